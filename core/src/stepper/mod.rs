//! What advances the arm by one tick. A stepper is immutable once built: factors and constants for
//! one tick length. Its state is separate and small, so that a restart is a new state and two runs
//! can share one stepper.

mod elastica;
mod kicks;
mod modal;
mod newmark;
mod oscillator;
mod rigid;
mod shaped;
mod terms;

pub use elastica::{Elastica, ElasticaState, Flex, Quality};
pub use modal::{Modal, ModalState};
pub use newmark::{Newmark, Vibration};
pub(crate) use oscillator::{Drive, Oscillator};
pub use rigid::Rigid;

use crate::Error;
use crate::hub::HubState;
use crate::math::Scalar;
use crate::motion::{Kink, Peaks};

/// The arm's answer at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<T> {
    /// Torque that the motor must put into the hub, N m.
    pub torque: T,
    /// The tip in the hub frame `(X, Y)`, m; Y is the deflection.
    pub tip: [T; 2],
}

/// Advances an arm whose hub follows a commanded motion.
///
/// The methods marked `inline(always)` in the implementations are the tick path: no allocation, no
/// panic, no `Result`, a fixed number of operations for a given stepper.
///
/// No method and no constant has a default. A wrapper that left one out would still run, but on other
/// paths than the stepper inside it: with other bits, and with energy that the inner one does not gain.
pub trait Stepper {
    /// The scalar of the tick.
    type Scalar: Scalar;

    /// What changes from tick to tick.
    type State: Copy;

    /// True if there are plain ticks at all, see [`Self::is_plain`]. The generator holds no code for
    /// those of a stepper that has none.
    const PLAIN: bool;

    /// True if the ticks of a hub at rest are advanced by [`Self::swing`] and answered by
    /// [`Self::response_at_rest`].
    const RESTS: bool;

    /// h, s.
    fn tick(&self) -> f64;

    /// True if gravity acts on the arm. If not, the hubs that [`Self::step`] and [`Self::response`] are
    /// given hold no sine and cosine, which then cost nothing.
    fn is_directed(&self) -> bool;

    /// Refuses a move with these peaks, after which the hub goes on turning at `held` rad/s, if the
    /// stepper was not set up for it. Not for the tick.
    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error>;

    /// Static equilibrium with the hub at rest at `hub.angle`. Set-up only.
    fn equilibrium(&self, hub: &HubState<Self::Scalar>) -> Self::State;

    /// Advances `state` by one tick, from the hub at its beginning to the hub at its end.
    fn step(
        &self,
        state: &mut Self::State,
        before: &HubState<Self::Scalar>,
        after: &HubState<Self::Scalar>,
    );

    /// True if the ticks of a cubic in which `|θ̇|` is at most `rate` may be advanced by
    /// [`Self::advance_in_cubic`]. Asked once a segment. Only an arm without gravity has plain ticks,
    /// see [`Self::is_directed`].
    fn is_plain(&self, rate: Self::Scalar) -> bool;

    /// Does [`Self::step`] and [`Self::response`] in one, where θ̈ is a straight line from the beginning of
    /// the tick to its end: the tick that most ticks are, inlined into [`Generator::tick`]. Returns the
    /// response to `after`, but for rounding.
    ///
    /// [`Generator::tick`]: crate::Generator::tick
    fn advance_in_cubic(
        &self,
        state: &mut Self::State,
        before: &HubState<Self::Scalar>,
        after: &HubState<Self::Scalar>,
    ) -> Response<Self::Scalar>;

    /// Does [`Self::step`] where the hub has been at rest and stays so, in any scene.
    fn swing(&self, state: &mut Self::State, hub: &HubState<Self::Scalar>);

    /// Does [`Self::response`] for a hub at rest.
    fn response_at_rest(
        &self,
        state: &Self::State,
        hub: &HubState<Self::Scalar>,
    ) -> Response<Self::Scalar>;

    /// Prepares the [`Self::step`] of a tick in which the commanded acceleration jumps or kinks between
    /// the ticks. `moment` is by how much `∫₀¹(1 − s)θ̈ ds` exceeds that of the parabola with the mean
    /// and the ends that `step` is given, rad/s²; `s` is the fraction of the tick. Steppers that take
    /// the rates only do nothing here.
    fn shift(&self, state: &mut Self::State, moment: Self::Scalar);

    /// Takes in the jumps that a shaper's delays put inside the tick that the coming [`Self::step`]
    /// advances by. [`Shaped::advance`](crate::motion::Shaped::advance) calls it before that step, in
    /// ticks that hold a jump only.
    fn kink(&self, state: &mut Self::State, kink: &Kink<Self::Scalar>);

    /// True if the arm, its hub at rest, moves by less than [`SLEEP`] of its length from where it
    /// rests: it may then be left as it is, and goes on from there.
    fn is_settled(&self, state: &Self::State) -> bool;

    /// Hub torque and tip for a state and the hub at the same instant.
    fn response(&self, state: &Self::State, hub: &HubState<Self::Scalar>)
    -> Response<Self::Scalar>;
}

/// Deflection below which an arm on a resting hub sleeps, fraction of its length: a tenth of what
/// the best reference resolves, and a few f32 roundings.
pub const SLEEP: f64 = 1e-6;

/// Largest change in a tick of what gravity puts on an arm, in link lengths that it deflects by: far beyond
/// anything that means something. An arm that it feeds without end, the hub turning at twice its
/// frequency, stays finite.
const MOST: f64 = 1e6;

/// Floors of a mode's coordinate for [`Stepper::is_settled`], from its tip deflection per unit.
fn sleep_floor<T: Scalar>(length: f64, tip: f64) -> T {
    T::from_f64(SLEEP * length / tip.abs())
}

/// The tick length if it is one: 1 µs to 1 s.
pub(crate) fn check_tick(tick: f64) -> Result<f64, Error> {
    Error::check("solver.tick", tick, 1e-6, 1.0, "s")
}
