//! Writes the tables and the pictures of `docs/still.md`.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use stillbeam::planner::{Planner, Request};
use stillbeam::{Error as CoreError, Profile, Scene};

use super::duration::durations;
use crate::fastest::eased;
use crate::markers::Block;
use crate::table::aligned;
use stillbeam_sim::error::Error;
use stillbeam_sim::number::Digits;
use stillbeam_sim::output::Files;
use stillbeam_sim::plan::comparison::{self, ERRORS, Entry};
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::plan::picture;
use stillbeam_sim::reference::rod;
use stillbeam_sim::scenes;

/// Setpoint interval of every motion, s.
const TICK: f64 = 0.01;

/// Durations of the residual table, first periods.
const RATIOS: [f64; 4] = [1.0, 1.5, 2.0, 3.0];

/// Durations of the comparison of motions, first periods.
const CONTEST: [f64; 2] = [1.5, 2.0];

/// Duration of the picture that moves, first periods: one of the comparison.
const SHOWN: f64 = CONTEST[1];

/// Bands of the table of robust moves, each in all of [`RATIOS`] but the shortest.
const SPREADS: [f64; 2] = [0.05, 0.15];

/// Steps of [`compute`], for a progress bar.
pub const STEPS: usize = 90;

/// Steps of [`pictures`].
pub const PICTURE_STEPS: usize = 28;

/// The page's tables, and the picture that moves.
pub struct Document {
    /// All blocks between markers, by name.
    pub blocks: Vec<Block>,
    /// The arm along three of the motions of the comparison in two first periods, as SVG.
    pub moving: String,
}

/// Computes the tables and the picture that moves.
pub fn compute(done: &(dyn Fn() + Sync)) -> Result<Document, Error> {
    let mut moving = String::new();
    let mut blocks = vec![Block::new("residual", residuals(done)?)];
    let arm = arm("a-tip30")?;
    let period = rod::first_period(&arm)?;
    for ratio in CONTEST {
        let duration = (ratio * period / TICK).round() * TICK;
        let entries = comparison::entries(&arm, PI, duration, TICK, done)?;
        blocks.push(Block::new(format!("contest-{ratio}"), contest_table(&entries, duration)));
        if ratio == SHOWN {
            let picture = picture::moving(&entries, &arm, PI);
            moving = picture.map(|picture| picture.svg()).unwrap_or_default();
        }
    }
    blocks.push(Block::new("robust", robust_table(done)?));
    blocks.push(Block::new("durations", duration_table(&arm, period)?));
    blocks.push(eased::block()?);
    Ok(Document { blocks, moving })
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
            let planner = Planner::<f32, 2>::new(&arm, tick)?;
            let mut line = vec![name.to_owned()];
            for ratio in RATIOS {
                let plan = planner.plan(&half_turn(ratio * period))?;
                let judged = Motion::of(0.0, plan.motion(), tick).judge(&arm, 0.0)?;
                line.push(Digits::Column.show(100.0 * judged.residual));
                done();
            }
            Ok(line)
        })
        .collect::<Result<Vec<_>, Error>>()?;
    lines.extend(rows);
    Ok(aligned(&lines))
}

fn contest_table(entries: &[Entry], duration: f64) -> String {
    let header = comparison::HEADER.map(str::to_owned).to_vec();
    let rows = entries.iter().map(|entry| entry.cells(duration));
    aligned(&std::iter::once(header).chain(rows).collect::<Vec<_>>())
}

/// Returns a move from 0 to π rad in `duration` s, for any deflection of the arm.
fn half_turn(duration: f64) -> Request<f32, 2> {
    Request::from_rest(0.0, PI).duration(duration).any_deflection()
}

/// Robust moves for bands of other widths, with damping and gravity too.
fn robust_table(done: &(dyn Fn() + Sync)) -> Result<String, Error> {
    let mut header = ["arm", "planned for", "duration"].map(str::to_owned).to_vec();
    header.extend(comparison::HEADER[1..=ERRORS.len()].iter().map(|&error| error.to_owned()));
    header.push("acceleration".to_owned());
    let shown = [0, 5, 6];
    let arms: Vec<_> = arms()?.into_iter().enumerate().filter(|(k, _)| shown.contains(k)).collect();
    let cases: Vec<_> = arms
        .iter()
        .flat_map(|(_, arm)| SPREADS.map(|spread| (arm, spread)))
        .flat_map(|(arm, spread)| RATIOS[1..].iter().map(move |&ratio| (arm, spread, ratio)))
        .collect();
    let rows = cases
        .into_par_iter()
        .map(|((name, arm), spread, ratio)| {
            let period = rod::first_period(arm)?;
            let tick = TICK.min(period / 10.0);
            let planner = Planner::<f32, 2>::robust(arm, tick, spread)?;
            let found = planner.plan(&half_turn(ratio * period));
            let mut line = vec![
                (*name).to_owned(),
                format!("\u{b1}{:.0} %", 100.0 * spread),
                format!("{ratio} T\u{2081}"),
            ];
            let plan = match found {
                Ok(plan) => plan,
                // No move for three arms in so short a time.
                Err(CoreError::NotStill { .. }) => {
                    line.extend(std::iter::repeat_n("\u{2013}".to_owned(), ERRORS.len() + 1));
                    done();
                    return Ok(line);
                }
                Err(error) => return Err(error.into()),
            };
            let motion = Motion::of(0.0, plan.motion(), tick);
            for error in ERRORS {
                line.push(Digits::Column.show(100.0 * motion.judge(arm, error)?.residual));
            }
            let duration = plan.duration();
            line.push(format!("{:.2}", plan.peaks.acceleration * duration * duration / PI));
            done();
            Ok(line)
        })
        .collect::<Result<Vec<_>, Error>>()?;
    let lines: Vec<_> = std::iter::once(header).chain(rows).collect();
    Ok(aligned(&lines))
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

/// Draws the pictures beside the text, `still.svg` and `still-swing.svg` for `still.md`. Returns
/// their paths.
pub fn pictures(
    files: &mut Files,
    text: &Path,
    done: &(dyn Fn() + Sync),
) -> Result<[PathBuf; 2], Error> {
    let arm = arm("a-tip30")?;
    let period = rod::first_period(&arm)?;
    let duration = (2.0 * period / TICK).round() * TICK;
    let curves = picture::curves(&arm, PI, duration, TICK, done)?;
    let entries = comparison::entries(&arm, PI, duration, TICK, done)?;
    let swing = picture::swing(&entries, duration, arm.link.length);
    let stem = text.file_stem().unwrap_or_default().to_string_lossy();
    let paths = [text.with_extension("svg"), text.with_file_name(format!("{stem}-swing.svg"))];
    for (chart, path) in [picture::sensitivity(&curves), swing].iter().zip(&paths) {
        let svg = chart.svg()?;
        files.add(path, |file| file.write_all(svg.as_bytes()))?;
    }
    Ok(paths)
}
