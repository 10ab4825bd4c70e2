//! Small deflections in modal coordinates: the tick costs the same for any number of elements.

use super::oscillator::{Drive, Oscillator, check_turns, jolt};
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
/// side's last three terms, the force, vanish and `θ̈` is a parabola; the force is taken along as a
/// straight line to its value at the predicted end, of second order with one evaluation a tick.
/// What remains is the small-deflection model's own error, about 0.1 (w/L)².
#[derive(Clone, Copy, Debug)]
pub struct Modal<T, const K: usize> {
    tick: f64,
    terms: Terms,
    per_tick: T,
    modes: [Oscillator<T>; K],
    /// What a kink of the motion inside a tick moves `a` and `ȧ` by, see [`jolt`].
    jolt: [[T; 2]; K],
    /// `Γ` and `ΦᵀSΦ`.
    spin: Band<T, K, K>,
    shortening: Band<T, K, K>,
    /// Tip deflection per modal coordinate.
    tip: [T; K],
    reach: T,
    coupling: [T; K],
    /// `bᵢωᵢ²`.
    support: [T; K],
    /// `J_h + J_r − bᵀb`: the hub's, and the inertia that the kept modes do not carry.
    inertia: T,
    alpha: T,
    /// `α(J_r − bᵀb)` and `βbᵢωᵢ²`.
    drag: T,
    loss: [T; K],
    /// `g Π`, `g f` and `g S`.
    tension: Band<T, K, K>,
    weight: [T; K],
    moment: T,
    /// `ωᵢ²`.
    stiffness: [T; K],
    /// Coordinates below which a mode sleeps, and their rates.
    asleep: [[T; 2]; K],
}

#[derive(Clone, Copy, Debug)]
struct Terms {
    spin: bool,
    gravity: bool,
    damping: bool,
}

/// Modal coordinates and their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModalState<T, const K: usize> {
    /// `a`, m √kg.
    pub coordinate: [T; K],
    /// `ȧ`.
    pub rate: [T; K],
    /// Spin and gravity forces.
    force: [T; K],
    /// `Γa`; both at the coordinates that the tick predicted.
    softening: [T; K],
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
        check_turns(&modes.frequency[..K], alpha, beta, tick)?;
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
        let support: [f64; K] = core::array::from_fn(|k| coupling[k] * squared[k]);
        let residual = scene.rigid_inertia() - dot(&coupling, &coupling);
        Ok(Self {
            tick,
            terms: Terms {
                spin: true,
                gravity: gravity != 0.0,
                damping: alpha != 0.0 || beta != 0.0,
            },
            per_tick: T::from_f64(1.0 / tick),
            modes: core::array::from_fn(|k| {
                Oscillator::new(modes.frequency[k], alpha, beta, coupling[k], tick)
            }),
            jolt: core::array::from_fn(|k| {
                jolt(modes.frequency[k], alpha, beta, coupling[k], tick)
            }),
            spin: between(model.spin(), 1.0),
            shortening: between(model.shortening(), 1.0),
            tip: core::array::from_fn(|k| T::from_f64(modes.shape[k][model.tip()])),
            reach: T::from_f64(scene.reach()),
            coupling: cast(&coupling),
            support: cast(&support),
            inertia: T::from_f64(scene.hub.inertia + residual),
            alpha: T::from_f64(alpha),
            drag: T::from_f64(alpha * residual),
            loss: cast(&support.map(|b| beta * b)),
            tension: between(model.tension(), gravity),
            weight: cast(&onto(model.weight()).map(|f| gravity * f)),
            moment: T::from_f64(gravity * scene.first_moment()),
            asleep: core::array::from_fn(|k| {
                let tip = modes.shape[k][model.tip()];
                let floor = super::sleep_floor::<f64>(scene.link.length, tip);
                [floor, modes.frequency[k] * floor].map(T::from_f64)
            }),
            stiffness: cast(&squared),
        })
    }

    /// Leaves out every term in θ̇², as [`super::Newmark::without_spin`] does.
    pub fn without_spin(mut self) -> Self {
        self.terms.spin = false;
        self
    }

    /// `(−θ̇²Γa + g sinθ Πa − g cosθ f, Γa)`.
    #[inline(always)]
    fn force(&self, a: &[T; K], hub: &Hub<T>) -> [[T; K]; 2] {
        let (mut force, mut softening) = ([T::ZERO; K], [T::ZERO; K]);
        if self.terms.spin {
            let rate2 = hub.rate * hub.rate;
            softening = self.spin.times(a);
            force = softening.map(|f| -(rate2 * f));
        }
        if self.terms.gravity {
            let tension = self.tension.times(a);
            for k in 0..K {
                force[k] += hub.sin * tension[k] - hub.cos * self.weight[k];
            }
        }
        [force, softening]
    }
}

