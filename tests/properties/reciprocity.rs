//! Maxwell and Betti: what a load here does there, the same load there does here.

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use stillbeam::math::Band;
use stillbeam::model::{EightElements, Model, Rod, TwoElements};

use crate::arms::arms;
use crate::cases;

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// `xᵀAy = yᵀAx`, `½xᵀAx` is half of it, and `bᵀA⁻¹c = cᵀA⁻¹b` of a definite matrix.
fn reciprocal<const N: usize, const W: usize>(
    a: &Band<f64, N, W>,
    definite: bool,
    loads: &[Vec<f64>; 2],
) -> TestCaseResult {
    // In units in which the diagonal is one, so that neither deflections nor slopes drown.
    let scale: [f64; N] = core::array::from_fn(|i| a.get(i, i).abs().sqrt());
    let [b, c]: [[f64; N]; 2] =
        loads.each_ref().map(|load| core::array::from_fn(|i| load[i] * scale[i]));
    let [x, y]: [[f64; N]; 2] =
        loads.each_ref().map(|load| core::array::from_fn(|i| load[i] / scale[i].max(1e-300)));
    let (there, back) = (dot(&x, &a.times(&y)), dot(&y, &a.times(&x)));
    prop_assert!((there - back).abs() <= 1e-12, "{there:e} and {back:e}");
    let (half, form) = (a.half_form().at(&x), 0.5 * dot(&x, &a.times(&x)));
    prop_assert!((half - form).abs() <= 1e-12, "{half:e} and {form:e}");
    if definite {
        let factors = a.factor();
        let (x, y) = (factors.solve(&b), factors.solve(&c));
        let (there, back) = (dot(&b, &y), dot(&c, &x));
        // Energies bound it; conditions are below 1e6.
        let size = (dot(&b, &x) * dot(&c, &y)).sqrt();
        prop_assert!((there - back).abs() <= 1e-9 * size, "{there:e} and {back:e} of {size:e}");
    }
    Ok(())
}

fn of_model<const N: usize, const W: usize>(
    model: &Model<N, W>,
    loads: &[Vec<f64>; 2],
) -> TestCaseResult {
    reciprocal(model.mass(), true, loads)?;
    reciprocal(model.stiffness(), true, loads)?;
    reciprocal(model.shortening(), true, loads)?;
    reciprocal(model.spin(), false, loads)?;
    reciprocal(model.tension(), false, loads)
}

fn loads() -> impl Strategy<Value = [Vec<f64>; 2]> {
    let load = || prop::collection::vec(-1.0..1.0, 16);
    (load(), load()).prop_map(|(a, b)| [a, b])
}

proptest! {
    #![proptest_config(cases(256))]

    #[test]
    fn loads_and_places_may_be_exchanged(scene in arms(), loads in loads()) {
        of_model(&TwoElements::consistent(&scene).expect("a model"), &loads)?;
        of_model(&EightElements::consistent(&scene).expect("a model"), &loads)?;
        if scene.payload.inertia > 0.0 {
            of_model(&Model::<5, 5>::lumped::<8>(&scene).expect("a model"), &loads)?;
        } else {
            of_model(&Model::<4, 4>::lumped::<8>(&scene).expect("a model"), &loads)?;
        }
    }

    /// The bent rod's mass matrix is computed entry by entry.
    #[test]
    fn the_bent_rod_is_reciprocal(scene in arms(), bend in prop::collection::vec(-1.0..1.0, 3)) {
        let rod = Rod::<3>::new(&scene).expect("a rod");
        let a = core::array::from_fn(|k| bend[k] / rod.tip_slope()[k]);
        let mass = rod.kinetics(&a).mass;
        for i in 0..3 {
            for j in 0..i {
                let size = (mass[i][i] * mass[j][j]).sqrt();
                prop_assert!((mass[i][j] - mass[j][i]).abs() <= 1e-12 * size);
            }
        }
    }
}
