//! Stand-in for the sensors of a board without arms: a damped mode on every hub.

use core::f32::consts::TAU;

use stillbeam::Angle;

use crate::Sensor;

/// The mode of one arm that the stand-in shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// Natural frequency with the hub held, Hz.
    pub frequency: f32,
    /// Damping ratio.
    pub damping_ratio: f32,
    /// Deflection per hub angle far above the frequency, m/rad: the tip stays where it is.
    pub gain: f32,
}

impl Truth {
    /// The modes of the two arms: not those of the scenes in [`crate::axes`], which a recording is
    /// there to correct.
    pub const ARMS: [Self; 2] = [
        Self { frequency: 1.31, damping_ratio: 0.018, gain: 0.42 },
        Self { frequency: 2.84, damping_ratio: 0.011, gain: 0.51 },
    ];
}

/// Noise of the readings, m to either side, evenly distributed and the same in every recording: a
/// sensor without any shows the same value twice, as one does that is slower than the tick.
const NOISE: f32 = 1e-5;

/// Tip deflections of arms that are not there, driven by the angles of hubs that turn.
///
/// The deflection q of one mode on a hub at the angle θ is, with g the gain,
/// `q̈ + 2ζω q̇ + ω² q = −g θ̈`. With `z = q + gθ` and `w = ż + 2ζω q` it reads
/// `ż = w − 2ζω q`, `ẇ = −ω² q`, which differentiates no angle. θ is a straight line between two
/// readings. A step of Runge and Kutta's method of fourth order takes `(ωh)⁴/120` of the frequency,
/// 1e-5 at 3 Hz and 10 ms.
#[derive(Clone, Copy, Debug)]
pub struct StandIn<const N: usize> {
    arms: [Arm; N],
}

#[derive(Clone, Copy, Debug)]
struct Arm {
    truth: Truth,
    /// z, m, and w, m/s, the hub's angle counted from that at the beginning.
    state: [f32; 2],
    begin: Angle<f32>,
    /// µs.
    time: u32,
    /// Hub angle of the latest reading, rad from the beginning.
    hub: f32,
    /// State of the noise.
    random: u32,
}

impl<const N: usize> StandIn<N> {
    /// Arms at rest.
    pub const fn new(truths: [Truth; N]) -> Self {
        let mut arms = [Arm::at_rest(truths[0]); N];
        let mut i = 0;
        while i < N {
            arms[i] = Arm::at_rest(truths[i]);
            i += 1;
        }
        Self { arms }
    }
}

impl<const N: usize> Sensor for StandIn<N> {
    const COLUMN: &'static str = "tip_deflection_m";
    const AXES: usize = N;

    /// Deflection of the tip, m. An arm begins a recording at rest.
    fn read(&mut self, axis: usize, time: u32, hub: Angle<f32>) -> f32 {
        self.arms.get_mut(axis).map_or(0.0, |arm| arm.read(time, hub))
    }
}

impl Arm {
    const fn at_rest(truth: Truth) -> Self {
        let begin = Angle { turns: 0, part: 0.0 };
        Self { truth, state: [0.0; 2], begin, time: 0, hub: 0.0, random: 1 }
    }

    fn read(&mut self, time: u32, hub: Angle<f32>) -> f32 {
        if time == 0 {
            *self = Self { begin: hub, ..Self::at_rest(self.truth) };
        } else {
            let elapsed = time.wrapping_sub(self.time);
            let turned = TAU * hub.since(self.begin);
            self.advance(1e-6 * elapsed as f32, turned);
            (self.time, self.hub) = (time, turned);
        }
        self.state[0] - self.truth.gain * self.hub + self.noise()
    }

    /// The next reading's noise, m, by a linear congruential generator.
    fn noise(&mut self) -> f32 {
        self.random = self.random.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        NOISE * (self.random as i32 as f32) / 2_147_483_648.0
    }

