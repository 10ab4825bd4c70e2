//! The steppers of an arm on a carrier that turns.

use std::marker::PhantomData;

use stillbeam::select::{Auto, Rung};
use stillbeam::stepper::OnCarrier;
use stillbeam::{Mount, Scene};

use crate::build::{Kind, ModalOf, NewmarkOf, Refused, Spec, StepperVisitor, pointwise};
use crate::model::with_model;
use crate::{Erasable, Scalar};

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
        Kind::Pointwise { modes } => {
            pointwise::<T, _>(&resting, tick, modes, Carried { scene, visitor })??
        }
        Kind::Rung { rung, bend } => visitor.visit(carried(rung, bend)?),
        Kind::Newmark { elements, mass, spin } => {
            let visitor = Carried { scene, visitor };
            let newmark = NewmarkOf::<T, _> { tick, spin, visitor, scalar: PhantomData };
            with_model(&resting, elements, mass, newmark)???
        }
        Kind::Modal { modes, elements, mass, spin } => {
            let visitor = Carried { scene, visitor };
            let modal = ModalOf::<T, _> { tick, modes, spin, visitor, scalar: PhantomData };
            with_model(&resting, elements, mass, modal)???
        }
    })
}

/// Puts the stepper of an arm on the scene's carrier, for the visitor.
struct Carried<'a, V> {
    scene: &'a Scene,
    visitor: V,
}

impl<V: StepperVisitor> StepperVisitor for Carried<'_, V> {
    type Output = Result<V::Output, Refused>;

    fn visit<S: Erasable>(self, stepper: S) -> Self::Output {
        Ok(self.visitor.visit(OnCarrier::new(self.scene, |_| Ok(stepper))?))
    }
}
