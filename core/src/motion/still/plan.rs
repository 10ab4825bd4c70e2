//! One still move of a given duration.

use core::f64::consts::TAU;

use super::effort::{Linear, MAX_AIMS, Manner};
use super::{Departure, Flex, MAX_ARMS, Path, Still, aiming, peaks};
use crate::Error;
use crate::math::{Scalar, cast, dot, sqrt};
use crate::motion::{Angle, BULGE, Move, Peaks, Segment};

/// Shortest move in first periods: below it the search converges to nothing real.
const SHORTEST: f64 = 0.9;

/// Amplitude that needs no further search, of L.
const ENOUGH: f64 = 1e-5;

/// Amplitude with which a plan is refused, of L.
const TOO_MUCH: f64 = 0.01;

/// Most flights of an arm in a search, and in one of several arms.
const MOST: u32 = 12;
const MOST_OF_SEVERAL: u32 = 24;

/// Whether what the linear move misses is looked after.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Search {
    None,
    Bounded,
}

/// A still move and what its planner expects of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StillMove {
    /// Where it begins.
    pub from: Departure,
    /// Where it ends, rad.
    pub to: f64,
    /// Whole ticks it takes.
    pub ticks: u32,
    /// h, s.
    pub tick: f64,
    /// The bulge, rad.
    pub bulge: [f64; BULGE],
    /// Greatest magnitudes of the motion, to 1e-4 of themselves.
    pub peaks: Peaks,
    /// Amplitude of the first mode that is left by the planner's model, of L. A robust move leaves
    /// some where the frequency is right, so as to leave less where it is not.
    pub residual: f64,
    /// Flights of each arm that it took to find.
    pub flights: u32,
}

impl StillMove {
    /// T, s.
    pub fn duration(&self) -> f64 {
        self.path().duration()
    }

    /// To be pushed behind moves that end where it begins, at rest.
    pub fn motion(&self) -> Move {
        let Self { to, bulge, peaks, .. } = *self;
        Move::Still { duration: self.duration(), to, bulge, peaks }
    }

    /// The curve.
    pub fn segment(&self) -> Segment<f64> {
        self.path().segment(&self.bulge)
    }

    pub(super) fn path(&self) -> Path {
        Path { from: self.from, to: self.to, ticks: self.ticks, tick: self.tick }
    }
}

impl<T: Scalar, const K: usize> Still<T, K> {
    /// From rest at `from` rad to rest at `to` rad in `duration` s, rounded to whole ticks.
    pub fn plan(&self, from: f64, to: f64, duration: f64) -> Result<StillMove, Error> {
        self.plan_from(&Departure::at_rest(Angle::from_radians(from)), None, to, duration)
    }

    /// From wherever the hub is and however the arm bends and moves, at rest in equilibrium if not
    /// told, to rest at `to` rad in `duration` s, rounded to whole ticks.
    pub fn plan_from(
        &self,
        from: &Departure,
        flex: Option<&Flex<T, K>>,
        to: f64,
        duration: f64,
    ) -> Result<StillMove, Error> {
        self.plan_in(Manner::Acceleration, from, flex, to, duration)
    }

    /// The move of [`Self::plan`] for an arm that bends by little: without a single correction.
    pub fn linear(&self, from: f64, to: f64, duration: f64) -> Result<StillMove, Error> {
        let from = Departure::at_rest(Angle::from_radians(from));
        self.search(Manner::Acceleration, &from, None, to, duration, Search::None)
    }

    /// [`Self::plan_from`], sparing something else than the acceleration.
    pub fn plan_in(
        &self,
        manner: Manner,
        from: &Departure,
        flex: Option<&Flex<T, K>>,
        to: f64,
        duration: f64,
    ) -> Result<StillMove, Error> {
        self.search(manner, from, flex, to, duration, Search::Bounded)
    }

