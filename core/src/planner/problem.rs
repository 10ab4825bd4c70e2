//! One search for a bulge: the linear model first, then corrections by simulation.

use core::f64::consts::TAU;
use core::ops::Range;

use super::least_effort::LeastEffort;
use super::linear::{Linear, MAX_AMPLITUDES};
use super::simulate::{Arm, Resolution};
use super::{ArmState, MAX_ARMS, Objective, Path, Planner, Request, StillMove, second_mode, solve};
use crate::Error;
use crate::hub::HubState;
use crate::math::{Scalar, array, cast, dot, sqrt};
use crate::motion::{BULGE, Segment, curve_peaks};

/// Shortest move in first periods. Below it the search does not converge.
const SHORTEST: f64 = 0.9;

/// Amplitude that needs no further search, of L.
const ENOUGH: f64 = 1e-5;

/// Amplitude with which a plan is refused, of L.
const TOO_MUCH: f64 = 0.01;

/// Amplitude of the second mode from which on it is brought to rest too, of L.
pub(super) const RINGS: f64 = 1e-3;

/// Most simulations of one arm in a search, and of each of several arms.
const MAX_SIMULATIONS: u32 = 12;
const MAX_SIMULATIONS_OF_SEVERAL: u32 = 24;

/// The modes that are brought to rest in the exact kinematics.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Scope {
    /// None: the move of the linear model.
    Linear,
    /// The first mode.
    First,
    /// The second mode too, where it is left ringing by more than [`RINGS`].
    Second,
    /// The first mode, of the outer arms of a robust planner only.
    Outer,
}

/// A search for the bulge of one path: everything that does not change while it runs.
pub(super) struct Problem<'a, T, const K: usize> {
    planner: &'a Planner<T, K>,
    resolution: &'a Resolution<T, K>,
    arms: &'a [Arm<T, K>],
    /// Indices of the arms that are brought to rest.
    sought: Range<usize>,
    scope: Scope,
    objective: Objective,
    path: Path,
    /// s.
    duration: f64,
    /// `c₁ … c₅` of the quintic, turns.
    quintic: [T; 5],
    /// The quintic without a bulge.
    curve: Segment<T>,
    /// Steps that are simulated.
    steps: u32,
    /// True if the simulation ends in the middle: an odd move of a time-reversible arm ends at rest
    /// if the arm is straight there.
    half: bool,
    /// States of the arms at the beginning, and the equilibria there.
    begin: [ArmState<T, K>; MAX_ARMS],
    begin_rest: [ArmState<T, K>; MAX_ARMS],
    /// States that the arms are to have when the simulation ends.
    goal: [ArmState<T, K>; MAX_ARMS],
}

/// A bulge and the amplitudes of the scene's own arm that it leaves.
struct Solution<T> {
    /// Turns.
    bulge: [T; BULGE],
    /// Residual of the first mode and of the second, of L.
    residual: [f64; 2],
    simulations: u32,
}

