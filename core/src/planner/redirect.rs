//! Redirects a generator: a still move from a coming tick on, whatever is under way then.

use super::StillMove;
use crate::Error;
use crate::generator::{Branch, Generator};
use crate::hub::MAX_ANGLE;
use crate::stepper::Stepper;

impl<S: Stepper, const QUEUE: usize> Generator<S, QUEUE> {
    /// Replaces all that follows by `plan`, which begins with the coming tick number `lead` (0 is
    /// the next one): angle, rate and acceleration go on without a jump.
    ///
    /// A plan is made outside the tick, from what a copy of the generator shows `lead + 1` ticks
    /// later. If ticks have gone by since, `lead` is as many less. A plan that does not begin
    /// exactly where the hub is at that tick is refused, and nothing changes. So is one whose curve
    /// exceeds the limits: its peaks are found anew, and those that it states are not looked at.
    ///
    /// ```
    /// # use stillbeam::model::Rod;
    /// # use stillbeam::planner::{Planner, Request, Target};
    /// # use stillbeam::stepper::{Elastica, Quality};
    /// # use stillbeam::{Generator, Link, Move, Profile, Scene};
    /// # let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    /// # let rod = Rod::<2>::new(&scene)?;
    /// # let stepper = Elastica::<f32, 2>::new(&rod, 0.010, Quality::Fine, rod.bend(150.0))?;
    /// # let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
    /// let planner = Planner::<f32, 2>::new(&scene, 0.010)?;
    /// arm.push(&Move::To { profile: Profile::Cubic, duration: 0.3, to: 1.57 })?;
    /// # for _ in 0..8 { arm.tick(); }
    /// // In the middle of the move: somewhere else, from the fifth tick on.
    /// let mut ahead = arm.clone();
    /// for _ in 0..5 {
    ///     ahead.tick();
    /// }
    /// let flex = ahead.stepper().arm_state(ahead.state(), ahead.hub());
    /// let request = Request::from_hub(ahead.hub().precise(), Target::Angle(0.5))
    ///     .arm(flex)
    ///     .duration(0.25);
    /// let plan = planner.plan(&request)?;
    /// arm.redirect(4, &plan)?;
    /// # for _ in 0..31 { arm.tick(); }
    /// # assert!((arm.setpoint().angle.radians() - 0.5).abs() < 1e-6);
    /// # assert!(arm.setpoint().deflection().abs() < 2e-4);
    /// # Ok::<(), stillbeam::Error>(())
    /// ```
    pub fn redirect(&mut self, lead: u32, plan: &StillMove) -> Result<(), Error> {
        let tick = self.stepper().tick();
        Error::check("plan.tick", plan.tick, tick, tick, "s")?;
        Error::check("plan.to", plan.to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
        Error::check("plan.rate", plan.rate, -MAX_ANGLE, MAX_ANGLE, "rad/s")?;
        // Of the curve itself: what a plan states of it may be anything.
        let peaks = plan.curve_peaks::<S::Scalar>();
        let StillMove { from, to, rate, .. } = *plan;
        self.branch(lead, &Branch { from, segment: plan.segment(), peaks, to, rate })
    }
}
