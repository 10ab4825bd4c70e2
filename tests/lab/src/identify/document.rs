//! The campaign's table and pictures on the page of `identify`.

use stillbeam_sim::error::Error;
use stillbeam_sim::identify::{Panel, Request};
use stillbeam_sim::plot::{Axis, Chart, Colour, Series};

use super::arm::{Case, Kind};
use super::summary::{Summary, Tally};
use crate::markers::Block;
use crate::table::{aligned, grouped};

/// Name of the block on the page.
pub const BLOCK: &str = "identify";

/// Returns the block with the command and the table.
pub fn block(seed: u64, count: u64, summary: &Summary) -> Block {
    let header = [
        "logs",
        "count",
        "holds f, %",
        "holds ζ, %",
        "f, %",
        "ζ, %",
        "EI, %",
        "worst f, %",
        "worst ζ, %",
    ];
    let row = |tally: &Tally| {
        let Tally { kind, count, coverage, usual, worst } = tally;
        vec![
            kind.name().to_owned(),
            grouped(*count as u64),
            format!("{:.1}", 100.0 * coverage[0]),
            format!("{:.1}", 100.0 * coverage[1]),
            format!("{:.3}", 100.0 * usual[0]),
            format!("{:.1}", 100.0 * usual[1]),
            format!("{:.3}", 100.0 * usual[2]),
            format!("{:.3}", 100.0 * worst[0]),
            format!("{:.1}", 100.0 * worst[1]),
        ]
    };
    let mut lines = vec![header.map(str::to_owned).to_vec()];
    lines.extend(summary.tallies.iter().map(row));
    let command = format!("`cargo lab identify --count {count} --seed {seed}`:\n\n");
    Block::new(BLOCK, command + &aligned(&lines))
}

/// Returns the pictures of the page, each with its file's name: a ring-down, and a driven arm.
pub fn pictures(seed: u64) -> Result<Vec<(&'static str, String)>, Error> {
    let of = |kind: Kind| {
        let index = Kind::ALL.iter().position(|other| *other == kind).unwrap_or(0) as u64;
        panel(&Case::random(seed, index)?)
    };
    let ringdown = of(Kind::Accelerometer)?;
    let (hub, forced) = (hub(seed)?, of(Kind::Forced)?);
    Ok(vec![
        ("ringdown", chart("A ring-down: tap, let go, wait", "m/s²", 1.0, &ringdown).svg()?),
        ("hub", hub.svg()?),
        ("forced", chart("What the sensor shows of it", "mm", 1e3, &forced).svg()?),
    ])
}

fn panel(case: &Case) -> Result<Panel, Error> {
    let request = Request { modes: Some(1), lowpass: case.lowpass, ..Request::default() };
    let mut identified = request.identify(vec![case.log()?])?;
    Ok(identified.panels.remove(0))
}

/// Draws the hub's motion of the driven arm.
fn hub(seed: u64) -> Result<Chart, Error> {
    let index = Kind::ALL.iter().position(|kind| *kind == Kind::Forced).unwrap_or(0) as u64;
    let log = Case::random(seed, index)?.log()?;
    let angles = log.hub.unwrap_or_default();
    let points = log.time.into_iter().zip(angles.into_iter().map(|angle| 1e3 * angle));
    let chart =
        Chart::new("A hub that shakes the arm", Axis::tight("time, s"), Axis::linear("mrad"));
    Ok(chart.sized(760, 240).with(Series::line("hub", points).colour(Colour::Ink)))
}

fn chart(title: &str, unit: &str, factor: f64, panel: &Panel) -> Chart {
    let curve = |values: &[f64]| {
        let values: Vec<f64> = values.iter().map(|value| factor * value).collect();
        panel.time.iter().copied().zip(values).collect::<Vec<_>>()
    };
    Chart::new(title, Axis::tight("time, s"), Axis::linear(unit))
        .sized(760, 300)
        .with(Series::line("measured", curve(&panel.measured)).colour(Colour::Grey).width(3))
        .with(Series::line("fitted", curve(&panel.fitted)).colour(Colour::Blue))
}
