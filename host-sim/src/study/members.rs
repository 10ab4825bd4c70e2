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
    /// A to D.
    pub members: Vec<Member>,
}

/// One member.
#[derive(Clone, Debug)]
pub struct Member {
    /// `A` to `D`.
    pub name: char,
    /// What it is made of, in the paper's table 1.
    pub material: &'static str,
    /// First period with the 30 g, eight consistent elements, s.
    pub period: f64,
    /// Without damping.
    pub undamped: Outcome,
    /// With [`DAMPING`].
    pub damped: Outcome,
}

/// A run and how it ends.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The run.
    pub run: Run,
    /// Largest |deflection|, fraction of L.
    pub peak: f64,
    /// Residual vibration, fraction of L.
    pub residual: f64,
}

/// An illustration: the paper fits its damping to its experiments and does not print it.
pub const DAMPING: Damping = Damping { alpha: 0.15, beta: 0.002 };

const MEMBERS: [(char, &str, &str); 4] = [
    ('A', "acrylic", "a-tip30"),
    ('B', "acrylic", "b-tip30"),
    ('C', "aluminium", "c-tip30"),
    ('D', "aluminium", "d-tip30"),
];

impl Members {
    /// π in 2 s and 2 s of rest, by the default solver.
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

    /// Member B, which arrives almost still without damping.
    pub fn quiet(&self) -> Option<&Member> {
        self.members.iter().find(|member| member.name == 'B')
    }
}

impl Member {
    /// Duration of the move in first periods.
    pub fn ratio(&self) -> f64 {
        self.undamped.run.move_time() / self.period
    }
}

impl Outcome {
    fn of(scene: SceneFile) -> Result<Self, Error> {
        let run = Run::of(scene)?;
        Ok(Self { peak: run.peak(), residual: run.residual()?, run })
    }

    /// Residual over peak deflection.
    pub fn ratio(&self) -> f64 {
        self.residual / self.peak
    }
}
