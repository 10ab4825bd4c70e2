//! The curve of a path.

use crate::assert_near;
use stillbeam::hub::HubState;
use stillbeam::motion::{Path, Spline, Waypoint};
use stillbeam::{Angle, Error, Limits, Move, Profile};

use super::{TICK, borders, generator, path, rest, segments};

/// Whatever the rows: angle and rate go on at every border; a quintic spline's acceleration too,
/// and a cubic one's at rows without a rate. Times need not be whole ticks.
#[test]
fn a_path_is_as_continuous_as_promised() {
    let mut seed = 7u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24)
    };
    for case in 0..60 {
        let spline = Spline::ALL[case % 2];
        let with_rates = case % 3 == 0;
        let mut time = 0.0;
        let rows: Vec<_> = (0..40)
            .map(|_| {
                time += 0.02 + 0.1 * random();
                let row = Waypoint::at(time, 0.2 * random());
                if with_rates { row.turning(2.0 * random() - 1.0) } else { row }
            })
            .collect();
        let start = HubState { acceleration: 3.0, ..HubState::turning(rest().angle, 0.7) };
        let all = segments(path(spline, start), &rows);
        let peaks = *path(spline, start).survey(rows.iter().copied()).expect("rows").peaks();
        for [left, right] in borders(&all) {
            assert_near("angle", right.angle.since(left.angle), 0.0, 1e-12);
            assert_near("rate", right.rate, left.rate, 1e-9 * peaks.rate);
            if spline == Spline::Quintic || !with_rates {
                let most = if spline == Spline::Quintic { 1e-9 } else { 2e-6 };
                let bound = most * peaks.acceleration;
                assert_near("acceleration", right.acceleration, left.acceleration, bound);
            }
        }
        // The peaks are those between the ticks, and are reached.
        let mut most = [0.0_f64; 2];
        for segment in &all {
            for i in 0..=40 * segment.count() {
                let last = f64::from(segment.count()) - 1.0;
                let hub = segment.hub_at((f64::from(i) / 40.0).min(last.max(0.0)));
                most = [most[0].max(hub.rate.abs()), most[1].max(hub.acceleration.abs())];
            }
        }
        assert!(most[0] <= peaks.rate * (1.0 + 1e-9), "{most:?} {peaks:?}");
        assert!(most[1] <= peaks.acceleration * (1.0 + 1e-9), "{most:?} {peaks:?}");
        assert!(most[0] > 0.9 * peaks.rate, "{most:?} {peaks:?}");
    }
}

/// A path passes its rows, at the rates that they give, and ends exactly at the last.
#[test]
fn a_path_passes_its_rows() {
    let rows = [
        Waypoint::at(0.1, 0.3).turning(1.0),
        Waypoint::at(0.2, 0.1).turning(-2.0).accelerating(5.0),
        Waypoint::at(0.35, 0.5),
    ];
    let mut arm = generator();
    let mut path = arm.path(Spline::Quintic).expect("a path");
    assert_eq!(arm.feed(&mut path, &mut rows.into_iter()), Ok(true));
    let hubs: Vec<_> = (0..=40).map(|_| arm.tick()).collect();
    for (k, angle, rate, acceleration) in
        [(10, 0.3, 1.0, None), (20, 0.1, -2.0, Some(5.0)), (35, 0.5, 0.0, Some(0.0))]
    {
        assert_near("angle", hubs[k].angle.radians(), angle, 1e-15);
        assert_near("rate", hubs[k].rate, rate, 1e-13);
        if let Some(acceleration) = acceleration {
            assert_near("acceleration", hubs[k].acceleration, acceleration, 1e-11);
        }
    }
    assert_eq!(hubs[40].angle, hubs[35].angle);
    assert!(arm.is_holding());
}

/// The cubic spline through samples of a cubic polynomial is that polynomial, whatever the times.
#[test]
fn a_spline_reproduces_a_cubic() {
    let at = |t: f64| (0.2 + 0.5 * t - 3.0 * t * t + 2.0 * t * t * t, 0.5 - 6.0 * t + 6.0 * t * t);
    let times = [0.013, 0.08, 0.0931, 0.2, 0.27, 0.3333, 0.5];
    let mut rows: Vec<_> = times.iter().map(|&t| Waypoint::at(t, at(t).0)).collect();
    let last = rows.len() - 1;
    rows[last] = rows[last].turning(at(0.5).1);
    let start = HubState::turning(Angle::from_radians(0.2), 0.5);
    let mut k = 0;
    for segment in segments(path(Spline::Cubic, start), &rows) {
        for i in 0..segment.count() {
            let (angle, rate) = at(f64::from(k) * TICK);
            let hub = segment.hub(i);
            assert_near("angle", hub.angle.radians(), angle, 1e-14);
            assert_near("rate", hub.rate, rate, 1e-13);
            k += 1;
        }
    }
    assert_eq!(k, 50);
}