impl<'a, T: Scalar, const K: usize> Problem<'a, T, K> {
    /// States the problem.
    ///
    /// # Errors
    /// A duration below [`SHORTEST`] first periods.
    pub fn new(
        planner: &'a Planner<T, K>,
        request: &Request<T, K>,
        path: &Path,
        objective: Objective,
        scope: Scope,
    ) -> Result<Self, Error> {
        let duration = path.duration();
        let shortest = SHORTEST * planner.first_period();
        if duration < shortest {
            return Err(Error::TooShort { duration, shortest });
        }
        let resolution = planner.resolution(duration);
        let arms = planner.arms(resolution);
        let steps = path.ticks * resolution.steps;
        let curve = resolution.refine(path).segment(&[0.0; BULGE]).cast::<T>();
        let turning = path.rate != 0.0;
        let rest = |at: u32| -> [ArmState<T, K>; MAX_ARMS] {
            let mut rest = [ArmState::STRAIGHT; MAX_ARMS];
            if planner.scene.in_plane_gravity() != 0.0 {
                for (n, arm) in arms.iter().enumerate() {
                    rest[n] = arm.equilibrium(&planner.points, &curve.hub(at));
                }
            }
            rest
        };
        let steady = || {
            let end = HubState::turning(curve.hub(steps).angle, T::from_f64(path.rate));
            let mut steady = [ArmState::STRAIGHT; MAX_ARMS];
            for (n, arm) in arms.iter().enumerate() {
                steady[n] = arm.steady(&planner.points, &end);
            }
            steady
        };
        let odd = request.begins_at_rest() && !turning;
        let half = odd && steps.is_multiple_of(2) && planner.is_reversible();
        let begin_rest = rest(0);
        Ok(Self {
            planner,
            resolution,
            arms,
            sought: if scope == Scope::Outer { 1..arms.len() } else { 0..arms.len() },
            scope,
            objective,
            path: *path,
            duration,
            quintic: cast(&path.quintic()),
            steps: if half { steps / 2 } else { steps },
            half,
            begin: request.arm.map_or(begin_rest, |arm| [arm; MAX_ARMS]),
            begin_rest,
            goal: match (half, turning) {
                (true, _) => [ArmState::STRAIGHT; MAX_ARMS],
                (false, true) => steady(),
                (false, false) => rest(steps),
            },
            curve,
        })
    }

    /// Solves the problem.
    ///
    /// # Errors
    /// A move that leaves the first mode ringing by more than [`TOO_MUCH`].
    pub fn solve(&self) -> Result<StillMove, Error> {
        let each = self.each();
        let mut linear = Linear::new();
        for n in self.sought.clone() {
            self.add_mode(&mut linear, n, 0);
        }
        let tolerated = if self.sought.len() == MAX_ARMS {
            linear.tolerate(each, &self.quintic, self.objective, self.duration)
        } else {
            [T::ZERO; 2]
        };
        let effort = linear.least_effort(&self.quintic, self.objective);
        let (found, second) = self.correct(&effort, &tolerated);
        let missed = self.amplitude(&found.miss);
        if self.scope != Scope::Linear && (missed.is_nan() || missed > TOO_MUCH) {
            return Err(Error::NotStill { duration: self.duration, residual: missed });
        }
        let bulge = effort.bulge(&found.target);
        let mut solution = Solution {
            bulge,
            residual: [missed + self.amplitude(&tolerated), self.amplitude(&second)],
            simulations: found.simulations,
        };
        if self.scope == Scope::Outer {
            let end = self.simulate(0, &bulge);
            solution.simulations += 1;
            solution.residual =
                array(|k| if k < K { self.amplitude(&self.left(0, k, &end)[..each]) } else { 0.0 });
        }
        if self.scope == Scope::Second && self.arms.len() == 1 && solution.residual[1] > RINGS {
            self.quieten(&mut solution, &linear, &effort, [&found.miss[..each], &second[..each]]);
        }
        Ok(self.still_move(&solution))
    }

    /// Amplitudes that one mode of one arm has to leave: one in the middle or two at the end.
    fn each(&self) -> usize {
        if self.half { 1 } else { 2 }
    }

    /// Adds mode `k` of arm `n` to the linear model.
    fn add_mode(&self, linear: &mut Linear<T>, n: usize, k: usize) {
        let arm = &self.arms[n];
        let begin = arm.amplitudes(k, &self.begin[n], &self.begin_rest[n]);
        linear.add(&arm.oscillation[k], &self.quintic, begin, self.duration, self.half);
    }

