//! Simulates an arm through a move in its exact kinematics.

use core::f64::consts::TAU;

use super::linear::Oscillation;
use super::{MAX_ARMS, Path};
use crate::Error;
use crate::hub::HubState;
use crate::math::{Each, Scalar, Words, array, cast, mix, named, read, sqrt, words};
use crate::model::{Load, Rod, RodPoints};
use crate::scene::{LinkShape, Scene};
use crate::stepper::{ArmState, Forcing, LONGEST_TURN, Oscillator};

/// Number of times that the distance to an equilibrium is halved.
const HALVINGS: usize = 30;

/// The modes of one arm that a move is planned for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arm<T, const K: usize> {
    modes: [Oscillator<T>; K],
    /// `ω²`, `βω²`, `b`.
    stiffness: [T; K],
    loss: [T; K],
    coupling: [T; K],
    /// The modes, as the linear model sees them.
    pub oscillation: [Oscillation<T>; K],
    alpha: T,
    /// `∂Y/∂a` of the tip over L, of each mode, and it over ω.
    tip_per_mode: [[T; 2]; K],
    /// `ω`.
    frequency: [T; K],
}

/// The arms that a move is planned for, discretised for simulations in steps of one length.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Resolution<T, const K: usize> {
    /// The scene's own arm, then the outer two of a robust planner.
    pub arms: [Arm<T, K>; MAX_ARMS],
    /// Steps in a tick.
    pub steps: u32,
    /// 1/s.
    pub per_step: T,
}

impl<T: Scalar, const K: usize> Resolution<T, K> {
    /// Puts the outer arms at `1 ± aside` of the frequency. A step turns the highest mode and the
    /// first by at most `radians`.
    pub fn new<S: LinkShape>(
        scene: &Scene<f64, S>,
        rod: &Rod<K>,
        tick: f64,
        aside: f64,
        radians: [f64; 2],
    ) -> Result<Self, Error> {
        let omega = rod.frequency();
        let turns = (omega[K - 1] * (1.0 + aside) / radians[0]).max(omega[0] / radians[1]);
        let steps = libm::ceil(turns * tick).clamp(1.0, 1024.0);
        let step = tick / steps;
        let arm = |factor: f64| Arm::new(&Rod::new(&scene.stiffened(factor * factor))?, step);
        let own = Arm::new(rod, step)?;
        let arms =
            if aside > 0.0 { [own, arm(1.0 - aside)?, arm(1.0 + aside)?] } else { [own; MAX_ARMS] };
        Ok(Self { arms, steps: steps as u32, per_step: T::from_f64(1.0 / step) })
    }

    /// The path, divided into the steps of a simulation.
    pub fn refine(&self, path: &Path) -> Path {
        let steps = self.steps;
        Path { ticks: path.ticks * steps, tick: path.tick / f64::from(steps), ..*path }
    }
}

impl<T: Scalar, const K: usize> Arm<T, K> {
    /// Discretises the modes of an arm for steps of `step` s.
    pub fn new(rod: &Rod<K>, step: f64) -> Result<Self, Error> {
        let alpha = rod.scene().damping.alpha;
        let beta = rod.stiffness_damping();
        let omega = *rod.frequency();
        let coupling = rod.straight().coupling;
        let tip_per_mode = |k: usize| rod.tip_swing()[k] / rod.scene().link.length;
        let f = T::from_f64;
        Ok(Self {
            modes: core::array::from_fn(|k| {
                Oscillator::new(omega[k], alpha, beta[k], coupling[k], step)
            }),
            stiffness: cast(&omega.each(|w| w * w)),
            loss: array(|k| f(beta[k] * omega[k] * omega[k])),
            coupling: cast(&coupling),
            oscillation: core::array::from_fn(|k| {
                let w = omega[k];
                let decay = 0.5 * (alpha + beta[k] * w * w);
                let damped = sqrt((w * w - decay * decay).max(0.01 * w * w));
                Oscillation {
                    decay,
                    damped,
                    ratio: [f(decay / damped), f(w / damped)],
                    gain: f(tip_per_mode(k) * coupling[k] / w),
                    alpha: f(alpha),
                }
            }),
            alpha: f(alpha),
            tip_per_mode: array(|k| [f(tip_per_mode(k)), f(tip_per_mode(k) / omega[k])]),
            frequency: cast(&omega),
        })
    }

