//! What the exact kinematics add to the linear oscillators.

use crate::beam::monomials::{EVEN, MAX_EVEN, MAX_ODD, ODD, Powers};
use crate::beam::{Even, Expansion, Odd, Rod};
use crate::math::{Scalar, cast, dot};
use crate::motion::Hub;

/// The expansion in the tick's scalar, gravity multiplied in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Remainder<T, const K: usize> {
    even: [Even<T, K>; MAX_EVEN],
    odd: [Odd<T>; MAX_ODD],
    linear: [Odd<T>; K],
    /// `b = d(0)`, `e(0)`.
    coupling: [T; K],
    e: T,
    moment: T,
    tip: T,
    /// `ωᵢ²`, `βωᵢ²`.
    stiffness: [T; K],
    loss: [T; K],
    alpha: T,
    gravity: bool,
    /// Is there damping?
    damping: bool,
    /// Where `a`, the first mode's `p̃` and the second's rate are clipped.
    coordinate_range: [T; K],
    momentum_range: T,
    rate_range: T,
}

/// The remainder at one instant.
pub(super) struct Value<T, const K: usize> {
    /// `(nₐ, n_p)` of each mode.
    pub force: [[T; 2]; K],
    /// `ṫ + αt + ∂V/∂θ` but for what is proportional to θ̈.
    pub torque: T,
    /// What is.
    pub inertia: T,
}

/// How the arm moves.
struct Flow<T, const K: usize> {
    /// `(p, v₂)`; a third is not used.
    z: [T; K],
    /// `Cz − dω` without its value at `a = 0`: `ȧ = p̃ + u`.
    u: [T; K],
    /// `ȧ`.
    rate: [T; K],
    /// One over the second mode's inertia.
    lightness: T,
}

/// `C`, `d`, `e` without their values at `a = 0`, or their rates of change.
#[derive(Clone, Copy)]
struct Form<T, const K: usize> {
    c: [[T; K]; K],
    d: [T; K],
    e: T,
}

impl<T: Scalar, const K: usize> Form<T, K> {
    const ZERO: Self = Self { c: [[T::ZERO; K]; K], d: [T::ZERO; K], e: T::ZERO };

    #[inline(always)]
    fn add(&mut self, mu: T, term: &Even<T, K>) {
        for i in 0..K {
            // The third mode's own inertia is the straight link's.
            for j in 0..=i.min(1) {
                self.c[i][j] += mu * term.c[i][j];
            }
            self.d[i] += mu * term.d[i];
        }
        self.e += mu * term.e;
    }
}

impl<T: Scalar, const K: usize> Remainder<T, K> {
    pub(super) fn new(rod: &Rod<K>, expansion: &Expansion<K>, range: &[f64; K]) -> Self {
        let f = T::from_f64;
        let scene = rod.scene();
        let g = scene.gravity;
        let squared: [f64; K] = rod.frequency().map(|omega| omega * omega);
        let odd = |term: Odd<f64>| Odd { moment: f(g * term.moment), tip: f(term.tip) };
        Self {
            even: expansion.even.map(|term| Even {
                c: term.c.map(|row| row.map(f)),
                d: term.d.map(f),
                e: f(term.e),
                moment: f(g * term.moment),
                tip: f(term.tip),
            }),
            odd: expansion.odd.map(odd),
            linear: expansion.linear.map(odd),
            coupling: cast(&expansion.coupling),
            e: f(expansion.e),
            moment: f(g * expansion.moment),
            tip: f(expansion.tip),
            stiffness: cast(&squared),
            loss: cast(&squared.map(|w2| scene.damping.beta * w2)),
            alpha: f(scene.damping.alpha),
            gravity: g != 0.0,
            damping: scene.damping.alpha != 0.0 || scene.damping.beta != 0.0,
            coordinate_range: range.map(|a| f(CLIP * a)),
            momentum_range: f(CLIP * rod.frequency()[0] * range[0]),
            rate_range: f(CLIP * rod.frequency()[1.min(K - 1)] * range[1.min(K - 1)]),
        }
    }

    /// Is there gravity?
    #[inline(always)]
    pub(super) fn is_directed(&self) -> bool {
        self.gravity
    }

