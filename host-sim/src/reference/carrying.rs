//! Motion that the hub gives the link.

use std::f64::consts::TAU;

use stillbeam::Scene;
use stillbeam::hub::{GravityDirection, HubState};

/// Motion of the clamp and load of gravity at one instant, in hub axes.
///
/// A hub that turns gives the link a rate and an angular acceleration. A carriage gives it neither:
/// its velocity and acceleration are those of the clamp, across the link.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carrying {
    /// Rate of the turn, rad/s, and its angular acceleration, rad/s².
    pub rate: f64,
    pub acceleration: f64,
    /// Velocity of the hub across the link, m/s, and its acceleration, m/s². Zero if it turns.
    pub velocity: f64,
    pub push: f64,
    /// `g sin χ` and `g cos χ`: the acceleration that holds a mass against gravity, m/s².
    pub weight: [f64; 2],
}

/// The mount of the link, and gravity: all of a scene that [`Carrying`] takes, looked up once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carrier {
    /// Acceleration of gravity in the plane, m/s², and its direction.
    gravity: f64,
    direction: GravityDirection<f64>,
    /// True of a carriage.
    is_linear: bool,
    /// Rate of the carrier that turns the hub's axis along, rad/s.
    rate: f64,
}

impl Carrier {
    /// The carrier of a scene.
    pub fn of(scene: &Scene) -> Self {
        Self {
            gravity: scene.in_plane_gravity(),
            direction: scene.gravity_direction(),
            is_linear: scene.mount.is_linear(),
            rate: scene.mount.carrier,
        }
    }

    /// The motion at an instant of a hub whose `sin` and `cos` are those of θ.
    pub fn carrying(&self, hub: &HubState<f64>) -> Carrying {
        let (sin, cos) = self.direction.seen_from(hub);
        let weight = [self.gravity * sin, self.gravity * cos];
        let (rate, acceleration) = (hub.rate, hub.acceleration);
        if self.is_linear {
            let (velocity, push) = (rate, acceleration);
            return Carrying { rate: 0.0, acceleration: 0.0, velocity, push, weight };
        }
        let rate = rate + self.rate;
        Carrying { rate, acceleration, velocity: 0.0, push: 0.0, weight }
    }
}

/// The hub as it is seen from outside at time `t` s, if a carrier turns it: the carrier is at its
/// zero at time 0.
pub(super) fn from_outside(scene: &Scene, hub: &HubState<f64>, t: f64) -> HubState<f64> {
    let carrier = scene.mount.carrier;
    if carrier == 0.0 {
        return *hub;
    }
    let angle = hub.angle.plus(carrier * t / TAU);
    let (sin, cos) = angle.sin_cos();
    HubState { angle, rate: hub.rate + carrier, sin, cos, ..*hub }
}

/// Position of a point of the hub frame in the global frame, m. The frame of a hub that turns is
/// turned by θ about the axis, that of a carriage is moved by its position along global Y.
pub(super) fn global(scene: &Scene, hub: &HubState<f64>, [x, y]: [f64; 2]) -> [f64; 2] {
    if scene.mount.is_linear() {
        return [x, y + hub.angle.radians()];
    }
    [x * hub.cos - y * hub.sin, x * hub.sin + y * hub.cos]
}
