//! Runs the core on a scene: the same generator as on the target, in f32 or f64.

use std::collections::HashSet;

use stillbeam::motion::{Hub as HubState, Segment, Shaped, Shaper};
use stillbeam::stepper::{Choice, Response, Stepper};
use stillbeam::{Error as CoreError, Generator, Move, Scalar as Real, Setpoint};

use crate::error::Error;
use crate::model_choice::{StepperVisitor, with_chosen, with_stepper};
use crate::scene_file::SceneFile;
use crate::solver::Solver;
use crate::table::Row;

/// Segments that can wait in the desktop's generator: two of the longest moves.
pub const QUEUE: usize = 14;

/// Runs a scene from its beginning to the end of the last rest: a row every tick, from t = 0.
///
/// At the end of a move the row holds the left-hand acceleration and torque.
pub fn run(scene: &SceneFile, solver: &Solver) -> Result<Vec<Row>, Error> {
    admitted(scene, with_stepper(scene, solver, Rows { scene })?)
}

/// [`run`] where it is known what `auto` has chosen, if that is the method.
pub fn run_chosen(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
) -> Result<Vec<Row>, Error> {
    admitted(scene, with_chosen(scene, solver, choice, Rows { scene })?)
}

/// The rows if their torque keeps the scene's limit.
fn admitted(scene: &SceneFile, rows: Vec<Row>) -> Result<Vec<Row>, Error> {
    let torque = rows.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max);
    scene.limits.admit_torque(torque)?;
    Ok(rows)
}

struct Rows<'a> {
    scene: &'a SceneFile,
}

impl StepperVisitor for Rows<'_> {
    type Output = Vec<Row>;

    fn visit<S: Stepper + Clone>(self, stepper: S) -> Result<Vec<Row>, Error> {
        drive(stepper, self.scene)
    }
}

/// Ticks a stepper through a scene: a row every tick.
pub fn drive<S: Stepper>(stepper: S, scene: &SceneFile) -> Result<Vec<Row>, Error> {
    if let Some(shaper) = &scene.shaper {
        return drive_shaped(&stepper, scene, shaper);
    }
    let tick = stepper.tick();
    let mut rows = Vec::new();
    each_tick(stepper, scene, |generator, k, ends| {
        let setpoint = generator.tick();
        let shown = if ends { generator.setpoint_before() } else { setpoint };
        rows.push(row(k as f64 * tick, &shown));
    })?;
    Ok(rows)
}

/// [`drive`] along a motion that has passed a shaper, which no generator's queue holds.
fn drive_shaped<S: Stepper>(
    stepper: &S,
    scene: &SceneFile,
    shaper: &Shaper,
) -> Result<Vec<Row>, Error> {
    let tick = stepper.tick();
    let trajectory = scene.trajectory(tick)?;
    // As on the target: what the tick evaluates is of its own precision.
    let plans = trajectory.plans().iter();
    let segments: Vec<_> =
        plans.flat_map(|plan| plan.segments.iter().map(Segment::cast::<S::Scalar>)).collect();
    let motion = Shaped::new(&segments, shaper, tick);
    let ends: HashSet<u32> = trajectory.arrivals().map(|end| (end / tick).round() as u32).collect();
    let mut state = stepper.equilibrium(&motion.hub(0));
    let mut rows = Vec::new();
    for k in 0..=motion.ticks() {
        if k > 0 {
            motion.advance(stepper, &mut state, k - 1);
        }
        let hub = if ends.contains(&k) { motion.arrival(k) } else { motion.hub(k) };
        let Response { torque, tip } = stepper.response(&state, &hub);
        let HubState { angle, rate, acceleration, .. } = hub;
        let setpoint = Setpoint { angle, rate, acceleration, torque, tip };
        rows.push(row(f64::from(k) * tick, &setpoint));
    }
    Ok(rows)
}

/// Feeds the moves to a generator as its queue takes them, and has `each` tick it through all of
/// them: `each(generator, k, ends)` calls [`Generator::tick`] once, for tick `k`, at which a move
/// ends if `ends`.
pub fn each_tick<S: Stepper>(
    stepper: S,
    scene: &SceneFile,
    mut each: impl FnMut(&mut Generator<S, QUEUE>, u64, bool),
) -> Result<(), Error> {
    if scene.shaper.is_some() {
        return Err(Error::new(
            "shaper: a generator has none; use run, reference, compare or sweep",
        ));
    }
    let mut generator = Generator::<S, QUEUE>::new(stepper, scene.from)?;
    generator.limit(scene.limits.kinematic())?;
    let motions = scene.motions();
    let mut waiting = motions.iter().peekable();
    let mut ends = Vec::new();
    let mut total = 0;
    for k in 0.. {
        while let Some(&&motion) = waiting.peek() {
            match generator.push(&motion) {
                Ok(plan) => {
                    total += u64::from(plan.ticks);
                    if !matches!(motion, Move::Dwell { .. }) {
                        ends.push(total);
                    }
                    waiting.next();
                }
                Err(CoreError::QueueFull { .. }) => break,
                Err(error) => return Err(error.into()),
            }
        }
        each(&mut generator, k, ends.contains(&k));
        if k == total {
            break;
        }
    }
    Ok(())
}

/// A setpoint in the units of the table.
pub fn row<T: Real>(t: f64, setpoint: &Setpoint<T>) -> Row {
    let [x, y] = setpoint.global_tip();
    Row {
        t_s: t,
        hub_angle_rad: setpoint.angle.radians(),
        hub_rate_rad_s: setpoint.rate.to_f64(),
        hub_accel_rad_s2: setpoint.acceleration.to_f64(),
        tip_x_m: x.to_f64(),
        tip_y_m: y.to_f64(),
        deflection_m: setpoint.deflection().to_f64(),
        torque_nm: setpoint.torque.to_f64(),
    }
}
