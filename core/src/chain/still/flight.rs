//! Effect of a bulge, found by flights: runs of the chain itself.

use super::search::Search;
use super::{Bulges, Left, TERMS};
use crate::Error;
use crate::chain::{ChainGenerator, ChainState};
use crate::math::{Each, Scalar, sqrt};

/// Change of a coefficient for the derivative, rad.
const NUDGE: f64 = 4e-3;

/// Result of a flight.
pub(super) struct Flight<T, const LINKS: usize, const W: usize> {
    pub state: ChainState<T, LINKS, W>,
    pub torque: [f64; LINKS],
    /// Largest deviation after the end, m.
    pub deviation: f64,
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Search<'_, T, LINKS, W, C, Q>
{
    /// Flies the move, and `longer` s on.
    pub(super) fn fly(
        &mut self,
        bulges: &Bulges<LINKS>,
        longer: f64,
    ) -> Result<Flight<T, LINKS, W>, Error> {
        self.flights += 1;
        let chain = self.planner.chain;
        let mut arm = ChainGenerator::<T, LINKS, W, C, Q, 1>::from_state(chain, self.begin);
        let mut ticks = 0;
        for (joint, motion) in self.moves(bulges).iter().enumerate() {
            ticks = arm.push(joint, motion)?.ticks;
        }
        let mut torque = [0.0_f64; LINKS];
        for _ in 0..=ticks {
            let setpoint = arm.tick();
            for j in 0..LINKS {
                torque[j] = torque[j].max(setpoint.joints[j].torque.to_f64().abs());
            }
        }
        let state = *arm.state();
        let still = self.planner.chain.setpoint(&self.end).ends;
        let (mut deviation, on) = (0.0, (longer / chain.tick()) as u32);
        for _ in 0..on {
            for (end, still) in arm.tick().ends.iter().zip(&still) {
                let [x, y] = [0, 1].each(|axis| (end[axis] - still[axis]).to_f64());
                deviation = f64::max(deviation, sqrt(x * x + y * y));
            }
        }
        Ok(Flight { state, torque, deviation })
    }

    pub(super) fn left(&self, flight: &Flight<T, LINKS, W>) -> Left<LINKS> {
        let mut left = [[0.0; 2]; LINKS];
        for (mode, left) in left.iter_mut().enumerate() {
            if self.modes.frequency[mode].is_finite() {
                for i in 0..C {
                    let (j, k) = (i / W, i % W);
                    let onto = self.modes.onto[mode][i];
                    left[0] += onto * (flight.state.shape[j][k] - self.end.shape[j][k]).to_f64();
                    left[1] += onto * flight.state.rate[j][k].to_f64();
                }
                left[0] *= self.modes.tip[mode];
                left[1] *= self.modes.tip[mode] / self.modes.frequency[mode];
            }
        }
        left
    }

    /// Change of the residual by a change of each coefficient.
    pub(super) fn derivative(
        &mut self,
        bulges: &Bulges<LINKS>,
        left: &Left<LINKS>,
    ) -> Result<[[Left<LINKS>; TERMS]; LINKS], Error> {
        let mut derivative = [[[[0.0; 2]; LINKS]; TERMS]; LINKS];
        for j in 0..LINKS {
            for term in 0..TERMS {
                let mut nudged = *bulges;
                nudged[j][term] += NUDGE;
                let flight = self.fly(&nudged, 0.0)?;
                let after = self.left(&flight);
                for mode in 0..LINKS {
                    for part in 0..2 {
                        derivative[j][term][mode][part] =
                            (after[mode][part] - left[mode][part]) / NUDGE;
                    }
                }
            }
        }
        Ok(derivative)
    }
}
