//! Runs the core on a scene: the same generator as on the target, in f32 or f64.

use std::collections::HashSet;

use stillbeam::motion::{Path, Segment, Shaper, Waypoint};
use stillbeam::select::Choice;
use stillbeam::{AxisKind, Error as CoreError, Move};
use stillbeam_erased::{AnyGenerator, AnySetpoint, AnyStepper, Shaped};

use crate::dispatch;
use crate::error::Error;
use crate::limits::load::Progress;
use crate::limits::{self, Excess, Peak, Quantity, Refusal, Way, remedy};
use crate::scene_file::SceneFile;
use crate::solver::Solver;
use crate::step::{Motion, Step};
use crate::table::Row;

/// Runs a scene from its beginning to the end of the last rest: a row every tick, from t = 0.
///
/// The commanded motion keeps the scene's limits, whatever the method: see [`limits`]. At the end
/// of a move the row holds the left-hand acceleration and torque.
pub fn run(scene: &SceneFile, solver: &Solver) -> Result<Vec<Row>, Error> {
    run_with(scene, solver, None, &|_| ())
}

/// [`run`] with the choice that `auto` has already made, if that is the method. `progress` is
/// called with what the limits' check is at.
pub fn run_with(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
    progress: &dyn Fn(Progress),
) -> Result<Vec<Row>, Error> {
    refused_or_run(scene, solver, choice, progress).map_err(|error| error.on(scene.arm.mount.axis))
}

fn refused_or_run(
    scene: &SceneFile,
    solver: &Solver,
    choice: Option<&Choice>,
    progress: &dyn Fn(Progress),
) -> Result<Vec<Row>, Error> {
    let commanded = |steps: &[Step]| {
        let scene = SceneFile { moves: steps.to_vec(), ..scene.clone() };
        let rows = dispatch::stepper(&scene, solver).and_then(|stepper| drive(&*stepper, &scene));
        rows.is_ok_and(|rows| own_excess(&scene, solver.tick, &rows).is_ok_and(|own| own.is_none()))
    };
    admit_loads(scene, solver.tick, &commanded, progress)?;
    let rows = drive(&*dispatch::stepper_chosen(scene, solver, choice)?, scene)?;
    match own_excess(scene, solver.tick, &rows)? {
        Some(excess) => Err(Refusal { excess, count: scene.moves.len(), way: Way::Method }.into()),
        None => Ok(rows),
    }
}

/// Refuses a scene along whose motion the reference rod exceeds a limit of torque or clamp moment.
/// `commanded` returns true if the method that is to make the setpoints keeps the limits with other
/// moves.
pub fn admit_loads(
    scene: &SceneFile,
    tick: f64,
    commanded: &dyn Fn(&[Step]) -> bool,
    progress: &dyn Fn(Progress),
) -> Result<(), Error> {
    if !limits::load::limited(&scene.limits) {
        return Ok(());
    }
    let case = scene.case(tick);
    let trajectory = scene.trajectory(tick)?;
    let limits = &scene.limits;
    let checked = |done| progress(Progress::Checked(done));
    match limits::load::excess(&case, &trajectory, limits, &checked)? {
        Some(found) => {
            let refusal =
                remedy::of_loads(&case, &trajectory, limits, &found, commanded, progress)?;
            Err(case.placed(&trajectory, refusal))
        }
        None => Ok(()),
    }
}

/// Returns the first move during which the setpoints themselves exceed the limit of torque.
fn own_excess(scene: &SceneFile, tick: f64, rows: &[Row]) -> Result<Option<Excess>, Error> {
    let Some(limit) = scene.limits.torque else { return Ok(None) };
    let windows = scene.case(tick).windows(&scene.trajectory(tick)?);
    Ok(windows.iter().find_map(|window| {
        let within = |row: &&Row| row.t_s >= window.begin - 1e-9 && row.t_s <= window.end + 1e-9;
        let mut peak = Peak::default();
        for row in rows.iter().filter(within) {
            peak.raise(row.torque_nm, row.t_s);
        }
        Excess::of(Quantity::Torque, peak, limit, window.index)
    }))
}

/// Ticks a stepper through a scene. Returns a row every tick.
pub fn drive(stepper: &dyn AnyStepper, scene: &SceneFile) -> Result<Vec<Row>, Error> {
    if let Some(shaper) = &scene.shaper {
        return drive_shaped(stepper, scene, shaper);
    }
    let tick = stepper.period();
    // The moves' own, and the rest that is added to show what they leave behind.
    let mut motions = scene.motions();
    let planned = scene.trajectory(tick)?;
    if let Some(rest) = planned.plans().get(motions.len()) {
        motions.push(Move::Dwell { duration: f64::from(rest.summary.ticks) * tick }.into());
    }
    let mut rows = Vec::new();
    each_tick_of(stepper, scene.from, &motions, |generator, k, ends| {
        let setpoint = generator.tick();
        let shown = if ends { generator.setpoint_before() } else { setpoint };
        rows.push(row_of(scene, k as f64 * tick, &shown, generator.tip_angle()));
    })?;
    Ok(rows)
}