    /// `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        TAU / self.frequency[0].to_f64()
    }

    /// Deflection of the tip and its rate over ω by mode `k`, away from `rest`, of L.
    pub fn amplitudes(&self, k: usize, at: &ArmState<T, K>, rest: &ArmState<T, K>) -> [T; 2] {
        [
            self.tip_per_mode[k][0] * (at.coordinate[k] - rest.coordinate[k]),
            self.tip_per_mode[k][1] * (at.rate[k] - rest.rate[k]),
        ]
    }

    /// Finds the static equilibrium at the hub's angle.
    pub fn equilibrium(&self, points: &RodPoints<T, K>, hub: &HubState<T>) -> ArmState<T, K> {
        self.steady(points, &HubState { rate: T::ZERO, acceleration: T::ZERO, ..*hub })
    }

    /// Finds the state in which the arm is at rest relative to a hub that keeps its rate: bent by
    /// the drag of the damping, stretched out by the spin. There is none under gravity.
    pub fn steady(&self, points: &RodPoints<T, K>, hub: &HubState<T>) -> ArmState<T, K> {
        let drive = hub.acceleration + self.alpha * hub.rate;
        let mut flex = ArmState::STRAIGHT;
        for _ in 0..HALVINGS {
            let excess = self.excess(points, &flex, hub);
            for k in 0..K {
                let next = (excess[k] - self.coupling[k] * drive) / self.stiffness[k];
                flex.coordinate[k] = T::HALF * (flex.coordinate[k] + next);
            }
        }
        flex
    }

    /// Returns the same arm without its damping, discretised for steps of `step` s.
    pub fn undamped(&self, step: f64) -> Self {
        let modes = core::array::from_fn(|k| {
            let (omega, coupling) = (self.frequency[k], self.coupling[k]);
            if omega.to_f64() * step <= LONGEST_TURN {
                return Oscillator::turning(omega, coupling, T::from_f64(step));
            }
            Oscillator::new(omega.to_f64(), 0.0, 0.0, coupling.to_f64(), step)
        });
        Self { modes, loss: [T::ZERO; K], alpha: T::ZERO, ..*self }
    }

    /// Returns an arm of `factor` times the frequencies for [`Self::undamped`] simulations: with
    /// every stiffness scaled alike, its modes keep their shapes.
    pub fn stiffened(&self, factor: T) -> Self {
        Self {
            stiffness: self.stiffness.each(|square| factor * factor * square),
            frequency: self.frequency.each(|omega| factor * omega),
            tip_per_mode: self.tip_per_mode.each(|[tip, per_rate]| [tip, per_rate / factor]),
            ..*self
        }
    }

    /// ω of mode `k`, rad/s, and its coupling b to the hub.
    pub fn mode(&self, k: usize) -> [T; 2] {
        [self.frequency[k], self.coupling[k]]
    }

    /// Deflection of the tip by mode `k`, of L.
    pub fn tip_per_mode(&self, k: usize) -> T {
        self.tip_per_mode[k][0]
    }

    /// Returns the state of the arm after `steps` steps of a hub that is `hub_at(k)` after step
    /// `k`. `watch` is handed arm and hub at every step.
    pub fn simulate(
        &self,
        points: &RodPoints<T, K>,
        per_step: T,
        hub_at: impl Fn(u32) -> HubState<T>,
        steps: u32,
        from: &ArmState<T, K>,
        mut watch: impl FnMut(&ArmState<T, K>, &HubState<T>),
    ) -> ArmState<T, K> {
        let mut flex = *from;
        let mut hub = hub_at(0);
        let mut force = self.excess(points, &flex, &hub);
        let mut change = [T::ZERO; K];
        for k in 1..=steps {
            let after = hub_at(k);
            let drive = Forcing::between(&hub, &after, per_step, self.alpha);
            let mut y = [[T::ZERO; 2]; K];
            for k in 0..K {
                let at = [flex.coordinate[k], flex.rate[k]];
                y[k] = self.modes[k].predict(at, &drive, [T::ZERO, force[k]], [T::ZERO, change[k]]);
            }
            let guess = ArmState { coordinate: y.each(|y| y[0]), rate: y.each(|y| y[1]) };
            let next = self.excess(points, &guess, &after);
            for k in 0..K {
                let new = next[k] - force[k];
                let [a, v] = self.modes[k].correct(y[k], [T::ZERO, new - change[k]]);
                (flex.coordinate[k], flex.rate[k]) = (a, v);
                change[k] = new;
            }
            (force, hub) = (next, after);
            watch(&flex, &hub);
        }
        flex
    }

    /// Torque at the hub (N m), bending moment at the clamp (N m) and position of the tip (m).
    pub fn load(
        &self,
        points: &RodPoints<T, K>,
        flex: &ArmState<T, K>,
        hub: &HubState<T>,
    ) -> Load<T> {
        points.answer(&flex.coordinate, &flex.rate, hub, &self.stiffness, &self.loss)
    }

    /// Amplitude of the tip's deflection about `rest`, m: an upper bound, with all modes in step.
    pub fn ringing(
        &self,
        points: &RodPoints<T, K>,
        at: &ArmState<T, K>,
        rest: &ArmState<T, K>,
    ) -> f64 {
        let tip = points.tip_swing();
        let mut sum = 0.0;
        for k in 0..K {
            let a = (at.coordinate[k] - rest.coordinate[k]).to_f64();
            let v = (at.rate[k] / self.frequency[k]).to_f64();
            sum += tip[k].to_f64().abs() * sqrt(a * a + v * v);
        }
        sum
    }

    /// The part of the modal accelerations that the linear oscillators do not have.
    #[inline(always)]
    fn excess(&self, points: &RodPoints<T, K>, flex: &ArmState<T, K>, hub: &HubState<T>) -> [T; K] {
        let ArmState { coordinate: a, rate: v } = flex;
        let exact = points.acceleration(a, v, hub, &self.stiffness, &self.loss);
        let drive = hub.acceleration + self.alpha * hub.rate;
        array(|k| {
            exact[k]
                + self.stiffness[k] * a[k]
                + (self.alpha + self.loss[k]) * v[k]
                + self.coupling[k] * drive
        })
    }
}