/// Time reversal and mirror: the spline of the rows read backwards is the spline backwards, and
/// that of the rows with the other sign has the other sign.
#[test]
fn a_path_backwards_and_in_the_mirror_is_the_same_path() {
    let angles = [0.0, 0.4, 0.1, -0.6, 0.2, 0.3];
    let times = [0.0, 0.1, 0.25, 0.3, 0.47, 0.6];
    for spline in Spline::ALL {
        let run = |rows: Vec<Waypoint>, from: f64| {
            let start = HubState::at_rest(Angle::from_radians(from));
            let all = segments(path(spline, start), &rows);
            all.iter().flat_map(|s| (0..s.count()).map(|k| s.hub(k))).collect::<Vec<_>>()
        };
        let row = |i: usize, sign: f64| Waypoint::at(times[i], sign * angles[i]);
        let forth = run((1..6).map(|i| row(i, 1.0)).collect(), 0.0);
        let mirrored = run((1..6).map(|i| row(i, -1.0)).collect(), 0.0);
        let back = |i: usize| Waypoint::at(0.6 - times[i], angles[i]);
        let back = run((0..5).rev().map(back).collect(), angles[5]);
        assert_eq!(forth.len(), 60);
        for k in 1..60 {
            let (a, b, c) = (forth[k], back[60 - k], mirrored[k]);
            assert_near("angle", b.angle.since(a.angle), 0.0, 1e-13);
            assert_near("rate", b.rate, -a.rate, 1e-11);
            assert_near("acceleration", b.acceleration, a.acceleration, 1e-8);
            assert_near("mirror", c.angle.in_turns(), -a.angle.in_turns(), 1e-15);
            assert_near("mirror", c.rate, -a.rate, 1e-13);
        }
    }
}

/// A quintic path begins with the acceleration that it is given, or with the hub's, and hands the
/// last row's on to what follows.
#[test]
fn a_quintic_begins_and_ends_with_an_acceleration() {
    let mut arm = generator();
    let first = [Waypoint::at(0.2, 0.3).turning(2.0).accelerating(7.0)];
    let mut begun = arm.path(Spline::Quintic).expect("a path").beginning_with(5.0).expect("begun");
    assert_eq!(arm.feed(&mut begun, &mut first.into_iter()), Ok(true));
    assert!(begun.peaks().jerk.is_infinite(), "the hub had no acceleration");
    // A path behind it goes on from there, and so does a move.
    let mut second = arm.path(Spline::Quintic).expect("a path");
    assert_eq!(second.start().acceleration, 7.0);
    let rows = [Waypoint::at(0.1, 0.6).turning(3.0).accelerating(-4.0)];
    assert_eq!(arm.feed(&mut second, &mut rows.into_iter()), Ok(true));
    let pass = Move::Pass { profile: Profile::Quintic, duration: 0.3, to: 1.0, rate: 0.0 };
    let summary = arm.push(&pass).expect("a move");
    assert!(summary.peaks.jerk.is_finite(), "its acceleration goes on");
    let hubs: Vec<_> = (0..=60).map(|_| arm.tick()).collect();
    for (k, acceleration) in [(0, 5.0), (20, 7.0), (30, -4.0), (60, 0.0)] {
        assert_near("acceleration", hubs[k].acceleration, acceleration, 1e-10);
    }
    assert_near("the end", hubs[60].angle.radians(), 1.0, 1e-14);
}

/// An acceleration that the hub does not have jumps: a limit of jerk refuses it, as a cubic spline
/// does, which has its own.
#[test]
fn an_acceleration_at_the_beginning_may_be_refused() {
    let limits = Limits { jerk: Some(1e4), ..Limits::default() };
    let rows = [Waypoint::at(0.5, 0.2)];
    let path = Path::new(Spline::Quintic, rest(), &limits, TICK).expect("a path");
    assert!(path.survey(rows).is_ok());
    let error = path.beginning_with(0.1).expect("begun").survey(rows).expect_err("a jump");
    assert_eq!(error.row, 0);
    assert!(matches!(error.error, Error::LimitExceeded { parameter: "limits.jerk", .. }));
    let turning = HubState { acceleration: 0.1, ..rest() };
    let path = Path::new(Spline::Quintic, turning, &limits, TICK).expect("a path");
    assert!(path.beginning_with(0.1).expect("begun").survey(rows).is_ok(), "the hub has it");
    let cubic = Path::new(Spline::Cubic, rest(), &limits, TICK).expect("a path");
    let error = cubic.beginning_with(0.1).expect_err("a cubic").to_string();
    assert_eq!(error, "waypoint.acceleration = 0.1: must be 0 rad/s^2");
}
