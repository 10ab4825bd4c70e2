//! Exact kinematics: no trigonometry of the beam and no linear solve in the tick.
//!
//! The first mode is described by its momentum `p = ∂T/∂v₁`, the others by their velocities
//! `v = ȧ`: with `z = (p, v₂, …)`, `ω = θ̇` and Routh's function
//!
//! `R = ½(zᵀC(a)z − 2ω d(a)ᵀz + ω²e(a)) + V(a, θ)`
//!
//! the motion is `ȧ₁ = ∂R/∂p`, `ṗ = −∂R/∂a₁ − αp − βω₁²ȧ₁`, and for the others `Pₖ = −∂R/∂vₖ`,
//! `Ṗₖ = −∂R/∂aₖ − αPₖ − βωₖ²vₖ`. `t = d·z − ωe` is the angular momentum about the axis,
//! `τ = ṫ + αt + ∂V/∂θ + J_h θ̈`. At `a = 0` what is left for `a` and `p̃ = P − bω` is the linear
//! oscillator, advanced exactly, and a remainder of polynomials in `a` and forms in `(z, ω)` that
//! holds no `θ̈`: where the commanded acceleration jumps, nothing needs care.
//!
//! The second mode's own inertia varies with `a` and costs one division a step. The third's is the
//! straight link's: the tick rarely resolves that mode, and then a frequency that varies would
//! make an explicit step unstable; what drives it, and how it bends, is complete to second order.

mod arm_state;
mod fast;
mod mode;
mod nonlinear;
mod numerical_damping;
mod polynomial;
mod quality;
mod reach;
mod stability_check;
mod state;
mod steps;

pub use arm_state::ArmState;
pub use fast::ElasticaFast;
pub use quality::Quality;
pub use state::ElasticaState;

use mode::Mode;
use nonlinear::Nonlinear;
use numerical_damping::NumericalDamping;

use super::kicks::Kicks;
use super::oscillator::{check_turns, kick};
use super::{FastPaths, HubMotion, KinkMoments, Response, Stepper};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::{Each, Scalar, array, dot, words};
use crate::model::{Expansion, Rod};
use crate::motion::Peaks;

/// Geometrically exact inextensible rod in `K` modes, 1 to 3.
///
/// Exponential predictor-corrector of second order. The remainder sees its arguments (coordinates,
/// the first mode's momentum, the second's rate) scaled down where they leave its reach: to at most
/// 3 times the range that it was fitted for in the first mode, 12 times in the others. It is
/// therefore bounded, and the oscillators, which contract at any tick, cannot run away: a setpoint
/// is finite whatever is asked for. Moves that would bend the link further than that range are
/// refused when they are pushed.
///
/// Error against the exact rod, fraction of L, at 10 ms with 2 modes: 1e-5 to 1e-4 for bends up to
/// ½ rad, 1e-3 at 1 rad, 1e-2 at 1.5 rad.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Elastica<T, const K: usize> {
    modes: [Mode<T>; K],
    nonlinear: Nonlinear<T, K>,
    per_tick: T,
    quarter: T,
    /// ⅛ tick: Hermite interpolation to the middle.
    eighth_tick: T,
    alpha: T,
    /// Distance from where a mode rests, in `ωa`, below which it sleeps.
    asleep: [T; K],
    quality: Quality,
    /// Changes of `ωa` and `p̃` per first moment of a kink, see [`kick`].
    kink: [[T; 2]; K],
    tick: f64,
    /// Largest tip angle that moves may bend the link by, rad: see [`Rod::bend`].
    bend: f64,
    sag: f64,
    flexibility: f64,
    numerical_damping: NumericalDamping<T, K>,
    kicks: [Kicks<T>; K],
    gravity: GravityDirection<T>,
    /// `φ(L)` per unit of `ωa`, rad.
    tip_slope: [T; K],
}

impl<T: Scalar, const K: usize> Elastica<T, K> {
    /// Least and greatest tip angle that the expansion is fitted for, rad.
    pub const BEND: (f64, f64) = (0.05, 2.0);

