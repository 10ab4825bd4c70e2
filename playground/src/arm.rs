//! The arm of the page, by the same operations as a scene file's.

use core::f64::consts::TAU;

use stillbeam::model::Rod;
use stillbeam::scene::CrossSection;
use stillbeam::{Damping, Error, Link, Scene, UniformScene};

use crate::input::Input;
use crate::motion::Refusal;
use crate::shape::Centreline;

/// Setpoint interval, s.
pub const TICK: f64 = 0.01;

/// Longest first period, s: with it a run still fits into the page's memory.
const LONGEST_PERIOD: f64 = 12.0;

/// Number of numbers in [`Arm::facts`].
pub const FACTS: usize = 8;

/// An arm, and the move that is asked of it.
#[derive(Debug)]
pub struct Arm {
    /// The arm that the motions are planned for.
    pub scene: UniformScene,
    /// The motion that is asked for.
    pub input: Input,
    /// Its modes.
    pub rod: Rod<2>,
    /// The arm as it is drawn.
    pub centreline: Centreline,
    /// Time of rest after a move, s: whole ticks, at least a first period.
    pub rest: f64,
}

impl Arm {
    /// Builds the arm.
    ///
    /// # Errors
    /// Numbers that the core refuses, and a first period beyond [`LONGEST_PERIOD`].
    pub fn new(input: &Input) -> Result<Self, Refusal> {
        let mut scene = scene(input)?;
        // Damping changes no frequency of the rod.
        let first = Rod::<2>::new(&scene)?.frequency()[0];
        scene.damping.beta = 2.0 * input.damping / first;
        let rod = Rod::new(&scene)?;
        let period = TAU / first;
        let (min, max, unit) = (4.0 * TICK, LONGEST_PERIOD, "s");
        if !(min..=max).contains(&period) {
            let parameter = "first period";
            return Err(Error::OutOfRange { parameter, value: period, min, max, unit }.into());
        }
        let rest = libm::ceil(f64::max(1.0, 1.5 * period) * 10.0) / 10.0;
        Ok(Self { scene, input: *input, centreline: Centreline::of(&rod), rod, rest })
    }

    /// Returns the same arm with frequencies that differ by the fraction `error`.
    pub fn detuned(&self, error: f64) -> UniformScene {
        let Link { bending_stiffness, .. } = self.scene.link;
        let bending_stiffness = bending_stiffness * (1.0 + error) * (1.0 + error);
        Scene { link: Link { bending_stiffness, ..self.scene.link }, ..self.scene }
    }

    /// First natural period `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        TAU / self.rod.frequency()[0]
    }

    /// First natural frequency, Hz, and damping ratio, for a shaper.
    pub fn first_mode(&self) -> [f64; 2] {
        [1.0 / self.first_period(), self.rod.damping_ratio()[0]]
    }

    /// Returns in order: mass of the link (kg), `EI` (N m²), first and second frequency (Hz), `β`
    /// (s), the shaper's frequency (Hz) and damping ratio, the rest after a move (s).
    pub fn facts(&self) -> [f64; FACTS] {
        let Link { mass, bending_stiffness, .. } = self.scene.link;
        let [first, second] = self.rod.frequency().map(|omega| omega / TAU);
        let [frequency, ratio] = self.first_mode();
        [
            mass,
            bending_stiffness,
            first,
            second,
            self.scene.damping.beta,
            frequency,
            ratio,
            self.rest,
        ]
    }
}

/// Returns the arm without its damping: a strip of a material, and a payload at its tip.
fn scene(input: &Input) -> Result<UniformScene, Refusal> {
    let &Input { length, width, thickness, payload, .. } = input;
    let material = input.material()?;
    let strip = CrossSection::Strip { width, thickness }.validate()?;
    let mass = material.density * strip.area() * length;
    let link = Link::from_section(length, mass, material.youngs_modulus, strip.second_moment())?;
    let mut scene = UniformScene::uniform(link);
    scene.payload.mass = payload;
    scene.damping = Damping::default();
    Ok(scene.validate()?)
}
