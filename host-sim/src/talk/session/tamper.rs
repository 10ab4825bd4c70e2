//! Faults of line, firmware, encoders and drives, for tests.

use super::Session;
use crate::error::Error;
use crate::talk::drive::Drive;

impl Session {
    /// Keeps the firmware from its tick for a time, s, as a fault of it would. Only QEMU can do
    /// this.
    ///
    /// # Errors
    /// Errors are those of [`Session::ask`]. A board, or a time beyond 0 to 65 ms, is refused too.
    pub fn stall(&mut self, seconds: f64) -> Result<(), Error> {
        let refused = |why| {
            Error::new(format_args!("stall = {seconds} s: must be 0 to 0.065 s in QEMU{why}"))
        };
        if !self.machine.is_emulated() {
            return Err(refused(", not on a board"));
        }
        if !(0.0..=0.065).contains(&seconds) {
            return Err(refused(""));
        }
        self.machine.stall((1e6 * seconds) as u16);
        // It counts from the last tick, with the next one due a tick later.
        let missed = (seconds / self.tick()) as u32;
        self.comparison.miss(self.upcoming, missed.saturating_sub(1));
        self.wait(1)
    }

    /// Sends arbitrary bytes to the firmware, as a bad line would.
    ///
    /// # Errors
    /// An error is returned if the line is broken.
    pub fn disturb(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.machine.send(bytes)
    }

    /// Lets the encoder of an axis jump by `turns` of its motor.
    ///
    /// # Errors
    /// An axis that does not exist, or drives without machines.
    pub fn jump(&mut self, axis: u8, turns: f64) -> Result<(), Error> {
        let drive = self.drive(axis)?;
        match drive.body_mut() {
            Some(body) if turns.is_finite() => body.jump(turns),
            _ => {
                return Err(Error::new(format_args!(
                    "jump = {turns}: must be a number of turns, with --plant"
                )));
            }
        }
        Ok(())
    }

    /// Lets the drive of an axis switch itself off with an error.
    ///
    /// # Errors
    /// An axis that does not exist.
    pub fn fail(&mut self, axis: u8) -> Result<(), Error> {
        self.drive(axis)?.fail();
        Ok(())
    }

    /// Cuts the line between the bus and the drive of an axis, or mends it.
    ///
    /// # Errors
    /// An axis that does not exist.
    pub fn cut(&mut self, axis: u8, cut: bool) -> Result<(), Error> {
        self.drive(axis)?.cut(cut);
        Ok(())
    }

    fn drive(&mut self, axis: u8) -> Result<&mut Drive, Error> {
        let count = self.comparison.axes().len();
        let found = self.comparison.axes_mut().get_mut(usize::from(axis));
        found.map(|axis| &mut axis.drive).ok_or_else(|| {
            Error::new(format_args!("axis = {axis}: must be 0 to {}", count.saturating_sub(1)))
        })
    }
}
