//! Small deflections in modal coordinates: the tick costs the same for any number of elements.

use super::oscillator::{Drive, Oscillator};
use super::{Response, Stepper};
use crate::Error;
use crate::beam::{Model, Modes};
use crate::math::{Band, Scalar, cast, dot};
use crate::motion::Hub;

/// The lowest `K` modes of a model, 1 to 3, each advanced exactly:
///
/// `äᵢ + (α + βωᵢ²)ȧᵢ + ωᵢ²aᵢ = −bᵢ(θ̈ + αθ̇) − θ̇²(Γa)ᵢ + g sinθ (Πa)ᵢ − g cosθ fᵢ`
///
/// with `Γ = ΦᵀGΦ`, `Π = ΦᵀK_PΦ`, `b = ΦᵀF`, `f = Φᵀf_g`. Exact for any tick where the right-hand
/// side's last three terms vanish and `θ̈` is a parabola; they are taken along by an exponential
/// predictor-corrector of second order with one evaluation a tick. What remains is the
/// small-deflection model's own error, about 0.1 (w/L)².
#[derive(Clone, Copy, Debug)]
pub struct Modal<T, const K: usize> {
    tick: f64,
    terms: Terms,
    modes: [Oscillator<T>; K],
    per_tick: T,
    alpha: T,
    /// `ωᵢ²` and `βωᵢ²`.
    stiffness: [T; K],
    loss: [T; K],
    coupling: [T; K],
    /// `Γ`, `g Π` and `ΦᵀSΦ`.
    spin: Band<T, K, K>,
    tension: Band<T, K, K>,
    shortening: Band<T, K, K>,
    /// `g f` and `g S`.
    weight: [T; K],
    moment: T,
    hub_inertia: T,
    /// `J_r − bᵀb`: the inertia that the kept modes do not carry.
    residual_inertia: T,
    reach: T,
    /// Tip deflection per modal coordinate.
    tip: [T; K],
}

#[derive(Clone, Copy, Debug)]
struct Terms {
    spin: bool,
    gravity: bool,
}

/// Modal coordinates and their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModalState<T, const K: usize> {
    /// `a`, m √kg.
    pub coordinate: [T; K],
    /// `ȧ`.
    pub rate: [T; K],
    /// Spin and gravity forces, and their change over the last tick.
    force: [T; K],
    change: [T; K],
}

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// Keeps the lowest `K` modes of the model for steps of `tick` s. f64 inside.
    pub fn new<const N: usize, const W: usize>(
        model: &Model<N, W>,
        tick: f64,
    ) -> Result<Self, Error> {
        const { assert!(1 <= K && K <= 3, "1 to 3 modes") }
        if K > N {
            return Err(Error::DegreesOfFreedom { given: N, needed: K });
        }
        let tick = super::check_tick(tick)?;
        let scene = model.scene();
        let (alpha, beta, gravity) = (scene.damping.alpha, scene.damping.beta, scene.gravity);
        let modes = Modes::of(model);
        let onto =
            |load: &[f64; N]| -> [f64; K] { core::array::from_fn(|k| dot(&modes.shape[k], load)) };
        let between = |matrix: &Band<f64, N, W>, scale: f64| -> Band<T, K, K> {
            let mut reduced = Band::ZERO;
            for i in 0..K {
                let column = onto(&matrix.times(&modes.shape[i]));
                for j in 0..=i {
                    reduced.add(i, j, T::from_f64(scale * column[j]));
                }
            }
            reduced
        };
        let coupling = onto(model.coupling());
        let squared: [f64; K] = core::array::from_fn(|k| modes.frequency[k] * modes.frequency[k]);
        Ok(Self {
            tick,
            terms: Terms { spin: true, gravity: gravity != 0.0 },
            modes: core::array::from_fn(|k| {
                Oscillator::new(modes.frequency[k], alpha, beta, coupling[k], tick)
            }),
            per_tick: T::from_f64(1.0 / tick),
            alpha: T::from_f64(alpha),
            stiffness: cast(&squared),
            loss: cast(&squared.map(|w2| beta * w2)),
            coupling: cast(&coupling),
            spin: between(model.spin(), 1.0),
            tension: between(model.tension(), gravity),
            shortening: between(model.shortening(), 1.0),
            weight: cast(&onto(model.weight()).map(|f| gravity * f)),
            moment: T::from_f64(gravity * scene.first_moment()),
            hub_inertia: T::from_f64(scene.hub.inertia),
            residual_inertia: T::from_f64(scene.rigid_inertia() - dot(&coupling, &coupling)),
            reach: T::from_f64(scene.reach()),
            tip: core::array::from_fn(|k| T::from_f64(modes.shape[k][model.tip()])),
        })
    }

    /// Leaves out every term in θ̇², as [`super::Newmark::without_spin`] does.
    pub fn without_spin(mut self) -> Self {
        self.terms.spin = false;
        self
    }

    /// `−θ̇²Γa + g sinθ Πa − g cosθ f`.
    #[inline(always)]
    fn force(&self, a: &[T; K], hub: &Hub<T>) -> [T; K] {
        let mut force = [T::ZERO; K];
        if self.terms.spin {
            let rate2 = hub.rate * hub.rate;
            force = self.spin.times(a).map(|f| -(rate2 * f));
        }
        if self.terms.gravity {
            let tension = self.tension.times(a);
            for k in 0..K {
                force[k] += hub.sin * tension[k] - hub.cos * self.weight[k];
            }
        }
        force
    }
}

