//! The paper's time marching: Newmark δ = ½, β = ¼ on the split displacement `u_m + u_d`.
//!
//! The paper puts the inertia on the whole displacement and the stiffness on the deformation
//! alone. In the hub frame the whole velocity is `v = q̇ + bθ̇`, with `b = M⁻¹F` the rigid turn as
//! the mass sees it, so that
//!
//! `M v̇ = −αM v − βK q̇ − [K + θ̇²G − g sinθ K_P] q − g cosθ f_g`,  `q̇ = v − bθ̇`.
//!
//! The commanded acceleration is gone: it may jump anywhere, inside a tick too, and the step stays
//! of second order without solving anew from the right-hand value. (It is the same scheme: with
//! the jumps handled that way, the classical form gives the same figures to four digits.)

use super::{Response, Stepper};
use crate::Error;
use crate::beam::Model;
use crate::math::{Band, Ldl, Scalar, cast, dot};
use crate::motion::Hub;

/// Newmark stepper for `N` degrees of freedom in bands of width `W`.
///
/// Second order in the tick; period error `(ωh)²/12`. Unconditionally stable in the linear part.
#[derive(Clone, Copy, Debug)]
pub struct Newmark<T, const N: usize, const W: usize> {
    tick: f64,
    terms: Terms,
    half: T,
    quarter: T,
    /// `M + ½h(αM + βK) + ¼h²K`, and its factors for ticks on which nothing is added to it.
    effective: Band<T, N, W>,
    factors: Ldl<T, N, W>,
    stiffness: Band<T, N, W>,
    /// `G`.
    spin: Band<T, N, W>,
    /// `g K_P`.
    tension: Band<T, N, W>,
    /// `S`.
    shortening: Band<T, N, W>,
    /// `αM`.
    drag: Band<T, N, W>,
    alpha: T,
    beta: T,
    /// `b = M⁻¹F`.
    turn: [T; N],
    /// `F`.
    coupling: [T; N],
    /// `g f_g`.
    weight: [T; N],
    /// `g S`, S the first moment.
    moment: T,
    hub_inertia: T,
    /// `J_r − Fᵀb`: the part of the rigid inertia that `F` and `v̇` do not carry.
    residual_inertia: T,
    reach: T,
    tip: usize,
}

/// Terms that the scene needs; the others cost nothing but a branch that never changes.
#[derive(Clone, Copy, Debug)]
struct Terms {
    spin: bool,
    gravity: bool,
    alpha: bool,
    beta: bool,
}

/// The arm's state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vibration<T, const N: usize> {
    /// `q`: deflection (m) and slope of each node in the hub frame.
    pub deflection: [T; N],
    /// `v = q̇ + bθ̇`.
    pub velocity: [T; N],
    /// `v̇`.
    pub acceleration: [T; N],
}

impl<T: Scalar, const N: usize, const W: usize> Newmark<T, N, W> {
    /// Factors the model for steps of `tick` s. f64 inside, rounded once at the end.
    pub fn new(model: &Model<N, W>, tick: f64) -> Result<Self, Error> {
        let tick = super::check_tick(tick)?;
        let scene = model.scene();
        let (alpha, beta, gravity) = (scene.damping.alpha, scene.damping.beta, scene.gravity);
        let (half, quarter) = (0.5 * tick, 0.25 * tick * tick);
        let effective = model
            .mass()
            .map(|m| (1.0 + half * alpha) * m)
            .plus(half * beta + quarter, model.stiffness());
        let turn = model.mass().factor().solve(model.coupling());
        let carried = dot(model.coupling(), &turn);
        let band = |a: &Band<f64, N, W>| a.map(T::from_f64);
        Ok(Self {
            tick,
            terms: Terms {
                spin: true,
                gravity: gravity != 0.0,
                alpha: alpha != 0.0,
                beta: beta != 0.0,
            },
            half: T::from_f64(half),
            quarter: T::from_f64(quarter),
            factors: effective.factor().map(T::from_f64),
            effective: band(&effective),
            stiffness: band(model.stiffness()),
            spin: band(model.spin()),
            tension: band(&model.tension().map(|k| gravity * k)),
            shortening: band(model.shortening()),
            drag: band(&model.mass().map(|m| alpha * m)),
            alpha: T::from_f64(alpha),
            beta: T::from_f64(beta),
            turn: cast(&turn),
            coupling: cast(model.coupling()),
            weight: cast(&model.weight().map(|f| gravity * f)),
            moment: T::from_f64(gravity * scene.first_moment()),
            hub_inertia: T::from_f64(scene.hub.inertia),
            residual_inertia: T::from_f64(scene.rigid_inertia() - carried),
            reach: T::from_f64(scene.reach()),
            tip: model.tip(),
        })
    }

    /// Leaves out every term in θ̇²: no centrifugal stiffening or softening, and their share of the
    /// torque. Cheaper, and wrong as soon as `θ̇` is not small against the first frequency.
    pub fn without_spin(mut self) -> Self {
        self.terms.spin = false;
        self
    }

