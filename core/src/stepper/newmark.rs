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
    /// `4/h²`.
    per_quarter: T,
    /// `4/h² M + 2/h (αM + βK) + K`, and its factors for ticks on which nothing is added to it.
    effective: Band<T, N, W>,
    factors: Ldl<T, N, W>,
    stiffness: Band<T, N, W>,
    /// `G`.
    spin: Band<T, N, W>,
    /// `g K_P`.
    tension: Band<T, N, W>,
    /// `S`.
    shortening: Band<T, N, W>,
    /// `C = αM + βK`.
    damping: Band<T, N, W>,
    alpha: T,
    /// `b = M⁻¹F`.
    turn: [T; N],
    /// `βKb`.
    turn_damping: [T; N],
    /// `F`.
    coupling: [T; N],
    /// `g f_g`.
    weight: [T; N],
    /// `g S`, S the first moment.
    moment: T,
    /// `J_h + J_r − Fᵀb`: `J_r − Fᵀb` is the part of the rigid inertia that `F` and `v̇` do not
    /// carry.
    inertia: T,
    /// `α(J_r − Fᵀb)`.
    drag: T,
    reach: T,
    /// The tip's deflection is the last degree of freedom, not the last but one.
    tip_last: bool,
}

/// Terms that the scene needs; the others cost nothing but a branch that never changes.
#[derive(Clone, Copy, Debug)]
struct Terms {
    spin: bool,
    gravity: bool,
    damping: bool,
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
        let (half, per_quarter) = (0.5 * tick, 4.0 / (tick * tick));
        let damping = model.mass().scaled(alpha).plus(beta, model.stiffness());
        let effective =
            model.stiffness().plus(1.0 / half, &damping).plus(per_quarter, model.mass());
        let turn = model.mass().factor().solve(model.coupling());
        let residual = scene.rigid_inertia() - dot(model.coupling(), &turn);
        let band = |a: &Band<f64, N, W>| a.map(T::from_f64);
        Ok(Self {
            tick,
            terms: Terms {
                spin: true,
                gravity: gravity != 0.0,
                damping: alpha != 0.0 || beta != 0.0,
            },
            half: T::from_f64(half),
            per_quarter: T::from_f64(per_quarter),
            factors: effective.factor().map(T::from_f64),
            effective: band(&effective),
            stiffness: band(model.stiffness()),
            spin: band(model.spin()),
            tension: band(&model.tension().scaled(gravity)),
            shortening: band(model.shortening()),
            damping: band(&damping),
            alpha: T::from_f64(alpha),
            turn: cast(&turn),
            turn_damping: cast(&model.stiffness().times(&turn).map(|f| beta * f)),
            coupling: cast(model.coupling()),
            weight: cast(&model.weight().map(|f| gravity * f)),
            moment: T::from_f64(gravity * scene.first_moment()),
            inertia: T::from_f64(scene.hub.inertia + residual),
            drag: T::from_f64(alpha * residual),
            reach: T::from_f64(scene.reach()),
            tip_last: model.tip() + 1 == N,
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

    /// `w(L)`.
    #[inline(always)]
    fn tip_deflection(&self, q: &[T; N]) -> T {
        // Both indices are constants: no bounds check, and `q` may stay in registers.
        if self.tip_last { q[N - 1] } else { q[N.saturating_sub(2)] }
    }

    /// `−¼h² v̇` from `[4/h² M + 2/h C + K_t] ¼h² v̇ = −K_t q − Cv + θ̇βKb − g cosθ f_g`, with
    /// `K_t = K + θ̇²G − g sinθ K_P`; the factors of set-up serve while `K_t` is `K`.
    #[inline(always)]
    fn solve(&self, q: &[T; N], v: &[T; N], hub: &Hub<T>) -> [T; N] {
        let mut force = self.stiffness.times(q);
        if self.terms.damping {
            let damping = self.damping.times(v);
            for i in 0..N {
                force[i] += damping[i] - self.turn_damping[i] * hub.rate;
            }
        }
        if self.terms.gravity {
            for i in 0..N {
                force[i] += self.weight[i] * hub.cos;
            }
        }
        let turns = self.terms.spin && hub.rate != T::ZERO;
        if !turns && !self.terms.gravity {
            return self.factors.solve(&force);
        }
        let change = match (turns, self.terms.gravity) {
            (true, false) => self.spin.scaled(hub.rate * hub.rate),
            (false, _) => self.tension.scaled(-hub.sin),
            (true, true) => self.spin.scaled(hub.rate * hub.rate).plus(-hub.sin, &self.tension),
        };
        let changed = change.times(q);
        for i in 0..N {
            force[i] += changed[i];
        }
        self.effective.plus(T::ONE, &change).factor().solve(&force)
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
        let mut a = state.acceleration;
        for i in 0..N {
            let v0 = v[i];
            v[i] += self.half * a[i];
            q[i] += self.half * (v0 + v[i]) - self.turn[i] * turned;
        }
        let back = self.solve(&q, &v, after);
        for i in 0..N {
            q[i] -= back[i];
            a[i] = -(self.per_quarter * back[i]);
            v[i] += self.half * a[i];
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
        let mut torque = self.inertia * hub.acceleration + dot(&self.coupling, &state.acceleration);
        if self.terms.damping {
            forced += self.alpha * hub.rate;
            torque += self.drag * hub.rate + self.alpha * dot(&self.coupling, &state.velocity);
        }
        if self.terms.spin {
            let q_dot = self.deflection_rate(state, hub.rate);
            let twice = T::TWO * hub.rate;
            let mut arm = *q;
            for i in 0..N {
                arm[i] = forced * q[i] + twice * q_dot[i];
            }
            torque -= dot(&self.spin.times(q), &arm);
        }
        if self.terms.gravity {
            let bent = self.tension.half_form(q);
            torque += hub.cos * (self.moment - bent) - hub.sin * dot(&self.weight, q);
        }
        let tip = [self.reach - self.shortening.half_form(q), self.tip_deflection(q)];
        Response { torque, tip }
    }
}
