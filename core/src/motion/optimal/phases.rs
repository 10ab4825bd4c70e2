//! Seven phases of jerk + 0 − 0 − 0 +.

/// Jerk of each phase, in units of the limit.
const JERK: [f64; 7] = [1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0];

/// Durations of the phases of a motion with jerk + 0 − 0 − 0 +, or of its mirror image.
///
/// The acceleration rises to `peak` in phase 0 and stays there in phase 1. It falls to zero in
/// phase 2, stays there in phase 3, falls to `trough` in phase 4 and stays there in phase 5, and
/// rises in phase 6. A motion whose acceleration does not pass zero on its way down leaves out
/// phase 3 and falls from `peak` to `trough` at once, in phase 2 or 4.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Phases {
    /// Durations, s.
    pub durations: [f64; 7],
    /// Highest acceleration, rad/s².
    pub peak: f64,
    /// Lowest acceleration after it, rad/s².
    pub trough: f64,
    /// True for the mirror image: every sign is the opposite.
    pub mirrored: bool,
}

impl Phases {
    /// Returns the mirror image.
    pub fn mirror(self) -> Self {
        Self { mirrored: !self.mirrored, ..self }
    }

    /// Returns the motion backwards in time: the rates stay, the accelerations change their sign,
    /// the jerk does not.
    pub fn reverse(self) -> Self {
        let mut durations = self.durations;
        durations.reverse();
        Self { durations, peak: -self.trough, trough: -self.peak, ..self }
    }

    /// Duration (s), acceleration at the beginning (rad/s²) and jerk (rad/s³) of each phase that
    /// takes any time, in a motion that begins with `acceleration`.
    pub fn pieces(&self, acceleration: f64, jerk: f64) -> impl Iterator<Item = [f64; 3]> {
        let sign = if self.mirrored { -1.0 } else { 1.0 };
        let Self { durations, peak, trough, .. } = *self;
        let middle = if durations[2] == 0.0 { peak } else { 0.0 };
        let begin = [acceleration, sign * peak, sign * peak, 0.0, sign * middle, sign * trough];
        (0..7).filter(move |&i| durations[i] > 0.0).map(move |i| {
            let jerk = if JERK[i] == 0.0 { 0.0 } else { sign * JERK[i] * jerk };
            [durations[i], begin[i.min(5)], jerk]
        })
    }
}
