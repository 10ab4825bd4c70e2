//! Turning the other way is the mirror image.

use std::f64::consts::PI;

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::Scene;

use crate::arms::{Turn, arms, level_arms, turns};
use crate::cases;
use crate::methods::{Method, Property, all};
use crate::runs::{close, numbers, run};

/// In the horizontal plane, to the bit.
struct Level {
    scene: Scene,
    turn: Turn,
}

impl Property for Level {
    fn holds<M: Method>(&self) -> TestCaseResult {
        let [there, back] = [1.0, -1.0]
            .map(|sign| run::<M, f32>(&self.scene, 0.0, &[self.turn.times(sign).from(0.0)], 50));
        for (a, b) in there.iter().zip(&back) {
            let mirrored = [-b.rate, -b.acceleration, -b.torque, b.tip[0], -b.tip[1]];
            let found = [a.rate, a.acceleration, a.torque, a.tip[0], a.tip[1]];
            prop_assert_eq!(found, mirrored, "{}", M::NAME);
            prop_assert_eq!((a.angle.turns, a.angle.part), (-b.angle.turns, -b.angle.part));
        }
        Ok(())
    }
}

/// With weight, about the vertical: θ becomes π − θ.
struct Upright {
    scene: Scene,
    from: f64,
    turn: Turn,
}

impl Property for Upright {
    fn holds<M: Method>(&self) -> TestCaseResult {
        let Self { scene, from, turn } = self;
        let there: Vec<_> =
            run::<M, f64>(scene, *from, &[turn.from(*from)], 50).iter().map(numbers).collect();
        let from = PI - from;
        let back: Vec<_> = run::<M, f64>(scene, from, &[turn.times(-1.0).from(from)], 50)
            .iter()
            .map(numbers)
            .map(|[rate, acceleration, torque, x, y]| [-rate, -acceleration, -torque, x, -y])
            .collect();
        // Asleep or not is decided at a millionth of the length.
        close(M::NAME, scene.reach(), &there, &back, 2e-6)
    }
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn turning_the_other_way_is_the_mirror_image(scene in level_arms(), turn in turns()) {
        all(&Level { turn: turn.gentle(&scene), scene })?;
    }

    #[test]
    fn weight_is_mirrored_about_the_vertical(
        scene in arms(),
        from in -4.0..4.0,
        turn in turns(),
    ) {
        all(&Upright { turn: turn.gentle(&scene), scene, from })?;
    }
}
