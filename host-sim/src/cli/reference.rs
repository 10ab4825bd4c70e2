//! `reference`: solves a scene with a reference solver.

use std::path::PathBuf;
use std::process::ExitCode;

use serde::Serialize;
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::{self, MechanismScene};
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::table::Row;
use stillbeam_sim::truth::{self, Reference};
use stillbeam_sim::{println, progress, run, table};

use super::mechanism::Outputs;
use super::motion::MotionArgs;
use super::rows::{self, Figures};
use super::tick::TickArgs;

#[derive(clap::Args)]
pub struct ReferenceArgs {
    /// Scene file, or the name of an embedded scene
    scene: String,
    /// Reference solver
    #[arg(long, value_enum, default_value = "rod")]
    solver: Reference,
    /// File for the rows [default: none is written]
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Print one JSON object, for programs
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    motion: MotionArgs,
    #[command(flatten)]
    tick: TickArgs,
    /// Interval of the rows in s [default: the tick]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    every: Option<f64>,
    /// File for a page with the mechanism drawn, of a mechanism
    #[arg(long, value_name = "OUT.html")]
    page: Option<PathBuf>,
    /// Show the page in the browser, of a mechanism
    #[arg(long)]
    open: bool,
}

impl ReferenceArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        if let Some(scene) = mechanism::scenes::open(&self.scene)? {
            return self.mechanism(scene);
        }
        super::mechanism::refuse_for_arm("--page", self.page.is_some())?;
        super::mechanism::refuse_for_arm("--open", self.open)?;
        let scene = self.tick.applied(self.motion.open(&self.scene)?);
        let tick = scene.solver.resolve()?.tick;
        let (scene, mut notes) = self.motion.command(scene, tick)?;
        notes.extend(scene.deduced.lines());
        notes.extend(scene.roundings(tick)?);
        let trajectory = scene.trajectory(tick)?;
        let every = self.every.unwrap_or(tick);
        if !(1e-6..=trajectory.duration()).contains(&every) {
            return Err(Error::new(format_args!(
                "--every = {every}: must be 0.000001 to {} s, the run's length",
                trajectory.duration()
            )));
        }
        super::with_limits_shown(|progress| run::admit_loads(&scene, tick, &|_| true, progress))?;
        let bar = progress::percent(&scene.name);
        let times = truth::times(&trajectory, every);
        let rows = truth::solve(self.solver, &scene, &trajectory, &times, &|done| {
            bar.set_position((100.0 * done) as u64);
        });
        bar.finish_and_clear();
        let rows = rows?;
        // A refusal is one line.
        for line in notes {
            super::note(&line);
        }
        if let Some(csv) = &self.csv {
            table::write(csv, scene.arm.mount.axis, &rows)?;
        }
        let report = ReferenceReport::of(&scene, self.solver, [tick, every], &rows)?;
        if self.json {
            super::print_json(&report)?;
        } else {
            self.print(&scene, &report);
            rows::draw(&scene, &rows);
        }
        Ok(ExitCode::SUCCESS)
    }

    fn mechanism(&self, scene: MechanismScene) -> Result<ExitCode, Error> {
        super::mechanism::refuse("--motion", self.motion.is_given())?;
        let outputs = Outputs::new(&self.csv, &self.page, self.open, self.json)?;
        let scene = self.tick.applied_to_mechanism(scene);
        super::mechanism::reference(&scene, self.solver, self.every, &outputs)
    }

    fn print(&self, scene: &SceneFile, solved: &ReferenceReport) {
        println!("{}: {}", solved.scene, solved.solver);
        super::print_written(solved.rows, "rows", self.csv.as_deref());
        solved.figures.print_peaks(scene);
        solved.figures.print_residual(scene);
    }
}

/// Figures of a reference solution, for programs.
#[derive(Serialize)]
struct ReferenceReport {
    /// The scene's name or file.
    scene: String,
    /// The solver in words.
    solver: &'static str,
    rows: usize,
    /// Setpoint interval, to which durations are rounded.
    tick_s: f64,
    /// Interval of the rows.
    every_s: f64,
    #[serde(flatten)]
    figures: Figures,
}

impl ReferenceReport {
    fn of(
        scene: &SceneFile,
        solver: Reference,
        [tick_s, every_s]: [f64; 2],
        rows: &[Row],
    ) -> Result<Self, Error> {
        Ok(Self {
            scene: scene.name.clone(),
            solver: solver.describe(),
            rows: rows.len(),
            tick_s,
            every_s,
            figures: Figures::of(scene, tick_s, rows)?,
        })
    }
}
