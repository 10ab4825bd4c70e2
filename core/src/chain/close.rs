//! A chain that closes while it runs.

use super::factors::Factors;
use super::pin::Pinned;
use super::{Chain, ChainState};
use crate::math::{Complex, Each, Scalar};

/// The factors of the mass matrix, and what a pin makes of them.
type EndAnswer<T, const LINKS: usize, const W: usize> = (Factors<T, LINKS, W>, Pinned<T, LINKS, W>);

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// Tick at which the chain closes, counted from the first one, which is 0.
    pub fn closes_at(&self) -> Option<u32> {
        self.closes
    }

    /// Closes the chain on a pin where its end is now; the joints that let go turn freely from now
    /// on. The end stops in a plastic impact: the rates jump by
    /// `−M⁻¹Gᵀ(GM⁻¹Gᵀ)⁻¹ẋ`, `G` the end's displacement per unit of the free coordinates, `ẋ` its
    /// velocity. Accelerations stay those of the latest tick, from which the next one guesses.
    #[inline(never)]
    pub fn close(&self, state: &mut ChainState<T, LINKS, W>) {
        let (factors, pinned) = self.end_answer(state);
        let to = pinned.velocity(&state.rate).map(|v| Complex::new(-v, T::ZERO));
        let (jump, _) = pinned.solve(&factors, to);
        for j in 0..LINKS {
            for k in 0..W {
                state.rate[j][k] += jump[j][k].re;
            }
        }
        for j in 0..LINKS {
            state.joints[j].rate = state.rate[j][0];
        }
        state.pin = Some(state.ends[LINKS - 1]);
        state.force = [T::ZERO; 2];
    }

    /// The answer of the closed chain's end to forces on it in the place where it is now, by the
    /// inertia of all coordinates that are free.
    fn end_answer(&self, state: &ChainState<T, LINKS, W>) -> EndAnswer<T, LINKS, W> {
        let pose = self.pose_of(state);
        let mass = self.model.mass::<C, false>(&pose);
        let none = [[Complex::ZERO; W]; LINKS];
        let factors = Factors::new(&mass.matrix, &none, &self.closed);
        let pinned = Pinned::new(&factors, self.model.tip_moves(&pose), &none);
        (factors, pinned)
    }

    /// Least over greatest of the accelerations that a force of 1 N gives the end of the closed
    /// chain: 0 where the links lie in one line, along which no force moves it.
    pub(super) fn mobility(&self, state: &ChainState<T, LINKS, W>) -> f64 {
        let (_, pinned) = self.end_answer(state);
        let [a, b, c] = pinned.end.each(|entry| entry.re.to_f64());
        let mean = 0.5 * (a + c);
        let spread = crate::math::sqrt(0.25 * (a - c) * (a - c) + b * b);
        (mean - spread) / (mean + spread)
    }
}
