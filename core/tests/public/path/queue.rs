//! Rows that come one by one.

use crate::assert_near;
use stillbeam::motion::{Path, Spline, Waypoint};
use stillbeam::{Error, Limits, Move, Profile};

use super::{TICK, generator, path, rest};

/// Ten thousand rows run through a queue of eight: what comes out is what `segments` has.
#[test]
fn a_long_path_runs_through_a_short_queue() {
    let rows = || {
        (1..=10_000u32).map(|i| {
            let t = 0.025 * f64::from(i);
            Waypoint::at(t, (0.9 * t).sin() + 0.3 * (3.1 * t).cos() - 0.3)
        })
    };
    let mut arm = generator();
    let mut path = arm.path(Spline::Cubic).expect("a path");
    let mut left = rows();
    let whole = path.clone().segments(rows()).map(|segment| segment.expect("a row"));
    let expected: Vec<_> =
        whole.flat_map(|s| (0..s.count()).map(move |k| s.hub(k))).map(|hub| hub.angle).collect();
    assert_eq!(expected.len(), 25_000);
    for (k, expected) in expected.iter().enumerate() {
        arm.feed(&mut path, &mut left).expect("rows");
        assert_eq!(arm.tick().angle, *expected, "tick {k}");
    }
    assert!(path.is_done() && !arm.is_holding());
    assert_near("end", arm.tick().rate, 0.0, 0.0);
}

/// Rows that come too late: the hub stops along the path behind the last one, within the limits,
/// and the next row is refused.
#[test]
fn a_starved_path_stops_within_its_limits() {
    let mut arm = generator();
    let limits = Limits { acceleration: Some(20.0), rate: Some(3.0), ..Limits::default() };
    arm.limit(limits).expect("limits");
    let mut path = arm.path(Spline::Cubic).expect("a path");
    path.offer(Waypoint::at(0.2, 0.15).turning(1.5)).expect("a row");
    assert_eq!(arm.advance(&mut path), Ok(false));
    let mut before = arm.tick();
    let mut furthest = 0.0_f64;
    for k in 1..100 {
        if k == 25 {
            path.offer(Waypoint::at(0.3, 0.3).turning(1.5))
                .expect("its time is after the last row's");
            let error = arm.advance(&mut path).expect_err("too late");
            assert_eq!((error.row, error.error), (1, Error::Starved));
        }
        let now = arm.tick();
        assert!(now.acceleration.abs() <= 20.0 + 1e-9, "{now:?}");
        assert!((now.rate - before.rate).abs() <= 0.2 + 1e-9, "{before:?} {now:?}");
        assert!(now.rate >= 0.0, "{now:?}");
        furthest = furthest.max(now.angle.radians());
        before = now;
    }
    assert_near("rest", before.rate, 0.0, 0.0);
    assert!(furthest > 0.15 + 0.04 && furthest < 0.4, "{furthest}");
    // A new path begins at rest.
    let mut path = arm.path(Spline::Cubic).expect("a path");
    let rows = [Waypoint::at(0.5, 0.0)];
    assert_eq!(arm.feed(&mut path, &mut rows.into_iter()), Ok(true));
}

/// A faulty row is named, with its number; the rows before it stay.
#[test]
fn a_bad_row_is_named() {
    let bad = |row: Waypoint, spline: Spline| {
        let mut path = path(spline, rest());
        path.offer(Waypoint::at(0.1, 0.1)).expect("a row");
        let error = path.offer(row).expect_err("a bad row");
        assert_eq!(error.row, 1);
        path.offer(Waypoint::at(0.2, 0.1)).expect("nothing has changed");
        error.to_string()
    };
    for (row, text) in [
        (Waypoint::at(0.1, 0.2), "waypoints[1]: waypoint.time = 0.1: must be 0.10001"),
        (Waypoint::at(0.05, 0.2), "waypoints[1]: waypoint.time = 0.05: must be 0.10001"),
        (Waypoint::at(f64::NAN, 0.2), "waypoints[1]: waypoint.time = NaN"),
        (Waypoint::at(0.2, f64::INFINITY), "waypoints[1]: waypoint.angle = inf"),
        (Waypoint::at(0.2, 0.2).turning(f64::NAN), "waypoints[1]: waypoint.rate = NaN"),
    ] {
        let error = bad(row, Spline::Quintic);
        assert!(error.starts_with(text), "{error}");
    }
    let error = bad(Waypoint::at(0.2, 0.2).accelerating(1.0), Spline::Cubic);
    assert!(error.contains("waypoint.acceleration = 1: must be 0 rad/s^2"), "{error}");
    // A limit is held between the rows: 1 rad in 0.1 s peaks at 13.6 rad/s.
    let limits = Limits { rate: Some(13.0), ..Limits::default() };
    let path = Path::new(Spline::Cubic, rest(), &limits, TICK).expect("a path");
    let rows = [Waypoint::at(0.5, 0.0), Waypoint::at(0.6, 1.0).turning(0.0)];
    let error = path.survey(rows).expect_err("too fast");
    assert_eq!(error.row, 1);
    assert!(matches!(error.error, Error::LimitExceeded { parameter: "limits.rate", .. }));
}

