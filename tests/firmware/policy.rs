//! The policy's table, row by row.

use proptest::prelude::*;
use stillbeam::axis::{Axis, Cause, Mode, Pace, Policy};
use stillbeam::{Error, Move, Profile};
use stillbeam_tests::assert_near;

use super::common::{
    Arm, LIMITS, POLICY, TICK, ask, assert_continuous, disabled, enabled, radians, run, stepper,
    stepper_at, to, turns,
};

#[test]
fn the_first_setpoint_is_the_measured_angle() {
    for part in [-0.5, -0.123_456, 0.0, 0.3, 0.499_999_97] {
        let mut axis = disabled(POLICY);
        run(&mut axis, 5);
        let measured = stillbeam::Angle { turns: -7, part };
        axis.enable(measured).unwrap();
        let first = axis.tick().setpoint;
        assert_eq!(first.angle, measured, "to the last bit");
        assert_eq!((first.rate, first.acceleration), (0.0, 0.0));
        // The arm hangs still in its static bend.
        let later = run(&mut axis, 100).pop().unwrap().setpoint;
        assert!((later.deflection() - first.deflection()).abs() < 1e-6, "no swing at power-up");
        assert!((later.torque - first.torque).abs() < 1e-5);
    }
}

#[test]
fn on_and_off_and_on_never_steps() {
    let mut axis = enabled(POLICY);
    ask(&mut axis, &to(Profile::Cycloid, 0.8, 2.5)).unwrap();
    let mut all = run(&mut axis, 40);
    axis.disable();
    assert_eq!(axis.mode(), Mode::Stopping, "brakes before it is off");
    all.extend(run(&mut axis, 100));
    assert_eq!(axis.mode(), Mode::Disabled);
    assert_continuous(&all, &LIMITS);
    // Somebody turns the arm by hand meanwhile.
    axis.enable(turns(-0.1)).unwrap();
    let all = run(&mut axis, 50);
    assert!(all.iter().all(|tick| tick.setpoint.angle == turns(-0.1)));
}

#[test]
fn enabling_what_is_enabled_changes_nothing() {
    let (mut axis, mut other) = (enabled(POLICY), enabled(POLICY));
    for axis in [&mut axis, &mut other] {
        ask(axis, &to(Profile::Quintic, 0.6, 2.0)).unwrap();
        run(axis, 20);
    }
    axis.enable(turns(0.4)).unwrap();
    assert_eq!(run(&mut axis, 50), run(&mut other, 50));
}

#[test]
fn a_stopped_axis_goes_on_where_it_holds() {
    let mut axis = enabled(POLICY);
    ask(&mut axis, &to(Profile::Cubic, 0.6, 2.0)).unwrap();
    let mut all = run(&mut axis, 30);
    axis.stop(Cause::Requested);
    assert_eq!(axis.enable(turns(0.0)), Err(Error::WrongMode { mode: Mode::Stopping }));
    all.extend(run(&mut axis, 60));
    let refused = ask(&mut axis, &to(Profile::Cubic, 0.6, 2.0));
    assert_eq!(refused, Err(Error::WrongMode { mode: Mode::Stopped }));
    axis.enable(turns(0.0)).unwrap();
    ask(&mut axis, &to(Profile::Cubic, 0.6, 2.0)).unwrap();
    all.extend(run(&mut axis, 80));
    assert_continuous(&all, &LIMITS);
    assert_near("angle", radians(all.last().unwrap()), 2.0, 1e-6);
}

#[test]
fn what_is_refused_changes_nothing() {
    let (mut axis, mut other) = (enabled(POLICY), enabled(POLICY));
    run(&mut axis, 5);
    run(&mut other, 5);
    let moves = [
        to(Profile::Cubic, 0.05, 3.0),
        to(Profile::Cubic, f64::NAN, 3.0),
        to(Profile::Cubic, 0.6, f64::INFINITY),
        Move::SpinUp { duration: 0.5, rate: 60.0 },
    ];
    for motion in moves {
        let planned = axis.plan_context().unwrap().plan::<f32>(&motion);
        assert!(planned.is_err(), "{motion:?}: {planned:?}");
    }
    assert_eq!(run(&mut axis, 50), run(&mut other, 50));
    let mut off = disabled(POLICY);
    let refused = ask(&mut off, &to(Profile::Cubic, 0.6, 1.0));
    assert_eq!(refused, Err(Error::WrongMode { mode: Mode::Disabled }));
}

