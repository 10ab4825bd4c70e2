//! The machine's equations of motion.

use std::f64::consts::TAU;

use differential_equations::ode::ODE;
use nalgebra::SVector;

use super::{Effort, Parts};
use crate::reference::rod::{Driven, Response};

/// Unknowns of the arm, and as many rates.
const ARM: usize = 8;

/// State of the machine, scaled so that one tolerance fits all of it: the arm's unknowns, rad, and
/// their rates over ω₁; see [`Row`] for the rest.
pub(super) type State = SVector<f64, 24>;

/// Rows of the state behind the arm's.
#[derive(Clone, Copy)]
pub(super) enum Row {
    /// θ, rad.
    Hub = 2 * ARM as isize,
    /// θ̇/ω₁.
    HubRate,
    /// θ_M, the motor's angle over the gear ratio, rad; θ of a rigid gear.
    Motor,
    /// θ̇_M/ω₁.
    MotorRate,
    /// Bristles of the friction at the hub.
    Bristle,
    /// Bristles of the gear's loss.
    GearBristle,
    /// Work of the motor over the unit of energy.
    Work,
    /// Losses over the unit of energy.
    Loss,
}

/// The machine, without its state.
pub(super) struct System {
    pub arm: Box<dyn Driven>,
    pub parts: Parts,
    /// ω₁, rad/s.
    pub scale: f64,
    /// Unit in which work and losses are integrated, J.
    pub energy: f64,
}

/// A state in its own units.
pub(super) struct Motion {
    pub a: SVector<f64, ARM>,
    pub v: SVector<f64, ARM>,
    pub angle: f64,
    pub rate: f64,
    /// The motor's, in the hub's units.
    pub motor: f64,
    pub motor_rate: f64,
    pub bristle: f64,
    pub gear_bristle: f64,
}

/// Torques at one instant, in the hub's units, and what they do.
struct Flow {
    /// θ̈ and θ̈_M, rad/s².
    hub: f64,
    motor: f64,
    /// Torque of the mesh and the part of it that is damping, N m.
    mesh: f64,
    damped: f64,
    /// Torque of the motor at its shaft, N m.
    torque: f64,
    /// Loss of the gear as a fraction of the mesh's torque.
    loss: f64,
}

impl System {
    /// True if motor and hub turn as one.
    pub fn is_rigid(&self) -> bool {
        self.parts.gear.stiffness.is_none()
    }

    pub fn motion(&self, y: &State) -> Motion {
        let of = |row: Row| y[row as usize];
        let (mut motor, mut motor_rate) = (of(Row::Motor), of(Row::MotorRate));
        if self.is_rigid() {
            (motor, motor_rate) = (of(Row::Hub), of(Row::HubRate));
        }
        Motion {
            a: y.fixed_rows::<ARM>(0).into_owned(),
            v: y.fixed_rows::<ARM>(ARM) * self.scale,
            angle: of(Row::Hub),
            rate: of(Row::HubRate) * self.scale,
            motor,
            motor_rate: motor_rate * self.scale,
            bristle: of(Row::Bristle),
            gear_bristle: of(Row::GearBristle),
        }
    }

    /// Returns the energy of arm, hub, rotor, mesh and cogging, J.
    pub fn stored(&self, y: &State) -> f64 {
        let now = self.motion(y);
        let n = self.parts.ratio();
        let inertia = self.parts.motor.rotor_inertia * n * n;
        let cogging = self.parts.motor.cogging;
        let periods = f64::from(cogging.periods);
        self.arm.energy(&now.a, &now.v, now.angle, now.rate)
            + 0.5 * inertia * now.motor_rate * now.motor_rate
            + if self.is_rigid() { 0.0 } else { self.mesh(&now).1 }
            + cogging.amplitude / periods * (periods * n * now.motor).cos()
    }

    fn mesh(&self, now: &Motion) -> (f64, f64) {
        self.parts.gear.mesh(now.motor - now.angle, now.motor_rate - now.rate)
    }

    /// Returns the cogging torque at the shaft, N m.
    fn cogging(&self, motor: f64) -> f64 {
        let cogging = self.parts.motor.cogging;
        cogging.amplitude * (f64::from(cogging.periods) * self.parts.ratio() * motor).sin()
    }

