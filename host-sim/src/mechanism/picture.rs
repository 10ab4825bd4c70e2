//! A mechanism's run as pictures: the links at several times, and what the joints do.

use super::MechanismScene;
use super::table::Row;
use crate::plot::{Axis, Chart, Colour, Dash, Marker, Series};

/// Times at which the mechanism is drawn.
const POSES: usize = 7;
/// Straight pieces by which a link is drawn.
const PIECES: usize = 12;

/// Draws the links at several times of the run, the first and the last pose dark, and the path of
/// the tip.
pub fn poses(scene: &MechanismScene, rows: &[Row]) -> Chart {
    let path = rows.iter().map(|row| (row.tip()[0], row.tip()[1]));
    let mut chart = Chart::new("The mechanism", Axis::linear("X, m"), Axis::linear("Y, m"))
        .sized(760, 560)
        .equal_scales()
        .with(Series::line("path of the tip", path).colour(Colour::Sky).width(1));
    let last = rows.len().saturating_sub(1);
    for k in 0..POSES {
        let row = &rows[last * k / (POSES - 1)];
        let (label, colour) = match k {
            0 => (format!("at {} s", row.t), Colour::Blue),
            k if k == POSES - 1 => (format!("at {} s", row.t), Colour::Vermilion),
            1 => ("between".to_owned(), Colour::Grey),
            _ => (String::new(), Colour::Grey),
        };
        let line = Series::line(label, shape(scene, row)).colour(colour);
        chart = chart.with(if colour == Colour::Grey { line.width(1) } else { line });
        let joints = joints(row).into_iter().map(|[x, y]| (x, y));
        chart = chart.with(Series::scatter("", joints).colour(colour).marker(Marker::Ring));
    }
    chart
}

/// Draws angles, torques and deflections over time, a curve a joint or a link. Passive joints have
/// no torque.
pub fn curves(scene: &MechanismScene, rows: &[Row]) -> Vec<Chart> {
    let count = scene.mechanism.links.len();
    let over_time = |title: &str, unit: &str, what: &str, of: &dyn Fn(&Row, usize) -> f64| {
        let chart = Chart::new(title, Axis::tight("time, s"), Axis::linear(unit));
        let line = |j: usize| {
            let dash = [Dash::Solid, Dash::Dashed, Dash::Dotted][j % 3];
            let points: Vec<_> = rows.iter().map(|row| (row.t, of(row, j))).collect();
            Series::line(format!("{what} {}", j + 1), points).dash(dash)
        };
        let chart = chart.with_all((0..count).map(line));
        match super::closes_at(&scene.mechanism).filter(|&t| t > 0.0) {
            Some(t) => chart.mark(t, "closes"),
            None => chart,
        }
    };
    vec![
        over_time("Joint angles", "relative angle, rad", "joint", &|row, j| row.joints[j]),
        over_time("Torques", "torque, N m", "joint", &|row, j| row.torques[j]),
        over_time("Deflections", "deflection, mm", "link", &|row, j| 1e3 * row.deflections[j]),
    ]
}

/// Returns the places of the joints and of the tip.
pub(super) fn joints(row: &Row) -> Vec<[f64; 2]> {
    std::iter::once([0.0; 2]).chain(row.ends.iter().copied()).collect()
}

/// Returns the links as a polyline from the first joint to the tip.
///
/// A table has a link's ends and its deflection, which give the direction of its clamp; the
/// direction of its end follows from the next link's, or at the tip from that of a cantilever. The
/// curve between is the cubic through both.
pub fn shape(scene: &MechanismScene, row: &Row) -> Vec<(f64, f64)> {
    let places = joints(row);
    let count = scene.mechanism.links.len();
    let root = |j: usize| {
        let [x, y] = [places[j + 1][0] - places[j][0], places[j + 1][1] - places[j][1]];
        y.atan2(x) - (row.deflections[j] / x.hypot(y)).clamp(-1.0, 1.0).asin()
    };
    let mut line = vec![(0.0, 0.0)];
    for (j, link) in scene.mechanism.links.iter().enumerate() {
        let begin = root(j);
        let end = if !link.bends() {
            begin
        } else if j + 1 < count {
            root(j + 1) - row.joints[j + 1]
        } else {
            begin + 1.5 * row.deflections[j] / link.length
        };
        let from = places[j];
        let radius = scene.mechanism.joints[j].radius;
        let along = |angle: f64, length: f64| [length * angle.cos(), length * angle.sin()];
        let (out, back) = (along(begin, radius), along(end, link.tip_offset));
        let clamp = [from[0] + out[0], from[1] + out[1]];
        let strip = [places[j + 1][0] - back[0], places[j + 1][1] - back[1]];
        let slopes = [along(begin, link.length), along(end, link.length)];
        for k in 0..=PIECES {
            let s = k as f64 / PIECES as f64;
            let (s2, s3) = (s * s, s * s * s);
            let at = |axis: usize| {
                (1.0 - 3.0 * s2 + 2.0 * s3) * clamp[axis]
                    + (s - 2.0 * s2 + s3) * slopes[0][axis]
                    + (3.0 * s2 - 2.0 * s3) * strip[axis]
                    + (s3 - s2) * slopes[1][axis]
            };
            line.push((at(0), at(1)));
        }
        line.push((places[j + 1][0], places[j + 1][1]));
    }
    line
}
