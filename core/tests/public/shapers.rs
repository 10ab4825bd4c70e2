//! Input shapers: their tables, and what a shaped motion leaves.

use std::f64::consts::TAU;

use stillbeam::hub::HubState;
use stillbeam::motion::{Limits, Plan, Pulse, Segment, Shaped, Shaper, ShaperKind};
use stillbeam::{Move, Profile};

/// Vibration that a table leaves of an oscillator's, of that of one pulse.
fn vibration(shaper: &Shaper, frequency: f64, damping: f64) -> f64 {
    let omega = TAU * frequency;
    let damped = omega * (1.0 - damping * damping).sqrt();
    let (mut sin, mut cos) = (0.0, 0.0);
    for Pulse { amplitude, delay } in shaper.pulses() {
        let grown = amplitude * (damping * omega * delay).exp();
        sin += grown * (damped * delay).sin();
        cos += grown * (damped * delay).cos();
    }
    (-damping * omega * shaper.delay()).exp() * f64::hypot(sin, cos)
}

#[test]
fn tables_leave_what_their_names_say() {
    for frequency in [0.1, 1.3, 47.0] {
        for damping in [0.0, 0.05] {
            for kind in ShaperKind::ALL {
                let shaper = Shaper::new(kind, frequency, damping).expect("a table");
                let sum: f64 = shaper.pulses().iter().map(|pulse| pulse.amplitude).sum();
                assert!((sum - 1.0).abs() < 1e-12);
                let at = |error: f64| vibration(&shaper, frequency * (1.0 + error), damping);
                let (nominal, aside) = (at(0.0), at(0.05));
                match kind {
                    ShaperKind::Zv | ShaperKind::Mzv => {
                        assert!(
                            nominal < 1e-9 || kind == ShaperKind::Mzv && nominal < 0.01,
                            "{nominal}"
                        );
                        assert!(aside > 0.02);
                    }
                    ShaperKind::Zvd => assert!(nominal < 1e-9 && aside < 0.01, "{nominal} {aside}"),
                    ShaperKind::Ei => assert!((nominal - 0.05).abs() < 0.01 && aside < 0.05),
                    ShaperKind::TwoHumpEi => {
                        assert!(nominal < 0.06 && at(0.15) < 0.06, "{nominal}")
                    }
                    _ => panic!("what {kind} must leave is not told here"),
                }
                let period = 1.0 / (frequency * (1.0 - damping * damping).sqrt());
                assert!((shaper.delay() - kind.periods() * period).abs() < 1e-9 * period);
            }
        }
    }
}

#[test]
fn tables_that_make_no_sense_are_refused() {
    let pulse = |amplitude, delay| Pulse { amplitude, delay };
    assert!(Shaper::custom(&[]).is_err());
    assert!(Shaper::custom(&[pulse(1.0, 0.1), pulse(1.0, 0.0)]).is_err());
    assert!(Shaper::custom(&[pulse(1.0, 0.0), pulse(-1.0, 0.1)]).is_err());
    assert!(Shaper::custom(&[pulse(1.0, 0.0); 6]).is_err());
    assert!(Shaper::custom(&[pulse(f64::NAN, 0.0)]).is_err());
    assert!(Shaper::new(ShaperKind::Zv, 0.001, 0.0).is_err());
    let one = Shaper::custom(&[pulse(3.0, 0.0), pulse(1.0, 0.3)]).expect("a table");
    assert_eq!(one.pulses()[0].amplitude, 0.75);
}

/// Seven segments, delays that are no whole ticks: at every tick what the sum of the delayed
/// motions is, in f32 too.
#[test]
fn a_shaped_motion_is_the_sum_of_its_delayed_copies() {
    let motion = Move::To { profile: Profile::SCurve, duration: 0.83, to: -7.0 };
    let plan =
        Plan::new(&motion, HubState::resting_at(2.0).unwrap(), &Limits::default(), 0.01).unwrap();
    let shaper = Shaper::new(ShaperKind::Ei, 1.237, 0.02).expect("a table");
    let single: Vec<Segment<f32>> = plan.segments.iter().map(Segment::cast).collect();
    let (exact, single) =
        (Shaped::new(&plan.segments, &shaper, 0.01), Shaped::new(&single, &shaper, 0.01));
    assert_eq!(exact.ticks(), 83 + (shaper.delay() / 0.01).ceil() as u32);
    let end = exact.ticks();
    assert_eq!(exact.hub(0).angle.radians(), 2.0);
    assert!((exact.hub(end).angle.radians() + 7.0).abs() < 1e-12);
    assert_eq!((exact.hub(end).rate, exact.hub(end).acceleration), (0.0, 0.0));
    let (mut rate, mut turned) = (0.0, 0.0);
    for k in 0..end {
        let (here, next) = (exact.hub(k), exact.hub(k + 1));
        // The angle is the integral of the rate.
        let step = next.angle.radians() - here.angle.radians();
        assert!((step - 0.005 * (here.rate + next.rate)).abs() < 2e-3, "{k}");
        rate = f64::max(rate, here.rate.abs());
        turned += step;
        let coarse = single.hub(k);
        assert!((coarse.angle.radians() - here.angle.radians()).abs() < 5e-6, "{k}");
        assert!((f64::from(coarse.rate) - here.rate).abs() < 1e-4, "{k}");
    }
    assert!((turned + 9.0).abs() < 1e-9);
    assert!(rate < 1.75 * 9.0 / 0.83);
}

