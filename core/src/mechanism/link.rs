//! One link of a chain.

use super::names::indexed;
use crate::Error;

/// Bending stiffness of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stiffness {
    /// The link does not bend.
    Rigid,
    /// `EI` of a uniform strip, N m².
    Bending(f64),
}

/// One link of a chain: uniform, inextensible, straight when nothing acts on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// `L`, clamp to the end of the strip, m.
    pub length: f64,
    /// `m`, whole link, kg.
    pub mass: f64,
    /// Its bending stiffness.
    pub stiffness: Stiffness,
    /// `e`, from the end of the strip to the next joint, or to the payload, along the tangent
    /// there, rigid and without mass, m.
    pub tip_offset: f64,
}

impl Link {
    /// A strip of that length (m), mass (kg) and `EI` (N m²).
    pub const fn flexible(length: f64, mass: f64, bending_stiffness: f64) -> Self {
        Self { length, mass, stiffness: Stiffness::Bending(bending_stiffness), tip_offset: 0.0 }
    }

    /// A rigid link of that length (m) and mass (kg).
    pub const fn rigid(length: f64, mass: f64) -> Self {
        Self { length, mass, stiffness: Stiffness::Rigid, tip_offset: 0.0 }
    }

    /// True if the link bends.
    pub const fn bends(&self) -> bool {
        matches!(self.stiffness, Stiffness::Bending(_))
    }

    /// `EI`, N m²; 0 of a rigid link, which has no coordinate that it would act on.
    pub const fn bending_stiffness(&self) -> f64 {
        match self.stiffness {
            Stiffness::Rigid => 0.0,
            Stiffness::Bending(stiffness) => stiffness,
        }
    }

    pub(super) fn validate(&self, index: usize) -> Result<(), Error> {
        let name = |names: [&'static str; super::MAX_LINKS]| names[index];
        Error::check(name(indexed!("links", "length")), self.length, 1e-3, 1e3, "m")?;
        // Nothing but its mass says how a strip vibrates; a rigid link may do without.
        let least = if self.bends() { 1e-7 } else { 0.0 };
        Error::check(name(indexed!("links", "mass")), self.mass, least, 1e5, "kg")?;
        if let Stiffness::Bending(stiffness) = self.stiffness {
            let field = name(indexed!("links", "bending_stiffness"));
            Error::check(field, stiffness, 1e-9, 1e12, "N m^2")?;
        }
        let field = name(indexed!("links", "tip_offset"));
        Error::check(field, self.tip_offset, 0.0, 1e3, "m")?;
        Ok(())
    }
}
