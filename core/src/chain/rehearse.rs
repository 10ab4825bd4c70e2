//! A rehearsal: what is queued, run ahead of time once in ticks and once in half ticks.
//!
//! Both runs are the same method, of third order. Where they part, the tick is too long for the
//! chain and its moves: seven eighths of the tick's own error show. Where the end of a loop leaves
//! its pin, the loop is asked to go where its links do not reach.

use super::generator::ChainSetpoint;
use super::weights::Weights;
use super::{Chain, ChainGenerator, ChainState, Command, Model};
use crate::Error;
use crate::math::{Each, Scalar, sqrt};
use crate::scene::Damping;

/// Largest distance of a link's end in ticks from that in half ticks, of all lengths.
const APART: f64 = 0.02;
/// Largest deflection of a link with two curvature coordinates, of its length. Farther bent, they
/// are not the strip's shape, however short the tick: of 1,560 random mechanisms none that stayed
/// below it erred by more than 0.066 of its length, and those above it by up to 0.8.
const DEFLECTION: f64 = 0.6;
/// Largest distance of a loop's end from its pin, of all lengths.
const GAP: f64 = 1e-3;
/// Least mobility of a loop's end along any direction, of that along the best one.
const MOBILITY: f64 = 1e-5;

/// Findings of a rehearsal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rehearsal<const LINKS: usize> {
    /// Largest distance of a link's end from where half ticks take it, of all lengths. The error of
    /// the tick is about 8/7 of it.
    pub apart: f64,
    /// Largest torque of each joint's motor, N m.
    pub torque: [f64; LINKS],
}

impl<
    T: Scalar,
    const LINKS: usize,
    const W: usize,
    const C: usize,
    const Q: usize,
    const QUEUE: usize,
> ChainGenerator<T, LINKS, W, C, Q, QUEUE>
{
    /// Runs the coming `ticks` ticks ahead of time, by copies of the chain and its queues. To be
    /// asked before the first tick of what is queued, where nothing is urgent: it takes three times
    /// as long as these ticks. Nothing changes.
    ///
    /// # Errors
    /// [`Error::TickTooLong`] if the tick does not resolve what the chain does,
    /// [`Error::DeflectsTooFar`] if two curvature coordinates do not follow a link's shape,
    /// [`Error::LeavesPin`] if a loop is to go beyond its reach, [`Error::StraightLoop`] if it
    /// comes to lie in one line, [`Error::Moving`] during a stop.
    pub fn rehearse(&self, ticks: u32) -> Result<Rehearsal<LINKS>, Error> {
        if self.stop.is_some() {
            return Err(Error::Moving);
        }
        let half = self.chain.halved();
        let (mut whole, mut fine) = (self.clone(), self.state);
        let mut found = Rehearsal { apart: 0.0, torque: [0.0; LINKS] };
        for k in 1..=ticks {
            let first = whole.next == 0;
            let commands = whole.half_commands();
            let setpoint = whole.tick();
            if !first {
                half.step(&mut fine, &commands[0]);
                half.step(&mut fine, &commands[1]);
            }
            let other = half.setpoint(&fine);
            // The generator has closed itself after its setpoint.
            if whole.state.is_closed() && !fine.is_closed() {
                half.close(&mut fine);
            }
            let time = f64::from(k) * self.chain.tick;
            self.judge(&setpoint, &other, &whole.state, time, &mut found)?;
        }
        Ok(found)
    }

    /// Compares both runs at a tick.
    fn judge(
        &self,
        whole: &ChainSetpoint<T, LINKS>,
        half: &ChainSetpoint<T, LINKS>,
        state: &ChainState<T, LINKS, W>,
        time: f64,
        found: &mut Rehearsal<LINKS>,
    ) -> Result<(), Error> {
        let Chain { length, tick, .. } = self.chain;
        if let Some(pin) = state.pin {
            let gap = distance(whole.tip(), pin);
            if !(..=GAP * length).contains(&gap) {
                return Err(Error::LeavesPin { gap, time });
            }
            if !(MOBILITY..).contains(&self.chain.mobility(state)) {
                return Err(Error::StraightLoop { time });
            }
        }
        for j in 0..LINKS {
            let apart = distance(whole.ends[j], half.ends[j]) / length;
            let deflection = whole.joints[j].tip[1].to_f64().abs();
            let most = DEFLECTION * self.chain.model.length(j);
            if W == 3 && deflection > most {
                return Err(Error::DeflectsTooFar { deflection, most });
            }
            // NaN is not below it either.
            if !(..=APART).contains(&apart) {
                return Err(Error::TickTooLong { tick, apart, time });
            }
            found.apart = found.apart.max(apart);
            found.torque[j] = found.torque[j].max(whole.joints[j].torque.to_f64().abs());
        }
        Ok(())
    }

    /// The commands of both halves of the coming tick. The queues stay where they are.
    fn half_commands(&self) -> [[Command<T>; LINKS]; 2] {
        let at = |ahead: f64| {
            let ahead = T::from_f64(ahead);
            self.queues.each_ref().map(|queue| queue.far(ahead))
        };
        let ends = [[at(1.0 / 6.0), at(0.5)], [at(2.0 / 3.0), at(1.0)]];
        ends.map(|[third, end]| core::array::from_fn(|j| Command { third: third[j], end: end[j] }))
    }
}

fn distance<T: Scalar>(a: [T; 2], b: [T; 2]) -> f64 {
    let [x, y] = [0, 1].each(|axis| (a[axis] - b[axis]).to_f64());
    sqrt(x * x + y * y)
}

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// Length of link `j`, m.
    fn length(&self, j: usize) -> f64 {
        self.links[j].lengths.iter().map(|length| length.to_f64()).sum()
    }
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// The same chain in steps of half a tick.
    fn halved(&self) -> Self {
        let tick = 0.5 * self.tick;
        let (alpha, beta) = (self.model.alpha.to_f64(), self.model.beta.to_f64());
        let damping = Damping { alpha, beta, joint: 0.0 };
        let weights = Weights::new(tick, &damping);
        Self { diagonal: self.model.diagonal(&weights), weights, tick, ..*self }
    }
}
