//! Watches what a drive says of itself: an axis does not go on without its drive.

use stillbeam::axis::{Cause, Mode};
use stillbeam::drive::Condition;

/// Time without a heartbeat after which a drive counts as lost, s: three of ODrive's default
/// intervals of 100 ms, and a half.
pub const PATIENCE: f64 = 0.35;

/// Time that a drive may take to switch on, s.
pub const SWITCH_ON: f64 = 1.0;

/// The last that was heard of a drive. It is watched from its first heartbeat on: a drive that
/// sends none is not taken for lost.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    /// Condition in the latest heartbeat.
    condition: Option<Condition>,
    /// Ticks since that heartbeat.
    silence: u32,
    /// Ticks since the axis was disabled.
    enabled: u32,
    /// True if the drive has been on since the axis was disabled.
    was_on: bool,
    /// [`PATIENCE`] and [`SWITCH_ON`] in ticks.
    patience: u32,
    switch_on: u32,
}

impl Watch {
    /// Watches a drive of an axis with ticks of `tick` s.
    pub fn new(tick: f64) -> Self {
        let ticks = |time: f64| ((time / tick) as u32).max(1);
        Self {
            condition: None,
            silence: 0,
            enabled: 0,
            was_on: false,
            patience: ticks(PATIENCE),
            switch_on: ticks(SWITCH_ON),
        }
    }

    /// Takes note of a heartbeat.
    pub fn heard(&mut self, condition: Condition) {
        self.condition = Some(condition);
        self.silence = 0;
    }

    /// The condition in the latest heartbeat, if one has come.
    pub fn condition(&self) -> Option<Condition> {
        self.condition
    }

    /// True if the drive has sent heartbeats and none for [`PATIENCE`].
    pub fn is_silent(&self) -> bool {
        self.condition.is_some() && self.silence > self.patience
    }

    /// Judges the drive at a tick in that mode, before which `missed` ticks did not take place.
    /// Returns the reason for which the axis has to stop, if there is one.
    ///
    /// A drive that was never on since the axis was enabled has [`SWITCH_ON`] to get there. One
    /// that was on may not be anything else.
    #[inline(always)]
    pub fn tick(&mut self, missed: u32, mode: Mode) -> Option<Cause> {
        let condition = self.condition?;
        let passed = missed.saturating_add(1);
        self.silence = self.silence.saturating_add(passed);
        if mode == Mode::Disabled {
            (self.enabled, self.was_on) = (0, false);
            return None;
        }
        self.enabled = self.enabled.saturating_add(passed);
        let faulty = match condition {
            Condition::Fault(_) => true,
            Condition::On => {
                self.was_on = true;
                false
            }
            Condition::Off | Condition::Busy => self.was_on || self.enabled > self.switch_on,
        };
        if faulty {
            return Some(Cause::DriveFault);
        }
        self.is_silent().then_some(Cause::DriveLost)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ticks of 10 ms with a heartbeat every tenth. Returns the tick of the first reason and the
    /// reason.
    fn first(
        watch: &mut Watch,
        ticks: u32,
        mut condition: impl FnMut(u32) -> Option<Condition>,
    ) -> Option<(u32, Cause)> {
        (0..ticks).find_map(|k| {
            if k % 10 == 0
                && let Some(condition) = condition(k)
            {
                watch.heard(condition);
            }
            watch.tick(0, Mode::Enabled).map(|cause| (k, cause))
        })
    }

    #[test]
    fn a_drive_that_sends_no_heartbeat_is_not_watched() {
        assert_eq!(first(&mut Watch::new(0.01), 10_000, |_| None), None);
    }

    #[test]
    fn a_drive_that_falls_silent_is_lost_after_the_patience() {
        let mut watch = Watch::new(0.01);
        let beats = |k| (k < 100).then_some(Condition::On);
        // The last heartbeat comes before tick 90.
        assert_eq!(first(&mut watch, 1000, beats), Some((90 + 35, Cause::DriveLost)));
        assert!(watch.is_silent());
        watch.heard(Condition::On);
        assert_eq!((watch.is_silent(), watch.tick(0, Mode::Enabled)), (false, None));
        // Missed ticks are time as well.
        assert_eq!(watch.tick(40, Mode::Enabled), Some(Cause::DriveLost));
    }

    #[test]
    fn a_drive_that_leaves_operation_has_failed_at_once() {
        for end in [Condition::Fault(7), Condition::Off, Condition::Busy] {
            let mut watch = Watch::new(0.01);
            let condition = |k| Some(if k < 50 { Condition::On } else { end });
            assert_eq!(first(&mut watch, 1000, condition), Some((50, Cause::DriveFault)));
        }
    }

    #[test]
    fn a_drive_has_its_time_to_switch_on() {
        let mut watch = Watch::new(0.01);
        let slow = |k| Some(if k < 90 { Condition::Off } else { Condition::On });
        assert_eq!(first(&mut watch, 1000, slow), None);
        // Off again with the axis: the next enabling begins anew.
        assert_eq!(watch.tick(0, Mode::Disabled), None);
        let never = |_| Some(Condition::Off);
        assert_eq!(first(&mut watch, 1000, never), Some((100, Cause::DriveFault)));
    }
}
