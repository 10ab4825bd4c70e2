//! Which family of motions turns by an angle in the shortest time.

use super::{Phases, Problem};

impl Problem {
    /// The motion in the shortest time that turns by `distance`, rad, and keeps the limits from
    /// beginning to end. The two ends are within the limits, as [`Self::brake`] leaves them.
    pub fn solve(&self, distance: f64) -> Phases {
        let ramp = self.ramp();
        if distance == ramp.distance {
            return ramp.phases;
        }
        let strict = self.towards(distance, ramp.distance, Self::stay_strict);
        strict.unwrap_or_else(|| {
            let first = if self.has_gap() { self.detour() } else { ramp.distance };
            self.towards(distance, first, |side, distance| side.pass_zero(distance))
        })
    }

    /// Angle of the fastest change of the rate behind a gap, rad: by the jerk of the other sign
    /// first, through acceleration zero and back.
    fn detour(&self) -> f64 {
        if self.from[1] > 0.0 { -self.mirror().rise().distance } else { self.rise().distance }
    }

    /// Solves for the furthest motions if `distance` lies above `first`, else for the mirror image.
    fn towards<P: Mirror>(
        &self,
        distance: f64,
        first: f64,
        furthest: impl Fn(&Self, f64) -> P,
    ) -> P {
        if distance > first {
            furthest(self, distance)
        } else {
            furthest(&self.mirror(), -distance).mirrored()
        }
    }
}

/// A solution that has a mirror image.
trait Mirror {
    /// Returns the mirror image.
    fn mirrored(self) -> Self;
}

impl Mirror for Phases {
    fn mirrored(self) -> Self {
        self.mirror()
    }
}

impl Mirror for Option<Phases> {
    fn mirrored(self) -> Self {
        self.map(Phases::mirror)
    }
}
