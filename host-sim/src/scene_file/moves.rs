//! The moves of a scene file.

use serde::Deserialize;
use stillbeam::{Limits, Move, Profile};

use super::Step;
use crate::error::Error;
use crate::limits::Case;
use crate::plan::kept::Asked;

/// A `[move]` table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MoveTable {
    pub(super) profile: String,
    pub(super) duration: Option<f64>,
    pub(super) from: Option<f64>,
    pub(super) to: Option<f64>,
    rate: Option<f64>,
    robust: Option<f64>,
    #[serde(default)]
    settle: f64,
}

/// Context in which a still move is planned.
pub(super) struct Planning<'a> {
    /// The moves before the still move.
    pub before: Case<'a>,
    pub limits: &'a Limits,
    /// Number of moves in the scene.
    pub count: usize,
}

impl MoveTable {
    /// Builds the move. `at` is the angle where the move before it ends, `None` behind a turning
    /// hub.
    pub(super) fn build(
        &self,
        index: usize,
        at: &mut Option<f64>,
        planning: &Planning<'_>,
    ) -> Result<Step, Error> {
        if let (Some(from), true) = (self.from, index > 0)
            && *at != Some(from)
        {
            let wanted = at.map_or("absent behind a turning hub".to_owned(), |angle| {
                format!("{angle}, where the move before it ends, or absent")
            });
            return Err(Error::new(format_args!("from = {from}: must be {wanted}")));
        }
        if !(0.0..=1e6).contains(&self.settle) {
            return Err(Error::new(format_args!(
                "move.settle = {}: must be 0 to 1000000 s",
                self.settle
            )));
        }
        let refuse = |key: &str, value: Option<f64>| match value {
            Some(value) => Err(Error::new(format_args!(
                "move.{key} = {value}: must be absent with profile \"{}\"",
                self.profile
            ))),
            None => Ok(()),
        };
        let need = |key: &str, unit: &str, value: Option<f64>| {
            value.ok_or_else(|| {
                Error::new(format_args!(
                    "move.{key}: missing; must be a number in {unit} with profile \"{}\"",
                    self.profile
                ))
            })
        };
        if self.profile == "still" {
            refuse("rate", self.rate)?;
            let to = need("to", "rad", self.to)?;
            let from = at.replace(to);
            let from = from.ok_or_else(|| {
                Error::new(
                    "move.profile = \"still\": the hub must be at rest before it; put a spin-up to \
                     rate = 0 and a move to an angle before it",
                )
            })?;
            let Planning { before, limits, count } = *planning;
            let Self { duration, robust, settle, .. } = *self;
            let asked = Asked { before, limits, from, to, duration, robust, settle, count };
            let motion = asked.plan()?.plan.motion();
            return Ok(Step { motion, settle: self.settle });
        }
        refuse("robust", self.robust)?;
        let duration = need("duration", "s", self.duration)?;
        let motion = match self.profile.as_str() {
            "spin-up" => {
                refuse("to", self.to)?;
                let rate = need("rate", "rad/s", self.rate)?;
                *at = None;
                Move::SpinUp { duration, rate }
            }
            "dwell" => {
                refuse("to", self.to)?;
                refuse("rate", self.rate)?;
                Move::Dwell { duration }
            }
            name => {
                let profile = Profile::named(name).ok_or_else(|| {
                    let known = Profile::ALL.map(Profile::name).join(", ");
                    Error::new(format_args!(
                        "move.profile = \"{name}\": must be {known}, still, spin-up or dwell"
                    ))
                })?;
                refuse("rate", self.rate)?;
                let to = need("to", "rad", self.to)?;
                *at = Some(to);
                Move::To { profile, duration, to }
            }
        };
        Ok(Step { motion, settle: self.settle })
    }
}
