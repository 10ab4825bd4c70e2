//! The `[shaper]` table of the commanded motion.

use serde::Deserialize;
use stillbeam::Scene;
use stillbeam::motion::{Pulse, Shaper, ShaperKind};

use crate::error::Error;
use crate::reference::rod;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ShaperTable {
    kind: Option<String>,
    /// Undamped frequency, Hz. `None` takes the arm's own.
    frequency: Option<f64>,
    /// Damping ratio. `None` takes the arm's own.
    damping: Option<f64>,
    /// Pulses, each `[amplitude, delay in s]`.
    pulses: Option<Vec<[f64; 2]>>,
}

impl ShaperTable {
    pub(super) fn build(&self, arm: &Scene) -> Result<Shaper, Error> {
        match (&self.kind, &self.pulses) {
            (Some(kind), None) => self.named(kind, arm),
            (None, Some(pulses)) => {
                if let Some((key, value)) =
                    [("frequency", self.frequency), ("damping", self.damping)]
                        .into_iter()
                        .find_map(|(key, value)| Some((key, value?)))
                {
                    return Err(Error::new(format_args!(
                        "shaper.{key} = {value}: must be absent beside shaper.pulses, which need no \
                         frequency and no damping"
                    )));
                }
                let pulses: Vec<Pulse> =
                    pulses.iter().map(|&[amplitude, delay]| Pulse { amplitude, delay }).collect();
                Ok(Shaper::custom(&pulses)?)
            }
            _ => Err(Error::new("shaper: must be either shaper.kind or shaper.pulses")),
        }
    }

    fn named(&self, name: &str, arm: &Scene) -> Result<Shaper, Error> {
        let kind =
            ShaperKind::ALL.into_iter().find(|kind| kind.name() == name).ok_or_else(|| {
                let names = ShaperKind::ALL.map(ShaperKind::name).join(", ");
                Error::new(format_args!("shaper.kind = \"{name}\": must be one of {names}"))
            })?;
        let frequency = match self.frequency {
            Some(frequency) => frequency,
            None => 1.0 / rod::first_period(arm)?,
        };
        let damping = match self.damping {
            Some(damping) => damping,
            None => rod::first_damping_ratio(arm)?,
        };
        Ok(Shaper::new(kind, frequency, damping)?)
    }
}
