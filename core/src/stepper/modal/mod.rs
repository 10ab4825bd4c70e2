//! Small deflections in modal coordinates: the tick costs the same for any number of elements.

mod bounded;

use super::oscillator::{Drive, Oscillator, check_turns, jolt};
use super::{Response, Stepper};
use crate::Error;
use crate::beam::{Model, Modes};
use crate::math::{Band, HalfForm, Scalar, cast, dot};
use crate::motion::{Hub, Peaks};

/// The lowest `K` modes of a model, 1 to 3, each advanced exactly:
///
/// `äᵢ + (α + βωᵢ²)ȧᵢ + ωᵢ²aᵢ = −bᵢ(θ̈ + αθ̇) − θ̇²(Γa)ᵢ + g sinθ (Πa)ᵢ − g cosθ fᵢ`
///
/// with `Γ = ΦᵀGΦ`, `Π = ΦᵀK_PΦ`, `b = ΦᵀF`, `f = Φᵀf_g`. Exact for any tick where the right-hand
/// side's last three terms, the force, vanish and `θ̈` is a parabola; the force is taken along as a
/// straight line to its value at the end, of second order, within plain cubics at the predicted end.
/// What remains is the small-deflection model's own error, about 0.1 (w/L)².
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
    /// What a kink of the motion inside a tick moves `ωa` and `ωȧ` by, see [`jolt`].
    jolt: [[T; 2]; K],
    alpha: T,
    /// `α(J_r − bᵀb)` and `βbᵢωᵢ`.
    drag: T,
    loss: [T; K],
    /// `g Πᵢⱼ/ωᵢωⱼ`, half its form, `g fᵢ/ωᵢ` and `g S`.
    tension: Band<T, K, K>,
    bent: HalfForm<T, K, K>,
    weight: [T; K],
    moment: T,
    /// Weights of the squares of how far a mode is from rest and of `ωȧ`: their sum is below 1 when the
    /// arm is to sleep.
    awake: [[T; 2]; K],
    tick: f64,
    /// Rate up to which the spin terms may be taken at a predicted state, as within plain cubics, rad/s.
    fastest: T,
}

