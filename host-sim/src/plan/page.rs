//! A planned move as pictures and as a table.

use std::path::{Path, PathBuf};

use maud::html;

use super::judge::{Judgement, Motion};
use super::{Planned, Request, moving, shortest};
use crate::axis_units;
use crate::error::Error;
use crate::output::Files;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::reference::Sample;
use crate::report::parts::{figure, page};
use crate::table;

use stillbeam::planner::ShortestMove;
use stillbeam::{Move, Profile};

/// Writes `index.html`, a picture for each chart, the one that moves (`moving.svg`, of an arm that
/// turns), and `plan.csv` into a folder. Returns the page's path.
pub fn write(
    folder: &Path,
    name: &str,
    request: &Request,
    planned: &Planned,
) -> Result<PathBuf, Error> {
    let quintic = quintic(request, planned)?;
    let charts = charts(request, planned, &quintic);
    let moving = moving::animation(request, &quintic, &planned.judgement);
    let caption = html! {
        "The commanded motion, what the tip of the reference rod does with it and after it, and what \
         is left where the arm's frequency is not what the plan was made for. Dashed: a quintic of \
         the same duration."
    };
    let named: Vec<Chart> = charts.iter().map(|(_, chart)| chart.clone()).collect();
    let body = html! {
        header { h1 { "A move that arrives still" } p.lead { (name) } }
        @if let Some(moving) = &moving {
            (moving.figure(&html! {
                "Both arms " (moving.speed()) ", over and over: what a quintic of the same duration \
                 leaves, and what the still move does. Dashed: where the arm shall rest. "
                a href="moving.svg" { "The picture as a file" } "."
            }))
        }
        (figure(&named, &caption, "plan.csv")?)
    };
    let mut files = Files::default();
    for (file, chart) in &charts {
        let svg = chart.svg()?;
        let path = folder.join(file).with_extension("svg");
        files.add(&path, |file| file.write_all(svg.as_bytes()))?;
    }
    if let Some(moving) = &moving {
        let svg = moving.svg();
        files.add(&folder.join("moving.svg"), |file| file.write_all(svg.as_bytes()))?;
    }
    let rows: Vec<Vec<f64>> = planned
        .judgement
        .samples
        .iter()
        .map(|s| vec![s.t, s.angle, s.rate, s.acceleration, s.deflection, s.torque])
        .collect();
    let [t, position, rate, acceleration, _, _, deflection, effort] =
        table::columns(request.arm.mount.axis);
    let header = [t, position, rate, acceleration, deflection, effort];
    table::add_columns(&mut files, &folder.join("plan.csv"), &header, &rows)?;
    if let ShortestMove::Fastest(fastest) = &planned.plan {
        shortest::add_rows(&mut files, &folder.join("motion.csv"), fastest)?;
    }
    let path = folder.join("index.html");
    let text = page(name, &body);
    files.add(&path, |file| file.write_all(text.as_bytes()))?;
    files.finish()?;
    Ok(path)
}

/// Judges a quintic of the same duration.
fn quintic(request: &Request, planned: &Planned) -> Result<Judgement, Error> {
    let duration = planned.plan.duration();
    let motion = Move::To { profile: Profile::Quintic, duration, to: request.to };
    Motion::of(request.from, motion, request.tick).judge(&request.arm, 0.0)
}

/// Returns the charts of motion, acceleration, deflection, torque and sensitivity, each with its
/// file's name.
fn charts(request: &Request, planned: &Planned, other: &Judgement) -> Vec<(&'static str, Chart)> {
    let units = axis_units::of(request.arm.mount.axis);
    let duration = planned.plan.duration();
    let length = request.arm.link.length;
    let line = |label: &str, samples: &[Sample], of: &dyn Fn(&Sample) -> f64| {
        Series::line(label, samples.iter().map(|s| (s.t, of(s))).collect::<Vec<_>>())
    };
    let pair = |title: &str, unit: &str, of: &dyn Fn(&Sample) -> f64| {
        Chart::new(title, Axis::tight("time, s"), Axis::linear(unit))
            .with(line("quintic", &other.samples, of).colour(Colour::Grey).dash(Dash::Dashed))
            .with(line("still", &planned.judgement.samples, of).colour(Colour::Blue))
            .mark(duration, "arrival")
    };
    let curve: Vec<_> =
        planned.sensitivity.iter().map(|&(error, left)| (100.0 * error, 100.0 * left)).collect();
    let sensitivity = Chart::new(
        "Sensitivity",
        Axis::tight("error of the arm's frequency, %"),
        Axis::linear("residual, % of L"),
    )
    .with(Series::line("still", curve).colour(Colour::Blue));
    vec![
        (units.name, pair(&format!("Hub {}", units.name), units.position, &|s| s.angle)),
        ("acceleration", pair("Hub acceleration", units.acceleration, &|s| s.acceleration)),
        ("deflection", pair("Tip deflection", "% of L", &|s| 100.0 * s.deflection / length)),
        (units.effort, pair(&format!("Hub {}", units.effort), units.effort_unit, &|s| s.torque)),
        ("sensitivity", sensitivity),
    ]
}
