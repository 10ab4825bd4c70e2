//! The moves of a scene file.

use serde::Deserialize;
use stillbeam::{Limits, Move, Profile};

use super::Step;
use super::waypoints::Rows;
use crate::error::Error;
use crate::limits::{self, Case};
use crate::plan::asked::Asked;
use crate::plan::kept::GOAL;
use crate::plan::{Options, options, shortest};
use crate::step::Motion;

/// A `[move]` table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MoveTable {
    pub(super) profile: Option<String>,
    pub(super) duration: Option<f64>,
    pub(super) from: Option<f64>,
    pub(super) to: Option<f64>,
    pub(super) rate: Option<f64>,
    /// Rows of time, angle, rate and acceleration.
    pub(super) waypoints: Option<Vec<Vec<f64>>>,
    pub(super) repeat: Option<u32>,
    pub(super) robust: Option<f64>,
    /// Quantity that a still move keeps least: `time`, `acceleration` or `effort`.
    least: Option<String>,
    /// Residual that a still move may leave, of L.
    within: Option<f64>,
    /// True for a still move without a jump of the acceleration at its ends.
    eased: Option<bool>,
    /// True for a move that passes into the next one.
    #[serde(default)]
    pub(super) blend: bool,
    #[serde(default)]
    pub(super) settle: f64,
}

/// Context in which a move is planned.
pub(super) struct Planning<'a> {
    /// The moves before it.
    pub before: Case<'a>,
    pub limits: &'a Limits,
    /// Number of moves in the scene.
    pub count: usize,
}

/// A move that was built, and what was found for it.
pub(super) struct Built {
    /// The move, with the time to settle after it.
    pub step: Step,
    /// Rate with which a blended move passes its end, rad/s.
    pub passes: Option<f64>,
}

/// The hub where a move begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Here {
    /// Angle, rad; `None` behind a change of the rate.
    pub angle: Option<f64>,
    /// Rate, rad/s.
    pub rate: f64,
}

impl MoveTable {
    /// Angle at the beginning of a scene whose first move this is, rad.
    pub(super) fn begin(&self) -> f64 {
        let row = self.waypoints.as_ref().and_then(|rows| rows.first());
        let first = row.filter(|row| row.first() == Some(&0.0)).and_then(|row| row.get(1));
        self.from.or(first.copied()).unwrap_or(0.0)
    }

    /// Returns the indices of the moves whose duration is to be found.
    pub(super) fn without_duration(tables: &[Self]) -> Vec<usize> {
        let lasts = |table: &Self| table.duration.is_some() || table.waypoints.is_some();
        (0..tables.len()).filter(|&index| !lasts(&tables[index])).collect()
    }

