//! Runs the core on a mechanism: the same generator as on the target, in f32 or f64.

use stillbeam::chain::{Chain, ChainGenerator, ChainSetpoint};
use stillbeam::{Limits, Move, Scalar as Real};

use super::limits::of_joint;
use super::table::Row;
use super::{JointDrive, MechanismScene, MechanismSolver};
use crate::error::Error;
use crate::solver::Scalar;

/// Capacity of the desktop's queue of a joint, segments.
const QUEUE: usize = 256;

/// Runs a mechanism: a row every tick, from t = 0 to the end of the run.
///
/// At a jump of a commanded acceleration, and when the chain closes, the row holds the values from
/// before.
///
/// # Errors
/// A number of links that the core has no type for, a move that it refuses, a loop that is to leave
/// its pin, and a tick that is too long for what the chain does.
/// A torque above its joint's limit.
pub fn run(scene: &MechanismScene, solver: &MechanismSolver) -> Result<Vec<Row>, Error> {
    // Overlapping moves are refused with their names, which the core does not know.
    scene.drives(solver.tick)?;
    match solver.scalar {
        Scalar::F32 => run_in::<f32>(scene, solver),
        Scalar::F64 => run_in::<f64>(scene, solver),
    }
}

fn run_in<T: Real>(scene: &MechanismScene, solver: &MechanismSolver) -> Result<Vec<Row>, Error> {
    let tick = solver.tick;
    match (scene.mechanism.links.len(), solver.coordinates) {
        (1, 2) => tick_through::<T, 1, 3, 3, 3>(scene, tick),
        (1, _) => tick_through::<T, 1, 4, 4, 5>(scene, tick),
        (2, 2) => tick_through::<T, 2, 3, 6, 3>(scene, tick),
        (2, _) => tick_through::<T, 2, 4, 8, 5>(scene, tick),
        (3, 2) => tick_through::<T, 3, 3, 9, 3>(scene, tick),
        (3, _) => tick_through::<T, 3, 4, 12, 5>(scene, tick),
        (count, _) => Err(Error::new(format_args!(
            "links = {count}: must be 1 to 3 to be run by the core; reference takes more"
        ))),
    }
}

/// Ticks the scene's chain to the end of the run.
fn tick_through<T, const LINKS: usize, const W: usize, const C: usize, const Q: usize>(
    scene: &MechanismScene,
    tick: f64,
) -> Result<Vec<Row>, Error>
where
    T: Real,
{
    let chain = Chain::<T, LINKS, W, C, Q>::new(&scene.mechanism, tick)?;
    let from = std::array::from_fn(|joint| scene.mechanism.joints[joint].angle);
    let mut generator = ChainGenerator::<T, LINKS, W, C, Q, QUEUE>::new(chain, from)?;
    for (joint, limits) in scene.limits.iter().enumerate() {
        if limits.kinematic() != Limits::default() {
            generator.limit(joint, limits.kinematic())?;
        }
    }
    let mut ends = [0; LINKS];
    for (index, drive) in in_order(&scene.drives) {
        let JointDrive { joint, start, motion } = drive;
        let place = |error: stillbeam::Error| Error::new(error).within(format!("moves[{index}]"));
        let start = (start / tick).round() as u64;
        let rest = start - ends[*joint];
        if rest > 0 {
            let duration = rest as f64 * tick;
            generator.push(*joint, &Move::Dwell { duration }).map_err(place)?;
        }
        let Some(motion) = motion.as_move() else { continue };
        let summary = generator.push(*joint, &motion).map_err(place)?;
        ends[*joint] = start + u64::from(summary.ticks);
    }
    let ticks = scene.drives(tick)?.ticks();
    // A run has no more ticks than a u32 counts.
    let rehearsal = generator.rehearse(u32::try_from(ticks + 1).unwrap_or(u32::MAX))?;
    for (joint, (limits, peak)) in scene.limits.iter().zip(rehearsal.torque).enumerate() {
        limits.admit_torque(peak).map_err(|error| of_joint(joint, error))?;
    }
    Ok((0..=ticks).map(|k| row(k as f64 * tick, &generator.tick())).collect())
}

/// Returns the drives with their place in the file, in order of their start.
fn in_order(drives: &[JointDrive]) -> Vec<(usize, &JointDrive)> {
    let mut all: Vec<_> = drives.iter().enumerate().collect();
    all.sort_by(|a, b| a.1.start.total_cmp(&b.1.start));
    all
}

fn row<T: Real, const LINKS: usize>(t: f64, setpoint: &ChainSetpoint<T, LINKS>) -> Row {
    let joints = || setpoint.joints.iter();
    Row {
        t,
        joints: joints().map(|joint| joint.angle.radians()).collect(),
        ends: setpoint.ends.iter().map(|end| end.map(T::to_f64)).collect(),
        deflections: joints().map(|joint| joint.tip[1].to_f64()).collect(),
        torques: joints().map(|joint| joint.torque.to_f64()).collect(),
    }
}
