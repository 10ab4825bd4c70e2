//! Charts that help to choose a still move.

use rayon::prelude::*;
use stillbeam::Scene;

use super::comparison::{self, Entry};
use super::{judge, moving as moving_arm};
use crate::animation::{Animation, Ink};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Series};

/// Motion of a curve and the look of the curve.
struct Style {
    /// Name in the comparison, or its beginning.
    motion: &'static str,
    label: &'static str,
    colour: Colour,
    dash: Dash,
}

const STYLES: [Style; 6] = [
    Style { motion: "quintic", label: "quintic", colour: Colour::Grey, dash: Dash::Dotted },
    Style {
        motion: "quintic, ZV",
        label: "ZV on a quintic",
        colour: Colour::Orange,
        dash: Dash::Dashed,
    },
    Style {
        motion: "quintic, ZVD",
        label: "ZVD on a quintic",
        colour: Colour::Green,
        dash: Dash::Dashed,
    },
    Style {
        motion: "quintic, EI",
        label: "EI on a quintic",
        colour: Colour::Purple,
        dash: Dash::Dashed,
    },
    Style { motion: "still", label: "still", colour: Colour::Blue, dash: Dash::Solid },
    Style {
        motion: comparison::ROBUST,
        label: "still, robust to \u{b1}20 %",
        colour: Colour::Vermilion,
        dash: Dash::Solid,
    },
];

impl Style {
    fn of(motion: &str) -> Option<&'static Self> {
        STYLES.iter().find(|style| style.motion == motion)
    }

    fn series(&self, points: Vec<(f64, f64)>) -> Series {
        let width = if self.dash == Dash::Solid { 3 } else { 2 };
        Series::line(self.label, points).colour(self.colour).dash(self.dash).width(width)
    }
}

/// Points of a sensitivity curve.
const POINTS: i32 = 40;

/// Residual over frequency error.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Name in the comparison.
    pub motion: String,
    /// `(frequency error, residual)`, fractions.
    pub points: Vec<(f64, f64)>,
}

/// Computes the sensitivity of the drawn motions, ±20 %. `done` is called once a motion.
pub fn curves(
    arm: &Scene,
    to: f64,
    duration: f64,
    tick: f64,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Curve>, Error> {
    comparison::motions(arm, to, duration, tick)?
        .into_par_iter()
        .filter(|(name, _)| Style::of(name).is_some())
        .map(|(name, motion)| {
            let points = (0..=POINTS)
                .into_par_iter()
                .map(|k| 0.4 * f64::from(k) / f64::from(POINTS) - 0.2)
                .map(|error| Ok((error, motion.judge_with(arm, error, &judge::BRISK)?.residual)))
                .collect::<Result<_, Error>>()?;
            done();
            Ok(Curve { motion: name, points })
        })
        .collect()
}

/// Draws residual over frequency error at equal total duration. A move is chosen by this chart.
pub fn sensitivity(curves: &[Curve]) -> Chart {
    let line = |curve: &Curve| {
        let percent = |&(error, left): &(f64, f64)| (100.0 * error, 100.0 * left.max(1e-7));
        Some(Style::of(&curve.motion)?.series(curve.points.iter().map(percent).collect()))
    };
    Chart::new(
        "What is left after a half turn in two first periods, delay of the shapers included",
        Axis::tight("error of the arm's frequency, %"),
        Axis::log("residual vibration, % of the arm's length"),
    )
    .sized(760, 460)
    .with_all(curves.iter().filter_map(line))
}

/// Draws the tip's deflection during the motions and after them, without frequency error.
pub fn swing(entries: &[Entry], duration: f64, length: f64) -> Chart {
    let line = |entry: &Entry| {
        let samples = &entry.nominal().samples;
        let points = samples.iter().map(|s| (s.t, 100.0 * s.deflection / length)).collect();
        Some(Style::of(&entry.name)?.series(points))
    };
    Chart::new(
        "The same half turn in the same time: where the tip is, seen from the hub",
        Axis::tight("time, s"),
        Axis::linear("deflection of the tip, % of the arm's length"),
    )
    .sized(760, 400)
    .mark(duration, "hub stops")
    .with_all(swung(entries).filter_map(line))
}

/// Draws the arms of [`swing`] as they move to the hub angle `to`, rad, side by side.
pub fn moving(entries: &[Entry], arm: &Scene, to: f64) -> Option<Animation> {
    let inks = [Ink::Vermilion, Ink::Orange, Ink::Blue];
    let motions = swung(entries)
        .zip(inks)
        .filter_map(|(entry, ink)| Some((Style::of(&entry.name)?.label, ink, entry.nominal())));
    moving_arm::side_by_side(arm, to, motions)
}

/// Returns the motions of [`swing`].
pub fn swung(entries: &[Entry]) -> impl Iterator<Item = &Entry> {
    entries.iter().filter(|entry| SWUNG.contains(&entry.name.as_str()))
}

/// Motions whose deflection is drawn. More would hide each other.
const SWUNG: [&str; 3] = ["quintic", "quintic, ZV", "still"];
