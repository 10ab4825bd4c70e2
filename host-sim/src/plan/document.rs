//! `docs/still.md`: its tables and its picture, by a command.

use std::f64::consts::PI;
use std::path::Path;

use rayon::prelude::*;
use stillbeam::motion::Still;
use stillbeam::{Profile, Scene};

use super::contest::{self, ERRORS, Entry};
use super::duration::durations;
use super::judge::{Judgement, Motion};
use crate::error::Error;
use crate::output::Files;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::reference::rod;
use crate::scenes;
use crate::sweep::tables::aligned;

/// Setpoint interval of every motion, s.
const TICK: f64 = 0.01;

/// Durations of the residual table, first periods.
const RATIOS: [f64; 4] = [1.0, 1.5, 2.0, 3.0];

/// Durations of the contest, first periods.
const CONTEST: [f64; 3] = [1.5, 2.0, 3.0];

/// Steps of [`blocks`], for a progress bar.
pub const STEPS: usize = 150;

/// Everything between markers, by name.
pub fn blocks(done: &(dyn Fn() + Sync)) -> Result<Vec<(String, String)>, Error> {
    let mut blocks = vec![("residual".to_owned(), residuals(done)?)];
    let arm = arm("a-tip30")?;
    let period = rod::first_period(&arm)?;
    for ratio in CONTEST {
        let duration = (ratio * period / TICK).round() * TICK;
        let entries = contest::entries(&arm, PI, duration, TICK, done)?;
        blocks.push((format!("contest-{ratio}"), contest_table(&entries, duration)));
    }
    blocks.push(("durations".to_owned(), duration_table(&arm, period)?));
    Ok(blocks)
}

fn arm(scene: &str) -> Result<Scene, Error> {
    Ok(scenes::open(scene)?.arm)
}

/// Arms of the residual table.
fn arms() -> Result<Vec<(&'static str, Scene)>, Error> {
    let mut all = Vec::new();
    for (name, scene) in [
        ("member A with 30 g", "a-tip30"),
        ("member B with 30 g", "b-tip30"),
        ("member C with 30 g", "c-tip30"),
        ("member D with 30 g", "d-tip30"),
        ("member D bare", "d-fast"),
        ("B with 30 g, damped, hub 40 mm", "b-tip30-damped-hub"),
        ("1 m arm, gravity, payload inertia", "s-gravity"),
    ] {
        all.push((name, arm(scene)?));
    }
    Ok(all)
}

fn residuals(done: &(dyn Fn() + Sync)) -> Result<String, Error> {
    let mut lines = vec![
        std::iter::once("arm".to_owned())
            .chain(RATIOS.map(|ratio| format!("{ratio} T\u{2081}")))
            .collect::<Vec<_>>(),
    ];
    let rows = arms()?
        .into_par_iter()
        .map(|(name, arm)| {
            let period = rod::first_period(&arm)?;
            // Fast arms at ticks that divide their period as finely as slow ones'.
            let tick = TICK.min(period / 10.0);
            let planner = Still::<f32, 2>::new(&arm, tick)?;
            let mut line = vec![name.to_owned()];
            for ratio in RATIOS {
                let plan = planner.plan(0.0, PI, ratio * period)?;
                let judged = Motion::of(0.0, plan.motion(), tick).judge(&arm, 0.0)?;
                line.push(percent(judged.residual));
                done();
            }
            Ok(line)
        })
        .collect::<Result<Vec<_>, Error>>()?;
    lines.extend(rows);
    Ok(aligned(&lines))
}

fn contest_table(entries: &[Entry], duration: f64) -> String {
    let mut header = vec!["motion".to_owned()];
    header.extend(ERRORS.map(|error| {
        format!("{:+.0} %", 100.0 * error).replace('-', "\u{2212}").replace("+0 %", "0 %")
    }));
    header.extend(["rate", "acceleration", "torque"].map(str::to_owned));
    let mut lines = vec![header];
    let scale = |judged: &Judgement| {
        [
            format!("{:.2}", judged.rate * duration / PI),
            format!("{:.2}", judged.acceleration * duration * duration / PI),
            format!("{:.1}", 1e3 * judged.torque),
        ]
    };
    for entry in entries {
        let mut line = vec![entry.name.clone()];
        line.extend(entry.residuals().map(percent));
        line.extend(scale(entry.nominal()));
        lines.push(line);
    }
    aligned(&lines)
}

fn duration_table(arm: &Scene, period: f64) -> Result<String, Error> {
    let mut lines = vec![
        ["limits of a", "that takes", "still", "rigid time-optimal"].map(str::to_owned).to_vec(),
    ];
    let in_periods = |seconds: f64| format!("{:.2} T\u{2081}", seconds / period);
    for (profile, what) in [
        (Profile::Cubic, "cubic, acceleration only"),
        (Profile::SCurve, "S-curve, rate, acceleration, jerk"),
    ] {
        for ratio in [1.0, 1.5, 2.0, 2.5, 3.0, 4.0] {
            let found = durations(arm, profile, PI, ratio * period, TICK)?;
            let share = format!("{} ({:.2})", in_periods(found.still), found.still / found.profile);
            let rigid = found.rigid.map_or("\u{2013}".to_owned(), in_periods);
            lines.push(vec![what.to_owned(), in_periods(found.profile), share, rigid]);
        }
    }
    Ok(aligned(&lines))
}

/// A fraction as per cent: three digits, 0.001 at the finest.
fn percent(fraction: f64) -> String {
    let value = 100.0 * fraction;
    match value {
        _ if value >= 10.0 => format!("{value:.1}"),
        _ if value >= 1.0 => format!("{value:.2}"),
        _ => format!("{value:.3}"),
    }
}

/// Residual over frequency error at equal total duration: what a move is to be chosen by.
pub fn picture(files: &mut Files, path: &Path) -> Result<(), Error> {
    let arm = arm("a-tip30")?;
    let period = rod::first_period(&arm)?;
    let duration = (2.0 * period / TICK).round() * TICK;
    let shown = [
        ("quintic", "quintic", Colour::Grey, Dash::Dotted),
        ("quintic, ZV", "ZV on a quintic", Colour::Orange, Dash::Dashed),
        ("quintic, ZVD", "ZVD on a quintic", Colour::Green, Dash::Dashed),
        ("quintic, EI", "EI on a quintic", Colour::Purple, Dash::Dashed),
        ("still", "still", Colour::Blue, Dash::Solid),
        ("robust", "still, robust to \u{b1}20 %", Colour::Vermilion, Dash::Solid),
    ];
    let motions = contest::motions(&arm, PI, duration, TICK)?;
    let mut chart = Chart::new(
        "What is left after a half turn in two first periods, delay of the shapers included",
        Axis::tight("error of the arm's frequency, %"),
        Axis::log("residual vibration, % of the arm's length"),
    )
    .sized(760, 460);
    for (name, label, colour, dash) in shown {
        let found =
            motions.iter().find(|(is, _)| is == name || (name == "robust" && is.contains(name)));
        let Some((_, motion)) = found else { continue };
        let points = (-20..=20)
            .into_par_iter()
            .map(|percent| f64::from(percent) / 100.0)
            .map(|error| Ok((100.0 * error, 100.0 * motion.judge(&arm, error)?.residual.max(1e-5))))
            .collect::<Result<Vec<_>, Error>>()?;
        let width = if dash == Dash::Solid { 3 } else { 2 };
        chart = chart.with(Series::line(label, points).colour(colour).dash(dash).width(width));
    }
    let svg = chart.svg()?;
    files.add(path, |file| file.write_all(svg.as_bytes()))
}
