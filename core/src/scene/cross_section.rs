//! Cross-sections of links.

use crate::Error;
use crate::material::Strip;

/// The cross-section of a link that bends in the plane of motion. Sizes in m.
///
/// `CrossSection<[f64; 2]>` holds the sizes at both ends of a stretch, that nearer to the clamp
/// first: [`CrossSection::at`] takes one between them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CrossSection<D = f64> {
    /// A full rectangle, `A = w t`, `I = w t³/12`.
    Strip {
        /// Size across the plane of motion.
        width: D,
        /// Size in the plane of motion.
        thickness: D,
    },
    /// A full circle, `A = π d²/4`, `I = π d⁴/64`.
    Round {
        /// Outer diameter.
        diameter: D,
    },
    /// A circular tube: the outer circle less the inner one.
    Tube {
        /// Outer diameter.
        diameter: D,
        /// Thickness of the wall, up to half the diameter.
        wall: D,
    },
    /// A rectangular tube with a wall of one thickness: the outer rectangle less the inner one.
    RectangleTube {
        /// Outer size across the plane of motion.
        width: D,
        /// Outer size in the plane of motion.
        thickness: D,
        /// Thickness of the wall, up to half the smaller side.
        wall: D,
    },
}

impl From<Strip> for CrossSection {
    fn from(Strip { width, thickness }: Strip) -> Self {
        Self::Strip { width, thickness }
    }
}

impl CrossSection {
    /// Area of the material, m².
    pub fn area(&self) -> f64 {
        const QUARTER: f64 = core::f64::consts::FRAC_PI_4;
        match *self {
            Self::Strip { width, thickness } => width * thickness,
            Self::Round { diameter } => QUARTER * diameter * diameter,
            Self::Tube { diameter, wall } => 4.0 * QUARTER * wall * (diameter - wall),
            Self::RectangleTube { width, thickness, wall } => {
                2.0 * wall * (width + thickness - 2.0 * wall)
            }
        }
    }

    /// Second moment of the area about the axis across the plane of motion, m⁴.
    pub fn second_moment(&self) -> f64 {
        let rectangle = |w: f64, t: f64| w * t * t * t / 12.0;
        let circle = |d: f64| core::f64::consts::PI / 64.0 * (d * d) * (d * d);
        match *self {
            Self::Strip { width, thickness } => rectangle(width, thickness),
            Self::Round { diameter } => circle(diameter),
            Self::Tube { diameter, wall } => circle(diameter) - circle(diameter - 2.0 * wall),
            Self::RectangleTube { width, thickness, wall } => {
                rectangle(width, thickness) - rectangle(width - 2.0 * wall, thickness - 2.0 * wall)
            }
        }
    }

    /// The cross-section itself if every size is in range.
    pub fn validate(self) -> Result<Self, Error> {
        let size = |parameter, value| Error::check(parameter, value, 1e-6, 10.0, "m");
        match self {
            Self::Strip { width, thickness } => {
                size("link.width", width)?;
                size("link.thickness", thickness)?;
            }
            Self::Round { diameter } => {
                size("link.diameter", diameter)?;
            }
            Self::Tube { diameter, wall } => {
                size("link.diameter", diameter)?;
                Error::check("link.wall", wall, 1e-6, 0.5 * diameter, "m")?;
            }
            Self::RectangleTube { width, thickness, wall } => {
                size("link.width", width)?;
                size("link.thickness", thickness)?;
                Error::check("link.wall", wall, 1e-6, 0.5 * width.min(thickness), "m")?;
            }
        }
        Ok(self)
    }
}

impl CrossSection<[f64; 2]> {
    /// The cross-section at `s` between the ends, 0 to 1: each size changes in a straight line.
    pub fn at(&self, s: f64) -> CrossSection {
        let mix = |[a, b]: [f64; 2]| a + s * (b - a);
        match *self {
            Self::Strip { width, thickness } => {
                CrossSection::Strip { width: mix(width), thickness: mix(thickness) }
            }
            Self::Round { diameter } => CrossSection::Round { diameter: mix(diameter) },
            Self::Tube { diameter, wall } => {
                CrossSection::Tube { diameter: mix(diameter), wall: mix(wall) }
            }
            Self::RectangleTube { width, thickness, wall } => CrossSection::RectangleTube {
                width: mix(width),
                thickness: mix(thickness),
                wall: mix(wall),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::CrossSection::{RectangleTube, Round, Strip, Tube};
    use crate::Error;

    /// A tube whose wall is half its size is full.
    #[test]
    fn a_tube_without_a_hole_is_a_bar() {
        let (tube, bar) = (Tube { diameter: 0.02, wall: 0.01 }, Round { diameter: 0.02 });
        assert!((tube.area() / bar.area() - 1.0).abs() < 1e-14);
        assert!((tube.second_moment() / bar.second_moment() - 1.0).abs() < 1e-14);
        let tube = RectangleTube { width: 0.03, thickness: 0.02, wall: 0.01 };
        let bar = Strip { width: 0.03, thickness: 0.02 };
        assert!((tube.area() / bar.area() - 1.0).abs() < 1e-14);
        assert!((tube.second_moment() / bar.second_moment() - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_wall_beyond_half_the_size_is_refused() {
        let error = Tube { diameter: 0.012, wall: 0.007 }.validate().expect_err("no tube");
        let Error::OutOfRange { parameter, value, .. } = error else { panic!("{error}") };
        assert_eq!((parameter, value), ("link.wall", 0.007));
    }
}