/// Ticks a stepper as [`drive`] does, along a shaped motion.
fn drive_shaped(
    stepper: &dyn AnyStepper,
    scene: &SceneFile,
    shaper: &Shaper,
) -> Result<Vec<Row>, Error> {
    let tick = stepper.period();
    let trajectory = scene.trajectory(tick)?;
    let plans = trajectory.plans().iter();
    let segments: Vec<Segment<f64>> =
        plans.flat_map(|plan| plan.segments.iter().copied()).collect();
    let ends: HashSet<u32> = trajectory.arrivals().map(|end| (end / tick).round() as u32).collect();
    let motion = Shaped { segments: &segments, shaper };
    let mut rows = Vec::new();
    stepper.along(&motion, &|k| ends.contains(&k), &mut |k, setpoint, tip_angle| {
        rows.push(row_of(scene, f64::from(k) * tick, &setpoint, tip_angle));
    });
    Ok(rows)
}

/// Feeds the scene's moves to a generator as its queue takes them, and has `each` tick it through
/// all of them. `each(generator, k, ends)` calls [`AnyGenerator::tick`] once, for tick `k`. `ends`
/// is true if a move ends at that tick. The scene's motion keeps its kinematic limits.
pub fn each_tick(
    stepper: &dyn AnyStepper,
    scene: &SceneFile,
    each: impl FnMut(&mut dyn AnyGenerator, u64, bool),
) -> Result<(), Error> {
    if scene.shaper.is_some() {
        return Err(Error::new(
            "shaper: a generator has none; use run, reference, compare or sweep",
        ));
    }
    scene.trajectory(stepper.period())?;
    each_tick_of(stepper, scene.from, &scene.motions(), each)
}

/// Feeds and ticks as [`each_tick`] does, with moves from rest at `from` rad.
fn each_tick_of(
    stepper: &dyn AnyStepper,
    from: f64,
    motions: &[Motion],
    mut each: impl FnMut(&mut dyn AnyGenerator, u64, bool),
) -> Result<(), Error> {
    let mut generator = stepper.generator(from)?;
    let mut waiting = motions.iter().peekable();
    let mut feeding = None;
    let mut ends = Vec::new();
    let mut total = 0;
    for k in 0.. {
        while let Some(motion) = waiting.peek() {
            let Some(ticks) = take(&mut *generator, motion, &mut feeding)? else { break };
            total += ticks;
            if !motion.is_dwell() {
                ends.push(total);
            }
            waiting.next();
        }
        each(&mut *generator, k, ends.binary_search(&k).is_ok());
        if waiting.peek().is_none() && k == total {
            break;
        }
    }
    Ok(())
}

/// A path of which the generator has not yet taken all rows.
pub(crate) struct Feeding {
    path: Path,
    rows: std::vec::IntoIter<Waypoint>,
}

/// Gives as much of a motion to a generator as its queue has room for. Returns the motion's ticks
/// once it is taken as a whole.
pub(crate) fn take(
    generator: &mut dyn AnyGenerator,
    motion: &Motion,
    feeding: &mut Option<Feeding>,
) -> Result<Option<u64>, Error> {
    match motion {
        Motion::Move(motion) => match generator.push(motion) {
            Ok(plan) => Ok(Some(u64::from(plan.ticks))),
            Err(CoreError::QueueFull { .. }) => Ok(None),
            Err(error) => Err(error.into()),
        },
        Motion::Path(waypoints) => {
            let mut fed = match feeding.take() {
                Some(fed) => fed,
                None => Feeding {
                    path: generator.path(waypoints.spline())?,
                    rows: waypoints.rows(generator.period()).into_iter(),
                },
            };
            let done = generator.feed(&mut fed.path, &mut fed.rows).map_err(|error| {
                Error::new(error.error).within(waypoints.place(error.row as usize))
            })?;
            if done {
                return Ok(Some(fed.path.ticks()));
            }
            *feeding = Some(fed);
            Ok(None)
        }
    }
}

/// Converts a setpoint of a scene's arm to a row of the table.
fn row_of(scene: &SceneFile, t: f64, setpoint: &AnySetpoint, tip_angle: f64) -> Row {
    row(t, scene.arm.mount.axis, setpoint, scene.arm.payload.offset, tip_angle)
}

/// Converts a setpoint of an axis of that kind to the units of the table, with the payload's centre
/// if that is `offset` m beyond the tip. `tip_angle` (rad) is that of the same tick.
pub fn row(t: f64, axis: AxisKind, setpoint: &AnySetpoint, offset: f64, tip_angle: f64) -> Row {
    let [x, y] = setpoint.global_tip_on(axis);
    let payload = (offset != 0.0).then(|| setpoint.global_payload_on(axis, offset, tip_angle));
    let setpoint = setpoint.precise();
    Row {
        t_s: t,
        hub_angle_rad: setpoint.angle.radians(),
        hub_rate_rad_s: setpoint.rate,
        hub_accel_rad_s2: setpoint.acceleration,
        tip_x_m: x,
        tip_y_m: y,
        deflection_m: setpoint.deflection(),
        torque_nm: setpoint.torque,
        payload_x_m: payload.map(|[x, _]| x),
        payload_y_m: payload.map(|[_, y]| y),
    }
}
