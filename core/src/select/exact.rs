//! The exact rod in all its modes, integrated in small steps: what the rungs are judged by.

use crate::hub::{GravityDirection, HubState};
use crate::math::{Band, Each, Scalar, array, cast, dot, round};
use crate::model::{LINK_STATIONS, POINTS, Rod};

/// The stations of the link, and the payload.
const STATIONS: usize = LINK_STATIONS + 1;

/// Most steps a tick.
const MAX_STEPS: f64 = 128.0;

/// Steps of a whole flight beyond which a step is made no shorter than the second mode asks for,
/// nor than a [`FEWEST`]th of a tick. On a host they take a quarter of a second.
const STEPS: f64 = 60_000.0;

/// Steps a tick that are affordable however long the flight.
const FEWEST: f64 = 32.0;

/// Largest turn of a mode in a step, rad, and largest decay; the method tolerates 2.8. The second
/// highest of six modes is held to it; the third then turns by 0.4, and its phase errs by 1e-4 of
/// that.
pub(super) const MOST: f64 = 1.5;

/// Distance from rest, fraction of L, below which an arm whose hub rests is left as it is.
const STILL: f64 = 1e-7;

/// Halvings of the distance to the equilibrium.
const EQUILIBRIUM_STEPS: usize = 60;

/// Coordinates `a` and rates `v` in the modes of [`Rod`].
#[derive(Clone, Copy)]
pub(super) struct Shape<T, const MODES: usize> {
    a: [T; MODES],
    v: [T; MODES],
}

/// `φ = Σ aₖψₖ`, `X = r + ∫cos φ`, `Y = ∫sin φ` by the angle at eight points, Lagrange's
/// equations without an expansion in `a`, classical Runge-Kutta of fourth order.
///
/// The steps are made for the second highest mode, or where a flight of so many ticks would take
/// more than [`STEPS`] of them, for as high a mode as it affords, the second in most cases. Every
/// mode that the steps do not resolve, or whose decay they do not, is given as much more inertia as
/// makes it bearable: it still follows its load, many periods a tick.
///
/// Hub torque and clamp moment are those of the inertia forces, drag and weight about the axis and
/// about the clamp, `τ = J_hθ̈ + ∫(X a_Y − Y a_X) dm + J_p α_L`, as the host's reference rod has
/// them.
pub(super) struct Exact<T, const MODES: usize> {
    steps_a_tick: f64,
    /// h, s.
    tick: f64,
    slope: [[T; POINTS]; MODES],
    tip_slope: [T; MODES],
    /// From the clamp to each station, length multiplied in.
    integral: [[T; POINTS]; STATIONS],
    /// From the clamp to the tip, likewise.
    to_tip: [T; POINTS],
    /// Of the stations.
    mass: [T; STATIONS],
    /// `J_p`.
    twist: T,
    stiffness: [T; MODES],
    /// `βω²`.
    loss: [T; MODES],
    /// Added inertia.
    ballast: [T; MODES],
    radius: T,
    alpha: T,
    gravity: T,
    direction: GravityDirection<T>,
    /// `J_h`, or the carriage's mass.
    hub: T,
    /// The hub is a carriage: it moves the clamp across the link and does not turn it.
    carried: bool,
    /// Rate of the carrier, rad/s.
    carrier: T,
    /// Tip deflection per unit of `aₖ` and `ωₖ⁻¹` of it, fractions of L: what a rate amounts to.
    swing: [[T; 2]; MODES],
}

/// Loads on the arm at one instant.
#[derive(Clone, Copy)]
pub(super) struct Load<T> {
    /// Hub torque, N m, or force on the carriage, N.
    pub torque: T,
    /// Bending moment at the clamp, N m.
    pub moment: T,
}

/// Lagrange's equations `M ä = f` at one instant, and what follows from `ä`.
struct Forces<T, const MODES: usize> {
    mass: Band<T, MODES, MODES>,
    force: [T; MODES],
    /// The tip in the hub frame, m.
    tip: [T; 2],
    /// Moment about the axis and force across the hub at the clamp but for `ä`, and per unit of it.
    fixed: [T; 2],
    moving: [[T; MODES]; 2],
}

