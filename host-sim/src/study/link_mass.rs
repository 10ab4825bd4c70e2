//! The link mass that the paper's section 3 prints contradicts the period it prints.

use stillbeam::Link;

use crate::dispatch::first_period;
use crate::error::Error;
use crate::solver::{Mass, SolverKeys};

/// First periods by the readings of the paper's numbers.
#[derive(Clone, Debug)]
pub struct LinkMass {
    /// Reading as section 3 prints it: 0.215 kg, EI 0.46 N m².
    pub printed: Reading,
    /// Reading as table 1(d) prints member D: 0.0224 kg, 69 GPa × 1.333e-11 m⁴.
    pub table: Reading,
    /// Member D as the embedded scenes have it: 0.0224 kg, EI 0.46 N m².
    pub used: Reading,
}

/// One reading and its first period.
#[derive(Clone, Copy, Debug)]
pub struct Reading {
    /// The link.
    pub link: Link,
    /// First period of the bare link, eight consistent elements, s.
    pub period: f64,
}

/// Theoretical period that the paper prints, s.
pub const PAPER_THEORY: f64 = 0.0998;
/// Period that the paper reads from its curve, s.
pub const PAPER_READ: f64 = 0.0992;
/// Link mass that the paper's section 3 prints, kg.
const PRINTED_MASS: f64 = 0.215;
/// Young's modulus and second moment that table 1(d) prints, Pa and m⁴.
const TABLE: (f64, f64) = (69.0e9, 1.333e-11);

impl LinkMass {
    /// Computes the periods.
    pub fn compute() -> Result<Self, Error> {
        let scene = super::scene("d-fast", SolverKeys::default())?;
        let used = scene.arm.link;
        let read = |link: Link| -> Result<Reading, Error> {
            let arm = stillbeam::Scene { link, ..scene.arm };
            Ok(Reading { link, period: first_period(&arm, 8, Mass::Consistent)? })
        };
        Ok(Self {
            printed: read(Link { mass: PRINTED_MASS, ..used })?,
            table: read(Link::from_section(used.length, used.mass, TABLE.0, TABLE.1)?)?,
            used: read(used)?,
        })
    }
}
