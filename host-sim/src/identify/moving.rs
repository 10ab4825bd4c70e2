//! The measured and the fitted motion as a picture that moves.

use super::Panel;
use super::report::Report;
use crate::animation::{self, Animation, Arm, Ink, Link};

/// First periods that are shown.
const PERIODS: f64 = 5.0;

/// Intervals between pictures: enough for a second mode, six times as fast.
const INTERVALS: usize = 240;

/// Largest deflection that is drawn, fraction of the link's length. A sensor's unit has no scale
/// that a picture could keep.
const MOST: f64 = 0.2;

/// Fraction of the hub's range that counts as its first motion.
const FIRST: f64 = 0.01;

/// Link that is drawn, for any: a log does not say how long its arm is.
const LINK: Link = Link { radius: 0.0, length: 1.0 };

/// Draws the first log's sensor, and the fit over it, as the deflection of an arm. Where the log
/// has the hub's angle, the arm turns by it.
pub fn animation(panel: &Panel, report: &Report) -> Animation {
    let period = 1.0 / report.modes[0].frequency_hz;
    let begin = begin(panel, period);
    let end = (begin + PERIODS * period).min(panel.time[panel.time.len() - 1]);
    let inside = |k: &usize| (begin..=end).contains(&panel.time[*k]);
    let rows: Vec<usize> = (0..panel.time.len()).filter(inside).collect();
    let swing = |value: f64| value - report.offset;
    let values = rows.iter().flat_map(|&k| [panel.measured[k], panel.fitted[k]]);
    let peak = values.fold(0.0, |most: f64, value| most.max(swing(value).abs()));
    let scale = if peak > 0.0 { MOST / peak } else { 0.0 };
    let arm = |label: &str, ink, values: &[f64]| {
        let sample = |&k: &usize| {
            let angle = panel.hub.get(k).copied().unwrap_or(0.0);
            (panel.time[k] - begin, angle, scale * swing(values[k]))
        };
        let frames = LINK.frames(rows.iter().map(sample), end - begin, INTERVALS);
        Arm { label: label.to_owned(), ink, frames }
    };
    let fit = format!("{:.1} % of the log explained", report.fit_percent);
    Animation {
        label: "The arm as the sensor and the fit have it".to_owned(),
        goal: None,
        quantity: format!("sensor, {}", report.unit),
        factor: peak / MOST,
        seconds: end - begin,
        panels: vec![animation::Panel {
            arms: vec![
                arm("measured", Ink::Grey, &panel.measured),
                arm("fitted", Ink::Blue, &panel.fitted),
            ],
            remark: fit,
        }],
    }
}

/// Returns where the picture begins, s: with the log, or a period before the hub begins to turn.
fn begin(panel: &Panel, period: f64) -> f64 {
    let first = panel.time[0];
    let low = panel.hub.iter().copied().fold(f64::INFINITY, f64::min);
    let high = panel.hub.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let moves = |angle: &f64| (angle - panel.hub[0]).abs() > FIRST * (high - low);
    match panel.hub.iter().position(moves) {
        Some(k) => (panel.time[k] - period).max(first),
        None => first,
    }
}
