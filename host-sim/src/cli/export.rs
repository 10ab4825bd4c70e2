//! `export`: writes a scene's stepper as constants, for a program without set-up.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam_sim::console::open;
use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::solver::SolverKeys;
use stillbeam_sim::{export, println};

#[derive(clap::Args)]
pub struct ExportArgs {
    /// Scene file, or the name of an embedded scene
    scene: String,
    /// File for Rust constants
    #[arg(long, value_name = "OUT.rs", required_unless_present_any = ["c", "bin"])]
    rust: Option<PathBuf>,
    /// File for a C header
    #[arg(long, value_name = "OUT.h")]
    c: Option<PathBuf>,
    /// File for the bare bytes
    #[arg(long, value_name = "OUT")]
    bin: Option<PathBuf>,
    /// Mass of the payload in kg, in place of the scene's; once for each arm of a table
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    payload: Vec<f64>,
    /// Write the planner of still moves too
    #[arg(long)]
    still: bool,
    #[command(flatten)]
    solver: SolverKeys,
}

impl ExportArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        let scene = open(&self.scene)?;
        let solver = self.solver.or(scene.solver).resolve()?;
        if let Some(line) = self.solver.unread(solver.method).into_iter().next() {
            return Err(Error::new(line));
        }
        let arm = export::prepare(&scene, &solver, &self.payload, self.still)?;
        let mut files = Files::default();
        if let Some(path) = &self.rust {
            files.add(path, |file| file.write_all(arm.to_rust().as_bytes()))?;
        }
        if let Some(path) = &self.c {
            files.add(path, |file| file.write_all(arm.to_c().as_bytes()))?;
        }
        if let Some(path) = &self.bin {
            files.add(path, |file| file.write_all(&arm.to_bytes()))?;
        }
        files.finish()?;
        let count = match arm.arms.len() {
            1 => String::new(),
            n => format!("{n} payloads of "),
        };
        println!("{}: {}, {count}{} bytes", arm.name, arm.stepper, arm.bytes_each());
        for path in [&self.rust, &self.c, &self.bin].into_iter().flatten() {
            println!("  to {}", path.display());
        }
        Ok(ExitCode::SUCCESS)
    }
}
