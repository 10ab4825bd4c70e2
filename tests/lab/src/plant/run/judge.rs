//! Holds a run against what is promised of it.

use stillbeam::axis::Mode;
use stillbeam_board::machine::TICK;
use stillbeam_protocol::Refusal;

use super::Run;
use crate::plant::{Fault, Outcome};

/// Turn of the hub, rad, and swing of the tip, of L, in the arm's last period that count as rest.
const STILL: [f64; 2] = [1e-2, 1e-2];

/// Way of a stop over `v²/A`, from rate `v` with the acceleration `A` of a hub that speeds up:
/// `T(v/2 + AT/12)` with the brake's longest time, `T = 1.5√2 v/A`.
const WAY: f64 = 1.4357;

/// Error of the energy balance over work and losses that a run may have.
const ENERGY: f64 = 1e-4;

/// True if a move was refused because the drive's frame does not hold the torque that it takes.
fn is_beyond_frame(refusal: &Refusal<'_>) -> bool {
    matches!(refusal, Refusal::Range { parameter: "drive.torque", .. })
}

impl Run<'_> {
    /// Returns the stop's way over the greatest that the brake may take.
    fn way(&self) -> f64 {
        let limit = self.case.configuration.policy.limits.acceleration.unwrap_or(f64::INFINITY);
        self.stopped_from.map_or(0.0, |(from, rate)| {
            // A stop takes whole ticks.
            let most = WAY * rate * rate / limit + rate.abs() * TICK;
            (self.setpoint - from).abs() / most.max(1e-6)
        })
    }

    /// Refusals among the board's answers.
    fn refusals(&self) -> impl Iterator<Item = &Refusal<'static>> {
        self.board.answers.iter().filter_map(|answer| answer.as_ref().err())
    }

    /// Returns what was promised of the run and does not hold.
    fn judge(&self, way: f64, energy: f64) -> Vec<String> {
        let mut broken = self.broken.clone();
        let mut fail = |promise: String| broken.push(promise);
        let length = self.case.configuration.scene.link.length;
        let [turn, swing] = [self.rest.turn(), self.rest.swing() / length];
        if !self.rest.finite() {
            fail("the machine is not finite".to_owned());
        }
        if turn > STILL[0] {
            fail(format!("the hub turns by {turn:.2e} rad in the last period"));
        }
        if swing > STILL[1] {
            fail(format!("the tip swings by {swing:.2e} of L in the last period"));
        }
        if way > 1.0 {
            fail(format!("a stop took {way:.3} of its way"));
        }
        if energy > ENERGY {
            fail(format!("the energy balance is off by {energy:.1e}"));
        }
        for refusal in self.refusals().filter(|refusal| !is_beyond_frame(refusal)) {
            fail(format!("a request was refused: {refusal:?}"));
        }
        let (axis, wanted) = (self.board.axis(), self.fault.cause());
        // A hub that rests because its move was refused need not be stopped.
        let stops =
            self.stopped_from.is_some() == wanted.is_some() || self.refusals().next().is_some();
        if axis.cause() != wanted || !stops {
            fail(format!("stopped for {:?}, not {wanted:?}", axis.cause()));
        }
        let end = match self.fault {
            Fault::DriveFault => Mode::Disabled,
            _ if wanted.is_some() => Mode::Stopped,
            _ => Mode::Enabled,
        };
        if axis.mode() != end || !axis.rests() {
            fail(format!("ends {:?}, not {end:?}, at rest", axis.mode()));
        }
        broken.extend(self.watch.broken.iter().cloned());
        broken
    }

    pub(super) fn outcome(&self) -> Outcome {
        let exchanged = self.plant.work().abs() + self.plant.lost().abs();
        let energy = self.plant.energy_error().abs() / exchanged.max(1e-9);
        let way = self.way();
        let length = self.case.configuration.scene.link.length;
        Outcome {
            runs: 1,
            injected: self.injected,
            setpoints: self.watch.setpoints,
            refused: self.refusals().count() as u64,
            cut: self.cut,
            stops: u64::from(self.stopped_from.is_some()),
            way,
            behind: self.behind,
            turn: self.rest.turn(),
            swing: self.rest.swing() / length,
            energy,
            broken: self.judge(way, energy),
        }
    }
}
