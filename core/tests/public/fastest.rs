//! The fastest moves that arrive still: durations against the optimum, limits, rest.

use core::f64::consts::PI;

use stillbeam::math::Scalar;
use stillbeam::model::Rod;
use stillbeam::motion::{Path, Spline, Waypoint};
use stillbeam::planner::{FastestMove, Objective, Planner, Request, ShortestMove, Target};
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Angle, Generator, HubState, Limits, Link, Profile, Scene};

/// Member A with 30 g at its tip.
fn member_a() -> Scene {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.00952, bending_stiffness: 0.0213344 });
    scene.payload.mass = 0.03;
    scene
}

/// Member D without a payload.
fn member_d() -> Scene {
    Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
}

fn first_period(arm: &Scene) -> f64 {
    Planner::<f64, 2>::new(arm, 0.01).expect("planner").first_period()
}

/// Half a turn within `limits`, with so short a tick that rounding to it does not count.
fn half_turn<T: Scalar, const N: usize>(arm: &Scene, limits: Limits) -> FastestMove<N> {
    let planner = Planner::<T, 2>::new(arm, first_period(arm) / 2000.0).expect("planner");
    let request = Request::from_rest(0.0, PI).limits(limits).any_deflection();
    planner.fastest(&request).expect("a request").expect("a fastest move")
}

fn acceleration_of(profile: Profile, duration: f64) -> Limits {
    let acceleration = Some(profile.peaks(PI, duration).acceleration);
    Limits { acceleration, ..Limits::default() }
}

fn all_of(profile: Profile, duration: f64) -> Limits {
    let peaks = profile.peaks(PI, duration);
    let jerk = Some(peaks.jerk);
    Limits { rate: Some(peaks.rate), jerk, ..acceleration_of(profile, duration) }
}

/// The optimum, in first periods, was computed apart, by direct collocation with the arm's exact
/// kinematics and two modes.
fn check(arm: &Scene, limits: Limits, optimum: f64, name: &str) {
    check_to(arm, limits, optimum, [1.01, 1.02], name);
}

/// As [`check`], to `most` times the optimum: on a desktop, on a target.
fn check_to(arm: &Scene, limits: Limits, optimum: f64, most: [f64; 2], name: &str) {
    let optimum = optimum * first_period(arm);
    let on_desktop = half_turn::<f64, 24>(arm, limits);
    let on_target = half_turn::<f32, 12>(arm, limits);
    let ratios = [on_desktop.duration() / optimum, on_target.duration() / optimum];
    assert!(ratios[0] < most[0] && ratios[1] < most[1], "{name}: {ratios:?}");
    if let Some(torque) = limits.torque {
        let most = on_desktop.prediction.torque.max(on_target.prediction.torque);
        assert!(most <= torque, "{name}: {most} N m");
    }
    for residual in [on_desktop.prediction.residual, on_target.prediction.residual] {
        assert!(residual < 2e-3 * arm.link.length, "{name}: {residual} m");
    }
    for rows in [on_desktop.waypoints().collect::<Vec<_>>(), on_target.waypoints().collect()] {
        assert_within(&rows, limits, name);
    }
}

/// A path takes the rows within the limits, which it checks on the polynomials.
fn assert_within(rows: &[Waypoint], limits: Limits, name: &str) {
    let start = HubState::resting_at(0.0).expect("an angle");
    let path = Path::new(Spline::Cubic, start, &limits.kinematic(), 0.001).expect("a path");
    for segment in path.segments(rows.iter().copied()) {
        if let Err(error) = segment {
            panic!("{name}: {error}");
        }
    }
    let last = rows.last().expect("a row");
    assert_eq!((last.angle, last.rate), (PI, Some(0.0)), "{name}");
}

#[test]
fn acceleration_binds() {
    let arms = [("A", member_a(), [1.056, 1.658, 2.495]), ("D", member_d(), [1.062, 1.659, 2.495])];
    for (name, arm, optima) in arms {
        for (ratio, optimum) in [1.0, 2.0, 3.0].into_iter().zip(optima) {
            let limits = acceleration_of(Profile::Cubic, ratio * first_period(&arm));
            check(&arm, limits, optimum, &format!("{name}, cubic of {ratio} first periods"));
        }
    }
}

