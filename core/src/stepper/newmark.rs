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
//!
//! Half a tick long, the velocities are lengths: with `d = ½h q̇` and `c = −¼h² v̇` a tick is
//!
//! `d* = d − c − ½hb Δθ̇`, `q* = q + d + d*`, `[4/h² M + 2/h C + K_t] c = K_t q* + 2/h C d* + …`,
//! `q = q* − c`, `d = d* − c`,
//!
//! which needs neither h nor `v` itself, and no difference of large numbers.

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
    /// `½hb` with `b = M⁻¹F`.
    turn: [T; N],
    stiffness: Band<T, N, W>,
    /// `G`.
    spin: Band<T, N, W>,
    /// `4/h² M + 2/h (αM + βK) + K`, and its factors for ticks on which nothing is added to it.
    effective: Band<T, N, W>,
    factors: Ldl<T, N, W>,
    /// `−4/h² F`.
    coupling: [T; N],
    /// `J_h + J_r − Fᵀb`: `J_r − Fᵀb` is the part of the rigid inertia that `F` and `v̇` do not
    /// carry.
    inertia: T,
    /// `4/h`.
    twice_per_half: T,
    reach: T,
    /// `S`.
    shortening: Band<T, N, W>,
    /// The tip's deflection is the last degree of freedom, not the last but one.
    tip_last: bool,
    /// `2/h (αM + βK)`.
    damping: Band<T, N, W>,
    /// `αF` and `2/h αF`.
    drag: [T; N],
    drag_torque: [T; N],
    alpha: T,
    /// `αJ_r`.
    rigid_drag: T,
    /// `g K_P`.
    tension: Band<T, N, W>,
    /// `g f_g`.
    weight: [T; N],
    /// `g S`, S the first moment.
    moment: T,
}

/// Terms that the scene needs; the others cost nothing but a branch that never changes.
#[derive(Clone, Copy, Debug)]
struct Terms {
    spin: bool,
    gravity: bool,
    damping: bool,
}

/// The arm's state, in m and slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vibration<T, const N: usize> {
    /// `q`: deflection (m) and slope of each node in the hub frame.
    pub deflection: [T; N],
    /// `½h q̇`: half of what it gains a tick.
    pub gain: [T; N],
    /// `−¼h² v̇`.
    pub restoring: [T; N],
}

impl<T: Scalar, const N: usize, const W: usize> Newmark<T, N, W> {
    /// Factors the model for steps of `tick` s. f64 inside, rounded once at the end.
    pub fn new(model: &Model<N, W>, tick: f64) -> Result<Self, Error> {
        let tick = super::check_tick(tick)?;
        let scene = model.scene();
        let (alpha, beta, gravity) = (scene.damping.alpha, scene.damping.beta, scene.gravity);
        let per_half = 2.0 / tick;
        let damping =
            model.mass().scaled(per_half * alpha).plus(per_half * beta, model.stiffness());
        let effective =
            damping.plus(per_half * per_half, model.mass()).plus(1.0, model.stiffness());
        let turn = model.mass().factor().solve(model.coupling());
        let residual = scene.rigid_inertia() - dot(model.coupling(), &turn);
        let band = |a: &Band<f64, N, W>| a.map(T::from_f64);
        let coupling = |scale: f64| cast(&model.coupling().map(|f| scale * f));
        Ok(Self {
            tick,
            terms: Terms {
                spin: true,
                gravity: gravity != 0.0,
                damping: alpha != 0.0 || beta != 0.0,
            },
            turn: cast(&turn.map(|b| 0.5 * tick * b)),
            stiffness: band(model.stiffness()),
            spin: band(model.spin()),
            factors: effective.factor().map(T::from_f64),
            effective: band(&effective),
            coupling: coupling(-per_half * per_half),
            inertia: T::from_f64(scene.hub.inertia + residual),
            twice_per_half: T::from_f64(2.0 * per_half),
            reach: T::from_f64(scene.reach()),
            shortening: band(model.shortening()),
            tip_last: model.tip() + 1 == N,
            damping: band(&damping),
            drag: coupling(alpha),
            drag_torque: coupling(per_half * alpha),
            alpha: T::from_f64(alpha),
            rigid_drag: T::from_f64(alpha * scene.rigid_inertia()),
            tension: band(&model.tension().scaled(gravity)),
            weight: cast(&model.weight().map(|f| gravity * f)),
            moment: T::from_f64(gravity * scene.first_moment()),
        })
    }

