use stillbeam::hub::HubState;
use stillbeam::model::Rod;
use stillbeam::planner::{Planner, Request, Target};
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Damping, Error, Generator, Limits, Link, Scene, Setpoint};

const TICK: f64 = 0.01;

/// Member A with 30 g.
fn scene(damping: Damping) -> Scene {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.00952, bending_stiffness: 0.0213344 });
    scene.payload.mass = 0.03;
    scene.damping = damping;
    scene
}

type Arm = Generator<Elastica<f32, 2>, 8>;

fn arm(scene: &Scene) -> Arm {
    let rod = Rod::<2>::new(scene).expect("rod");
    let stepper = Elastica::<f32, 2>::new(&rod, TICK, Quality::Fine, 1.0).expect("stepper");
    Arm::new(stepper, 0.0).expect("generator")
}

/// Ticks on, and returns the setpoints.
fn run(arm: &mut Arm, ticks: u32) -> Vec<Setpoint<f32>> {
    (0..ticks).map(|_| arm.tick()).collect()
}

/// Half the swing of the tip, of L.
fn swing(setpoints: &[Setpoint<f32>]) -> f32 {
    let tips = || setpoints.iter().map(|s| s.tip[1]);
    0.5 * (tips().fold(f32::MIN, f32::max) - tips().fold(f32::MAX, f32::min)) / 0.4
}

/// From rest through two angles at a rate, the arm at rest relative to the hub at each, and to
/// rest.
#[test]
fn an_arm_rests_on_a_hub_that_turns() {
    for damping in [Damping { alpha: 0.0, beta: 0.0 }, Damping { alpha: 0.3, beta: 1e-3 }] {
        let scene = scene(damping);
        let planner = Planner::<f32, 2>::new(&scene, TICK).expect("planner");
        let mut arm = arm(&scene);
        let duration = 1.6 * planner.first_period();
        let plan = |arm: &mut Arm, to: f64, rate: f64| {
            let mut ahead = arm.clone();
            ahead.tick();
            let bent = ahead.stepper().arm_state(ahead.state(), ahead.hub());
            let request = Request::from_hub(ahead.hub().precise(), Target::Angle(to))
                .arm(bent)
                .passing(rate)
                .duration(duration);
            let plan = planner.plan(&request).expect("a plan");
            arm.redirect(0, &plan).expect("from here");
            assert!(plan.residual < 1e-3, "{plan:?}");
            run(arm, plan.ticks)
        };
        let moving = plan(&mut arm, 3.0, 3.0);
        assert!(swing(&moving) > 0.05, "{}", swing(&moving));
        let passing = run(&mut arm, 120);
        assert!(passing.iter().all(|s| s.rate == 3.0 && s.acceleration == 0.0));
        assert!(swing(&passing) < 1e-3, "{damping:?}: {} of L", swing(&passing));
        let from = arm.hub().angle.radians();
        plan(&mut arm, from + 6.0, 4.0);
        let passing = run(&mut arm, 120);
        assert!(swing(&passing) < 1e-3, "{damping:?}: {} of L", swing(&passing));
        let from = arm.hub().angle.radians();
        plan(&mut arm, from + 4.0, 0.0);
        let still = run(&mut arm, 120);
        assert!(swing(&still) < 1e-3, "{damping:?}: {} of L", swing(&still));
        println!("{damping:?}: {} {} {}", swing(&moving), swing(&passing), swing(&still));
    }
}

/// Under gravity no arm rests on a hub that turns; a queue of moves from rest to rest takes no
/// move that ends turning; a stop ends at rest.
#[test]
fn a_passing_move_is_refused_where_it_cannot_be() {
    let mut scene = scene(Damping { alpha: 0.0, beta: 0.0 });
    let planner = Planner::<f32, 2>::new(&scene, TICK).expect("planner");
    let request = Request::from_rest(0.0, 1.0).passing(2.0).duration(1.5);
    let plan = planner.plan(&request).expect("a plan");
    assert!(arm(&scene).push(&plan.motion()).is_err());
    let stop = Request { target: Target::Stop, ..request };
    let named = |error: Error| matches!(error, Error::OutOfRange { parameter: "request.rate", .. });
    assert!(named(planner.plan(&stop).expect_err("no stop")));
    let limits = Limits { rate: Some(1.0), ..Limits::default() };
    let slow = planner.plan(&request.limits(limits)).expect_err("2 rad/s are above the limit");
    assert!(matches!(slow, Error::LimitExceeded { parameter: "limits.rate", .. }), "{slow}");
    scene.gravity = 0.5;
    let planner = Planner::<f32, 2>::new(&scene, TICK).expect("planner");
    assert!(named(planner.plan(&request).expect_err("no rest")));
    let rest = HubState::<f64>::resting_at(0.0).expect("an angle");
    assert!(planner.plan(&Request::from_hub(rest, Target::Angle(1.0)).duration(1.5)).is_ok());
}