    /// Builds the move that begins where the hub is `here`, and moves `here` to its end. `next` is
    /// the move behind it.
    pub(super) fn build(
        &self,
        index: usize,
        next: Option<&Self>,
        here: &mut Here,
        planning: &Planning<'_>,
    ) -> Result<Built, Error> {
        if let (Some(from), true) = (self.from, index > 0)
            && here.angle != Some(from)
        {
            let wanted = here.angle.map_or("absent behind a turning hub".to_owned(), |angle| {
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
        if self.profile.as_deref() != Some("still") {
            let least = self.least.as_ref().map(|least| format!("least = \"{least}\""));
            let within = self.within.map(|within| format!("within = {within}"));
            let eased = self.eased.map(|eased| format!("eased = {eased}"));
            if let Some(key) = least.or(within).or(eased) {
                return Err(Error::new(format_args!(
                    "move.{key}: must be absent; only a move with profile = \"still\" has it"
                )));
            }
        }
        if self.blend {
            let motion = self.blended(next, here, planning)?;
            let passes = Some(here.rate);
            return Ok(Built { step: Step { motion: motion.into(), settle: 0.0 }, passes });
        }
        let motion = match (&self.waypoints, self.profile.as_deref()) {
            (Some(rows), _) => self.path(rows, here)?,
            (None, Some("still")) => self.still(here, planning)?,
            (None, Some(name @ ("reach" | "ramp"))) => self.optimal(name, here, planning)?.into(),
            (None, _) => self.plain(here, planning)?.into(),
        };
        Ok(Built { step: Step { motion, settle: self.settle }, passes: None })
    }

    fn path(&self, rows: &[Vec<f64>], here: &mut Here) -> Result<Motion, Error> {
        for (key, value) in [
            ("duration", self.duration),
            ("to", self.to),
            ("rate", self.rate),
            ("robust", self.robust),
        ] {
            if let Some(value) = value {
                return Err(Error::new(format_args!(
                    "move.{key} = {value}: must be absent beside move.waypoints, whose rows say it"
                )));
            }
        }
        let at = here.angle.filter(|_| here.rate == 0.0);
        let profile = self.profile.as_deref();
        let path = Rows { rows, profile, repeat: self.repeat, at }.build()?;
        *here = Here { angle: Some(path.end_angle()), rate: path.end_rate() };
        Ok(Motion::Path(path))
    }

    fn still(&self, here: &mut Here, planning: &Planning<'_>) -> Result<Motion, Error> {
        self.refuse("rate", self.rate)?;
        self.refuse("repeat", self.repeat)?;
        let to = self.need("to", "rad", self.to)?;
        let from = here.angle.filter(|_| here.rate == 0.0).ok_or_else(|| {
            Error::new(
                "move.profile = \"still\": the hub must be at rest before it; put a spin-up to \
                 rate = 0 and a move to an angle before it",
            )
        })?;
        *here = Here { angle: Some(to), rate: 0.0 };
        let Planning { before, limits, count } = *planning;
        let Self { duration, robust, settle, .. } = *self;
        let piecewise = self.least.is_some() || self.within.is_some();
        let least = match self.least.as_deref() {
            None | Some("time") => None,
            Some(name) => Some(options::least(name)?),
        };
        if self.least.as_deref() == Some("time")
            && let Some(duration) = duration
        {
            return Err(Error::new(format_args!(
                "move.duration = {duration}: must be absent beside move.least = \"time\""
            )));
        }
        let eased = self.eased.unwrap_or(false);
        let options = Options { residual: self.within, least, eased };
        let asked = Asked { before, limits, from, to, duration, robust, options, settle, count };
        if piecewise {
            let found = asked.plan_piecewise()?;
            return Ok(shortest::path(&found));
        }
        Ok(asked.plan()?.plan.motion().into())
    }

    /// Builds a move to an angle in a given or in the shortest duration, a spin-up or a dwell.
    pub(super) fn plain(&self, here: &mut Here, planning: &Planning<'_>) -> Result<Move, Error> {
        self.refuse("robust", self.robust)?;
        self.refuse("repeat", self.repeat)?;
        let duration = self.duration.unwrap_or(1.0);
        let motion = match self.name()? {
            "spin-up" => {
                self.refuse("to", self.to)?;
                let rate = self.need("rate", "rad/s", self.rate)?;
                *here = Here { angle: None, rate };
                Move::SpinUp { duration, rate }
            }
            "dwell" => {
                self.refuse("to", self.to)?;
                self.refuse("rate", self.rate)?;
                self.need("duration", "s", self.duration)?;
                Move::Dwell { duration }
            }
            name => {
                let profile = Profile::named(name).ok_or_else(|| unknown(name))?;
                let to = self.need("to", "rad", self.to)?;
                let rate = self.rate.unwrap_or(0.0);
                let from_rest = here.rate == 0.0 && rate == 0.0;
                *here = Here { angle: Some(to), rate };
                if from_rest {
                    Move::To { profile, duration, to }
                } else {
                    Move::Pass { profile, duration, to, rate }
                }
            }
        };
        match self.duration {
            Some(_) => Ok(motion),
            None => Ok(motion.lasting(self.shortest(motion, planning)?)),
        }
    }

    /// Returns the shortest duration of a move that keeps the scene's limits, s.
    fn shortest(&self, motion: Move, planning: &Planning<'_>) -> Result<f64, Error> {
        let Planning { before, limits, .. } = planning;
        if **limits == Limits::default() {
            self.need("duration", "s, or [limits] must be given,", self.duration)?;
        }
        let mut steps = before.steps.to_vec();
        steps.push(Step { motion: motion.into(), settle: self.settle });
        limits::shortest(&before.with(&steps), &planning.aimed(), &|_| ())
    }

    pub(super) fn name(&self) -> Result<&str, Error> {
        self.profile.as_deref().ok_or_else(|| {
            Error::new(format_args!("move.profile: missing; must be {}, or waypoints", profiles()))
        })
    }

    pub(super) fn refuse(
        &self,
        key: &str,
        value: Option<impl std::fmt::Display>,
    ) -> Result<(), Error> {
        match value {
            Some(value) => Err(Error::new(format_args!(
                "move.{key} = {value}: must be absent with profile \"{}\"",
                self.name()?
            ))),
            None => Ok(()),
        }
    }

    pub(super) fn need(&self, key: &str, unit: &str, value: Option<f64>) -> Result<f64, Error> {
        match value {
            Some(value) => Ok(value),
            None => Err(Error::new(format_args!(
                "move.{key}: missing; must be a number in {unit} with profile \"{}\"",
                self.name()?
            ))),
        }
    }
}

fn unknown(name: &str) -> Error {
    Error::new(format_args!("move.profile = \"{name}\": must be {}", profiles()))
}

fn profiles() -> String {
    let shapes = Profile::ALL.map(Profile::name).join(", ");
    format!("{shapes}, still, reach, ramp, spin-up or dwell")
}

impl Planning<'_> {
    /// Returns the limits with that of the torque lowered to what is aimed at: a method's own
    /// setpoints, good to a hundredth of the peak, then keep the limit too.
    pub(super) fn aimed(&self) -> Limits {
        let torque = self.limits.torque.map(|most| GOAL * most);
        Limits { torque, ..*self.limits }
    }
}
