//! Mode, cause of a stop, count of ticks and silence of the host, the same for one axis and for the
//! joints of a mechanism.

use super::Cause;
use crate::Error;
use crate::error::Mode;

/// Mode and clocks of what is switched on and off together. Disabled at first.
#[derive(Clone, Debug)]
pub(super) struct Supervisor {
    /// The policy's patience in ticks; 0 waits for ever.
    patience: u32,
    pub mode: Mode,
    pub cause: Option<Cause>,
    /// A stop that ends with the drive off.
    then_off: bool,
    /// Ticks made: the number of the next.
    pub clock: u32,
    /// Ticks since the host was heard, missed ones included.
    silence: u32,
}

impl Supervisor {
    pub fn new(patience: u32) -> Self {
        let (mode, cause, then_off) = (Mode::Disabled, None, false);
        Self { patience, mode, cause, then_off, clock: 0, silence: 0 }
    }

    /// Returns [`Error::WrongMode`] unless enabled.
    pub fn check_enabled(&self) -> Result<(), Error> {
        match self.mode {
            Mode::Enabled => Ok(()),
            mode => Err(Error::WrongMode { mode }),
        }
    }

    /// Counts a tick of silence; true if the host has been silent for too long.
    #[inline(always)]
    pub fn listen(&mut self) -> bool {
        if self.mode != Mode::Enabled || self.patience == 0 {
            return false;
        }
        self.silence = self.silence.saturating_add(1);
        self.silence > self.patience
    }

    /// Counts ticks that did not take place.
    #[inline(always)]
    pub fn missed(&mut self, ticks: u32) {
        self.silence = self.silence.saturating_add(ticks);
    }

    pub fn heard(&mut self) {
        self.silence = 0;
    }

    /// Returns the number of the tick that is being made.
    #[inline(always)]
    pub fn number(&mut self) -> u32 {
        let number = self.clock;
        self.clock = self.clock.wrapping_add(1);
        number
    }

    /// Ends a stop under way if the hub `rests`.
    #[inline(always)]
    pub fn end_stop(&mut self, rests: impl FnOnce() -> bool) {
        if self.mode == Mode::Stopping && rests() {
            self.mode = if self.then_off { Mode::Disabled } else { Mode::Stopped };
        }
    }

    /// Switches on.
    pub fn enable(&mut self) {
        self.mode = Mode::Enabled;
        self.cause = None;
        self.silence = 0;
    }

    /// Has a stop that was begun end with the drive off.
    pub fn disable(&mut self) {
        self.then_off = true;
        if self.mode == Mode::Stopped {
            self.mode = Mode::Disabled;
        }
    }

    /// Stops what is enabled. It brakes from now on, or, without `moves`, rests.
    pub fn stop(&mut self, cause: Cause, moves: bool) {
        self.then_off = false;
        self.cause = Some(cause);
        self.mode = if moves { Mode::Stopping } else { Mode::Stopped };
    }
}