words! {
    [T: Scalar, const K: usize] Arm<T, K>: modes, stiffness, loss, coupling, oscillation, alpha,
        tip_per_mode, frequency;
}

/// A planner that is not robust has one arm three times, and it is written once.
impl<T: Scalar, const K: usize> Words for Resolution<T, K> {
    const LAYOUT: u32 = {
        let hash = mix(named("own arm, is robust, outer arms, steps, per_step"), T::LAYOUT);
        mix(hash, Arm::<T, K>::LAYOUT)
    };
    const BLANK: Self =
        Self { arms: [Words::BLANK; MAX_ARMS], steps: Words::BLANK, per_step: Words::BLANK };

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        let Self { arms, steps, per_step } = self;
        let [own, outer @ ..] = arms;
        own.put(sink);
        let robust = outer.iter().any(|arm| arm.frequency != own.frequency);
        robust.put(sink);
        if robust {
            outer.iter().for_each(|arm| arm.put(sink));
        }
        steps.put(sink);
        per_step.put(sink);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        let Self { arms, steps, per_step } = self;
        let [own, outer @ ..] = arms;
        own.fill(source);
        let robust = read(source);
        for arm in outer {
            if robust {
                arm.fill(source);
            } else {
                *arm = *own;
            }
        }
        steps.fill(source);
        per_step.fill(source);
    }
}
