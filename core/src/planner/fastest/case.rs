//! One search: the arm, the turn and the limits, and the program of a trial of it.

use super::grid::{Grid, Nodes, TORQUE};
use super::program::{AIMS, Program};
use super::response::{Mode, Response};
use super::rigid::{Rigid, rigid};
use super::rows::{Bounds, Rows};
use super::search::BEYOND;
use super::window::Windows;
use crate::hub::HubState;
use crate::math::{Each, Scalar, array};
use crate::model::RodPoints;
use crate::motion::Limits;
use crate::planner::simulate::Arm;
use crate::stepper::ArmState;

/// Modes that are brought to rest.
pub(super) const MODES: usize = 2;

/// Weight κ of a missed target, of the first mode and of the second. The second mode's is less: as
/// a condition that must hold it would need several times the duration where an interval is close
/// to its period.
const WEIGHTS: [f64; MODES] = [3e5, 3e4];

/// Weight ρ of the roughness. Without it many sets of knots are as good as the best, and the
/// duration wanders between them.
const ROUGHNESS: f64 = 1e-3;

/// The arm, the turn and the limits of a search.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case<'a, T, const K: usize> {
    pub arm: &'a Arm<T, K>,
    pub points: &'a RodPoints<T, K>,
    /// Turn, rad, positive.
    pub angle: f64,
    /// Limits, tightened where a plan has exceeded them.
    pub limits: Limits,
    /// 2π/ω₁, s.
    pub period: f64,
    /// Duration of the ramp, s, if the hub cruises between two of them.
    pub cruise: Option<f64>,
    /// Duration of the rigid arm, s.
    pub rigid: f64,
    /// L, m.
    pub length: f64,
    /// Residual that may be left; `None`: none.
    pub windows: Option<Windows>,
    /// True if the acceleration begins and ends at zero.
    pub smooth: bool,
    /// Quantity to be least where the duration is given.
    pub least: Option<Least>,
    /// Torque by an acceleration of 1 rad/s² on the arm at rest, `J − Σb²`, kg m².
    bare: T,
    /// The same of the arm as a rigid body, J, kg m².
    inertia: f64,
}

/// Quantity that a move of a given duration keeps least.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Least {
    /// Peak of the acceleration.
    Acceleration,
    /// Integral of the squared torque.
    Effort,
}

/// A trial of a search: what the program is made for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trial<T, const N: usize> {
    /// Duration of the move, s.
    pub duration: f64,
    /// Factor of every limit.
    pub scale: f64,
    /// Amplitudes that the linear arm is to have where the half ends, of L.
    pub targets: [T; AIMS],
    /// Excess of the exact rows over the linear ones, of the limit.
    pub offsets: Grid<T, N>,
}

impl<'a, T: Scalar, const K: usize> Case<'a, T, K> {
    /// States the search; `None` if nothing limits the hub.
    pub fn new(
        arm: &'a Arm<T, K>,
        points: &'a RodPoints<T, K>,
        [angle, length]: [f64; 2],
        limits: &Limits,
    ) -> Option<Self> {
        let hub = HubState { acceleration: T::ONE, ..HubState::ZERO };
        let bare = arm.load(points, &ArmState::STRAIGHT, &hub).torque;
        let mut inertia = bare.to_f64();
        for k in 0..K {
            let b = arm.mode(k)[1].to_f64();
            inertia += b * b;
        }
        let Rigid { duration, ramp } = rigid(angle, limits, inertia)?;
        let period = arm.first_period();
        let ramp = ramp + 0.5 * period;
        // With little time between them, two ramps are better as one curve.
        let cruise = (0.5 * (duration + 0.25 * period) > ramp).then_some(ramp);
        let (smooth, limits) = (limits.jerk.is_some(), *limits);
        let (windows, least) = (None, None);
        Some(Self {
            arm,
            points,
            angle,
            limits,
            period,
            cruise,
            rigid: duration,
            length,
            smooth,
            windows,
            least,
            bare,
            inertia,
        })
    }

    /// The same move in `duration` s, with something kept least.
    pub fn lasting(mut self, duration: f64, least: Least) -> Self {
        (self.rigid, self.cruise, self.least) = (duration, None, Some(least));
        if least == Least::Acceleration {
            self.limits.acceleration = Some(self.natural(duration));
        }
        self
    }

    /// Acceleration of twice a rigid arm's least, rad/s², in a move of `duration` s.
    fn natural(&self, duration: f64) -> f64 {
        8.0 * self.angle / (duration * duration)
    }

    /// Number of modes that are brought to rest.
    pub fn modes(&self) -> usize {
        K.min(MODES)
    }

    /// Amplitudes of each mode that the half has to leave at zero: with the mirrored half behind it
    /// the deflection alone; before a cruise, its rate too.
    pub fn each(&self) -> usize {
        if self.cruise.is_some() { 2 } else { 1 }
    }

    /// Amplitudes of the first mode that a search has to bring to rest; none that have windows.
    pub fn sought(&self) -> usize {
        if self.windows.is_some() { 0 } else { self.each() }
    }

    /// Duration of an interval of a trial, s.
    pub fn interval<const N: usize>(&self, trial: &Trial<T, N>) -> f64 {
        let half = 0.5 * trial.duration;
        self.cruise.map_or(half, |ramp| ramp.min(half)) / N as f64
    }

    /// Acceleration in units of which the knots are sought, rad/s².
    pub fn unit<const N: usize>(&self, trial: &Trial<T, N>) -> f64 {
        let natural = match (self.cruise, self.limits.rate) {
            (Some(ramp), Some(rate)) => 2.0 * rate / ramp,
            _ => self.natural(trial.duration),
        };
        self.limits.acceleration.unwrap_or(natural)
    }

