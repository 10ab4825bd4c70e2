//! Runs the core on a scene: the same generator as on the target, in f32 or f64.

use std::collections::HashSet;

use stillbeam::hub::HubState;
use stillbeam::motion::{Path, Segment, Shaped, Shaper, Waypoint};
use stillbeam::select::Choice;
use stillbeam::stepper::{AnyMotion, Response, Stepper};
use stillbeam::{AxisKind, Error as CoreError, Generator, Move, Scalar as Real, Setpoint};

use crate::dispatch::{StepperVisitor, with_chosen, with_stepper};
use crate::error::Error;
use crate::limits::load::Progress;
use crate::limits::{self, Excess, Peak, Quantity, Refusal, Way, remedy};
use crate::scene_file::SceneFile;
use crate::solver::Solver;
use crate::step::{Motion, Step};
use crate::table::Row;

/// Capacity of the desktop's generator queue, segments: two of the longest moves.
pub const QUEUE: usize = 14;

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
        let rows = with_stepper(&scene, solver, Rows { scene: &scene });
        rows.is_ok_and(|rows| own_excess(&scene, solver.tick, &rows).is_ok_and(|own| own.is_none()))
    };
    admit_loads(scene, solver.tick, &commanded, progress)?;
    let rows = match choice {
        Some(_) => with_chosen(scene, solver, choice, Rows { scene }),
        None => with_stepper(scene, solver, Rows { scene }),
    }?;
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

struct Rows<'a> {
    scene: &'a SceneFile,
}

impl StepperVisitor for Rows<'_> {
    type Output = Vec<Row>;

    fn visit<S: Stepper + Clone>(self, stepper: S) -> Result<Vec<Row>, Error> {
        drive(stepper, self.scene)
    }
}

/// Ticks a stepper through a scene. Returns a row every tick.
pub fn drive<S: Stepper>(stepper: S, scene: &SceneFile) -> Result<Vec<Row>, Error> {
    if let Some(shaper) = &scene.shaper {
        return drive_shaped(&stepper, scene, shaper);
    }
    let tick = stepper.tick();
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
        let tip_angle = generator.stepper().tip_angle(generator.state());
        let centre = payload(scene, &shown, tip_angle);
        rows.push(row(k as f64 * tick, scene.arm.mount.axis, &shown, centre));
    })?;
    Ok(rows)
}

/// Ticks a stepper as [`drive`] does, along a shaped motion, which no generator's queue holds.
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
    let mut state = stepper.equilibrium(&stepper.gravity().aimed(&motion.hub(0)));
    let mut rows = Vec::new();
    for k in 0..=motion.ticks() {
        if k > 0 {
            motion.advance(stepper, &mut state, k - 1);
        }
        let hub = if ends.contains(&k) { motion.arrival(k) } else { motion.hub(k) };
        let hub = stepper.gravity().aimed(&hub);
        let Response { torque, tip } = stepper.response::<AnyMotion>(&state, &hub);
        let HubState { angle, rate, acceleration, .. } = hub;
        let setpoint = Setpoint { angle, rate, acceleration, torque, tip };
        let centre = payload(scene, &setpoint, stepper.tip_angle(&state));
        rows.push(row(f64::from(k) * tick, scene.arm.mount.axis, &setpoint, centre));
    }
    Ok(rows)
}

/// Feeds the scene's moves to a generator as its queue takes them, and has `each` tick it through
/// all of them. `each(generator, k, ends)` calls [`Generator::tick`] once, for tick `k`. `ends` is
/// true if a move ends at that tick. The scene's motion keeps its kinematic limits.
pub fn each_tick<S: Stepper>(
    stepper: S,
    scene: &SceneFile,
    each: impl FnMut(&mut Generator<S, QUEUE>, u64, bool),
) -> Result<(), Error> {
    if scene.shaper.is_some() {
        return Err(Error::new(
            "shaper: a generator has none; use run, reference, compare or sweep",
        ));
    }
    scene.trajectory(stepper.tick())?;
    each_tick_of(stepper, scene.from, &scene.motions(), each)
}

/// Feeds and ticks as [`each_tick`] does, with moves from rest at `from` rad.
fn each_tick_of<S: Stepper>(
    stepper: S,
    from: f64,
    motions: &[Motion],
    mut each: impl FnMut(&mut Generator<S, QUEUE>, u64, bool),
) -> Result<(), Error> {
    let mut generator = Generator::<S, QUEUE>::new(stepper, from)?;
    let mut waiting = motions.iter().peekable();
    let mut feeding = None;
    let mut ends = Vec::new();
    let mut total = 0;
    for k in 0.. {
        while let Some(motion) = waiting.peek() {
            let Some(ticks) = take(&mut generator, motion, &mut feeding)? else { break };
            total += ticks;
            if !motion.is_dwell() {
                ends.push(total);
            }
            waiting.next();
        }
        each(&mut generator, k, ends.binary_search(&k).is_ok());
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
pub(crate) fn take<S: Stepper>(
    generator: &mut Generator<S, QUEUE>,
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
                    path: waypoints.begun(generator.path(waypoints.spline())?)?,
                    rows: waypoints.rows(generator.stepper().tick()).into_iter(),
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

/// Returns the payload's centre in the global frame, m, if it is not the tip.
fn payload<T: Real>(scene: &SceneFile, setpoint: &Setpoint<T>, tip_angle: T) -> Option<[f64; 2]> {
    let offset = scene.arm.payload.offset;
    (offset != 0.0).then(|| {
        let centre = setpoint.payload_centre(T::from_f64(offset), tip_angle);
        let centre = Setpoint { tip: centre, ..*setpoint };
        centre.global_tip_on(scene.arm.mount.axis).map(T::to_f64)
    })
}

/// Converts a setpoint of an axis of that kind to the units of the table. `payload` is the
/// payload's centre in the global frame, m, if it is not the tip.
pub fn row<T: Real>(
    t: f64,
    axis: AxisKind,
    setpoint: &Setpoint<T>,
    payload: Option<[f64; 2]>,
) -> Row {
    let [x, y] = setpoint.global_tip_on(axis);
    Row {
        t_s: t,
        hub_angle_rad: setpoint.angle.radians(),
        hub_rate_rad_s: setpoint.rate.to_f64(),
        hub_accel_rad_s2: setpoint.acceleration.to_f64(),
        tip_x_m: x.to_f64(),
        tip_y_m: y.to_f64(),
        deflection_m: setpoint.deflection().to_f64(),
        torque_nm: setpoint.torque.to_f64(),
        payload_x_m: payload.map(|[x, _]| x),
        payload_y_m: payload.map(|[_, y]| y),
    }
}