    fn flow(&self, t: f64, now: &Motion, response: &Response, effort: &Effort<'_>) -> Flow {
        let n = self.parts.ratio();
        let rotor = self.parts.motor.rotor_inertia * n * n;
        let friction = self.parts.friction.torque(now.bristle, now.rate);
        let load = response.bias + friction;
        let cogging = self.cogging(now.motor);
        let gear = &self.parts.gear;
        if !self.is_rigid() {
            let torque = effort.torque(t);
            let (mesh, energy) = self.mesh(now);
            let loss = gear.loss(mesh, now.gear_bristle);
            let elastic = (2.0 * energy * gear.stiffness.unwrap_or(0.0)).sqrt();
            let side = (now.motor - now.angle).signum();
            return Flow {
                hub: (mesh - load) / response.inertia,
                motor: (n * (torque + cogging) - (1.0 + loss) * mesh) / rotor,
                mesh,
                damped: mesh - side * elastic,
                torque,
                loss,
            };
        }
        let rigid = |torque: f64, sign: f64| {
            let loss = gear.loss(sign, now.gear_bristle);
            let driven = n * (torque + cogging) - (1.0 + loss) * load;
            let hub = driven / (rotor + (1.0 + loss) * response.inertia);
            let mesh = response.inertia * hub + load;
            Flow { hub, motor: hub, mesh, damped: 0.0, torque, loss }
        };
        let torque = match effort {
            Effort::Along(wanted) => {
                let hub = wanted(t, now.angle, now.rate);
                let mesh = response.inertia * hub + load;
                let loss = gear.loss(mesh, now.gear_bristle);
                ((1.0 + loss) * mesh + rotor * hub) / n - cogging
            }
            other => other.torque(t),
        };
        // The loss depends on the sign of the mesh's torque, and just one sign agrees with itself.
        let forward = rigid(torque, 1.0);
        if forward.mesh >= 0.0 { forward } else { rigid(torque, -1.0) }
    }

    fn derivative(&self, t: f64, y: &State, effort: &Effort<'_>) -> State {
        let now = self.motion(y);
        let response = self.arm.respond(&now.a, &now.v, now.angle, now.rate);
        let flow = self.flow(t, &now, &response, effort);
        let friction = &self.parts.friction;
        let acceleration = response.free + response.per_acceleration * flow.hub;
        let mut dy = State::zeros();
        dy.fixed_rows_mut::<ARM>(0).copy_from(&now.v);
        dy.fixed_rows_mut::<ARM>(ARM).copy_from(&(acceleration / self.scale));
        let mut set = |row: Row, value: f64| dy[row as usize] = value;
        set(Row::Hub, now.rate);
        set(Row::HubRate, flow.hub / self.scale);
        set(Row::Motor, now.motor_rate);
        set(Row::MotorRate, flow.motor / self.scale);
        set(Row::Bristle, friction.follow(now.bristle, now.rate));
        set(Row::GearBristle, friction.follow(now.gear_bristle, now.motor_rate));
        let work = flow.torque * self.parts.ratio() * now.motor_rate;
        let lost = friction.torque(now.bristle, now.rate) * now.rate
            + flow.loss * flow.mesh * now.motor_rate
            + flow.damped * (now.motor_rate - now.rate)
            + response.lost;
        set(Row::Work, work / self.energy);
        set(Row::Loss, lost / self.energy);
        dy
    }

    /// Returns the shaft's angle, turns, and its rate, rad/s.
    pub fn shaft(&self, y: &State) -> (f64, f64) {
        let now = self.motion(y);
        let n = self.parts.ratio();
        (n * now.motor / TAU, n * now.motor_rate)
    }
}

/// The machine under an effort.
pub(super) struct Driving<'a> {
    pub system: &'a System,
    pub effort: &'a Effort<'a>,
}

impl ODE<f64, State> for Driving<'_> {
    fn diff(&self, t: f64, y: &State, dydt: &mut State) {
        *dydt = self.system.derivative(t, y, self.effort);
    }
}
