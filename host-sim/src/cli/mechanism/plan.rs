//! `plan` on a mechanism.

use std::path::{Path, PathBuf};

use stillbeam::Limits;
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::plan::{Planned, Request};
use stillbeam_sim::mechanism::{MechanismScene, page, table};
use stillbeam_sim::output::Files;
use stillbeam_sim::println;

/// Plans a move of all joints that arrives still. Writes its page and the reference rod's rows.
pub fn plan(
    scene: &MechanismScene,
    from: Option<Vec<f64>>,
    to: Vec<f64>,
    duration: Option<f64>,
    limits: Vec<Limits>,
    out: &Path,
) -> Result<PathBuf, Error> {
    let joints = &scene.mechanism.joints;
    let from = from.unwrap_or_else(|| joints.iter().map(|joint| joint.angle).collect());
    let request = Request { scene, from, to, duration, limits };
    let planned = request.carry_out()?;
    let rows = &planned.still.rows;
    let mut files = Files::default();
    table::add(&mut files, &out.join("plan.csv"), rows)?;
    let path = out.join("index.html");
    let text = page::render(scene, "A move that arrives still: reference rod", rows, "plan.csv")?;
    files.add(&path, |file| file.write_all(text.as_bytes()))?;
    files.finish()?;
    print(&request, &planned);
    println!("  {}", path.display());
    Ok(path)
}

fn print(request: &Request<'_>, planned: &Planned) {
    let Planned { duration, first_period, flights, still, quintic, .. } = planned;
    println!("{}: {:?} to {:?} rad, still", request.scene.name, request.from, request.to);
    println!("  duration           {duration:.4} s ({:.2} first periods)", duration / first_period);
    for j in 0..request.to.len() {
        let peak = still.rows.iter().map(|row| row.torques[j].abs()).fold(0.0, f64::max);
        println!("  peak torque {}      {peak:.4} N m in the reference rod", j + 1);
    }
    println!(
        "  residual           {:.4} % of the total length in the reference rod",
        100.0 * still.residual
    );
    println!("  quintics           {:.4} % in the same time", 100.0 * quintic.residual);
    println!("  planned in         {flights} simulations of the move");
}
