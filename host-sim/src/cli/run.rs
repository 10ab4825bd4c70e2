//! `run`: runs the core on a scene.

use std::path::PathBuf;
use std::process::ExitCode;

use serde::Serialize;
use stillbeam::select::{Assessment, Choice, Tolerance};
use stillbeam_sim::compare::residual;
use stillbeam_sim::error::Error;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver, SolverKeys};
use stillbeam_sim::table::Row;
use stillbeam_sim::{axis_units, dispatch, println, run, table};

use super::motion::MotionArgs;

#[derive(clap::Args)]
pub struct RunArgs {
    /// Scene file, or the name of an embedded scene
    scene: String,
    /// File for the setpoints [default: none is written]
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    motion: MotionArgs,
    #[command(flatten)]
    solver: SolverKeys,
    /// Leave out centrifugal stiffening and softening
    #[arg(long)]
    no_spin: bool,
}

impl RunArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let scene = self.motion.open(&self.scene)?;
        let typed = SolverKeys { spin: self.no_spin.then_some(false), ..self.solver };
        let solver = typed.or(scene.solver).resolve()?;
        // What is typed is meant. A file may hold keys for another method than the one that is
        // typed.
        if let Some(line) = typed.unread(solver.method).into_iter().next() {
            return Err(Error::new(line));
        }
        // Printed once the run is accepted: a refusal is one line.
        let (scene, mut notes) = self.motion.command(scene, solver.tick)?;
        if typed.method.is_none() {
            notes.extend(scene.solver.unread(solver.method));
        }
        notes.extend(scene.deduced.lines());
        notes.extend(scene.roundings(solver.tick)?);
        let keys = typed.or(scene.solver);
        let choice = match solver.method {
            Method::Auto => Some(chosen(&scene, &solver, &keys, &mut notes)?),
            _ => None,
        };
        let rows = super::with_limits_shown(|progress| {
            run::run_with(&scene, &solver, choice.as_ref(), progress)
        })?;
        if choice.is_none() {
            notes.extend(remark(&scene, &solver));
        }
        for line in notes {
            super::note(&line);
        }
        if let Some(csv) = &self.csv {
            table::write(csv, scene.arm.mount.axis, &rows)?;
        }
        let report = RunReport::of(&scene, &solver, choice.as_ref(), &rows)?;
        if self.json {
            println!("{}", serde_json::to_string_pretty(&report).map_err(Error::new)?);
        } else {
            self.print(&scene, &solver, choice.as_ref(), &report);
            draw(&scene, &rows);
        }
        Ok(ExitCode::SUCCESS)
    }

    fn print(&self, scene: &SceneFile, solver: &Solver, choice: Option<&Choice>, run: &RunReport) {
        let units = axis_units::of(scene.arm.mount.axis);
        println!("{}: {}", scene.name, solver.describe());
        if let Some(Choice { rung, expected, .. }) = choice {
            println!("  chose            {rung} (expected error {})", errors(scene, expected));
        }
        match &self.csv {
            Some(csv) => println!("  {} setpoints to {}", run.setpoints, csv.display()),
            None => println!("  {} setpoints; --csv OUT.csv writes them", run.setpoints),
        }
        println!("  peak {:<10}  {:.4} {}", units.effort, run.peak_effort, units.effort_unit);
        let bent = run.peak_deflection_m / scene.arm.link.length;
        println!(
            "  peak deflection  {:.2} mm ({:.1} % of L)",
            1e3 * run.peak_deflection_m,
            100.0 * bent
        );
        if bent > 0.3 && matches!(solver.method, Method::Newmark | Method::Modal) {
            println!("  note: small-deflection kinematics; beyond 30 % of L they are a guess");
        }
        if let Some(residual) = run.residual {
            println!(
                "  residual         {:.2} mm ({:.2} % of L) in a first period after arrival",
                1e3 * residual * scene.arm.link.length,
                100.0 * residual
            );
        }
    }
}

/// Draws deflection and effort over time, if standard output is a terminal.
fn draw(scene: &SceneFile, rows: &[Row]) {
    let units = axis_units::of(scene.arm.mount.axis);
    let effort = format!("{}, {}", units.effort, units.effort_unit);
    let end = rows.last().map_or(0.0, |row| row.t_s);
    super::draw(
        [
            ("deflection, mm", rows.iter().map(|row| 1e3 * row.deflection_m).collect()),
            (effort.as_str(), rows.iter().map(|row| row.torque_nm).collect()),
        ],
        end,
    );
}

