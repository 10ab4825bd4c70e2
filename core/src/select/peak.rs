//! The largest magnitude of a curve that is seen at equal intervals.

/// Largest magnitude so far, between the samples too: of the parabola through three of them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Peak {
    most: f64,
    /// The latest two samples since the curve has last jumped, the later one last.
    latest: [Option<f64>; 2],
}

impl Peak {
    /// Takes the next sample.
    pub fn see(&mut self, value: f64) {
        self.most = self.most.max(value.abs());
        if let [Some(first), Some(middle)] = self.latest {
            let (rise, bend) = (value - first, 2.0 * middle - first - value);
            // The vertex lies between the outer two.
            if rise.abs() < 2.0 * bend.abs() {
                self.most = self.most.max((middle + rise * rise / (8.0 * bend)).abs());
            }
        }
        self.latest = [self.latest[1], Some(value)];
    }

    /// Tells that the curve jumps here.
    pub fn jump(&mut self) {
        self.latest = [None; 2];
    }

    /// Largest magnitude.
    pub fn most(&self) -> f64 {
        self.most
    }
}
