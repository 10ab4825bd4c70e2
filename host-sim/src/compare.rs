//! Differences of two runs of one scene. The whole project uses these definitions.

use crate::error::Error;
use crate::reference::rod;
use crate::scene_file::SceneFile;
use crate::table::Row;
use crate::trajectory::{Side, Trajectory};

/// Differences of a run `a` from a run `b`; `b` is the more accurate one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Number of times that both runs have.
    pub common: usize,
    /// Largest distance of the tips, fraction of L.
    pub tip_max: f64,
    /// Root mean square distance of the tips, fraction of L.
    pub tip_rms: f64,
    /// Time of the largest distance, s.
    pub tip_max_at: f64,
    /// Largest torque difference away from the jumps of the commanded acceleration, fraction of
    /// `b`'s peak torque. Rows less than one and a half row intervals from a jump are left out.
    pub torque: f64,
    /// [`residual`] of `a` and of `b`.
    pub residual: [Residual; 2],
    /// L, m.
    pub length: f64,
}

/// Compares two runs at the times that both have.
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
        residual: [residual_of_table(a, scene, tick)?, residual_of_table(b, scene, tick)?],
        length,
    })
}

/// Residual vibration that a run's table shows, or the reason why it shows none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Residual {
    /// The residual, fraction of L.
    Of(f64),
    /// The hub does not end at rest.
    Turning,
    /// The table ends before a first period after the last arrival has passed.
    Cut {
        /// Last time of the table, s.
        ends: f64,
        /// Time that the table should reach, s.
        needed: f64,
    },
}

impl Residual {
    /// Returns the residual, fraction of L, if there is one.
    pub fn value(self) -> Option<f64> {
        if let Self::Of(value) = self { Some(value) } else { None }
    }
}

/// Returns the residual vibration. It is the largest deflection of the tip from its rest, the
/// static equilibrium at the final angle, over a first period after the last arrival. See
/// [`crate::residual`].
///
/// `rows` stand at intervals of `tick` s, the setpoint interval of the run.
pub fn residual(rows: &[Row], scene: &SceneFile, tick: f64) -> Result<Residual, Error> {
    residual_along(rows, scene, &scene.trajectory(tick)?)
}

fn residual_along(
    rows: &[Row],
    scene: &SceneFile,
    trajectory: &Trajectory,
) -> Result<Residual, Error> {
    let turning = trajectory.plans().last().is_none_or(|plan| plan.summary.end.rate != 0.0);
    let Some(end) = trajectory.arrivals().last().filter(|_| !turning) else {
        return Ok(Residual::Turning);
    };
    let length = scene.arm.link.length;
    let still = rod::rest_deflection(&scene.arm, trajectory.at(end, Side::Right).angle)?;
    let interval = interval(rows);
    let span = crate::residual::span(&scene.arm, trajectory.tick())?;
    let (ends, needed) = (rows.last().map_or(0.0, |row| row.t_s), end + span);
    if ends < needed - interval.max(trajectory.tick()) {
        return Ok(Residual::Cut { ends, needed });
    }
    let samples: Vec<(f64, f64)> =
        rows.iter().map(|row| (row.t_s, (row.deflection_m - still) / length)).collect();
    Ok(Residual::Of(crate::residual::largest(&samples, end, span)))
}

/// Returns the [`residual`] of a table whose run may have had another tick than the scene says.
/// Takes the interval of the rows as the tick. The later arrival counts: at both the hub is at
/// rest.
fn residual_of_table(rows: &[Row], scene: &SceneFile, tick: f64) -> Result<Residual, Error> {
    let by_scene = scene.trajectory(tick)?;
    let rounded = (interval(rows) * 1e9).round() * 1e-9;
    let last = |trajectory: &Trajectory| trajectory.arrivals().last();
    let other = (1e-6..=1.0).contains(&rounded).then(|| scene.trajectory(rounded));
    match other {
        Some(Ok(other)) if last(&other) > last(&by_scene) => residual_along(rows, scene, &other),
        _ => residual_along(rows, scene, &by_scene),
    }
}

/// Returns the times at which the commanded acceleration jumps, the beginning of the run included.
pub fn jumps(trajectory: &Trajectory) -> Vec<f64> {
    let largest =
        trajectory.plans().iter().map(|plan| plan.summary.peaks.acceleration).fold(0.0, f64::max);
    let jumps_at = |t: f64| {
        let (left, right) = (trajectory.at(t, Side::Left), trajectory.at(t, Side::Right));
        (left.acceleration - right.acceleration).abs() > 1e-6 * largest
    };
    let first = (trajectory.at(0.0, Side::Right).acceleration != 0.0).then_some(0.0);
    first.into_iter().chain(trajectory.breaks().into_iter().filter(|&t| jumps_at(t))).collect()
}

/// Returns the pairs of rows that have the same time, to a microsecond.
pub fn common<'a>(a: &'a [Row], b: &'a [Row]) -> Vec<(&'a Row, &'a Row)> {
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

/// Returns the longest interval between rows, s.
fn interval(rows: &[Row]) -> f64 {
    rows.windows(2).map(|pair| pair[1].t_s - pair[0].t_s).fold(0.0, f64::max)
}
