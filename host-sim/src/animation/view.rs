//! The part of the plane that a picture shows.

use super::Animation;

/// Width of a panel, and the margin around its arms, px.
pub(super) const WIDTH: f64 = 320.0;
const MARGIN: f64 = 20.0;

/// Greatest height of the arms' part of a panel, px.
const HEIGHT: f64 = 330.0;

/// Box in m that holds every frame, and its scale.
#[derive(Clone, Copy)]
pub(super) struct View {
    low: [f64; 2],
    high: [f64; 2],
    /// Pixels a metre.
    scale: f64,
}

impl View {
    /// Holds the hub, the goal and every point of every frame.
    pub fn of(animation: &Animation) -> Self {
        let mut view = Self { low: [0.0; 2], high: [0.0; 2], scale: 1.0 };
        for frame in animation.frames() {
            frame.line.iter().for_each(|&point| view.widen(point));
        }
        if let Some(goal) = animation.goal {
            view.widen(goal);
        }
        let size = |i: usize| view.high[i] - view.low[i];
        view.scale = f64::min((WIDTH - 2.0 * MARGIN) / size(0), (HEIGHT - 2.0 * MARGIN) / size(1));
        view
    }

    fn widen(&mut self, point: [f64; 2]) {
        for i in 0..2 {
            self.low[i] = self.low[i].min(point[i]);
            self.high[i] = self.high[i].max(point[i]);
        }
    }

    /// Height of the arms' part of a panel, px.
    pub fn height(&self) -> f64 {
        (2.0 * MARGIN + (self.high[1] - self.low[1]) * self.scale).ceil()
    }

    /// Returns a point's place in the arms' part of a panel, px.
    pub fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let from_middle = |i: usize| (point[i] - 0.5 * (self.low[i] + self.high[i])) * self.scale;
        [0.5 * WIDTH + from_middle(0), 0.5 * self.height() - from_middle(1)]
    }
}