#[test]
fn a_full_queue_refuses_the_whole_move_and_keeps_the_others() {
    let (mut axis, mut other) = (enabled(POLICY), enabled(POLICY));
    for axis in [&mut axis, &mut other] {
        ask(axis, &to(Profile::SCurve, 0.8, 2.0)).unwrap();
    }
    let refused = ask(&mut axis, &to(Profile::SCurve, 0.8, 1.0));
    assert_eq!(refused, Err(Error::QueueFull { needed: 7, free: 1 }));
    assert_eq!(run(&mut axis, 120), run(&mut other, 120));
    // There is room again, and every move that was must be followed.
    ask(&mut axis, &to(Profile::SCurve, 0.8, 1.0)).unwrap();
    assert_near("angle", radians(run(&mut axis, 100).last().unwrap()), 1.0, 1e-6);
}

#[test]
fn moves_wait_for_each_other_and_the_first_tick_is_told() {
    let mut axis = enabled(POLICY);
    run(&mut axis, 7);
    assert_eq!(ask(&mut axis, &to(Profile::Cubic, 0.5, 2.0)), Ok(7));
    assert_eq!(ask(&mut axis, &to(Profile::Quintic, 0.4, 1.5)), Ok(57));
    let all = run(&mut axis, 200);
    assert_continuous(&all, &LIMITS);
    let at = |number: u32| &all[(number - 7) as usize];
    assert_eq!(at(7).setpoint.rate, 0.0);
    assert_near("first", radians(at(57)), 2.0, 1e-6);
    assert_near("second", radians(at(97)), 1.5, 1e-6);
}

#[test]
fn a_lost_link_stops_the_axis_after_the_patience() {
    let mut axis = enabled(POLICY);
    ask(&mut axis, &Move::SpinUp { duration: 0.5, rate: 5.0 }).unwrap();
    let mut all = run(&mut axis, 60);
    // The tick after the last word is the first of twenty.
    all.extend((0..19).map(|_| axis.tick()));
    assert_eq!(axis.mode(), Mode::Enabled, "as patient as it was told to be");
    all.push(axis.tick());
    assert_eq!((axis.mode(), axis.cause()), (Mode::Stopping, Some(Cause::LinkLost)));
    all.extend((0..100).map(|_| axis.tick()));
    assert_eq!(axis.mode(), Mode::Stopped);
    assert_continuous(&all, &LIMITS);
}

#[test]
fn a_patience_of_zero_waits_for_ever() {
    let mut axis = enabled(Policy { patience: 0.0, ..POLICY });
    for _ in 0..100_000 {
        axis.tick();
    }
    assert_eq!(axis.mode(), Mode::Enabled);
}

/// Ticks without a word until an axis with this tick and patience, s, stops.
fn patience(tick: f64, patience: f64) -> u32 {
    let policy = Policy { patience, ..POLICY };
    let mut axis: Arm = Axis::new(stepper_at(tick, 0.03), turns(0.2), policy).unwrap();
    axis.enable(turns(0.2)).unwrap();
    let enabled = (0..10_000).take_while(|_| axis.tick().mode == Mode::Enabled).count();
    assert_eq!(axis.cause(), Some(Cause::LinkLost));
    enabled as u32
}

/// Half a second of silence is half a second at every tick.
#[test]
fn the_patience_is_a_time_whatever_the_tick() {
    assert_eq!(patience(0.010, 0.5), 50);
    assert_eq!(patience(0.001, 0.5), 500);
    assert_eq!(patience(0.0025, 0.5), 200);
    // To the nearest tick; what is less than one does not mean for ever.
    assert_eq!(patience(0.010, 0.0749), 7);
    assert_eq!(patience(0.010, 1e-9), 1);
}

