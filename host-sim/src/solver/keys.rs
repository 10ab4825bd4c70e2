//! The keys of a solver as they are typed, those that a method reads, and their defaults.

use serde::{Deserialize, Serialize};

use super::{ELEMENTS, MODES, Mass, Method, Quality, Scalar, Solver, no_such_mesh};
use crate::error::Error;

/// The `[solver]` table, and the same keys on the command line. What is absent is left to the
/// next in line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, clap::Args)]
#[serde(deny_unknown_fields)]
pub struct SolverKeys {
    /// Stepper [default: auto, or the nearest to its tolerances]
    #[arg(long, value_enum)]
    pub method: Option<Method>,
    /// Beam elements: 1, 2, 4 or 8; newmark and modal [default: 1, modal 8]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub elements: Option<i64>,
    /// Mass matrix; newmark and modal [default: consistent]
    #[arg(long, value_enum)]
    pub mass: Option<Mass>,
    /// Modes: 1 to 3; modal and elastica [default: 2]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub modes: Option<i64>,
    /// Work a tick; elastica [default: fine]
    #[arg(long, value_enum)]
    pub quality: Option<Quality>,
    /// Error of the tip that auto may make, fraction of the length [default: 0.001]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Error of the torque that auto may make, fraction of its peak [default: 0.01]
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    pub torque_tolerance: Option<f64>,
    /// Setpoint interval in s [default: 0.01]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    pub tick: Option<f64>,
    /// Precision of the tick [default: f32]
    #[arg(long, value_enum)]
    pub scalar: Option<Scalar>,
    /// Centrifugal stiffening and softening [default: true]
    #[arg(skip)]
    pub spin: Option<bool>,
}

impl From<Solver> for SolverKeys {
    fn from(solver: Solver) -> Self {
        Self {
            method: Some(solver.method),
            elements: Some(solver.elements as i64),
            mass: Some(solver.mass),
            modes: Some(solver.modes as i64),
            quality: Some(solver.quality),
            tolerance: Some(solver.tolerance),
            torque_tolerance: Some(solver.torque_tolerance),
            tick: Some(solver.tick),
            scalar: Some(solver.scalar),
            spin: Some(solver.spin),
        }
    }
}

impl SolverKeys {
    /// Names of the keys, in the order of the fields. A sweep has them as columns.
    pub const NAMES: [&'static str; 10] = [
        "method",
        "elements",
        "mass",
        "modes",
        "quality",
        "tolerance",
        "torque_tolerance",
        "tick_s",
        "scalar",
        "spin",
    ];

    /// Returns every key that the method reads, absent ones at their defaults. Keys that it does
    /// not read are left out, so that equal solvers have equal keys.
    pub fn relevant(self) -> Self {
        let method = self.method.unwrap_or(Solver::default().method);
        let default = Solver { elements: method.elements(), ..Solver::default() };
        let keys = self.or(default.into());
        let keys = if method == Method::Auto {
            keys
        } else {
            Self { tolerance: None, torque_tolerance: None, ..keys }
        };
        let meshless = Self { elements: None, mass: None, spin: None, ..keys };
        match method {
            Method::Rigid | Method::Auto => Self { modes: None, quality: None, ..meshless },
            Method::Newmark => Self { modes: None, quality: None, ..keys },
            Method::Modal => Self { quality: None, ..keys },
            Method::Elastica => meshless,
            Method::Pointwise => Self { quality: None, ..meshless },
        }
    }

    /// Returns the given keys that `method` does not read, each in a line that names the methods
    /// that do.
    pub fn unread(self, method: Method) -> Vec<String> {
        let reads = |method: Method| {
            let typed = Self { method: Some(method), ..Self::default() };
            typed.relevant().values().map(|value| value.is_some())
        };
        let names =
            ["elements", "mass", "modes", "quality", "tolerance", "torque_tolerance", "spin"];
        let mut unread = Vec::new();
        for (k, value) in self.values().into_iter().enumerate() {
            let Some(value) = value.filter(|_| !reads(method)[k]) else { continue };
            let others = Method::ALL.iter().filter(|&&other| reads(other)[k]);
            let others: Vec<&str> = others.map(|other| other.name()).collect();
            unread.push(format!(
                "solver.{} = {value}: {} does not read it, must be absent or with {}",
                names[k],
                method.name(),
                if others.len() == 1 {
                    format!("method = {}", others[0])
                } else {
                    format!("one of the methods {}", others.join(", "))
                }
            ));
        }
        unread
    }

    /// Returns the values that not every method reads.
    fn values(&self) -> [Option<String>; 7] {
        [
            self.elements.map(|n| n.to_string()),
            self.mass.map(|mass| mass.name().to_owned()),
            self.modes.map(|n| n.to_string()),
            self.quality.map(|quality| quality.name().to_owned()),
            self.tolerance.map(|x| x.to_string()),
            self.torque_tolerance.map(|x| x.to_string()),
            self.spin.map(|spin| spin.to_string()),
        ]
    }

    /// Returns these keys, with `other`'s in place of absent ones.
    pub fn or(self, other: Self) -> Self {
        Self {
            method: self.method.or(other.method),
            elements: self.elements.or(other.elements),
            mass: self.mass.or(other.mass),
            modes: self.modes.or(other.modes),
            quality: self.quality.or(other.quality),
            tolerance: self.tolerance.or(other.tolerance),
            torque_tolerance: self.torque_tolerance.or(other.torque_tolerance),
            tick: self.tick.or(other.tick),
            scalar: self.scalar.or(other.scalar),
            spin: self.spin.or(other.spin),
        }
    }

    /// Returns the solver, with absent keys at their defaults.
    pub fn resolve(self) -> Result<Solver, Error> {
        let default = Solver::default();
        let method = self.method.unwrap_or(default.method);
        let elements = match self.elements {
            None => method.elements(),
            Some(n) => {
                let known = usize::try_from(n).ok().filter(|n| ELEMENTS.contains(n));
                known.ok_or_else(|| no_such_mesh(n))?
            }
        };
        let modes = match self.modes {
            None => method.modes(),
            Some(n) => usize::try_from(n).ok().filter(|n| MODES.contains(n)).ok_or_else(|| {
                let [least, most] = [*MODES.start(), *MODES.end()];
                Error::new(format_args!("solver.modes = {n}: must be {least} to {most}"))
            })?,
        };
        let tick = self.tick.unwrap_or(default.tick);
        if !(1e-6..=1.0).contains(&tick) {
            return Err(Error::new(format_args!("solver.tick = {tick}: must be 0.000001 to 1 s")));
        }
        let tolerance = fraction(
            "solver.tolerance",
            self.tolerance.unwrap_or(default.tolerance),
            "a fraction of the length",
        )?;
        let torque_tolerance = fraction(
            "solver.torque_tolerance",
            self.torque_tolerance.unwrap_or(default.torque_tolerance),
            "a fraction of the torque's peak",
        )?;
        Ok(Solver {
            method,
            elements,
            mass: self.mass.unwrap_or(default.mass),
            modes,
            quality: self.quality.unwrap_or(default.quality),
            tolerance,
            torque_tolerance,
            tick,
            scalar: self.scalar.unwrap_or(default.scalar),
            spin: self.spin.unwrap_or(default.spin),
        })
    }
}

/// Returns a tolerance, or an error if the value cannot be one.
fn fraction(key: &str, value: f64, of: &str) -> Result<f64, Error> {
    if (1e-6..=1.0).contains(&value) {
        return Ok(value);
    }
    Err(Error::new(format_args!("{key} = {value}: must be 0.000001 to 1, {of}")))
}
