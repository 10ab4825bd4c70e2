//! Steppers and planners of the axes: picked from what the build has prepared, or with the feature
//! `set-up` set up here for any payload. What that takes stands in docs/firmware.md.

/// The planner of still moves of one arm: its exact rod in two modes.
pub type Planner = stillbeam::planner::Planner<f32, 2>;

#[cfg(not(feature = "set-up"))]
mod source {
    use stillbeam::prepared::Prepared;
    use stillbeam::{Error, Payload, UniformScene};
    use stillbeam_protocol::Refusal;
    use stillbeam_wiring::axes::{AXES, Stepper, TICK};
    use stillbeam_wiring::{PreparedArm, PreparedArms};

    use super::Planner;
    use crate::shared::Outcome;

    include!(concat!(env!("OUT_DIR"), "/arms.rs"));

    /// The stepper of the axis' arm at power-up.
    pub fn at_power_up(axis: usize) -> Result<Stepper, Error> {
        Stepper::load(ARMS[axis].arms[0].stepper, TICK)
    }

    /// The stepper of the axis' arm as described.
    pub fn stepper(axis: usize, scene: &UniformScene) -> Outcome<Stepper> {
        let arm = of(axis)?.pick(&scene.payload)?;
        Ok(Stepper::load(arm.stepper, TICK)?)
    }

    /// Lends the planner of the axis' arm as described.
    pub fn with_planner(
        axis: usize,
        scene: &UniformScene,
        plan: impl FnOnce(&Planner) -> Outcome<u32>,
    ) -> Outcome<u32> {
        // Used where it was made, which saves the stack a copy.
        let made = load(of(axis)?.planner(scene)?);
        plan(made.as_ref().map_err(|error| *error)?)
    }

    /// Loads a planner.
    // Not inlined: what loading needs beside the planner is off the stack when the plan begins.
    #[inline(never)]
    fn load(words: &[u32]) -> Result<Planner, Error> {
        Planner::load(words, TICK)
    }

    fn of(axis: usize) -> Outcome<&'static PreparedArms> {
        ARMS.get(axis).ok_or(Refusal::Axis(AXES as u8))
    }
}

#[cfg(feature = "set-up")]
mod source {
    use stillbeam::{Error, UniformScene};
    use stillbeam_wiring::axes::{self, CONFIGURATIONS, Stepper, TICK};

    use super::Planner;
    use crate::shared::Outcome;

    /// The stepper of the axis' arm at power-up.
    pub fn at_power_up(axis: usize) -> Result<Stepper, Error> {
        axes::stepper(&CONFIGURATIONS[axis].scene)
    }

    /// The stepper of the axis' arm as described.
    pub fn stepper(_: usize, scene: &UniformScene) -> Outcome<Stepper> {
        Ok(axes::stepper(scene)?)
    }

    /// Lends the planner of the axis' arm as described.
    pub fn with_planner(
        _: usize,
        scene: &UniformScene,
        plan: impl FnOnce(&Planner) -> Outcome<u32>,
    ) -> Outcome<u32> {
        // Used where it was made, which saves the stack a copy.
        let made = Planner::new(scene, TICK);
        plan(made.as_ref().map_err(|error| *error)?)
    }
}

pub use source::{at_power_up, stepper, with_planner};
