//! Reports as they come over the link.

use stillbeam_protocol::frame::decode;
use stillbeam_protocol::{Refusal, Report};

use super::Session;
use crate::error::Error;
use crate::talk::{Answer, Replica};

impl Session {
    /// Takes in the bytes that have come over the link.
    pub(super) fn take_in(&mut self) -> Result<(), Error> {
        for byte in self.machine.receive()? {
            let Some(frame) = self.link.push(byte) else { continue };
            let mut bytes = frame.map(|frame| frame.to_vec()).unwrap_or_default();
            match decode::<Report<'_>>(&mut bytes) {
                Ok(report) => self.sort(&report)?,
                // A board's line may begin in the middle of a frame.
                Err(_) if self.comparison.axes().is_empty() => {}
                Err(error) => {
                    return Err(Error::new(format_args!(
                        "link: a frame came in garbled, {error:?}"
                    )));
                }
            }
        }
        Ok(())
    }

    fn sort(&mut self, report: &Report<'_>) -> Result<(), Error> {
        let (sequence, answer) = match *report {
            Report::Tick { axis, tick, cause } => {
                self.comparison.push(axis, tick, cause);
                return Ok(());
            }
            Report::Description { sequence, description } => {
                self.comparison.expect(description.axes.into());
                let patient = !self.machine.is_emulated();
                let replica = Replica::new(&description, patient)?;
                self.comparison.add(replica, &description, self.loaded)?;
                self.open.retain(|open| *open != sequence);
                return Ok(());
            }
            Report::Accepted { sequence, tick } => (sequence, Answer::Accepted(tick)),
            Report::Refused { sequence, refusal } => {
                let why = refusal.to_string();
                let is_full = matches!(refusal, Refusal::Queue { .. });
                (sequence, if is_full { Answer::Full(why) } else { Answer::Refused(why) })
            }
            Report::Status { sequence, status } => (sequence, Answer::Status(status)),
            Report::Recording { sequence, column, .. } => {
                (sequence, Answer::Recording(column.to_owned()))
            }
            Report::Sample { axis, sample } => {
                // Those of a recording that another host has begun are not kept.
                if let Some((_, samples)) = self.samples.as_mut().filter(|(of, _)| *of == axis) {
                    samples.push(sample);
                }
                return Ok(());
            }
            Report::Recorded { sequence, samples, lost } => {
                (sequence, Answer::Recorded { samples, lost })
            }
        };
        let known = self.open.contains(&sequence);
        self.open.retain(|open| *open != sequence);
        if known {
            self.answers.push_back((sequence, answer));
        }
        Ok(())
    }
}