    fn search(
        &self,
        manner: Manner,
        from: &Departure,
        flex: Option<&Flex<T, K>>,
        to: f64,
        duration: f64,
        search: Search,
    ) -> Result<StillMove, Error> {
        let to = Error::check("move.to", to, -1e6, 1e6, "rad")?;
        let ticks = Move::Dwell { duration }.ticks(self.tick)?;
        let path = Path { from: *from, to, ticks, tick: self.tick };
        let duration = path.duration();
        let shortest = SHORTEST * self.first_period();
        if duration < shortest {
            return Err(Error::TooShort { duration, shortest });
        }
        let c: [T; 5] = cast(&path.quintic());
        let steps = ticks * self.steps;
        let curve = self.fine(&path).segment(&[0.0; BULGE]).cast::<T>();
        let arms = self.arms();
        let (mut begin, mut rest) = ([Flex::STRAIGHT; MAX_ARMS], [Flex::STRAIGHT; MAX_ARMS]);
        for (n, arm) in arms.iter().enumerate() {
            if self.scene.gravity != 0.0 {
                begin[n] = arm.rest(&self.chain, &curve.hub(0));
                rest[n] = arm.rest(&self.chain, &curve.hub(steps));
            }
        }
        // Odd about the middle and reversible in time: at rest at the end if straight in the middle.
        let resting = from.rate == 0.0 && from.acceleration == 0.0 && flex.is_none();
        let half = resting && steps.is_multiple_of(2) && self.is_reversible();
        let mut linear = Linear::new();
        for (n, arm) in arms.iter().enumerate() {
            let still = begin[n];
            if let Some(flex) = flex {
                begin[n] = *flex;
            }
            let ringing = arm.amplitudes(&begin[n], &still);
            linear.add(&arm.oscillation, &c, ringing, duration, half);
        }
        let each = if half { 1 } else { 2 };
        let tolerated = if arms.len() == MAX_ARMS {
            linear.tolerate(each, &c, manner, duration)
        } else {
            [T::ZERO; 2]
        };
        let effort = linear.least_effort(&c, manner);
        let flown = if half { steps / 2 } else { steps };
        let aimed = if half { [Flex::STRAIGHT; MAX_ARMS] } else { rest };
        let most = match search {
            Search::None => 1,
            Search::Bounded if arms.len() == 1 => MOST,
            Search::Bounded => MOST_OF_SEVERAL,
        };
        let found = aiming::find(linear.aims, T::from_f64(ENOUGH * ENOUGH), most, |aim| {
            let curve = curve.bulged(&effort.bulge(aim));
            let mut miss = [T::ZERO; MAX_AIMS];
            for (n, arm) in arms.iter().enumerate() {
                let end = arm.fly(&self.chain, &self.pace, &curve, flown, &begin[n], |_, _| ());
                let left = arm.amplitudes(&end, &aimed[n]);
                miss[each * n..each * (n + 1)].copy_from_slice(&left[..each]);
            }
            for i in 0..each {
                miss[i] -= tolerated[i];
            }
            miss
        });
        // The middle of an odd move misses by half of what its end does.
        let whole = if half { 2.0 } else { 1.0 };
        let missed = whole * sqrt(found.miss.to_f64());
        if search == Search::Bounded && (missed.is_nan() || missed > TOO_MUCH) {
            return Err(Error::NotStill { duration, residual: missed });
        }
        let residual = missed + whole * sqrt(dot(&tolerated, &tolerated).to_f64());
        let d = effort.bulge(&found.aim);
        Ok(StillMove {
            from: *from,
            to,
            ticks,
            tick: self.tick,
            bulge: d.map(|x| TAU * x.to_f64()),
            peaks: peaks(&c, &d, duration),
            residual,
            flights: found.evaluations,
        })
    }

    /// The path in the steps of a flight.
    pub(super) fn fine(&self, path: &Path) -> Path {
        let steps = self.steps;
        Path { ticks: path.ticks * steps, tick: self.tick / f64::from(steps), ..*path }
    }
}
