//! Recordings of one axis: hub angle and sensor, a row a tick.

use stillbeam::Angle;
use stillbeam::axis::Timing;
use stillbeam_protocol::Sample;

/// A row of a recording on its way to the host.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Recording {
    /// A sample.
    Row(Sample),
    /// The end, behind the last sample: the request that asked for it, and what came of it.
    End {
        /// Sequence number of the request.
        sequence: u16,
        /// Samples that were handed on.
        samples: u32,
        /// Samples that found no room, or no hub angle.
        lost: u32,
    },
}

/// Recorder of one axis. It keeps no samples: each is handed on in its tick or lost, and counted
/// either way.
#[derive(Clone, Copy, Debug, Default)]
pub struct Recorder {
    phase: Phase,
    /// Ticks since the first, those that did not take place included.
    periods: u32,
    samples: u32,
    lost: u32,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Phase {
    #[default]
    Off,
    /// Begins with the next tick.
    Begins,
    On,
    /// Ends with the next tick, for that request.
    Ends(u16),
}

impl Recorder {
    /// A recorder that is off.
    pub const OFF: Self = Self { phase: Phase::Off, periods: 0, samples: 0, lost: 0 };

    /// Begins a recording with the next tick. One that is under way begins anew.
    pub fn begin(&mut self) {
        *self = Self { phase: Phase::Begins, ..Self::OFF };
    }

    /// Ends the recording with the next tick, which hands [`Recording::End`] on. Returns false if
    /// there is none to end.
    pub fn end(&mut self, sequence: u16) -> bool {
        let is_on = matches!(self.phase, Phase::Begins | Phase::On);
        if is_on {
            self.phase = Phase::Ends(sequence);
        }
        is_on
    }

    /// Ends the recording without a word, as when nobody listens any more.
    pub fn drop_it(&mut self) {
        self.phase = Phase::Off;
    }

    /// True between the beginning and the end.
    pub fn is_on(&self) -> bool {
        self.phase != Phase::Off
    }

    /// Takes the sample of a tick and hands it to `hand_on`, which returns false if it has no room.
    ///
    /// `period` is the tick in µs and `late` its lateness in µs. Without a hub angle the sample is
    /// lost. An end that finds no room is handed on a tick later, so that it is never lost.
    pub fn tick(
        &mut self,
        timing: &Timing,
        [period, late]: [u32; 2],
        hub: Option<Angle<f32>>,
        read: impl FnOnce(u32, Angle<f32>) -> f32,
        hand_on: impl FnOnce(Recording) -> bool,
    ) {
        match self.phase {
            Phase::Off => return,
            Phase::Ends(sequence) => {
                let (samples, lost) = (self.samples, self.lost);
                if hand_on(Recording::End { sequence, samples, lost }) {
                    self.phase = Phase::Off;
                }
                return;
            }
            // Times count from here, to the due time of the tick.
            Phase::Begins => (self.phase, self.periods) = (Phase::On, 0),
            Phase::On => self.periods = self.periods.wrapping_add(1 + timing.missed),
        }
        let time = self.periods.wrapping_mul(period).wrapping_add(late);
        let taken = hub.is_some_and(|hub| {
            hand_on(Recording::Row(Sample { time, hub, value: read(time, hub) }))
        });
        let counter = if taken { &mut self.samples } else { &mut self.lost };
        *counter = counter.wrapping_add(1);
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;

    const HUB: Option<Angle<f32>> = Some(Angle { turns: 1, part: 0.25 });
    const ON_TIME: Timing = Timing { due: true, early: 0, late: 0, missed: 0 };

    /// Makes ticks, each with room or without, and returns what was handed on.
    fn ticks(recorder: &mut Recorder, rooms: &[bool]) -> Vec<Recording> {
        let mut handed = Vec::new();
        for &room in rooms {
            recorder.tick(
                &ON_TIME,
                [10_000, 0],
                HUB,
                |_, _| 0.5,
                |row| {
                    if room {
                        handed.push(row);
                    }
                    room
                },
            );
        }
        handed
    }

    #[test]
    fn what_finds_no_room_is_counted_and_leaves_a_gap_in_the_times() {
        let mut recorder = Recorder::OFF;
        assert!(ticks(&mut recorder, &[true]).is_empty() && !recorder.end(1));
        recorder.begin();
        let rows = ticks(&mut recorder, &[true, false, false, true]);
        let sample = |time| Recording::Row(Sample { time, hub: HUB.unwrap(), value: 0.5 });
        assert_eq!(rows, [sample(0), sample(30_000)]);
        assert!(recorder.end(7));
        let end = ticks(&mut recorder, &[false, true, true]);
        assert_eq!(end, [Recording::End { sequence: 7, samples: 2, lost: 2 }]);
        assert!(!recorder.is_on());
    }

    #[test]
    fn times_hold_missed_and_late_ticks() {
        let mut recorder = Recorder::OFF;
        recorder.begin();
        let mut times = Vec::new();
        for (missed, late) in [(3, 0), (0, 40), (2, 5)] {
            let timing = Timing { missed, ..ON_TIME };
            let read = |time, _| {
                times.push(time);
                0.0
            };
            recorder.tick(&timing, [10_000, late], HUB, read, |_| true);
        }
        // What was missed before the first tick is before the recording.
        assert_eq!(times, [0, 10_040, 40_005]);
    }

    #[test]
    fn a_sample_without_a_hub_angle_is_lost() {
        let mut recorder = Recorder::OFF;
        recorder.begin();
        recorder.tick(&ON_TIME, [10_000, 0], None, |_, _| unreachable!(), |_| unreachable!());
        assert!(recorder.end(3));
        let end = ticks(&mut recorder, &[true]);
        assert_eq!(end, [Recording::End { sequence: 3, samples: 0, lost: 1 }]);
    }
}
