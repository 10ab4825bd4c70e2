//! The search for the duration and the targets with which the exact arm arrives at rest.

use super::case::{Case, Least, Trial};
use super::flight::{View, fly};
use super::grid::{RATE, zero};
use super::half::Half;
use super::program::AIMS;
use crate::math::{Each, Scalar, sqrt};
use crate::planner::LONG;
use crate::planner::linear::MAX_AMPLITUDES;
use crate::planner::solve;
use crate::stepper::ArmState;

/// Shortest move, first periods.
pub(super) const SHORTEST: f64 = 0.9;

/// Most rounds of a search for the duration, and of one for the scale of the limits.
const MAX_ROUNDS: u32 = 10;

/// Tolerances: the turn, of itself; the first mode, of L; the torque, of its limit; the
/// second mode, of L.
pub(super) const TURN: f64 = 5e-4;
const FIRST: f64 = 3e-5;
const TORQUE: f64 = 4e-3;
const SECOND: f64 = 1.5e-4;
/// Tolerance of the amplitudes in their windows, of these.
const WIDER: f64 = 0.01;

/// Part of the turn by which a program is to reach beyond it. Scaled back to the turn, the knots
/// are then within the limits.
pub(super) const BEYOND: f64 = 2e-4;

/// Longest changes in a round: of the logarithm of duration or scale, and of a target, of L.
const STEP: f64 = 0.2;
const TARGET_STEP: f64 = 0.15;

/// Number that the search changes to make the turn right.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Free {
    /// Duration of the move.
    Duration,
    /// Factor of every limit, the duration being whole ticks, or of the acceleration's alone.
    Scale,
    /// Nothing: the program asks for the turn.
    Nothing,
}

/// A trial carried out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outcome<T, const N: usize> {
    /// The trial, with what was learnt from it.
    pub trial: Trial<T, N>,
    /// θ̈ at the knots, rad/s².
    pub half: Half<T, N>,
    /// Turn, in parts of the turn asked for.
    pub reach: f64,
    /// Amplitudes where the half ends, of L.
    pub miss: [T; AIMS],
    /// Greatest part of the torque's limit by which that is exceeded.
    pub excess: f64,
    /// Largest amplitude in its window, of that, less 1; −1 without windows.
    pub wider: f64,
    /// Bound of the residual of all arms with a window, of L.
    pub residual: f64,
    /// Greatest torque, N m; 0 without a limit of it.
    pub torque: f64,
}

/// A search under way.
pub(super) struct Search<'a, T, const K: usize, const N: usize> {
    pub case: Case<'a, T, K>,
    pub trial: Trial<T, N>,
    /// Inverse slopes of turn and first mode by duration or scale and targets.
    inverse: [[T; MAX_AMPLITUDES]; MAX_AMPLITUDES],
    free: Free,
    /// Gap to the optimum of each program, of the turn.
    gap: f64,
    pub simulations: u32,
}

impl<'a, T: Scalar, const K: usize, const N: usize> Search<'a, T, K, N> {
    /// Begins from the rigid arm's duration, corrected by two programs without a simulation.
    pub fn new(case: Case<'a, T, K>) -> Self {
        let longer = if case.least.is_some() { 0.0 } else { 0.25 * case.period };
        let trial = Trial {
            duration: (case.rigid + longer).max(SHORTEST * case.period),
            scale: 1.0,
            targets: [T::ZERO; AIMS],
            offsets: zero(),
        };
        let gap = if T::EPSILON.to_f64() < 1e-12 { 1e-5 } else { 1e-3 };
        let mut inverse = [[T::ZERO; MAX_AMPLITUDES]; MAX_AMPLITUDES];
        for (i, row) in inverse.iter_mut().enumerate() {
            row[i] = T::ONE;
        }
        inverse[0][0] = T::from_f64(1.0 / case.power());
        let free = match case.least {
            None => Free::Duration,
            Some(Least::Acceleration) => Free::Scale,
            Some(Least::Effort) => Free::Nothing,
        };
        if free == Free::Scale {
            inverse[0][0] = T::ONE;
        }
        let mut search = Self { case, trial, inverse, free, gap, simulations: 0 };
        for _ in 0..2 {
            if free == Free::Nothing {
                break;
            }
            let reach = case.program(&search.trial, gap).solve().reach.to_f64();
            if free == Free::Scale {
                search.trial.scale /= reach.clamp(0.2, 5.0);
                continue;
            }
            let longer = (-libm::log(reach.max(1e-3)) / case.power()).clamp(-0.5, 0.5);
            search.lengthen(longer);
        }
        search
    }