/// What a run says, for programs.
#[derive(Serialize)]
struct RunReport {
    /// The scene's name or file.
    scene: String,
    /// The solver in words.
    solver: String,
    /// The method that `auto` has chosen, if it was asked.
    chosen: Option<String>,
    setpoints: usize,
    tick_s: f64,
    /// Largest torque, N m; on a linear axis the largest force, N.
    peak_effort: f64,
    peak_deflection_m: f64,
    /// Residual vibration, fraction of L. Absent if the hub does not end at rest.
    residual: Option<f64>,
}

impl RunReport {
    fn of(
        scene: &SceneFile,
        solver: &Solver,
        choice: Option<&Choice>,
        rows: &[Row],
    ) -> Result<Self, Error> {
        let peak = |of: fn(&Row) -> f64| rows.iter().map(of).map(f64::abs).fold(0.0, f64::max);
        Ok(Self {
            scene: scene.name.clone(),
            solver: solver.describe(),
            chosen: choice.map(|choice| choice.rung.to_string()),
            setpoints: rows.len(),
            tick_s: solver.tick,
            peak_effort: peak(|row| row.torque_nm),
            peak_deflection_m: peak(|row| row.deflection_m),
            residual: residual(rows, scene, solver.tick)?.value(),
        })
    }
}

/// Returns the method that `auto` chooses. If no method keeps default tolerances, takes the one
/// that comes nearest and notes it. Returns an error if a method or tolerances were asked for, or
/// if the tip's error exceeds [`REMARKABLE`].
fn chosen(
    scene: &SceneFile,
    solver: &Solver,
    keys: &SolverKeys,
    notes: &mut Vec<String>,
) -> Result<Choice, Error> {
    let none = match dispatch::choose(scene, solver)? {
        Ok(choice) => return Ok(choice),
        Err(none) => none,
    };
    let asked =
        keys.method.is_some() || keys.tolerance.is_some() || keys.torque_tolerance.is_some();
    let near = |choice: &Choice| !asked && choice.expected.tip <= REMARKABLE.tip;
    let Some(nearest) = none.nearest.filter(near) else { return Err(none.error.into()) };
    notes.push(format!(
        "no method keeps {} of L and {} of the {}'s peak here; {} comes nearest, with {}",
        solver.tolerance,
        solver.torque_tolerance,
        axis_units::of(scene.arm.mount.axis).effort,
        nearest.rung,
        errors(scene, &nearest.expected)
    ));
    Ok(nearest)
}

/// Errors above which a method that is named by hand gets a remark.
const REMARKABLE: Tolerance = Tolerance { tip: 0.01, torque: 0.05 };

/// Returns a remark if the method is expected to err by more than [`REMARKABLE`]. The remark names
/// a better method if there is one.
fn remark(scene: &SceneFile, solver: &Solver) -> Option<String> {
    // A method that cannot be judged here has run all the same.
    let expected = dispatch::assess(scene, solver).ok()?;
    if expected.excess(&REMARKABLE) <= 1.0 {
        return None;
    }
    let (tolerance, torque_tolerance) = (Solver::PAPER.tolerance, Solver::PAPER.torque_tolerance);
    let auto = Solver { method: Method::Auto, tolerance, torque_tolerance, ..*solver };
    let better = match dispatch::choose(scene, &auto) {
        Ok(Ok(choice)) => Some(choice),
        Ok(Err(none)) => none.nearest,
        Err(_) => None,
    };
    let excess = |choice: &Choice| choice.expected.excess(&REMARKABLE);
    let advice = match better.filter(|choice| excess(choice) < expected.excess(&REMARKABLE)) {
        Some(choice) => {
            format!("auto would take {}, with {}", choice.rung, errors(scene, &choice.expected))
        }
        None => "no method does better at this tick; a shorter one may".to_owned(),
    };
    let method = solver.method.name();
    Some(format!("{method} is expected to err by {}; {advice}", errors(scene, &expected)))
}

/// Returns the errors in words, e.g. `4.0e-4 of L, 0.2 % of the torque's peak`.
fn errors(scene: &SceneFile, expected: &Assessment) -> String {
    let effort = axis_units::of(scene.arm.mount.axis).effort;
    format!("{:.1e} of L, {:.2} % of the {effort}'s peak", expected.tip, 100.0 * expected.torque)
}
