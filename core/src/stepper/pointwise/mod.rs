//! Exact kinematics at eight points of the link, in steps that resolve every mode.

mod steps;

use super::kicks::Kicks;
use super::oscillator::kick;
use super::{FastPaths, HubMotion, KinkMoments, Oscillator, Response, Stepper};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::{Each, Scalar, array, cast, clip, dot, words};
use crate::model::{POINTS, Rod, RodPoints};
use crate::motion::Peaks;
use crate::scene::{LinkShape, Scene};

/// Polynomials that the modes are made of. Of five, the third mode's frequency is 2.5 % too high,
/// and what a jump of the acceleration leaves of it is soon out of phase; of six it is 0.03 %.
const POLYNOMIALS: usize = 6;

/// Angles that the highest and the first mode turn by in a step at most, rad.
const RADIANS: [f64; 2] = [1.0, 0.2];

/// Most steps a tick.
const MAX_STEPS: f64 = 1024.0;

/// Excess acceleration, of what bends the tip by a radian, beyond which it is clipped. No move that
/// is admitted comes near.
const MOST: f64 = 30.0;

/// Halvings of the distance to the equilibrium.
const EQUILIBRIUM_STEPS: usize = 60;

/// Geometrically exact inextensible rod in `K` modes, 1 to 4, by the angles at eight points: what
/// [`Elastica`](super::Elastica) expands in polynomials is evaluated, and the mass matrix solved.
///
/// `M(a) ä = f(a, ȧ, θ̇, θ̈)`: the linear oscillators are advanced exactly, and the rest, which
/// bending makes, by a predictor and a corrector of second order. A tick takes as many steps as
/// keep the highest mode's turn within 1 rad and the first's within 0.2: it costs many times what
/// one of `Elastica` does.
///
/// Error against the exact rod with three modes, fraction of L: 2e-5 where `Elastica` errs by 1e-4.
/// The third mode floors that, which its expansion takes to be that of the straight link.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Pointwise<T, const K: usize> {
    points: RodPoints<T, K, POINTS>,
    modes: [Oscillator<T>; K],
    /// `ω²`, `βω²`, `b`.
    stiffness: [T; K],
    loss: [T; K],
    coupling: [T; K],
    alpha: T,
    /// Greatest excess acceleration.
    most: [T; K],
    /// `1/ω²` and `1/ω`.
    compliance: [T; K],
    per_omega: [T; K],
    /// Steps a tick, and their parts of it.
    steps: u32,
    part: T,
    /// h, s, `1/h`, and steps a second.
    length: T,
    per_tick: T,
    per_step: T,
    /// Gravity is felt by a hub that turns.
    weighs: bool,
    /// Distance from where a mode rests below which it sleeps.
    asleep: [T; K],
    /// Changes of `a` and `ȧ` per first moment of a kink.
    kink: [[T; 2]; K],
    kicks: [Kicks<T>; K],
    gravity: GravityDirection<T>,
    tip_slope: [T; K],
    tick: f64,
    sag: f64,
    flexibility: f64,
}

/// The arm's state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointwiseState<T, const K: usize> {
    /// `a`, m √kg.
    pub coordinate: [T; K],
    /// `ȧ`, m √kg/s.
    pub rate: [T; K],
    /// Acceleration beyond the linear oscillators', and by how much it changed in the last step.
    force: [T; K],
    change: [T; K],
}

impl<T: Scalar, const K: usize> Pointwise<T, K> {
    /// Largest tip angle relative to the hub that moves may bend the link by, rad.
    pub const BEND: f64 = 2.0;

    /// Fastest turn that may go on and on, rad a step.
    const HELD: f64 = 0.1;

    /// For ticks of `tick` s. f64 inside.
    pub fn new<S: LinkShape>(scene: &Scene<f64, S>, tick: f64) -> Result<Self, Error> {
        const { assert!(1 <= K && K <= 4, "1 to 4 modes") }
        scene.check_no_carrier()?;
        let tick = super::check_tick(tick)?;
        let rod = Rod::<K>::of_polynomials::<POLYNOMIALS>(scene)?;
        let points = RodPoints::fine(scene, &rod);
        let omega = *rod.frequency();
        let turns = (omega[K - 1] / RADIANS[0]).max(omega[0] / RADIANS[1]);
        let steps = libm::ceil(turns * tick);
        let longest = MAX_STEPS / turns;
        Error::check("solver.tick", tick, 1e-6, longest, "s")?;
        let step = tick / steps;
        let alpha = rod.scene().damping.alpha;
        let beta = rod.stiffness_damping();
        let b = rod.straight().coupling;
        let f = T::from_f64;
        Ok(Self {
            points,
            modes: core::array::from_fn(|k| Oscillator::new(omega[k], alpha, beta[k], b[k], step)),
            stiffness: cast(&omega.each(|w| w * w)),
            loss: array(|k| f(beta[k] * omega[k] * omega[k])),
            coupling: cast(&b),
            alpha: f(alpha),
            most: array(|k| f(MOST * omega[k] * omega[k] / rod.tip_slope()[k].abs())),
            compliance: cast(&omega.each(|w| 1.0 / (w * w))),
            per_omega: cast(&omega.each(|w| 1.0 / w)),
            steps: steps as u32,
            part: f(1.0 / steps),
            length: f(tick),
            per_tick: f(1.0 / tick),
            per_step: f(1.0 / step),
            weighs: rod.scene().in_plane_gravity() != 0.0 && !rod.scene().mount.is_linear(),
            asleep: array(|k| super::sleep_floor::<T>(rod.scene().link.length, rod.tip_swing()[k])),
            kink: array(|k| kick::<f64>(omega[k], alpha, beta[k], b[k], tick).each(f)),
            kicks: core::array::from_fn(|k| Kicks::new(omega[k], alpha, beta[k], b[k], tick)),
            gravity: rod.scene().gravity_direction(),
            tip_slope: cast(rod.tip_slope()),
            tick,
            sag: rod.bend(0.0),
            flexibility: rod.bend(1.0) - rod.bend(0.0),
        })
    }

