//! `run`: runs the core on a scene.

use std::path::PathBuf;
use std::process::ExitCode;

use serde::Serialize;
use stillbeam::select::Choice;
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver, SolverKeys};
use stillbeam_sim::table::Row;
use stillbeam_sim::{advice, println, run, table};

use super::mechanism::Outputs;
use super::motion::MotionArgs;
use super::rows::{self, Figures};

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
    /// Curvature coordinates a flexible link, 2 or 3, of a mechanism [default: 2]
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    coordinates: Option<i64>,
    /// File for a page with the mechanism drawn, of a mechanism
    #[arg(long, value_name = "OUT.html")]
    page: Option<PathBuf>,
    /// Show the page in the browser, of a mechanism
    #[arg(long)]
    open: bool,
}

impl RunArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        if let Some(scene) = mechanism::scenes::open(&self.scene)? {
            super::mechanism::refuse("--motion", self.motion.is_given())?;
            let spin = self.no_spin.then_some(false);
            let keys = SolverKeys { spin, ..self.solver };
            let keys = super::mechanism::typed(&keys, self.coordinates)?;
            let outputs = Outputs::new(&self.csv, &self.page, self.open, self.json)?;
            return super::mechanism::run(&scene, keys, &outputs);
        }
        super::mechanism::refuse_for_arm("--page", self.page.is_some())?;
        super::mechanism::refuse_for_arm("--open", self.open)?;
        super::mechanism::refuse_for_arm("--coordinates", self.coordinates.is_some())?;
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
            Method::Auto => Some(advice::chosen(&scene, &solver, &keys, &|_| (), &mut notes)?),
            _ => None,
        };
        let rows = super::with_limits_shown(|progress| {
            run::run_with(&scene, &solver, choice.as_ref(), progress)
        })?;
        if choice.is_none() {
            notes.extend(advice::remark(&scene, &solver));
        }
        for line in notes {
            super::note(&line);
        }
        if let Some(csv) = &self.csv {
            table::write(csv, scene.arm.mount.axis, &rows)?;
        }
        let report = RunReport::of(&scene, &solver, choice.as_ref(), &rows)?;
        if self.json {
            super::print_json(&report)?;
        } else {
            self.print(&scene, &solver, choice.as_ref(), &report);
            rows::draw(&scene, &rows);
        }
        Ok(ExitCode::SUCCESS)
    }

    fn print(&self, scene: &SceneFile, solver: &Solver, choice: Option<&Choice>, run: &RunReport) {
        println!("{}: {}", scene.name, solver.describe());
        if let Some(Choice { rung, expected, .. }) = choice {
            println!(
                "  chose            {rung} (expected error {})",
                advice::errors(scene, expected)
            );
        }
        super::print_written(run.setpoints, "setpoints", self.csv.as_deref());
        run.figures.print_peaks(scene);
        let bent = run.figures.peak_deflection_m / scene.arm.link.length;
        if bent > 0.3 && matches!(solver.method, Method::Newmark | Method::Modal) {
            println!("  note: small-deflection kinematics; beyond 30 % of L they are a guess");
        }
        run.figures.print_residual(scene);
    }
}

/// Figures of a run, for programs.
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
    #[serde(flatten)]
    figures: Figures,
}

impl RunReport {
    fn of(
        scene: &SceneFile,
        solver: &Solver,
        choice: Option<&Choice>,
        rows: &[Row],
    ) -> Result<Self, Error> {
        Ok(Self {
            scene: scene.name.clone(),
            solver: solver.describe(),
            chosen: choice.map(|choice| choice.rung.to_string()),
            setpoints: rows.len(),
            tick_s: solver.tick,
            figures: Figures::of(scene, solver.tick, rows)?,
        })
    }
}
