//! The force at the end of a step that leads there.

use super::Modal;
use crate::hub::HubState;
use crate::math::{Each, Scalar, array, clip};

impl<T: Scalar, const K: usize> Modal<T, K> {
    /// The change of the force over a step that agrees with the coordinates it leads to, from that
    /// at the predicted ones: `(I + S D) e = c`, `S = θ̇²Γ − g sinχ Π`, `D` what a mode moves by
    /// for a change of its force by 1.
    ///
    /// Taken at the predicted coordinates the force would feed modes that turn more than half a
    /// turn a tick: by `½r²` a tick and less, `r` the share of `S` in the mode's stiffness. So the
    /// step is the same forwards and backwards, and neither feeds nor damps. Under gravity it is
    /// clipped to `MOST_GRAVITY_CHANGE`.
    #[inline(always)]
    pub(super) fn implied(&self, mut change: [T; K], hub: &HubState<T>) -> [T; K] {
        let rate2 = if self.terms.spin { hub.rate * hub.rate } else { T::ZERO };
        let mut stiff = self.spin.scaled(rate2);
        if self.terms.gravity {
            stiff = stiff.plus(-hub.sin, &self.tension);
        }
        let mut a: [[T; K]; K] = array(|i| {
            array(|j| {
                let unit = if i == j { T::ONE } else { T::ZERO };
                unit + stiff.get(i, j) * self.modes[j].ramp(0, T::ONE)
            })
        });
        // Elimination without pivoting: the diagonal is 1 and more but for weights near buckling.
        for p in 0..K {
            let inverse = T::ONE / a[p][p];
            for i in p + 1..K {
                let factor = a[i][p] * inverse;
                for j in p..K {
                    a[i][j] -= factor * a[p][j];
                }
                change[i] -= factor * change[p];
            }
            a[p][p] = inverse;
        }
        for p in (0..K).rev() {
            for j in p + 1..K {
                change[p] -= a[p][j] * change[j];
            }
            change[p] = change[p] * a[p][p];
        }
        if self.terms.gravity { change.each(|force| clip(force, self.most)) } else { change }
    }
}
