//! Commands to a drive at a tick.

use stillbeam::axis::{Cause, Mode, Tick};
use stillbeam::motor::{Demand, Drivetrain};

/// A tick of one axis on its way to drive and host.
#[derive(Clone, Copy, Debug)]
pub struct Setpoint {
    /// Number of the axis, from 0.
    pub axis: u8,
    /// Number, mode, setpoint.
    pub tick: Tick<f32>,
    /// Reason for which the axis stopped, if it did.
    pub cause: Option<Cause>,
}

/// Demand on the shaft at a tick, none while the axis is disabled.
pub fn demand(train: &Drivetrain<f32>, tick: &Tick<f32>) -> Option<Demand<f32>> {
    is_on(tick.mode).then(|| train.demand(&tick.setpoint))
}

/// The state that a drive was last told. At the first tick it is told in any case: it may still be
/// on when the board begins anew.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Switch(Option<bool>);

impl Switch {
    /// Returns what the drive is to be told at a tick in that mode: on, off, or nothing new.
    pub fn turn(&mut self, mode: Mode) -> Option<bool> {
        let on = is_on(mode);
        let news = self.0 != Some(on);
        self.0 = Some(on);
        news.then_some(on)
    }
}

/// True if the drive follows setpoints in this mode.
fn is_on(mode: Mode) -> bool {
    mode != Mode::Disabled
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drive_is_told_at_first_and_at_every_change() {
        let mut switch = Switch::default();
        let modes = [Mode::Disabled, Mode::Disabled, Mode::Enabled, Mode::Stopping, Mode::Stopped];
        let told = modes.map(|mode| switch.turn(mode));
        assert_eq!(told, [Some(false), None, Some(true), None, None]);
        assert_eq!(switch.turn(Mode::Disabled), Some(false));
    }
}