/// Integrands along the rod, at the Gauss points.
struct Integrands<T, const MODES: usize> {
    /// `∂X/∂a` and `∂Y/∂a`.
    x_slope: [[T; POINTS]; MODES],
    y_slope: [[T; POINTS]; MODES],
    /// X, Y and the centripetal parts of their second derivatives.
    rest: [[T; POINTS]; 4],
}

impl<T: Scalar, const MODES: usize> Forces<T, MODES> {
    fn acceleration(&self) -> [T; MODES] {
        self.mass.factor().solve(&self.force)
    }
}

impl<T: Scalar, const MODES: usize> Exact<T, MODES> {
    /// For `ticks` ticks of `tick` s.
    pub fn new(rod: &Rod<MODES>, tick: f64, ticks: f64) -> Self {
        let (scene, link) = (rod.scene(), rod.stations());
        let length = scene.link.length;
        let squared = rod.frequency().each(|omega| omega * omega);
        let beta = rod.stiffness_damping();
        let loss: [f64; MODES] = array(|k| beta[k] * squared[k]);
        let wanted = |mode: usize| {
            let fastest = rod.frequency()[mode].max(loss[mode]);
            libm::ceil(tick * fastest / MOST).clamp(1.0, MAX_STEPS)
        };
        let affordable = wanted(1).min(FEWEST).max(libm::floor(STEPS / ticks.max(1.0)));
        let steps = wanted(MODES - 2).min(affordable);
        let step = tick / steps;
        Self {
            steps_a_tick: steps,
            tick,
            slope: rod.slope().each(|slope| cast(&slope)),
            tip_slope: cast(rod.tip_slope()),
            integral: array(|s| {
                let row = link.running.get(s).unwrap_or(&link.to_payload);
                cast(&row.each(|weight| length * weight))
            }),
            to_tip: cast(&link.to_tip.each(|weight| length * weight)),
            mass: array(|s| {
                let own = link.weights.get(s).map(|weight| link.mass * weight);
                T::from_f64(own.unwrap_or(scene.payload.mass))
            }),
            twist: round(scene.payload.inertia),
            stiffness: cast(&squared),
            loss: cast(&loss),
            ballast: array(|k| {
                let (turn, decay) = (squared[k] * step * step, loss[k] * step);
                T::from_f64((turn / (MOST * MOST)).max(decay / MOST).max(1.0) - 1.0)
            }),
            radius: round(scene.hub.radius),
            alpha: round(scene.damping.alpha),
            gravity: round(scene.in_plane_gravity()),
            direction: scene.gravity_direction(),
            hub: round(scene.hub.inertia),
            carried: scene.mount.is_linear(),
            carrier: round(scene.mount.carrier),
            swing: array(|k| {
                let swing = rod.tip_swing()[k].abs() / length;
                [T::from_f64(swing / rod.frequency()[k]), T::from_f64(swing / squared[k])]
            }),
        }
    }

    /// h, s.
    pub fn tick(&self) -> T {
        T::from_f64(self.tick)
    }

    /// Steps that a tick takes.
    pub fn steps_a_tick(&self) -> f64 {
        self.steps_a_tick
    }

    /// Evaluates the integrands along the rod, at the Gauss points.
    #[inline(always)]
    fn integrands(&self, shape: &Shape<T, MODES>) -> Integrands<T, MODES> {
        let Shape { a, v } = shape;
        let mut x_slope = [[T::ZERO; POINTS]; MODES];
        let mut y_slope = [[T::ZERO; POINTS]; MODES];
        let mut rest = [[T::ZERO; POINTS]; 4];
        let turn = T::from_f64(1.0 / core::f64::consts::TAU);
        for p in 0..POINTS {
            let (mut angle, mut rate) = (T::ZERO, T::ZERO);
            for k in 0..MODES {
                angle += self.slope[k][p] * a[k];
                rate += self.slope[k][p] * v[k];
            }
            let (sin, cos) = (angle * turn).sin_cos_turns();
            for k in 0..MODES {
                x_slope[k][p] = -(self.slope[k][p] * sin);
                y_slope[k][p] = self.slope[k][p] * cos;
            }
            let square = rate * rate;
            (rest[0][p], rest[1][p]) = (cos, sin);
            (rest[2][p], rest[3][p]) = (-(square * cos), -(square * sin));
        }
        Integrands { x_slope, y_slope, rest }
    }

