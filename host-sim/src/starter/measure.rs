//! Order in which to measure: how far each number of a new scene may be off, and what that does to
//! the first frequency.

use super::Starter;
use crate::error::Error;
use crate::reference::rod;

/// A number that may be off, and the relative change of the first frequency that it makes.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// The number and how far it may be off, in words.
    pub what: String,
    /// Relative change of the first frequency.
    pub shift: f64,
}

/// Error of a length by a ruler, m.
const RULER: f64 = 1e-3;

/// Error of a thickness by the maker's word, m.
const GAUGE: f64 = 5e-5;

/// Error of a mass by a kitchen scale, kg.
const SCALE: f64 = 1e-3;

/// Returns the doubts of a scene whose frequency is not measured, the largest first.
pub fn doubts(starter: &Starter) -> Result<Vec<Doubt>, Error> {
    let own = rod::first_period(&starter.arm()?.arm)?;
    let shift = |other: Starter| -> Result<f64, Error> {
        Ok((own / rod::first_period(&other.arm()?.arm)? - 1.0).abs())
    };
    let scatter = scatter(&starter.material);
    let mut doubts = vec![
        Doubt {
            what: format!("the modulus of {} off by {} %", starter.material, 100.0 * scatter),
            // A frequency goes with the root of the stiffness.
            shift: (1.0 + scatter).sqrt() - 1.0,
        },
        Doubt {
            what: format!("a thickness off by {} mm", 1e3 * GAUGE),
            shift: shift(Starter { thickness: starter.thickness + GAUGE, ..starter.clone() })?,
        },
        Doubt {
            what: format!("a length off by {} mm", 1e3 * RULER),
            shift: shift(Starter { length: starter.length + RULER, ..starter.clone() })?,
        },
        Doubt {
            what: format!("a payload off by {} g", 1e3 * SCALE),
            shift: shift(Starter { payload: starter.payload + SCALE, ..starter.clone() })?,
        },
    ];
    doubts.sort_by(|a, b| b.shift.total_cmp(&a.shift));
    Ok(doubts)
}

/// Scatter of a material's modulus, as the core's table of materials tells it.
fn scatter(material: &str) -> f64 {
    const METALS: [&str; 6] =
        ["aluminium", "steel", "stainless-steel", "spring-steel", "brass", "titanium"];
    const PLASTICS: [&str; 5] = ["acrylic", "petg", "abs", "pom", "nylon"];
    if METALS.contains(&material) {
        0.05
    } else if PLASTICS.contains(&material) {
        0.2
    } else {
        0.3
    }
}
