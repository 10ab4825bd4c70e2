//! The factors solve the equation that was asked.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::math::Band;
use stillbeam::model::{EightElements, FourElements, Model, OneElement};
use stillbeam::{Scalar, Scene};

use crate::arms::arms;
use crate::cases;

/// `|Ax − b| ≤ c N ε (|A||x| + |b|)`, row by row: the residual that elimination without pivoting
/// leaves with a positive definite matrix, whatever its condition. ε is a rounding, half of
/// [`Scalar::EPSILON`]; c = 8 is twice what N² of the theorem allows per column of a band of four.
fn residual<T: Scalar, const N: usize, const W: usize>(
    a: &Band<f64, N, W>,
    b: &[f64],
) -> TestCaseResult {
    let a: Band<T, N, W> = a.map(T::from_f64);
    let b: [T; N] = core::array::from_fn(|i| T::from_f64(b[i]));
    let factors = a.factor();
    prop_assert!(factors.is_positive(), "a positive definite matrix");
    let x = factors.solve(&b).map(T::to_f64);
    // Scaled rows: deflections and slopes have units of their own.
    let scale: [f64; N] = core::array::from_fn(|i| a.get(i, i).to_f64().sqrt());
    let size = (0..N).map(|j| scale[j] * x[j].abs()).fold(0.0, f64::max);
    for i in 0..N {
        let (mut sum, mut load) = (0.0, b[i].to_f64().abs());
        for j in 0..N {
            sum += a.get(i, j).to_f64() * x[j];
            load += (a.get(i, j).to_f64() * x[j]).abs();
        }
        let bound = 8.0 * N as f64 * 0.5 * T::EPSILON.to_f64() * (load + scale[i] * size);
        let off = (sum - b[i].to_f64()).abs();
        prop_assert!(off <= bound, "row {i} of {N}: {off:e} above {bound:e}");
    }
    Ok(())
}

fn of_model<const N: usize, const W: usize>(
    model: &Model<N, W>,
    tick: f64,
    b: &[f64],
) -> TestCaseResult {
    // What Newmark's rule factors, from a tick that the inertia rules to one of the stiffness.
    let inertia = 4.0 / (tick * tick);
    let effective = model.stiffness().plus(inertia, model.mass());
    for matrix in [model.mass(), model.stiffness(), &effective] {
        residual::<f64, N, W>(matrix, b)?;
    }
    // The stiffness of eight elements has condition 1e5, and its own rounding to f32 can take its
    // least pivot; set-up factors it in f64.
    residual::<f32, N, W>(&effective, b)
}

fn loads() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(-1.0..1.0, 16)
}

fn lumped(scene: &Scene, tick: f64, b: &[f64]) -> TestCaseResult {
    if scene.payload.inertia > 0.0 {
        of_model(&Model::<5, 5>::lumped::<8>(scene).expect("a model"), tick, b)
    } else {
        of_model(&Model::<4, 4>::lumped::<8>(scene).expect("a model"), tick, b)
    }
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn the_residual_is_rounding(scene in arms(), b in loads(), digits in -4.0..0.0) {
        let tick = 10_f64.powf(digits);
        of_model(&OneElement::consistent(&scene).expect("a model"), tick, &b)?;
        of_model(&FourElements::consistent(&scene).expect("a model"), tick, &b)?;
        of_model(&EightElements::consistent(&scene).expect("a model"), tick, &b)?;
        lumped(&scene, tick, &b)?;
    }
}