    fn lengthen(&mut self, by: f64) {
        let shortest = SHORTEST * self.case.period;
        self.trial.duration = (self.trial.duration * libm::exp(by)).max(shortest);
    }

    /// Fixes the duration, s, from now on; the scale of the limits makes the turn right.
    pub fn fix(&mut self, duration: f64) {
        let power = self.case.power();
        if self.free == Free::Duration {
            for slope in &mut self.inverse[0] {
                *slope = T::from_f64(power) * *slope;
            }
            self.free = Free::Scale;
        }
        let ratio = self.trial.duration / duration;
        self.trial.scale *= libm::pow(ratio, power);
        self.trial.duration = duration;
    }

    /// Searches until all is close enough, and returns the best that was found.
    pub fn run(&mut self) -> Outcome<T, N> {
        let each = self.case.sought();
        let mut best = self.attempt();
        let mut last = best;
        let mut second = f64::INFINITY;
        for _ in 1..MAX_ROUNDS {
            let ringing = self.amplitude(&last, 1);
            if self.distance(&last) <= 1.0 && (ringing < SECOND || ringing > 0.7 * second) {
                return last;
            }
            second = ringing;
            let step = self.advance(&last);
            let next = self.attempt();
            let mut change = [T::ZERO; MAX_AMPLITUDES];
            change[0] = T::from_f64(libm::log(next.reach / last.reach));
            for i in 0..each {
                change[1 + i] = next.miss[i] - last.miss[i];
            }
            solve::update(&mut self.inverse, 1 + each, &step, &change);
            if self.distance(&next) <= self.distance(&best) {
                best = next;
            }
            last = next;
        }
        self.trial = best.trial;
        best
    }

    /// Distance from what is close enough, 1 where it is reached; the second mode left out.
    pub fn distance(&self, outcome: &Outcome<T, N>) -> f64 {
        let turn = (libm::log(outcome.reach) - BEYOND).abs();
        let turn = if self.free == Free::Duration { turn / TURN } else { turn / (0.75 * BEYOND) };
        let clamped = self.free == Free::Duration
            && outcome.trial.duration <= SHORTEST * self.case.period
            && outcome.reach > 1.0;
        let turn = if clamped { 0.0 } else { turn };
        let first = if self.case.windows.is_some() {
            outcome.wider / WIDER
        } else {
            self.amplitude(outcome, 0) / FIRST
        };
        let all = turn.max(first).max(outcome.excess / TORQUE);
        if all.is_nan() { f64::INFINITY } else { all }
    }

    /// Amplitude of a mode where the half ends, of L.
    pub fn amplitude(&self, outcome: &Outcome<T, N>, mode: usize) -> f64 {
        let each = self.case.each();
        if mode >= self.case.modes() {
            return 0.0;
        }
        let of = &outcome.miss[each * mode..each * (mode + 1)];
        sqrt(of.iter().fold(0.0, |sum, x| sum + x.to_f64() * x.to_f64()))
    }

