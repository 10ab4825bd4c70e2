//! Changing course: another move from a coming tick on, whatever is under way then.

use super::{Generator, hold};
use crate::Error;
use crate::motion::{Angle, Hub, MAX_ANGLE, Origin, Segment, Start, StillMove, admit};
use crate::stepper::Stepper;

/// A coming tick: which segment it falls into, and where.
enum Place {
    Current(u32),
    /// Position in the queue.
    Waiting(usize, u32),
    /// Behind the queue.
    Held(u32),
}

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
    /// # use stillbeam::beam::Rod;
    /// # use stillbeam::motion::{Origin, Still};
    /// # use stillbeam::stepper::{Elastica, Quality};
    /// # use stillbeam::{Generator, Link, Move, Profile, Scene};
    /// # let scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    /// # let rod = Rod::<2>::new(&scene)?;
    /// # let stepper = Elastica::<f32, 2>::new(&rod, 0.010, Quality::Fine, rod.bend(150.0))?;
    /// # let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
    /// let planner = Still::<f32, 2>::new(&scene, 0.010)?;
    /// arm.push(&Move::To { profile: Profile::Cubic, duration: 0.3, to: 1.57 })?;
    /// # for _ in 0..8 { arm.tick(); }
    /// // In the middle of the move: somewhere else, from the fifth tick on.
    /// let mut ahead = arm.clone();
    /// for _ in 0..5 {
    ///     ahead.tick();
    /// }
    /// let flex = ahead.stepper().flex(ahead.state(), ahead.hub());
    /// let plan = planner.plan_from(&Origin::of(ahead.hub()), Some(&flex), 0.5, 0.25)?;
    /// arm.redirect(4, &plan)?;
    /// # for _ in 0..31 { arm.tick(); }
    /// # assert!((arm.setpoint().angle.radians() - 0.5).abs() < 1e-6);
    /// # assert!(arm.setpoint().deflection().abs() < 2e-4);
    /// # Ok::<(), stillbeam::Error>(())
    /// ```
    pub fn redirect(&mut self, lead: u32, plan: &StillMove) -> Result<(), Error> {
        let tick = self.stepper.tick();
        Error::check("plan.tick", plan.tick, tick, tick, "s")?;
        Error::check("plan.to", plan.to, -MAX_ANGLE, MAX_ANGLE, "rad")?;
        // Of the curve itself: what a plan states of it may be anything.
        let peaks = plan.curve_peaks::<S::Scalar>();
        admit(&self.limits, &peaks, tick)?;
        self.stepper.admit(&peaks, 0.0)?;
        let place = self.place(lead);
        let here = Origin::of(&self.hub_of(&place));
        if here != plan.from {
            let (hub, begins) = (here.angle.radians(), plan.from.angle.radians());
            return Err(Error::Elsewhere { hub, begins });
        }
        let kept = match place {
            Place::Current(_) => 0,
            Place::Waiting(index, k) => index + usize::from(k > 0),
            Place::Held(k) => self.queue.len() + usize::from(k > 0),
        };
        let (needed, free) = (1, QUEUE.saturating_sub(kept));
        if needed > free {
            return Err(Error::QueueFull { needed, free });
        }
        match place {
            Place::Current(k) => {
                self.current = self.current.broken_off(k);
                self.set_path();
            }
            Place::Waiting(index, k) => {
                if let Some(segment) = self.queue.iter_mut().nth(index) {
                    *segment = segment.broken_off(k);
                }
            }
            Place::Held(0) => {}
            Place::Held(k) => {
                // There is room: just counted.
                let _ = self.queue.push_back(self.tail.broken_off(k));
            }
        }
        while self.queue.len() > kept {
            self.queue.pop_back();
        }
        let segment = plan.segment();
        let _ = self.queue.push_back(segment.cast());
        let end = Start { angle: Angle::from_radians(plan.to), rate: 0.0 };
        self.end = end;
        self.tail = hold(end, tick);
        Ok(())
    }

    /// The arm's state from now on, e.g. as measured: see
    /// [`Elastica::state_of`](crate::stepper::Elastica::state_of).
    pub fn set_state(&mut self, state: S::State) {
        self.state = state;
        self.asleep = false;
    }

    fn place(&self, lead: u32) -> Place {
        let left = self.current.count() - self.next_k().min(self.current.count());
        // A current segment of no length has ended already.
        if lead < left {
            return Place::Current(self.next_k() + lead);
        }
        let mut lead = lead - left;
        for (index, segment) in self.queue.iter().enumerate() {
            if lead < segment.count() {
                return Place::Waiting(index, lead);
            }
            lead -= segment.count();
        }
        Place::Held(lead)
    }

    fn hub_of(&self, place: &Place) -> Hub<S::Scalar> {
        let waiting = |index| self.queue.iter().nth(index).unwrap_or(&self.tail);
        let (segment, k): (&Segment<_>, u32) = match *place {
            Place::Current(k) => (&self.current, k),
            Place::Waiting(index, k) => (waiting(index), k),
            Place::Held(k) => (&self.tail, k),
        };
        segment.hub(k)
    }
}