#[test]
fn rate_acceleration_and_jerk_bind() {
    for (name, arm, optima) in [
        ("A", member_a(), [1.216, 1.559, 2.197, 3.032]),
        ("D", member_d(), [1.218, 1.560, 2.198, 3.033]),
    ] {
        for (ratio, optimum) in [1.0, 1.5, 2.0, 3.0].into_iter().zip(optima) {
            let limits = all_of(Profile::SCurve, ratio * first_period(&arm));
            check(&arm, limits, optimum, &format!("{name}, S-curve of {ratio} first periods"));
        }
    }
}

/// Torque and rate are those of a rigid arm that accelerates evenly for a third of the time,
/// acceleration is under twice that of a cubic.
#[test]
fn torque_and_rate_bind() {
    let (a, d) = (member_a(), member_d());
    let of_a = (a.link.mass / 3.0 + a.payload.mass) * a.link.length * a.link.length;
    let of_d = d.link.mass / 3.0 * d.link.length * d.link.length;
    for (name, arm, inertia, optima) in
        [("A", a, of_a, [1.612, 2.143, 3.195]), ("D", d, of_d, [1.621, 2.146, 3.204])]
    {
        for (ratio, optimum) in [1.5, 2.0, 3.0].into_iter().zip(optima) {
            let duration = ratio * first_period(&arm);
            let rigid = Profile::Trapezoid.peaks(PI, duration);
            let limits = Limits {
                rate: Some(rigid.rate),
                acceleration: Some(12.0 * PI / (duration * duration)),
                torque: Some(inertia * rigid.acceleration),
                ..Limits::default()
            };
            check_to(&arm, limits, optimum, [1.015, 1.04], &format!("{name}, {ratio}"));
        }
    }
}

/// A cruise between two ramps: no motion within the rate is shorter than the turn at that rate.
#[test]
fn a_long_move_cruises() {
    let arm = member_a();
    let period = first_period(&arm);
    for (ratio, optimum) in [(5.0, 5.0054), (10.0, 9.6124), (20.0, 18.7326)] {
        let limits = Limits { rate: Some(1.1 * PI / (ratio * period)), ..Limits::default() };
        check(&arm, limits, optimum, &format!("{ratio} first periods"));
        let found = half_turn::<f32, 12>(&arm, limits);
        assert!(found.duration() > ratio / 1.1 * period, "{found:?}");
        assert!(2.0 * found.ramp < 0.5 * found.duration(), "{found:?}");
    }
}

/// The way back is the way there with the other sign.
#[test]
fn a_turn_backwards_mirrors() {
    let arm = member_d();
    let planner = Planner::<f32, 2>::new(&arm, 0.001).expect("planner");
    let limits = all_of(Profile::SCurve, 2.0 * first_period(&arm));
    let plan = |from: f64, to: f64| -> FastestMove<12> {
        let request = Request::from_rest(from, to).limits(limits).any_deflection();
        planner.fastest(&request).expect("a request").expect("a fastest move")
    };
    let (there, back) = (plan(0.5, 2.0), plan(2.0, 0.5));
    assert_eq!(there.ticks, back.ticks);
    assert_eq!(there.knots, back.knots.map(|u| -u));
    assert_eq!(back.waypoints().last().expect("a row").angle, 0.5);
}

/// A generator follows the rows within its limits, and the arm is at rest behind them.
#[test]
fn a_generator_follows_the_rows_and_rests() {
    let arm = member_a();
    let limits = all_of(Profile::SCurve, 3.0 * first_period(&arm));
    let tick = 0.01;
    let planner = Planner::<f32, 2>::new(&arm, tick).expect("planner");
    let plan: ShortestMove<12> = planner
        .plan_fastest(&Request::from_rest(0.0, PI).limits(limits).any_deflection())
        .expect("a plan");
    assert!(matches!(plan, ShortestMove::Fastest(_)), "{plan:?}");
    let rod = Rod::<2>::new(&arm).expect("a rod");
    let stepper =
        Elastica::<f32, 2>::new(&rod, tick, Quality::Fine, rod.bend(limits.acceleration.unwrap()))
            .expect("fit");
    let mut generator = Generator::<_, 8>::new(stepper, 0.0).expect("a generator");
    generator.limit(limits).expect("limits");
    let mut path = generator.path(Spline::Cubic).expect("a path");
    let mut rows = plan.waypoints();
    let mut last = generator.setpoint();
    for _ in 0..=plan.ticks() {
        generator.feed(&mut path, &mut rows).expect("a row");
        last = generator.tick();
    }
    assert!((last.angle.radians() - PI).abs() < 1e-6, "{last:?}");
    let mut left = 0.0_f32;
    for _ in 0..200 {
        left = left.max(generator.tick().deflection().abs());
    }
    assert!(left < 1e-3 * 0.4, "{left} m");
}

