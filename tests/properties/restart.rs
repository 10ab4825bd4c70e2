//! A copy of a generator, or of its state, goes on with the same bits.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::{Move, Scalar, Scene};

use crate::arms::{Turn, arms, turns};
use crate::cases;
use crate::methods::{Method, Property, all};
use crate::runs::{arm, push, ticks};

#[derive(Debug)]
struct Saved {
    scene: Scene,
    turn: Turn,
    from: f64,
    /// Tick at which it is saved.
    at: u32,
}

impl Saved {
    fn to_the_bit<M: Method, T: Scalar>(&self) -> TestCaseResult {
        // To the end in moves: where the hub holds, the arm may sleep, and a state that is set
        // wakes it.
        let [pause, rest] = [0.2, 10.0].map(|duration| Move::Dwell { duration });
        let moves = [self.turn.from(self.from), pause, self.back(), rest];
        let mut original = arm::<M, T>(&self.scene, self.from);
        push(&mut original, &moves);
        ticks(&mut original, self.at);

        let mut copy = original.clone();
        let state = *original.state();
        let rest = ticks(&mut original, 400);
        prop_assert_eq!(&ticks(&mut copy, 400), &rest, "{}: the copy", M::NAME);

        // Another arm on the same way, whose state was lost and put back.
        let mut other = arm::<M, T>(&self.scene, self.from);
        push(&mut other, &moves);
        ticks(&mut other, self.at);
        let lost = *arm::<M, T>(&self.scene, 1.0).state();
        other.set_state(lost);
        other.set_state(state);
        prop_assert_eq!(&ticks(&mut other, 400), &rest, "{}: the state", M::NAME);
        Ok(())
    }

    fn back(&self) -> Move {
        Move::To { profile: self.turn.profile, duration: self.turn.duration, to: self.from }
    }
}

impl Property for Saved {
    fn holds<M: Method>(&self) -> TestCaseResult {
        self.to_the_bit::<M, f32>()?;
        self.to_the_bit::<M, f64>()
    }
}

/// A move that is refused.
struct Refused(Saved);

impl Property for Refused {
    fn holds<M: Method>(&self) -> TestCaseResult {
        let Saved { scene, turn, from, at } = &self.0;
        let [mut asked, mut left] = [(); 2].map(|()| {
            let mut arm = arm::<M, f32>(scene, *from);
            push(&mut arm, &[turn.from(*from)]);
            ticks(&mut arm, *at);
            arm
        });
        for bad in [
            Move::To { profile: turn.profile, duration: f64::NAN, to: 0.0 },
            Move::To { profile: turn.profile, duration: 1.0, to: f64::INFINITY },
            Move::SpinUp { duration: 0.5, rate: 1e5 },
            Move::Dwell { duration: -1.0 },
        ] {
            prop_assert!(asked.push(&bad).is_err(), "{}: {bad:?}", M::NAME);
        }
        prop_assert_eq!(ticks(&mut asked, 400), ticks(&mut left, 400), "{}", M::NAME);
        Ok(())
    }
}

fn saved() -> impl Strategy<Value = Saved> {
    (arms(), turns(), -4.0..4.0, 1_u32..500).prop_map(|(scene, turn, from, at)| Saved {
        turn: turn.gentle(&scene),
        scene,
        from,
        at,
    })
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn a_saved_state_goes_on_to_the_bit(saved in saved()) {
        all(&saved)?;
    }

    #[test]
    fn a_refused_move_changes_no_bit(saved in saved()) {
        all(&Refused(saved))?;
    }
}
