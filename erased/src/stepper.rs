//! A stepper of whatever type.

use std::any::type_name;

use stillbeam::motion::{Commanded, Segment, Shaper};
use stillbeam::select::{Assessment, assess};
use stillbeam::stepper::{AnyMotion, Response};
use stillbeam::{Error, Generator, Scene, Setpoint, motion};

use crate::build::{Refused, Spec, StepperVisitor, with_stepper};
use crate::steppers::Held;
use crate::{AnyGenerator, AnySetpoint, Erasable, QUEUE, Scalar};

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
    ///
    /// [`Prepare::kind`]: stillbeam::prepared::Prepare::kind
    fn kind(&self) -> [u32; 3];

    /// Returns its words: see [`Prepare::prepare`].
    ///
    /// [`Prepare::prepare`]: stillbeam::prepared::Prepare::prepare
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

/// A stepper as the type that it shares with others, and what is to be told of its own.
struct Erased<A> {
    stepper: A,
    type_name: &'static str,
    sizes: [usize; 2],
}

impl<A: Held> AnyStepper for Erased<A> {
    fn period(&self) -> f64 {
        self.stepper.tick()
    }

    fn type_name(&self) -> &'static str {
        self.type_name
    }

    fn sizes(&self) -> [usize; 2] {
        self.sizes
    }

    fn kind(&self) -> [u32; 3] {
        self.stepper.kind()
    }

    fn words(&self) -> Vec<u32> {
        let mut words = Vec::new();
        self.stepper.prepare(&mut |word| words.push(word));
        words
    }

    fn generator(&self, from: f64) -> Result<Box<dyn AnyGenerator>, Error> {
        Ok(Box::new(Generator::<A, QUEUE>::new(self.stepper.clone(), from)?))
    }

    fn along(
        &self,
        motion: &Shaped<'_>,
        arrives: &dyn Fn(u32) -> bool,
        each: &mut dyn FnMut(u32, AnySetpoint, f64),
    ) {
        let stepper = &self.stepper;
        // As on the target: what the tick evaluates is of its own precision.
        let segments: Vec<_> = motion.segments.iter().map(Segment::cast::<A::Scalar>).collect();
        let motion = motion::Shaped::new(&segments, motion.shaper, stepper.tick());
        let mut state = stepper.equilibrium(&stepper.gravity().aimed(&motion.hub(0)));
        for k in 0..=motion.ticks() {
            if k > 0 {
                motion.advance(stepper, &mut state, k - 1);
            }
            let hub = if arrives(k) { motion.arrival(k) } else { motion.hub(k) };
            let hub = stepper.gravity().aimed(&hub);
            let Response { torque, tip } = stepper.response::<AnyMotion>(&state, &hub);
            let (angle, rate, acceleration) = (hub.angle, hub.rate, hub.acceleration);
            let setpoint = Setpoint { angle, rate, acceleration, torque, tip };
            let tip_angle = stillbeam::Scalar::to_f64(stepper.tip_angle(&state));
            each(k, Scalar::any(setpoint), tip_angle);
        }
    }

    fn assess(
        &self,
        scene: &Scene,
        motion: &dyn Commanded,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Assessment, Error> {
        assess(scene, self.stepper.clone(), motion, progress)
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
            Box::new(Erased {
                type_name: type_name::<S>(),
                sizes: [size_of::<S::State>(), size_of::<S>()],
                stepper: stepper.into_any(),
            })
        }
    }
    with_stepper(scene, spec, Boxed)
}