    /// Assembles Lagrange's equations.
    fn forces(&self, shape: &Shape<T, MODES>, hub: &HubState<T>) -> Forces<T, MODES> {
        let Shape { a, v } = shape;
        let Integrands { x_slope, y_slope, rest } = self.integrands(shape);
        let alpha = self.alpha;
        let (sin, cos) = self.direction.seen_from(hub);
        let (mut weight, mut omega, mut faster) =
            ([self.gravity * sin, self.gravity * cos], hub.rate + self.carrier, hub.acceleration);
        if self.carried {
            weight[1] += faster + alpha * omega;
            (omega, faster) = (T::ZERO, T::ZERO);
        }
        let turning = alpha * (dot(&self.tip_slope, v) + omega) + faster;
        let mut mass = Band::ZERO;
        let mut force = [T::ZERO; MODES];
        for k in 0..MODES {
            mass.add(k, k, self.ballast[k]);
            force[k] = -(self.stiffness[k] * a[k] + self.loss[k] * v[k])
                - self.twist * self.tip_slope[k] * turning;
            for j in 0..=k {
                mass.add(k, j, self.twist * self.tip_slope[k] * self.tip_slope[j]);
            }
        }
        let tip = [dot(&self.to_tip, &rest[0]) + self.radius, dot(&self.to_tip, &rest[1])];
        let mut fixed = [self.twist * turning, T::ZERO];
        let mut moving = [self.tip_slope.each(|slope| self.twist * slope), [T::ZERO; MODES]];
        for s in 0..STATIONS {
            if self.mass[s] == T::ZERO {
                continue;
            }
            let row = &self.integral[s];
            let along: [T; MODES] = array(|k| dot(row, &x_slope[k]));
            let across: [T; MODES] = array(|k| dot(row, &y_slope[k]));
            let [x, y, x_rest, y_rest]: [T; 4] = array(|i| dot(row, &rest[i]));
            let x = x + self.radius;
            let (x_rate, y_rate) = (dot(&along, v), dot(&across, v));
            let x_load = x_rest - T::TWO * omega * y_rate - faster * y - omega * omega * x
                + alpha * (x_rate - omega * y)
                + weight[0];
            let y_load = y_rest + T::TWO * omega * x_rate + faster * x - omega * omega * y
                + alpha * (y_rate + omega * x)
                + weight[1];
            let (x_load, y_load) = (self.mass[s] * x_load, self.mass[s] * y_load);
            let (x_mass, y_mass) = (self.mass[s] * x, self.mass[s] * y);
            fixed[0] += x * y_load - y * x_load;
            fixed[1] += y_load;
            for k in 0..MODES {
                moving[0][k] += x_mass * across[k] - y_mass * along[k];
                moving[1][k] += self.mass[s] * across[k];
                force[k] += -(along[k] * x_load + across[k] * y_load);
                let (x, y) = (self.mass[s] * along[k], self.mass[s] * across[k]);
                for j in 0..=k {
                    mass.add(k, j, x * along[j] + y * across[j]);
                }
            }
        }
        Forces { mass, force, tip, fixed, moving }
    }

    fn acceleration(&self, shape: &Shape<T, MODES>, hub: &HubState<T>) -> [T; MODES] {
        self.forces(shape, hub).acceleration()
    }