    /// Returns the tip angle of [`Self::BEND`] that is nearest to `expected`, rad: the one to set a
    /// stepper up for.
    pub fn nearest_bend(expected: f64) -> f64 {
        let (least, most) = Self::BEND;
        expected.clamp(least, most)
    }

    /// Fastest turn that may go on and on, rad a tick: beyond it the predictor's spin terms feed
    /// the arm, too little to matter within a move.
    pub const HELD: f64 = 0.1;

    /// For steps of `tick` s and tip angles up to `bend` rad relative to the hub, 0 to 2: see
    /// [`Rod::bend`]. A smaller range than the least of [`Self::BEND`] is that one: a stiff arm or
    /// a slow move bends by less, and an expansion fitted to nothing would be none. f64 inside.
    pub fn new(rod: &Rod<K>, tick: f64, quality: Quality, bend: f64) -> Result<Self, Error> {
        rod.scene().check_no_carrier()?;
        let tick = super::check_tick(tick)?;
        let (least, most) = Self::BEND;
        let bend = Error::check("bend", bend, 0.0, most, "rad")?.max(least);
        let alpha = rod.scene().damping.alpha;
        check_turns(rod.frequency(), alpha, &rod.stiffness_damping(), tick)?;
        let stepper = Self::fitted(rod, tick, quality, bend, bend);
        if !stepper.is_stable_at_rest() {
            let mut shorter = tick;
            for _ in 0..HALVINGS {
                shorter *= 0.5;
                if Self::fitted(rod, shorter, quality, bend, bend).is_stable_at_rest() {
                    break;
                }
            }
            Error::check("solver.tick", tick, 1e-6, shorter, "s")?;
        }
        Ok(stepper)
    }

    /// Admits moves that bend the link by `bend`, but is fitted up to `range`.
    pub(super) fn fitted(rod: &Rod<K>, tick: f64, quality: Quality, bend: f64, range: f64) -> Self {
        const { assert!(1 <= K && K <= 3, "1 to 3 modes") }
        let step = match quality {
            Quality::Fast => tick,
            Quality::Fine => 0.5 * tick,
        };
        let scene = rod.scene();
        let range = rod.range(range);
        let expansion = Expansion::fit(rod, &range);
        let (alpha, beta) = (scene.damping.alpha, rod.stiffness_damping());
        Self {
            tick,
            quality,
            per_tick: T::from_f64(1.0 / tick),
            quarter: T::from_f64(0.25),
            eighth_tick: T::from_f64(0.125 * tick),
            alpha: T::from_f64(alpha),
            modes: core::array::from_fn(|k| {
                let (omega, b) = (rod.frequency()[k], expansion.coupling[k]);
                Mode::new(omega, alpha, beta[k], b, step)
            }),
            kink: array(|k| {
                let (omega, b) = (rod.frequency()[k], expansion.coupling[k]);
                let [a, p] = kick::<f64>(omega, alpha, beta[k], b, tick);
                [omega * a, p].each(T::from_f64)
            }),
            kicks: core::array::from_fn(|k| {
                let (omega, b) = (rod.frequency()[k], expansion.coupling[k]);
                Kicks::new(omega, alpha, beta[k], b, tick)
            }),
            nonlinear: Nonlinear::new(rod, &expansion, &range),
            numerical_damping: NumericalDamping::new(rod, step, &range),
            asleep: array(|k| {
                let floor = super::sleep_floor::<f64>(scene.link.length, expansion.linear[k].tip);
                T::from_f64(rod.frequency()[k] * floor)
            }),
            tip_slope: array(|k| T::from_f64(rod.tip_slope()[k] / rod.frequency()[k])),
            bend,
            sag: rod.bend(0.0),
            flexibility: rod.bend(1.0) - rod.bend(0.0),
            gravity: scene.gravity_direction(),
        }
    }

    /// Neither damping nor gravity.
    #[inline(always)]
    fn is_bare(&self) -> bool {
        !self.nonlinear.is_damped() && !self.nonlinear.feels_gravity()
    }

