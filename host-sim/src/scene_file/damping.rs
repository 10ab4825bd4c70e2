//! The `[damping]` table: α, β and the joint's β_J, or measured damping ratios.

use std::f64::consts::TAU;

use serde::Deserialize;
use stillbeam::{Damping, Scene};

use super::deduced::Deduced;
use super::values::Modes;
use crate::arm::natural;
use crate::error::Error;

/// A `[damping]` table.
#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct DampingTable {
    alpha: Option<f64>,
    beta: Option<f64>,
    joint: Option<f64>,
    /// Damping ratio of the joint.
    joint_ratio: Option<f64>,
    /// Damping ratio of the first mode, or of the first two.
    ratio: Option<Modes>,
    /// The term that one ratio is made by.
    from: Option<Term>,
}

/// A term of the damping.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Term {
    Alpha,
    Beta,
    Joint,
}

/// The first two modes of the undamped arm.
struct Undamped {
    /// Angular frequencies, rad/s.
    omega: [f64; 2],
    /// The joint's shares of the strain energy.
    joint: [f64; 2],
}

impl DampingTable {
    /// Builds the damping of `arm`, which is complete in all else.
    pub(super) fn build(&self, arm: &Scene, deduced: &mut Deduced) -> Result<Damping, Error> {
        self.refuse_clashes(arm)?;
        let mut damping = Damping {
            alpha: self.alpha.unwrap_or(0.0),
            beta: self.beta.unwrap_or(0.0),
            joint: self.joint.unwrap_or(0.0),
        };
        if let Some(ratio) = self.joint_ratio {
            check("joint_ratio", &[ratio], &ratio.to_string())?;
            let first = TAU * natural::frequencies(arm)?[0];
            damping.joint = Damping::joint_of_ratio(ratio, first);
            deduced.joint_damping(damping.joint, ratio.to_string());
        }
        if let Some(ratio) = &self.ratio {
            check("ratio", &ratio.0, &ratio.text())?;
            damping = self.of_ratio(ratio, &Undamped::of(arm)?, damping)?;
            if damping.alpha != 0.0 && arm.mount.carrier != 0.0 {
                return Err(Error::new(format_args!(
                    "damping.ratio = {}: must not make alpha with carrier.rate = {}, as the drag would \
                     bend the arm at rest; give one ratio and damping.from = \"beta\"",
                    ratio.text(),
                    arm.mount.carrier
                )));
            }
            deduced.damping(&damping, self.joint_ratio.is_none(), ratio.text());
        }
        Ok(damping)
    }

    /// Refuses keys that say twice, or nothing.
    fn refuse_clashes(&self, arm: &Scene) -> Result<(), Error> {
        let clash = |key: &str, value: f64, other: &str| {
            Err(Error::new(format_args!(
                "damping.{key} = {value}: must be absent beside damping.{other}, which gives it"
            )))
        };
        if self.ratio.is_some() {
            for (key, value) in [("alpha", self.alpha), ("beta", self.beta)] {
                if let Some(value) = value {
                    return clash(key, value, "ratio");
                }
            }
        } else if let Some(term) = self.from {
            return Err(Error::new(format_args!(
                "damping.from = \"{}\": must be absent without damping.ratio",
                term.name()
            )));
        }
        if let (Some(joint), Some(_)) = (self.joint, self.joint_ratio) {
            return clash("joint", joint, "joint_ratio");
        }
        let joint = [("joint", self.joint), ("joint_ratio", self.joint_ratio)];
        let mut joint = joint.into_iter().filter_map(|(key, value)| Some((key, value?)));
        match (joint.next(), arm.hub.stiffness) {
            (Some((key, value)), None) => Err(Error::new(format_args!(
                "damping.{key} = {value}: must be beside hub.stiffness in N m/rad, as a clamp that \
                 does not give damps nothing"
            ))),
            (Some((key, value)), Some(_)) if self.from == Some(Term::Joint) => {
                clash(key, value, "from = \"joint\"")
            }
            _ => Ok(()),
        }
    }