    /// Takes the step to the next trial and returns it.
    fn advance(&mut self, from: &Outcome<T, N>) -> [T; MAX_AMPLITUDES] {
        let (each, sought) = (self.case.each(), self.case.sought());
        let mut left = [T::ZERO; MAX_AMPLITUDES];
        if self.free != Free::Nothing {
            left[0] = T::from_f64(libm::log(from.reach) - BEYOND);
        }
        left[1..=sought].copy_from_slice(&from.miss[..sought]);
        let mut step = [T::ZERO; MAX_AMPLITUDES];
        for i in 0..=sought {
            let mut sum = T::ZERO;
            for j in 0..=sought {
                sum += self.inverse[i][j] * left[j];
            }
            step[i] = crate::math::clip(-sum, T::from_f64(if i == 0 { STEP } else { TARGET_STEP }));
        }
        match self.free {
            Free::Duration => {
                let before = self.trial.duration;
                self.lengthen(step[0].to_f64());
                step[0] = T::from_f64(libm::log(self.trial.duration / before));
            }
            Free::Scale => self.trial.scale *= libm::exp(step[0].to_f64()),
            Free::Nothing => step[0] = T::ZERO,
        }
        for i in 0..sought {
            self.trial.targets[i] += step[1 + i];
        }
        for i in each..each * self.case.modes() {
            self.trial.targets[i] -= from.miss[i];
        }
        step
    }

    /// Solves the program of the trial, simulates the arm along its knots and learns from it what
    /// the linear rows lack.
    #[inline(never)]
    fn attempt(&mut self) -> Outcome<T, N> {
        let (case, trial) = (&self.case, &mut self.trial);
        let program = case.program(trial, self.gap);
        let found = program.solve();
        let unit = T::from_f64(case.unit(trial));
        let interval = T::from_f64(case.interval(trial));
        let half = Half::new(found.knots.each(|y| unit * y), interval);
        let limit = case.torque(trial);
        let long = trial.duration >= LONG * case.period;
        let view = View { long, loaded: limit.is_some() };
        let landing = fly(case.arm, case.points, &half, view);
        self.simulations += 1;
        let mut excess = 0.0_f64;
        if let Some(limit) = limit {
            let greatest = |most: T, torque: &T| {
                let torque = torque.abs();
                if torque > most { torque } else { most }
            };
            let most = landing.torque.iter().flatten().fold(T::ZERO, greatest);
            if case.limits.torque.is_some() {
                excess = (most / limit).to_f64() - 1.0;
            }
            let linear = program.values(&found.knots);
            trial.learn_torque(&landing.torque, &linear, limit);
        }
        if let Some(rate) = case.limits.rate {
            let per = T::from_f64(1.0 / (rate * case.scale(trial)));
            let beyond = half.beyond_nodes();
            for side in 0..2 {
                trial.offsets[RATE + side] = beyond[side].map(|rate| per * rate);
            }
        }
        let (mut wider, mut residual) = (-1.0, 0.0);
        if let Some(windows) = &case.windows {
            let view = View { long, loaded: false };
            let seen = case.look::<N>(windows, |arm| fly(arm, case.points, &half, view).arm);
            self.simulations += windows.factors().len() as u32;
            for amplitude in seen.amplitudes {
                wider = f64::max(wider, amplitude.to_f64().abs() - 1.0);
            }
            residual = seen.residual;
            trial.learn_windows(&seen, &program.values(&found.knots));
        }
        Outcome {
            trial: *trial,
            half,
            wider,
            residual,
            reach: found.reach.to_f64(),
            miss: self.left(&landing.arm),
            excess,
            torque: landing.most.to_f64(),
        }
    }

    /// Amplitudes that the modes have where the half ends, in the order of the program's aims.
    fn left(&self, end: &ArmState<T, K>) -> [T; AIMS] {
        let each = self.case.each();
        let mut miss = [T::ZERO; AIMS];
        for k in 0..self.case.modes() {
            let amplitudes = self.case.arm.amplitudes(k, end, &ArmState::STRAIGHT);
            miss[each * k..each * (k + 1)].copy_from_slice(&amplitudes[..each]);
        }
        miss
    }
}
