//! The scenes of `tests/truth`, built in code, and their solutions.

use std::path::Path;

use stillbeam::{Limits, Link, Move, Profile, Scene};
use stillbeam_sim::reference::Sample;
use stillbeam_sim::trajectory::Trajectory;

/// A scene of `tests/truth` with its solution.
pub struct Truth {
    pub scene: Scene,
    pub trajectory: Trajectory,
    pub samples: Vec<Sample>,
}

/// Largest differences of a run from a truth.
#[derive(Clone, Copy, Debug, Default)]
pub struct Error {
    /// Distance of the tips, whole run, as a fraction of L.
    pub tip: f64,
    /// As a fraction of the greatest torque, away from the jumps of the commanded acceleration.
    pub torque: f64,
}

pub const NAMES: [&str; 6] =
    ["d-fast", "a-tip30", "b-tip30", "b-tip30-damped-hub", "s-gravity", "spin-up"];

pub fn truth(name: &'static str) -> Truth {
    let (scene, from, moves) = problem(name);
    let trajectory = Trajectory::plan(from, &moves, &Limits::default(), 0.010).unwrap();
    Truth { scene, trajectory, samples: read(name) }
}

impl Truth {
    pub fn times(&self) -> Vec<f64> {
        self.samples.iter().map(|sample| sample.t).collect()
    }

    /// Compares a run at the same times.
    pub fn error(&self, run: &[Sample]) -> Error {
        difference(&self.scene, &self.trajectory, run, &self.samples)
    }
}

/// Largest differences of two runs at the same times.
pub fn difference(
    scene: &Scene,
    trajectory: &Trajectory,
    run: &[Sample],
    truth: &[Sample],
) -> Error {
    assert_eq!(run.len(), truth.len());
    let tick = trajectory.tick();
    let mut borders = vec![0.0];
    borders.extend(trajectory.breaks());
    let peak = truth.iter().fold(0.0, |peak: f64, sample| peak.max(sample.torque.abs()));
    let mut error = Error::default();
    for (a, b) in run.iter().zip(truth) {
        let apart = (a.tip[0] - b.tip[0]).hypot(a.tip[1] - b.tip[1]) / scene.link.length;
        // A NaN must not pass for no difference.
        assert!(apart.is_finite() && a.torque.is_finite(), "at {} s", a.t);
        error.tip = error.tip.max(apart);
        if borders.iter().all(|border| (a.t - border).abs() > 1.001 * tick) {
            error.torque = error.torque.max((a.torque - b.torque).abs() / peak);
        }
    }
    error
}

fn problem(name: &str) -> (Scene, f64, Vec<Move>) {
    use std::f64::consts::PI;
    let a = Link { length: 0.4, mass: 0.00952, bending_stiffness: 0.0213344 };
    let b = Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 };
    let d = Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 };
    let turn = |duration| {
        let profile = Profile::Cubic;
        vec![Move::To { profile, duration, to: PI }, Move::Dwell { duration }]
    };
    match name {
        "d-fast" => (Scene::new(d), 0.0, turn(0.2)),
        "a-tip30" => {
            let mut scene = Scene::new(a);
            scene.payload.mass = 0.03;
            (scene, 0.0, turn(2.0))
        }
        "b-tip30" => {
            let mut scene = Scene::new(b);
            scene.payload.mass = 0.03;
            (scene, 0.0, turn(2.0))
        }
        "b-tip30-damped-hub" => {
            let mut scene = Scene::new(b);
            scene.payload.mass = 0.03;
            scene.hub.radius = 0.04;
            scene.damping.alpha = 0.15;
            scene.damping.beta = 0.002;
            (scene, 0.0, turn(2.0))
        }
        "s-gravity" => {
            let link = Link { length: 1.0, mass: 0.4, bending_stiffness: 15.0 };
            let mut scene = Scene::new(link);
            scene.payload.mass = 0.2;
            scene.payload.inertia = 0.001;
            scene.hub.radius = 0.1;
            scene.damping.beta = 0.0001;
            scene.gravity = 9.81;
            let to = Move::To { profile: Profile::Quintic, duration: 0.8, to: 0.4 };
            (scene, -0.4, vec![to, Move::Dwell { duration: 0.8 }])
        }
        "spin-up" => {
            let link = Link { length: 10.0, mass: 12.0, bending_stiffness: 14000.0 };
            let spin = Move::SpinUp { rate: 6.0, duration: 15.0 };
            (Scene::new(link), 0.0, vec![spin, Move::Dwell { duration: 15.0 }])
        }
        other => panic!("no scene {other}"),
    }
}

fn read(name: &str) -> Vec<Sample> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/truth");
    let mut file = csv::Reader::from_path(directory.join(format!("{name}.csv"))).unwrap();
    file.deserialize()
        .map(|row| {
            let [t, angle, rate, acceleration, x, y, deflection, torque]: [f64; 8] = row.unwrap();
            Sample { t, angle, rate, acceleration, tip: [x, y], deflection, torque }
        })
        .collect()
}
