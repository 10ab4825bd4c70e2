//! Scenes by the million, on all cores, the same whatever their number.

use std::ops::Range;
use std::path::Path;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use super::draw::{Drawn, draw};
use super::summary::Summary;
use super::trial::{Verdict, trial};
use stillbeam_sim::error::Error;
use stillbeam_sim::output;
use stillbeam_sim::solver::Solver;

/// Scenes between two writes.
const CHUNK: u64 = 10_000;

/// A scene takes some milliseconds, and some seconds where `auto` tries a stiff arm for ten thousand ticks.
/// One that takes this long hangs.
const PATIENCE: Duration = Duration::from_secs(600);

/// Runs `scenes` scenes of a seed. With a `part`, what is done stands in that file after every
/// ten thousand, and a campaign that finds it goes on from there.
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
    while summary.scenes < scenes {
        let from = summary.scenes;
        let numbers = from..scenes.min((from / CHUNK + 1) * CHUNK);
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
    let watch = Watch::default();
    watch.over(|| {
        numbers
            .into_par_iter()
            .map(|index| {
                let judged = watch.time(index, || {
                    let drawn = draw(seed, index);
                    let verdicts =
                        drawn.solvers.iter().map(|solver| (*solver, trial(&drawn, solver)));
                    let verdicts = verdicts.collect();
                    (drawn, verdicts)
                });
                done(1);
                judged
            })
            .collect()
    })
}

/// Scenes under way and since when. A scene that hangs cannot be interrupted: it ends the program.
#[derive(Default)]
struct Watch {
    under_way: Mutex<Vec<(u64, Instant)>>,
}

impl Watch {
    fn time<R>(&self, index: u64, run: impl FnOnce() -> R) -> R {
        let scenes = || self.under_way.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        scenes().push((index, Instant::now()));
        let result = run();
        scenes().retain(|(under_way, _)| *under_way != index);
        result
    }

    fn over<R>(&self, run: impl FnOnce() -> R) -> R {
        let (stop, stopped) = std::sync::mpsc::channel::<()>();
        std::thread::scope(|scope| {
            scope.spawn(move || {
                let pause = Duration::from_secs(1);
                while stopped.recv_timeout(pause) == Err(std::sync::mpsc::RecvTimeoutError::Timeout)
                {
                    let scenes = self.under_way.lock().unwrap_or_else(|p| p.into_inner());
                    if let Some((index, _)) = scenes.iter().find(|s| s.1.elapsed() > PATIENCE) {
                        eprintln!("error: scene {index} hangs");
                        std::process::exit(1);
                    }
                }
            });
            let result = run();
            drop(stop);
            result
        })
    }
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
