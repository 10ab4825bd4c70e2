#![no_std]
#![forbid(unsafe_code)]
//! Feed-forward setpoints for a flexible robot link, in real time.
//!
//! The crate in the order of the data:
//!
//! 1. [`Scene`]: the arm in SI units, validated ([`scene`], [`material`]).
//! 2. [`beam`]: its matrices, modes; f64, once.
//! 3. [`stepper`]: what advances the arm by one tick; built from the model for one tick length.
//! 4. [`motion`]: moves of the hub, planned into segments.
//! 5. [`Generator`]: stepper and motion; [`Generator::tick`] gives the next [`Setpoint`].
//!
//! ```
//! use stillbeam::beam::OneElement;
//! use stillbeam::stepper::Newmark;
//! use stillbeam::{Generator, Link, Move, Profile, Scene};
//!
//! // The paper's member B with 30 g at the tip: π rad in 2 s, a setpoint every 10 ms.
//! let mut scene = Scene::new(Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 });
//! scene.payload.mass = 0.030;
//! let stepper = Newmark::<f32, 2, 2>::new(&OneElement::consistent(&scene)?, 0.010)?;
//! let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
//! arm.push(&Move::To { profile: Profile::Cubic, duration: 2.0, to: core::f64::consts::PI })?;
//! for _ in 0..=400 {
//!     let setpoint = arm.tick();
//!     assert!(setpoint.deflection.abs() < 0.06);
//! }
//! # Ok::<(), stillbeam::Error>(())
//! ```

pub mod beam;
mod error;
mod generator;
pub mod material;
pub mod math;
pub mod motion;
pub mod scene;
pub mod stepper;

pub use error::Error;
pub use generator::{Generator, Setpoint};
pub use math::Scalar;
pub use motion::{Angle, Limits, Move, Profile};
pub use scene::{Damping, Hub, Link, Payload, Scene};
pub use stepper::Stepper;