    /// `q̇ = v − bθ̇`, the deflection's rate in the hub frame.
    #[inline(always)]
    pub fn deflection_rate(&self, state: &Vibration<T, N>, rate: T) -> [T; N] {
        let mut q_dot = state.velocity;
        for i in 0..N {
            q_dot[i] -= self.turn[i] * rate;
        }
        q_dot
    }

    /// `−αM v − K(q + βq̇) − θ̇²G q + g sinθ K_P q − g cosθ f_g`: what `M v̇` equals.
    #[inline(always)]
    fn load(&self, q: &[T; N], v: &[T; N], hub: &Hub<T>) -> [T; N] {
        let mut strain = *q;
        if self.terms.beta {
            for i in 0..N {
                strain[i] += self.beta * (v[i] - self.turn[i] * hub.rate);
            }
        }
        let mut load = self.stiffness.times(&strain).map(|f| -f);
        if self.terms.alpha {
            let drag = self.drag.times(v);
            for i in 0..N {
                load[i] -= drag[i];
            }
        }
        if self.terms.spin {
            let spin = self.spin.times(q);
            let rate2 = hub.rate * hub.rate;
            for i in 0..N {
                load[i] -= rate2 * spin[i];
            }
        }
        if self.terms.gravity {
            let tension = self.tension.times(q);
            for i in 0..N {
                load[i] += hub.sin * tension[i] - hub.cos * self.weight[i];
            }
        }
        load
    }

    /// Solves `[M + ½hC + ¼h²K_t] v̇ = load`; the factors of set-up serve while `K_t` is `K`.
    #[inline(always)]
    fn solve(&self, load: &[T; N], hub: &Hub<T>) -> [T; N] {
        let turns = self.terms.spin && hub.rate != T::ZERO;
        if !turns && !self.terms.gravity {
            return self.factors.solve(load);
        }
        let mut effective = self.effective;
        if self.terms.spin {
            effective = effective.plus(self.quarter * hub.rate * hub.rate, &self.spin);
        }
        if self.terms.gravity {
            effective = effective.plus(-(self.quarter * hub.sin), &self.tension);
        }
        effective.factor().solve(load)
    }
}

impl<T: Scalar, const N: usize, const W: usize> Stepper for Newmark<T, N, W> {
    type Scalar = T;
    type State = Vibration<T, N>;

    fn tick(&self) -> f64 {
        self.tick
    }

    fn equilibrium(&self, hub: &Hub<T>) -> Vibration<T, N> {
        let load = self.weight.map(|f| -hub.cos * f);
        let deflection = self.stiffness.plus(-hub.sin, &self.tension).factor().solve(&load);
        Vibration { deflection, velocity: [T::ZERO; N], acceleration: [T::ZERO; N] }
    }

    #[inline(always)]
    fn step(&self, state: &mut Vibration<T, N>, before: &Hub<T>, after: &Hub<T>) {
        // ∫θ̇dt by the same rule as everything else; the remainder of the angle would bring in
        // rounding noise a hundred times larger.
        let turned = self.half * (before.rate + after.rate);
        let mut q = state.deflection;
        let mut v = state.velocity;
        for i in 0..N {
            let (v0, a0) = (v[i], state.acceleration[i]);
            v[i] += self.half * a0;
            q[i] += self.half * (v0 + v[i]) - self.turn[i] * turned;
        }
        let a = self.solve(&self.load(&q, &v, after), after);
        for i in 0..N {
            v[i] += self.half * a[i];
            q[i] += self.quarter * a[i];
        }
        *state = Vibration { deflection: q, velocity: v, acceleration: a };
    }

    /// `τ = J_h θ̈ + (J_r − Fᵀb)(θ̈ + αθ̇) + Fᵀ(v̇ + αv) + g cosθ S − g sinθ f_gᵀq
    /// − (θ̈ + αθ̇) qᵀGq − 2θ̇ qᵀGq̇ − ½ g cosθ qᵀK_P q`, of second order in `q`;
    /// tip `(r + L − ½ qᵀSq, w(L))`.
    #[inline(always)]
    fn response(&self, state: &Vibration<T, N>, hub: &Hub<T>) -> Response<T> {
        let q = &state.deflection;
        let mut forced = hub.acceleration;
        let mut torque =
            self.hub_inertia * hub.acceleration + dot(&self.coupling, &state.acceleration);
        if self.terms.alpha {
            forced += self.alpha * hub.rate;
            torque += self.alpha * dot(&self.coupling, &state.velocity);
        }
        torque += self.residual_inertia * forced;
        if self.terms.spin {
            let q_dot = self.deflection_rate(state, hub.rate);
            let spin = self.spin.times(q);
            torque -= forced * dot(&spin, q) + T::TWO * hub.rate * dot(&spin, &q_dot);
        }
        if self.terms.gravity {
            let bent = dot(&self.tension.times(q), q);
            torque += hub.cos * (self.moment - T::HALF * bent) - hub.sin * dot(&self.weight, q);
        }
        let shortened = T::HALF * dot(&self.shortening.times(q), q);
        let deflection = q.get(self.tip).copied().unwrap_or(T::ZERO);
        Response { torque, tip: [self.reach - shortened, deflection] }
    }
}
