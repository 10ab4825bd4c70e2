//! A stepper of whatever type.

use std::any::type_name;

use stillbeam::motion::{Commanded, Segment, Shaper};
use stillbeam::prepared::Prepare;
use stillbeam::select::{Assessment, assess};
use stillbeam::stepper::{AnyMotion, Response};
use stillbeam::{Error, Generator, Scene, Setpoint, Stepper, motion};

use crate::build::{Refused, Spec, StepperVisitor, with_stepper};
use crate::{AnyGenerator, AnySetpoint, QUEUE, Scalar};

/// A stepper whose type can be left open.
pub trait Erasable:
    Stepper<Scalar: Scalar, State: Send + Sync> + Prepare + Clone + Send + Sync + 'static
{
}

impl<S> Erasable for S where
    S: Stepper<Scalar: Scalar, State: Send + Sync> + Prepare + Clone + Send + Sync + 'static
{
}

/// A motion behind an input shaper, which no generator's queue holds.
#[derive(Clone, Copy, Debug)]
pub struct Shaped<'a> {
    /// The segments of rest-to-rest moves, at least one.
    pub segments: &'a [Segment<f64>],
    /// The shaper in front of the arm.
    pub shaper: &'a Shaper,
}

/// A stepper of whatever type.
pub trait AnyStepper: Send + Sync {
    /// Returns h, s.
    fn period(&self) -> f64;

    /// Returns the name of its type.
    fn type_name(&self) -> &'static str;

    /// Returns the bytes of a state and of the stepper.
    fn sizes(&self) -> [usize; 2];

    /// Returns the type that loads its words: see [`Prepare::kind`].
    fn kind(&self) -> [u32; 3];

    /// Returns its words: see [`Prepare::prepare`].
    fn words(&self) -> Vec<u32>;

    /// Returns a generator of it, hub at rest at `from` rad.
    ///
    /// # Errors
    /// Those of [`Generator::new`].
    fn generator(&self, from: f64) -> Result<Box<dyn AnyGenerator>, Error>;

    /// Steps along a shaped motion from its first tick, 0, to its last, and hands over each tick's
    /// setpoint and tip angle (rad). `arrives` says at which ticks a move ends: there the setpoint
    /// has the acceleration and torque from before.
    fn along(
        &self,
        motion: &Shaped<'_>,
        arrives: &dyn Fn(u32) -> bool,
        each: &mut dyn FnMut(u32, AnySetpoint, f64),
    );

    /// Estimates its errors along a motion of the scene: see [`assess`].
    ///
    /// # Errors
    /// Those of [`assess`].
    fn assess(
        &self,
        scene: &Scene,
        motion: &dyn Commanded,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Assessment, Error>;
}

impl<S: Erasable> AnyStepper for S {
    fn period(&self) -> f64 {
        self.tick()
    }

    fn type_name(&self) -> &'static str {
        type_name::<S>()
    }

    fn sizes(&self) -> [usize; 2] {
        [size_of::<S::State>(), size_of::<S>()]
    }

    fn kind(&self) -> [u32; 3] {
        Prepare::kind(self)
    }

    fn words(&self) -> Vec<u32> {
        let mut words = Vec::new();
        self.prepare(&mut |word| words.push(word));
        words
    }

    fn generator(&self, from: f64) -> Result<Box<dyn AnyGenerator>, Error> {
        Ok(Box::new(Generator::<S, QUEUE>::new(self.clone(), from)?))
    }

    fn along(
        &self,
        motion: &Shaped<'_>,
        arrives: &dyn Fn(u32) -> bool,
        each: &mut dyn FnMut(u32, AnySetpoint, f64),
    ) {
        // As on the target: what the tick evaluates is of its own precision.
        let segments: Vec<_> = motion.segments.iter().map(Segment::cast::<S::Scalar>).collect();
        let motion = motion::Shaped::new(&segments, motion.shaper, self.tick());
        let mut state = self.equilibrium(&self.gravity().aimed(&motion.hub(0)));
        for k in 0..=motion.ticks() {
            if k > 0 {
                motion.advance(self, &mut state, k - 1);
            }
            let hub = if arrives(k) { motion.arrival(k) } else { motion.hub(k) };
            let hub = self.gravity().aimed(&hub);
            let Response { torque, tip } = self.response::<AnyMotion>(&state, &hub);
            let (angle, rate, acceleration) = (hub.angle, hub.rate, hub.acceleration);
            let setpoint = Setpoint { angle, rate, acceleration, torque, tip };
            let tip_angle = stillbeam::Scalar::to_f64(self.tip_angle(&state));
            each(k, Scalar::any(setpoint), tip_angle);
        }
    }

    fn assess(
        &self,
        scene: &Scene,
        motion: &dyn Commanded,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Assessment, Error> {
        assess(scene, self.clone(), motion, progress)
    }
}

/// Builds the stepper that is asked for.
///
/// # Errors
/// Those of [`with_stepper`].
pub fn stepper(scene: &Scene, spec: &Spec) -> Result<Box<dyn AnyStepper>, Refused> {
    struct Boxed;
    impl StepperVisitor for Boxed {
        type Output = Box<dyn AnyStepper>;
        fn visit<S: Erasable>(self, stepper: S) -> Self::Output {
            Box::new(stepper)
        }
    }
    with_stepper(scene, spec, Boxed)
}