#[derive(Clone, Copy, Debug)]
struct Terms {
    spin: bool,
    gravity: bool,
    damping: bool,
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
        let omega: [f64; K] = core::array::from_fn(|k| modes.frequency[k]);
        check_turns(&omega, alpha, beta, tick)?;
        let shape: [[f64; N]; K] = core::array::from_fn(|k| modes.shape[k].map(|x| x / omega[k]));
        let onto = |load: &[f64; N]| -> [f64; K] { shape.map(|shape| dot(&shape, load)) };
        let between =
            |matrix: &Band<f64, N, W>| -> Band<T, K, K> { matrix.onto(&shape).map(T::from_f64) };
        let rest = onto(model.coupling());
        let coupling: [f64; K] = core::array::from_fn(|k| rest[k] * omega[k]);
        let support: [f64; K] = core::array::from_fn(|k| coupling[k] * omega[k]);
        let residual = scene.rigid_inertia() - dot(&coupling, &coupling);
        let tension = between(&model.tension().scaled(gravity));
        let spin: Band<T, K, K> = between(model.spin());
        let mut modal = Self {
            modes: core::array::from_fn(|k| {
                Oscillator::new(omega[k], alpha, beta, support[k], tick)
                    .forced_by(omega[k] * omega[k])
            }),
            rest: cast(&rest),
            fastest: T::ZERO,
            spin,
            shortening: between(model.shortening()).half_form(),
            tip: core::array::from_fn(|k| T::from_f64(shape[k][model.tip()])),
            reach: T::from_f64(scene.reach()),
            support: cast(&support),
            inertia: T::from_f64(scene.hub.inertia + residual),
            terms: Terms {
                spin: true,
                gravity: gravity != 0.0,
                damping: alpha != 0.0 || beta != 0.0,
            },
            per_tick: T::from_f64(1.0 / tick),
            jolt: core::array::from_fn(|k| jolt(omega[k], alpha, beta, support[k], tick)),
            alpha: T::from_f64(alpha),
            drag: T::from_f64(alpha * residual),
            loss: cast(&support.map(|b| beta * b)),
            tension,
            bent: tension.half_form(),
            weight: cast(&onto(model.weight()).map(|f| gravity * f)),
            moment: T::from_f64(gravity * scene.first_moment()),
            awake: core::array::from_fn(|k| {
                let floor = super::sleep_floor::<f64>(scene.link.length, shape[k][model.tip()]);
                [floor, omega[k] * floor].map(|floor| T::from_f64(1.0 / (floor * floor)))
            }),
            tick,
        };
        modal.fastest = T::from_f64(modal.fastest_plain(&omega));
        if modal.terms.gravity {
            modal.admit_gravity(gravity)?;
        }
        Ok(modal)
    }

    /// Leaves out every term in θ̇², as [`super::Newmark::without_spin`] does.
    pub fn without_spin(mut self) -> Self {
        self.terms.spin = false;
        // Plain ticks do not ask.
        self.spin = Band::ZERO;
        self
    }

    /// `(−θ̇²Γa + g sinθ Πa − g cosθ f, Γa)`, over `ω`.
    #[inline(always)]
    fn force(&self, a: &[T; K], hub: &Hub<T>) -> [[T; K]; 2] {
        let (mut force, mut softening) = ([T::ZERO; K], [T::ZERO; K]);
        if self.terms.spin {
            let rate2 = hub.rate * hub.rate;
            softening = self.spin.times(a);
            force = softening.map(|f| -(rate2 * f));
        }
        if self.terms.gravity {
            let hanging = self.hanging(a, hub);
            for k in 0..K {
                force[k] += hanging[k];
            }
        }
        [force, softening]
    }
}

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// The change of the force over a step that agrees with the coordinates it leads to, from that
    /// at the predicted ones: `(I + S D) e = c`, `S = θ̇²Γ − g sinθ Π`, `D` what a mode moves by for a
    /// change of its force by 1.
    ///
    /// Taken at the predicted coordinates the force would feed modes that turn more than half a turn
    /// a tick: by `½r²` a tick and less, `r` the share of `S` in the mode's stiffness. So the step is
    /// the same forwards and backwards, and neither feeds nor damps.
    #[inline(always)]
    fn implied(&self, mut change: [T; K], hub: &Hub<T>) -> [T; K] {
        let rate2 = if self.terms.spin { hub.rate * hub.rate } else { T::ZERO };
        let mut stiff = self.spin.scaled(rate2);
        if self.terms.gravity {
            stiff = stiff.plus(-hub.sin, &self.tension);
        }
        let mut a: [[T; K]; K] = core::array::from_fn(|i| {
            core::array::from_fn(|j| {
                let unit = if i == j { T::ONE } else { T::ZERO };
                unit + stiff.get(i, j) * self.modes[j].ramp(0, T::ONE)
            })
        });
        // Elimination without pivoting: the diagonal is 1 and more but for weights near buckling.
        for p in 0..K {
            let inverse = T::ONE / a[p][p];
            for i in p + 1..K {
                let factor = a[i][p] * inverse;
                for j in p..K {
                    a[i][j] -= factor * a[p][j];
                }
                change[i] -= factor * change[p];
            }
            a[p][p] = inverse;
        }
        for p in (0..K).rev() {
            for j in p + 1..K {
                change[p] -= a[p][j] * change[j];
            }
            change[p] = change[p] * a[p][p];
        }
        change
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

    fn admit(&self, peaks: &Peaks, _: f64) -> Result<(), Error> {
        if self.terms.spin { self.admit_rate(peaks.rate) } else { Ok(()) }
    }

    fn equilibrium(&self, hub: &Hub<T>) -> ModalState<T, K> {
        let mut stiffness = self.tension.map(|x| -(hub.sin * x));
        for k in 0..K {
            stiffness.add(k, k, T::ONE);
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
            let [force, _] = self.force(&y.map(|y| y[0]), after);
            let change = self.implied(core::array::from_fn(|k| force[k] - state.force[k]), after);
            for k in 0..K {
                y[k] = self.modes[k].correct_forced(y[k], change[k]);
                state.force[k] += change[k];
            }
            state.softening = self.spin.times(&y.map(|y| y[0]));
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

    const PLAIN: bool = true;

    #[inline(always)]
    fn is_plain(&self, rate: T) -> bool {
        let Terms { spin, gravity, damping } = self.terms;
        !gravity && !damping && (!spin || rate <= self.fastest)
    }

    #[inline(always)]
    fn advance_in_cubic(
        &self,
        state: &mut ModalState<T, K>,
        before: &Hub<T>,
        after: &Hub<T>,
    ) -> Response<T> {
        let gained = after.acceleration - before.acceleration;
        let mut y = [[T::ZERO; 2]; K];
        let (mut predicted, mut driven) = ([T::ZERO; K], [T::ZERO; K]);
        for k in 0..K {
            let (rest, force) = (self.rest[k], state.force[k]);
            y[k] = [state.coordinate[k], state.rate[k]];
            y[k] = self.modes[k].rotate(y[k], rest, before.acceleration, force);
            driven[k] = rest * gained + force;
            predicted[k] = y[k][0] - self.modes[k].ramp(0, rest * gained);
        }
        let softening = self.spin.times(&predicted);
        let square = after.rate * after.rate;
        let force = softening.map(|f| -(square * f));
        let (mut coordinate, mut rate) = (state.coordinate, state.rate);
        for k in 0..K {
            let change = force[k] - driven[k];
            coordinate[k] = y[k][0] + self.modes[k].ramp(0, change);
            rate[k] = y[k][1] + self.modes[k].ramp(1, change);
        }
        let next = ModalState { coordinate, rate, force, softening };
        *state = next;
        let torque = self.inertial(&next, after.acceleration);
        Response {
            torque: torque - self.spin_torque(&next, after.acceleration, after.rate),
            tip: self.tip_of(&next),
        }
    }

    #[inline(always)]
    fn swing(&self, state: &mut ModalState<T, K>, hub: &Hub<T>) {
        let mut y = [[T::ZERO; 2]; K];
        for k in 0..K {
            y[k] = [state.coordinate[k], state.rate[k]];
            y[k] = self.modes[k].swing(y[k], state.force[k]);
        }
        if self.terms.gravity {
            let hanging = self.hanging(&y.map(|y| y[0]), hub);
            let change = self.implied(core::array::from_fn(|k| hanging[k] - state.force[k]), hub);
            for k in 0..K {
                y[k] = self.modes[k].correct_forced(y[k], change[k]);
                state.force[k] += change[k];
            }
        }
        state.coordinate = y.map(|y| y[0]);
        state.rate = y.map(|y| y[1]);
    }

    #[inline(always)]
    fn response_at_rest(&self, state: &ModalState<T, K>, hub: &Hub<T>) -> Response<T> {
        let mut torque = self.inertial(state, T::ZERO);
        if self.terms.damping {
            torque += -dot(&self.loss, &state.rate);
        }
        if self.terms.gravity {
            torque += self.weight_torque(state, hub);
        }
        Response { torque, tip: self.tip_of(state) }
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

    /// `τ = J_h θ̈ + (J_r − bᵀb)u + bᵀ(ä + bu + αȧ) + g cosθ S − g sinθ fᵀa − u aᵀΓa − 2θ̇ aᵀΓȧ
    /// − ½ g cosθ aᵀΠa` with `u = θ̈ + αθ̇`; tip `(r + L − ½ aᵀΦᵀSΦa, ψ(L)ᵀa)`.
    #[inline(always)]
    fn response(&self, state: &ModalState<T, K>, hub: &Hub<T>) -> Response<T> {
        let mut u = hub.acceleration;
        let mut torque = self.inertial(state, u);
        if self.terms.damping {
            u += self.alpha * hub.rate;
            torque += self.drag * hub.rate - dot(&self.loss, &state.rate);
        }
        if self.terms.spin {
            torque -= self.spin_torque(state, u, hub.rate);
        }
        if self.terms.gravity {
            torque += self.weight_torque(state, hub);
        }
        Response { torque, tip: self.tip_of(state) }
    }
}

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// `(J_h + J_r − bᵀb)θ̈ + bᵀ(ä + bu + αȧ + βω²ȧ)`: the drive and the drag cancel, and the force less
    /// the spring is left.
    #[inline(always)]
    fn inertial(&self, state: &ModalState<T, K>, acceleration: T) -> T {
        let mut pull = state.coordinate;
        for k in 0..K {
            pull[k] -= state.force[k];
        }
        self.inertia * acceleration - dot(&self.support, &pull)
    }

    /// `u aᵀΓa + 2θ̇ aᵀΓȧ`.
    #[inline(always)]
    fn spin_torque(&self, state: &ModalState<T, K>, u: T, rate: T) -> T {
        let twice = rate + rate;
        let mut arm = state.coordinate;
        for k in 0..K {
            arm[k] = u * arm[k] + twice * state.rate[k];
        }
        dot(&state.softening, &arm)
    }

    /// `g cosθ S − g sinθ fᵀa − ½ g cosθ aᵀΠa`.
    #[inline(always)]
    fn weight_torque(&self, state: &ModalState<T, K>, hub: &Hub<T>) -> T {
        let a = &state.coordinate;
        hub.cos * (self.moment - self.bent.at(a)) - hub.sin * dot(&self.weight, a)
    }

    /// `g sinθ Πa − g cosθ f`, over `ω`.
    #[inline(always)]
    fn hanging(&self, a: &[T; K], hub: &Hub<T>) -> [T; K] {
        let mut force = self.tension.times(a);
        for k in 0..K {
            force[k] = hub.sin * force[k] - hub.cos * self.weight[k];
        }
        force
    }

    #[inline(always)]
    fn tip_of(&self, state: &ModalState<T, K>) -> [T; 2] {
        let a = &state.coordinate;
        [self.reach - self.shortening.at(a), dot(&self.tip, a)]
    }
}
