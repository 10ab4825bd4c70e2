//! Which solver a run uses: command line over scene file over defaults.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// How the arm is stepped.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// The arm does not bend.
    Rigid,
    /// The paper's time marching, small deflections.
    Newmark,
}

/// How the elements' mass is spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Mass {
    /// By the element's shape functions.
    Consistent,
    /// Half at each node.
    Lumped,
}

/// Precision of the tick; set-up is always f64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Scalar {
    /// As on the target.
    F32,
    /// To tell rounding from method.
    F64,
}

/// The `[solver]` table, and the same keys on the command line. What is absent is left to the
/// next in line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, clap::Args)]
#[serde(deny_unknown_fields)]
pub struct SolverKeys {
    /// Stepper [default: newmark]
    #[arg(long, value_enum)]
    pub method: Option<Method>,
    /// Beam elements: 1, 2, 4 or 8 [default: 1]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub elements: Option<i64>,
    /// Mass matrix [default: consistent]
    #[arg(long, value_enum)]
    pub mass: Option<Mass>,
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

/// A solver, every choice made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Stepper.
    pub method: Method,
    /// Beam elements: 1, 2, 4 or 8.
    pub elements: usize,
    /// Mass matrix.
    pub mass: Mass,
    /// h, s.
    pub tick: f64,
    /// Precision of the tick.
    pub scalar: Scalar,
    /// Centrifugal stiffening and softening.
    pub spin: bool,
}

impl Method {
    /// As it is typed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Newmark => "newmark",
        }
    }
}

impl Mass {
    /// As it is typed.
    pub fn name(self) -> &'static str {
        match self {
            Self::Consistent => "consistent",
            Self::Lumped => "lumped",
        }
    }
}

impl Scalar {
    /// As it is typed.
    pub fn name(self) -> &'static str {
        match self {
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            method: Method::Newmark,
            elements: 1,
            mass: Mass::Consistent,
            tick: 0.01,
            scalar: Scalar::F32,
            spin: true,
        }
    }
}

impl From<Solver> for SolverKeys {
    fn from(solver: Solver) -> Self {
        Self {
            method: Some(solver.method),
            elements: Some(solver.elements as i64),
            mass: Some(solver.mass),
            tick: Some(solver.tick),
            scalar: Some(solver.scalar),
            spin: Some(solver.spin),
        }
    }
}

impl SolverKeys {
    /// Names of the keys, in the order of the fields; a sweep's columns.
    pub const NAMES: [&'static str; 6] = ["method", "elements", "mass", "tick_s", "scalar", "spin"];

    /// Every key that the method reads, absent ones at their defaults; none that it does not, so
    /// that equal solvers have equal keys.
    pub fn relevant(self) -> Self {
        let keys = self.or(Solver::default().into());
        match keys.method {
            Some(Method::Rigid) => Self { elements: None, mass: None, spin: None, ..keys },
            Some(Method::Newmark) | None => keys,
        }
    }

    /// These keys, and `other`'s where they are absent.
    pub fn or(self, other: Self) -> Self {
        Self {
            method: self.method.or(other.method),
            elements: self.elements.or(other.elements),
            mass: self.mass.or(other.mass),
            tick: self.tick.or(other.tick),
            scalar: self.scalar.or(other.scalar),
            spin: self.spin.or(other.spin),
        }
    }

    /// The solver, absent keys at their defaults.
    pub fn resolve(self) -> Result<Solver, Error> {
        let default = Solver::default();
        let elements = match self.elements {
            None => default.elements,
            Some(n @ (1 | 2 | 4 | 8)) => n as usize,
            Some(n) => {
                return Err(Error::new(format_args!(
                    "solver.elements = {n}: accepted is 1, 2, 4 or 8"
                )));
            }
        };
        let tick = self.tick.unwrap_or(default.tick);
        if !(1e-6..=1.0).contains(&tick) {
            return Err(Error::new(format_args!(
                "solver.tick = {tick}: accepted is 0.000001 to 1 s"
            )));
        }
        Ok(Solver {
            method: self.method.unwrap_or(default.method),
            elements,
            mass: self.mass.unwrap_or(default.mass),
            tick,
            scalar: self.scalar.unwrap_or(default.scalar),
            spin: self.spin.unwrap_or(default.spin),
        })
    }
}

impl Solver {
    /// In a few words, e.g. `newmark, 4 consistent elements, 10 ms, f32`.
    pub fn describe(&self) -> String {
        let tick = self.tick * 1e3;
        let (method, scalar) = (self.method.name(), self.scalar.name());
        match self.method {
            Method::Rigid => format!("{method}, {tick} ms, {scalar}"),
            Method::Newmark => {
                let mass = self.mass.name();
                let plural = if self.elements == 1 { "" } else { "s" };
                let spin = if self.spin { "" } else { ", no spin terms" };
                format!(
                    "{method}, {} {mass} element{plural}, {tick} ms, {scalar}{spin}",
                    self.elements
                )
            }
        }
    }
}