#[test]
fn a_patience_that_is_no_time_is_refused() {
    let refused = |patience| {
        let policy = Policy { patience, ..POLICY };
        let Err(error) = Axis::<_, 8>::new(stepper(0.03), turns(0.2), policy) else {
            panic!("{patience} s")
        };
        error.to_string()
    };
    assert_eq!(refused(-0.5), "policy.patience = -0.5: must be 0 to 42949672.95 s");
    assert!(refused(f64::NAN).starts_with("policy.patience = NaN: must be 0 to "));
    assert!(refused(f64::INFINITY).starts_with("policy.patience = inf: must be 0 to "));
    assert!(refused(1e9).starts_with("policy.patience = 1000000000: must be 0 to "));
}

/// Time goes on through missed ticks: silence is not lengthened by them.
#[test]
fn silence_lasts_through_missed_ticks() {
    let mut axis = enabled(Policy { patience: 0.6, ..POLICY });
    for tick in 1..=30 {
        axis.missed(2);
        let mode = axis.tick().mode;
        assert_eq!(mode == Mode::Enabled, 3 * tick <= 60, "after {} periods", 3 * tick);
    }
    axis.missed(0);
    axis.tick();
    assert_eq!(axis.cause(), Some(Cause::LinkLost));
}

/// At 1 ms a tick that is missed for 1 ms is found, by the counts that follow from the tick.
#[test]
fn a_missed_millisecond_is_found() {
    let tick = 0.001;
    let mut axis: Arm = Axis::new(stepper_at(tick, 0.03), turns(0.2), POLICY).unwrap();
    axis.enable(turns(0.2)).unwrap();
    let period = Pace::period(tick, 170_000_000).unwrap();
    let mut pace = Pace::new(period);
    let mut now = 0u32;
    for periods in [1, 1, 2, 1, 3] {
        now += periods * period;
        let timing = pace.arrive(now);
        // The first tick has none before it.
        let missed = if now == period { 0 } else { periods - 1 };
        assert_eq!(timing.missed, missed);
        axis.heard();
        axis.tick_if_due(&timing).unwrap();
        assert_eq!(axis.mode(), Mode::Enabled, "two missed ticks are waited for");
    }
    now += 4 * period;
    axis.tick_if_due(&pace.arrive(now)).unwrap();
    assert_eq!(axis.cause(), Some(Cause::MissedTicks), "three are not");
}

/// A burst after a freeze does not run the path ahead of time: no tick is made, nothing changes.
#[test]
fn a_tick_that_is_not_due_is_not_made() {
    let (mut axis, mut other) = (enabled(POLICY), enabled(POLICY));
    for axis in [&mut axis, &mut other] {
        ask(axis, &to(Profile::Quintic, 0.6, 2.0)).unwrap();
    }
    let period = Pace::period(TICK, 1_000_000).unwrap();
    let mut pace = Pace::new(period);
    let (mut all, mut now) = (Vec::new(), 0u32);
    for k in 0..80 {
        // Two ticks are missed now and then, and come in a burst.
        let (freeze, burst) = if k % 20 == 7 { (3, 2) } else { (1, 0) };
        now += freeze * period;
        axis.heard();
        all.extend(axis.tick_if_due(&pace.arrive(now)));
        for _ in 0..burst {
            now += 20;
            assert_eq!(axis.tick_if_due(&pace.arrive(now)), None);
        }
        now -= 20 * burst;
    }
    assert_eq!(all, run(&mut other, 80), "the same path, none left out, none twice");
}

/// The path waits for a tick that was missed; too many in a row are a stop.
#[test]
fn missed_ticks_stretch_the_path_or_stop_it() {
    let (mut axis, mut other) = (enabled(POLICY), enabled(POLICY));
    for axis in [&mut axis, &mut other] {
        ask(axis, &to(Profile::Quintic, 0.6, 2.0)).unwrap();
        run(axis, 20);
    }
    axis.missed(2);
    assert_eq!(run(&mut axis, 10), run(&mut other, 10), "no setpoint of the path is left out");
    let mut all = run(&mut axis, 1);
    axis.missed(3);
    assert_eq!(axis.cause(), Some(Cause::MissedTicks));
    all.extend(run(&mut axis, 100));
    assert_continuous(&all, &LIMITS);
    assert_eq!(axis.mode(), Mode::Stopped);
}