    /// Leaves out every term in θ̇²: no centrifugal stiffening or softening, and their share of the
    /// torque. Cheaper, and wrong as soon as `θ̇` is not small against the first frequency.
    pub fn without_spin(mut self) -> Self {
        self.terms.spin = false;
        self
    }

    /// `q̇`, the deflection's rate in the hub frame.
    pub fn deflection_rate(&self, state: &Vibration<T, N>) -> [T; N] {
        let per_half = T::HALF * self.twice_per_half;
        state.gain.map(|gain| per_half * gain)
    }

    /// `w(L)`.
    #[inline(always)]
    fn tip_deflection(&self, q: &[T; N]) -> T {
        // Both indices are constants: no bounds check, and `q` may stay in registers.
        if self.tip_last { q[N - 1] } else { q[N.saturating_sub(2)] }
    }

    /// `c` from `[4/h² M + 2/h C + K_t] c = K_t q + 2/h C d + αFθ̇ + g cosθ f_g`, with
    /// `K_t = K + θ̇²G − g sinθ K_P`; the factors of set-up serve while `K_t` is `K`.
    #[inline(always)]
    fn solve(&self, q: &[T; N], d: &[T; N], hub: &Hub<T>) -> [T; N] {
        let mut force = self.stiffness.times(q);
        self.load(&mut force, d, hub);
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

    /// Adds the forces that do not depend on `q`.
    #[inline(always)]
    fn load(&self, force: &mut [T; N], d: &[T; N], hub: &Hub<T>) {
        if self.terms.damping {
            let damping = self.damping.times(d);
            for i in 0..N {
                force[i] += damping[i] + self.drag[i] * hub.rate;
            }
        }
        if self.terms.gravity {
            for i in 0..N {
                force[i] += self.weight[i] * hub.cos;
            }
        }
    }
}

impl<T: Scalar, const N: usize, const W: usize> Stepper for Newmark<T, N, W> {
    type Scalar = T;
    type State = Vibration<T, N>;

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn is_directed(&self) -> bool {
        self.terms.gravity
    }

    fn equilibrium(&self, hub: &Hub<T>) -> Vibration<T, N> {
        let load = self.weight.map(|f| -hub.cos * f);
        let deflection = self.stiffness.plus(-hub.sin, &self.tension).factor().solve(&load);
        Vibration { deflection, gain: [T::ZERO; N], restoring: [T::ZERO; N] }
    }

    #[inline(always)]
    fn step(&self, state: &mut Vibration<T, N>, before: &Hub<T>, after: &Hub<T>) {
        let gained = after.rate - before.rate;
        let mut q = state.deflection;
        let mut d = state.gain;
        for i in 0..N {
            let d0 = d[i];
            d[i] = d0 - state.restoring[i] - self.turn[i] * gained;
            q[i] += d0 + d[i];
        }
        let restoring = self.solve(&q, &d, after);
        for i in 0..N {
            q[i] -= restoring[i];
            d[i] -= restoring[i];
        }
        *state = Vibration { deflection: q, gain: d, restoring };
    }

    /// `τ = J_h θ̈ + (J_r − Fᵀb)θ̈ + αJ_r θ̇ + Fᵀ(v̇ + αq̇) + g cosθ S − g sinθ f_gᵀq
    /// − (θ̈ + αθ̇) qᵀGq − 2θ̇ qᵀGq̇ − ½ g cosθ qᵀK_P q`, of second order in `q`;
    /// tip `(r + L − ½ qᵀSq, w(L))`.
    #[inline(always)]
    fn response(&self, state: &Vibration<T, N>, hub: &Hub<T>) -> Response<T> {
        let q = &state.deflection;
        let mut forced = hub.acceleration;
        let mut torque = self.inertia * hub.acceleration + dot(&self.coupling, &state.restoring);
        if self.terms.damping {
            forced += self.alpha * hub.rate;
            torque += self.rigid_drag * hub.rate + dot(&self.drag_torque, &state.gain);
        }
        if self.terms.spin {
            let twice = self.twice_per_half * hub.rate;
            let mut arm = *q;
            for i in 0..N {
                arm[i] = forced * q[i] + twice * state.gain[i];
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
