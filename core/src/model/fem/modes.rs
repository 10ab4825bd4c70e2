//! Natural modes of the clamped beam.

use super::Model;
use crate::math::{generalized_eigen, sqrt};

/// The modes of `K φ = ω² M φ`, lowest first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Modes<const N: usize> {
    /// `ωᵢ`, rad/s.
    pub frequency: [f64; N],
    /// `φᵢ` over the model's degrees of freedom, `φᵢᵀ M φⱼ = δᵢⱼ`, the tip deflecting to +y.
    pub shape: [[f64; N]; N],
}

impl<const N: usize> Modes<N> {
    /// All modes of the model: cyclic Jacobi, relative error of the lower half below 1e-12.
    pub fn of<const W: usize>(model: &Model<N, W>) -> Self {
        let (values, vectors) = generalized_eigen(model.stiffness(), model.mass());
        let frequency = values.map(|mu| 1.0 / sqrt(mu));
        let shape = core::array::from_fn(|i| {
            let sign = if vectors[i][model.tip()] < 0.0 { -1.0 } else { 1.0 };
            vectors[i].map(|x| x * sign * frequency[i])
        });
        Self { frequency, shape }
    }

    /// `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        core::f64::consts::TAU / self.frequency[0]
    }
}
