//! The paper's time marching: Newmark δ = ½, β = ¼ on the split displacement `u_m + u_d`.
//!
//! The paper puts the inertia on the whole displacement and the stiffness on the deformation
//! alone. In the hub frame the whole velocity is `v = q̇ + bθ̇`, with `b = M⁻¹F` the rigid turn as
//! the mass sees it, so that
//!
//! `M v̇ = −αM v − βK q̇ − [K + θ̇²G − g sinχ K_P] q − g cosχ f_g`,  `q̇ = v − bθ̇`.
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
//!
//! With full matrices (one or two elements, lumped mass), `q` is taken along the principal axes of
//! `G` in the metric of `K`: `K` is then the identity and `G` a diagonal, and only the solve with
//! the mass is left to couple the coordinates. The scheme is the same, at a third less work with
//! one element. Not modes: with `K` exact on the diagonal the lowest of them loses nothing to
//! rounding, and the spin terms stay off the coupling. Banded matrices would fill; they keep the
//! nodes' `q`.

mod respond;
mod setup;
mod solve;

use super::terms::Terms;
use super::{FastPaths, HubMotion, KinkMoments, Response, Stepper};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::{Band, Each, HalfForm, Ldl, Scalar, dot, words};
use crate::model::Model;
use crate::motion::Peaks;

/// Newmark stepper for `N` degrees of freedom in bands of width `W`.
///
/// Second order in the tick; period error `(ωh)²/12`. Unconditionally stable in the linear part.
///
/// Full matrices, `W = N`, are taken along the principal axes of stiffness and spin, in which both
/// are diagonal. [`Self::nodal`] is without: 3 KB of code less, and ticks that take half as many
/// instructions again where there is neither damping nor gravity.
// The numbers of a linear tick first: within a short reach of the generator's own.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Newmark<T, const N: usize, const W: usize, const AXES: bool = true> {
    /// `½hb` with `b = M⁻¹F`.
    turn: [T; N],
    /// `G`; a diagonal along the principal axes.
    spin: Band<T, N, W>,
    /// `4/h² M + 2/h (αM + βK) + K`, and its factors for ticks on which nothing is added to it.
    effective: Band<T, N, W>,
    /// `−4/h² F`.
    coupling: [T; N],
    /// `J_h + J_r − Fᵀb`: `J_r − Fᵀb` is the part of the rigid inertia that `F` and `v̇` do not
    /// carry.
    inertia: T,
    /// `4/h`.
    twice_per_half: T,
    reach: T,
    /// `½ qᵀSq`.
    shortening: HalfForm<T, N, W>,
    /// `w(L)` per unit of `q`.
    tip: [T; N],
    factors: Ldl<T, N, W>,
    /// `K`; the identity along the principal axes.
    stiffness: Band<T, N, W>,
    terms: Terms,
    /// Fraction of `d` that is taken a tick from an arm that nothing damps, its hub at rest.
    numerical_damping: T,
    /// The tip's deflection is the last degree of freedom, not the last but one.
    tip_last: bool,
    /// Weights of the squares of `c` and of `d`: below 1, their sum says that the arm is settled.
    awake: [T; 2],
    tick: f64,
    /// `2/h (αM + βK)`.
    damping: Band<T, N, W>,
    /// `αF` and `2/h αF`.
    drag: [T; N],
    drag_torque: [T; N],
    alpha: T,
    /// `αJ_r`.
    rigid_drag: T,
    /// `g K_P`, and `½ g qᵀK_P q`, on a carriage 0.
    tension: Band<T, N, W>,
    bent: HalfForm<T, N, W>,
    /// `g f_g`.
    weight: [T; N],
    /// 1 on a hub that turns, 0 on a carriage, where the weight has no lever.
    swings: T,
    /// `g S`, S the first moment.
    moment: T,
    /// Largest `c`, see [`super::MOST_GRAVITY_CHANGE`].
    most: T,
    gravity: GravityDirection<T>,
    /// `φ(L)` per unit of `q`.
    tip_slope: [T; N],
}

/// The arm's state. Of banded matrices in m and slopes, of full ones along the principal axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewmarkState<T, const N: usize> {
    /// `q`: deflection (m) and slope of each node in the hub frame, or their principal coordinates.
    pub deflection: [T; N],
    /// `½h q̇`: half of what it gains a tick.
    pub gain: [T; N],
    /// `−¼h² v̇`.
    pub restoring: [T; N],
}

impl<T: Scalar, const N: usize, const W: usize> Newmark<T, N, W> {
    /// Factors the model for steps of `tick` s. In the model's precision, rounded once at the end.
    pub fn new<P: Scalar>(model: &Model<N, W, P>, tick: f64) -> Result<Self, Error> {
        Self::set_up(model, tick)
    }
}

impl<T: Scalar, const N: usize, const W: usize> Newmark<T, N, W, false> {
    /// Factors the model as [`Newmark::new`] does, in the nodes' own coordinates.
    pub fn nodal<P: Scalar>(model: &Model<N, W, P>, tick: f64) -> Result<Self, Error> {
        Self::set_up(model, tick)
    }
}

impl<T: Scalar, const N: usize, const W: usize, const AXES: bool> Newmark<T, N, W, AXES> {
    /// A change of basis fills a band matrix, so it pays only where the matrix is full.
    const PRINCIPAL: bool = AXES && W == N;

    /// Leaves out every term in θ̇²: no centrifugal stiffening or softening, and their share of the
    /// torque. Cheaper, and wrong as soon as `θ̇` is not small against the first frequency.
    #[must_use]
    pub fn without_spin(mut self) -> Self {
        self.terms.spin = false;
        // Linear ticks do not ask.
        self.spin = Band::ZERO;
        self
    }

