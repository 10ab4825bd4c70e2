//! Nonlinear terms of the exact kinematics, as the centres that the linear oscillators turn about.

use super::polynomial::{Axial, Even, Local, Odd, Order, Shape};
use super::reach::Reach;
use crate::hub::HubState;
use crate::math::{Each, Scalar, array, cast, dot, words};
use crate::model::rod::monomials::{EVEN, ODD};
use crate::model::{Expansion, Rod};
use crate::scene::AxisKind;

/// The expansion in the tick's scalar and in scaled coordinates, gravity multiplied in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nonlinear<T, const K: usize> {
    /// `Cₖ₁`, `dₖ` and `e` without their values at rest.
    c: [Even<T, K>; K],
    d: [Even<T, K>; K],
    e: Even<T, K>,
    /// `Cₖ₂` without its value at rest, `k > 1`.
    second: [Axial<T>; K],
    /// `b = d(0)`, `J_h − e(0)` and `J_h`.
    coupling: [T; K],
    inertia_at_rest: T,
    hub_inertia: T,
    /// `g ∫ρA (X, Y) dx`, payload included; on a carriage `moment_at_rest` is the whole weight.
    moment_at_rest: T,
    moment: (Even<T, K>, Odd<T, K>),
    tip_at_rest: T,
    tip: (Even<T, K>, Odd<T, K>),
    /// `ωₖ`, `βωₖ²`.
    omega: [T; K],
    loss: [T; K],
    /// `α` and `α/ωₖ`.
    alpha: T,
    drag: [T; K],
    /// `Dₖⱼ/ωₖ` of the joint's own damping, which couples the modes; 0 for `j = k`, which `loss`
    /// has.
    joint: [[T; K]; K],
    gravity: bool,
    damping: bool,
    joint_damping: bool,
    /// The hub turns, so that what holds the arm against gravity depends on its shape.
    turns: bool,
    /// Keeps the arguments bounded.
    reach: Reach<T, K>,
}

/// The nonlinear terms at one instant.
pub(super) struct Value<T, const K: usize> {
    /// The negative of what each mode turns about.
    pub offset: [[T; 2]; K],
    /// `ṫ + αt + ∂V/∂θ + J_h θ̈` but for what is proportional to θ̈.
    pub torque: T,
    /// Inertia: the factor of θ̈ in that torque, kg m².
    pub inertia: T,
}

/// `C`, `d`, `e` at one shape.
struct Forms<T, const K: usize> {
    c: [Local<T, K>; K],
    d: [Local<T, K>; K],
    e: Local<T, K>,
    /// `Cₖ₂` and half its slope along the first mode.
    second: [(T, T); K],
}

/// Momentum and velocities of the arm.
struct Flow<T, const K: usize> {
    omega: T,
    /// `p` and `v₂`: the third mode's velocity acts on nothing.
    p: T,
    v2: T,
    /// `ȧ = p̃ + u`.
    u: [T; K],
    rate: [T; K],
    /// One over the second mode's inertia.
    lightness: T,
}

impl<T: Scalar, const K: usize> Nonlinear<T, K> {
    pub(super) fn new(rod: &Rod<K>, expansion: &Expansion<T, K>, range: &[f64; K]) -> Self {
        let f = T::from_f64;
        let (scene, omega) = (rod.scene(), rod.frequency());
        let g = scene.in_plane_gravity();
        let beta = rod.stiffness_damping();
        let (terms, odd) = (&expansion.even, &expansion.odd);
        let scale: [f64; K] = array(|k| omega[k] * range[k]);
        let even = |of: &dyn Fn(usize) -> f64| Even::new(&EVEN, &scale, of);
        let linear = &expansion.linear;
        Self {
            c: core::array::from_fn(|k| even(&|n| terms[n].c[k][0].to_f64())),
            d: core::array::from_fn(|k| even(&|n| terms[n].d[k].to_f64())),
            e: even(&|n| terms[n].e.to_f64()),
            second: core::array::from_fn(|k| {
                Axial::of(&even(&|n| if K > 1 { terms[n].c[k][1 % K].to_f64() } else { 0.0 }))
            }),
            coupling: cast(&expansion.coupling),
            inertia_at_rest: f(scene.hub.inertia - expansion.e),
            hub_inertia: f(scene.hub.inertia),
            moment_at_rest: f(g * match scene.mount.axis {
                AxisKind::Rotary => expansion.moment,
                AxisKind::Linear => rod.straight().inertia + scene.hub.inertia,
            }),
            moment: (
                even(&|n| g * terms[n].moment.to_f64()),
                Odd::new(
                    &ODD,
                    &scale,
                    |k| g * linear[k].moment / omega[k],
                    |n| g * odd[n].moment.to_f64(),
                ),
            ),
            tip_at_rest: f(expansion.tip),
            tip: (
                even(&|n| terms[n].tip.to_f64()),
                Odd::new(&ODD, &scale, |k| linear[k].tip / omega[k], |n| odd[n].tip.to_f64()),
            ),
            omega: cast(omega),
            loss: array(|k| f(beta[k] * omega[k] * omega[k])),
            alpha: f(scene.damping.alpha),
            drag: cast(&omega.each(|omega| scene.damping.alpha / omega)),
            joint: array(|k| cast(&rod.joint_damping()[k].each(|coupling| coupling / omega[k]))),
            joint_damping: scene.damping.joint > 0.0,
            gravity: g != 0.0,
            damping: !scene.damping.is_zero(),
            turns: !scene.mount.is_linear(),
            reach: Reach::new(omega, range),
        }
    }

