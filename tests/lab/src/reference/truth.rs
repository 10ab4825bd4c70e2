//! The scenes of `tests/truth` and their solutions, by methods that share nothing with the solvers.

use std::path::Path;

use stillbeam::Scene;
use stillbeam_sim::error::Error;
use stillbeam_sim::reference::Sample;
use stillbeam_sim::scenes;
use stillbeam_sim::trajectory::Trajectory;

/// A scene of `tests/truth` with its solution.
pub struct Truth {
    /// The arm.
    pub scene: Scene,
    /// Its motion, planned at 10 ms.
    pub trajectory: Trajectory,
    /// The solution, every 10 ms.
    pub samples: Vec<Sample>,
}

/// Largest differences of a run from a truth.
#[derive(Clone, Copy, Debug, Default)]
pub struct Apart {
    /// Distance of the tips, whole run, as a fraction of L.
    pub tip: f64,
    /// Difference of the torques, as a fraction of the greatest torque, away from the jumps of the
    /// commanded acceleration.
    pub torque: f64,
}

/// Names of the scenes.
pub const NAMES: [&str; 6] =
    ["d-fast", "a-tip30", "b-tip30", "b-tip30-damped-hub", "s-gravity", "spin-up"];

impl Truth {
    /// Reads an embedded scene and its solution from `tests/truth`.
    ///
    /// # Errors
    /// An error is returned if a file is missing there or wrong.
    pub fn read(name: &str) -> Result<Self, Error> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../truth");
        let file = scenes::open(name)?;
        let trajectory = file.trajectory(0.010)?;
        let samples = samples(&folder.join(format!("{name}.csv")))?;
        Ok(Self { scene: file.arm, trajectory, samples })
    }

    /// Returns the times of the solution, s.
    pub fn times(&self) -> Vec<f64> {
        self.samples.iter().map(|sample| sample.t).collect()
    }

    /// Compares a run at the same times.
    pub fn error(&self, run: &[Sample]) -> Apart {
        difference(&self.scene, &self.trajectory, run, &self.samples)
    }
}

/// Returns the largest differences of two runs at the same times.
pub fn difference(
    scene: &Scene,
    trajectory: &Trajectory,
    run: &[Sample],
    truth: &[Sample],
) -> Apart {
    assert_eq!(run.len(), truth.len());
    let tick = trajectory.tick();
    let mut borders = vec![0.0];
    borders.extend(trajectory.breaks());
    let peak = truth.iter().fold(0.0, |peak: f64, sample| peak.max(sample.torque.abs()));
    let mut error = Apart::default();
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

fn samples(path: &Path) -> Result<Vec<Sample>, Error> {
    let refuse = |cause: csv::Error| {
        Error::file(path, format_args!("{cause}; must be a table of truth that can be read"))
    };
    let mut file = csv::Reader::from_path(path).map_err(refuse)?;
    file.deserialize()
        .map(|row| {
            let [t, angle, rate, acceleration, x, y, deflection, torque]: [f64; 8] =
                row.map_err(refuse)?;
            let tip = [x, y];
            Ok(Sample { t, angle, rate, acceleration, tip, payload: tip, deflection, torque })
        })
        .collect()
}
