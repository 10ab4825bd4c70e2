//! `run`: the core on a scene.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::compare::residual;
use stillbeam_sim::error::Error;
use stillbeam_sim::solver::{Method, SolverKeys};
use stillbeam_sim::table::Row;
use stillbeam_sim::{model_choice, progress, run, scenes, table};

#[derive(clap::Args)]
pub struct RunArgs {
    /// Scene file, or the name of an embedded scene
    scene: String,
    /// Where the setpoints go
    #[arg(long, value_name = "OUT.csv")]
    csv: PathBuf,
    #[command(flatten)]
    solver: SolverKeys,
    /// Leave out centrifugal stiffening and softening
    #[arg(long)]
    no_spin: bool,
}

impl RunArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let scene = scenes::open(&self.scene)?;
        let typed = SolverKeys { spin: self.no_spin.then_some(false), ..self.solver };
        let solver = typed.or(scene.solver).resolve()?;
        // What is typed is meant. A file may hold keys for another method than the one that is typed.
        if let Some(line) = typed.unread(solver.method).into_iter().next() {
            return Err(Error::new(line));
        }
        // Printed once the run is accepted: a refusal is one line.
        let mut notes = Vec::new();
        if typed.method.is_none() {
            notes.extend(scene.solver.unread(solver.method));
        }
        notes.extend(scene.roundings(solver.tick)?);
        let late = progress::late("limits, by the rod");
        let rows = run::run_with(&scene, &solver, &|done| late.set(done));
        late.clear();
        let rows = rows?;
        for line in notes {
            eprintln!("note: {line}");
        }
        table::write(&self.csv, &rows)?;
        let peak = |of: fn(&Row) -> f64| rows.iter().map(of).fold(0.0, f64::max);
        println!("{}: {}", scene.name, solver.describe());
        if solver.method == Method::Auto {
            let (_, choice) = model_choice::auto::<f32>(&scene, &solver)?;
            println!(
                "  chose            {} (expected error {:.1e} of L)",
                choice.rung, choice.error
            );
        }
        println!("  {} setpoints to {}", rows.len(), self.csv.display());
        println!("  peak torque      {:.4} N m", peak(|row| row.torque_nm.abs()));
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
