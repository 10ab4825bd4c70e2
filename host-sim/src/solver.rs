//! The solver of a run: the command line precedes the scene file, the scene file the defaults.

use std::fmt::Display;
use std::ops::RangeInclusive;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::error::Error;

/// Declares the words of one key: each variant with the name by which it is typed, in a scene file
/// and on the command line.
macro_rules! words {
    ($(#[$about:meta])* $key:ident { $($(#[$meaning:meta])* $variant:ident = $name:literal,)* }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
        pub enum $key {
            $($(#[$meaning])* #[serde(rename = $name)] #[value(name = $name)] $variant,)*
        }

        impl $key {
            /// Every word, in the order of the list.
            pub const ALL: &[Self] = &[$(Self::$variant),*];

            /// Returns the name as it is typed.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name,)*
                }
            }
        }
    };
}

words! {
    /// How the arm is stepped.
    Method {
        /// The arm does not bend.
        Rigid = "rigid",
        /// The paper's time marching, small deflections.
        Newmark = "newmark",
        /// Small deflections in a few modes, each advanced exactly.
        Modal = "modal",
        /// Exact kinematics in up to three modes.
        Elastica = "elastica",
        /// The cheapest of rigid, modal and elastica that is good enough for the scene's moves.
        Auto = "auto",
    }
}

words! {
    /// How much work a tick of elastica does.
    Quality {
        /// One evaluation a tick.
        Fast = "fast",
        /// Two half-steps.
        Fine = "fine",
    }
}

words! {
    /// How the elements' mass is spread.
    Mass {
        /// By the element's shape functions.
        Consistent = "consistent",
        /// Half at each node.
        Lumped = "lumped",
    }
}

words! {
    /// Precision of the tick; set-up is always f64.
    Scalar {
        /// As on the target.
        F32 = "f32",
        /// To tell rounding from method.
        F64 = "f64",
    }
}

/// Numbers of beam elements that a model is built for.
pub const ELEMENTS: [usize; 4] = [1, 2, 4, 8];

/// Numbers of modes that modal and elastica are built for.
pub const MODES: RangeInclusive<usize> = 1..=3;

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

/// A solver with every key resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Stepper.
    pub method: Method,
    /// Beam elements: 1, 2, 4 or 8.
    pub elements: usize,
    /// Mass matrix.
    pub mass: Mass,
    /// Modes of modal and elastica: 1 to 3.
    pub modes: usize,
    /// Work a tick of elastica.
    pub quality: Quality,
    /// Error of the tip that auto may make, fraction of L.
    pub tolerance: f64,
    /// Error of the torque that auto may make, fraction of its peak.
    pub torque_tolerance: f64,
    /// h, s.
    pub tick: f64,
    /// Precision of the tick.
    pub scalar: Scalar,
    /// Centrifugal stiffening and softening.
    pub spin: bool,
}

impl Method {
    /// Returns the default number of beam elements. They cost newmark time in the tick, modal only
    /// in set-up.
    fn elements(self) -> usize {
        if self == Self::Modal { 8 } else { 1 }
    }
}

impl Solver {
    /// The paper's own: Newmark's rule on one element, 10 ms, f32.
    pub const PAPER: Self = Self {
        method: Method::Newmark,
        elements: 1,
        mass: Mass::Consistent,
        modes: 2,
        quality: Quality::Fine,
        tolerance: 1e-3,
        torque_tolerance: 1e-2,
        tick: 0.01,
        scalar: Scalar::F32,
        spin: true,
    };
}

impl Default for Solver {
    /// Returns the solver that chooses the method for the scene, at the paper's tick.
    fn default() -> Self {
        Self { method: Method::Auto, ..Self::PAPER }
    }
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
            None => default.modes,
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

/// Returns the error of a number of elements that is not one of [`ELEMENTS`].
pub(crate) fn no_such_mesh(elements: impl Display) -> Error {
    let [few @ .., most] = ELEMENTS.map(|n| n.to_string());
    let few = few.join(", ");
    Error::new(format_args!("solver.elements = {elements}: must be {few} or {most}"))
}

/// Returns a tolerance, or an error if the value cannot be one.
fn fraction(key: &str, value: f64, of: &str) -> Result<f64, Error> {
    if (1e-6..=1.0).contains(&value) {
        return Ok(value);
    }
    Err(Error::new(format_args!("{key} = {value}: must be 0.000001 to 1, {of}")))
}

impl Solver {
    /// Describes the solver in a few words, e.g. `newmark, 4 consistent elements, 10 ms, f32`.
    pub fn describe(&self) -> String {
        let tick = self.tick * 1e3;
        let (method, scalar) = (self.method.name(), self.scalar.name());
        let spin = if self.spin { "" } else { ", no spin terms" };
        let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
        let elements = count(self.elements, &format!("{} element", self.mass.name()));
        let modes = count(self.modes, "mode");
        match self.method {
            Method::Rigid => format!("{method}, {tick} ms, {scalar}"),
            Method::Newmark => format!("{method}, {elements}, {tick} ms, {scalar}{spin}"),
            Method::Modal => format!("{method}, {modes} of {elements}, {tick} ms, {scalar}{spin}"),
            Method::Elastica => {
                format!("{method}, {modes}, {}, {tick} ms, {scalar}", self.quality.name())
            }
            Method::Auto => {
                let (tip, torque) = (self.tolerance, self.torque_tolerance);
                format!("{method}, within {tip} of L and {torque} of torque, {tick} ms, {scalar}")
            }
        }
    }
}
