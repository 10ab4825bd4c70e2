//! Where the hub begins does not matter in the horizontal plane; whole turns never do.

use std::f64::consts::TAU;

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::Scene;

use crate::arms::{Turn, arms, level_arms, turns};
use crate::cases;
use crate::methods::{Method, Property, all};
use crate::runs::{close, numbers, run};

struct Elsewhere {
    scene: Scene,
    turn: Turn,
    from: [f64; 2],
}

impl Property for Elsewhere {
    fn holds<M: Method>(&self) -> TestCaseResult {
        let [here, there] = self.from.map(|from| {
            let run = run::<M, f64>(&self.scene, from, &[self.turn.from(from)], 50);
            run.iter().map(numbers).collect::<Vec<_>>()
        });
        // An angle of 10⁴ rad resolves to 2e-12 rad; an arm may fall asleep a tick later.
        close(M::NAME, self.scene.reach(), &here, &there, 2e-6)
    }
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn the_first_angle_does_not_matter(
        scene in level_arms(),
        turn in turns(),
        from in -1e4..1e4,
    ) {
        all(&Elsewhere { turn: turn.gentle(&scene), scene, from: [0.0, from] })?;
    }

    #[test]
    fn whole_turns_do_not_matter(
        scene in arms(),
        turn in turns(),
        from in -4.0..4.0,
        whole in -1000_i32..1000,
    ) {
        let from = [from, from + f64::from(whole) * TAU];
        all(&Elsewhere { turn: turn.gentle(&scene), scene, from })?;
    }
}