    /// Exponent of the duration in the turn: twice the time, 2ᵖ times the way.
    pub fn power(&self) -> f64 {
        if self.cruise.is_some() { 1.0 } else { 2.0 }
    }

    /// The program of a trial, whose optimum is found to `gap` of the turn.
    #[inline(never)]
    pub fn program<const N: usize>(&self, trial: &Trial<T, N>, gap: f64) -> Program<T, N> {
        let (interval, unit) = (self.interval(trial), self.unit(trial));
        let responses: [Option<Response<T, N>>; MODES] = core::array::from_fn(|k| {
            (k < K).then(|| {
                let [frequency, coupling] = self.arm.mode(k);
                Response::new(&Mode { frequency, coupling }, interval)
            })
        });
        let mut aims = [[T::ZERO; N]; AIMS];
        let mut weights = [T::ONE; AIMS];
        let each = self.each();
        for (k, response) in responses.iter().flatten().enumerate() {
            let tip = self.arm.tip_per_mode(k) * T::from_f64(unit);
            if k == 0 && self.windows.is_some() {
                continue;
            }
            aims[each * k] = response.deflections().each(|a| tip * a);
            if each == 2 {
                aims[2 * k + 1] = response.rates().each(|v| tip * v);
            }
            for i in 0..each {
                weights[each * k + i] = T::from_f64(WEIGHTS[k]);
            }
        }
        Program {
            gain: self.gain(trial),
            aims,
            targets: trial.targets,
            weights,
            count: each * self.modes(),
            roughness: T::from_f64(ROUGHNESS * (1.5 * self.period / trial.duration).min(1.0)),
            smooth: self.smooth,
            rows: self.rows(trial, &responses),
            offsets: trial.offsets,
            turn: T::from_f64(1.0 + BEYOND),
            effort: if self.least == Some(Least::Effort) {
                T::ONE / T::from_u32(N as u32)
            } else {
                T::ZERO
            },
            gap: T::from_f64(gap),
        }
    }

    /// Turn by each knot, of the turn asked for: twice its area times its lever to the middle.
    fn gain<const N: usize>(&self, trial: &Trial<T, N>) -> [T; N] {
        let (interval, unit) = (self.interval(trial), self.unit(trial));
        let area = 2.0 * unit * interval / self.angle;
        array(|k| {
            let (area, at) = if k == 0 { (0.5 * area, 1.0 / 3.0) } else { (area, k as f64) };
            T::from_f64(area * (0.5 * trial.duration - at * interval))
        })
    }

    fn rows<const N: usize>(
        &self,
        trial: &Trial<T, N>,
        responses: &[Option<Response<T, N>>; MODES],
    ) -> Rows<T, N> {
        let (interval, unit) = (self.interval(trial), self.unit(trial));
        let limit = |limit: Option<f64>, per: f64| limit.map(|x| T::from_f64(x / per));
        let scale = self.scale(trial);
        let bounds = Bounds {
            acceleration: limit(self.limits.acceleration, unit / trial.scale),
            jerk: limit(self.limits.jerk, unit / (interval * scale)),
            rate: limit(self.limits.rate, unit * interval / scale),
            torque: limit(self.limits.torque, unit / scale),
            effort: limit(self.effort_unit(trial), unit),
        };
        let (mut hat, mut half): (Nodes<T, N>, Nodes<T, N>) =
            ([[T::ZERO; N]; 2], [[T::ZERO; N]; 2]);
        // The hat itself: ½, 1, ½, 0.
        let middle = T::HALF * self.bare;
        (hat[0][0], hat[1][0], half[0][0]) = (middle, self.bare, middle);
        if N > 1 {
            hat[0][1] = middle;
        }
        for (k, response) in responses.iter().flatten().enumerate() {
            let [omega, b] = self.arm.mode(k);
            let per_a = b * omega * omega;
            for side in 0..2 {
                for i in 0..N {
                    hat[side][i] -= per_a * response.hat[side][i];
                    half[side][i] -= per_a * response.half[side][i];
                }
            }
        }
        let rows = Rows::new(&bounds, hat, half);
        match &self.windows {
            Some(windows) => rows.within(&self.window_rows(windows, trial)),
            None => rows,
        }
    }

    /// Factor of the limits but the acceleration's. In a given duration the others stay.
    pub fn scale<const N: usize>(&self, trial: &Trial<T, N>) -> f64 {
        if self.least.is_some() { 1.0 } else { trial.scale }
    }

    /// Torque in parts of which an effort is counted, N m.
    fn effort_unit<const N: usize>(&self, trial: &Trial<T, N>) -> Option<f64> {
        let counts = self.least == Some(Least::Effort);
        counts.then(|| self.inertia * self.natural(trial.duration))
    }

    /// The unit of the torque's rows, N m: its limit, or that of the effort.
    pub fn torque<const N: usize>(&self, trial: &Trial<T, N>) -> Option<T> {
        let limit = self.limits.torque.map(|torque| torque * self.scale(trial));
        limit.or_else(|| self.effort_unit(trial)).map(T::from_f64)
    }
}

impl<T: Scalar, const N: usize> Trial<T, N> {
    /// Moves the torque's offsets most of the way to what a simulation says: `exact` and `linear`
    /// at the nodes, of the limit.
    pub fn learn_torque(&mut self, exact: &Nodes<T, N>, linear: &Grid<T, N>, limit: T) {
        let share = T::from_f64(0.7);
        for side in 0..2 {
            for i in 0..N {
                let offset = &mut self.offsets[TORQUE + side][i];
                let found = exact[side][i] / limit - (linear[TORQUE + side][i] - *offset);
                *offset += share * (found - *offset);
            }
        }
    }
}
