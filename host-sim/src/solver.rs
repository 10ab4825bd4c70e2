//! The solver of a run: the command line precedes the scene file, the scene file the defaults.

use std::fmt::Display;
use std::ops::RangeInclusive;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::error::Error;
use crate::number::short_percent;

mod keys;

pub use keys::SolverKeys;

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
        /// Exact kinematics at points along the link, in up to three modes.
        Pointwise = "pointwise",
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

/// Numbers of modes that modal, elastica and pointwise are built for.
pub const MODES: RangeInclusive<usize> = 1..=3;

/// A solver with every key resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solver {
    /// Stepper.
    pub method: Method,
    /// Beam elements: 1, 2, 4 or 8.
    pub elements: usize,
    /// Mass matrix.
    pub mass: Mass,
    /// Modes of modal, elastica and pointwise: 1 to 3.
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

    /// Returns the default number of modes. The third is what pointwise is for.
    fn modes(self) -> usize {
        if self == Self::Pointwise { 3 } else { Solver::PAPER.modes }
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

/// Returns the error of a number of elements that is not one of [`ELEMENTS`].
pub(crate) fn no_such_mesh(elements: impl Display) -> Error {
    let [few @ .., most] = ELEMENTS.map(|n| n.to_string());
    let few = few.join(", ");
    Error::new(format_args!("solver.elements = {elements}: must be {few} or {most}"))
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
            Method::Pointwise => format!("{method}, {modes}, {tick} ms, {scalar}"),
            Method::Auto => {
                let tip = short_percent(self.tolerance, 4);
                let torque = short_percent(self.torque_tolerance, 4);
                format!("{method}, within {tip} of L and {torque} of torque, {tick} ms, {scalar}")
            }
        }
    }
}
