//! Counts what a tick of two axes costs in an image like the application: same profile, same
//! hand-over of setpoints, one method. Prints the worst tick of a move and the worst of all, a line
//! of two numbers.
//!
//! The method is that of `axes.rs`, of which tests build changed ones. What the compiler inlines
//! depends on how many steppers an image holds, so that an image of several methods would count
//! something else.
#![no_std]
#![no_main]

use core::cell::RefCell;
use core::fmt::Write;

use cortex_m_rt::entry;
use embassy_sync::blocking_mutex::CriticalSectionMutex;
use embassy_sync::blocking_mutex::raw::CriticalSectionRawMutex;
use embassy_sync::channel::Channel;
use heapless::Vec;
use semihosting::process::ExitCode;
use stillbeam::axis::{Axis, Mode};
use stillbeam::{Angle, Error, PlainMove, Profile};
use stillbeam_firmware::counter::Chosen as Counter;
use stillbeam_firmware::output::Output;
use stillbeam_firmware::stopwatch::Stopwatch;
use stillbeam_wiring::Configuration;
use stillbeam_wiring::axes::{self, CONFIGURATIONS, QUEUE, Stepper};
use stillbeam_wiring::drive::Setpoint;

stillbeam_firmware::exit_on_panic!();
stillbeam_firmware::unused_interrupts!();

const AXES: usize = 2;

type Joint = Axis<Stepper, QUEUE>;

type Outlet = Channel<CriticalSectionRawMutex, Setpoint, { 2 * AXES }>;

static TO_DRIVE: Outlet = Channel::new();
static TO_HOST: Outlet = Channel::new();
static JOINTS: CriticalSectionMutex<RefCell<Vec<Joint, AXES>>> =
    CriticalSectionMutex::new(RefCell::new(Vec::new()));

fn with<R>(look: impl FnOnce(&mut Vec<Joint, AXES>) -> R) -> R {
    JOINTS.lock(|joints| look(&mut joints.borrow_mut()))
}

#[inline(never)]
fn set_up() -> Result<(), Error> {
    // The application's second axis has every term, so that both are that one here.
    let Configuration { scene, policy, .. } = &CONFIGURATIONS[1];
    let origin = Angle { turns: 0, part: 0.0 };
    for _ in 0..AXES {
        let axis = Axis::new(axes::stepper(scene)?, origin, *policy)?;
        with(|joints| {
            // As many as there is room for.
            let _ = joints.push(axis);
        });
    }
    Ok(())
}

/// A tick of every axis, as the application's task makes it. Returns the number of setpoints that
/// found no room.
#[inline(never)]
fn tick() -> u32 {
    with(|joints| {
        let mut dropped = 0;
        for (i, axis) in joints.iter_mut().enumerate() {
            let tick = axis.tick_by(stillbeam_tick::advance);
            let setpoint = Setpoint { axis: i as u8, tick, cause: axis.cause() };
            for outlet in [&TO_DRIVE, &TO_HOST] {
                dropped += u32::from(outlet.try_send(setpoint).is_err());
            }
        }
        dropped
    })
}

/// Ticks until every axis is in `mode` and at rest; the worst of them.
fn run(watch: &Stopwatch<Counter>, mode: Mode, heard: bool) -> u32 {
    let mut worst = 0;
    loop {
        let (dropped, count) = watch.count(tick);
        assert_eq!(dropped, 0, "the channels have room");
        worst = worst.max(count);
        while TO_DRIVE.try_receive().is_ok() {}
        while TO_HOST.try_receive().is_ok() {}
        let over = with(|joints| {
            if heard {
                joints.iter_mut().for_each(Axis::heard);
            }
            joints.iter().all(|axis| axis.mode() == mode && axis.rests())
        });
        if over {
            return worst;
        }
    }
}

/// The same move for every axis.
#[inline(never)]
fn take(motion: &PlainMove) {
    with(|joints| {
        for axis in joints.iter_mut() {
            let context = axis.plan_context().expect("the axes are enabled");
            let planned = context.plan(motion).expect("within the limits");
            axis.take(&planned).expect("there is room");
        }
    });
}

const fn to(profile: Profile, duration: f64, to: f64) -> PlainMove {
    PlainMove::To { profile, duration, to }
}

#[entry]
fn main() -> ! {
    let mut output = Output::open().expect("standard output by semihosting");
    set_up().expect("every method takes this arm");
    let watch = Stopwatch::<Counter>::start();
    with(|joints| {
        for axis in joints.iter_mut() {
            axis.enable(Angle { turns: 0, part: 0.1 }).expect("at rest");
        }
    });
    take(&to(Profile::SCurve, 1.2, 1.5));
    let moving = run(&watch, Mode::Enabled, true);
    take(&to(Profile::Quintic, 1.2, -0.8));
    let moving = moving.max(run(&watch, Mode::Enabled, true));
    // Silence in the middle of a move: every axis plans its stop in the same tick.
    take(&to(Profile::Quintic, 1.2, 1.0));
    let stopping = run(&watch, Mode::Stopped, false);
    writeln!(output, "{moving},{}", moving.max(stopping)).expect("the host takes the line");
    output.flush().expect("the host takes the line");
    ExitCode::SUCCESS.exit_process()
}
