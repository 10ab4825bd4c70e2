//! `plan` on a mechanism.

use std::path::{Path, PathBuf};

use stillbeam::Limits;
use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::plan::Request;
use stillbeam_sim::mechanism::{MechanismScene, page, table};
use stillbeam_sim::output::Files;

use super::outputs::draw;
use super::report::PlanReport;

/// Plans a move of all joints that arrives still. Writes its page and the reference rod's rows.
pub fn plan(
    scene: &MechanismScene,
    from: Option<Vec<f64>>,
    to: Vec<f64>,
    duration: Option<f64>,
    limits: Vec<Limits>,
    out: &Path,
    json: bool,
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
    let report = PlanReport::of(&request, &planned, &path);
    if json {
        crate::cli::print_json(&report)?;
    } else {
        report.print();
        draw(rows);
    }
    Ok(path)
}
