//! Maps numbers to the types of steppers: all that the desktop can run.

use std::fmt;
use std::marker::PhantomData;

use stillbeam::model::{Model, Rod};
use stillbeam::select::{Auto, Rung};
use stillbeam::stepper::{Elastica, Modal, Pointwise, Quality, Rigid};
use stillbeam::{Error, Mount, Scene};

use crate::model::{Marched, Mass, ModelVisitor, with_model};
use crate::on_carrier::Carried;
use crate::{Erasable, Scalar};

/// Which stepper, with which numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spec {
    /// Its type. Of a scene with a carrier that turns, it is built on that.
    pub kind: Kind,
    /// h, s.
    pub tick: f64,
    /// Precision of the tick. Set-up is always in double precision.
    pub precision: Precision,
}

/// Precision of the tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// As on the target.
    F32,
    /// To tell rounding from method.
    F64,
}

/// The type of a stepper.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // Fields of one name mean the same in all.
pub enum Kind {
    /// The arm does not bend.
    Rigid,
    /// The paper's time marching on 1, 2, 4 or 8 elements, without the spin's terms if `spin` is
    /// false.
    Newmark { elements: usize, mass: Mass, spin: bool },
    /// One to three modes of a model, each advanced exactly.
    Modal { modes: usize, elements: usize, mass: Mass, spin: bool },
    /// Exact kinematics in one to three modes, fitted for a tip angle of `bend` rad.
    Elastica { modes: usize, quality: Quality, bend: f64 },
    /// Exact kinematics at eight points of the link, in one to three modes.
    Pointwise { modes: usize },
    /// A rung of `auto`'s ladder, all rungs as one type.
    Rung { rung: Rung, bend: f64 },
}

/// A stepper that there is not.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refused {
    /// No model has this number of elements.
    Elements(usize),
    /// The model has only this many modes.
    Modes(usize),
    /// The set-up refuses it.
    SetUp(Error),
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Elements(n) => write!(f, "elements = {n}: must be 1, 2, 4 or 8"),
            Self::Modes(most) => write!(f, "modes: must be at most the model's {most}"),
            Self::SetUp(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for Refused {}

impl From<Error> for Refused {
    fn from(error: Error) -> Self {
        Self::SetUp(error)
    }
}

/// Action on a stepper whose type is known only here. It is compiled for each of some twenty types
/// in both precisions, and once more for each on a carrier; what an
/// [`AnyStepper`](crate::AnyStepper) offers is compiled already.
pub trait StepperVisitor {
    /// Result of the action.
    type Output;

    /// Receives the stepper.
    fn visit<S: Erasable>(self, stepper: S) -> Self::Output;
}

/// Builds the stepper that is asked for, model included, and hands it to the visitor.
///
/// # Errors
/// A model or modes that there are not, and what the set-up refuses.
pub fn with_stepper<V: StepperVisitor>(
    scene: &Scene,
    spec: &Spec,
    visitor: V,
) -> Result<V::Output, Refused> {
    if scene.mount.carrier == 0.0 {
        return in_precision(scene, spec, visitor);
    }
    let resting = Scene { mount: Mount { carrier: 0.0, ..scene.mount }, ..*scene };
    in_precision(&resting, spec, Carried { scene, visitor })?
}

fn in_precision<V: StepperVisitor>(
    scene: &Scene,
    spec: &Spec,
    visitor: V,
) -> Result<V::Output, Refused> {
    match spec.precision {
        Precision::F32 => of_kind::<f32, V>(scene, spec, visitor),
        Precision::F64 => of_kind::<f64, V>(scene, spec, visitor),
    }
}

/// The list of steppers. A new method is one more arm here, and one more line in the types that
/// steppers share.
fn of_kind<T: Scalar, V: StepperVisitor>(
    scene: &Scene,
    spec: &Spec,
    visitor: V,
) -> Result<V::Output, Refused> {
    let tick = spec.tick;
    match spec.kind {
        Kind::Rigid => Ok(visitor.visit(Rigid::<T>::new(scene, tick)?)),
        Kind::Newmark { elements, mass, spin } => {
            let newmark = NewmarkOf::<T, V> { tick, spin, visitor, scalar: PhantomData };
            with_model(scene, elements, mass, newmark)?
        }
        Kind::Modal { modes, elements, mass, spin } => {
            let modal = ModalOf::<T, V> { tick, modes, spin, visitor, scalar: PhantomData };
            with_model(scene, elements, mass, modal)?
        }
        Kind::Elastica { modes, quality, bend } => {
            let visited = match modes {
                1 => visitor.visit(Elastica::<T, 1>::new(&Rod::new(scene)?, tick, quality, bend)?),
                2 => visitor.visit(Elastica::<T, 2>::new(&Rod::new(scene)?, tick, quality, bend)?),
                3 => visitor.visit(Elastica::<T, 3>::new(&Rod::new(scene)?, tick, quality, bend)?),
                _ => return Err(Refused::Modes(3)),
            };
            Ok(visited)
        }
        Kind::Pointwise { modes } => match modes {
            1 => Ok(visitor.visit(Pointwise::<T, 1>::new(scene, tick)?)),
            2 => Ok(visitor.visit(Pointwise::<T, 2>::new(scene, tick)?)),
            3 => Ok(visitor.visit(Pointwise::<T, 3>::new(scene, tick)?)),
            _ => Err(Refused::Modes(3)),
        },
        Kind::Rung { rung, bend } => Ok(visitor.visit(Auto::<T>::new(scene, tick, rung, bend)?)),
    }
}

/// Newmark of a model, for a visitor.
struct NewmarkOf<T, V> {
    tick: f64,
    spin: bool,
    visitor: V,
    scalar: PhantomData<T>,
}

impl<T: Scalar, V: StepperVisitor> ModelVisitor for NewmarkOf<T, V> {
    type Output = Result<V::Output, Refused>;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Self::Output
    where
        Model<N, W>: Marched,
    {
        Ok(self.visitor.visit(model.newmark::<T>(self.tick, self.spin)?))
    }
}

/// Modal of a model, for a visitor.
struct ModalOf<T, V> {
    tick: f64,
    modes: usize,
    spin: bool,
    visitor: V,
    scalar: PhantomData<T>,
}

impl<T: Scalar, V: StepperVisitor> ModelVisitor for ModalOf<T, V> {
    type Output = Result<V::Output, Refused>;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Self::Output
    where
        Model<N, W>: Marched,
    {
        if !(1..=N.min(3)).contains(&self.modes) {
            return Err(Refused::Modes(N.min(3)));
        }
        let Self { tick, spin, visitor, .. } = self;
        Ok(match self.modes {
            1 => visitor.visit(modal::<T, 1, N, W>(&model, tick, spin)?),
            2 => visitor.visit(modal::<T, 2, N, W>(&model, tick, spin)?),
            _ => visitor.visit(modal::<T, 3, N, W>(&model, tick, spin)?),
        })
    }
}

fn modal<T: Scalar, const K: usize, const N: usize, const W: usize>(
    model: &Model<N, W>,
    tick: f64,
    spin: bool,
) -> Result<Modal<T, K>, Error> {
    let stepper = Modal::new(model, tick)?;
    Ok(if spin { stepper } else { stepper.without_spin() })
}