/// `∫₀¹(1 − s)θ̈ ds` beyond the parabola's, from the angles and rates at both ends.
fn moment(before: &HubState<f64>, after: &HubState<f64>, tick: f64) -> f64 {
    let turned = TAU * after.angle.since(before.angle);
    let mean = (after.rate - before.rate) / tick;
    let parabola = 0.5 * mean + (before.acceleration - after.acceleration) / 12.0;
    (turned - tick * before.rate) / (tick * tick) - parabola
}

/// Every tick of every profile behind every shaper, delays that are no whole ticks.
#[test]
fn kinks_have_the_moments_of_the_motion() {
    let tick = 0.01;
    let to = |profile| Move::To { profile, duration: 0.31, to: 1.0 };
    for motion in Profile::ALL.map(to) {
        let start = HubState::resting_at(0.0).expect("start");
        let plan = Plan::new(&motion, start, &Limits::default(), tick).expect("plan");
        let peak = plan.summary.peaks.acceleration;
        for kind in ShaperKind::ALL {
            let shaper = Shaper::new(kind, 31.7, 0.01).expect("a table");
            let shaped = Shaped::new(&plan.segments, &shaper, tick);
            let mut kinks = 0;
            for k in 0..shaped.ticks() {
                let expected = moment(&shaped.hub(k), &shaped.arrival(k + 1), tick);
                let kink = shaped.kink(k);
                kinks += usize::from(!kink.is_none());
                let error = (kink.moment() - expected).abs();
                assert!(error < 1e-4 * peak, "{motion:?} {kind:?} {k}: {error} of {peak}");
            }
            assert!(kinks >= shaper.pulses().len(), "{motion:?} {kind:?}: {kinks}");
        }
    }
}

/// A shaper of one pulse leaves the motion as it is, and the planner's own moments with it.
#[test]
fn one_pulse_gives_the_moments_of_the_segments() {
    let motion = Move::To { profile: Profile::Trapezoid, duration: 0.31, to: 1.0 };
    let start = HubState::resting_at(0.0).expect("start");
    let plan = Plan::new(&motion, start, &Limits::default(), 0.01).expect("plan");
    let shaper = Shaper::custom(&[Pulse { amplitude: 1.0, delay: 0.0 }]).expect("a table");
    let shaped = Shaped::new(&plan.segments, &shaper, 0.01);
    let (mut first, mut landing) = (0, 0.0);
    for segment in &plan.segments {
        if first > 0 {
            // A generator's parabola ends at the border's left-hand value.
            let beyond = (shaped.arrival(first).acceleration - landing) / 12.0;
            let expected = segment.kink_moment() + beyond;
            let moment = shaped.kink(first - 1).moment();
            assert!((moment - expected).abs() < 1e-9, "{moment} is not {expected}");
            assert!(expected.abs() > 0.1);
        }
        first += segment.count();
        landing = segment.end_acceleration();
    }
    assert!(shaped.kink(first - 1).is_none(), "the end is a tick");
}

/// A copy that begins or ends on a tick makes its two sides differ and leaves nothing inside.
#[test]
fn jumps_on_a_tick_are_of_its_sides() {
    let motion = Move::To { profile: Profile::Cubic, duration: 0.2, to: 1.0 };
    let start = HubState::resting_at(0.0).expect("start");
    let plan = Plan::new(&motion, start, &Limits::default(), 0.01).expect("plan");
    let pulses = [0.0, 0.07].map(|delay| Pulse { amplitude: 0.5, delay });
    let shaper = Shaper::custom(&pulses).expect("a table");
    let shaped = Shaped::new(&plan.segments, &shaper, 0.01);
    let jump = 3.0 / (0.2 * 0.2);
    for k in 0..=shaped.ticks() {
        assert!(k == shaped.ticks() || shaped.kink(k).is_none(), "{k}");
        let jumped = shaped.hub(k).acceleration - shaped.arrival(k).acceleration;
        let expected = if [0, 7, 20, 27].contains(&k) { jump } else { 0.0 };
        assert!((jumped - expected).abs() < 1e-9, "{k}: {jumped}");
    }
}
