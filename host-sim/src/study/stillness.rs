//! Still moves compared with the usual ones, shaped or not, in the same time.

use std::f64::consts::PI;

use stillbeam::Scene;

use crate::error::Error;
use crate::plan::comparison::{self, Entry};
use crate::plan::picture::{self, Curve};
use crate::reference::rod;
use crate::scenes;

/// Duration of every motion, delay of its shaper included, first periods.
pub const PERIODS: f64 = 2.0;

/// Setpoint interval, s.
const TICK: f64 = 0.01;

/// A half turn of member A with 30 g by every motion, simulated with the reference rod.
#[derive(Clone, Debug)]
pub struct Stillness {
    /// Member A with 30 g.
    pub arm: Scene,
    /// `2π/ω₁`, s.
    pub period: f64,
    /// Duration of every motion, s.
    pub duration: f64,
    /// The motions, as in `docs/still.md`.
    pub entries: Vec<Entry>,
    /// Residual over frequency error of a few of them.
    pub curves: Vec<Curve>,
}

impl Stillness {
    /// Simulates the rod some 250 times. `done` is called now and then.
    pub fn compute(done: &(dyn Fn() + Sync)) -> Result<Self, Error> {
        let arm = scenes::open("a-tip30")?.arm;
        let period = rod::first_period(&arm)?;
        let duration = (PERIODS * period / TICK).round() * TICK;
        let entries = comparison::entries(&arm, PI, duration, TICK, done)?;
        let curves = picture::curves(&arm, PI, duration, TICK, done)?;
        Ok(Self { arm, period, duration, entries, curves })
    }

    /// Returns the motion of that name.
    pub fn entry(&self, name: &str) -> Option<&Entry> {
        self.entries.iter().find(|entry| entry.name == name)
    }
}