    /// Returns `known` with the terms that make the measured ratio, or the two.
    fn of_ratio(&self, ratio: &Modes, modes: &Undamped, known: Damping) -> Result<Damping, Error> {
        let text = ratio.text();
        // What is left by a joint whose damping is known.
        let left = |i: usize| {
            let own = 0.5 * modes.joint[i] * known.joint * modes.omega[i];
            let left = ratio.0[i] - own;
            if left >= 0.0 {
                return Ok(left);
            }
            Err(Error::new(format_args!(
                "damping.ratio = {text}: must be at least {own:.4} of mode {}, which the joint makes \
                 alone",
                i + 1
            )))
        };
        match (ratio.0.len(), self.from) {
            (1, Some(term)) => term.with_ratio(left(0)?, modes, known),
            (1, None) => Err(Error::new(format_args!(
                "damping.ratio = {text}: must be beside damping.from: \"beta\", damping that grows \
                 with frequency as in the link itself, \"alpha\", as in air, or \"joint\"; or be two \
                 ratios, of modes 1 and 2"
            ))),
            (2, None) => both([left(0)?, left(1)?], &text, modes, known),
            (2, Some(term)) => Err(Error::new(format_args!(
                "damping.from = \"{}\": must be absent beside two ratios, which give both alpha and \
                 beta",
                term.name()
            ))),
            _ => Err(Error::new(format_args!(
                "damping.ratio = {text}: must be one ratio or two, of modes 1 and 2"
            ))),
        }
    }
}

impl Undamped {
    fn of(arm: &Scene) -> Result<Self, Error> {
        let (frequency, joint) = (natural::frequencies(arm)?, natural::joint_shares(arm)?);
        Ok(Self { omega: [0, 1].map(|i| TAU * frequency[i]), joint: [joint[0], joint[1]] })
    }
}

impl Term {
    fn name(self) -> &'static str {
        match self {
            Self::Alpha => "alpha",
            Self::Beta => "beta",
            Self::Joint => "joint",
        }
    }

    /// Returns `known` and the term by which the first mode has that ratio: `ζ = α/2ω`, `βω/2` or
    /// `eβ_Jω/2`, e the joint's share of the strain energy.
    fn with_ratio(self, ratio: f64, modes: &Undamped, known: Damping) -> Result<Damping, Error> {
        let (omega, share) = (modes.omega[0], modes.joint[0]);
        match self {
            Self::Alpha => Ok(Damping { alpha: 2.0 * ratio * omega, ..known }),
            Self::Beta => Ok(Damping { beta: 2.0 * ratio / omega, ..known }),
            Self::Joint if share > 0.0 => {
                Ok(Damping { joint: 2.0 * ratio / (share * omega), ..known })
            }
            Self::Joint => Err(Error::new(
                "damping.from = \"joint\": must be beside hub.stiffness in N m/rad, as a clamp that \
                 does not give damps nothing",
            )),
        }
    }
}

/// Refuses what is no damping ratio.
fn check(key: &str, ratios: &[f64], text: &str) -> Result<(), Error> {
    if ratios.iter().all(|ratio| (0.0..1.0).contains(ratio)) {
        return Ok(());
    }
    Err(Error::new(format_args!(
        "damping.{key} = {text}: must be 0 to less than 1, a fraction of critical damping (1 % is \
         0.01)"
    )))
}

/// Returns `known` with the α and β of `ζᵢ = (α/ωᵢ + βωᵢ)/2` for the first two modes.
fn both(ratio: [f64; 2], text: &str, modes: &Undamped, known: Damping) -> Result<Damping, Error> {
    let [first, second] = modes.omega;
    let span = second * second - first * first;
    let alpha = 2.0 * first * second * (ratio[0] * second - ratio[1] * first) / span;
    let beta = 2.0 * (ratio[1] * second - ratio[0] * first) / span;
    // What one term alone gives is not refused for its rounding.
    let least = -1e-9;
    if alpha < least * first || beta < least / second {
        let times = second / first;
        return Err(Error::new(format_args!(
            "damping.ratio = {text}: the second must be {:.3e} to {:.3e} beside this first, else \
             alpha or beta is negative; or give one ratio and damping.from",
            ratio[0] / times,
            ratio[0] * times
        )));
    }
    Ok(Damping { alpha: alpha.max(0.0), beta: beta.max(0.0), ..known })
}
