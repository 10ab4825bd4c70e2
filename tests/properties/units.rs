//! Nothing depends on the units that length, mass and time are counted in.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::{Damping, Generator, Hub, Link, Move, Payload, Scene};

use crate::arms::{TICK, Turn, arms, turns};
use crate::cases;
use crate::methods::{Method, Property, all};
use crate::runs::{Numbers, QUEUE, close, numbers, push, ticks};

/// How many new units an old one is.
#[derive(Clone, Copy, Debug)]
struct Units {
    length: f64,
    mass: f64,
    time: f64,
}

impl Units {
    fn scene(&self, s: &Scene) -> Scene {
        let Self { length, mass, time } = *self;
        let inertia = mass * length * length;
        Scene {
            link: Link {
                length: s.link.length * length,
                mass: s.link.mass * mass,
                bending_stiffness: s.link.bending_stiffness * inertia * length / (time * time),
            },
            shape: s.shape,
            hub: Hub {
                radius: s.hub.radius * length,
                inertia: s.hub.inertia * inertia,
                stiffness: s.hub.stiffness.map(|k| k * inertia / (time * time)),
            },
            payload: Payload {
                mass: s.payload.mass * mass,
                inertia: s.payload.inertia * inertia,
                offset: s.payload.offset * length,
            },
            damping: Damping {
                alpha: s.damping.alpha / time,
                beta: s.damping.beta * time,
                joint: s.damping.joint * time,
            },
            gravity: s.gravity * length / (time * time),
        }
    }

    /// Numbers in the new units, in the old ones.
    fn back(&self, [rate, acceleration, torque, x, y]: Numbers) -> Numbers {
        let Self { length, mass, time } = *self;
        [
            rate * time,
            acceleration * time * time,
            torque * time * time / (mass * length * length),
            x / length,
            y / length,
        ]
    }
}

struct Change {
    scene: Scene,
    turn: Turn,
    units: Units,
}

impl Change {
    fn run<M: Method>(&self, units: &Units) -> Vec<Numbers> {
        let scene = units.scene(&self.scene);
        let stepper = M::stepper::<f64>(&scene, TICK * units.time).expect("an arm");
        let mut arm = Generator::<_, QUEUE>::new(stepper, 0.3).expect("an angle");
        let turn = Turn { duration: self.turn.duration * units.time, ..self.turn };
        // A dwell and not a hold, which falls asleep a tick sooner or later by a last bit.
        let rest = Move::Dwell { duration: 50.0 * TICK * units.time };
        let count = push(&mut arm, &[turn.from(0.3), rest]);
        ticks(&mut arm, count).iter().map(numbers).map(|now| units.back(now)).collect()
    }
}

impl Property for Change {
    fn holds<M: Method>(&self) -> TestCaseResult {
        let old = self.run::<M>(&Units { length: 1.0, mass: 1.0, time: 1.0 });
        let new = self.run::<M>(&self.units);
        close(M::NAME, self.scene.reach(), &old, &new, 2e-6)
    }
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn units_are_a_matter_of_taste(
        scene in arms(),
        turn in turns(),
        (length, mass, time) in (0.05..20.0, 0.05..20.0, 0.02..20.0),
    ) {
        let units = Units { length, mass, time };
        // A pendulum's gravity and a drag's rate have their own greatest values.
        prop_assume!(units.scene(&scene).validate().is_ok());
        all(&Change { turn: turn.gentle(&scene), scene, units })?;
    }
}
