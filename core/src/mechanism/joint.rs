//! One joint of a chain, with its motor.

use super::names::indexed;
use crate::Error;

/// A revolute joint and the hub of its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// `r`, from the joint's axis to the clamp of its link, rigid and without mass, m.
    pub radius: f64,
    /// `J_h` of hub and rotor about the axis, which turn with the joint's own link, kg m².
    pub inertia: f64,
    /// Mass of the joint with its motor, at its axis, kg.
    pub mass: f64,
    /// `J_s` of the motor's stator about the axis, which turns with the link before, kg m².
    pub stator_inertia: f64,
    /// True if no motor turns the joint. Its torque is then zero, and its angle is a result.
    pub passive: bool,
    /// Angle of a passive joint when the run begins, rad; in a loop where to begin the search for
    /// the angle that closes it. A driven joint begins where its motion does.
    pub angle: f64,
}

impl Joint {
    /// A joint with a motor and without mass.
    pub const DRIVEN: Self = Self {
        radius: 0.0,
        inertia: 0.0,
        mass: 0.0,
        stator_inertia: 0.0,
        passive: false,
        angle: 0.0,
    };

    /// A joint without motor and mass, at `angle` rad.
    pub const fn passive(angle: f64) -> Self {
        Self { passive: true, angle, ..Self::DRIVEN }
    }

    pub(super) fn validate(&self, index: usize) -> Result<(), Error> {
        let name = |names: [&'static str; super::MAX_LINKS]| names[index];
        Error::check(name(indexed!("joints", "radius")), self.radius, 0.0, 1e3, "m")?;
        Error::check(name(indexed!("joints", "inertia")), self.inertia, 0.0, 1e6, "kg m^2")?;
        Error::check(name(indexed!("joints", "mass")), self.mass, 0.0, 1e5, "kg")?;
        let field = name(indexed!("joints", "stator_inertia"));
        Error::check(field, self.stator_inertia, 0.0, 1e6, "kg m^2")?;
        Error::check(name(indexed!("joints", "angle")), self.angle, -1e6, 1e6, "rad")?;
        Ok(())
    }
}
