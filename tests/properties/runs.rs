//! Arms driven through moves, and how runs are compared.

use proptest::prelude::*;
use proptest::test_runner::TestCaseError;
use stillbeam::{Generator, Move, Scalar, Scene, Setpoint, Stepper};

use crate::arms::TICK;
use crate::methods::Method;

/// Room for every queue of moves here.
pub const QUEUE: usize = 32;

/// A setpoint of either precision in f64: rate, acceleration, torque, tip X and Y.
pub type Numbers = [f64; 5];

/// A generator of the method at rest.
pub fn arm<M: Method, T: Scalar>(scene: &Scene, from: f64) -> Generator<M::Stepper<T>, QUEUE> {
    let stepper = M::stepper::<T>(scene, TICK).expect("an arm that every method takes");
    Generator::new(stepper, from).expect("an angle")
}

/// Pushes the moves and returns the ticks they take.
pub fn push<S: Stepper>(arm: &mut Generator<S, QUEUE>, moves: &[Move]) -> u32 {
    moves.iter().map(|motion| arm.push(motion).expect("a gentle move").ticks).sum()
}

/// The next setpoints.
pub fn ticks<S: Stepper>(arm: &mut Generator<S, QUEUE>, count: u32) -> Vec<Setpoint<S::Scalar>> {
    (0..count).map(|_| arm.tick()).collect()
}

/// All setpoints of the moves from rest at `from`, and `after` more.
pub fn run<M: Method, T: Scalar>(
    scene: &Scene,
    from: f64,
    moves: &[Move],
    after: u32,
) -> Vec<Setpoint<T>> {
    let mut arm = arm::<M, T>(scene, from);
    let count = push(&mut arm, moves) + 1 + after;
    ticks(&mut arm, count)
}

/// A setpoint's numbers.
pub fn numbers<T: Scalar>(s: &Setpoint<T>) -> Numbers {
    [s.rate, s.acceleration, s.torque, s.tip[0], s.tip[1]].map(T::to_f64)
}

/// Greatest magnitude of each number over a run.
pub fn peaks(run: &[Numbers]) -> Numbers {
    run.iter().fold([0.0; 5], |peak, now| core::array::from_fn(|i| peak[i].max(now[i].abs())))
}

/// Fails unless each number is the same in both runs to `tolerance` of its peak; of X, to that of
/// the arm's reach, and of Y to that of the peak of Y or a thousandth of the reach.
pub fn close(
    name: &str,
    reach: f64,
    a: &[Numbers],
    b: &[Numbers],
    tolerance: f64,
) -> Result<(), TestCaseError> {
    prop_assert_eq!(a.len(), b.len());
    let mut scale = peaks(a);
    scale[4] = scale[4].max(1e-3 * reach);
    for (k, (a, b)) in a.iter().zip(b).enumerate() {
        for i in 0..5 {
            let apart = (a[i] - b[i]).abs();
            prop_assert!(
                apart <= tolerance * scale[i],
                "{name}, tick {k}, number {i}: {:e} and {:e} are {:.1e} of {:e} apart",
                a[i],
                b[i],
                apart / scale[i],
                scale[i]
            );
        }
    }
    Ok(())
}