impl<T: Scalar, const K: usize> Stepper for Modal<T, K> {
    type Scalar = T;
    type State = ModalState<T, K>;

    fn tick(&self) -> f64 {
        self.tick
    }

    fn equilibrium(&self, hub: &Hub<T>) -> ModalState<T, K> {
        let mut stiffness = self.tension.map(|x| -(hub.sin * x));
        for k in 0..K {
            stiffness.add(k, k, self.stiffness[k]);
        }
        let coordinate = stiffness.factor().solve(&self.weight.map(|f| -(hub.cos * f)));
        let still = Hub { rate: T::ZERO, ..*hub };
        let force = self.force(&coordinate, &still);
        ModalState { coordinate, rate: [T::ZERO; K], force, change: [T::ZERO; K] }
    }

    #[inline(always)]
    fn step(&self, state: &mut ModalState<T, K>, before: &Hub<T>, after: &Hub<T>) {
        let drive = Drive::between(before, after, self.per_tick, self.alpha);
        let mut y = [[T::ZERO; 2]; K];
        for k in 0..K {
            let (n, change) = ([T::ZERO, state.force[k]], [T::ZERO, state.change[k]]);
            y[k] = self.modes[k].predict([state.coordinate[k], state.rate[k]], &drive, n, change);
        }
        let force = self.force(&y.map(|y| y[0]), after);
        for k in 0..K {
            let change = force[k] - state.force[k];
            let excess = change - state.change[k];
            [state.coordinate[k], state.rate[k]] = self.modes[k].correct(y[k], [T::ZERO, excess]);
            state.change[k] = change;
        }
        state.force = force;
    }

    /// `τ = J_h θ̈ + (J_r − bᵀb)u + bᵀ(ä + bu + αȧ) + g cosθ S − g sinθ fᵀa − u aᵀΓa − 2θ̇ aᵀΓȧ
    /// − ½ g cosθ aᵀΠa` with `u = θ̈ + αθ̇`; tip `(r + L − ½ aᵀΦᵀSΦa, ψ(L)ᵀa)`.
    #[inline(always)]
    fn response(&self, state: &ModalState<T, K>, hub: &Hub<T>) -> Response<T> {
        let (a, rate) = (&state.coordinate, &state.rate);
        let u = hub.acceleration + self.alpha * hub.rate;
        let force = self.force(a, hub);
        let mut torque = self.hub_inertia * hub.acceleration + self.residual_inertia * u;
        for k in 0..K {
            // ä + bu + αȧ: the drive and the drag cancel.
            torque +=
                self.coupling[k] * (force[k] - self.stiffness[k] * a[k] - self.loss[k] * rate[k]);
        }
        if self.terms.spin {
            let spin = self.spin.times(a);
            torque -= u * dot(&spin, a) + T::TWO * hub.rate * dot(&spin, rate);
        }
        if self.terms.gravity {
            let bent = dot(&self.tension.times(a), a);
            torque += hub.cos * (self.moment - T::HALF * bent) - hub.sin * dot(&self.weight, a);
        }
        let shortened = T::HALF * dot(&self.shortening.times(a), a);
        Response { torque, tip: [self.reach - shortened, dot(&self.tip, a)] }
    }
}
