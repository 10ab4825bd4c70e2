//! What the exact kinematics add to the linear oscillators.

use crate::beam::{Even, Expansion, MAX_EVEN, MAX_ODD, Odd, Rod, is_even_pair, is_odd_triple};
use crate::math::{Scalar, cast, dot};
use crate::motion::Hub;

/// The expansion in the tick's scalar, gravity multiplied in.
#[derive(Clone, Copy, Debug)]
pub(super) struct Remainder<T, const K: usize> {
    even: [Even<T, K>; MAX_EVEN],
    odd: [Odd<T>; MAX_ODD],
    linear: [Odd<T>; K],
    /// `b = g(0)`, `s(0)`.
    coupling: [T; K],
    s: T,
    moment: T,
    tip: T,
    /// `ωᵢ²`, `βωᵢ²`.
    stiffness: [T; K],
    loss: [T; K],
    alpha: T,
    gravity: bool,
    /// Where `a` and `p̃` are clipped.
    coordinate_range: [T; K],
    momentum_range: [T; K],
}

/// The remainder at one instant.
pub(super) struct Value<T, const K: usize> {
    /// `(nₐ, n_p)` of each mode.
    pub force: [[T; 2]; K],
    /// `ṫ + αt + ∂V/∂θ` but for `−s θ̈`.
    pub torque: T,
    /// `−s`.
    pub inertia: T,
    /// `g`.
    pub lever: [T; K],
}

/// What the monomial `μ` multiplies: `½(p·u − ωt)` is its share of the energy.
struct Form<T, const K: usize> {
    /// `Cp − dω`.
    u: [T; K],
    /// `d·p − eω`.
    t: T,
    /// `½(p·u − ωt)`, and gravity's `g sinθ` share.
    energy: T,
}

