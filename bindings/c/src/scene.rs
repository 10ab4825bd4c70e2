//! The arm in SI units, as C describes it.

use stillbeam::{AxisKind, Damping, Hub, Link, Mount, Payload, UniformScene};

/// An arm with a uniform link. A field that is 0 is not there: no payload, no damping, no gravity,
/// a clamp that does not give. A link that is not uniform is exported on the desktop.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default)]
pub struct Scene {
    /// Length of the link from clamp to tip, m; 0.001 to 1000.
    pub length: f64,
    /// Mass of the link, kg; 1e-7 to 1e5.
    pub mass: f64,
    /// Bending stiffness EI of the link, N m^2; 1e-9 to 1e12.
    pub bending_stiffness: f64,
    /// Radius from the hub's axis to the clamp, m.
    pub hub_radius: f64,
    /// Inertia of the hub about its axis, kg m^2; of a carriage its mass, kg.
    pub hub_inertia: f64,
    /// Stiffness of the joint between hub and link, N m/rad; 0 is a rigid clamp.
    pub joint_stiffness: f64,
    /// Mass of the payload, kg.
    pub payload_mass: f64,
    /// Inertia of the payload about its own centre, kg m^2.
    pub payload_inertia: f64,
    /// Distance of the payload's centre beyond the tip, m.
    pub payload_offset: f64,
    /// Damping of absolute velocity, 1/s.
    pub damping_alpha: f64,
    /// Damping of the rate of deformation, s.
    pub damping_beta: f64,
    /// Damping of the joint alone, s.
    pub damping_joint: f64,
    /// Gravity, m/s^2; 0 is a horizontal plane of motion.
    pub gravity: f64,
    /// Lean of the plane of motion from the vertical, rad; 0 to pi/2.
    pub tilt: f64,
    /// Angle in the plane by which gravity is turned from global -Y, counter-clockwise, rad.
    pub gravity_direction: f64,
    /// 0: the hub turns. 1: it is a carriage on a linear axis; a metre then takes the place of a
    /// radian everywhere, and a newton that of a newton metre.
    pub linear_axis: u32,
    /// Not used; 0.
    pub reserved: u32,
}

impl Scene {
    /// Returns the core's scene, not yet validated.
    pub(crate) fn arm(&self) -> UniformScene {
        let present = |value: f64| if value == 0.0 { None } else { Some(value) };
        let axis = if self.linear_axis == 0 { AxisKind::Rotary } else { AxisKind::Linear };
        let (length, mass) = (self.length, self.mass);
        let link = Link { length, mass, bending_stiffness: self.bending_stiffness };
        UniformScene {
            hub: Hub {
                radius: self.hub_radius,
                inertia: self.hub_inertia,
                stiffness: present(self.joint_stiffness),
            },
            payload: Payload {
                mass: self.payload_mass,
                inertia: self.payload_inertia,
                offset: self.payload_offset,
            },
            damping: Damping {
                alpha: self.damping_alpha,
                beta: self.damping_beta,
                joint: self.damping_joint,
            },
            gravity: self.gravity,
            mount: Mount { axis, tilt: self.tilt, direction: self.gravity_direction, carrier: 0.0 },
            ..UniformScene::uniform(link)
        }
    }
}
