//! Runs scenes by the million on all cores. The results do not depend on the number of cores.

use std::ops::Range;
use std::path::Path;

use super::draw::{Drawn, draw};
use super::summary::Summary;
use super::trial::{Verdict, trial};
use crate::campaign::{self, chunks};
use stillbeam_sim::error::Error;
use stillbeam_sim::output;
use stillbeam_sim::solver::Solver;

/// Runs `scenes` scenes of a seed. With a `part`, the progress is saved in that file after every
/// ten thousand scenes. A campaign that finds the file goes on from there.
pub fn run(
    seed: u64,
    scenes: u64,
    part: Option<&Path>,
    done: &(dyn Fn(u64) + Sync),
) -> Result<Summary, Error> {
    let mut summary = match part.filter(|path| path.exists()) {
        Some(path) => read(path, seed)?,
        None => Summary::new(seed),
    };
    done(summary.scenes.min(scenes));
    for numbers in chunks(summary.scenes, scenes) {
        for (index, (_, verdicts)) in numbers.clone().zip(each(seed, numbers, done)) {
            summary.add(index, &verdicts);
        }
        if let Some(path) = part {
            write(path, &summary)?;
        }
    }
    Ok(summary)
}

/// A scene and the verdicts on its solvers.
pub type Judged = (Drawn, Vec<(Solver, Verdict)>);

/// Runs the scenes of those numbers.
pub fn each(seed: u64, numbers: Range<u64>, done: &(dyn Fn(u64) + Sync)) -> Vec<Judged> {
    campaign::each("scene", numbers, &|| done(1), |index| {
        let drawn = draw(seed, index);
        let verdicts = drawn.solvers.iter().map(|solver| (*solver, trial(&drawn, solver)));
        let verdicts = verdicts.collect();
        (drawn, verdicts)
    })
}

fn read(path: &Path, seed: u64) -> Result<Summary, Error> {
    let text = std::fs::read_to_string(path).map_err(|cause| {
        Error::file(path, format_args!("{cause}; it must be a file that a campaign wrote"))
    })?;
    let summary: Summary = toml::from_str(&text).map_err(|cause| {
        Error::file(path, format_args!("{cause}; it must be a file that a campaign wrote"))
    })?;
    if summary.seed != seed {
        let left = summary.seed;
        return Err(Error::file(
            path,
            format_args!("seed = {left}: must be {seed}, as asked for, or no such file"),
        ));
    }
    Ok(summary)
}

fn write(path: &Path, summary: &Summary) -> Result<(), Error> {
    let text = toml::to_string(summary).map_err(|cause| Error::file(path, cause))?;
    output::write_whole(path, |file| file.write_all(text.as_bytes()))
}
