//! The steppers of an arm on a carrier that turns.

use std::marker::PhantomData;

use stillbeam::model::Model;
use stillbeam::select::{Auto, Rung};
use stillbeam::stepper::{Newmark, OnCarrier};
use stillbeam::{Mount, Scene};

use crate::Scalar;
use crate::build::{Kind, Refused, Spec, StepperVisitor, modal};
use crate::model::{ModelVisitor, with_model};

/// Builds the stepper that is asked for on the scene's carrier. What `auto` has a rung for is of
/// one type, as such scenes are rare.
pub(crate) fn on_carrier<T: Scalar, V: StepperVisitor>(
    scene: &Scene,
    spec: &Spec,
    visitor: V,
) -> Result<V::Output, Refused> {
    let tick = spec.tick;
    let resting = Scene { mount: Mount { carrier: 0.0, ..scene.mount }, ..*scene };
    let carried = |rung, bend| OnCarrier::<Auto<T>>::of_rung(scene, tick, rung, bend);
    Ok(match spec.kind {
        Kind::Rigid => visitor.visit(carried(Rung::Rigid, 0.0)?),
        Kind::Elastica { modes, quality, bend } => match modes {
            1..=3 => visitor.visit(carried(Rung::Elastica(modes, quality), bend)?),
            _ => return Err(Refused::Modes(3)),
        },
        Kind::Rung { rung, bend } => visitor.visit(carried(rung, bend)?),
        Kind::Newmark { elements, mass, spin } => {
            let newmark = NewmarkOf::<T, V> { scene, tick, spin, visitor, scalar: PhantomData };
            with_model(&resting, elements, mass, newmark)??
        }
        Kind::Modal { modes, elements, mass, spin } => {
            let modal = ModalOf::<T, V> { scene, tick, modes, spin, visitor, scalar: PhantomData };
            with_model(&resting, elements, mass, modal)??
        }
    })
}

struct NewmarkOf<'a, T, V> {
    scene: &'a Scene,
    tick: f64,
    spin: bool,
    visitor: V,
    scalar: PhantomData<T>,
}

impl<T: Scalar, V: StepperVisitor> ModelVisitor for NewmarkOf<'_, T, V> {
    type Output = Result<V::Output, Refused>;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Self::Output {
        let stepper = OnCarrier::new(self.scene, |_| {
            let stepper = Newmark::<T, N, W>::new(&model, self.tick)?;
            Ok(if self.spin { stepper } else { stepper.without_spin() })
        })?;
        Ok(self.visitor.visit(stepper))
    }
}

struct ModalOf<'a, T, V> {
    scene: &'a Scene,
    tick: f64,
    modes: usize,
    spin: bool,
    visitor: V,
    scalar: PhantomData<T>,
}

impl<T: Scalar, V: StepperVisitor> ModelVisitor for ModalOf<'_, T, V> {
    type Output = Result<V::Output, Refused>;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Self::Output {
        match self.modes {
            1 if N >= 1 => self.in_modes::<1, N, W>(&model),
            2 if N >= 2 => self.in_modes::<2, N, W>(&model),
            3 if N >= 3 => self.in_modes::<3, N, W>(&model),
            _ => Err(Refused::Modes(N.min(3))),
        }
    }
}

impl<T: Scalar, V: StepperVisitor> ModalOf<'_, T, V> {
    fn in_modes<const K: usize, const N: usize, const W: usize>(
        self,
        model: &Model<N, W>,
    ) -> Result<V::Output, Refused> {
        let set_up = |_: &Scene| modal::<T, K, N, W>(model, self.tick, self.spin);
        Ok(self.visitor.visit(OnCarrier::new(self.scene, set_up)?))
    }
}