    /// True if there is gravity.
    #[inline(always)]
    pub(super) fn feels_gravity(&self) -> bool {
        self.gravity
    }

    /// True if the hub turns.
    #[inline(always)]
    pub(super) fn turns(&self) -> bool {
        self.turns
    }

    /// True if there is damping.
    #[inline(always)]
    pub(super) fn is_damped(&self) -> bool {
        self.damping
    }

    /// `ωₖ`.
    pub(super) fn omega(&self, k: usize) -> T {
        self.omega[k]
    }

    /// The nonlinear terms for `y = (ωa, p̃)` and a hub. Without `ALL` there is neither damping nor
    /// gravity; without `TURNS` the hub rests.
    #[inline(always)]
    pub(super) fn evaluate<const ALL: bool, const TURNS: bool>(
        &self,
        y: &[[T; 2]; K],
        hub: &HubState<T>,
    ) -> Value<T, K> {
        let (x, p) = self.reach.of(y);
        let shape = Shape::new(x);
        let forms = self.forms(&shape);
        let flow = self.flow::<TURNS>(&forms, &p, hub.rate);
        let mut gradient = gradient::<T, K, TURNS>(&forms, &flow);
        let mut weight = T::ZERO;
        if ALL && self.gravity {
            weight = self.weigh(&shape, hub, &mut gradient);
        }
        if ALL && K > 1 && self.joint_damping {
            for (gradient, row) in gradient.iter_mut().zip(&self.joint) {
                *gradient += dot(row, &flow.rate);
            }
        }
        let (torque, inertia) = self.torque::<ALL, TURNS>(&shape, &forms, &flow, &gradient);
        let torque = if ALL { torque + weight } else { torque };
        let offset = array(|k| {
            let drag = if ALL && self.damping { self.drag[k] * flow.u[k] } else { T::ZERO };
            [if ALL { gradient[k] - drag } else { gradient[k] }, flow.u[k]]
        });
        Value { offset, torque, inertia }
    }

    #[inline(always)]
    fn forms(&self, shape: &Shape<T, K>) -> Forms<T, K> {
        let order = |k| if k == 0 { Order::Second } else { Order::First };
        Forms {
            c: core::array::from_fn(|k| self.c[k].at(shape, order(k))),
            d: core::array::from_fn(|k| self.d[k].at(shape, order(k))),
            e: self.e.at(shape, Order::Second),
            second: array(|k| self.second[k].at(shape)),
        }
    }

    /// Momentum and velocities out of `p̃`.
    #[inline(always)]
    fn flow<const TURNS: bool>(
        &self,
        forms: &Forms<T, K>,
        p_tilde: &[T; K],
        omega: T,
    ) -> Flow<T, K> {
        let Forms { c, d, second, .. } = forms;
        let p = if TURNS { p_tilde[0] + self.coupling[0] * omega } else { p_tilde[0] };
        let along = |k: usize| {
            let along = c[k].value * p;
            if TURNS { along - d[k].value * omega } else { along }
        };
        let mut u = [T::ZERO; K];
        u[0] = along(0);
        let (mut v2, mut lightness) = (T::ZERO, T::ONE);
        if K > 1 {
            // v₂ = p̃₂ + u₂, and u₂ holds C₂₂v₂.
            lightness = T::ONE / at_least(T::ONE - second[1].0, LEAST_INERTIA);
            v2 = (p_tilde[1] + along(1)) * lightness;
            u[0] += c[1].value * v2;
            u[1] = v2 - p_tilde[1];
        }
        if K > 2 {
            u[2] = along(2) + second[2].0 * v2;
        }
        let rate = array(|k| if k == 1 { v2 } else { p_tilde[k] + u[k] });
        Flow { omega, p, v2, u, rate, lightness }
    }

    /// Adds `∂V/∂x` of the weight to the gradient; returns `∂V/∂θ`, which on a carriage is the same
    /// in every shape.
    #[inline(always)]
    fn weigh(&self, shape: &Shape<T, K>, hub: &HubState<T>, gradient: &mut [T; K]) -> T {
        let (along, across) = (self.moment.0.at(shape, Order::Second), self.moment.1.slope(shape));
        let twice = hub.sin + hub.sin;
        for k in 0..K {
            gradient[k] += twice * along.half_slope[k] + hub.cos * across[k];
        }
        if !self.turns {
            return hub.cos * self.moment_at_rest;
        }
        hub.cos * (self.moment_at_rest + along.value) - hub.sin * self.moment.1.value(shape)
    }

