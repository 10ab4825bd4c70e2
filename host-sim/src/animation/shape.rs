//! The link's curve between its clamp and its tip, from what a table holds of it.

use stillbeam::Scene;

use super::Frame;
use super::pose::Pose;

/// Straight pieces by which a link is drawn.
const PIECES: usize = 16;

/// Tip angle, rad, up to which a link is drawn. The deflection of the curve grows up to 2.2 rad.
const MOST: f64 = 2.0;

/// One link on a hub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Radius of the hub, m.
    pub radius: f64,
    /// Length of the link, m.
    pub length: f64,
}

impl Link {
    /// The link of a scene.
    pub fn of(arm: &Scene) -> Self {
        Self { radius: arm.hub.radius, length: arm.link.length }
    }

    /// Draws samples `(t, angle, deflection)` in s, rad and m, whose times ascend, at the ends of
    /// `intervals` even ones from 0 to `end` s, straight between two samples. Before the first and
    /// after the last the arm stays as it is. Returns nothing if there is no sample.
    pub fn frames(
        self,
        samples: impl IntoIterator<Item = (f64, f64, f64)>,
        end: f64,
        intervals: usize,
    ) -> Vec<Frame> {
        Pose::evenly(samples, end, intervals).iter().map(|pose| self.frame(pose)).collect()
    }

    fn frame(self, pose: &Pose) -> Frame {
        let line = centreline(pose, self.radius, self.length);
        Frame { line, joints: Vec::new(), deflections: vec![pose.deflection] }
    }

    /// Returns the tip of the straight link at a hub angle, rad, in m.
    pub(super) fn tip(self, angle: f64) -> [f64; 2] {
        let reach = self.radius + self.length;
        [reach * angle.cos(), reach * angle.sin()]
    }
}

/// Returns the points of the centreline in the global frame, m, from the hub's rim on.
///
/// The link does not stretch. Its tangent turns as that of a cantilever with a load at its tip,
/// `φ(s) = φ_L (2s − s²)`, and `φ_L` is the one with which the tip's deflection is that of the
/// pose. Midpoint rule.
fn centreline(pose: &Pose, radius: f64, length: f64) -> Vec<[f64; 2]> {
    let tip_angle = tip_angle(pose.deflection / length);
    let (sin, cos) = pose.angle.sin_cos();
    let mut point = [radius * cos, radius * sin];
    let mut points = vec![point];
    let step = length / PIECES as f64;
    for turn in turns() {
        let (sin, cos) = (pose.angle + tip_angle * turn).sin_cos();
        point = [point[0] + step * cos, point[1] + step * sin];
        points.push(point);
    }
    points
}

/// Returns `2s − s²` in the middle of each piece.
fn turns() -> impl Iterator<Item = f64> {
    (0..PIECES).map(|k| (k as f64 + 0.5) / PIECES as f64).map(|s| s * (2.0 - s))
}

/// Returns the tip angle, rad, with which the tip is off the hub's line by a fraction of the
/// length, by bisection.
fn tip_angle(fraction: f64) -> f64 {
    let off = |angle: f64| turns().map(|turn| (angle * turn).sin()).sum::<f64>() / PIECES as f64;
    let (mut low, mut high) = (-MOST, MOST);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if off(middle) < fraction {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A tip load bends a cantilever by `φ_L = 3/2` of the deflection over the length.
    #[test]
    fn a_little_bend_is_that_of_a_tip_load() {
        let angle = tip_angle(0.01);
        assert!((angle / 0.015 - 1.0).abs() < 2e-3, "{angle}");
        assert!(tip_angle(0.0).abs() < 1e-9);
    }

    #[test]
    fn the_tip_is_where_the_table_says() {
        for (angle, deflection) in [(0.0, 0.05), (1.0, -0.2), (-2.0, 0.31)] {
            let points = centreline(&Pose { angle, deflection }, 0.03, 0.4);
            let [x, y] = points[points.len() - 1];
            let across = -x * angle.sin() + y * angle.cos();
            assert!((across - deflection).abs() < 1e-9, "{across}");
            let steps = points.windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1]));
            assert!((steps.sum::<f64>() - 0.4).abs() < 1e-12);
        }
    }
}
