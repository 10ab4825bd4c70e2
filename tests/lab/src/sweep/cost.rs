//! Cost of a case: time and memory on the machine at hand, one case at a time on one thread.

use std::hint::black_box;
use std::time::{Duration, Instant};

use stillbeam_erased::AnyStepper;

use super::row::Cost;
use stillbeam_sim::dispatch;
use stillbeam_sim::error::Error;
use stillbeam_sim::run::each_tick;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::SolverKeys;
use stillbeam_sim::table::significant;

/// Number of set-ups that are timed.
const SETUPS: usize = 31;

/// Runs are repeated until this many ticks are timed, at least and at most so often.
const TICKS: usize = 20_000;
const RUNS: std::ops::RangeInclusive<usize> = 7..=50;

/// Measures a case.
///
/// A tick is one call of `Generator::tick`: motion, step and response. It is timed by itself, less
/// the time of an empty measurement. Of the repeated runs each tick keeps its fastest time. So the
/// slowest tick is one that computes more, not one that the machine interrupted.
pub fn cost(scene: &SceneFile, keys: SolverKeys) -> Result<Cost, Error> {
    let solver = keys.resolve()?;
    let mut setups = Vec::with_capacity(SETUPS);
    for _ in 0..SETUPS {
        let start = Instant::now();
        black_box(dispatch::stepper(scene, &solver)?);
        setups.push(start.elapsed().as_secs_f64());
    }
    let stepper = dispatch::stepper(scene, &solver)?;
    let mut ticks = ticks(scene, &*stepper)?;
    let [state, whole] = stepper.sizes();
    Ok(Cost {
        setup_us: significant(1e6 * median(&mut setups), 3),
        state_bytes: state as u64,
        stepper_bytes: whole as u64,
        worst_ns: significant(1e9 * ticks.iter().copied().fold(0.0, f64::max), 3),
        tick_ns: significant(1e9 * median(&mut ticks), 3),
    })
}

/// Returns the fastest time of each tick of the scene, s.
fn ticks(scene: &SceneFile, stepper: &dyn AnyStepper) -> Result<Vec<f64>, Error> {
    let empty = empty_measurement();
    let mut fastest: Vec<f64> = Vec::new();
    let mut runs = 0;
    while runs < *RUNS.start() || (runs < *RUNS.end() && runs * fastest.len() < TICKS) {
        each_tick(stepper, scene, |generator, k, _| {
            let start = Instant::now();
            black_box(generator.tick());
            let time = start.elapsed().saturating_sub(empty).as_secs_f64();
            match fastest.get_mut(k as usize) {
                Some(best) => *best = best.min(time),
                None => fastest.push(time),
            }
        })?;
        runs += 1;
    }
    Ok(fastest)
}

/// Returns the time of an empty measurement.
fn empty_measurement() -> Duration {
    let empty = || {
        let start = Instant::now();
        black_box(());
        start.elapsed()
    };
    (0..1000).map(|_| empty()).min().unwrap_or_default()
}

fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