/// A move behind a path that ends inside a tick begins at the next one.
#[test]
fn a_move_follows_a_path() {
    let mut arm = generator();
    let mut path = arm.path(Spline::Quintic).expect("a path");
    let rows = [Waypoint::at(0.105, 0.5), Waypoint::at(0.2222, 1.0)];
    assert_eq!(arm.feed(&mut path, &mut rows.into_iter()), Ok(true));
    arm.push(&Move::To { profile: Profile::Quintic, duration: 0.2, to: 0.0 }).expect("a move");
    let hubs: Vec<_> = (0..=50).map(|_| arm.tick()).collect();
    assert_near("path", hubs[23].angle.radians(), 1.0, 1e-15);
    assert_near("middle", hubs[33].angle.radians(), 0.5, 1e-12);
    assert_near("end", hubs[43].angle.radians(), 0.0, 1e-15);
    // The path is over.
    let error = arm.advance(&mut path).expect("nothing is left");
    assert!(error);
}

/// A cycle repeats without a stop: from the second round on every round is the same.
#[test]
fn a_cycle_repeats() {
    let rows = [0.3, 0.5, -0.1, 0.0].map(|angle| angle).into_iter().enumerate();
    let rows: Vec<_> =
        rows.map(|(i, angle)| Waypoint::at(0.15 * (i as f64 + 1.0), angle)).collect();
    let cycle =
        |i: u32| rows.clone().into_iter().map(move |row| row.shifted(0.6 * f64::from(i), 0.0));
    let mut left = (0..20).flat_map(cycle);
    let mut arm = generator();
    let mut path = arm.path(Spline::Quintic).expect("a path");
    let mut hubs = Vec::new();
    for _ in 0..=1200 {
        arm.feed(&mut path, &mut left).expect("rows");
        hubs.push(arm.tick());
    }
    for k in 480..720 {
        let (a, b) = (hubs[k], hubs[k + 60]);
        assert_near("angle", b.angle.radians(), a.angle.radians(), 1e-9);
        assert_near("rate", b.rate, a.rate, 1e-6);
    }
    assert!(hubs[600].rate.abs() > 0.5, "{:?}", hubs[600]);
    assert_near("end", hubs[1200].rate, 0.0, 0.0);
}

/// Pieces that are planned beside the ticks and handed over are those of a path that is fed, to the
/// bit, through any room; one that is not the path's next is refused.
#[test]
fn pieces_planned_beside_the_ticks_are_those_of_feeding() {
    let rows: Vec<_> =
        (1..60).map(|k| Waypoint::at(0.05 * f64::from(k), 0.1 * f64::from(k % 4))).collect();
    let (mut fed, mut taken) = (generator(), generator());
    let mut path = fed.path(Spline::Cubic).expect("a path");
    let mut own = taken.path(Spline::Cubic).expect("a path");
    let (mut left, mut waiting) = (rows.iter().copied(), rows.iter().copied());
    let mut refused = 0;
    for _ in 0..400 {
        fed.feed(&mut path, &mut left).expect("rows");
        while own.has_room() {
            match waiting.next() {
                Some(row) => own.offer(row).expect("a row"),
                None => own.close(),
            }
        }
        while let Some(piece) = own.next_piece().expect("a piece") {
            if !taken.take_piece(&mut own, &piece).expect("room or none") {
                refused += 1;
                break;
            }
            let again = taken.take_piece(&mut own, &piece).expect_err("it has been taken");
            assert_eq!(again.error, Error::Stale);
            if own.has_room() {
                break;
            }
        }
        assert_eq!(fed.tick(), taken.tick());
    }
    assert!(refused > 10 && own.is_done() && taken.is_holding(), "{refused}");
}
