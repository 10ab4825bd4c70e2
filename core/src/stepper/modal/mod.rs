//! Small deflections in modal coordinates: the tick costs the same for any number of elements.

mod bounded;
mod implied;
mod respond;
mod setup;
mod steps;

use super::kicks::Kicks;
use super::oscillator::Oscillator;
use super::terms::Terms;
use super::{FastPaths, HubMotion, KinkMoments, Response, Stepper};
use crate::Error;
use crate::hub::{GravityDirection, HubState};
use crate::math::{Band, Each, HalfForm, Scalar, dot, words};
use crate::motion::Peaks;

/// The lowest `K` modes of a model, 1 to 3, each advanced exactly:
///
/// `äᵢ + (α + βωᵢ²)ȧᵢ + ωᵢ²aᵢ = −bᵢ(θ̈ + αθ̇) − θ̇²(Γa)ᵢ + g sinχ (Πa)ᵢ − g cosχ fᵢ`
///
/// with `Γ = ΦᵀGΦ`, `Π = ΦᵀK_PΦ`, `b = ΦᵀF`, `f = Φᵀf_g`. Exact for any tick where the right-hand
/// side's last three terms, the force, vanish and `θ̈` is a parabola; the force is taken along as a
/// straight line to its value at the end, of second order, in linear ticks at the predicted end.
/// The remaining error is that of the small-deflection model, about 0.1 (w/L)².
///
/// The tick works with `ωa`, `ωȧ` and the force over `ω`: a mode then rests at its force, and the
/// coupling matrices stay symmetric.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Modal<T, const K: usize> {
    modes: [Oscillator<T>; K],
    /// `bᵢ/ωᵢ`: `−ωa` at rest under `u = 1`.
    rest: [T; K],
    /// `Γᵢⱼ/ωᵢωⱼ`.
    spin: Band<T, K, K>,
    /// `½ aᵀΦᵀSΦa`.
    shortening: HalfForm<T, K, K>,
    /// Tip deflection per `ωa`.
    tip: [T; K],
    reach: T,
    /// `bᵢωᵢ`.
    support: [T; K],
    /// `J_h + J_r − bᵀb`: the hub's, and the inertia that the kept modes do not carry.
    inertia: T,
    terms: Terms,
    per_tick: T,
    /// Changes of `ωa` and `ωȧ` per first moment of a kink, see [`kick`](super::oscillator::kick).
    kink: [[T; 2]; K],
    alpha: T,
    /// `α(J_r − bᵀb)` and `βbᵢωᵢ`.
    drag: T,
    loss: [T; K],
    /// `g Πᵢⱼ/ωᵢωⱼ`, half its form, on a carriage 0, `g fᵢ/ωᵢ` and `g S`.
    tension: Band<T, K, K>,
    bent: HalfForm<T, K, K>,
    weight: [T; K],
    /// Levers of the weight about the hub: `g fᵢ/ωᵢ`, and 0 on a carriage.
    lever: [T; K],
    moment: T,
    /// Weights of the squares of how far a mode is from rest and of `ωȧ`: their sum is below 1 when
    /// the arm is to sleep.
    awake: [[T; 2]; K],
    tick: f64,
    /// Largest change of a force over `ω` in a tick, see [`super::MOST_GRAVITY_CHANGE`].
    most: T,
    /// Rate up to which the spin terms may be taken at a predicted state, as in linear ticks,
    /// rad/s.
    fastest: T,
    kicks: [Kicks<T>; K],
    gravity: GravityDirection<T>,
    /// `φ(L)` per unit of `ωa`, rad.
    tip_slope: [T; K],
}

/// Modal coordinates and their rates, times the frequencies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModalState<T, const K: usize> {
    /// `ωa`, m √kg/s.
    pub coordinate: [T; K],
    /// `ωȧ`.
    pub rate: [T; K],
    /// Spin and gravity forces over `ω`.
    force: [T; K],
    /// `Γa` over `ω`.
    softening: [T; K],
}

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// Leaves out every term in θ̇², as [`super::Newmark::without_spin`] does.
    #[must_use]
    pub fn without_spin(mut self) -> Self {
        self.terms.spin = false;
        // Linear ticks do not ask.
        self.spin = Band::ZERO;
        self
    }

    /// `(−θ̇²Γa + g sinχ Πa − g cosχ f, Γa)`, over `ω`.
    #[inline(always)]
    fn force(&self, a: &[T; K], hub: &HubState<T>) -> [[T; K]; 2] {
        let (mut force, mut softening) = ([T::ZERO; K], [T::ZERO; K]);
        if self.terms.spin {
            let rate2 = hub.rate * hub.rate;
            softening = self.spin.times(a);
            force = softening.each(|f| -(rate2 * f));
        }
        if self.terms.gravity {
            let hanging = self.hanging(a, hub);
            for k in 0..K {
                force[k] += hanging[k];
            }
        }
        [force, softening]
    }

    /// `g sinχ Πa − g cosχ f`, over `ω`.
    #[inline(always)]
    fn hanging(&self, a: &[T; K], hub: &HubState<T>) -> [T; K] {
        let mut force = self.tension.times(a);
        for k in 0..K {
            force[k] = hub.sin * force[k] - hub.cos * self.weight[k];
        }
        force
    }
}