    /// `q̇`, the deflection's rate in the hub frame.
    pub fn deflection_rate(&self, state: &NewmarkState<T, N>) -> [T; N] {
        let per_half = T::HALF * self.twice_per_half;
        state.gain.each(|gain| per_half * gain)
    }
}

impl<T: Scalar, const N: usize, const W: usize, const AXES: bool> Stepper
    for Newmark<T, N, W, AXES>
{
    type Scalar = T;
    type State = NewmarkState<T, N>;

    const FAST: FastPaths = {
        let linear = N <= 2 && Self::PRINCIPAL;
        FastPaths { linear, at_rest: N > 2 || linear, large: false }
    };

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<T> {
        &self.gravity
    }

    #[inline(always)]
    fn is_linear_fast(&self, _: T) -> bool {
        !self.terms.gravity && !self.terms.damping
    }

    /// Refuses rates at which the arm has no stiffness left, upright where there is gravity. Lumped
    /// mass overrates what turning softens: one element gives way at 1.5 ω₁.
    fn admit(&self, peaks: &Peaks, _: f64) -> Result<(), Error> {
        if !Self::PRINCIPAL || !self.terms.spin {
            return Ok(());
        }
        let carries = |rate: f64| {
            let rate = T::from_f64(rate);
            let turning = self.stiffness.plus(rate * rate, &self.spin);
            let upright = turning.plus(-T::ONE, &self.tension);
            upright.factor().is_positive()
        };
        if carries(peaks.rate) {
            return Ok(());
        }
        // To a hundredth; down to none for an arm that hardly stands.
        let mut max = peaks.rate;
        for _ in 0..2000 {
            if carries(max) {
                break;
            }
            max *= 0.99;
        }
        Err(Error::TooFast { rate: peaks.rate, max })
    }

    fn equilibrium(&self, hub: &HubState<T>) -> NewmarkState<T, N> {
        let load = self.weight.each(|f| -hub.cos * f);
        let deflection = self.stiffness.plus(-hub.sin, &self.tension).factor().solve(&load);
        NewmarkState { deflection, gain: [T::ZERO; N], restoring: [T::ZERO; N] }
    }

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut NewmarkState<T, N>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        let (mut q, mut d) = (state.deflection, state.gain);
        self.predict::<M>(&mut q, &mut d, &state.restoring, after.rate - before.rate);
        let mut restoring = self.solve::<M>(&q, &d, after);
        if M::AT_REST {
            self.damp_numerically(&mut restoring, &d);
        }
        *state = Self::correct(q, d, restoring);
    }

    fn tip_angle(&self, state: &NewmarkState<T, N>) -> T {
        dot(&self.tip_slope, &state.deflection)
    }

    /// Does nothing: the step takes the hub's rates only, which say what a jump inside the tick
    /// gives `v`. Where in the tick it jumps moves `q` by at most `⅛(ωh)²` of what the jump bends
    /// it by: no more than the rule's own period error, `(ωh)²/12` a radian, makes of it within a
    /// period.
    #[inline(always)]
    fn kink(&self, _: &mut NewmarkState<T, N>, _: KinkMoments<'_, T>) {}

    /// Bounds the swing of every node by the arm's lowest frequency: none is larger than
    /// `c/(½hω₁)²` and `d/(½hω₁)` make it.
    #[inline(always)]
    fn is_settled(&self, state: &NewmarkState<T, N>) -> bool {
        let [far, fast] = self.awake;
        far * dot(&state.restoring, &state.restoring) + fast * dot(&state.gain, &state.gain)
            < T::ONE
    }

    /// `τ = J_h θ̈ + (J_r − Fᵀb)θ̈ + αJ_r θ̇ + Fᵀ(v̇ + αq̇) + g cosχ S − g sinχ f_gᵀq
    /// − (θ̈ + αθ̇) qᵀGq − 2θ̇ qᵀGq̇ − ½ g cosχ qᵀK_P q`, of second order in `q`;
    /// tip `(r + L − ½ qᵀSq, w(L))`.
    #[inline(always)]
    fn response<M: HubMotion>(&self, state: &NewmarkState<T, N>, hub: &HubState<T>) -> Response<T> {
        let mut forced = hub.acceleration;
        let mut torque = if M::AT_REST {
            dot(&self.coupling, &state.restoring)
        } else {
            self.inertial(state, hub.acceleration)
        };
        if !M::LINEAR && self.terms.damping {
            if M::AT_REST {
                torque += dot(&self.drag_torque, &state.gain);
            } else {
                forced += self.alpha * hub.rate;
                torque += self.rigid_drag * hub.rate + dot(&self.drag_torque, &state.gain);
            }
        }
        // Without the terms in θ̇² a linear tick subtracts a zero, which costs less than to ask.
        if !M::AT_REST && (M::LINEAR || self.terms.spin) {
            torque -= self.spin_torque(state, forced, hub.rate);
        }
        if !M::LINEAR && self.terms.gravity {
            torque += self.weight_torque(state, hub);
        }
        Response { torque, tip: self.tip_of(state) }
    }
}

words! {
    [T: Scalar, const N: usize, const W: usize, const AXES: bool] Newmark<T, N, W, AXES>:
        turn, spin, effective, coupling, inertia, twice_per_half, reach, shortening, tip,
        factors, stiffness, terms, numerical_damping, tip_last, awake, tick, damping, drag,
        drag_torque, alpha, rigid_drag, tension, bent, weight, swings, moment, most, gravity,
        tip_slope;
}
