use crate::assert_near;
use stillbeam::hub::HubState;
use stillbeam::model::{EightElements, Rod};
use stillbeam::motion::{Path, Segment, Spline, Waypoint};
use stillbeam::stepper::{Elastica, Modal, Quality, Rigid};
use stillbeam::{Angle, Error, Generator, Limits, Link, Move, Profile, Scene};

pub const TICK: f64 = 0.01;

fn scene() -> Scene {
    Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
}

pub fn rest() -> HubState<f64> {
    HubState::at_rest(Angle::from_radians(0.0))
}

fn path(spline: Spline, start: HubState<f64>) -> Path {
    Path::new(spline, start, &Limits::default(), TICK).expect("a path")
}

pub fn generator() -> Generator<Rigid<f64>, 8> {
    Generator::new(Rigid::new(&scene(), TICK).expect("stepper"), 0.0).expect("generator")
}

fn segments(path: Path, rows: &[Waypoint]) -> Vec<Segment<f64>> {
    path.segments(rows.iter().copied()).map(|segment| segment.expect("a row")).collect()
}

/// The hub from both sides of every border, and at every tick, in s from the path's beginning.
pub fn borders(segments: &[Segment<f64>]) -> Vec<[HubState<f64>; 2]> {
    let mut found = Vec::new();
    for pair in segments.windows(2) {
        let before = pair[1].ticks_before();
        let end = f64::from(pair[0].count()) - before;
        found.push([pair[0].hub_at(end), pair[1].hub_at(-before)]);
    }
    found
}

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

/// A motion that ends inside a tick takes no step with it: the arm behind it vibrates as behind
/// one that ends at the same time in finer ticks.
#[test]
fn a_path_may_end_inside_a_tick() {
    let model = EightElements::consistent(&scene()).expect("model");
    let run = |tick: f64, every: usize| {
        let stepper = Modal::<f64, 2>::new(&model, tick).expect("stepper");
        let mut arm = Generator::<_, 8>::new(stepper, 0.0).expect("generator");
        let mut path = arm.path(Spline::Cubic).expect("a path");
        let rows = [Waypoint::at(0.1337, 0.4).turning(2.0), Waypoint::at(0.2563, 0.7)];
        assert_eq!(arm.feed(&mut path, &mut rows.into_iter()), Ok(true));
        let all = (0..=60 * every).map(|_| arm.tick());
        all.step_by(every).collect::<Vec<_>>()
    };
    let (coarse, fine) = (run(0.01, 1), run(0.0001, 100));
    let swing = fine.iter().map(|s| s.tip[1].abs()).fold(0.0, f64::max);
    for (k, (a, b)) in coarse.iter().zip(&fine).enumerate() {
        assert_near("angle", a.angle.radians(), b.angle.radians(), 1e-12);
        assert_near(&format!("tip at tick {k}"), a.tip[1], b.tip[1], 4e-3 * swing);
    }
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

/// Torque (N m) and residual deflection (of L) of member D with 30 g along a path by 0.8 rad in
/// 1.2 s, in elastica.
fn loads(queue: impl FnOnce(&mut Generator<Elastica<f64, 2>, 8>)) -> [f64; 2] {
    let mut scene = scene();
    scene.payload.mass = 0.03;
    let rod = Rod::<2>::new(&scene).expect("rod");
    let stepper = Elastica::new(&rod, TICK, Quality::Fine, 0.5).expect("stepper");
    let mut arm = Generator::new(stepper, 0.0).expect("generator");
    queue(&mut arm);
    let setpoints: Vec<_> = (0..320).map(|_| arm.tick()).collect();
    assert_near("end", setpoints[120].angle.radians(), 0.8, 1e-12);
    let torque = setpoints.iter().map(|s| s.torque.abs()).fold(0.0, f64::max);
    let residual = setpoints[120..].iter().map(|s| s.tip[1].abs()).fold(0.0, f64::max);
    [torque, residual / 0.4]
}

/// Four waypoints 0.2 rad apart, 0.3 s each: passing them costs a fraction of a stop at each.
#[test]
fn passing_costs_less_than_stopping() {
    let times = [0.3, 0.6, 0.9, 1.2];
    let angles = [0.2, 0.4, 0.6, 0.8];
    let smooth = loads(|arm| {
        arm.push(&Move::To { profile: Profile::Cubic, duration: 1.2, to: 0.8 }).expect("a move");
    });
    let stops = loads(|arm| {
        for to in angles {
            arm.push(&Move::To { profile: Profile::Cubic, duration: 0.3, to }).expect("a move");
        }
    });
    let passes = |spline, rate: Option<f64>| {
        loads(|arm| {
            let mut path = arm.path(spline).expect("a path");
            let mut rows = times.into_iter().zip(angles).map(|(time, angle)| {
                let last = angle == 0.8;
                Waypoint { rate: rate.filter(|_| !last), ..Waypoint::at(time, angle) }
            });
            assert_eq!(arm.feed(&mut path, &mut rows), Ok(true));
        })
    };
    // A stop at each costs eight times the torque of one smooth move and six times the residual.
    assert_near("stops", stops[0] / smooth[0], 7.96, 0.01);
    assert_near("stops", stops[1] / smooth[1], 5.79, 0.01);
    // Through the angles at these times from rest takes 5.36 rad/s² at least, in two stretches of
    // constant acceleration up to the first row; the smooth move takes 3.33.
    for (spline, rate, torque, residual) in [
        (Spline::Cubic, Some(0.8 / 1.2), 2.12, 1.54),
        (Spline::Cubic, None, 1.93, 1.94),
        (Spline::Quintic, Some(0.8 / 1.2), 3.68, 2.36),
        (Spline::Quintic, None, 2.77, 1.35),
    ] {
        let passed = passes(spline, rate);
        assert_near("torque", passed[0] / smooth[0], torque, 0.01);
        assert_near("residual", passed[1] / smooth[1], residual, 0.01);
    }
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
