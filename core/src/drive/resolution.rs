//! Warns of a move whose torques a format resolves too coarsely.

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