impl<T: Scalar, const K: usize> Remainder<T, K> {
    /// Modes that have a momentum; a third one has a velocity.
    pub(super) const MOMENTA: usize = if K < 2 { K } else { 2 };

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
            s: f(expansion.s),
            moment: f(g * expansion.moment),
            tip: f(expansion.tip),
            stiffness: cast(&squared),
            loss: cast(&squared.map(|w2| scene.damping.beta * w2)),
            alpha: f(scene.damping.alpha),
            gravity: g != 0.0,
            coordinate_range: range.map(|a| f(CLIP * a)),
            momentum_range: core::array::from_fn(|k| f(CLIP * rod.frequency()[k] * range[k])),
        }
    }

    /// `ωᵢ²`.
    pub(super) fn stiffness(&self, k: usize) -> T {
        self.stiffness[k]
    }

    /// The remainder for `a`, `p̃` and a hub; hub-frame, SI.
    #[inline(always)]
    pub(super) fn evaluate(&self, a: &[T; K], p_tilde: &[T; K], hub: &Hub<T>) -> Value<T, K> {
        let a: [T; K] = core::array::from_fn(|k| within(a[k], self.coordinate_range[k]));
        let mut p_tilde = *p_tilde;
        for k in 0..Self::MOMENTA {
            p_tilde[k] = within(p_tilde[k], self.momentum_range[k]);
        }
        let mut p = p_tilde;
        for k in 0..K {
            p[k] += self.coupling[k] * hub.rate;
        }
        // r: G p − gω beyond the linear; gradient of the energy; g and s themselves.
        let mut r = [T::ZERO; K];
        let mut gradient = [T::ZERO; K];
        let (mut g, mut s, mut moment) = (self.coupling, self.s, self.moment);
        let mut t = [T::ZERO; MAX_EVEN];
        let mut collect = |n: usize, mu: T| -> T {
            let term = &self.even[n];
            let form = self.form(term, &p, hub);
            for k in 0..K {
                r[k] += mu * form.u[k];
                g[k] += mu * term.d[k];
            }
            s += mu * term.e;
            moment += mu * term.moment;
            t[n] = form.t;
            form.energy
        };
        let mut n = 0;
        for i in 0..K {
            for j in i..K {
                if is_even_pair(i, j) {
                    let energy = collect(n, a[i] * a[j]);
                    gradient[i] += energy * a[j];
                    gradient[j] += energy * a[i];
                    n += 1;
                }
            }
        }
        let square = a[0] * a[0];
        let quartic_slope = (T::TWO + T::TWO) * (square * a[0]);
        gradient[0] += quartic_slope * collect(n, square * square);

        let mut torque = T::ZERO;
        if self.gravity {
            let (y, slope) = self.lateral(&a);
            torque += hub.cos * moment - hub.sin * y;
            for k in 0..K {
                gradient[k] += hub.cos * slope[k];
            }
        }
        // ṫ = g·ṗ + (∇μ·ȧ) t − s θ̈, with αt: the drag in ṗ and αg·p cancel.
        let rate: [T; K] = core::array::from_fn(|k| p_tilde[k] + r[k]);
        let mut n = 0;
        for i in 0..K {
            for j in i..K {
                if is_even_pair(i, j) {
                    torque += (rate[i] * a[j] + a[i] * rate[j]) * t[n];
                    n += 1;
                }
            }
        }
        for k in Self::MOMENTA..K {
            s += g[k] * self.coupling[k];
            torque += self.alpha * g[k] * r[k];
        }
        torque += quartic_slope * rate[0] * t[n];
        let force = core::array::from_fn(|k| {
            torque -= g[k] * (gradient[k] + self.stiffness[k] * a[k] + self.loss[k] * rate[k]);
            [r[k], -gradient[k] - self.loss[k] * r[k]]
        });
        torque -= self.alpha * s * hub.rate;
        Value { force, torque, inertia: -s, lever: g }
    }

    #[inline(always)]
    fn form(&self, term: &Even<T, K>, p: &[T; K], hub: &Hub<T>) -> Form<T, K> {
        let over = |f: &[T; K], x: &[T; K]| {
            let mut sum = f[0] * x[0];
            for k in 1..Self::MOMENTA {
                sum += f[k] * x[k];
            }
            sum
        };
        let u: [T; K] = core::array::from_fn(|k| over(&term.c[k], p) - term.d[k] * hub.rate);
        let t = over(&term.d, p) - term.e * hub.rate;
        let mut energy = T::HALF * (over(p, &u) - hub.rate * t);
        if self.gravity {
            energy += hub.sin * term.moment;
        }
        Form { u, t, energy }
    }

    /// `g(∫ρA Y dx + m_p Y_L)` and its gradient.
    #[inline(always)]
    fn lateral(&self, a: &[T; K]) -> (T, [T; K]) {
        let mut slope = self.linear.map(|term| term.moment);
        let mut y = dot(&slope, a);
        let mut n = 0;
        for i in 0..K {
            for j in i..K {
                for k in j..K {
                    if is_odd_triple(i, j, k) {
                        let c = self.odd[n].moment;
                        y += c * (a[i] * a[j] * a[k]);
                        slope[i] += c * (a[j] * a[k]);
                        slope[j] += c * (a[i] * a[k]);
                        slope[k] += c * (a[i] * a[j]);
                        n += 1;
                    }
                }
            }
        }
        (y, slope)
    }

    /// The tip `(X, Y)` in the hub frame.
    #[inline(always)]
    pub(super) fn tip(&self, a: &[T; K]) -> [T; 2] {
        let (mut x, mut n) = (self.tip, 0);
        for i in 0..K {
            for j in i..K {
                if is_even_pair(i, j) {
                    x += self.even[n].tip * (a[i] * a[j]);
                    n += 1;
                }
            }
        }
        let square = a[0] * a[0];
        x += self.even[n].tip * (square * square);
        let (mut y, mut n) = (T::ZERO, 0);
        for i in 0..K {
            y += self.linear[i].tip * a[i];
            for j in i..K {
                for k in j..K {
                    if is_odd_triple(i, j, k) {
                        y += self.odd[n].tip * (a[i] * a[j] * a[k]);
                        n += 1;
                    }
                }
            }
        }
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
