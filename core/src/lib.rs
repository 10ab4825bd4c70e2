#![no_std]
#![forbid(unsafe_code)]
#![warn(clippy::too_many_lines)]
#![warn(missing_debug_implementations)]
//! Feed-forward setpoints for a flexible robot link, in real time.
//!
//! A link (a strip clamped to a motor hub, with a payload) and a move go in. Every tick, 10 ms for
//! example, a [`Setpoint`] comes out: angle, rate, acceleration and torque of the hub, and where
//! the tip will be. A tick does not allocate, does not panic and does not fail.
//!
//! ```
//! use stillbeam::model::Rod;
//! use stillbeam::stepper::{Elastica2, Quality};
//! use stillbeam::{Generator, Link, Move, Profile, Scene};
//!
//! let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
//! scene.payload.mass = 0.030;
//! // Set-up, once: fitted for the bend that accelerations up to 100 rad/s² make.
//! let rod = Rod::new(&scene)?;
//! let stepper = Elastica2::<f32>::new(&rod, 0.010, Quality::Fast, rod.bend(100.0))?;
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
//! # Modules
//!
//! In the order of the data:
//!
//! 1. [`Scene`]: the arm in SI units, validated ([`scene`], [`material`]).
//! 2. [`model`]: its matrices, its modes, the exact rod; f64, once.
//! 3. [`motion`]: moves of the hub, planned into segments; limits and input shapers.
//! 4. [`stepper`]: methods that advance the arm by one tick, built from the model for one tick
//!    length.
//! 5. [`Generator`]: stepper and motion; [`Generator::tick`] gives the next [`Setpoint`].
//! 6. [`planner`]: moves after which the arm is at rest; [`select`]: the cheapest stepper that will
//!    do. Both can be set up on the desktop and loaded: [`prepared`].
//! 7. [`axis`]: a generator under a policy: enable, stop, a late tick, a lost link.
//! 8. [`motor`]: the setpoint's demand on the motor's shaft, behind gear and friction.
//! 9. [`drive`]: that demand as the bytes of a drive's protocol.
//!
//! Several links on joints, open or closed to a loop, are a [`Mechanism`](mechanism::Mechanism). A
//! [`ChainGenerator`](chain::ChainGenerator) gives the setpoints of all its joints in one tick.
//!
//! # Which stepper
//!
//! | stepper | assumes | take it |
//! |---|---|---|
//! | [`Newmark1`](stepper::Newmark1) | small deflections, one element | for the paper's scheme, and slow moves |
//! | [`Modal2`](stepper::Modal2) | small deflections, two modes | where the arm bends less than 10 % of L |
//! | [`Elastica2`](stepper::Elastica2) | nothing about the bend, up to 2 rad | in every other case |
//! | [`Auto`](select::Auto) | that the moves are known at set-up | to have it chosen by a tolerance |
//!
//! The paper's own choice is one element and Newmark's rule:
//!
//! ```
//! use stillbeam::model::OneElement;
//! use stillbeam::stepper::Newmark1;
//! use stillbeam::{Generator, Link, Scene};
//!
//! let scene = Scene::new(Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 });
//! let stepper = Newmark1::<f32>::new(&OneElement::consistent(&scene)?, 0.010)?;
//! let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
//! assert_eq!(arm.tick().deflection(), 0.0);
//! # Ok::<(), stillbeam::Error>(())
//! ```
//!
//! # Errors
//!
//! A refusal is an [`Error`], which names the field, its value, what it must be and what to do.
//! Nothing has changed then. Kinds may be added: a `match` needs a last arm.
//!
//! ```
//! use stillbeam::model::OneElement;
//! use stillbeam::{Error, Link, Scene};
//!
//! let scene = Scene::new(Link { length: -0.4, mass: 0.02, bending_stiffness: 0.04 });
//! let error = OneElement::consistent(&scene).unwrap_err();
//! assert!(matches!(error, Error::OutOfRange { parameter: "link.length", .. }));
//! assert_eq!(error.to_string(), "link.length = -0.4: must be 0.001 to 1000 m");
//! ```
//!
//! # Features
//!
//! All are off by default. Each compiles alone, and none of them changes a bit of a setpoint.
//!
//! | feature | adds | for |
//! |---|---|---|
//! | `defmt` | `defmt::Format` on setpoints, angles, demands, modes and errors | logging on the target |
//! | `serde` | `Serialize` and `Deserialize` on scenes, moves, limits, setpoints | what crosses a wire |
//!
//! # Examples
//!
//! Numbered, in `examples/`; each prints or draws what it does, on the desktop:
//!
//! | `cargo run --example …` | shows |
//! |---|---|
//! | `01_one_move` | setpoints of a move, and the ringing after it |
//! | `02_queue_and_limits` | a queue, limits, a refusal and its remedy |
//! | `03_arrive_still` | a move after which the arm is at rest |
//! | `04_input_shaper` | five shapers on the same move |
//! | `05_motor_and_drive` | from setpoint to shaft to bytes |
//! | `06_choose_method` | the cheapest stepper within a tolerance |
//! | `07_waypoints` | a path of any length through a queue of eight |
//! | `08_follow` | a hub that another program moves, and a target that moves |

pub mod axis;
pub mod chain;
pub mod drive;
mod error;
mod generator;
pub mod hub;
pub mod material;
pub mod math;
pub mod mechanism;
pub mod model;
pub mod motion;
pub mod motor;
pub mod planner;
pub mod prepared;
pub mod scene;
pub mod select;
pub mod stepper;

pub use error::Error;
pub use generator::{Generator, PlanContext, PlannedMove, Setpoint};
pub use hub::{Angle, HubState};
pub use math::Scalar;
pub use motion::{Limits, Move, PlainMove, Plannable, Profile, Remedy};
pub use scene::{AxisKind, Damping, Hub, Link, Mount, Payload, Scene, UniformScene};
pub use stepper::Stepper;
