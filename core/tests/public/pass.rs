//! Moves that pass an angle at a rate, and moves that blend into each other.

use std::f64::consts::TAU;

use crate::assert_near;
use crate::path::{TICK, borders, generator, rest};
use stillbeam::hub::HubState;
use stillbeam::motion::Segment;
use stillbeam::{Angle, Limits, Move, Profile};

/// Every profile from any state to any rate: it begins and ends with what is asked, angle and rate
/// go on within, the acceleration of the smooth ones too, and the stated peaks hold.
#[test]
fn every_profile_leads_from_any_state_to_any_rate() {
    let mut seed = 3u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 23) - 1.0
    };
    for case in 0..400 {
        let profile = Profile::ALL[case % 5];
        let mut start = HubState::turning(Angle::from_radians(2.0 * random()), 3.0 * random());
        start.acceleration = if case % 3 == 0 { 0.0 } else { 20.0 * random() };
        let (to, rate) = (2.0 * random(), if case % 4 == 0 { 0.0 } else { 3.0 * random() });
        let duration = TICK * (20.0 + (60.0 * random().abs()).round());
        let motion = Move::Pass { profile, duration, to, rate };
        let plan = stillbeam::motion::Plan::new(&motion, start, &Limits::default(), TICK);
        let plan = plan.expect("a plan");
        let peaks = plan.summary.peaks;
        let first = plan.segments[0].hub(0);
        assert_eq!((first.angle, first.rate), (start.angle, start.rate), "{motion:?}");
        let smooth = !matches!(profile, Profile::Cubic | Profile::Trapezoid);
        if smooth {
            let bound = 1e-12 * peaks.acceleration;
            assert_near("begin", first.acceleration, start.acceleration, bound);
        }
        assert_eq!(peaks.jerk.is_finite(), smooth, "{motion:?}: {peaks:?}");
        for [left, right] in borders(&plan.segments) {
            assert_near("angle", right.angle.since(left.angle), 0.0, 1e-12);
            assert_near("rate", right.rate, left.rate, 1e-10 * peaks.rate);
            if smooth {
                let bound = 1e-9 * peaks.acceleration;
                assert_near("acceleration", right.acceleration, left.acceleration, bound);
            }
        }
        let last = plan.segments.last().expect("a segment");
        let end = last.hub_at(f64::from(last.count()));
        assert_near("end", end.angle.radians(), to, 1e-12);
        assert_near("end", end.rate, rate, 1e-10 * peaks.rate);
        if smooth {
            assert_near("end", end.acceleration, 0.0, 1e-9 * peaks.acceleration);
        }
        let mut most = [0.0_f64; 2];
        for segment in &plan.segments {
            for i in 0..=20 * segment.count() {
                let ticks = (f64::from(i) / 20.0 - segment.ticks_before()).max(0.0);
                let hub = segment.hub_at(ticks.min(f64::from(segment.count()) - 1.0));
                most = [most[0].max(hub.rate.abs()), most[1].max(hub.acceleration.abs())];
            }
        }
        assert!(most[0] <= peaks.rate * (1.0 + 1e-9), "{motion:?}: {most:?} {peaks:?}");
        assert!(most[1] <= peaks.acceleration * (1.0 + 1e-9), "{motion:?}: {most:?} {peaks:?}");
    }
}

/// From rest to rest a pass is the profile itself, with the profile's peaks.
#[test]
fn a_pass_from_rest_to_rest_is_the_profile() {
    for profile in Profile::ALL {
        let to = Move::To { profile, duration: 0.5, to: 1.3 };
        let pass = Move::Pass { profile, duration: 0.5, to: 1.3, rate: 0.0 };
        let plan = |motion: &Move| {
            stillbeam::motion::Plan::new(motion, rest(), &Limits::default(), TICK).expect("a plan")
        };
        let (a, b) = (plan(&to), plan(&pass));
        assert_near("rate", b.summary.peaks.rate, a.summary.peaks.rate, 1e-9);
        assert_near(
            "acceleration",
            b.summary.peaks.acceleration,
            a.summary.peaks.acceleration,
            1e-8,
        );
        if a.summary.peaks.jerk.is_finite() {
            assert_near("jerk", b.summary.peaks.jerk, a.summary.peaks.jerk, 1e-6);
        }
        let hubs = |plan: &stillbeam::motion::Plan| {
            let of = |s: &Segment<f64>| {
                let s = *s;
                (0..s.count()).map(move |k| s.hub(k))
            };
            plan.segments.iter().flat_map(of).collect::<Vec<_>>()
        };
        for (k, (a, b)) in hubs(&a).iter().zip(&hubs(&b)).enumerate() {
            assert_near(&format!("{profile} {k}"), b.angle.radians(), a.angle.radians(), 1e-12);
            assert_near(profile.name(), b.rate, a.rate, 1e-10);
            assert_near(profile.name(), b.acceleration, a.acceleration, 1e-8);
        }
        for (a, b) in a.segments.iter().zip(&b.segments) {
            assert_near(profile.name(), b.kink_moment(), a.kink_moment(), 1e-7);
        }
    }
}

/// A move behind a spin-up: back to an angle that lies ahead, without a stop before it.
#[test]
fn a_move_begins_behind_a_turning_hub() {
    let mut arm = generator();
    arm.push(&Move::SpinUp { duration: 1.0, rate: 3.0 }).expect("spin-up");
    let to = 0.5 * 3.0 + 2.0;
    let pass = Move::Pass { profile: Profile::SCurve, duration: 1.0, to, rate: 0.0 };
    arm.push(&pass).expect("a move");
    let hubs: Vec<_> = (0..=210).map(|_| arm.tick()).collect();
    for pair in hubs.windows(2) {
        let step = (pair[1].rate - pair[0].rate).abs();
        assert!(step < 0.2, "{pair:?}");
    }
    assert_near("angle", hubs[200].angle.in_turns(), to / TAU, 1e-12);
    assert_near("rate", hubs[210].rate, 0.0, 0.0);
}

/// Moves one way pass their corners without a stop, within the limits; where the way turns back
/// they stop.
#[test]
fn moves_blend_where_the_limits_allow_it() {
    let to = |to| Move::To { profile: Profile::Quintic, duration: 0.3, to };
    let moves = [to(0.2), to(0.4), to(0.6), to(0.3), to(0.0)];
    let run = |acceleration: f64| {
        let limits = Limits { acceleration: Some(acceleration), ..Limits::default() };
        let (mut start, mut rates) = (rest(), Vec::new());
        for (i, motion) in moves.iter().enumerate() {
            let blended = motion.blended(moves.get(i + 1), start, &limits, TICK).expect("fits");
            let plan = stillbeam::motion::Plan::new(&blended, start, &limits, TICK).expect("fits");
            start = plan.summary.end;
            rates.push(start.rate);
        }
        rates
    };
    let free = run(1e3);
    assert_near("corner", free[0], 0.2 / 0.3, 1e-12);
    assert_near("corner", free[1], 0.2 / 0.3, 1e-12);
    assert_near("back", free[2], 0.0, 0.0);
    assert_near("corner", free[3], -1.0, 1e-12);
    assert_near("end", free[4], 0.0, 0.0);
    // From rest to rest 0.3 rad in 0.3 s takes 19.25 rad/s²; to pass a corner takes less.
    assert_eq!(run(19.3), free);
    let stopped = Limits { acceleration: Some(19.0), ..Limits::default() };
    let start = HubState::at_rest(Angle::from_radians(0.6));
    assert!(moves[3].blended(Some(&moves[4]), start, &stopped, TICK).is_err());
}
