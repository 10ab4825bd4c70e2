//! Judges whether hub and arm are at rest at the end of a run.

use stillbeam_sim::plant::{Plant, Shown};

use super::draw::Case;

/// Hub and tip over the last first period of the arm.
pub struct Rest {
    /// Time at which the window begins, s.
    from: f64,
    /// Least and greatest hub angle, rad.
    angle: [f64; 2],
    /// Least and greatest deflection of the tip, m.
    deflection: [f64; 2],
    /// True as long as every number was finite.
    finite: bool,
}

impl Rest {
    /// Watches a run that ends at `end` s.
    pub fn new(case: &Case, end: f64) -> Self {
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        Self { from: end - case.period, angle: none, deflection: none, finite: true }
    }

    /// Looks at the machine.
    pub fn see(&mut self, plant: &Plant) {
        let Shown { t, angle, rate, tip, deflection, shaft_rate, .. } = plant.shown();
        let numbers = [angle, rate, tip[0], tip[1], deflection, shaft_rate];
        self.finite &= numbers.iter().all(|x| x.is_finite());
        if t >= self.from {
            widen(&mut self.angle, angle);
            widen(&mut self.deflection, deflection);
        }
    }

    /// True if nothing was other than finite.
    pub fn finite(&self) -> bool {
        self.finite
    }

    /// Turn of the hub within the last period, rad.
    pub fn turn(&self) -> f64 {
        self.angle[1] - self.angle[0]
    }

    /// Half of the tip's swing within the last period, m.
    pub fn swing(&self) -> f64 {
        0.5 * (self.deflection[1] - self.deflection[0])
    }
}

fn widen(range: &mut [f64; 2], value: f64) {
    *range = [range[0].min(value), range[1].max(value)];
}
