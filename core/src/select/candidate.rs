//! A stepper on trial: how it is led along a motion, and how far it is off.

use crate::Error;
use crate::generator::Generator;
use crate::hub::HubState;
use crate::math::{Each, Scalar, sqrt};
use crate::motion::{Commanded, Kink, MAX_SEGMENTS};
use crate::stepper::{AnyMotion, KinkMoments, Response, Stepper};

/// Segments that wait in the candidate's generator: two of the longest moves.
const QUEUE: usize = 2 * MAX_SEGMENTS;

/// Part of the ringing that the exact rod has lost that counts as met at a tick. All of it would be
/// met if every mode were at its crest there. Over the 10,000 arms of `docs/auto.md` a half leaves
/// 14 of 6,742 choices beyond their tolerance. Three quarters leave 2 of 6,709, and 0.57 % are two
/// rungs too dear; with all of it 1 of 6,676 and 0.63 %.
const UNSEEN: f64 = 0.75;

/// Motion of the hub from one tick to the next.
pub(super) struct Tick {
    /// The tick that ends it.
    pub number: u64,
    /// The hub at its beginning, just after.
    pub before: HubState<f32>,
    /// The hub at its end, just before and just after.
    pub arrival: HubState<f32>,
    pub after: HubState<f32>,
    /// See [`Commanded::kink`].
    pub kink: Kink<f32>,
}

/// Leads a stepper as it is led when it ships.
#[allow(clippy::large_enum_variant)] // There is no heap to put one on.
enum Lead<S: Stepper> {
    /// By a generator that is given the moves.
    Moves {
        arm: Generator<S, QUEUE>,
        pushed: usize,
        /// Ticks before the last move pushed, and with it.
        begin: u64,
        end: u64,
    },
    /// By hand.
    HubState { stepper: S, state: S::State },
}

/// A stepper on trial.
pub(super) struct Candidate<S: Stepper> {
    lead: Lead<S>,
    /// Largest distance of the tips, fraction of L.
    pub distance: f64,
    /// Largest difference of the torques away from jumps, N m, with the part [`UNSEEN`] of what the
    /// exact rod has lost by then.
    pub torque: f64,
    /// Differences of the torque at the latest two ticks, the later one last: a jump may still
    /// follow that is too close.
    pending: [f64; 2],
    /// Reason why it cannot follow.
    pub error: Option<Error>,
}

impl<S: Stepper> Candidate<S> {
    /// At rest where the motion begins.
    pub fn new(stepper: S, motion: &dyn Commanded, first: &HubState<f32>) -> Result<Self, Error> {
        let lead = if motion.moves().is_some() {
            let arm = Generator::new(stepper, motion.from())?;
            Lead::Moves { arm, pushed: 0, begin: 0, end: 0 }
        } else {
            stepper.admit(&motion.peaks(), 0.0)?;
            let state = stepper.equilibrium(&aimed(&stepper, first));
            Lead::HubState { stepper, state }
        };
        Ok(Self { lead, distance: 0.0, torque: 0.0, pending: [0.0; 2], error: None })
    }

    /// True if it is still in the running: within `most` of L, and able to follow.
    pub fn follows(&self, most: f64) -> bool {
        self.error.is_none() && self.distance <= most
    }

    /// Goes on to the end of a tick. After the last move it holds.
    pub fn tick(&mut self, motion: &dyn Commanded, tick: &Tick) -> Option<Response<S::Scalar>> {
        match &mut self.lead {
            Lead::Moves { arm, pushed, begin, end } => {
                // While one move runs the next one waits: none begins late.
                while *begin <= tick.number
                    && let Some(next) = motion.moves().and_then(|moves| moves.get(*pushed))
                {
                    match arm.push(next) {
                        Ok(summary) => {
                            (*begin, *end) = (*end, *end + u64::from(summary.ticks));
                            *pushed += 1;
                        }
                        Err(error) => {
                            self.error = Some(error);
                            return None;
                        }
                    }
                }
                let setpoint = arm.tick();
                Some(Response { torque: setpoint.torque, tip: setpoint.tip })
            }
            Lead::HubState { stepper, state } => {
                if tick.number > 0 {
                    if !tick.kink.is_none() {
                        stepper.kink(state, KinkMoments::All(&tick.kink.cast()));
                    }
                    let [before, arrival] =
                        [&tick.before, &tick.arrival].map(|hub| aimed(stepper, hub));
                    stepper.step::<AnyMotion>(state, &before, &arrival);
                }
                Some(stepper.response::<AnyMotion>(state, &aimed(stepper, &tick.after)))
            }
        }
    }

    /// Compares with the exact rod at that tick, `unseen` N m of whose ringing are lost.
    pub fn watch(
        &mut self,
        response: &Response<S::Scalar>,
        tip: [f32; 2],
        torque: f32,
        unseen: f64,
        length: f64,
    ) {
        let [x, y] = [0, 1].each(|i| f64::from(tip[i]) - response.tip[i].to_f64());
        let distance = sqrt(x * x + y * y) / length;
        let apart = (f64::from(torque) - response.torque.to_f64()).abs() + UNSEEN * unseen;
        // Not a number is no distance.
        let known = |x: f64| if x.is_finite() { x } else { f64::INFINITY };
        self.distance = self.distance.max(known(distance));
        let [certain, later] = self.pending;
        self.torque = self.torque.max(certain);
        self.pending = [later, known(apart)];
    }

    /// A jump less than one and a half ticks behind the older of the latest two ticks, or the end.
    pub fn forget(&mut self, both: bool) {
        let [before, last] = self.pending;
        // A number that is none is no matter of a jump.
        let kept = |x: f64| if x.is_finite() { 0.0 } else { x };
        self.pending = [if both { kept(before) } else { before }, kept(last)];
    }

    /// No jump follows any more.
    pub fn finish(&mut self) {
        let [before, last] = self.pending;
        self.torque = self.torque.max(before).max(last);
        self.pending = [0.0; 2];
    }
}

/// The hub as the stepper is given it: in its scalar, with sine and cosine of gravity's angle.
fn aimed<S: Stepper>(stepper: &S, hub: &HubState<f32>) -> HubState<S::Scalar> {
    stepper.gravity().aimed(&cast(hub))
}

fn cast<T: Scalar>(hub: &HubState<f32>) -> HubState<T> {
    let f = |x: f32| T::from_f64(f64::from(x));
    let angle = crate::hub::Angle { turns: hub.angle.turns, part: f(hub.angle.part) };
    HubState {
        angle,
        rate: f(hub.rate),
        acceleration: f(hub.acceleration),
        sin: f(hub.sin),
        cos: f(hub.cos),
    }
}
