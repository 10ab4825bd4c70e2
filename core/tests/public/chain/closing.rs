//! A chain that closes while it runs.

use stillbeam::chain::{Chain, ChainGenerator};
use stillbeam::mechanism::{Closure, Link, Mechanism};
use stillbeam::{Move, Profile, Scalar};

use super::scenes;

/// Three rigid links without mass, with masses at their ends: the momenta are those of points.
const LENGTHS: [f64; 3] = [0.3, 0.25, 0.2];
const MASSES: [f64; 3] = [0.05, 0.03, 0.02];

fn points() -> Mechanism {
    let links = LENGTHS.map(|length| Link::rigid(length, 0.0));
    let mut mechanism = Mechanism::new(&links).expect("links");
    mechanism.joints[1].mass = MASSES[0];
    mechanism.joints[2].mass = MASSES[1];
    mechanism.payload.mass = MASSES[2];
    let mut closure = Closure::at(0.1);
    closure.release = [0, 1, 2].into_iter().collect();
    mechanism.closure = Some(closure);
    mechanism
}

/// Velocity of each mass per unit rate of each joint.
fn velocities(angles: [f64; 3]) -> [[[f64; 2]; 3]; 3] {
    let mut places = [[0.0; 2]; 4];
    let mut direction = 0.0;
    for j in 0..3 {
        direction += angles[j];
        places[j + 1] = [
            places[j][0] + LENGTHS[j] * direction.cos(),
            places[j][1] + LENGTHS[j] * direction.sin(),
        ];
    }
    core::array::from_fn(|point| {
        core::array::from_fn(|joint| {
            if joint > point {
                return [0.0; 2];
            }
            let [x, y] = [0, 1].map(|axis| places[point + 1][axis] - places[joint][axis]);
            [-y, x]
        })
    })
}

/// Rates after the impact: of all that leave the end at rest, the one to which the momentum before
/// projects. Three joints less two conditions leave one motion `n`, so `n (nᵀMq̇)/(nᵀMn)`.
fn after_impact(angles: [f64; 3], rates: [f64; 3]) -> [f64; 3] {
    let v = velocities(angles);
    let tip = v[2];
    // Perpendicular to both rows of the end's displacement.
    let n: [f64; 3] = core::array::from_fn(|i| {
        let (a, b) = ((i + 1) % 3, (i + 2) % 3);
        tip[a][0] * tip[b][1] - tip[a][1] * tip[b][0]
    });
    let momentum = |q: [f64; 3]| {
        let mut sum = 0.0;
        for point in 0..3 {
            for axis in 0..2 {
                let along = |q: [f64; 3]| (0..3).map(|j| v[point][j][axis] * q[j]).sum::<f64>();
                sum += MASSES[point] * along(n) * along(q);
            }
        }
        sum
    };
    let share = momentum(rates) / momentum(n);
    n.map(|n| n * share)
}

fn assert_impact<T: Scalar>(tolerance: f64) {
    let chain = Chain::<T, 3, 3, 9, 3>::new(&points(), 0.01).expect("a chain");
    let from = [0.3, 0.9, -1.4];
    let mut arm = ChainGenerator::<T, 3, 3, 9, 3>::new(chain, from).expect("a generator");
    for (joint, rate) in [1.0, -2.0, 1.5].into_iter().enumerate() {
        arm.push(joint, &Move::SpinUp { duration: 0.05, rate }).expect("a move");
    }
    let mut before = arm.tick();
    for _ in 0..10 {
        before = arm.tick();
    }
    assert!(arm.state().is_closed());
    let angles = before.joints.map(|joint| joint.angle.precise().radians());
    let exact = after_impact(angles, before.joints.map(|joint| joint.rate.to_f64()));
    for (joint, exact) in arm.state().joints().iter().zip(exact) {
        let found = joint.rate.to_f64();
        assert!((found - exact).abs() <= tolerance, "{found} is not {exact}");
    }
    // A motor that has let go gives nothing, and the next ticks keep the end where it is.
    let place = before.tip().map(T::to_f64);
    for _ in 0..100 {
        let setpoint = arm.tick();
        assert!(setpoint.joints.iter().all(|joint| joint.torque == T::ZERO));
        let [x, y] = setpoint.tip().map(T::to_f64);
        assert!((x - place[0]).hypot(y - place[1]) < 1e-3 * 0.75, "{x} {y}, {place:?}");
    }
}

#[test]
fn rates_jump_as_momentum_says() {
    assert_impact::<f64>(1e-6);
    assert_impact::<f32>(1e-5);
}

/// The end stays on its pin through a hundred thousand ticks of moves, and torques stay finite.
fn assert_no_drift<T: Scalar>() -> f64 {
    let scene = scenes::latch();
    let mut arm = scenes::generator::<T, 3, 3, 9, 3>(&scene, 0.01);
    let length = scene.mechanism.total_length();
    let mut pin = None;
    let mut worst: f64 = 0.0;
    for k in 0..100_000_u32 {
        let setpoint = arm.tick();
        assert!(setpoint.joints.iter().all(|joint| joint.torque.is_finite()), "tick {k}");
        if k >= 180 {
            let [x, y] = setpoint.tip().map(T::to_f64);
            let [x0, y0] = *pin.get_or_insert([x, y]);
            worst = worst.max((x - x0).hypot(y - y0) / length);
        }
        if k >= 300 && k % 100 == 0 {
            let to = if k % 200 == 0 { 1.6 } else { 2.0 };
            arm.push(0, &Move::To { profile: Profile::Quintic, duration: 0.9, to })
                .expect("a move");
        }
    }
    worst
}

#[test]
fn the_end_does_not_drift_from_its_pin() {
    let found = [assert_no_drift::<f32>(), assert_no_drift::<f64>()];
    println!("{found:?}");
    assert!(found.iter().all(|found| *found <= 1e-5), "{found:?}");
}
