//! Clips curves at the frame of the plot.

/// The frame, in positions on the axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// Left and right.
    pub x: (f64, f64),
    /// Bottom and top.
    pub y: (f64, f64),
}

impl Bounds {
    /// True if the point is inside, to rounding.
    pub fn holds(&self, (x, y): (f64, f64)) -> bool {
        let within = |v: f64, (low, high): (f64, f64)| {
            let air = 1e-9 * (high - low);
            (low - air..=high + air).contains(&v)
        };
        within(x, self.x) && within(y, self.y)
    }

    /// Returns the pieces of a polyline that are inside.
    pub fn clip(&self, points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
        let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
        for pair in points.windows(2) {
            let Some((start, end)) = self.segment(pair[0], pair[1]) else { continue };
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&start) => piece.push(end),
                _ => pieces.push(vec![start, end]),
            }
        }
        pieces
    }

    /// Returns the part of a segment that is inside (Liang and Barsky).
    fn segment(&self, a: (f64, f64), b: (f64, f64)) -> Option<((f64, f64), (f64, f64))> {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
        let sides = [
            (-dx, a.0 - self.x.0),
            (dx, self.x.1 - a.0),
            (-dy, a.1 - self.y.0),
            (dy, self.y.1 - a.1),
        ];
        for (outward, room) in sides {
            if outward == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if outward < 0.0 {
                enter = enter.max(room / outward);
            } else {
                leave = leave.min(room / outward);
            }
        }
        let at = |share: f64| match share {
            0.0 => a,
            1.0 => b,
            _ => (a.0 + share * dx, a.1 + share * dy),
        };
        (enter <= leave).then(|| (at(enter), at(leave)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_that_leaves_and_returns_is_two_pieces() {
        let bounds = Bounds { x: (0.0, 4.0), y: (0.0, 1.0) };
        let points = [(0.0, 0.0), (1.0, 0.5), (2.0, 1.5), (3.0, 1.5), (4.0, 0.5)];
        let pieces = bounds.clip(&points);
        assert_eq!(pieces[0], [(0.0, 0.0), (1.0, 0.5), (1.5, 1.0)]);
        assert_eq!(pieces[1], [(3.5, 1.0), (4.0, 0.5)]);
        assert_eq!(pieces.len(), 2);
    }
}
