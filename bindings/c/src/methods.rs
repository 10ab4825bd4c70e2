//! The methods of an archive: one axis of a type that the exported constants, or the set-up, name.
//!
//! With one method the type has one variant, and costs nothing in the tick.

use stillbeam::axis::{Axis, Policy};
use stillbeam::prepared::Prepared;
use stillbeam::{Angle, Error, Stepper, UniformScene, stepper};

use crate::fault::Fault;
use crate::setup::{Method, Setup};

/// Segments that can wait: one S-curve and a move more, or eight moves of another shape.
const QUEUE: usize = 8;

/// Words of the header of exported constants that name their type.
const KIND: usize = 2;

/// First word of exported constants.
const MAGIC: u32 = u32::from_le_bytes(*b"SBPA");

#[cfg(not(any(
    feature = "elastica1",
    feature = "elastica2",
    feature = "elastica3",
    feature = "modal2",
    feature = "newmark1",
    feature = "rigid"
)))]
compile_error!("features: name one method at least, e.g. elastica2");

/// Does the same with the axis of whichever method it is.
macro_rules! on_axis {
    ($any:expr, $axis:ident => $work:expr) => {
        match $any {
            #[cfg(feature = "elastica1")]
            $crate::methods::AnyAxis::Elastica1($axis) => $work,
            #[cfg(feature = "elastica2")]
            $crate::methods::AnyAxis::Elastica2($axis) => $work,
            #[cfg(feature = "elastica3")]
            $crate::methods::AnyAxis::Elastica3($axis) => $work,
            #[cfg(feature = "modal2")]
            $crate::methods::AnyAxis::Modal2($axis) => $work,
            #[cfg(feature = "newmark1")]
            $crate::methods::AnyAxis::Newmark1($axis) => $work,
            #[cfg(feature = "rigid")]
            $crate::methods::AnyAxis::Rigid($axis) => $work,
        }
    };
}
pub(crate) use on_axis;

/// Lists the methods: feature, name, stepper, and how it is set up from a scene.
macro_rules! methods {
    ($($feature:literal $name:ident: $stepper:ty = $build:path;)*) => {
        /// An axis of one of the methods in this archive.
        // One lives in its caller's storage, which is of the largest.
        #[allow(clippy::large_enum_variant)]
        pub(crate) enum AnyAxis {
            $(#[cfg(feature = $feature)] $name(Axis<$stepper, QUEUE>),)*
        }

        impl AnyAxis {
            /// Loads the arm of exported constants, disabled at hub angle 0.
            pub(crate) fn load(words: &[u32], setup: &Setup) -> Result<Self, Fault> {
                let word = |i: usize| words.get(i).copied().unwrap_or(0);
                if word(0) != MAGIC {
                    let (parameter, found, needed) = ("arm.magic", word(0), MAGIC);
                    return Err(Error::NotPrepared { parameter, found, needed }.into());
                }
                let kind = [word(KIND), word(KIND + 1), word(KIND + 2)];
                $(
                    #[cfg(feature = $feature)]
                    if kind == <$stepper as Prepared>::KIND {
                        let stepper = <$stepper>::load(words, setup.tick)?;
                        return Ok(Self::$name(axis(stepper, setup.policy())?));
                    }
                )*
                Err(Fault::NotBuilt(kind[0]))
            }

            /// Sets the arm of a scene up, disabled at hub angle 0.
            pub(crate) fn set_up(scene: &UniformScene, setup: &Setup) -> Result<Self, Fault> {
                $(
                    #[cfg(feature = $feature)]
                    if setup.method == Method::$name as i32 {
                        let stepper: $stepper = $build(scene, setup)?;
                        return Ok(Self::$name(axis(stepper, setup.policy())?));
                    }
                )*
                Err(Fault::NotBuilt(setup.method as u32))
            }

            /// Puts the arm of another axis in the place of this one's. At rest only.
            pub(crate) fn replace(&mut self, with: &Self) -> Result<(), Fault> {
                match (self, with) {
                    $(
                        #[cfg(feature = $feature)]
                        (Self::$name(axis), Self::$name(with)) => {
                            let stepper = with.generator().stepper();
                            let (tick, needed) = (stepper.tick(), axis.generator().stepper().tick());
                            Fault::check("payload.tick", tick, (needed, needed), "s")?;
                            Ok(axis.replace(stepper.clone())?)
                        }
                    )*
                    #[allow(unreachable_patterns)]
                    _ => Err(Fault::OtherMethod),
                }
            }
        }
    };
}

methods! {
    "elastica1" Elastica1: stepper::Elastica<f32, 1> = elastica;
    "elastica2" Elastica2: stepper::Elastica<f32, 2> = elastica;
    "elastica3" Elastica3: stepper::Elastica<f32, 3> = elastica;
    "modal2" Modal2: stepper::Modal<f32, 2> = modal;
    "newmark1" Newmark1: stepper::Newmark<f32, 2, 2> = newmark;
    "rigid" Rigid: stepper::Rigid<f32> = rigid;
}

fn axis<S: Stepper<Scalar = f32>>(stepper: S, policy: Policy) -> Result<Axis<S, QUEUE>, Error> {
    Axis::new(stepper, Angle { turns: 0, part: 0.0 }, policy)
}

/// Fits elastica for the bend that the limit of the acceleration makes, or for the one that is
/// given.
#[cfg(any(feature = "elastica1", feature = "elastica2", feature = "elastica3"))]
fn elastica<const K: usize>(
    scene: &UniformScene,
    setup: &Setup,
) -> Result<stepper::Elastica<f32, K>, Error> {
    let rod = stillbeam::model::Rod::<K>::new(scene)?;
    let bend = if setup.bend == 0.0 {
        stepper::Elastica::<f32, K>::nearest_bend(rod.bend(setup.acceleration))
    } else {
        setup.bend
    };
    let quality = if setup.fine == 0 { stepper::Quality::Fast } else { stepper::Quality::Fine };
    stepper::Elastica::new(&rod, setup.tick, quality, bend)
}

#[cfg(feature = "modal2")]
fn modal(scene: &UniformScene, setup: &Setup) -> Result<stepper::Modal<f32, 2>, Error> {
    stepper::Modal::new(&stillbeam::model::EightElements::consistent(scene)?, setup.tick)
}

#[cfg(feature = "newmark1")]
fn newmark(scene: &UniformScene, setup: &Setup) -> Result<stepper::Newmark<f32, 2, 2>, Error> {
    stepper::Newmark::new(&stillbeam::model::OneElement::consistent(scene)?, setup.tick)
}

#[cfg(feature = "rigid")]
fn rigid(scene: &UniformScene, setup: &Setup) -> Result<stepper::Rigid<f32>, Error> {
    stepper::Rigid::new(scene, setup.tick)
}
