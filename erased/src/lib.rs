#![forbid(unsafe_code)]
//! Steppers by number instead of by type. A firmware names its stepper's type; a desktop is told
//! which one, with how many elements or modes, when it runs. Every one of them, in both precisions,
//! is compiled here once, and taken by what calls it through [`AnyStepper`] and [`AnyGenerator`].
//!
//! ```
//! use stillbeam::{Link, Move, Profile, Scene};
//! use stillbeam_erased::{Kind, Mass, Precision, Spec, stepper};
//!
//! let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
//! let kind = Kind::Newmark { elements: 2, mass: Mass::Consistent, spin: true };
//! let arm = stepper(&scene, &Spec { kind, tick: 0.010, precision: Precision::F32 })?;
//! let mut generator = arm.generator(0.0)?;
//! generator.push(&Move::To { profile: Profile::Quintic, duration: 1.0, to: 1.0 })?;
//! while !generator.is_holding() {
//!     generator.tick();
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod build;
mod generator;
mod model;
mod on_carrier;
mod setpoint;
mod stepper;
mod steppers;

pub use build::{Kind, Precision, Refused, Spec, StepperVisitor, with_stepper};
pub use generator::{AnyGenerator, QUEUE};
pub use model::{Marched, Mass, ModelVisitor, first_period, with_model};
pub use setpoint::{AnySetpoint, Scalar};
pub use stepper::{AnyStepper, Shaped, stepper};
pub use steppers::{Erasable, Held};