/// Requests of another kind are planned as ever.
#[test]
fn other_requests_are_the_planners_own() {
    let mut damped = member_d();
    damped.damping.alpha = 0.1;
    let limits = acceleration_of(Profile::Cubic, 0.4);
    let request = Request::from_rest(0.0, 1.0).limits(limits);
    let planner = Planner::<f32, 2>::new(&damped, 0.01).expect("planner");
    let own = planner.plan(&request).expect("a plan");
    assert_eq!(planner.plan_fastest::<12>(&request), Ok(ShortestMove::Still(own)));
    let free = Planner::<f32, 2>::new(&member_d(), 0.01).expect("planner");
    assert_eq!(free.fastest::<12>(&Request::from_rest(0.0, 1.0)), Ok(None), "no limit");
    assert_eq!(free.fastest::<12>(&request.duration(0.5)), Ok(None), "a duration");
}

/// A move that begins on its way is planned as ever: from rest only is there a fastest one.
#[test]
fn a_moving_start_is_the_planners_own() {
    let planner = Planner::<f32, 2>::new(&member_d(), 0.01).expect("planner");
    let from = HubState { acceleration: 20.0, ..HubState::turning(Angle::from_radians(0.3), 4.0) };
    let limits = Limits { rate: Some(40.0), acceleration: Some(900.0), ..Limits::default() };
    let request = Request::from_hub(from, Target::Angle(1.0)).limits(limits);
    let own = planner.plan(&request).expect("a plan");
    assert_eq!(planner.plan_fastest::<12>(&request), Ok(ShortestMove::Still(own)));
    assert!(own.peaks.rate <= 40.0 && own.peaks.acceleration <= 900.0, "{own:?}");
}

/// Where the frequency is known to a fifth, a move within 9 π/T² leaves 3 % at most in less than
/// two first periods. Less accuracy, a smaller range or more residual take less time.
#[test]
fn a_robust_move_is_as_short_as_its_range_allows() {
    let arm = member_a();
    let period = first_period(&arm);
    let duration = |spread: f64, residual: f64| {
        let planner = Planner::<f64, 2>::robust(&arm, period / 1000.0, spread).expect("planner");
        let acceleration = Some(9.0 * PI / (4.0 * period * period));
        let limits = Limits { acceleration, ..Limits::default() };
        let request = Request::from_rest(0.0, PI).limits(limits).any_deflection();
        let found = planner.fastest::<24>(&request.residual(residual)).expect("a request");
        let found = found.expect("a fastest move");
        assert!(found.peaks.acceleration <= limits.acceleration.unwrap(), "{found:?}");
        found.duration() / period
    };
    let asked = duration(0.2, 0.03);
    assert!(asked < 2.0, "{asked}");
    assert!(duration(0.2, 0.1) < asked - 0.2 && duration(0.1, 0.03) < asked - 0.2);
    // Without a residual that may be left, several arms are the other planner's.
    let robust = Planner::<f32, 2>::robust(&arm, 0.01, 0.2).expect("planner");
    let limits = acceleration_of(Profile::Cubic, 2.0 * period);
    let request = Request::from_rest(0.0, PI).limits(limits);
    assert_eq!(robust.fastest::<12>(&request), Ok(None));
}

/// A residual that may be left never makes a move longer, and is kept.
#[test]
fn a_residual_that_may_be_left_saves_time() {
    for arm in [member_a(), member_d()] {
        let period = first_period(&arm);
        let planner = Planner::<f64, 2>::new(&arm, period / 1000.0).expect("planner");
        let limits = all_of(Profile::SCurve, 2.0 * period);
        let ticks = |residual: f64| {
            let request = Request::from_rest(0.0, PI).limits(limits).any_deflection();
            let found = planner.fastest::<24>(&request.residual(residual)).expect("a request");
            let found = found.expect("a fastest move");
            let most = residual.max(1e-3) * arm.link.length;
            assert!(found.prediction.residual <= most, "{residual}: {found:?}");
            found.ticks
        };
        let [none, little, much] = [0.0, 0.002, 0.02].map(ticks);
        assert!(much < little && little <= none && much < none - 10, "{none} {little} {much}");
    }
    let planner = Planner::<f64, 2>::new(&member_a(), 0.01).expect("planner");
    let request = Request::from_rest(0.0, PI).limits(acceleration_of(Profile::Cubic, 2.0));
    let refused = planner.fastest::<24>(&request.residual(0.3)).expect_err("too much");
    assert!(refused.to_string().contains("request.residual"), "{refused}");
}

