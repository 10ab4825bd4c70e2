//! One still move of a given duration.

use core::f64::consts::TAU;

use super::effort::{Linear, MAX_AIMS, Manner};
use super::{Flex, MAX_ARMS, Path, Still, aiming, second};
use crate::Error;
use crate::hub::{Angle, HubState};
use crate::math::{Scalar, cast, dot, sqrt};
use crate::motion::{BULGE, Move, Peaks, Segment, curve_peaks};

/// Shortest move in first periods: below it the search converges to nothing real.
const SHORTEST: f64 = 0.9;

/// Amplitude that needs no further search, of L.
const ENOUGH: f64 = 1e-5;

/// Amplitude with which a plan is refused, of L.
const TOO_MUCH: f64 = 0.01;

/// Amplitude of the second mode that is looked after, of L, what has to be gained by it, and how
/// much more a move may peak for it.
const RINGS: f64 = 1e-3;
const GAIN: f64 = 0.85;
const PRICE: f64 = 1.5;

/// Most flights of an arm in a search, and in one of several arms.
const MOST: u32 = 12;
const MOST_OF_SEVERAL: u32 = 24;

/// Which modes are brought to rest in the exact kinematics.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Search {
    /// None: the linear move.
    None,
    /// The first.
    First,
    /// The second too, where it is left ringing by more than [`RINGS`].
    Second,
    /// The first, of the outer arms of a robust planner only.
    Outer,
}

/// A still move and what its planner expects of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StillMove {
    /// Where it begins.
    pub from: HubState<f64>,
    /// Where it ends, rad.
    pub to: f64,
    /// Whole ticks it takes.
    pub ticks: u32,
    /// h, s.
    pub tick: f64,
    /// The bulge, rad.
    pub bulge: [f64; BULGE],
    /// Greatest magnitudes of the motion, to 1e-4 of themselves. For information: a generator finds
    /// them anew from the curve before it takes the move.
    pub peaks: Peaks,
    /// Amplitude of the first two modes that is left by the planner's model, of L. A robust move leaves
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
        Move::Still { duration: self.duration(), to: self.to, bulge: self.bulge }
    }

    /// The curve.
    pub fn segment(&self) -> Segment<f64> {
        self.path().segment(&self.bulge)
    }

    /// Greatest magnitudes of the curve, in the tick's scalar: whatever [`Self::peaks`] says.
    pub(crate) fn curve_peaks<T: Scalar>(&self) -> Peaks {
        let path = self.path();
        curve_peaks::<T>(
            &cast(&path.quintic()),
            &self.bulge.map(|b| T::from_f64(b / TAU)),
            path.duration(),
        )
    }

    pub(super) fn path(&self) -> Path {
        Path { from: self.from, to: self.to, ticks: self.ticks, tick: self.tick }
    }
}

impl<T: Scalar, const K: usize> Still<T, K> {
    /// From rest at `from` rad to rest at `to` rad in `duration` s, rounded to whole ticks.
    pub fn plan(&self, from: f64, to: f64, duration: f64) -> Result<StillMove, Error> {
        self.plan_from(&HubState::at_rest(Angle::from_radians(from)), None, to, duration)
    }

    /// From wherever the hub is and however the arm bends and moves, at rest in equilibrium if not
    /// told, to rest at `to` rad in `duration` s, rounded to whole ticks.
    pub fn plan_from(
        &self,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        duration: f64,
    ) -> Result<StillMove, Error> {
        self.plan_in(Manner::Acceleration, from, flex, to, duration)
    }

    /// The move of [`Self::plan`] for an arm that bends by little: without a single correction.
    pub fn linear(&self, from: f64, to: f64, duration: f64) -> Result<StillMove, Error> {
        let from = HubState::at_rest(Angle::from_radians(from));
        let plan = self.search(Manner::Acceleration, &from, None, to, duration, Search::None)?;
        self.keeping_loads(plan, None)
    }

    /// [`Self::plan_from`], sparing something else than the acceleration.
    pub fn plan_in(
        &self,
        manner: Manner,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        duration: f64,
    ) -> Result<StillMove, Error> {
        let plan = self.search(manner, from, flex, to, duration, Search::Second)?;
        self.keeping_loads(plan, flex)
    }

    pub(super) fn search(
        &self,
        manner: Manner,
        from: &HubState<f64>,
        flex: Option<&Flex<T, K>>,
        to: f64,
        duration: f64,
        search: Search,
    ) -> Result<StillMove, Error> {
        let first = match search {
            Search::Second => Search::First,
            other => other,
        };
        let plan = match self.search_in(manner, from, flex, to, duration, first) {
            // Three arms that are nearly one, or a short time, ask for too much.
            Err(Error::NotStill { .. }) if self.robust && search != Search::None => {
                self.search_in(manner, from, flex, to, duration, Search::Outer)
            }
            found => found,
        }?;
        let alone = manner != Manner::Acceleration || self.robust;
        if search != Search::Second || alone || plan.residual < RINGS {
            return Ok(plan);
        }
        let mut flights = plan.flights;
        for manner in [Manner::Smooth, manner] {
            let found = self.search_in(manner, from, flex, to, duration, Search::Second);
            let Ok(other) = found else { continue };
            flights += other.flights;
            if other.residual < GAIN * plan.residual
                && other.peaks.acceleration < PRICE * plan.peaks.acceleration
            {
                return Ok(StillMove { flights, ..other });
            }
        }
        Ok(StillMove { flights, ..plan })
    }