    /// Is there damping?
    #[inline(always)]
    pub(super) fn is_damped(&self) -> bool {
        self.damping
    }

    /// `ωᵢ²`.
    pub(super) fn stiffness(&self, k: usize) -> T {
        self.stiffness[k]
    }

    /// The remainder for `a`, `p̃ = P − bω` and a hub; hub-frame, SI.
    #[inline(always)]
    pub(super) fn evaluate(&self, a: &[T; K], p_tilde: &[T; K], hub: &Hub<T>) -> Value<T, K> {
        let a: [T; K] = core::array::from_fn(|k| within(a[k], self.coordinate_range[k]));
        let powers = Powers::new(&a);
        let mut form = Form::ZERO;
        EVEN.each::<K>(|n, e| form.add(powers.of(e), &self.even[n]));
        let flow = self.flow(&form, p_tilde, hub.rate);
        let (gradient, weight) = self.gradient(&a, &powers, &flow, hub);
        let force = core::array::from_fn(|k| {
            let loss = if self.damping { self.loss[k] * flow.u[k] } else { T::ZERO };
            [flow.u[k], -(gradient[k] + loss)]
        });
        let pull = core::array::from_fn(|k| {
            let loss = if self.damping { self.loss[k] * flow.rate[k] } else { T::ZERO };
            -(gradient[k] + self.stiffness[k] * a[k] + loss)
        });
        let (torque, inertia) = self.torque(&powers, &form, &flow, &pull, hub.rate);
        Value { force, torque: torque + weight, inertia }
    }

    /// Momentum and velocities out of `p̃`.
    #[inline(always)]
    fn flow(&self, form: &Form<T, K>, p_tilde: &[T; K], omega: T) -> Flow<T, K> {
        let (c, d) = (&form.c, &form.d);
        let mut z = *p_tilde;
        z[0] = within(p_tilde[0], self.momentum_range);
        let mut rate = z;
        z[0] += self.coupling[0] * omega;
        let mut u = [T::ZERO; K];
        let mut lightness = T::ONE;
        if K > 1 {
            // v₂ = p̃₂ + u₂, and u₂ holds c₂₂v₂.
            lightness = T::ONE / at_least(T::ONE - c[1][1], LEAST_INERTIA);
            let v = (p_tilde[1] + c[1][0] * z[0] - d[1] * omega) * lightness;
            z[1] = within(v, self.rate_range);
            rate[1] = z[1];
        }
        for k in 0..K {
            u[k] = c[k][0] * z[0] - d[k] * omega;
            if K > 1 {
                u[k] += c[k.max(1)][k.min(1)] * z[1];
            }
            if k != 1 {
                rate[k] += u[k];
            }
        }
        Flow { z, u, rate, lightness }
    }

    /// `∂R/∂a` without the elastic energy, and `∂V/∂θ`.
    #[inline(always)]
    fn gradient(
        &self,
        a: &[T; K],
        powers: &Powers<T, K>,
        flow: &Flow<T, K>,
        hub: &Hub<T>,
    ) -> ([T; K], T) {
        let (z, omega) = (&flow.z, hub.rate);
        // R's products of z and ω, half of the squares.
        let of_first = [T::HALF * (z[0] * z[0]), omega * z[0], T::HALF * (omega * omega)];
        let of_second =
            if K > 1 { [z[0] * z[1], T::HALF * (z[1] * z[1]), omega * z[1]] } else { [T::ZERO; 3] };
        let (mut gradient, mut moment) = ([T::ZERO; K], self.moment);
        EVEN.each::<K>(|n, e| {
            let term = &self.even[n];
            let mut energy =
                of_first[0] * term.c[0][0] - of_first[1] * term.d[0] + of_first[2] * term.e;
            if K > 1 {
                energy += of_second[0] * term.c[1][0] + of_second[1] * term.c[1][1]
                    - of_second[2] * term.d[1];
            }
            if self.gravity {
                energy += hub.sin * term.moment;
                moment += powers.of(e) * term.moment;
            }
            for k in 0..K {
                if let Some(slope) = powers.slope(e, k) {
                    gradient[k] += energy * slope;
                }
            }
        });
        if !self.gravity {
            return (gradient, T::ZERO);
        }
        let (y, slope) = self.lateral(a, powers);
        for k in 0..K {
            gradient[k] += hub.cos * slope[k];
        }
        (gradient, hub.cos * moment - hub.sin * y)
    }