    /// Does the work of [`Stepper::step`] for that quality, known to the compiler or not.
    #[inline(always)]
    fn step_of<M: HubMotion>(
        &self,
        quality: Quality,
        state: &mut ElasticaState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        if M::LINEAR {
            self.step_linear(quality, state, before, after);
        } else if M::AT_REST && self.is_bare() {
            self.step_at_rest(quality, state);
        } else {
            self.step_any(quality, state, before, after);
        }
    }

    #[inline(always)]
    fn tip_of(&self, state: &ElasticaState<T, K>) -> [T; 2] {
        self.nonlinear.tip(state.y.each(|y| y[0]))
    }
}

impl<T: Scalar, const K: usize> Stepper for Elastica<T, K> {
    type Scalar = T;
    type State = ElasticaState<T, K>;

    const FAST: FastPaths = FastPaths { large: K > 1, ..FastPaths::BOTH };

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<T> {
        &self.gravity
    }

    #[inline(always)]
    fn is_linear_fast(&self, _: T) -> bool {
        self.is_bare()
    }

    /// Refuses what would bend the link beyond the range of the expansion, with 1e-6 of it for
    /// rounding, and rates to be held beyond [`Self::HELD`].
    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
        let fastest = Self::HELD / self.tick;
        Error::check("move.rate", held, -fastest, fastest, "rad/s")?;
        let bend = self.sag + self.flexibility * peaks.acceleration;
        super::check_bend(bend, self.bend)
    }

    #[inline(never)]
    fn equilibrium(&self, hub: &HubState<T>) -> ElasticaState<T, K> {
        let still = HubState { rate: T::ZERO, ..*hub };
        let mut y = [[T::ZERO; 2]; K];
        let mut value = self.value_at(&y, &still);
        // Half-way steps to the centre: contracting as long as the link carries its weight.
        for _ in 0..EQUILIBRIUM_STEPS {
            let before = y;
            for k in 0..K {
                y[k][0] = T::HALF * (y[k][0] - value.offset[k][0]);
            }
            // Every further step would be the same: firmware masks its tick for as long.
            if y == before {
                break;
            }
            value = self.value_at(&y, &still);
        }
        ElasticaState::at(y, value)
    }

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut ElasticaState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        self.step_of::<M>(self.quality, state, before, after);
    }

    #[inline(always)]
    fn response<M: HubMotion>(
        &self,
        state: &ElasticaState<T, K>,
        hub: &HubState<T>,
    ) -> Response<T> {
        let torque =
            if M::AT_REST { state.torque } else { state.torque + state.inertia * hub.acceleration };
        Response { torque, tip: self.tip_of(state) }
    }

    fn tip_angle(&self, state: &ElasticaState<T, K>) -> T {
        dot(&self.tip_slope, &state.y.each(|y| y[0]))
    }

    #[inline(always)]
    fn kink(&self, state: &mut ElasticaState<T, K>, moments: KinkMoments<'_, T>) {
        for k in 0..K {
            let kick = match moments {
                KinkMoments::First(moment) => self.kink[k].each(|kick| kick * moment),
                KinkMoments::All(kink) => self.kicks[k].of(kink),
            };
            for r in 0..2 {
                state.y[k][r] += kick[r];
            }
        }
    }

    #[inline(always)]
    fn is_settled(&self, state: &ElasticaState<T, K>) -> bool {
        (0..K).all(|k| {
            let floor = self.asleep[k];
            (0..2).all(|r| {
                let off = state.y[k][r] + state.offset[k][r];
                off < floor && -off < floor
            })
        })
    }
}

/// Halvings of a tick that is too long, in search of one that is not.
const HALVINGS: u32 = 16;

/// Halvings of the distance to the equilibrium: f32's precision is reached after 24.
const EQUILIBRIUM_STEPS: usize = 60;

words! {
    [T: Scalar, const K: usize] Elastica<T, K>: modes, nonlinear, per_tick, quarter,
        eighth_tick, alpha, asleep, quality, kink, tick, bend, sag, flexibility,
        numerical_damping, kicks, gravity, tip_slope;
}
