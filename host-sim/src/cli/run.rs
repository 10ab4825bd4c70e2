//! `run`: runs the core on a scene.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam::select::Choice;
use stillbeam_sim::compare::residual;
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism;
use stillbeam_sim::solver::{Method, SolverKeys};
use stillbeam_sim::table::Row;
use stillbeam_sim::{advice, axis_units, println, run, table};

use super::mechanism::Outputs;
use super::motion::MotionArgs;

#[derive(clap::Args)]
pub struct RunArgs {
    /// Scene file, or the name of an embedded scene
    scene: String,
    /// File for the setpoints
    #[arg(long, value_name = "OUT.csv")]
    csv: PathBuf,
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
}

impl RunArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        if let Some(scene) = mechanism::scenes::open(&self.scene)? {
            super::mechanism::refuse("--motion", self.motion.is_given())?;
            let spin = self.no_spin.then_some(false);
            let keys = SolverKeys { spin, ..self.solver };
            let keys = super::mechanism::typed(&keys, self.coordinates)?;
            let outputs = Outputs { csv: &self.csv, page: self.page.as_deref() };
            return super::mechanism::run(&scene, keys, &outputs);
        }
        super::mechanism::refuse_for_arm("--page", self.page.is_some())?;
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
        table::write(&self.csv, scene.arm.mount.axis, &rows)?;
        let units = axis_units::of(scene.arm.mount.axis);
        let peak = |of: fn(&Row) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        println!("{}: {}", scene.name, solver.describe());
        if let Some(Choice { rung, expected, .. }) = choice {
            println!(
                "  chose            {rung} (expected error {})",
                advice::errors(&scene, &expected)
            );
        }
        println!("  {} setpoints to {}", rows.len(), self.csv.display());
        println!(
            "  peak {:<10}  {:.4} {}",
            units.effort,
            peak(|row| row.torque_nm.abs()),
            units.effort_unit
        );
        println!(
            "  peak deflection  {:.2} mm ({:.1} % of L)",
            1e3 * peak(|row| row.deflection_m.abs()),
            100.0 * peak(|row| row.deflection_m.abs()) / scene.arm.link.length
        );
        let bent = peak(|row| row.deflection_m.abs()) / scene.arm.link.length;
        if bent > 0.3 && matches!(solver.method, Method::Newmark | Method::Modal) {
            println!("  note: small-deflection kinematics; beyond 30 % of L they are a guess");
        }
        if let Some(residual) = residual(&rows, &scene, solver.tick)?.value() {
            println!(
                "  residual         {:.2} mm ({:.2} % of L) in a first period after arrival",
                1e3 * residual * scene.arm.link.length,
                100.0 * residual
            );
        }
        Ok(ExitCode::SUCCESS)
    }
}
