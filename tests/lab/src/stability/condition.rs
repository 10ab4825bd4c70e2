//! Rounding errors of f32 in the effective matrix `4/h² M + K` and in `K q`.

use nalgebra::{DMatrix, DVector};
use stillbeam::Scene;
use stillbeam::model::Model;
use stillbeam_erased::{Marched, Mass, ModelVisitor, with_model};

use super::probe;
use stillbeam_sim::error::Error;
use stillbeam_sim::solver::ELEMENTS;

/// Rounding errors for one number of elements at one tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Loss {
    /// Number of elements.
    pub elements: usize,
    /// ω₁h.
    pub turn: f64,
    /// Condition number of the matrix as it is assembled, in m and rad.
    pub assembled: f64,
    /// Condition number after scaling each degree of freedom so that the diagonal is 1.
    pub scaled: f64,
    /// Relative error of the tip in a solution in f32: with factors of the matrix as assembled, and
    /// scaled.
    pub solved: [f64; 2],
    /// Relative error of `ω₁²q₁` by way of `K q` in f32, `q` the first mode: as assembled, and by
    /// the elements' deformations.
    pub product: [f64; 2],
}

/// Computes the errors for all numbers of elements at some ticks, with the arm of [`probe::arm`].
pub fn losses(turns: &[f64]) -> Result<Vec<Loss>, Error> {
    let omega = 1.0;
    let arm = probe::arm(omega)?;
    let mut all = Vec::new();
    for elements in ELEMENTS {
        for &turn in turns {
            let of = Of { arm: &arm, elements, tick: turn / omega };
            let loss = with_model(&arm, elements, Mass::Consistent, of).map_err(Error::new)?;
            all.push(loss);
        }
    }
    Ok(all)
}

struct Of<'a> {
    arm: &'a Scene,
    elements: usize,
    tick: f64,
}

impl ModelVisitor for Of<'_> {
    type Output = Loss;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Loss
    where
        Model<N, W>: Marched,
    {
        let full = |get: &dyn Fn(usize, usize) -> f64| DMatrix::from_fn(N, N, get);
        let mass = full(&|i, j| model.mass().get(i, j));
        let stiffness = full(&|i, j| model.stiffness().get(i, j));
        let effective = &mass * (4.0 / (self.tick * self.tick)) + &stiffness;
        let scale = DVector::from_fn(N, |i, _| 1.0 / effective[(i, i)].sqrt());
        let scaled = DMatrix::from_fn(N, N, |i, j| scale[i] * effective[(i, j)] * scale[j]);
        // The load of a turning hub.
        let load = DVector::from_fn(N, |i, _| model.coupling()[i]);
        let tip = model.tip();
        let exact = effective.clone().cholesky().map(|factors| factors.solve(&load));
        let exact = exact.map_or(f64::NAN, |x| x[tip]);
        let single = |matrix: &DMatrix<f64>, load: &DVector<f64>| {
            let factors = matrix.map(|x| x as f32).cholesky();
            factors.map(|factors| factors.solve(&load.map(|x| x as f32)))
        };
        let off = |found: Option<f64>| found.map_or(f64::INFINITY, |x| (x / exact - 1.0).abs());
        let plain = single(&effective, &load).map(|x| f64::from(x[tip]));
        let by_scale = single(&scaled, &load.component_mul(&scale));
        let by_scale = by_scale.map(|x| f64::from(x[tip]) * scale[tip]);
        // The first mode, by inverse iteration.
        let mut mode = load.clone();
        for _ in 0..40 {
            mode = stiffness.clone().cholesky().map_or(mode.clone(), |k| k.solve(&(&mass * &mode)));
            mode /= mode.norm();
        }
        Loss {
            elements: self.elements,
            turn: self.tick,
            assembled: condition(&effective),
            scaled: condition(&scaled),
            solved: [off(plain), off(by_scale)],
            product: products(self.arm, self.elements, &stiffness, &mode),
        }
    }
}

fn condition(matrix: &DMatrix<f64>) -> f64 {
    let values = matrix.symmetric_eigenvalues();
    values.max() / values.min()
}

/// Returns the relative errors of `qᵀK q` in f32, `q` rounded: by the rows of `K`, and by each
/// element's two end rotations against its chord.
fn products(
    arm: &Scene,
    elements: usize,
    stiffness: &DMatrix<f64>,
    mode: &DVector<f64>,
) -> [f64; 2] {
    let n = mode.len();
    // Of many scales of the same mode the largest: one may round well by chance.
    let mut worst = [0.0_f64; 2];
    for k in 0..64 {
        let q = mode.map(|x| (x * (1.0 + f64::from(k) / 64.0)) as f32);
        let exact = q.map(f64::from);
        let energy = exact.dot(&(stiffness * &exact));
        let matrix = stiffness.map(|x| x as f32);
        let assembled = (matrix * q.clone()).map(f64::from).dot(&exact);
        let length = (arm.link.length / elements as f64) as f32;
        let stiff = (arm.link.bending_stiffness / f64::from(length)) as f32;
        let mut local = 0.0_f64;
        for e in 0..elements {
            let at = |i: usize| if i < 2 { 0.0 } else { q[i - 2] };
            let chord = (at(2 * e + 2) - at(2 * e)) / length;
            let [a, b] = [at(2 * e + 1) - chord, at(2 * e + 3) - chord];
            let moments = [stiff * (4.0 * a + 2.0 * b), stiff * (2.0 * a + 4.0 * b)];
            local += f64::from(moments[0]) * f64::from(a) + f64::from(moments[1]) * f64::from(b);
        }
        debug_assert_eq!(n, 2 * elements);
        for (worst, found) in worst.iter_mut().zip([assembled, local]) {
            *worst = worst.max((found / energy - 1.0).abs());
        }
    }
    worst
}