    /// Steps that a tick takes.
    #[must_use]
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// Acceleration of the modes beyond that of the linear oscillators.
    #[inline(always)]
    fn excess(&self, a: &[T; K], v: &[T; K], hub: &HubState<T>) -> [T; K] {
        let exact = self.points.acceleration(a, v, hub, &self.stiffness, &self.loss);
        let drive = hub.acceleration + self.alpha * hub.rate;
        array(|k| {
            let linear = self.stiffness[k] * a[k]
                + (self.alpha + self.loss[k]) * v[k]
                + self.coupling[k] * drive;
            clip(exact[k] + linear, self.most[k])
        })
    }
}

impl<T: Scalar, const K: usize> Stepper for Pointwise<T, K> {
    type Scalar = T;
    type State = PointwiseState<T, K>;

    const FAST: FastPaths = FastPaths { linear: false, at_rest: false, large: false };

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<T> {
        &self.gravity
    }

    #[inline(always)]
    fn is_linear_fast(&self, _: T) -> bool {
        false
    }

    /// Refuses what would bend the link by more than [`Self::BEND`], and rates to be held at which
    /// it turns by more than a tenth of a radian a step.
    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
        let fastest = Self::HELD * f64::from(self.steps) / self.tick;
        Error::check("move.rate", held, -fastest, fastest, "rad/s")?;
        let bend = self.sag + self.flexibility * peaks.acceleration;
        super::check_bend(bend, Self::BEND)
    }

    fn equilibrium(&self, hub: &HubState<T>) -> PointwiseState<T, K> {
        let still = HubState { rate: T::ZERO, acceleration: T::ZERO, ..*hub };
        let (mut coordinate, rate) = ([T::ZERO; K], [T::ZERO; K]);
        let mut force = self.excess(&coordinate, &rate, &still);
        for _ in 0..EQUILIBRIUM_STEPS {
            for k in 0..K {
                coordinate[k] = T::HALF * (coordinate[k] + self.compliance[k] * force[k]);
            }
            force = self.excess(&coordinate, &rate, &still);
        }
        PointwiseState { coordinate, rate, force, change: [T::ZERO; K] }
    }

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut PointwiseState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        self.advance(state, before, after);
    }

    #[inline(always)]
    fn response<M: HubMotion>(
        &self,
        state: &PointwiseState<T, K>,
        hub: &HubState<T>,
    ) -> Response<T> {
        self.answer(state, hub)
    }

    fn tip_angle(&self, state: &PointwiseState<T, K>) -> T {
        dot(&self.tip_slope, &state.coordinate)
    }

    #[inline(always)]
    fn kink(&self, state: &mut PointwiseState<T, K>, moments: KinkMoments<'_, T>) {
        for k in 0..K {
            let [a, v] = match moments {
                KinkMoments::First(moment) => self.kink[k].map(|kick| kick * moment),
                KinkMoments::All(kink) => {
                    let [a, v] = self.kicks[k].of(kink);
                    [self.per_omega[k] * a, v]
                }
            };
            state.coordinate[k] += a;
            state.rate[k] += v;
        }
    }

    #[inline(always)]
    fn is_settled(&self, state: &PointwiseState<T, K>) -> bool {
        (0..K).all(|k| {
            let off = state.coordinate[k] - self.compliance[k] * state.force[k];
            let moving = self.per_omega[k] * state.rate[k];
            off.abs() < self.asleep[k] && moving.abs() < self.asleep[k]
        })
    }
}

words! {
    [T: Scalar, const K: usize] Pointwise<T, K>: points, modes, stiffness, loss, coupling, alpha,
        most, compliance, per_omega, steps, part, length, per_tick, per_step, weighs, asleep, kink,
        kicks, gravity, tip_slope, tick, sag, flexibility;
}
