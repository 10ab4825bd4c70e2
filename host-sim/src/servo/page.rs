//! The trials of a drive as a table and as pictures.

use std::path::{Path, PathBuf};

use maud::html;

use super::between::Interpolator;
use super::trials::{Outcome, Report};
use super::{Between, Target, moving};
use crate::error::Error;
use crate::number::Digits;
use crate::output::Files;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::report::parts::{Table, figure, page};
use crate::table;

/// Columns of the table.
pub const HEADER: [&str; 8] = [
    "sent",
    "hub, rad",
    "tip, % of L",
    "residual, % of L",
    "if the hub followed, % of L",
    "off after arrival, % of L",
    "torque, N m",
    "saturated, %",
];

/// Returns the cells of a row.
pub fn cells(outcome: &Outcome) -> Vec<String> {
    let judged = &outcome.judged;
    let percent = |fraction: f64| Digits::Three.show(100.0 * fraction);
    vec![
        outcome.trial.describe(),
        Digits::Three.show(judged.hub),
        percent(judged.tip),
        percent(judged.residual),
        percent(outcome.exact),
        percent(judged.off),
        Digits::Three.show(judged.torque),
        percent(judged.saturated),
    ]
}

/// Writes `index.html`, its pictures, the one that moves (`moving.svg`) among them, and
/// `drive.csv`, the hub's errors over time, into a folder. Returns the page's path.
///
/// # Errors
/// A path that cannot be written.
pub fn write(folder: &Path, title: &str, report: &Report) -> Result<PathBuf, Error> {
    let charts = [
        ("hub", hub(report)),
        ("deflection", deflection(report)),
        ("torque", torque(report)),
        ("between", between(report)),
    ];
    let rows = Table {
        caption:
            "Largest errors of each run; residual: largest deflection over a first period after \
                  arrival"
                .to_owned(),
        header: HEADER.to_vec(),
        rows: report.outcomes.iter().map(cells).collect(),
        key: None,
    };
    let moving = moving::animation(report);
    let caption = html! {
        "The hub against its command, what the tip does, the motor's torque, and what a drive does \
         between two setpoints."
    };
    let named: Vec<Chart> = charts.iter().map(|(_, chart)| chart.clone()).collect();
    let body = html! {
        header { h1 { "What feed-forward is worth" } p.lead { (title) } }
        p { (report.conclusion()) "." }
        (moving.figure(&html! {
            "The arm behind the drive " (moving.speed()) ", over and over, with less and with more that is \
             sent. Dashed: where it shall rest. "
            a href="moving.svg" { "The picture as a file" } "."
        }))
        (rows.markup())
        (figure(&named, &caption, "drive.csv")?)
    };
    let mut files = Files::default();
    for (file, chart) in &charts {
        let svg = chart.svg()?;
        let path = folder.join(file).with_extension("svg");
        files.add(&path, |file| file.write_all(svg.as_bytes()))?;
    }
    let svg = moving.svg();
    files.add(&folder.join("moving.svg"), |file| file.write_all(svg.as_bytes()))?;
    add_errors(&mut files, &folder.join("drive.csv"), report)?;
    let path = folder.join("index.html");
    let text = page(title, &body);
    files.add(&path, |file| file.write_all(text.as_bytes()))?;
    files.finish()?;
    Ok(path)
}

/// Adds a table of every run at every sample.
fn add_errors(files: &mut Files, path: &Path, report: &Report) -> Result<(), Error> {
    let header = ["trial", "t_s", "hub_angle_rad", "deflection_m", "motor_torque_nm"];
    let rows: Vec<Vec<f64>> = report
        .outcomes
        .iter()
        .enumerate()
        .flat_map(|(index, outcome)| {
            let trace = &outcome.trace;
            trace.shown.iter().zip(&trace.torque).map(move |(shown, torque)| {
                vec![index as f64, shown.t, shown.angle, shown.deflection, *torque]
            })
        })
        .collect();
    table::add_columns(files, path, &header, &rows)
}

/// Colours and dashes of the runs that are drawn.
const STYLES: [(Colour, Dash); 4] = [
    (Colour::Grey, Dash::Dotted),
    (Colour::Orange, Dash::Dashed),
    (Colour::Blue, Dash::Solid),
    (Colour::Vermilion, Dash::Solid),
];

/// Draws a value of the first runs, those of the scene's own moves, over time.
fn drawn(report: &Report, of: &dyn Fn(&Outcome) -> Vec<(f64, f64)>) -> Vec<Series> {
    let own = report.outcomes.iter().filter(|outcome| !outcome.trial.still);
    own.zip(STYLES)
        .map(|(outcome, (colour, dash))| {
            Series::line(outcome.trial.describe(), of(outcome)).colour(colour).dash(dash)
        })
        .collect()
}

