//! Warns of values that a format resolves too coarsely: a move's torques, a position far from zero.

/// Counts that a move's torque peak should have at least: 1 % steps.
const ENOUGH: f32 = 100.0;

/// A torque peak that the format resolves badly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Coarse {
    /// Peak of the move, N m.
    pub peak: f32,
    /// The peak in counts of the format, below 100.
    pub counts: f32,
}

/// Greatest |torque| of the move under way.
#[derive(Clone, Copy, Debug, Default)]
pub struct TorquePeak {
    peak: f32,
}

impl TorquePeak {
    /// Takes note of a torque, N m.
    pub fn note(&mut self, torque: f32) {
        let magnitude = if torque < 0.0 { -torque } else { torque };
        if magnitude > self.peak {
            self.peak = magnitude;
        }
    }

    /// Ends a move and begins the next: a warning if the peak was above 0 and under 100 counts of
    /// `step` N m.
    pub fn finish(&mut self, step: f32) -> Option<Coarse> {
        let peak = core::mem::take(&mut self.peak);
        let counts = peak / step;
        (peak > 0.0 && counts < ENOUGH).then_some(Coarse { peak, counts })
    }
}

/// A position in f32 that is so far from the encoder's zero that counts are lost.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Lost {
    /// Turns from the encoder's zero.
    pub turns: f32,
    /// Counts in a step of the f32, above 1.
    pub counts: f32,
}

impl Lost {
    /// Returns a warning if an f32 of `turns` turns no longer tells neighbouring counts apart, of
    /// which an encoder has `counts` a turn. With 8192 counts that is so from 2048 turns on; then
    /// re-home the axis with its drive off.
    pub fn at(turns: f32, counts: u32) -> Option<Self> {
        let magnitude = if turns < 0.0 { -turns } else { turns };
        if !magnitude.is_finite() {
            return None;
        }
        let next = f32::from_bits(magnitude.to_bits() + 1);
        let step = (next - magnitude) * counts as f32;
        (step > 1.0).then_some(Self { turns, counts: step })
    }
}

#[cfg(test)]
mod tests {
    use super::Lost;

    #[test]
    fn counts_are_lost_far_from_zero() {
        assert_eq!(Lost::at(1023.9, 8192), None);
        assert_eq!(Lost::at(-1024.5, 8192), None);
        assert_eq!(Lost::at(2048.5, 8192), Some(Lost { turns: 2048.5, counts: 2.0 }));
        assert_eq!(Lost::at(-1025.0, 16_384), Some(Lost { turns: -1025.0, counts: 2.0 }));
        assert_eq!(Lost::at(f32::NAN, 8192), None);
    }
}
