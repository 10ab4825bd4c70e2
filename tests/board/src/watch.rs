//! Promises that every setpoint keeps, whatever happens.

use std::f64::consts::TAU;

use stillbeam::Limits;
use stillbeam::axis::Mode;
use stillbeam::motor::Ratio;

use crate::board::Step;

/// Judges the setpoints of an axis one by one. While the drive is on, with `A` the limit of
/// acceleration, `V` that of rate and `h` the tick:
///
/// - the shaft's angle is continuous: from tick to tick it turns by the mean of the two rates times
///   h, to `¼Ah²`, twice what the trapezoidal rule can be off by where the acceleration jumps, and
///   the resolution of a move's angle in f32, 2⁻¹⁶ turn for the longest that are accepted;
/// - the rate changes by at most `Ah` a tick;
/// - rate and acceleration keep their limits, to 1e-3 and the rounding of f32;
/// - the first setpoint after switching on is at rest;
/// - every number is finite.
#[derive(Clone, Debug)]
pub struct Watch {
    rate: f64,
    acceleration: f64,
    tick: f64,
    /// Hub angle for a turn of the shaft, rad.
    gear: f64,
    before: Option<Step>,
    /// Number of setpoints judged.
    pub setpoints: u64,
    /// Greatest shares so far.
    pub worst: Excess,
    /// First promise that was broken.
    pub broken: Option<String>,
}

/// Shares of the allowed values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Excess {
    /// Departure of the angle from the rates, over `¼Ah²`.
    pub angle: f64,
    /// Change of rate, over `Ah`.
    pub change: f64,
    /// Rate, over `V`.
    pub rate: f64,
    /// Acceleration, over `A`.
    pub acceleration: f64,
}

impl Excess {
    /// Returns the greater of each.
    pub fn max(self, other: Self) -> Self {
        Self {
            angle: self.angle.max(other.angle),
            change: self.change.max(other.change),
            rate: self.rate.max(other.rate),
            acceleration: self.acceleration.max(other.acceleration),
        }
    }
}

/// Slack for limits and sums.
const ROUNDING: f64 = 1e-3;

impl Watch {
    /// Creates a watch for an axis with these limits, of which rate and acceleration must be there.
    pub fn new(limits: &Limits, ratio: Ratio, tick: f64) -> Self {
        Self {
            rate: limits.rate.unwrap_or(f64::INFINITY),
            acceleration: limits.acceleration.unwrap_or(f64::INFINITY),
            tick,
            gear: TAU / ratio.value::<f64>(),
            before: None,
            setpoints: 0,
            worst: Excess::default(),
            broken: None,
        }
    }

    /// Judges the next tick.
    pub fn see(&mut self, step: &Step) {
        if step.tick.mode == Mode::Disabled {
            self.before = None;
            return;
        }
        self.setpoints += 1;
        let before = self.before.replace(*step).filter(|_| !step.begins);
        let s = step.tick.setpoint;
        let numbers = [s.angle.part, s.rate, s.acceleration, s.torque, s.tip[0], s.tip[1]];
        if !numbers.iter().all(|x| x.is_finite()) || !step.demand.is_finite() {
            self.fail(step, "a number that is not finite");
            return;
        }
        let [rate, acceleration] = [s.rate, s.acceleration].map(|x| f64::from(x).abs());
        let mut now = Excess {
            rate: rate / self.rate,
            acceleration: acceleration / self.acceleration,
            ..Excess::default()
        };
        match before {
            None if rate > 1e-6 => self.fail(step, "a first setpoint that turns"),
            None => {}
            Some(before) => {
                let last = before.tick.setpoint;
                let turned = before.demand.position;
                let shaft = step.demand.position.in_turns() - turned.in_turns();
                let mean = 0.5 * (f64::from(s.rate) + f64::from(last.rate));
                let off = (self.gear * shaft.abs() - (mean * self.tick).abs()).abs();
                // 2⁻¹⁶ turn of the hub, and a rounding of the shaft's turn.
                let resolution = TAU / 65_536.0 + 2e-7 * self.gear;
                let allowed = 0.25 * self.acceleration * self.tick * self.tick;
                now.angle = (off - resolution).max(0.0) / allowed;
                let change = (f64::from(s.rate) - f64::from(last.rate)).abs();
                let rounding = 2e-6 * self.rate;
                now.change = (change - rounding).max(0.0) / (self.acceleration * self.tick);
            }
        }
        self.worst = self.worst.max(now);
        for (share, what) in [
            (now.angle, "a step of the angle"),
            (now.change, "a step of the rate"),
            (now.rate, "a rate above its limit"),
            (now.acceleration, "an acceleration above its limit"),
        ] {
            if share > 1.0 + ROUNDING {
                self.fail(step, &format!("{what}, {share:.3} of what is allowed"));
            }
        }
    }

    fn fail(&mut self, step: &Step, what: &str) {
        if self.broken.is_none() {
            self.broken = Some(format!("tick {}: {what}", step.tick.number));
        }
    }
}