    /// Corrects the linear model's target until the simulated arms arrive at rest but for
    /// `tolerated`. Returns the best target and the scene's own arm's second mode with it.
    fn correct(&self, effort: &LeastEffort<T>, tolerated: &[T; 2]) -> (solve::Found<T>, [T; 2]) {
        let each = self.each();
        let most = match self.scope {
            Scope::Linear => 1,
            _ if self.sought.len() == 1 => MAX_SIMULATIONS,
            _ => MAX_SIMULATIONS_OF_SEVERAL,
        };
        let (mut least, mut second) = (T::from_f64(f64::INFINITY), [T::ZERO; 2]);
        let enough = T::from_f64(ENOUGH * ENOUGH);
        let found = solve::solve(self.sought.len() * each, enough, most, |target| {
            let bulge = effort.bulge(target);
            let mut miss = [T::ZERO; MAX_AMPLITUDES];
            let mut rung = [T::ZERO; 2];
            for (row, n) in self.sought.clone().enumerate() {
                let end = self.simulate(n, &bulge);
                let left = self.left(n, 0, &end);
                miss[each * row..each * (row + 1)].copy_from_slice(&left[..each]);
                if n == 0 && K > 1 {
                    rung[..each].copy_from_slice(&self.left(n, 1, &end)[..each]);
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
        (found, second)
    }

    /// Brings the second mode to rest too, from a solution that leaves the amplitudes `miss` of the
    /// two modes.
    fn quieten(
        &self,
        solution: &mut Solution<T>,
        linear: &Linear<T>,
        effort: &LeastEffort<T>,
        miss: [&[T]; 2],
    ) {
        let each = self.each();
        let mut other = Linear::new();
        self.add_mode(&mut other, 0, 1);
        let mut along = [[T::ZERO; BULGE]; second_mode::MISSES];
        along[..each].copy_from_slice(&effort.towards[..each]);
        along[each..2 * each].copy_from_slice(&effort.aside(linear, &other)[..each]);
        let mut begin = [T::ZERO; second_mode::MISSES];
        for k in 0..2 {
            begin[each * k..each * (k + 1)].copy_from_slice(miss[k]);
        }
        let quiet = second_mode::solve(solution.bulge, begin, &along, 2 * each, |bulge| {
            let end = self.simulate(0, bulge);
            let mut miss = [T::ZERO; second_mode::MISSES];
            for k in 0..2 {
                miss[each * k..each * (k + 1)].copy_from_slice(&self.left(0, k, &end)[..each]);
            }
            miss
        });
        *solution = Solution {
            bulge: quiet.bulge,
            residual: [&quiet.miss[..each], &quiet.miss[each..2 * each]].map(|m| self.amplitude(m)),
            simulations: solution.simulations + quiet.simulations,
        };
    }

    /// Simulates arm `n` through the move with a bulge (turns).
    fn simulate(&self, n: usize, bulge: &[T; BULGE]) -> ArmState<T, K> {
        let curve = self.curve.bulged(bulge);
        let (points, per_step) = (&self.planner.points, self.resolution.per_step);
        self.arms[n].simulate(
            points,
            per_step,
            |k| curve.hub(k),
            self.steps,
            &self.begin[n],
            |_, _| (),
        )
    }

    /// Amplitudes that mode `k` of arm `n` is left with.
    fn left(&self, n: usize, k: usize, end: &ArmState<T, K>) -> [T; 2] {
        self.arms[n].amplitudes(k, end, &self.goal[n])
    }

    /// Root of the summed squares at the end of the move. The middle of an odd move misses by half
    /// of what its end does.
    fn amplitude(&self, of: &[T]) -> f64 {
        let whole = if self.half { 2.0 } else { 1.0 };
        whole * sqrt(of.iter().fold(T::ZERO, |sum, &x| sum + x * x).to_f64())
    }

    fn still_move(&self, solution: &Solution<T>) -> StillMove {
        let Path { from, to, rate, ticks, tick } = self.path;
        StillMove {
            from,
            to,
            rate,
            ticks,
            tick,
            bulge: solution.bulge.map(|x| TAU * x.to_f64()),
            peaks: curve_peaks(&self.quintic, &solution.bulge, self.duration),
            residual: solution.residual[0] + solution.residual[1],
            simulations: solution.simulations,
        }
    }
}