    /// Returns `ṫ + αt` without its part proportional to `θ̈`, and the factor of `θ̈` in that part.
    ///
    /// `t = d·z − ωe` changes with `ṗ`, `v̇₂`, `v̇₃`, and these with `Ṗ`: the levers `M⁻¹h` of the
    /// momenta, last mode first, gather both.
    #[inline(always)]
    fn torque<const ALL: bool, const TURNS: bool>(
        &self,
        shape: &Shape<T, K>,
        forms: &Forms<T, K>,
        flow: &Flow<T, K>,
        gradient: &[T; K],
    ) -> (T, T) {
        let Forms { c, d, e, second } = forms;
        let Flow { omega, p, v2, .. } = *flow;
        let mut lever = self.coupling;
        let mut inertia = self.inertia_at_rest - e.value;
        // Half the slope of t along each mode, levers held.
        let mut rise: [T; K] = array(|k| {
            let rise = p * d[0].half_slope[k];
            if TURNS { rise - omega * e.half_slope[k] } else { rise }
        });
        lever[0] += d[0].value;
        if K > 2 {
            // The third mode's lever is the straight link's, as its inertia is.
            let last = lever[2];
            inertia -= last * last;
            let by = [last * p, last * v2, last * omega];
            for k in 0..K {
                rise[k] += by[0] * c[2].half_slope[k];
                if TURNS {
                    rise[k] -= by[2] * d[2].half_slope[k];
                }
            }
            rise[0] += by[1] * second[2].1;
            lever[0] += c[2].value * last;
            lever[1] += second[2].0 * last;
        }
        if K > 1 {
            let full = self.coupling[1] + d[1].value;
            lever[1] = (lever[1] + d[1].value) * flow.lightness;
            let own = lever[1];
            inertia -= own * full;
            let by = [own * p, own * v2, if TURNS { v2 - own * omega } else { v2 }];
            for k in 0..K {
                rise[k] += by[0] * c[1].half_slope[k] + by[2] * d[1].half_slope[k];
            }
            rise[0] += by[1] * second[1].1;
            lever[0] += c[1].value * own;
        }
        let mut torque = T::ZERO;
        for k in 0..K {
            let mut share =
                (rise[k] + rise[k]) * flow.rate[k] - lever[k] * (shape.x[k] + gradient[k]);
            share = self.omega[k] * share;
            if ALL && self.damping {
                share -= lever[k] * (self.loss[k] * flow.rate[k]);
            }
            if k == 0 { torque = share } else { torque += share }
        }
        if ALL && TURNS && self.damping {
            // The drag in Ṗ and αt cancel but for this.
            torque += self.alpha * (inertia - self.hub_inertia) * omega;
        }
        (torque, inertia)
    }

    /// The tip `(X, Y)` in the hub frame.
    #[inline(always)]
    pub(super) fn tip(&self, x: [T; K]) -> [T; 2] {
        let shape = Shape::new(x);
        let along = self.tip.0.at(&shape, Order::Second).value;
        [self.tip_at_rest + along, self.tip.1.value(&shape)]
    }
}

/// `∂R/∂x` without the elastic energy.
#[inline(always)]
fn gradient<T: Scalar, const K: usize, const TURNS: bool>(
    forms: &Forms<T, K>,
    flow: &Flow<T, K>,
) -> [T; K] {
    let Forms { c, d, e, second } = forms;
    let Flow { omega, p, v2, .. } = *flow;
    // R's products of p, v₂ and ω.
    let twice = p + p;
    let of_first = [p * p, twice * omega, omega * omega];
    let mut gradient: [T; K] = array(|k| {
        let own = of_first[0] * c[0].half_slope[k];
        if !TURNS {
            return own;
        }
        own - of_first[1] * d[0].half_slope[k] + of_first[2] * e.half_slope[k]
    });
    if K > 1 {
        let of_second = [twice * v2, (v2 + v2) * omega, v2 * v2];
        for k in 0..K {
            let own = of_second[0] * c[1].half_slope[k];
            gradient[k] += if TURNS { own - of_second[1] * d[1].half_slope[k] } else { own };
        }
        gradient[0] += of_second[2] * second[1].1;
    }
    gradient
}

/// The second mode's inertia, 1 in the straight link, is not taken to be less.
const LEAST_INERTIA: f64 = 0.25;

#[inline(always)]
fn at_least<T: Scalar>(x: T, least: f64) -> T {
    let least = T::from_f64(least);
    if x < least { least } else { x }
}

words! {
    [T: Scalar, const K: usize] Nonlinear<T, K>: c, d, e, second, coupling,
        inertia_at_rest, hub_inertia, moment_at_rest, moment, tip_at_rest, tip, omega, loss, alpha, drag, joint, gravity, damping,
        joint_damping, turns, reach;
}
