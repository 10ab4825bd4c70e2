//! Natural modes of the clamped beam.

use super::Model;
use crate::math::{Each, array, generalized_eigen, lowest_eigen, sqrt};

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

/// The lowest `K` modes of a model, 1 to 3, for a tick.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LowestModes<const K: usize, const N: usize> {
    /// `ωᵢ`, rad/s.
    pub frequency: [f64; K],
    /// Shapes of unit stiffness, `φᵢᵀ K φⱼ = δᵢⱼ`, the tip deflecting to +y.
    pub shape: [[f64; N]; K],
}

impl<const K: usize, const N: usize> LowestModes<K, N> {
    /// By Lanczos's method, at a thirtieth of the cost of [`Modes::of`]. Relative error of the
    /// frequencies `1e-11 + 1e-14 (ωₖ/ω₁)²`, asserted by the tests with payloads of up to 400,000
    /// links.
    pub fn of<const W: usize>(model: &Model<N, W>) -> Self {
        const { assert!(1 <= K && K <= 3, "1 to 3 modes") }
        let (stiffness, mass) = (model.stiffness(), model.mass());
        let (values, vectors) = match K {
            1 => lowest_eigen::<K, 6, N, W>(stiffness, mass),
            2 => lowest_eigen::<K, 8, N, W>(stiffness, mass),
            _ => lowest_eigen::<K, 10, N, W>(stiffness, mass),
        };
        Self {
            frequency: values.each(|mu| 1.0 / sqrt(mu)),
            shape: vectors.each(|vector| {
                let sign = if vector[model.tip()] < 0.0 { -1.0 } else { 1.0 };
                vector.each(|x| sign * x)
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{LowestModes, Modes};
    use crate::math::sqrt;
    use crate::model::{EightElements, FourElements, Model};
    use crate::{Link, Scene};

    /// Those of Jacobi's method, with payloads of all sizes, their inertia and lever, and a joint
    /// that gives.
    #[test]
    fn the_lowest_modes_are_among_all() {
        let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
        for mass in [0.0, 1e-6, 1e-3, 0.01, 0.1, 1.0, 1e2, 1e4] {
            for inertia in [0.0, 1e-9, 1e-5, 1e-3] {
                for (offset, stiffness) in [(0.0, None), (0.02, Some(3.0)), (0.0, Some(0.1))] {
                    scene.payload = crate::Payload { mass, inertia, offset };
                    scene.hub.stiffness = stiffness;
                    let name = (mass, inertia, offset);
                    let model = EightElements::consistent(&scene).expect("a model");
                    compare::<1, 16, 4>(&model, name);
                    compare::<2, 16, 4>(&model, name);
                    compare::<3, 16, 4>(&model, name);
                    compare::<3, 8, 4>(&FourElements::consistent(&scene).expect("a model"), name);
                }
            }
        }
    }

    fn compare<const K: usize, const N: usize, const W: usize>(
        model: &Model<N, W>,
        name: (f64, f64, f64),
    ) {
        let (all, lowest) = (Modes::of(model), LowestModes::<K, N>::of(model));
        for k in 0..K {
            let ratio = lowest.frequency[k] / all.frequency[k];
            let apart = all.frequency[k] / all.frequency[0];
            let most = 1e-11 + 1e-14 * apart * apart;
            assert!((ratio - 1.0).abs() < most, "{name:?}, {K} modes, mode {k}: {ratio}");
            let shape = all.shape[k].map(|x| x / all.frequency[k]);
            let off = core::array::from_fn(|i| lowest.shape[k][i] - shape[i]);
            let pull = model.stiffness().times(&off);
            let energy: f64 = pull.iter().zip(&off).map(|(f, x)| f * x).sum();
            // The tip of an arm with a payload of a million links moves in its first mode only.
            assert!(energy < 10.0 * most * most || name.0 > 1e3, "{name:?}, mode {k}: {energy:e}");
        }
    }

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
