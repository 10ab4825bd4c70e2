//! A model's lowest modes, made ready for ticks.

use super::Modal;
use crate::Error;
use crate::math::{Band, Each, Scalar, array, cast, dot};
use crate::model::{LowestModes, Model};
use crate::stepper::kicks::Kicks;
use crate::stepper::oscillator::{Oscillator, check_turns, kick};
use crate::stepper::terms::Terms;
use crate::stepper::{MOST_GRAVITY_CHANGE, check_tick, sleep_floor};

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// Keeps the lowest `K` modes of the model for steps of `tick` s. f64 inside.
    pub fn new<const N: usize, const W: usize>(
        model: &Model<N, W>,
        tick: f64,
    ) -> Result<Self, Error> {
        let tick = Self::admit(model, tick)?;
        let scene = model.scene();
        let (alpha, gravity) = (scene.damping.alpha, scene.in_plane_gravity());
        let LowestModes { frequency: omega, shape } = LowestModes::<K, N>::of(model);
        let beta: [f64; K] = stiffness_damping(model, &shape);
        check_turns(&omega, alpha, &beta, tick)?;
        let onto = |load: &[f64; N]| -> [f64; K] { shape.each(|shape| dot(&shape, load)) };
        let between =
            |matrix: &Band<f64, N, W>| -> Band<T, K, K> { matrix.onto(&shape).map(T::from_f64) };
        let rest = onto(model.coupling());
        let coupling: [f64; K] = array(|k| rest[k] * omega[k]);
        let support: [f64; K] = array(|k| coupling[k] * omega[k]);
        let residual = model.rigid_inertia() - dot(&coupling, &coupling);
        let tension = between(&model.tension().scaled(gravity));
        let tip = shape.each(|shape| shape[model.tip()]);
        let weight = onto(model.weight()).each(|f| gravity * f);
        let swings = if scene.mount.is_linear() { 0.0 } else { 1.0 };
        let modal = Self {
            modes: core::array::from_fn(|k| {
                Oscillator::new(omega[k], alpha, beta[k], support[k], tick)
                    .forced_by(omega[k] * omega[k])
            }),
            rest: cast(&rest),
            fastest: T::ZERO,
            spin: between(model.spin()),
            shortening: between(model.shortening()).half_form(),
            tip: cast(&tip),
            reach: T::from_f64(scene.reach()),
            support: cast(&support),
            inertia: T::from_f64(scene.hub.inertia + residual),
            terms: Terms::of(scene),
            per_tick: T::from_f64(1.0 / tick),
            kink: array(|k| kick(omega[k], alpha, beta[k], support[k], tick)),
            kicks: core::array::from_fn(|k| {
                Kicks::new(omega[k], alpha, beta[k], coupling[k], tick).rates_by(omega[k])
            }),
            alpha: T::from_f64(alpha),
            drag: T::from_f64(alpha * residual),
            loss: array(|k| T::from_f64(beta[k] * support[k])),
            tension,
            bent: tension.map(|pull| T::from_f64(swings) * pull).half_form(),
            weight: cast(&weight),
            lever: cast(&weight.each(|f| swings * f)),
            moment: T::from_f64(gravity * model.first_moment()),
            awake: array(|k| settled_weights(omega[k], sleep_floor(scene.link.length, tip[k]))),
            tick,
            tip_slope: array(|k| T::from_f64(dot(&shape[k], model.tip_slope()))),
            most: T::from_f64(MOST_GRAVITY_CHANGE * scene.link.length / tip[0].abs()),
            gravity: scene.gravity_direction(),
        };
        modal.bounded(&omega, gravity)
    }

    /// Refuses a model that has too few modes or a carrier, and a tick out of range.
    fn admit<const N: usize, const W: usize>(model: &Model<N, W>, tick: f64) -> Result<f64, Error> {
        const { assert!(1 <= K && K <= 3, "1 to 3 modes") }
        if K > N {
            return Err(Error::DegreesOfFreedom { given: N, needed: K });
        }
        let tick = check_tick(tick)?;
        model.scene().check_no_carrier()?;
        Ok(tick)
    }

    /// Finds the fastest linear tick; refuses a gravity that the tick length does not allow.
    fn bounded(mut self, omega: &[f64; K], gravity: f64) -> Result<Self, Error> {
        self.fastest = T::from_f64(self.fastest_linear_rate(omega));
        if self.terms.gravity {
            self.admit_gravity(gravity)?;
        }
        Ok(self)
    }
}

/// `βₖ` of each mode, s: `β`, and the joint's own damping by the mode's share in its strain energy.
fn stiffness_damping<const K: usize, const N: usize, const W: usize>(
    model: &Model<N, W>,
    shape: &[[f64; N]; K],
) -> [f64; K] {
    let joint = model.joint_damping();
    shape.each(|shape| model.scene().damping.beta + dot(&shape, &joint.times(&shape)))
}

/// Weights of the squares of `ωa` and of `ωȧ` of a mode that is settled below the coordinate
/// `floor`.
fn settled_weights<T: Scalar>(omega: f64, floor: f64) -> [T; 2] {
    [floor, omega * floor].each(|floor| T::from_f64(1.0 / (floor * floor)))
}
