//! A linear method bends twice as far when the hub turns twice as far; any method does where it
//! bends little.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::{Move, Scalar, Scene};

use crate::arms::{Turn, level_arms, turns};
use crate::cases;
use crate::methods::{Method, Property, all};
use crate::runs::{close, numbers, run};

/// A dwell and not a hold: an arm that holds falls asleep below a deflection of its own.
const REST: Move = Move::Dwell { duration: 0.5 };

struct Doubling {
    scene: Scene,
    turn: Turn,
}

impl Doubling {
    /// Twice the turn in bits: a factor of two rounds nothing.
    fn exact<M: Method, T: Scalar>(&self) -> TestCaseResult {
        let [once, twice] = [1.0, 2.0].map(|factor| {
            run::<M, T>(&self.scene, 0.0, &[self.turn.times(factor).from(0.0), REST], 0)
        });
        for (a, b) in once.iter().zip(&twice) {
            let doubled = [a.rate, a.acceleration, a.torque, a.deflection()].map(|x| T::TWO * x);
            let found = [b.rate, b.acceleration, b.torque, b.deflection()];
            prop_assert_eq!(doubled, found, "{}", M::NAME);
        }
        Ok(())
    }
}

impl Property for Doubling {
    fn holds<M: Method>(&self) -> TestCaseResult {
        if !M::LINEAR {
            return Ok(());
        }
        self.exact::<M, f32>()?;
        self.exact::<M, f64>()
    }
}

/// A factor of any size, and moves so small that the cube of what they bend is nothing.
struct Scaling {
    scene: Scene,
    turn: Turn,
    factor: f64,
}

impl Property for Scaling {
    fn holds<M: Method>(&self) -> TestCaseResult {
        let small = if M::LINEAR { self.turn } else { self.turn.times(1e-4) };
        let reach = self.scene.reach();
        let of = |turn: Turn, scale: f64| -> Vec<_> {
            run::<M, f64>(&self.scene, 0.0, &[turn.from(0.0), REST], 0)
                .iter()
                .map(numbers)
                // X shortens with the square.
                .map(|[rate, acceleration, torque, _, y]| {
                    [rate, acceleration, torque, reach / scale, y].map(|x| x * scale)
                })
                .collect()
        };
        let (factor, peak) = (self.factor, 1e-9 * reach);
        let tolerance = if M::LINEAR { 1e-9 } else { 1e-5 };
        close(M::NAME, peak, &of(small.times(factor), 1.0), &of(small, factor), tolerance)
    }
}

proptest! {
    #![proptest_config(cases(96))]

    #[test]
    fn twice_the_turn_is_twice_the_bits(scene in level_arms(), turn in turns()) {
        all(&Doubling { turn: turn.gentle(&scene), scene })?;
    }

    #[test]
    fn small_moves_scale(scene in level_arms(), turn in turns(), factor in 0.1..1.0) {
        all(&Scaling { turn: turn.gentle(&scene), scene, factor })?;
    }
}
