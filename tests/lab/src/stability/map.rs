//! Verdicts over a plane.

use rayon::prelude::*;

use super::probe::{self, Task, Verdict};
use stillbeam_sim::error::Error;
use stillbeam_sim::plot::{Axis, Chart, Colour, Marker, Series};
use stillbeam_sim::reference::fem;
use stillbeam_sim::solver::{Method, Quality, Scalar, Solver};

/// Verdicts over a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Title: what is judged.
    pub title: String,
    /// Name in file names.
    pub name: &'static str,
    /// Cells: `(x, y)` and the verdict there.
    pub cells: Vec<(f64, f64, Verdict)>,
}

/// Returns the mapped solvers, each with its name in file names. Their tick is left open.
pub fn solvers() -> [(&'static str, Solver); 6] {
    let newmark = Solver { method: Method::Newmark, scalar: Scalar::F32, ..Solver::PAPER };
    let modal = Solver { method: Method::Modal, elements: 8, ..newmark };
    let elastica = Solver { method: Method::Elastica, ..newmark };
    [
        ("newmark-1", newmark),
        ("newmark-8", Solver { elements: 8, ..newmark }),
        ("modal-2", modal),
        ("elastica-1-fast", Solver { modes: 1, quality: Quality::Fast, ..elastica }),
        ("elastica-2-fast", Solver { quality: Quality::Fast, ..elastica }),
        ("elastica-2-fine", elastica),
    ]
}

/// Steps of [`all`], for a progress bar.
pub const STEPS: usize = 2 * 6 + 1;

/// Returns the ticks of the first kind of map, s, and, below, its first frequencies, Hz.
fn ticks() -> Vec<f64> {
    (0..=16).map(|k| 10f64.powf(-4.0 + f64::from(k) / 4.0)).collect()
}

fn frequencies() -> Vec<f64> {
    (0..=16).map(|k| 10f64.powf(-1.0 + f64::from(k) / 4.0)).collect()
}

/// Returns `ω₁h` of the second kind of map, and, below, its rates in ω₁.
fn turns() -> Vec<f64> {
    (0..=24).map(|k| 10f64.powf(-2.0 + f64::from(k) / 8.0)).collect()
}

fn rates() -> Vec<f64> {
    (0..=20).map(|k| 0.25 * f64::from(k)).collect()
}

/// Computes every map: over tick and frequency, over `ω₁h` and rate, and that of the trapezoidal
/// rule.
pub fn all(done: &(dyn Fn() + Sync)) -> Result<Vec<Map>, Error> {
    let mut maps = Vec::new();
    for (name, solver) in solvers() {
        maps.push(moving(name, &solver)?);
        done();
    }
    for (name, solver) in solvers() {
        maps.push(spinning(name, &solver)?);
        done();
    }
    maps.push(trapezoidal()?);
    done();
    Ok(maps)
}

fn plane(
    x: &[f64],
    y: &[f64],
    judge: impl Fn(f64, f64) -> Result<Verdict, Error> + Sync,
) -> Result<Vec<(f64, f64, Verdict)>, Error> {
    let cells: Vec<(f64, f64)> = x.iter().flat_map(|&x| y.iter().map(move |&y| (x, y))).collect();
    cells.into_par_iter().map(|(x, y)| Ok((x, y, judge(x, y)?))).collect()
}

fn describe(solver: &Solver) -> String {
    let text = solver.describe();
    // Without the tick.
    let tick = format!(", {} ms", solver.tick * 1e3);
    text.replace(&tick, "")
}

/// Maps a method over frequency and tick.
pub fn moving(name: &'static str, solver: &Solver) -> Result<Map, Error> {
    let cells = plane(&frequencies(), &ticks(), |hertz, tick| {
        probe::judge(&Solver { tick, ..*solver }, std::f64::consts::TAU * hertz, Task::Move)
    })?;
    Ok(Map { title: describe(solver), name, cells })
}

/// Maps a method over `ω₁h` and the rate that is held, in ω₁, at a tick of 10 ms.
pub fn spinning(name: &'static str, solver: &Solver) -> Result<Map, Error> {
    let cells = plane(&turns(), &rates(), |turn, rate| {
        probe::judge(solver, turn / solver.tick, Task::Spin(rate))
    })?;
    Ok(Map { title: describe(solver), name, cells })
}

/// Maps the trapezoidal rule (Newmark's, δ = ½, β = ¼) on corotational elements, with equilibrium
/// iterations, over the same plane. It is the reference solver's, with four elements and its own
/// step as the tick.
pub fn trapezoidal() -> Result<Map, Error> {
    let tick = 0.01;
    let cells = plane(&turns(), &rates(), |turn, rate| {
        let omega = turn / tick;
        let arm = probe::arm(omega)?;
        let scene = probe::scene(&arm, omega, tick, Task::Spin(rate), 500.0);
        let Ok(trajectory) = scene.trajectory(tick) else { return Ok(Verdict::Refused) };
        let times = stillbeam_sim::truth::times(&trajectory, tick);
        let options = fem::Options {
            elements: 4,
            step: Some(tick),
            axial_stiffness: 1e4,
            ..fem::Options::default()
        };
        let Ok(samples) = fem::solve(&scene.arm, &trajectory, &times, &options) else {
            return Ok(Verdict::Unstable);
        };
        let found: Vec<f64> = samples.iter().map(|sample| sample.deflection).collect();
        let exact = Solver { method: Method::Elastica, tick, ..Solver::PAPER };
        let truth = probe::truth(&arm, &exact, omega, Task::Spin(rate))?;
        Ok(probe::verdict(&found, &truth, 500))
    })?;
    let title = "trapezoidal rule, 4 corotational elements, f64".to_owned();
    Ok(Map { title, name: "trapezoidal", cells })
}

impl Map {
    /// Returns the number of cells with that verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.cells.iter().filter(|cell| cell.2 == verdict).count()
    }

    /// The greatest `x·y·scale` below which no cell is worse than `verdict`, refusals apart.
    pub fn holds_up_to(&self, verdict: Verdict, of: impl Fn(f64, f64) -> f64) -> f64 {
        let worse = |cell: &&(f64, f64, Verdict)| cell.2 > verdict && cell.2 != Verdict::Refused;
        let least = self.cells.iter().filter(worse).map(|&(x, y, _)| of(x, y));
        let least = least.fold(f64::INFINITY, f64::min);
        let below = self.cells.iter().filter(|cell| cell.2 <= verdict).map(|&(x, y, _)| of(x, y));
        below.filter(|&value| value < least * (1.0 - 1e-9)).fold(0.0, f64::max)
    }

    /// Draws the map, one mark a cell.
    pub fn chart(&self, x: Axis, y: Axis) -> Chart {
        let look = |verdict| match verdict {
            Verdict::Accurate => (Colour::Green, Marker::Disc),
            Verdict::Inaccurate => (Colour::Orange, Marker::Dot),
            Verdict::Unstable => (Colour::Vermilion, Marker::Cross),
            Verdict::Refused => (Colour::Grey, Marker::Ring),
        };
        let of = |verdict: Verdict| {
            let points = self.cells.iter().filter(move |cell| cell.2 == verdict);
            let (colour, marker) = look(verdict);
            Series::scatter(verdict.name(), points.map(|&(x, y, _)| (x, y)))
                .colour(colour)
                .marker(marker)
        };
        let shown = Verdict::ALL.into_iter().filter(|&verdict| self.count(verdict) > 0);
        Chart::new(self.title.clone(), x, y).sized(520, 400).with_all(shown.map(of))
    }
}
