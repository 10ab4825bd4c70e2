//! `compare`: compares two runs of a scene.

use std::path::PathBuf;
use std::process::ExitCode;

use stillbeam::AxisKind;
use stillbeam_sim::compare::{Comparison, Residual, compare};
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism;
use stillbeam_sim::{axis_units, println, table};

use super::motion::MotionArgs;
use super::tick::TickArgs;

#[derive(clap::Args)]
pub struct CompareArgs {
    /// The run to judge
    a: PathBuf,
    /// The run to judge it by
    b: PathBuf,
    /// Scene file, or the name of an embedded scene, of both
    #[arg(long)]
    scene: String,
    #[command(flatten)]
    motion: MotionArgs,
    #[command(flatten)]
    tick: TickArgs,
    /// Exit with 1 where the largest tip error is above this fraction of L
    #[arg(long, value_name = "FRACTION", allow_negative_numbers = true)]
    tolerance: Option<f64>,
}

impl CompareArgs {
    pub fn execute(self) -> Result<ExitCode, Error> {
        if let Some(tolerance) = self.tolerance
            && !(0.0..=10.0).contains(&tolerance)
        {
            return Err(Error::new(format_args!(
                "--tolerance = {tolerance}: must be 0 to 10, a fraction of L"
            )));
        }
        if let Some(scene) = mechanism::scenes::open(&self.scene)? {
            super::mechanism::refuse("--motion", self.motion.is_given())?;
            let scene = self.tick.applied_to_mechanism(scene);
            return super::mechanism::compare(&scene, [&self.a, &self.b], self.tolerance);
        }
        let scene = self.tick.applied(self.motion.open(&self.scene)?);
        let tick = scene.solver.resolve()?.tick;
        let (scene, _) = self.motion.command(scene, tick)?;
        let (a, b) = (table::read(&self.a)?, table::read(&self.b)?);
        let result = compare(&a, &b, &scene)?;
        print(scene.arm.mount.axis, &result);
        let refused = self.tolerance.is_some_and(|tolerance| result.tip_max > tolerance);
        if let (true, Some(tolerance)) = (refused, self.tolerance) {
            println!("  above the tolerance of {tolerance} L");
        }
        Ok(if refused { ExitCode::FAILURE } else { ExitCode::SUCCESS })
    }
}

fn print(axis: AxisKind, result: &Comparison) {
    let mm = 1e3 * result.length;
    println!("{} common times", result.common);
    println!(
        "  tip error, max   {:.6} L  {:.4} mm  at {:.3} s",
        result.tip_max,
        result.tip_max * mm,
        result.tip_max_at
    );
    println!("  tip error, rms   {:.6} L  {:.4} mm", result.tip_rms, result.tip_rms * mm);
    let error = format!("{} error", axis_units::of(axis).effort);
    println!("  {error:<15}  {:.3} % of the peak, away from jumps", 100.0 * result.torque);
    if result.residual.contains(&Residual::Turning) {
        return;
    }
    let words = result.residual.map(|residual| match residual {
        Residual::Of(left) => format!("{left:.6} L  {:.4} mm", left * mm),
        Residual::Turning => "none".to_owned(),
        Residual::Cut { ends, needed } => format!(
            "unknown (the table ends at {ends:.4} s, must reach {needed:.4} s: a first period after arrival)"
        ),
    });
    println!("  residual         {}  against {}", words[0], words[1]);
}