impl<T: Scalar, const K: usize> Stepper for Modal<T, K> {
    type Scalar = T;
    type State = ModalState<T, K>;

    fn tick(&self) -> f64 {
        self.tick
    }

    #[inline(always)]
    fn is_directed(&self) -> bool {
        self.terms.gravity
    }

    fn equilibrium(&self, hub: &Hub<T>) -> ModalState<T, K> {
        let mut stiffness = self.tension.map(|x| -(hub.sin * x));
        for k in 0..K {
            stiffness.add(k, k, self.stiffness[k]);
        }
        let coordinate = stiffness.factor().solve(&self.weight.map(|f| -(hub.cos * f)));
        let still = Hub { rate: T::ZERO, ..*hub };
        let [force, softening] = self.force(&coordinate, &still);
        ModalState { coordinate, rate: [T::ZERO; K], force, softening }
    }

    #[inline(always)]
    fn step(&self, state: &mut ModalState<T, K>, before: &Hub<T>, after: &Hub<T>) {
        let drive = if self.terms.damping {
            Drive::between(before, after, self.per_tick, self.alpha)
        } else {
            Drive::undamped(before, after, self.per_tick)
        };
        let mut y = [[T::ZERO; 2]; K];
        for k in 0..K {
            y[k] = [state.coordinate[k], state.rate[k]];
            y[k] = self.modes[k].predict_forced(y[k], &drive, state.force[k]);
        }
        if self.terms.spin || self.terms.gravity {
            let [force, softening] = self.force(&y.map(|y| y[0]), after);
            for k in 0..K {
                let change = force[k] - state.force[k];
                y[k] = self.modes[k].correct_forced(y[k], change);
            }
            (state.force, state.softening) = (force, softening);
        }
        state.coordinate = y.map(|y| y[0]);
        state.rate = y.map(|y| y[1]);
    }

    fn shift(&self, state: &mut ModalState<T, K>, moment: T) {
        for k in 0..K {
            state.coordinate[k] += self.jolt[k][0] * moment;
            state.rate[k] += self.jolt[k][1] * moment;
        }
    }

    #[inline(always)]
    fn is_settled(&self, state: &ModalState<T, K>) -> bool {
        (0..K).all(|k| {
            let ([near, slow], stiffness) = (self.asleep[k], self.stiffness[k]);
            let rate = state.rate[k];
            let pull = state.force[k] - stiffness * state.coordinate[k];
            rate < slow && -rate < slow && pull < stiffness * near && -pull < stiffness * near
        })
    }

    /// `τ = J_h θ̈ + (J_r − bᵀb)u + bᵀ(ä + bu + αȧ) + g cosθ S − g sinθ fᵀa − u aᵀΓa − 2θ̇ aᵀΓȧ
    /// − ½ g cosθ aᵀΠa` with `u = θ̈ + αθ̇`; tip `(r + L − ½ aᵀΦᵀSΦa, ψ(L)ᵀa)`.
    #[inline(always)]
    fn response(&self, state: &ModalState<T, K>, hub: &Hub<T>) -> Response<T> {
        let (a, rate) = (&state.coordinate, &state.rate);
        let mut u = hub.acceleration;
        // bᵀ(ä + bu + αȧ): the drive and the drag cancel.
        let mut torque = self.inertia * u - dot(&self.support, a);
        if self.terms.damping {
            u += self.alpha * hub.rate;
            torque += self.drag * hub.rate - dot(&self.loss, rate);
        }
        if self.terms.spin || self.terms.gravity {
            torque += dot(&self.coupling, &state.force);
        }
        if self.terms.spin {
            let twice = T::TWO * hub.rate;
            let mut arm = *a;
            for k in 0..K {
                arm[k] = u * a[k] + twice * rate[k];
            }
            torque -= dot(&state.softening, &arm);
        }
        if self.terms.gravity {
            let bent = self.tension.half_form(a);
            torque += hub.cos * (self.moment - bent) - hub.sin * dot(&self.weight, a);
        }
        let tip = [self.reach - self.shortening.half_form(a), dot(&self.tip, a)];
        Response { torque, tip }
    }
}