    /// Torque and moment, where `ä` is known.
    fn load(&self, forces: &Forces<T, MODES>, a: &[T; MODES], hub: &HubState<T>) -> Load<T> {
        let of = |i: usize| forces.fixed[i] + dot(&forces.moving[i], a);
        let (about_axis, across) = (of(0), of(1));
        let own = if self.carried {
            let (_, cos) = self.direction.seen_from(hub);
            across + self.hub * (hub.acceleration + self.gravity * cos)
        } else {
            about_axis + self.hub * hub.acceleration
        };
        Load { torque: own, moment: about_axis - self.radius * across }
    }

    /// The tip in the hub frame, m, and what acts on the arm. Where the acceleration jumps, that is
    /// of the side that the hub is of.
    pub fn answer(&self, shape: &Shape<T, MODES>, hub: &HubState<T>) -> ([T; 2], Load<T>) {
        let forces = self.forces(shape, hub);
        (forces.tip, self.load(&forces, &forces.acceleration(), hub))
    }

    /// Static equilibrium with the hub at rest: `Ω²a` is the load, half-way steps.
    pub fn equilibrium(&self, hub: &HubState<T>) -> Shape<T, MODES> {
        let hub = HubState { rate: T::ZERO, acceleration: T::ZERO, ..*hub };
        let mut shape = Shape { a: [T::ZERO; MODES], v: [T::ZERO; MODES] };
        for _ in 0..EQUILIBRIUM_STEPS {
            let left = self.forces(&shape, &hub);
            for k in 0..MODES {
                shape.a[k] += T::HALF * left.force[k] / self.stiffness[k];
            }
        }
        shape
    }

    /// True if the arm, its hub at rest, moves by less than [`STILL`].
    pub fn is_still(&self, shape: &Shape<T, MODES>, hub: &HubState<T>) -> bool {
        let pull = self.acceleration(shape, hub);
        let floor = T::from_f64(STILL);
        (0..MODES).all(|k| {
            let [fast, far] = self.swing[k];
            let (v, pull) = (fast * shape.v[k], far * pull[k]);
            v < floor && -v < floor && pull < floor && -pull < floor
        })
    }

    /// Advances from `begin` to `end`, ticks no more than one apart, along a motion with one
    /// formula; returns how many steps that took. `seen` is given the load at the beginning of
    /// every step.
    pub fn advance(
        &self,
        shape: &mut Shape<T, MODES>,
        hub_at: &dyn Fn(f64) -> HubState<T>,
        begin: f64,
        end: f64,
        seen: &mut dyn FnMut(Load<T>),
    ) -> u32 {
        let steps = libm::ceil((end - begin) * self.steps_a_tick - 1e-6);
        if steps < 1.0 {
            return 0;
        }
        let ticks = (end - begin) / steps;
        let at = |half_steps: u32| hub_at(begin + 0.5 * f64::from(half_steps) * ticks);
        let (h, sixth) = (T::from_f64(ticks * self.tick), T::from_f64(ticks * self.tick / 6.0));
        let mut hub = at(0);
        for i in 0..steps as u32 {
            let (middle, last) = (at(2 * i + 1), at(2 * i + 2));
            let half = T::HALF * h;
            let from = |a: &[T; MODES], x: &[T; MODES], step: T| -> [T; MODES] {
                array(|k| a[k] + step * x[k])
            };
            let Shape { a, v } = *shape;
            let v1 = v;
            let forces = self.forces(shape, &hub);
            let f1 = forces.acceleration();
            seen(self.load(&forces, &f1, &hub));
            let v2 = from(&v, &f1, half);
            let f2 = self.acceleration(&Shape { a: from(&a, &v1, half), v: v2 }, &middle);
            let v3 = from(&v, &f2, half);
            let f3 = self.acceleration(&Shape { a: from(&a, &v2, half), v: v3 }, &middle);
            let v4 = from(&v, &f3, h);
            let f4 = self.acceleration(&Shape { a: from(&a, &v3, h), v: v4 }, &last);
            for k in 0..MODES {
                shape.a[k] += sixth * (v1[k] + T::TWO * (v2[k] + v3[k]) + v4[k]);
                shape.v[k] += sixth * (f1[k] + T::TWO * (f2[k] + f3[k]) + f4[k]);
            }
            hub = last;
        }
        steps as u32
    }
}
