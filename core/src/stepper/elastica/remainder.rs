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

    /// `ωᵢ²`.
    pub(super) fn stiffness(&self, k: usize) -> T {
        self.stiffness[k]
    }

    /// The remainder for `a`, `p̃ = P − bω` and a hub; hub-frame, SI.
    #[inline(always)]
    pub(super) fn evaluate(&self, a: &[T; K], p_tilde: &[T; K], hub: &Hub<T>) -> Value<T, K> {
        let a: [T; K] = core::array::from_fn(|k| within(a[k], self.coordinate_range[k]));
        let omega = hub.rate;
        let mut p_tilde = *p_tilde;
        p_tilde[0] = within(p_tilde[0], self.momentum_range);
        let powers = Powers::new(&a);

        let mut form = Form::ZERO;
        EVEN.each::<K>(|n, e| form.add(powers.of(e), &self.even[n]));
        // z = (p, v₂, …): v₂ = p̃₂ + (what the form says with v₂ in it).
        let (c, d) = (&form.c, &form.d);
        let mut z = p_tilde;
        z[0] += self.coupling[0] * omega;
        let mut lighter = T::ONE;
        if K > 1 {
            let inertia = T::ONE - c[1][1];
            lighter =
                T::ONE / if inertia < T::HALF * T::HALF { T::HALF * T::HALF } else { inertia };
            z[1] = within((p_tilde[1] + c[1][0] * z[0] - d[1] * omega) * lighter, self.rate_range);
        }
        let mut u = [T::ZERO; K];
        u[0] = c[0][0] * z[0] - d[0] * omega;
        if K > 1 {
            u[0] += c[1][0] * z[1];
            u[1] = c[1][0] * z[0] + c[1][1] * z[1] - d[1] * omega;
        }
        let mut rate: [T; K] =
            core::array::from_fn(|k| if k == 0 { p_tilde[0] + u[0] } else { z[k] });
        for k in 2..K {
            u[k] = c[k][0] * z[0] + c[k][1] * z[1] - d[k] * omega;
            rate[k] = p_tilde[k] + u[k];
        }

        // ∂R/∂a, without V's elastic part.
        let mut products = [T::ZERO; 6];
        products[0] = T::HALF * (z[0] * z[0]);
        products[1] = -(omega * z[0]);
        products[2] = T::HALF * (omega * omega);
        if K > 1 {
            products[3] = z[0] * z[1];
            products[4] = T::HALF * (z[1] * z[1]);
            products[5] = -(omega * z[1]);
        }
        let mut gradient = [T::ZERO; K];
        let mut moment = self.moment;
        EVEN.each::<K>(|n, e| {
            let term = &self.even[n];
            let mut energy =
                products[0] * term.c[0][0] + products[1] * term.d[0] + products[2] * term.e;
            if K > 1 {
                energy += products[3] * term.c[1][0]
                    + products[4] * term.c[1][1]
                    + products[5] * term.d[1];
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
        let mut torque = T::ZERO;
        if self.gravity {
            let (y, slope) = self.lateral(&a);
            torque += hub.cos * moment - hub.sin * y;
            for k in 0..K {
                gradient[k] += hub.cos * slope[k];
            }
        }

        // ṫ + αt: the drag in Ṗ and αt cancel but for α times what is proportional to ω̇.
        let mut change = Form::ZERO;
        EVEN.each::<K>(|n, e| {
            let mut risen: Option<T> = None;
            for k in 0..K {
                if let Some(slope) = powers.slope(e, k) {
                    let share = rate[k] * slope;
                    risen = Some(risen.map_or(share, |sum| sum + share));
                }
            }
            change.add(risen.unwrap_or(T::ZERO), &self.even[n]);
        });
        let mut inertia = -(self.e + form.e);
        torque -= change.e * omega;
        // ṗ, v̇₂, …, and the share of each that is proportional to −ω̇.
        let mut faster = [T::ZERO; K];
        let mut jolt = [T::ZERO; K];
        let mut force = [[T::ZERO; 2]; K];
        for k in 0..K {
            let elastic = self.stiffness[k] * a[k] + self.loss[k] * rate[k];
            force[k] = [u[k], -gradient[k] - self.loss[k] * u[k]];
            faster[k] = -(gradient[k] + elastic);
            let lever = if k < 2 { self.coupling[k] + form.d[k] } else { self.coupling[k] };
            if k > 0 {
                jolt[k] = lever;
                faster[k] -= change.d[k] * omega;
                for j in 0..2.min(K) {
                    faster[k] += change.c[k][j.min(k)] * z[j];
                }
                faster[k] += form.c[k][0] * faster[0];
                if k > 1 {
                    faster[k] += form.c[k][1] * faster[1];
                    jolt[k] += form.c[k][1] * jolt[1];
                } else {
                    faster[1] = faster[1] * lighter;
                    jolt[1] = jolt[1] * lighter;
                }
            }
            torque += lever * faster[k] + if k < 2 { change.d[k] * z[k] } else { T::ZERO };
            inertia -= lever * jolt[k];
        }
        torque += self.alpha * inertia * omega;
        Value { force, torque, inertia }
    }

    /// `g(∫ρA Y dx + m_p Y_L)` and its gradient.
    #[inline(always)]
    fn lateral(&self, a: &[T; K]) -> (T, [T; K]) {
        let mut slope = self.linear.map(|term| term.moment);
        let mut y = dot(&slope, a);
        let powers = Powers::new(a);
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

/// `x` within ± `range`.
#[inline(always)]
fn within<T: Scalar>(x: T, range: T) -> T {
    let least = if x < -range { -range } else { x };
    if least > range { range } else { least }
}
