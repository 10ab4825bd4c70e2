//! Moves in pieces are the whole moves.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::{Move, Scalar, Scene, Setpoint};

use crate::arms::{TICK, Turn, arms, gentle_spin, turns};
use crate::cases;
use crate::methods::{Method, Property, all};
use crate::runs::{arm, close, numbers, push, run, ticks};

/// A dwell of `a + b` ticks.
#[derive(Debug)]
struct Wait {
    scene: Scene,
    turn: Turn,
    a: u32,
    b: u32,
}

fn dwell(ticks: u32) -> Move {
    Move::Dwell { duration: f64::from(ticks) * TICK }
}

impl Wait {
    /// Between two moves, in one piece, in two, and as no move at all but time that passes.
    fn at_rest<M: Method, T: Scalar>(&self) -> TestCaseResult {
        let Self { scene, turn, a, b } = self;
        let (there, back) = (turn.from(0.3), turn.times(-1.0).from(0.3 + turn.by));
        let whole = run::<M, T>(scene, 0.3, &[there, dwell(a + b), back], 0);
        let split = run::<M, T>(scene, 0.3, &[there, dwell(*a), dwell(*b), back], 0);
        prop_assert_eq!(&whole, &split, "{}", M::NAME);

        let mut arm = arm::<M, T>(scene, 0.3);
        let count = push(&mut arm, &[there]) + a + b;
        let mut held = ticks(&mut arm, count);
        let count = push(&mut arm, &[back]) + 1;
        held.extend(ticks(&mut arm, count));
        // What holds may sleep, which leaves a millionth of the length.
        let peak = whole.iter().map(|s| s.deflection().to_f64().abs()).fold(0.0, f64::max);
        let bound = 4e-6 * scene.reach() + rounding::<T>() * peak;
        for (a, b) in whole.iter().zip(&held) {
            let apart = (a.deflection().to_f64() - b.deflection().to_f64()).abs();
            prop_assert!(apart <= bound, "{}: {apart:e} m", M::NAME);
            prop_assert!((a.angle.in_turns() - b.angle.in_turns()).abs() <= resolution::<T>());
        }
        Ok(())
    }

    /// The same on a hub that turns: a cruise.
    fn cruising<M: Method, T: Scalar>(&self, rate: f64) -> TestCaseResult {
        let Self { scene, a, b, .. } = self;
        let (up, down) = (spin(rate), spin(0.0));
        let whole = run::<M, T>(scene, 0.3, &[up, dwell(a + b), down], 0);
        let split = run::<M, T>(scene, 0.3, &[up, dwell(*a), dwell(*b), down], 0);
        let tolerance = rounding::<T>();
        same(M::NAME, scene, &whole, &split, tolerance)?;

        let mut arm = arm::<M, T>(scene, 0.3);
        let count = push(&mut arm, &[up]) + a + b;
        let mut cut = ticks(&mut arm, count);
        let count = push(&mut arm, &[down]) + 1;
        cut.extend(ticks(&mut arm, count));
        same(M::NAME, scene, &whole, &cut, tolerance)
    }
}

/// Effect that a last bit of the input may have on a setpoint: in f32 eight elements lose three
/// digits, see `precision`.
fn rounding<T: Scalar>() -> f64 {
    2e4 * T::EPSILON.to_f64()
}

/// Two last bits of half a turn.
fn resolution<T: Scalar>() -> f64 {
    2.0 * T::EPSILON.to_f64()
}

fn spin(rate: f64) -> Move {
    Move::SpinUp { duration: 0.8, rate }
}

fn same<T: Scalar>(
    name: &str,
    scene: &Scene,
    a: &[Setpoint<T>],
    b: &[Setpoint<T>],
    tolerance: f64,
) -> TestCaseResult {
    for (a, b) in a.iter().zip(b) {
        let apart = (a.angle.in_turns() - b.angle.in_turns()).abs();
        prop_assert!(apart <= resolution::<T>(), "{name}: {apart:e} turns");
    }
    let [a, b] = [a, b].map(|run| run.iter().map(numbers).collect::<Vec<_>>());
    close(name, scene.reach(), &a, &b, tolerance)
}

impl Property for Wait {
    fn holds<M: Method>(&self) -> TestCaseResult {
        self.at_rest::<M, f32>()?;
        self.at_rest::<M, f64>()
    }
}

struct Cruise {
    wait: Wait,
    rate: f64,
}

impl Property for Cruise {
    fn holds<M: Method>(&self) -> TestCaseResult {
        self.wait.cruising::<M, f32>(self.rate)?;
        self.wait.cruising::<M, f64>(self.rate)
    }
}

fn waits() -> impl Strategy<Value = Wait> {
    (arms(), turns(), 1_u32..80, 1_u32..80).prop_map(|(scene, turn, a, b)| Wait {
        turn: turn.gentle(&scene),
        scene,
        a,
        b,
    })
}

proptest! {
    #![proptest_config(cases(48))]

    #[test]
    fn a_dwell_in_pieces_is_the_dwell(wait in waits()) {
        all(&wait)?;
    }

    #[test]
    fn a_cruise_in_pieces_is_the_cruise(wait in waits(), rate in -3.0..3.0) {
        // Slow against the first frequency, so that small-deflection kinematics have a meaning.
        let turn = Turn { by: rate, ..wait.turn }.gentle(&wait.scene);
        let rate = gentle_spin(&wait.scene, 0.9 * turn.by.clamp(-3.0, 3.0), 0.8);
        all(&Cruise { rate, wait })?;
    }
}
