//! Differences of two runs of one mechanism. The whole project uses these definitions.

use super::table::Row;
use super::{Drives, MechanismScene, closes_at};
use crate::error::Error;

/// Differences of a run `a` from a run `b`; `b` is the more accurate one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// Number of times that both runs have.
    pub common: usize,
    /// Largest distance of any joint or of the tip, fraction of the total length.
    pub place: f64,
    /// Its time, s.
    pub place_at: f64,
    /// End of the link, counted from 1, whose place it is.
    pub place_of: usize,
    /// Root mean square distance over all ends and times, fraction of the total length.
    pub place_rms: f64,
    /// Largest torque difference of any joint, fraction of that joint's own largest torque in `b`.
    /// Rows less than one and a half row intervals from a jump are left out.
    pub torque: f64,
    /// The joint, counted from 1, whose torque it is.
    pub torque_of: usize,
    /// Total length, m.
    pub length: f64,
}

/// Compares two runs at the times that both have.
pub fn compare(a: &[Row], b: &[Row], scene: &MechanismScene) -> Result<Comparison, Error> {
    let drives = scene.drives(scene.solver()?.tick)?;
    let pairs = common(a, b);
    if pairs.is_empty() {
        return Err(Error::new(
            "no common times; the tables must be of two runs of the same scene",
        ));
    }
    let length = scene.mechanism.total_length();
    let (mut place, mut place_at, mut place_of) = (0.0, 0.0, 1);
    let (mut squares, mut count) = (0.0, 0.0);
    for (a, b) in &pairs {
        for (j, (one, other)) in a.ends.iter().zip(&b.ends).enumerate() {
            let distance = (one[0] - other[0]).hypot(one[1] - other[1]) / length;
            squares += distance * distance;
            count += 1.0;
            if distance > place {
                (place, place_at, place_of) = (distance, b.t, j + 1);
            }
        }
    }
    let beside = 1.5 * interval(a).max(interval(b));
    let jumps = jumps(scene, &drives);
    let away = |t: f64| jumps.iter().all(|jump| (t - jump).abs() > beside);
    let peaks = peaks(b);
    let (mut torque, mut torque_of) = (0.0, 1);
    for (a, b) in pairs.iter().filter(|(_, b)| away(b.t)) {
        for (j, (one, other)) in a.torques.iter().zip(&b.torques).enumerate() {
            let difference = (one - other).abs() / peaks[j];
            if difference > torque {
                (torque, torque_of) = (difference, j + 1);
            }
        }
    }
    Ok(Comparison {
        common: pairs.len(),
        place,
        place_at,
        place_of,
        place_rms: f64::sqrt(squares / count),
        torque,
        torque_of,
        length,
    })
}

/// Returns the largest torque of each joint, N m. A joint without any, or with less than a
/// thousandth of the largest of all, counts with that thousandth: of a passive joint there is
/// nothing to tell.
fn peaks(rows: &[Row]) -> Vec<f64> {
    let count = rows.first().map_or(0, |row| row.torques.len());
    let peak = |j: usize| rows.iter().map(|row| row.torques[j].abs()).fold(0.0, f64::max);
    let peaks: Vec<f64> = (0..count).map(peak).collect();
    let least = 1e-3 * peaks.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    peaks.into_iter().map(|peak| peak.max(least)).collect()
}

/// Returns the times at which a run's torques jump, s: at jumps of a commanded acceleration, and
/// when the chain closes.
pub fn jumps(scene: &MechanismScene, drives: &Drives) -> Vec<f64> {
    drives.jumps().into_iter().chain(closes_at(&scene.mechanism)).collect()
}

/// Returns the pairs of rows that have the same time, to a microsecond.
fn common<'a>(a: &'a [Row], b: &'a [Row]) -> Vec<(&'a Row, &'a Row)> {
    let near = |row: &'a Row| {
        let at = b.partition_point(|other| other.t < row.t - 1e-6);
        b.get(at).filter(|other| (other.t - row.t).abs() <= 1e-6).map(|other| (row, other))
    };
    a.iter().filter_map(near).collect()
}

/// Returns the longest interval between rows, s.
fn interval(rows: &[Row]) -> f64 {
    rows.windows(2).map(|pair| pair[1].t - pair[0].t).fold(0.0, f64::max)
}
