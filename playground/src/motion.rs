//! The three motions of the page, each from 0 to the same angle in the same duration.

use core::fmt;

use stillbeam::hub::HubState;
use stillbeam::motion::{Limits, MoveSummary, Plan, Segment, Shaper};
use stillbeam::planner::{Planner, Request};
use stillbeam::{Error, Move, Profile};

use crate::arm::{Arm, TICK};

/// Shortest base motion of a shaped one, first periods: as in the tables of `stillbeam-sim plan`.
const LEAST_BASE: f64 = 0.25;

/// A motion of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A cubic.
    Cubic,
    /// A cubic behind an input shaper; both take the duration together.
    Shaped,
    /// A move after which the arm is at rest.
    Still,
}

/// Why there is no motion, or no run of it.
#[derive(Clone, Copy, Debug)]
pub enum Refusal {
    /// Nothing is set up.
    NotSetUp,
    /// The core refuses a number.
    Core(Error),
    /// The shaper takes more of the duration than there is.
    ShaperTooLong {
        /// Duration from which on it would do, s.
        least: f64,
    },
    /// The arm would bend further than the model of it goes.
    BendsTooFar {
        /// Angle of the tip against the hub to expect, rad.
        bend: f64,
        /// The largest that the model is for, rad.
        most: f64,
    },
    /// The run is longer than the page's memory.
    TooLong,
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self::Core(error)
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotSetUp => f.write_str("no arm is set up"),
            Self::Core(error) => write!(f, "{error}"),
            Self::ShaperTooLong { least } => write!(
                f,
                "move.duration: the shaper delays the motion; must be at least {least:.2} s with it"
            ),
            Self::BendsTooFar { bend, most } => write!(
                f,
                "the tip is expected to turn {bend:.2} rad against the hub, must be at most {most} \
                 rad; use a longer move or a stiffer link"
            ),
            Self::TooLong => f.write_str("move.duration: the run is longer than the page's memory"),
        }
    }
}

/// A motion and the rest after it, planned.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The move and the rest.
    pub moves: [Move; 2],
    /// Plans of both.
    plans: [Plan; 2],
    /// The shaper that both pass, if any.
    pub shaper: Option<Shaper>,
}

impl Kind {
    /// Number of motions.
    pub const COUNT: usize = 3;
    /// The motions, in the order of the page.
    pub const ALL: [Self; Self::COUNT] = [Self::Cubic, Self::Shaped, Self::Still];

    /// Plans the motion for an arm.
    pub fn plan(self, arm: &Arm) -> Result<Motion, Refusal> {
        let (to, duration) = (arm.input.to, arm.input.duration);
        let profile = Profile::Cubic;
        match self {
            Self::Cubic => Motion::new(arm, Move::To { profile, duration, to }, None),
            Self::Shaped => {
                let [frequency, damping] = arm.first_mode();
                let shaper = Shaper::new(arm.input.shaper()?, frequency, damping)?;
                let base = base(duration, &shaper);
                let least = LEAST_BASE * arm.first_period();
                if base < least {
                    // The base motion too takes whole ticks.
                    let least = shaper.delay() + libm::ceil(least / TICK) * TICK;
                    let least = libm::ceil(least / TICK - 1e-9) * TICK;
                    return Err(Refusal::ShaperTooLong { least });
                }
                Motion::new(arm, Move::To { profile, duration: base, to }, Some(shaper))
            }
            Self::Still => {
                let planner = match arm.input.robust {
                    0.0 => Planner::<f32, 2>::new(&arm.scene, TICK)?,
                    spread => Planner::robust(&arm.scene, TICK, spread)?,
                };
                let still = planner.plan(&Request::from_rest(0.0, to).duration(duration))?;
                Motion::new(arm, still.motion(), None)
            }
        }
    }
}

/// Returns the duration that a shaper leaves for the motion before it, s: whole ticks.
fn base(duration: f64, shaper: &Shaper) -> f64 {
    let ticks = libm::floor((duration - shaper.delay()) / TICK + 1e-9);
    // As the page writes it: a number of hundredths.
    ticks / 100.0
}

impl Motion {
    fn new(arm: &Arm, motion: Move, shaper: Option<Shaper>) -> Result<Self, Refusal> {
        let rest = Move::Dwell { duration: arm.rest };
        let plan = |motion, start| Plan::new(motion, start, &Limits::default(), TICK);
        let first = plan(&motion, HubState::resting_at(0.0)?)?;
        let second = plan(&rest, first.summary.end)?;
        Ok(Self { moves: [motion, rest], plans: [first, second], shaper })
    }

    /// Segments of the motion and its rest, before they pass a shaper.
    pub fn segments(&self) -> impl Iterator<Item = &Segment<f64>> {
        self.plans.iter().flat_map(|plan| &plan.segments)
    }

    /// Duration, end and peaks of the move itself.
    pub fn summary(&self) -> &MoveSummary {
        &self.plans[0].summary
    }

    /// Ticks that the shaper adds.
    pub fn added(&self) -> u32 {
        let delay = self.shaper.as_ref().map_or(0.0, Shaper::delay);
        libm::ceil(delay / TICK - 1e-9) as u32
    }

    /// Tick at which the motion arrives.
    pub fn arrival_tick(&self) -> u32 {
        self.summary().ticks + self.added()
    }

    /// Time at which the motion arrives, s.
    pub fn arrival(&self) -> f64 {
        f64::from(self.arrival_tick()) * TICK
    }
}
