//! Requests to the planner.

use super::{Objective, Prediction};
use crate::hub::{Angle, HubState};
use crate::motion::Limits;
use crate::stepper::ArmState;

/// A move to be planned, from any state of hub and arm to rest, or to a rate at which the arm is at
/// rest relative to the hub.
///
/// ```
/// use stillbeam::planner::{Planner, Request};
/// use stillbeam::{Limits, Link, Scene};
///
/// let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
/// let planner = Planner::<f32, 2>::new(&scene, 0.010)?;
/// let limits = Limits { acceleration: Some(300.0), ..Limits::default() };
/// let shortest = planner.plan(&Request::from_rest(0.0, 1.57).limits(limits))?;
/// assert!(shortest.peaks.acceleration <= 300.0);
/// let slower = Request::from_rest(0.0, 1.57).limits(limits).duration(1.5 * shortest.duration());
/// assert!(planner.plan(&slower)?.peaks.acceleration < 200.0);
/// # Ok::<(), stillbeam::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Request<T, const K: usize> {
    /// State of the hub where the move begins.
    pub from: HubState<f64>,
    /// State of the arm where the move begins. `None`: static equilibrium at the hub's angle.
    pub arm: Option<ArmState<T, K>>,
    /// End of the move.
    pub target: Target,
    /// Rate with which the hub turns on from the end, rad/s; the arm is at rest relative to it. 0
    /// by default. Under gravity it must be 0, as a turning arm never rests then.
    pub rate: f64,
    /// Duration in s, rounded to whole ticks. `None`: the shortest that the planner finds.
    pub duration: Option<f64>,
    /// Limits of the hub's motion, of torque and of clamp moment. None by default.
    pub limits: Limits,
    /// Greatest deflection of the tip, of L, by simulation. 0.7 by default: beyond it the arm may
    /// bend back on itself. `None`: the deflection is not looked at, which saves a simulation.
    pub deflection: Option<f64>,
    /// Residual vibration that the arm may keep, of L, 0 to 0.2. 0 by default: as little as can be.
    /// More makes the fastest move shorter, and lets a robust planner plan one. Other moves leave
    /// what they leave without it.
    pub residual: f64,
    /// True if a move with a piecewise-linear acceleration begins and ends without acceleration
    /// though no jerk is limited. False by default: then it jumps there, as a cubic's does. A
    /// quintic with a bulge never jumps from rest to rest.
    pub eased: bool,
    /// Quantity that the move keeps small.
    pub objective: Objective,
    /// Model that the move is planned by.
    pub kinematics: Kinematics,
}

/// End of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// At this hub angle, rad, −1e6 to 1e6.
    Angle(f64),
    /// About where the hub gets to if its rate falls evenly to zero.
    Stop,
}

/// Model of the arm that a move is planned by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kinematics {
    /// Geometrically exact: the move is simulated and corrected until the arm arrives at rest.
    Exact,
    /// Linear oscillators: no correction. A strongly bent arm rings on.
    Linear,
}

impl<T, const K: usize> Request<T, K> {
    /// Asks for the shortest move from rest at `from` rad to rest at `to` rad.
    pub fn from_rest(from: f64, to: f64) -> Self {
        Self::from_hub(HubState::at_rest(Angle::from_radians(from)), Target::Angle(to))
    }

    /// Asks for the shortest move from a state of the hub to rest at `target`, the arm in static
    /// equilibrium.
    pub fn from_hub(from: HubState<f64>, target: Target) -> Self {
        Self {
            from,
            arm: None,
            target,
            rate: 0.0,
            duration: None,
            limits: Limits::default(),
            deflection: Some(Prediction::MAX_DEFLECTION),
            residual: 0.0,
            eased: false,
            objective: Objective::Acceleration,
            kinematics: Kinematics::Exact,
        }
    }

    /// Begins with the arm bent and moving.
    pub fn arm(self, arm: ArmState<T, K>) -> Self {
        Self { arm: Some(arm), ..self }
    }

    /// Ends somewhere else.
    pub fn target(self, target: Target) -> Self {
        Self { target, ..self }
    }

    /// Ends turning at `rate` rad/s: the hub passes the target.
    pub fn passing(self, rate: f64) -> Self {
        Self { rate, ..self }
    }

    /// Takes `duration` s, rounded to whole ticks.
    pub fn duration(self, duration: f64) -> Self {
        Self { duration: Some(duration), ..self }
    }

    /// Keeps `limits`.
    pub fn limits(self, limits: Limits) -> Self {
        Self { limits, ..self }
    }

    /// Does not look at the tip's deflection: see [`Self::deflection`].
    pub fn any_deflection(self) -> Self {
        Self { deflection: None, ..self }
    }

    /// Leaves up to `residual` of L of vibration.
    pub fn residual(self, residual: f64) -> Self {
        Self { residual, ..self }
    }

    /// Begins and ends without acceleration: see [`Self::eased`](#structfield.eased).
    pub fn eased(self) -> Self {
        Self { eased: true, ..self }
    }

    /// Keeps something else small than the acceleration.
    pub fn objective(self, objective: Objective) -> Self {
        Self { objective, ..self }
    }

    /// Plans by another model.
    pub fn kinematics(self, kinematics: Kinematics) -> Self {
        Self { kinematics, ..self }
    }

    /// True if hub and arm begin at rest.
    pub(super) fn begins_at_rest(&self) -> bool {
        self.from.rate == 0.0 && self.from.acceleration == 0.0 && self.arm.is_none()
    }
}