impl<T: Scalar, const K: usize> Stepper for Modal<T, K> {
    type Scalar = T;
    type State = ModalState<T, K>;

    const FAST: FastPaths = FastPaths::BOTH;

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<T> {
        &self.gravity
    }

    #[inline(always)]
    fn is_linear_fast(&self, rate: T) -> bool {
        let Terms { spin, gravity, damping } = self.terms;
        !gravity && !damping && (!spin || rate <= self.fastest)
    }

    fn admit(&self, peaks: &Peaks, _: f64) -> Result<(), Error> {
        if self.terms.spin { self.admit_rate(peaks.rate) } else { Ok(()) }
    }

    fn equilibrium(&self, hub: &HubState<T>) -> ModalState<T, K> {
        let mut stiffness = self.tension.map(|x| -(hub.sin * x));
        for k in 0..K {
            stiffness.add(k, k, T::ONE);
        }
        let coordinate = stiffness.factor().solve(&self.weight.each(|f| -(hub.cos * f)));
        let still = HubState { rate: T::ZERO, ..*hub };
        let [force, softening] = self.force(&coordinate, &still);
        ModalState { coordinate, rate: [T::ZERO; K], force, softening }
    }

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut ModalState<T, K>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        if M::LINEAR {
            self.step_linear(state, before, after);
        } else if M::AT_REST {
            self.step_at_rest(state, after);
        } else {
            self.step_any(state, before, after);
        }
    }

    /// `τ = J_h θ̈ + (J_r − bᵀb)u + bᵀ(ä + bu + αȧ) + g cosχ S − g sinχ fᵀa − u aᵀΓa − 2θ̇ aᵀΓȧ
    /// − ½ g cosχ aᵀΠa` with `u = θ̈ + αθ̇`; tip `(r + L − ½ aᵀΦᵀSΦa, ψ(L)ᵀa)`.
    #[inline(always)]
    fn response<M: HubMotion>(&self, state: &ModalState<T, K>, hub: &HubState<T>) -> Response<T> {
        let mut u = if M::AT_REST { T::ZERO } else { hub.acceleration };
        let mut torque = self.inertial(state, u);
        if !M::LINEAR && self.terms.damping {
            if M::AT_REST {
                torque += -dot(&self.loss, &state.rate);
            } else {
                u += self.alpha * hub.rate;
                torque += self.drag * hub.rate - dot(&self.loss, &state.rate);
            }
        }
        // Without the terms in θ̇² a linear tick subtracts a zero, which costs less than to ask.
        if !M::AT_REST && (M::LINEAR || self.terms.spin) {
            torque -= self.spin_torque(state, u, hub.rate);
        }
        if !M::LINEAR && self.terms.gravity {
            torque += self.weight_torque(state, hub);
        }
        Response { torque, tip: self.tip_of(state) }
    }

    fn tip_angle(&self, state: &ModalState<T, K>) -> T {
        dot(&self.tip_slope, &state.coordinate)
    }

    #[inline(always)]
    fn kink(&self, state: &mut ModalState<T, K>, moments: KinkMoments<'_, T>) {
        for k in 0..K {
            let [a, v] = match moments {
                KinkMoments::First(moment) => self.kink[k].each(|kick| kick * moment),
                KinkMoments::All(kink) => self.kicks[k].of(kink),
            };
            state.coordinate[k] += a;
            state.rate[k] += v;
        }
    }

    #[inline(always)]
    fn is_settled(&self, state: &ModalState<T, K>) -> bool {
        let mut swing = T::ZERO;
        for k in 0..K {
            let [far, fast] = self.awake[k];
            let pull = state.force[k] - state.coordinate[k];
            swing += far * pull * pull + fast * state.rate[k] * state.rate[k];
        }
        swing < T::ONE
    }
}

words! {
    [T: Scalar, const K: usize] Modal<T, K>: modes, rest, spin, shortening, tip, reach,
        support, inertia, terms, per_tick, kink, alpha, drag, loss, tension, bent, weight, lever,
        moment, awake, tick, most, fastest, kicks, gravity, tip_slope;
}
