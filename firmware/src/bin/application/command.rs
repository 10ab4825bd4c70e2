//! Requests of the host. What changes at once is done here, with the tick masked for as long; what
//! has to be planned is handed down to [`crate::plan`], so that a stop never waits for a plan.

use embassy_futures::select::{Either, select};
use embedded_io_async::Read;
use stillbeam_firmware::stack;
use stillbeam_methods::Method as _;
use stillbeam_protocol::frame::{Splitter, decode};
use stillbeam_protocol::{Command, Description, Refusal, Report, Request, Status};
use stillbeam_wiring::Work;
use stillbeam_wiring::axes::{self, AXES, CONFIGURATIONS};

use crate::board::LinkReader;
use crate::plan::{DONE, Done, JOBS, Job};
use crate::record::{self, COLUMN};
use crate::shared::{self, Outcome, on, scene};
use crate::{link, tick};

/// Takes requests one by one and answers each, at once or when it is planned.
#[embassy_executor::task]
pub async fn run(mut line: LinkReader) {
    let mut splitter = Splitter::new();
    let mut bytes = [0; 32];
    loop {
        let n = match select(line.read(&mut bytes), DONE.receive()).await {
            // A line that fails is silent; the axes' patience sees to the rest.
            Either::First(n) => n.unwrap_or(0),
            Either::Second(Done { sequence, outcome }) => {
                link::send(&accepted(sequence, outcome)).await;
                continue;
            }
        };
        for &byte in &bytes[..n] {
            let Some(frame) = splitter.push(byte) else { continue };
            match frame.and_then(decode::<Request>) {
                Ok(request) => {
                    if let Some(report) = answer(&request) {
                        link::send(&report).await;
                    }
                }
                Err(_) => shared::with(|s| s.counters.garbled += 1),
            }
        }
    }
}

/// The answer to a request, unless that has to be planned first.
fn answer(request: &Request) -> Option<Report<'static>> {
    let Request { sequence, axis, command } = *request;
    shared::with(|s| s.joints.iter_mut().for_each(|joint| joint.axis.heard()));
    let axis = usize::from(axis);
    if let Some(work) = Work::of(&command) {
        return hand_down(sequence, axis, work);
    }
    let outcome = match command {
        Command::Describe => {
            describe(axis).map(|description| Report::Description { sequence, description })
        }
        Command::Status => status(axis).map(|status| Report::Status { sequence, status }),
        Command::Record(true) => {
            record::begin(axis).map(|tick| Report::Recording { sequence, tick, column: COLUMN })
        }
        // Answered behind the last row.
        Command::Record(false) if record::end(axis, sequence) => return None,
        Command::Record(false) => Ok(Report::Recorded { sequence, samples: 0, lost: 0 }),
        _ => Ok(accepted(sequence, on(axis, |joint| joint.carry_out(&command)))),
    };
    Some(outcome.unwrap_or_else(|refusal| Report::Refused { sequence, refusal }))
}

fn accepted(sequence: u16, outcome: Outcome<u32>) -> Report<'static> {
    match outcome {
        Ok(tick) => Report::Accepted { sequence, tick },
        Err(refusal) => Report::Refused { sequence, refusal },
    }
}

/// To the planner; answered by its [`DONE`].
fn hand_down(sequence: u16, axis: usize, work: Work) -> Option<Report<'static>> {
    let full = JOBS.try_send(Job { sequence, axis, work }).is_err();
    full.then_some(Report::Refused { sequence, refusal: Refusal::Busy })
}

fn describe(axis: usize) -> Outcome<Description<'static>> {
    let configuration = CONFIGURATIONS.get(axis).ok_or(Refusal::Axis(AXES as u8))?;
    let zero = shared::with(|s| s.joints.get(axis).map(|joint| joint.train.mapping().zero()));
    Ok(Description {
        axes: AXES as u8,
        method: axes::Method::ID,
        tick: axes::TICK,
        scene: scene(axis)?,
        policy: configuration.policy,
        joint: configuration.joint,
        direction: configuration.direction,
        zero: zero.ok_or(Refusal::Axis(AXES as u8))?,
        node: configuration.node,
    })
}

fn status(axis: usize) -> Outcome<Status> {
    shared::with(|s| {
        let joint = s.joints.get(axis).ok_or(Refusal::Axis(AXES as u8))?;
        let counters = s.counters;
        Ok(Status {
            mode: joint.axis.mode(),
            cause: joint.axis.cause(),
            clock: joint.axis.clock(),
            measured: joint.measured.unwrap_or_default(),
            cost: counters.cost,
            worst: counters.worst,
            late: tick::microseconds(counters.late),
            missed: counters.missed,
            early: counters.early,
            overruns: counters.overruns,
            dropped: counters.dropped,
            garbled: counters.garbled,
            saturated: counters.saturated,
            stack: 0,
        })
    })
    .map(|status| Status { stack: stack::deepest() as u32, ..status })
}