    /// Goes on by `h` s, in which the hub turns to `hub` rad.
    fn advance(&mut self, h: f32, hub: f32) {
        let Truth { frequency, damping_ratio, gain } = self.truth;
        let omega = TAU * frequency;
        let begin = self.hub;
        let slope = |[z, w]: [f32; 2], part: f32| {
            let q = z - gain * (begin + part * (hub - begin));
            [w - 2.0 * damping_ratio * omega * q, -omega * omega * q]
        };
        let state = self.state;
        let along = |slope: [f32; 2], part: f32| {
            [state[0] + part * h * slope[0], state[1] + part * h * slope[1]]
        };
        let a = slope(state, 0.0);
        let b = slope(along(a, 0.5), 0.5);
        let c = slope(along(b, 0.5), 0.5);
        let d = slope(along(c, 1.0), 1.0);
        for (i, value) in self.state.iter_mut().enumerate() {
            *value += h / 6.0 * (a[i] + 2.0 * (b[i] + c[i]) + d[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    // For roots and logarithms.
    extern crate std;

    use super::*;

    const TRUTH: Truth = Truth { frequency: 2.0, damping_ratio: 0.05, gain: 0.5 };

    fn hub(radians: f64) -> Angle<f32> {
        Angle::from_radians(radians).cast()
    }

    /// A hub that turns at once from one reading to the next by 0.1 rad rings the mode:
    /// `q = −gΔ e^(−ζωt) (cos ωd t + …)`, by its zeros and its decay.
    #[test]
    fn an_arm_rings_with_its_frequency_and_damping() {
        let mut sensor = StandIn::new([TRUTH]);
        let readings = (0..2000u32).map(|k| {
            let angle = if k == 0 { 0.3 } else { 0.4 };
            sensor.read(0, 1000 * k, hub(angle))
        });
        let mut q = [0.0; 2000];
        q.iter_mut().zip(readings).for_each(|(slot, reading)| *slot = reading);
        assert!((q[1] + 0.05).abs() < 1e-3, "the tip stays behind: {}", q[1]);
        // Rising zeros, interpolated, ms.
        let mut zeros = [0.0; 8];
        let mut count = 0;
        for k in 2..2000 {
            if q[k - 1] < 0.0 && q[k] >= 0.0 && count < zeros.len() {
                zeros[count] = k as f32 - q[k] / (q[k] - q[k - 1]);
                count += 1;
            }
        }
        assert_eq!(count, 4, "{zeros:?}");
        let period = (zeros[3] - zeros[0]) / 3.0;
        let expected = 500.0 / (1.0 - 0.05_f32 * 0.05).sqrt();
        assert!((period / expected - 1.0).abs() < 2e-4, "{period} ms, {expected} ms");
        let peak = |from: usize| q[from..from + 500].iter().fold(0.0_f32, |a, &b| a.max(b));
        let decay = (peak(200) / peak(700)).ln() / (TAU * 0.05 / (1.0 - 0.0025_f32).sqrt());
        assert!((decay - 1.0).abs() < 5e-3, "{decay}");
    }

    /// A hub that turns slowly is followed.
    #[test]
    fn a_slow_hub_bends_nothing() {
        let mut sensor = StandIn::new([TRUTH]);
        let last =
            (0..4000u32).map(|k| sensor.read(0, 10_000 * k, hub(1e-5 * f64::from(k)))).last();
        assert!(last.unwrap().abs() < 1.5 * NOISE, "{last:?}");
    }

    #[test]
    fn time_zero_begins_at_rest() {
        let mut sensor = StandIn::new(Truth::ARMS);
        sensor.read(1, 0, hub(0.0));
        assert!(sensor.read(1, 10_000, hub(0.2)) < -0.05);
        let [first, second] = [0, 10_000].map(|time| sensor.read(1, time, hub(0.2)));
        assert!(first.abs() <= NOISE && second.abs() <= NOISE && first != second);
    }
}
