//! Planning and set-up, below everything else: however long they take, ticks, drives and requests
//! go on. The tick is masked while their results are handed over, no longer.

use embassy_futures::select::{Either, select};
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use embassy_time::{Duration, Timer};
use stillbeam::motion::{Path, PathPiece, RowError, Spline, Waypoint};
use stillbeam::{Error, Payload, PlanContext, PlannedMove, UniformScene};
use stillbeam_protocol::Refusal;
use stillbeam_wiring::axes::{self, AXES};
use stillbeam_wiring::{Rows, Work};

use crate::shared::{self, Outcome, on, scene};
use crate::still::Planners;
use crate::tick::MICROSECONDS;

/// Work for one axis.
#[derive(Clone, Copy)]
pub struct Job {
    /// The request's.
    pub sequence: u16,
    pub axis: usize,
    pub work: Work,
}

/// Result of a job: the first tick that shows it.
pub struct Done {
    pub sequence: u16,
    pub outcome: Outcome<u32>,
}

/// Jobs that wait; whoever asks for one more is told that the planner is busy.
pub static JOBS: Channel<CriticalSectionRawMutex, Job, 2> = Channel::new();
/// To whoever answers.
pub static DONE: Channel<CriticalSectionRawMutex, Done, 1> = Channel::new();

/// Takes jobs one by one.
#[embassy_executor::task]
pub async fn run() {
    let mut planners = Planners::default();
    let mut paths: [Rows; AXES] = Default::default();
    loop {
        let Job { sequence, axis, work } = next_job(&mut paths).await;
        let outcome = match work {
            Work::Move(motion) => follow(axis, |context| context.plan(&motion)),
            Work::Still { to, duration } => planners
                .of(axis)
                .and_then(|planner| follow(axis, |d| planner.plan(d, to, duration))),
            Work::Payload(payload) => {
                planners.forget(axis);
                reload(axis, payload)
            }
            Work::Path(spline) => begin(&mut paths, axis, spline),
            Work::Row(row, last) => match paths.get_mut(axis) {
                Some(rows) => offer(rows, axis, row, last),
                None => Err(Refusal::Axis(AXES as u8)),
            },
        };
        DONE.send(Done { sequence, outcome }).await;
    }
}

/// Waits for a job; meanwhile takes rows of the paths under way, a tick after the other.
async fn next_job(paths: &mut [Rows; AXES]) -> Job {
    let tick = Duration::from_micros(MICROSECONDS.into());
    while paths.iter().any(Rows::is_open) {
        if let Either::First(job) = select(JOBS.receive(), Timer::after(tick)).await {
            return job;
        }
        for (axis, rows) in paths.iter_mut().enumerate() {
            rows.advance(|path, piece| take(axis, path, piece));
        }
    }
    JOBS.receive().await
}

/// Begins a path at the end of the axis' moves.
#[inline(never)]
fn begin(paths: &mut [Rows; AXES], axis: usize, spline: Spline) -> Outcome<u32> {
    let none = Refusal::Axis(AXES as u8);
    let rows = paths.get_mut(axis).ok_or(none)?;
    let (path, tick) = shared::with(|s| {
        let joint = s.joints.get(axis).ok_or(none)?;
        Ok::<_, Refusal<'static>>((joint.axis.path(spline)?, joint.axis.clock()))
    })?;
    rows.begin(path);
    Ok(tick)
}

/// Takes a row of a path.
#[inline(never)]
fn offer(rows: &mut Rows, axis: usize, row: Waypoint, last: bool) -> Outcome<u32> {
    // The tick before which the first piece is taken, if any is.
    let mut tick = None;
    rows.offer(row, last, |path, piece| {
        let (taken, before) = hand_over(axis, path, piece)?;
        tick = tick.or(taken.then_some(before));
        Ok(taken)
    })?;
    tick.map_or_else(|| on(axis, |_| Ok(())), Ok)
}

fn take(axis: usize, path: &mut Path, piece: &PathPiece) -> Result<bool, RowError> {
    hand_over(axis, path, piece).map(|(taken, _)| taken)
}

/// Hands a piece over with the tick masked. Returns the number of the next tick with it.
#[inline(never)]
fn hand_over(axis: usize, path: &mut Path, piece: &PathPiece) -> Result<(bool, u32), RowError> {
    shared::with(|s| match s.joints.get_mut(axis) {
        Some(joint) => Ok((joint.axis.take_piece(path, piece)?, joint.axis.clock())),
        None => Ok((false, 0)),
    })
}

/// Plans with the tick running and hands the plan over. Where the axis' motion has changed
/// meanwhile it is planned once more.
// Not inlined, as the next: one job needs no stack for another.
#[inline(never)]
fn follow(
    axis: usize,
    plan: impl Fn(&PlanContext) -> Result<PlannedMove<f32>, Error>,
) -> Outcome<u32> {
    let mut last = Error::Stale;
    for _ in 0..2 {
        let context = shared::with(|s| {
            let joint = s.joints.get(axis).ok_or(Refusal::Axis(AXES as u8))?;
            joint.axis.plan_context().map_err(Refusal::from)
        })?;
        let planned = plan(&context)?;
        let taken = shared::with(|s| match s.joints.get_mut(axis) {
            Some(joint) => joint.take(&planned).map(|_| joint.axis.clock()),
            None => Err(last),
        });
        match taken {
            Ok(tick) => return Ok(tick),
            Err(refused) => last = refused,
        }
        if last != Error::Stale {
            break;
        }
    }
    Err(last.into())
}

/// Sets the arm with another payload up and puts it in the place of the old one.
#[inline(never)]
fn reload(axis: usize, payload: Payload) -> Outcome<u32> {
    let scene = scene(axis)?;
    let changed = UniformScene { payload, ..scene };
    let stepper = axes::stepper(&changed)?;
    on(axis, |joint| joint.replace(changed, stepper))
}
