//! Still moves compared with other motions of the same duration.

use std::f64::consts::PI;

use rayon::prelude::*;
use stillbeam::motion::{Shaper, ShaperKind};
use stillbeam::planner::{Planner, Request};
use stillbeam::{Error as CoreError, Move, Profile, Scene};

use super::judge::{self, Judgement, Motion};
use crate::error::Error;
use crate::number::Digits;
use crate::reference::rod;

/// Frequency errors of the table's columns.
pub const ERRORS: [f64; 7] = [-0.2, -0.1, -0.05, 0.0, 0.05, 0.1, 0.2];

/// Head of the table.
pub const HEADER: [&str; ERRORS.len() + 4] = [
    "motion",
    "\u{2212}20 %",
    "\u{2212}10 %",
    "\u{2212}5 %",
    "0 %",
    "+5 %",
    "+10 %",
    "+20 %",
    "rate",
    "acceleration",
    "torque",
];

/// Frequency band for which the robust entry is planned, ± fraction.
pub const SPREAD: f64 = 0.2;

/// Name of the robust entry.
pub const ROBUST: &str = "still, robust to \u{b1}20 %";

/// One motion and its residual vibration.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name in the table.
    pub name: String,
    /// Judgement for each of [`ERRORS`].
    pub judgements: Vec<Judgement>,
}

impl Entry {
    /// Returns the residual for each of [`ERRORS`], fraction of L.
    pub fn residuals(&self) -> impl Iterator<Item = f64> + '_ {
        self.judgements.iter().map(|judgement| judgement.residual)
    }

    /// Returns a row of the table, see [`HEADER`]: residuals in % of L, rate in π/T, acceleration
    /// in π/T², torque in mN m.
    pub fn cells(&self, duration: f64) -> Vec<String> {
        let nominal = self.nominal();
        std::iter::once(self.name.clone())
            .chain(self.residuals().map(|residual| Digits::Column.show(100.0 * residual)))
            .chain([
                format!("{:.2}", nominal.rate * duration / PI),
                format!("{:.2}", nominal.acceleration * duration * duration / PI),
                format!("{:.1}", 1e3 * nominal.torque),
            ])
            .collect()
    }

    /// Returns the run with the frequency for which the motion was planned.
    pub fn nominal(&self) -> &Judgement {
        &self.judgements[ERRORS.len() / 2]
    }
}

/// Judges every motion from 0 to `to` rad in the same `duration` s, shapers included. Motions for
/// which the duration is too short are left out.
pub fn entries(
    arm: &Scene,
    to: f64,
    duration: f64,
    tick: f64,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Entry>, Error> {
    let motions = motions(arm, to, duration, tick)?;
    motions
        .into_par_iter()
        .map(|(name, motion)| {
            let judged = |&error: &f64| motion.judge_with(arm, error, &judge::BRISK);
            let judgements = ERRORS.par_iter().map(judged).collect::<Result<_, _>>()?;
            done();
            Ok(Entry { name, judgements })
        })
        .collect()
}

/// Returns the motions by name.
pub(super) fn motions(
    arm: &Scene,
    to: f64,
    duration: f64,
    tick: f64,
) -> Result<Vec<(String, Motion)>, Error> {
    let period = rod::first_period(arm)?;
    let damping = rod::first_damping_ratio(arm)?;
    let mut all = Vec::new();
    let profiles = [Profile::Cubic, Profile::Quintic, Profile::Cycloid, Profile::SCurve];
    for profile in profiles {
        let of = |duration| Motion::of(0.0, Move::To { profile, duration, to }, tick);
        all.push((profile.name().to_owned(), of(duration)));
        for kind in [ShaperKind::Zv, ShaperKind::Mzv, ShaperKind::Zvd, ShaperKind::Ei] {
            let shaper = Shaper::new(kind, 1.0 / period, damping)?;
            // Whole ticks for the base motion; the shaper takes what is left, or a little less.
            let base = ((duration - shaper.delay()) / tick + 1e-9).floor() * tick;
            if base >= LEAST_BASE * period {
                let name = format!("{}, {}", profile.name(), kind.name().to_uppercase());
                all.push((name, of(base).shaped(shaper)));
            }
        }
    }
    let request = Request::from_rest(0.0, to).duration(duration).any_deflection();
    let still = Planner::<f32, 2>::new(arm, tick)?.plan(&request);
    let robust = Planner::<f32, 2>::robust(arm, tick, SPREAD)?.plan(&request);
    for (name, plan) in [("still", still), (ROBUST, robust)] {
        match plan {
            Ok(plan) => all.push((name.to_owned(), Motion::of(0.0, plan.motion(), tick))),
            Err(CoreError::NotStill { .. } | CoreError::TooShort { .. }) => {}
            Err(error) => return Err(error.into()),
        }
    }
    Ok(all)
}

/// Shortest base motion of a shaped one, first periods.
const LEAST_BASE: f64 = 0.25;