#[test]
fn a_new_payload_is_taken_at_rest_and_moves_no_angle() {
    let mut axis = enabled(POLICY);
    ask(&mut axis, &to(Profile::Cubic, 0.6, 2.0)).unwrap();
    run(&mut axis, 30);
    assert_eq!(axis.replace(stepper(0.06)), Err(Error::Moving));
    let before = run(&mut axis, 60).pop().unwrap().setpoint;
    axis.replace(stepper(0.06)).unwrap();
    let after = axis.tick().setpoint;
    assert_eq!(after.angle, before.angle);
    assert_ne!(after.torque, before.torque, "it holds more weight");
    assert_eq!(axis.mode(), Mode::Enabled);
}

#[test]
fn a_move_planned_before_a_stop_is_stale_after_it() {
    let mut axis = enabled(POLICY);
    ask(&mut axis, &to(Profile::Cubic, 0.6, 2.0)).unwrap();
    run(&mut axis, 20);
    let late = axis.plan_context().unwrap().plan(&to(Profile::Cubic, 0.6, 1.5)).unwrap();
    axis.stop(Cause::Requested);
    run(&mut axis, 100);
    axis.enable(turns(0.0)).unwrap();
    assert_eq!(axis.take(&late), Err(Error::Stale));
}

/// A hub that turns turns on while a move is planned; the move begins where the hub is by then.
#[test]
fn a_spin_is_changed_without_a_step_however_long_planning_takes() {
    for planning in [0, 1, 3, 15] {
        let mut axis = enabled(POLICY);
        ask(&mut axis, &Move::SpinUp { duration: 0.5, rate: 5.0 }).unwrap();
        let mut all = run(&mut axis, 70);
        let stop = Move::SpinUp { duration: 0.5, rate: 0.0 };
        let planned = axis.plan_context().unwrap().plan(&stop).unwrap();
        all.extend(run(&mut axis, planning));
        axis.take(&planned).unwrap();
        all.extend(run(&mut axis, 100));
        assert_continuous(&all, &LIMITS);
        assert!(axis.rests());
    }
}

#[derive(Clone, Copy, Debug)]
enum Event {
    Run(u32),
    Silence(u32),
    Ask(Move),
    Enable,
    Disable,
    Stop,
    Missed(u32),
}

fn events() -> impl Strategy<Value = Event> {
    let profile = prop::sample::select(Profile::ALL.to_vec());
    let rest_to_rest = (profile, 0.1f64..1.0, -2.0f64..2.0).prop_map(|(p, t, a)| to(p, t, a));
    let spin =
        (0.2f64..1.0, -6.0f64..6.0).prop_map(|(duration, rate)| Move::SpinUp { duration, rate });
    prop_oneof![
        4 => (1u32..60).prop_map(Event::Run),
        1 => (1u32..40).prop_map(Event::Silence),
        4 => rest_to_rest.prop_map(Event::Ask),
        1 => spin.prop_map(Event::Ask),
        2 => Just(Event::Enable),
        1 => Just(Event::Disable),
        1 => Just(Event::Stop),
        1 => (1u32..5).prop_map(Event::Missed),
    ]
}

/// Whatever happens in whatever order: while the drive is on, setpoints have no step.
#[test]
fn no_order_of_events_makes_a_step() {
    proptest!(ProptestConfig::with_cases(400), |(list in prop::collection::vec(events(), 1..40))| {
        let mut axis = disabled(POLICY);
        let mut measured = turns(0.2);
        let mut all = run(&mut axis, 1);
        for event in list {
            match event {
                Event::Run(ticks) => all.extend(run(&mut axis, ticks)),
                Event::Silence(ticks) => all.extend((0..ticks).map(|_| axis.tick())),
                // Refusals are part of the game.
                Event::Ask(motion) => drop(ask(&mut axis, &motion)),
                Event::Enable => drop(axis.enable(measured)),
                Event::Disable => axis.disable(),
                Event::Stop => axis.stop(Cause::Requested),
                Event::Missed(ticks) => axis.missed(ticks),
            }
            // The drive follows.
            if let Some(last) = all.last() {
                measured = last.setpoint.angle;
            }
        }
        all.extend(run(&mut axis, 10));
        assert_continuous(&all, &LIMITS);
    });
}