/// Returns the hub's error over time, (s, rad): its angle less the command, later by the drive's
/// lag.
pub fn hub_error(report: &Report, outcome: &Outcome) -> Vec<(f64, f64)> {
    let shift = (4.0 * outcome.lag / report.tick).round() as usize;
    let late: Vec<f64> = report.commanded.angles(0.0).map(|(_, angle)| angle).collect();
    let shown = outcome.trace.shown.iter().enumerate();
    shown.filter_map(|(k, s)| Some((s.t, s.angle - late.get(k.saturating_sub(shift))?))).collect()
}

/// Draws the hub's error over time.
pub fn hub(report: &Report) -> Chart {
    let error = |outcome: &Outcome| hub_error(report, outcome);
    Chart::new("Hub behind its command", Axis::tight("time, s"), Axis::linear("hub error, rad"))
        .sized(760, 400)
        .mark(report.commanded.arrival(), "arrival")
        .with_all(drawn(report, &error))
}

/// Draws the tip's deflection of the plain and of the still move with all that can be sent.
pub fn deflection(report: &Report) -> Chart {
    let line = |outcome: &Outcome, colour: Colour| {
        let points: Vec<_> =
            outcome.trace.shown.iter().map(|s| (s.t, 1e3 * s.deflection)).collect();
        Series::line(outcome.trial.describe(), points).colour(colour)
    };
    let known = |outcome: &&Outcome| {
        let trial = &outcome.trial;
        trial.feed.torque
            && trial.between.is_none()
            && trial.unknown == super::trials::Unknown::None
    };
    let colours = [Colour::Grey, Colour::Blue];
    let lines = report.outcomes.iter().filter(known).zip(colours);
    Chart::new("Tip deflection", Axis::tight("time, s"), Axis::linear("deflection, mm"))
        .sized(760, 400)
        .mark(report.commanded.arrival(), "arrival")
        .with_all(lines.map(|(outcome, colour)| line(outcome, colour)))
}

/// Draws the motor's torque.
pub fn torque(report: &Report) -> Chart {
    let torque = |outcome: &Outcome| {
        outcome.trace.shown.iter().zip(&outcome.trace.torque).map(|(s, x)| (s.t, *x)).collect()
    };
    Chart::new("Motor torque", Axis::tight("time, s"), Axis::linear("torque, N m"))
        .sized(760, 400)
        .mark(report.commanded.arrival(), "arrival")
        .with_all(drawn(report, &torque))
}

/// Draws what each way between setpoints makes of four of them, where the hub accelerates most.
pub fn between(report: &Report) -> Chart {
    let tick = report.tick;
    let command: Vec<(f64, f64)> = report.commanded.angles(0.0).collect();
    let per_tick = super::bench::SAMPLES as usize;
    let arrival = (report.commanded.arrival() / tick).round() as usize;
    // The ends of a move are where the rate changes fastest; a fifth on is inside of it.
    let first = arrival / 5;
    let at = |k: usize| command.get(k * per_tick).map_or(0.0, |point| point.1);
    let rate = |k: usize| {
        let here = k * per_tick;
        let side = |k: usize| command.get(k).map_or(0.0, |point| point.1);
        (side(here + 1) - side(here.saturating_sub(1))) * per_tick as f64 / (2.0 * tick)
    };
    let target = |k: usize| Target { position: at(k), velocity: rate(k), torque: 0.0 };
    let line = |between: Between| {
        let mut follow = Interpolator::resting(between, tick, at(first));
        follow.push(-tick, target(first));
        let mut points = Vec::new();
        for k in 0..4 {
            let begin = tick * k as f64;
            follow.push(begin, target(first + k + 1));
            for step in 0..=20 {
                let t = begin + tick * f64::from(step) / 20.001;
                points.push((1e3 * t, follow.target(t).position));
            }
        }
        Series::line(between.name(), points)
    };
    let exact: Vec<_> = (0..=4 * per_tick)
        .map(|k| {
            let t = tick * k as f64 / per_tick as f64;
            (1e3 * t, command.get((first + 1) * per_tick + k).map_or(0.0, |point| point.1))
        })
        .collect();
    Chart::new(
        "Between setpoints",
        Axis::tight("time, ms"),
        Axis::linear("what the loops are to follow, rad"),
    )
    .sized(760, 400)
    .with(Series::line("command", exact).colour(Colour::Grey).dash(Dash::Dotted))
    .with_all(Between::ALL.map(line))
}