    fn search_in(
        &self,
        manner: Manner,
        from: &HubState<f64>,
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
        let stride = self.stride(duration);
        let steps = ticks * stride.steps;
        let curve = stride.fine(&path).segment(&[0.0; BULGE]).cast::<T>();
        let arms = self.arms(stride);
        let sought = if search == Search::Outer { 1..arms.len() } else { 0..arms.len() };
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
        let mut ringing = [T::ZERO; 2];
        for (n, arm) in arms.iter().enumerate() {
            let still = begin[n];
            if let Some(flex) = flex {
                begin[n] = *flex;
            }
            if !sought.contains(&n) {
                continue;
            }
            linear.add(
                &arm.oscillation[0],
                &c,
                arm.amplitudes(0, &begin[n], &still),
                duration,
                half,
            );
            if n == 0 && K > 1 {
                ringing = arm.amplitudes(1, &begin[n], &still);
            }
        }
        let each = if half { 1 } else { 2 };
        let tolerated = if sought.len() == MAX_ARMS {
            linear.tolerate(each, &c, manner, duration)
        } else {
            [T::ZERO; 2]
        };
        let effort = linear.least_effort(&c, manner);
        let flown = if half { steps / 2 } else { steps };
        let aimed = if half { [Flex::STRAIGHT; MAX_ARMS] } else { rest };
        let most = match search {
            Search::None => 1,
            _ if sought.len() == 1 => MOST,
            _ => MOST_OF_SEVERAL,
        };
        let fly = |n: usize, bulge: &[T; BULGE]| {
            let curve = curve.bulged(bulge);
            arms[n].fly(&self.chain, stride.per_step, &curve, flown, &begin[n], |_, _| ())
        };
        // Of the scene's own arm, of the flight that came nearest.
        let (mut least, mut second) = (T::from_f64(f64::INFINITY), [T::ZERO; 2]);
        let found = aiming::find(linear.aims, T::from_f64(ENOUGH * ENOUGH), most, |aim| {
            let bulge = effort.bulge(aim);
            let mut miss = [T::ZERO; MAX_AIMS];
            let mut rung = [T::ZERO; 2];
            for (row, n) in sought.clone().enumerate() {
                let end = fly(n, &bulge);
                let left = arms[n].amplitudes(0, &end, &aimed[n]);
                miss[each * row..each * (row + 1)].copy_from_slice(&left[..each]);
                if n == 0 && K > 1 {
                    rung[..each].copy_from_slice(&arms[n].amplitudes(1, &end, &aimed[n])[..each]);
                }
            }
            for i in 0..each {
                miss[i] -= tolerated[i];
            }
            let size = dot(&miss, &miss);
            if size < least {
                (least, second) = (size, rung);
            }
            miss
        });
        // The middle of an odd move misses by half of what its end does.
        let whole = if half { 2.0 } else { 1.0 };
        let amplitude = |of: &[T]| -> f64 {
            whole * sqrt(of.iter().fold(T::ZERO, |sum, &x| sum + x * x).to_f64())
        };
        let missed = amplitude(&found.miss);
        if search != Search::None && (missed.is_nan() || missed > TOO_MUCH) {
            return Err(Error::NotStill { duration, residual: missed });
        }
        let mut d = effort.bulge(&found.aim);
        let mut greatest = curve_peaks(&c, &d, duration);
        let mut flights = found.evaluations;
        let mut rings = amplitude(&second);
        let mut residual = missed + amplitude(&tolerated);
        if search == Search::Outer {
            let end = fly(0, &d);
            flights += 1;
            residual = amplitude(&arms[0].amplitudes(0, &end, &aimed[0])[..each]);
            if K > 1 {
                rings = amplitude(&arms[0].amplitudes(1, &end, &aimed[0])[..each]);
            }
        }
        if search == Search::Second && arms.len() == 1 && rings > RINGS {
            let arm = &arms[0];
            let mut other = Linear::new();
            other.add(&arm.oscillation[1], &c, ringing, duration, half);
            let mut along = [[T::ZERO; BULGE]; second::MISSES];
            along[..each].copy_from_slice(&effort.towards[..each]);
            along[each..2 * each].copy_from_slice(&effort.aside(&linear, &other)[..each]);
            let mut miss = [T::ZERO; second::MISSES];
            miss[..each].copy_from_slice(&found.miss[..each]);
            miss[each..2 * each].copy_from_slice(&second[..each]);
            let quiet = second::find(d, miss, &along, 2 * each, |bulge| {
                let end = fly(0, bulge);
                let mut miss = [T::ZERO; second::MISSES];
                for k in 0..2 {
                    let left = arm.amplitudes(k, &end, &aimed[0]);
                    miss[each * k..each * (k + 1)].copy_from_slice(&left[..each]);
                }
                miss
            });
            let after = curve_peaks(&c, &quiet.bulge, duration);
            flights += quiet.flights;
            (d, greatest) = (quiet.bulge, after);
            residual = amplitude(&quiet.miss[..each]);
            rings = amplitude(&quiet.miss[each..2 * each]);
        }
        Ok(StillMove {
            from: *from,
            to,
            ticks,
            tick: self.tick,
            bulge: d.map(|x| TAU * x.to_f64()),
            peaks: greatest,
            residual: residual + rings,
            flights,
        })
    }
}
