//! The blocks and pictures of `docs/drive.md` that take seconds.

use std::path::Path;

use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::scenes;
use stillbeam_sim::servo::trials::{Report, Trial, Unknown};
use stillbeam_sim::servo::{Machine, page};

use crate::markers::Block;
use crate::table::aligned;

/// Blocks of the page and the machines that they are of; the first is the default one. The first
/// two have all rows, the others those of what is sent.
pub const MACHINES: [(&str, Option<&str>); 5] = [
    ("odrive", None),
    ("odrive-tuned", Some("odrive-tuned")),
    ("moteus-tuned", Some("moteus-tuned")),
    ("cia402-tuned", Some("cia402-tuned")),
    ("geared", Some("geared")),
];

/// Scene of the page.
pub const SCENE: &str = "d-tip30-quick";

/// Machines with all rows.
const WHOLE: usize = 2;

/// Steps of [`blocks`], about: runs of all machines.
pub const STEPS: usize = 14 * WHOLE + 7 * (MACHINES.len() - WHOLE);

/// Runs the trials of a machine, or with `known` those without anything unknown.
fn report(machine: Option<&str>, known: bool, done: &(dyn Fn() + Sync)) -> Result<Report, Error> {
    let scene = scenes::open(SCENE)?;
    let machine = machine.map_or(Ok(Machine::default()), Machine::open)?;
    let mut trials = Trial::all(&scene.arm);
    trials.retain(|trial| !known || trial.unknown == Unknown::None);
    Report::of(&scene, &machine, &trials, done)
}

/// Returns the tables.
///
/// # Errors
/// None of an embedded machine.
pub fn blocks(done: &(dyn Fn() + Sync)) -> Result<Vec<Block>, Error> {
    MACHINES
        .iter()
        .enumerate()
        .map(|(index, (name, machine))| {
            let report = report(*machine, index >= WHOLE, done)?;
            let option = machine.map_or(String::new(), |name| format!(" --machine {name}"));
            let mut lines = vec![page::HEADER.map(str::to_owned).to_vec()];
            lines.extend(report.outcomes.iter().map(page::cells));
            let text = format!(
                "`stillbeam-sim drive {SCENE}{option}`\n\n{}\nIn one line: {}.\n",
                aligned(&lines),
                report.conclusion()
            );
            Ok(Block::new(*name, text))
        })
        .collect()
}

/// Adds the pictures of the default machine, beside the page.
///
/// # Errors
/// A path that cannot be written.
pub fn pictures(files: &mut Files, path: &Path, done: &(dyn Fn() + Sync)) -> Result<(), Error> {
    let report = report(None, false, done)?;
    for (name, chart) in [("hub", page::hub(&report)), ("between", page::between(&report))] {
        let svg = chart.svg()?;
        let file = path.with_file_name(format!("drive-{name}.svg"));
        files.add(&file, |file| file.write_all(svg.as_bytes()))?;
    }
    Ok(())
}
