//! `compare` on the tables of a mechanism.

use std::path::Path;
use std::process::ExitCode;

use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::{self, MechanismScene, table};
use stillbeam_sim::println;

/// Compares two tables of a mechanism's runs. Exits with 1 where the largest error of a place is
/// above `tolerance`, a fraction of the total length.
pub fn compare(
    scene: &MechanismScene,
    [a, b]: [&Path; 2],
    tolerance: Option<f64>,
) -> Result<ExitCode, Error> {
    let count = scene.mechanism.links.len();
    let result =
        mechanism::compare::compare(&table::read(a, count)?, &table::read(b, count)?, scene)?;
    let mm = 1e3 * result.length;
    println!("{} common times, places of {count} ends", result.common);
    println!(
        "  place error, max  {:.7} of the total length  {:.4} mm  end {} at {:.3} s",
        result.place,
        result.place * mm,
        result.place_of,
        result.place_at
    );
    println!(
        "  place error, rms  {:.7} of the total length  {:.4} mm",
        result.place_rms,
        result.place_rms * mm
    );
    println!(
        "  torque error      {:.4} % of its peak, joint {}, away from jumps",
        100.0 * result.torque,
        result.torque_of
    );
    let Some(tolerance) = tolerance.filter(|tolerance| result.place > *tolerance) else {
        return Ok(ExitCode::SUCCESS);
    };
    println!("  above the tolerance of {tolerance} of the total length");
    Ok(ExitCode::FAILURE)
}
