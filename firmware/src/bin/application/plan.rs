//! Plans and changes of arms, below everything else: however long they take, ticks, drives and
//! requests go on. The tick is masked while their results are handed over, no longer.

use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use stillbeam::{Error, Payload, PlanContext, PlannedMove, UniformScene};
use stillbeam_protocol::Refusal;
use stillbeam_wiring::Work;
use stillbeam_wiring::axes::AXES;

use crate::arms::{self, Planner};
use crate::path::Paths;
use crate::shared::{self, Outcome, on, scene};

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
    let mut paths = Paths::default();
    loop {
        let Job { sequence, axis, work } = paths.next_job().await;
        let outcome = match work {
            Work::Move(motion) => follow(axis, |context| context.plan(&motion)),
            Work::Still { to, duration } => still(axis, to, duration),
            Work::Payload(payload) => reload(axis, payload),
            Work::Path(spline) => paths.begin(axis, spline),
            Work::Row(row, last) => paths.offer(axis, row, last),
        };
        DONE.send(Done { sequence, outcome }).await;
    }
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
        // Used where it was made: a move is large, and a copy of it needs as much stack.
        let made = plan(&context);
        let planned = made.as_ref().map_err(|error| *error)?;
        let taken = shared::with(|s| match s.joints.get_mut(axis) {
            Some(joint) => joint.take(planned).map(|_| joint.axis.clock()),
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

/// Plans a move that arrives still. The planner is there for as long: loading it takes less than a
/// hundredth of its plan, and statics for one an axis would be more than the stack that it needs.
#[inline(never)]
fn still(axis: usize, to: f64, duration: Option<f64>) -> Outcome<u32> {
    arms::with_planner(axis, &scene(axis)?, |planner| {
        follow(axis, |context| search(context, planner, to, duration))
    })
}

/// Searches for a still move.
// Not inlined: what the search needs is off the stack when the move is handed over.
#[inline(never)]
fn search(
    context: &PlanContext,
    planner: &Planner,
    to: f64,
    duration: Option<f64>,
) -> Result<PlannedMove<f32>, Error> {
    context.plan_still(planner, to, duration)
}

/// Puts the arm with another payload in the place of the old one.
#[inline(never)]
fn reload(axis: usize, payload: Payload) -> Outcome<u32> {
    let scene = scene(axis)?;
    let changed = UniformScene { payload, ..scene };
    let stepper = arms::stepper(axis, &changed)?;
    on(axis, |joint| joint.replace(changed, stepper))
}
