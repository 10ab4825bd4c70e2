//! The values that a protocol can carry, asked for before a move begins.

use super::Encoded;
use crate::Error;
use crate::motor::Demand;

/// Largest values of a protocol, either way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Turns of the shaft.
    pub position: f32,
    /// Turns/s.
    pub velocity: f32,
    /// N m.
    pub torque: f32,
}

/// Largest values of a move's demands, either way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DemandPeaks {
    /// Turns of the shaft.
    pub position: f32,
    /// Turns/s.
    pub velocity: f32,
    /// N m.
    pub torque: f32,
}

impl DemandPeaks {
    /// Takes note of a demand.
    pub fn note(&mut self, demand: &Demand<f32>) {
        let position = demand.position.turns as f32 + demand.position.part;
        raise(&mut self.position, position);
        raise(&mut self.velocity, demand.velocity);
        raise(&mut self.torque, demand.torque);
    }
}

/// Raises a peak to a value's magnitude. A value that is not a number stays as the peak.
fn raise(peak: &mut f32, value: f32) {
    let magnitude = if value < 0.0 { -value } else { value };
    if magnitude > *peak || magnitude.is_nan() {
        *peak = magnitude;
    }
}

impl Range {
    /// Refuses a move whose demands do not fit, before its first setpoint. What is sent then is
    /// never saturated.
    ///
    /// # Errors
    /// The first of position, velocity and torque that does not fit, with its peak and the range.
    pub fn admit(&self, peaks: &DemandPeaks) -> Result<(), Error> {
        for (parameter, peak, most, unit) in [
            ("drive.position", peaks.position, self.position, "turns, what its frame holds"),
            ("drive.velocity", peaks.velocity, self.velocity, "turn/s, what its frame holds"),
            ("drive.torque", peaks.torque, self.torque, "N m, what its frame holds"),
        ] {
            let most = f64::from(most);
            Error::check(parameter, f64::from(peak), -most, most, unit)?;
        }
        Ok(())
    }
}

impl<P> Encoded<P> {
    /// The payload, if nothing in it was saturated.
    pub fn whole(self) -> Option<P> {
        (!self.saturated.any()).then_some(self.payload)
    }
}

#[cfg(test)]
mod tests {
    use super::{DemandPeaks, Range};
    use crate::hub::Angle;
    use crate::motor::Demand;

    const RANGE: Range = Range { position: 100.0, velocity: 32.767, torque: 2.0 };

    fn peaks(turns: i32, velocity: f32, torque: f32) -> DemandPeaks {
        let mut peaks = DemandPeaks::default();
        let position = Angle { turns, part: 0.25 };
        peaks.note(&Demand { position, velocity, torque });
        peaks.note(&Demand { position: Angle { turns: 0, part: 0.0 }, velocity: 0.0, torque: 0.0 });
        peaks
    }

    #[test]
    fn a_move_beyond_the_frame_is_refused_by_name() {
        assert!(RANGE.admit(&peaks(-99, 32.767, -2.0)).is_ok());
        for (peaks, name) in [
            (peaks(-101, 0.0, 0.0), "drive.position"),
            (peaks(0, -32.8, 0.0), "drive.velocity"),
            (peaks(0, 0.0, 2.1), "drive.torque"),
            (peaks(0, f32::NAN, 0.0), "drive.velocity"),
        ] {
            match RANGE.admit(&peaks) {
                Err(crate::Error::OutOfRange { parameter, .. }) => assert_eq!(parameter, name),
                other => panic!("{name}: {other:?}"),
            }
        }
    }
}
