//! Requests of the host. Planning and set-up happen here, at the lowest priority; the tick is masked
//! while their results are handed over, no longer.

use embedded_io_async::Read;
use stillbeam::axis::{Cause, Mode, Refused};
use stillbeam::{Angle, Error, Move, Payload, Rejected, Scene};
use stillbeam_firmware::stack;
use stillbeam_protocol::frame::{Splitter, decode};
use stillbeam_protocol::{Command, Description, Refusal, Report, Request, Status};

use crate::axes::{self, AXES, CONFIGURATIONS};
use crate::board::{self, LinkReader};
use crate::link;
use crate::shared::{self, Joint};

type Outcome<T> = Result<T, Refusal<'static>>;

/// Takes requests one by one and answers each.
#[embassy_executor::task]
pub async fn run(mut line: LinkReader) {
    let mut scenes: [Scene; AXES] = CONFIGURATIONS.map(|configuration| configuration.scene);
    let mut splitter = Splitter::new();
    let mut bytes = [0; 32];
    loop {
        // A line that fails is silent; the axes' patience sees to the rest.
        let n = line.read(&mut bytes).await.unwrap_or(0);
        for &byte in &bytes[..n] {
            let Some(frame) = splitter.push(byte) else { continue };
            match frame.and_then(decode::<Request>) {
                Ok(request) => link::send(&answer(&request, &mut scenes)).await,
                Err(_) => shared::with(|s| s.counters.garbled += 1),
            }
        }
    }
}

fn answer(request: &Request, scenes: &mut [Scene; AXES]) -> Report<'static> {
    let Request { sequence, axis, command } = *request;
    shared::with(|s| s.joints.iter_mut().for_each(|joint| joint.axis.heard()));
    let axis = usize::from(axis);
    let outcome = match command {
        Command::Describe => {
            describe(axis, scenes).map(|description| Report::Description { sequence, description })
        }
        Command::Status => status(axis).map(|status| Report::Status { sequence, status }),
        _ => carry_out(axis, command, scenes).map(|tick| Report::Accepted { sequence, tick }),
    };
    outcome.unwrap_or_else(|refusal| Report::Refused { sequence, refusal })
}

/// Carries a request out and returns the first tick that it shows in.
fn carry_out(axis: usize, command: Command, scenes: &mut [Scene; AXES]) -> Outcome<u32> {
    match command {
        Command::Move(motion) => plan(axis, &motion),
        Command::Payload(payload) => reload(axis, payload, scenes),
        Command::Enable => on(axis, |joint| {
            let shaft = joint.measured.ok_or(Refusal::NotMeasured)?;
            Ok(joint.axis.enable(joint.train.mapping().to_link(shaft))?)
        }),
        Command::Disable => on(axis, |joint| {
            joint.axis.disable();
            Ok(())
        }),
        Command::Stop => on(axis, |joint| {
            joint.axis.stop(Cause::Requested);
            Ok(())
        }),
        Command::Home(angle) => home(axis, angle),
        Command::Heartbeat | Command::Describe | Command::Status => on(axis, |_| Ok(())),
    }
}

/// Changes an axis with the tick masked.
fn on(axis: usize, change: impl FnOnce(&mut Joint) -> Outcome<()>) -> Outcome<u32> {
    shared::with(|s| {
        let joint = s.joints.get_mut(axis).ok_or(Refusal::Axis(AXES as u8))?;
        let tick = joint.axis.clock();
        change(joint).map(|()| tick)
    })
}

/// Plans with the tick running and hands the plan over. Where the axis' motion has changed meanwhile
/// it is planned once more.
fn plan(axis: usize, motion: &Move) -> Outcome<u32> {
    let mut last = Refused::Queue(Rejected::Stale);
    for _ in 0..2 {
        let departure = shared::with(|s| {
            let joint = s.joints.get(axis).ok_or(Refusal::Axis(AXES as u8))?;
            joint.axis.departure().map_err(Refusal::from)
        })?;
        let planned = departure.plan(motion)?;
        let taken = shared::with(|s| match s.joints.get_mut(axis) {
            Some(joint) => joint.axis.take(&planned).map(|_| joint.axis.clock()),
            None => Err(last),
        });
        match taken {
            Ok(tick) => return Ok(tick),
            Err(refused) => last = refused,
        }
        if last != Refused::Queue(Rejected::Stale) {
            break;
        }
    }
    Err(last.into())
}

/// Sets the arm with another payload up and puts it in the place of the old one.
fn reload(axis: usize, payload: Payload, scenes: &mut [Scene; AXES]) -> Outcome<u32> {
    let scene = scenes.get_mut(axis).ok_or(Refusal::Axis(AXES as u8))?;
    let changed = Scene { payload, ..*scene };
    let stepper = axes::stepper(&changed)?;
    let tick = on(axis, |joint| Ok(joint.axis.replace(stepper)?))?;
    *scene = changed;
    Ok(tick)
}

/// Names the angle where a disabled axis stands.
fn home(axis: usize, angle: f64) -> Outcome<u32> {
    if !(-1e6..=1e6).contains(&angle) {
        let parameter = "home.angle";
        return Err(Error::OutOfRange {
            parameter,
            value: angle,
            min: -1e6,
            max: 1e6,
            unit: "rad",
        }
        .into());
    }
    let angle: Angle<f32> = Angle::from_radians(angle).cast();
    on(axis, |joint| {
        let shaft = joint.measured.ok_or(Refusal::NotMeasured)?;
        match joint.axis.mode() {
            Mode::Disabled => joint.train.home(shaft, angle),
            mode => return Err(Refusal::Mode(mode)),
        }
        Ok(())
    })
}

fn describe(axis: usize, scenes: &[Scene; AXES]) -> Outcome<Description<'static>> {
    let (Some(configuration), Some(scene)) = (CONFIGURATIONS.get(axis), scenes.get(axis)) else {
        return Err(Refusal::Axis(AXES as u8));
    };
    let zero = shared::with(|s| s.joints.get(axis).map(|joint| joint.train.mapping().zero()));
    Ok(Description {
        axes: AXES as u8,
        method: axes::METHOD,
        tick: axes::TICK,
        scene: *scene,
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
            late: board::microseconds(counters.late),
            missed: counters.missed,
            overruns: counters.overruns,
            dropped: counters.dropped,
            garbled: counters.garbled,
            saturated: counters.saturated,
            stack: 0,
        })
    })
    .map(|status| Status { stack: stack::deepest() as u32, ..status })
}