/// In a given duration the peak of the acceleration is lower than that of a still move, with both
/// modes at rest; the least effort takes less torque in the mean than the least peak.
#[test]
fn a_given_duration_is_used_for_the_least_peak_or_effort() {
    for (arm, ratio, most) in [(member_d(), 1.0, 11.8), (member_a(), 2.0, 4.1)] {
        let duration = ratio * first_period(&arm);
        let planner = Planner::<f64, 2>::new(&arm, duration / 1000.0).expect("planner");
        let request = Request::from_rest(0.0, PI).duration(duration).any_deflection();
        let plan = |request: &Request<f64, 2>| -> FastestMove<24> {
            planner.gentlest(request).expect("a request").expect("a move")
        };
        let gentle = plan(&request);
        assert_eq!(gentle.ticks, 1000);
        let acceleration = gentle.peaks.acceleration * duration * duration / PI;
        assert!(acceleration < most, "{acceleration}");
        let still = planner.plan(&request).expect("a plan");
        assert!(gentle.peaks.acceleration < still.peaks.acceleration, "{still:?}");
        let easy = plan(&request.objective(Objective::Effort));
        for plan in [&gentle, &easy] {
            assert!(plan.prediction.residual < 1e-3 * arm.link.length, "{plan:?}");
        }
        assert!(easy.prediction.torque < 0.96 * gentle.prediction.torque, "{easy:?}");
        // Within limits.
        let limits = Limits {
            acceleration: Some(1.3 * gentle.peaks.acceleration),
            rate: Some(1.02 * gentle.peaks.rate),
            ..Limits::default()
        };
        let bound = plan(&request.objective(Objective::Effort).limits(limits));
        assert!(bound.peaks.acceleration <= limits.acceleration.unwrap(), "{bound:?}");
        assert!(bound.peaks.rate <= limits.rate.unwrap(), "{bound:?}");
        let tight = Limits { acceleration: Some(0.9 * gentle.peaks.acceleration), ..limits };
        assert_eq!(planner.gentlest::<24>(&request.limits(tight)), Ok(None));
        // Another objective, no duration, or one too short are not its kind.
        for other in [
            request.objective(Objective::Jerk),
            Request::from_rest(0.0, PI).limits(limits),
            request.duration(0.8 * first_period(&arm)),
        ] {
            assert_eq!(planner.gentlest::<24>(&other), Ok(None));
        }
    }
}

/// Without a jump at the ends a move within an acceleration takes a fortieth longer at most. A
/// limit of the jerk asks for it by itself.
#[test]
fn an_eased_move_begins_and_ends_without_acceleration() {
    for arm in [member_a(), member_d()] {
        let period = first_period(&arm);
        let planner = Planner::<f64, 2>::new(&arm, period / 2000.0).expect("planner");
        let plan = |request: Request<f64, 2>| -> FastestMove<24> {
            planner.fastest(&request).expect("a request").expect("a fastest move")
        };
        let of = |limits| Request::from_rest(0.0, PI).limits(limits).any_deflection();
        let limits = acceleration_of(Profile::Cubic, 2.0 * period);
        let request = of(limits);
        let (jumping, eased) = (plan(request), plan(request.eased()));
        assert!(jumping.knots[0] > 1.0 && jumping.peaks.jerk.is_infinite(), "{jumping:?}");
        assert_eq!(eased.knots[0], 0.0);
        assert!(eased.peaks.jerk.is_finite(), "{eased:?}");
        let longer = eased.duration() / jumping.duration();
        assert!(longer > 1.0 && longer < 1.025, "{longer}");
        assert!(eased.peaks.acceleration <= limits.acceleration.unwrap(), "{eased:?}");
        let limited = of(all_of(Profile::SCurve, 2.0 * period));
        assert_eq!(plan(limited), plan(limited.eased()));
        // In a given duration too.
        let request = Request::from_rest(0.0, PI).duration(2.0 * period).any_deflection();
        for objective in [Objective::Acceleration, Objective::Effort] {
            let request = request.objective(objective).eased();
            let plan = planner.gentlest::<24>(&request).expect("a request").expect("a move");
            assert_eq!(plan.knots[0], 0.0, "{objective:?}");
        }
    }
}