    /// `ṫ + αt` but for what is proportional to `θ̈`, and what is. `pull` is `−∂R/∂a` and the loss:
    /// the drag in `Ṗ` and `αt` cancel but for `α` times what is proportional to `θ̈`.
    #[inline(always)]
    fn torque(
        &self,
        powers: &Powers<T, K>,
        form: &Form<T, K>,
        flow: &Flow<T, K>,
        pull: &[T; K],
        omega: T,
    ) -> (T, T) {
        let z = &flow.z;
        let mut change = Form::ZERO;
        EVEN.each::<K>(|n, e| {
            let mut rise = None;
            for k in 0..K {
                if let Some(slope) = powers.slope(e, k) {
                    let share = flow.rate[k] * slope;
                    rise = Some(rise.map_or(share, |sum: T| sum + share));
                }
            }
            change.add(rise.unwrap_or(T::ZERO), &self.even[n]);
        });
        let mut torque = -(change.e * omega);
        let mut inertia = -(self.e + form.e);
        // ṗ, v̇₂, v̇₃, and the share of each that is proportional to −θ̈.
        let (mut faster, mut share) = (*pull, [T::ZERO; K]);
        for k in 0..K {
            // Where the third mode is bent far its straight inertia and a lever that grows would
            // not belong together.
            let lever = self.coupling[k] + if k < 2 { form.d[k] } else { T::ZERO };
            if k > 0 {
                share[k] = lever;
                faster[k] += change.c[k][0] * z[0] + change.c[k][1] * z[1] - change.d[k] * omega;
                faster[k] += form.c[k][0] * faster[0];
            }
            if k == 1 {
                faster[1] = faster[1] * flow.lightness;
                share[1] = share[1] * flow.lightness;
            } else if k > 1 {
                faster[k] += form.c[k][1] * faster[1];
                share[k] += form.c[k][1] * share[1];
            }
            torque += lever * faster[k];
            if k < 2 {
                torque += change.d[k] * z[k];
            }
            inertia -= lever * share[k];
        }
        if self.damping {
            torque += self.alpha * inertia * omega;
        }
        (torque, inertia)
    }

    /// `g(∫ρA Y dx + m_p Y_L)` and its gradient.
    #[inline(always)]
    fn lateral(&self, a: &[T; K], powers: &Powers<T, K>) -> (T, [T; K]) {
        let mut slope = self.linear.map(|term| term.moment);
        let mut y = dot(&slope, a);
        ODD.each::<K>(|n, e| {
            let weight = self.odd[n].moment;
            y += weight * powers.of(e);
            for k in 0..K {
                if let Some(rise) = powers.slope(e, k) {
                    slope[k] += weight * rise;
                }
            }
        });
        (y, slope)
    }

    /// The tip `(X, Y)` in the hub frame.
    #[inline(always)]
    pub(super) fn tip(&self, a: &[T; K]) -> [T; 2] {
        let powers = Powers::new(a);
        let (mut x, mut y) = (self.tip, T::ZERO);
        EVEN.each::<K>(|n, e| x += self.even[n].tip * powers.of(e));
        for k in 0..K {
            y += self.linear[k].tip * a[k];
        }
        ODD.each::<K>(|n, e| y += self.odd[n].tip * powers.of(e));
        [x, y]
    }
}

/// Beyond this multiple of the fitted range the remainder's arguments are clipped.
const CLIP: f64 = 1.5;

/// The second mode's inertia, 1 in the straight link, is not taken to be less.
const LEAST_INERTIA: f64 = 0.25;

#[inline(always)]
fn at_least<T: Scalar>(x: T, least: f64) -> T {
    let least = T::from_f64(least);
    if x < least { least } else { x }
}

/// `x` within ± `range`.
#[inline(always)]
fn within<T: Scalar>(x: T, range: T) -> T {
    let least = if x < -range { -range } else { x };
    if least > range { range } else { least }
}
