//! Steppers: methods that advance the arm by one tick. A stepper is immutable once built: factors
//! and constants for one tick length. Its state is separate and small, so that a restart is a new
//! state and two runs can share one stepper.

mod aliases;
mod borrowed;
mod elastica;
mod kicks;
mod modal;
mod newmark;
mod on_carrier;
mod oscillator;
mod path;
mod pointwise;
mod prepared;
mod rigid;
mod shaped;
mod terms;

pub use aliases::{
    Elastica1, Elastica2, Elastica3, Modal1, Modal2, Modal3, Newmark1, Newmark2, Newmark4, Newmark8,
};
pub use elastica::{ArmState, Elastica, ElasticaFast, ElasticaState, Quality};
pub use modal::{Modal, ModalState};
pub use newmark::{Newmark, NewmarkState};
pub use on_carrier::OnCarrier;
pub(crate) use oscillator::{Forcing, LONGEST_TURN, Oscillator};
pub use path::{AnyMotion, AtRest, FastPaths, HubMotion, KinkMoments, Linear};
pub use pointwise::{Pointwise, PointwiseState};
pub use rigid::Rigid;

use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::Scalar;
use crate::motion::Peaks;

/// The arm's answer at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<T> {
    /// Torque that the motor must put into the hub, N m. On a linear axis the force along it, N.
    pub torque: T,
    /// The tip in the hub frame `(X, Y)`, m; Y is the deflection.
    pub tip: [T; 2],
}

/// Advances an arm whose hub follows a commanded motion.
///
/// A stepper says once how it steps and once how it answers, for whatever is known of the hub's
/// motion ([`HubMotion`]). A wrapper passes the motion on and has thereby every path of the stepper
/// inside it.
///
/// The methods marked `inline(always)` in the implementations are the tick path: no allocation, no
/// panic, no `Result`, a fixed number of operations for a given stepper.
pub trait Stepper {
    /// The scalar of the tick.
    type Scalar: Scalar;

    /// State of the arm: all that changes from tick to tick.
    type State: Copy;

    /// The motions that [`Self::step`] has code of its own for.
    const FAST: FastPaths;

    /// Tick length h, s.
    fn tick(&self) -> f64;

    /// Direction of gravity in the hub frame. The hubs that [`Self::step`] and [`Self::response`]
    /// are given hold sine and cosine of its angle χ; without gravity, or on a carriage, these do
    /// not change and cost nothing.
    fn gravity(&self) -> &GravityDirection<Self::Scalar>;

    /// True if the ticks of a segment with linear acceleration in which `|θ̇|` is at most `rate`
    /// rad/s may be advanced as [`Linear`]; never under gravity. Asked once a segment.
    fn is_linear_fast(&self, rate: Self::Scalar) -> bool;

    /// Refuses a move with these peaks, after which the hub goes on turning at `held` rad/s, if the
    /// stepper was not set up for it. Not for the tick.
    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error>;

    /// Static equilibrium with the hub at rest at `hub.angle`; `hub` holds sine and cosine of χ.
    /// Set-up only.
    fn equilibrium(&self, hub: &HubState<Self::Scalar>) -> Self::State;

    /// Advances `state` by one tick, from the hub at its beginning to the hub at its end.
    fn step<M: HubMotion>(
        &self,
        state: &mut Self::State,
        before: &HubState<Self::Scalar>,
        after: &HubState<Self::Scalar>,
    );

    /// Hub torque and tip for a state and the hub at the same instant, `M` being the motion that
    /// led there. Motions differ by rounding only.
    fn response<M: HubMotion>(
        &self,
        state: &Self::State,
        hub: &HubState<Self::Scalar>,
    ) -> Response<Self::Scalar>;

    /// Angle of the link's tangent at the tip against the hub's x axis, rad. The payload's centre
    /// is [`Payload::offset`](crate::Payload) beyond the tip in that direction: see
    /// [`Setpoint::payload_centre`](crate::Setpoint::payload_centre). Costs nothing where it is not
    /// called.
    fn tip_angle(&self, state: &Self::State) -> Self::Scalar;

    /// Prepares the [`Self::step`] of a tick in which the commanded acceleration jumps or kinks. To
    /// be called before that step. Steppers that take the rates only do nothing here.
    fn kink(&self, state: &mut Self::State, moments: KinkMoments<'_, Self::Scalar>);

    /// True if the arm, its hub at rest, moves by less than [`SLEEP`] of its length from where it
    /// rests: it may then be left as it is, and goes on from there.
    fn is_settled(&self, state: &Self::State) -> bool;
}

/// Deflection below which an arm on a resting hub sleeps, fraction of its length: a tenth of what
/// the best reference resolves, and a few f32 roundings.
pub const SLEEP: f64 = 1e-6;

/// Largest change in a tick of what gravity puts on an arm, in link lengths that it deflects by. No
/// real arm comes near; one that gravity feeds without end, the hub turning at twice its frequency,
/// stays finite.
const MOST_GRAVITY_CHANGE: f64 = 1e6;

/// Coordinate of a mode below which it is settled, from its tip deflection per unit.
fn sleep_floor<T: Scalar>(length: f64, tip: f64) -> T {
    T::from_f64(SLEEP * length / tip.abs())
}

/// Checks the tip angle, rad, that a move bends a link by.
pub(crate) fn check_bend(bend: f64, max: f64) -> Result<(), Error> {
    // The peak of a curve is right to 1e-4, wherever it was computed.
    if bend <= max * (1.0 + 2e-4) { Ok(()) } else { Err(Error::BendsTooFar { bend, max }) }
}

/// The tick length if it is one: 1 µs to 1 s.
pub(crate) fn check_tick(tick: f64) -> Result<f64, Error> {
    Error::check("solver.tick", tick, 1e-6, 1.0, "s")
}
