//! Natural modes of the clamped beam.

use super::Model;
use crate::math::{Each, array, generalized_eigen, sqrt};

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
        let frequency = values.each(|mu| 1.0 / sqrt(mu));
        let shape = array(|i| {
            let sign = if vectors[i][model.tip()] < 0.0 { -1.0 } else { 1.0 };
            vectors[i].each(|x| x * sign * frequency[i])
        });
        Self { frequency, shape }
    }

    /// `2π/ω₁`, s.
    pub fn first_period(&self) -> f64 {
        core::f64::consts::TAU / self.frequency[0]
    }
}

#[cfg(test)]
mod tests {
    use super::Modes;
    use crate::math::sqrt;
    use crate::model::EightElements;
    use crate::{Link, Scene};

    /// Roots of `cos λ cosh λ = −1`: `ω = λ² √(EI/ρA)/L²`, which eight cubic elements meet from
    /// above.
    #[test]
    fn frequencies_are_those_of_the_cantilever() {
        let link = Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 };
        let model = EightElements::consistent(&Scene::new(link)).expect("a model");
        let modes = Modes::of(&model);
        let scale = sqrt(0.46 / (0.0224 / 0.4)) / (0.4 * 0.4);
        for (i, (root, error)) in
            [(1.875_104_069, 5e-6), (4.694_091_133, 1e-4), (7.854_757_438, 1e-3)]
                .into_iter()
                .enumerate()
        {
            let ratio = modes.frequency[i] / (root * root * scale);
            assert!((1.0..1.0 + error).contains(&ratio), "mode {i}: {ratio} of the closed form");
            assert!(modes.shape[i][model.tip()] > 0.0, "mode {i} deflects to +y");
        }
    }
}
