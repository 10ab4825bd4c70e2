#![no_std]
#![forbid(unsafe_code)]
//! Feed-forward setpoints for a flexible robot link, in real time.
//!
//! The crate in the order of the data:
//!
//! 1. [`Scene`]: the arm in SI units, validated ([`scene`], [`material`]).
//! 2. [`beam`]: its matrices, its modes, the exact rod; f64, once.
//! 3. [`stepper`]: what advances the arm by one tick; built from the model for one tick length.
//! 4. [`motion`]: moves of the hub, planned into segments.
//! 5. [`Generator`]: stepper and motion; [`Generator::tick`] gives the next [`Setpoint`].
//! 6. [`axis`]: a generator under a policy: enable, stop, a late tick, a lost link.
//! 7. [`motor`]: what the setpoint asks of the motor's shaft, behind gear and friction.
//! 8. [`drive`]: that demand as the bytes of a drive's protocol.
//!
//! ```
//! use stillbeam::model::Rod;
//! use stillbeam::stepper::{Elastica, Quality};
//! use stillbeam::{Generator, Link, Move, Profile, Scene};
//!
//! let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
//! scene.payload.mass = 0.030;
//! // Set-up, once: fitted for the bend that accelerations up to 100 rad/s² make.
//! let rod = Rod::<2>::new(&scene)?;
//! let stepper = Elastica::<f32, 2>::new(&rod, 0.010, Quality::Fast, rod.bend(100.0))?;
//! let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
//! arm.push(&Move::To { profile: Profile::Quintic, duration: 0.6, to: 1.57 })?;
//!
//! // Every 10 ms: one call.
//! for _ in 0..=60 {
//!     let setpoint = arm.tick();
//!     assert!(setpoint.torque.abs() < 0.5 && setpoint.deflection().abs() < 0.08);
//! }
//! # Ok::<(), stillbeam::Error>(())
//! ```
//!
//! The paper's own choice is one element and Newmark's rule:
//!
//! ```
//! use stillbeam::model::OneElement;
//! use stillbeam::stepper::Newmark;
//! use stillbeam::{Generator, Link, Scene};
//!
//! let scene = Scene::new(Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 });
//! let stepper = Newmark::<f32, 2, 2>::new(&OneElement::consistent(&scene)?, 0.010)?;
//! let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
//! assert_eq!(arm.tick().deflection(), 0.0);
//! # Ok::<(), stillbeam::Error>(())
//! ```

pub mod axis;
pub mod drive;
mod error;
mod generator;
pub mod hub;
pub mod material;
pub mod math;
pub mod model;
pub mod motion;
pub mod motor;
pub mod planner;
pub mod scene;
pub mod select;
pub mod stepper;

pub use error::Error;
pub use generator::{Departure, Generator, Planned, Setpoint};
pub use hub::{Angle, HubState};
pub use math::Scalar;
pub use motion::{Limits, Move, Profile, Remedy};
pub use scene::{Damping, Hub, Link, Payload, Scene};
pub use stepper::Stepper;
