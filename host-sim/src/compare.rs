//! How far two runs of one scene are apart. The same definitions everywhere in the project.

use crate::error::Error;
use crate::reference::rod;
use crate::scene_file::SceneFile;
use crate::table::Row;
use crate::trajectory::{Side, Trajectory};

/// Differences of a run `a` from a run `b`, `b` being the better one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Times that both have.
    pub common: usize,
    /// Largest distance of the tips, fraction of L.
    pub tip_max: f64,
    /// Root mean square distance of the tips, fraction of L.
    pub tip_rms: f64,
    /// Time of the largest distance, s.
    pub tip_max_at: f64,
    /// Largest torque difference away from the jumps of the commanded acceleration, fraction of
    /// `b`'s peak torque; rows less than one and a half row intervals from a jump are left out.
    pub torque: f64,
    /// [`residual`] of `a` and of `b`, fraction of L; none where the run does not end at rest.
    pub residual: Option<(f64, f64)>,
    /// L, m.
    pub length: f64,
}

/// Compares at the times that both runs have.
pub fn compare(a: &[Row], b: &[Row], scene: &SceneFile) -> Result<Comparison, Error> {
    let tick = scene.solver.resolve()?.tick;
    let trajectory = scene.trajectory(tick)?;
    let pairs = common(a, b);
    if pairs.is_empty() {
        return Err(Error::new(
            "no common times; the tables must be of two runs of the same scene",
        ));
    }
    let length = scene.arm.link.length;
    let (mut tip_max, mut tip_max_at, mut squares) = (0.0, 0.0, 0.0);
    for (a, b) in &pairs {
        let distance = (a.tip_x_m - b.tip_x_m).hypot(a.tip_y_m - b.tip_y_m) / length;
        squares += distance * distance;
        if distance > tip_max {
            (tip_max, tip_max_at) = (distance, b.t_s);
        }
    }
    let beside = 1.5 * interval(a).max(interval(b));
    let jumps = jumps(&trajectory);
    let away = |t: f64| jumps.iter().all(|jump| (t - jump).abs() > beside);
    let peak = b.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max);
    let torque = pairs
        .iter()
        .filter(|(_, b)| away(b.t_s))
        .map(|(a, b)| (a.torque_nm - b.torque_nm).abs())
        .fold(0.0, f64::max);
    Ok(Comparison {
        common: pairs.len(),
        tip_max,
        tip_rms: (squares / pairs.len() as f64).sqrt(),
        tip_max_at,
        torque: if peak > 0.0 { torque / peak } else { torque },
        residual: residual(a, scene)?.zip(residual(b, scene)?),
        length,
    })
}

/// Residual vibration, fraction of L: the largest |deflection − static equilibrium at the final
/// angle| from the end of the last move on. None where the hub does not end at rest.
pub fn residual(rows: &[Row], scene: &SceneFile) -> Result<Option<f64>, Error> {
    let trajectory = scene.trajectory(scene.solver.resolve()?.tick)?;
    let last = trajectory.plans().last();
    if last.is_none_or(|plan| plan.outline.end.rate != 0.0) {
        return Ok(None);
    }
    let end = trajectory.arrivals().last().unwrap_or(0.0);
    let still = rod::rest_deflection(&scene.arm, trajectory.at(end, Side::Right).angle)?;
    let length = scene.arm.link.length;
    let largest = rows
        .iter()
        .filter(|row| row.t_s >= end - 1e-9)
        .map(|row| (row.deflection_m - still).abs() / length)
        .fold(None, |most: Option<f64>, x| Some(most.map_or(x, |most| most.max(x))));
    Ok(largest)
}

/// Times at which the commanded acceleration jumps, the beginning of the run included.
pub(crate) fn jumps(trajectory: &Trajectory) -> Vec<f64> {
    let largest =
        trajectory.plans().iter().map(|plan| plan.outline.peaks.acceleration).fold(0.0, f64::max);
    let jumps_at = |t: f64| {
        let (left, right) = (trajectory.at(t, Side::Left), trajectory.at(t, Side::Right));
        (left.acceleration - right.acceleration).abs() > 1e-6 * largest
    };
    let first = (trajectory.at(0.0, Side::Right).acceleration != 0.0).then_some(0.0);
    first.into_iter().chain(trajectory.breaks().into_iter().filter(|&t| jumps_at(t))).collect()
}

/// Rows of both at the same times, to a microsecond.
pub(crate) fn common<'a>(a: &'a [Row], b: &'a [Row]) -> Vec<(&'a Row, &'a Row)> {
    let mut pairs = Vec::new();
    let mut rest = b;
    for row in a {
        let skip = rest.partition_point(|other| other.t_s < row.t_s - 1e-6);
        rest = &rest[skip..];
        if let Some(other) = rest.first().filter(|other| (other.t_s - row.t_s).abs() <= 1e-6) {
            pairs.push((row, other));
        }
    }
    pairs
}

/// Longest interval between rows, s.
fn interval(rows: &[Row]) -> f64 {
    rows.windows(2).map(|pair| pair[1].t_s - pair[0].t_s).fold(0.0, f64::max)
}
