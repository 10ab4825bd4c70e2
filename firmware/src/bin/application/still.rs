//! Planners of still moves, one an axis, set up when they are first asked: some seconds of a slow
//! core's time, which nobody else waits for. With the feature `still`; what it takes stands in
//! docs/firmware.md.

#[cfg(feature = "still")]
mod planner {
    use stillbeam::{Error, PlanContext, PlannedMove};
    use stillbeam_wiring::axes::{AXES, TICK};

    use crate::shared::{Outcome, scene};

    /// The planner of one arm: its exact rod in two modes.
    pub struct Planner(stillbeam::planner::Planner<f32, 2>);

    impl Planner {
        pub fn plan(
            &self,
            context: &PlanContext,
            to: f64,
            duration: Option<f64>,
        ) -> Result<PlannedMove<f32>, Error> {
            context.plan_still(&self.0, to, duration)
        }
    }

    #[derive(Default)]
    pub struct Planners([Option<Planner>; AXES]);

    impl Planners {
        /// The axis' planner, set up if there is none yet.
        pub fn of(&mut self, axis: usize) -> Outcome<&Planner> {
            let scene = scene(axis)?;
            let planner = &mut self.0[axis];
            if planner.is_none() {
                *planner = Some(Planner(stillbeam::planner::Planner::new(&scene, TICK)?));
            }
            planner.as_ref().ok_or(stillbeam_protocol::Refusal::NoPlanner)
        }

        /// Drops the planner of an axis whose arm has changed.
        pub fn forget(&mut self, axis: usize) {
            if let Some(planner) = self.0.get_mut(axis) {
                *planner = None;
            }
        }
    }
}

#[cfg(not(feature = "still"))]
mod planner {
    use stillbeam::{Error, PlanContext, PlannedMove};
    use stillbeam_protocol::Refusal;

    use crate::shared::Outcome;

    /// Stands for the planner in a build without one.
    pub enum Planner {}

    impl Planner {
        pub fn plan(
            &self,
            _: &PlanContext,
            _: f64,
            _: Option<f64>,
        ) -> Result<PlannedMove<f32>, Error> {
            match *self {}
        }
    }

    // With braces: `Planners::default()` is written for both, and for a unit struct clippy objects.
    #[derive(Default)]
    pub struct Planners {}

    impl Planners {
        pub fn of(&mut self, _: usize) -> Outcome<&Planner> {
            Err(Refusal::NoPlanner)
        }

        pub fn forget(&mut self, _: usize) {}
    }
}

pub use planner::Planners;
