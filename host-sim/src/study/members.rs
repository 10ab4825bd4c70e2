//! Fig. 6: the four members of the paper's table 1, each with 30 g at the tip.

use stillbeam::Damping;

use super::Run;
use crate::dispatch::first_period;
use crate::error::Error;
use crate::scene_file::SceneFile;
use crate::solver::{Mass, SolverKeys};

/// Runs of members A to D.
#[derive(Clone, Debug)]
pub struct Members {
    /// Members A to D.
    pub members: Vec<Member>,
}

/// One member.
#[derive(Clone, Debug)]
pub struct Member {
    /// Name, `A` to `D`.
    pub name: char,
    /// Material in the paper's table 1.
    pub material: &'static str,
    /// First period with the 30 g, eight consistent elements, s.
    pub period: f64,
    /// Run without damping.
    pub undamped: Outcome,
    /// Run with [`DAMPING`].
    pub damped: Outcome,
}

/// A run, its peak deflection and its residual vibration.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The run.
    pub run: Run,
    /// Largest |deflection|, fraction of L.
    pub peak: f64,
    /// Residual vibration, fraction of L.
    pub residual: f64,
}

/// Damping for illustration. The paper fits its damping to its experiments and does not print it.
pub const DAMPING: Damping = Damping { alpha: 0.15, beta: 0.002, joint: 0.0 };

const MEMBERS: [(char, &str, &str); 4] = [
    ('A', "acrylic", "a-tip30"),
    ('B', "acrylic", "b-tip30"),
    ('C', "aluminium", "c-tip30"),
    ('D', "aluminium", "d-tip30"),
];

impl Members {
    /// Runs π in 2 s and 2 s of rest, by the default solver.
    pub fn compute() -> Result<Self, Error> {
        let member = |(name, material, file)| -> Result<Member, Error> {
            let scene = super::scene(file, SolverKeys::default())?;
            let mut damped = scene.clone();
            damped.arm.damping = DAMPING;
            Ok(Member {
                name,
                material,
                period: first_period(&scene.arm, 8, Mass::Consistent)?,
                undamped: Outcome::of(scene)?,
                damped: Outcome::of(damped)?,
            })
        };
        Ok(Self { members: MEMBERS.into_iter().map(member).collect::<Result<_, _>>()? })
    }

    /// Returns member B, which arrives almost still without damping.
    pub fn quiet(&self) -> Option<&Member> {
        self.members.iter().find(|member| member.name == 'B')
    }
}

impl Member {
    /// Returns the duration of the move in first periods.
    pub fn ratio(&self) -> f64 {
        self.undamped.run.move_time() / self.period
    }
}

impl Outcome {
    fn of(scene: SceneFile) -> Result<Self, Error> {
        let run = Run::of(scene)?;
        Ok(Self { peak: run.peak(), residual: run.residual()?, run })
    }

    /// Returns the residual over the peak deflection.
    pub fn ratio(&self) -> f64 {
        self.residual / self.peak
    }
}
