//! The ringing after jumps of the commanded acceleration that the exact rod does not follow.

use super::exact::MOST;
use crate::math::{Each, array, sqrt};
use crate::model::Rod;

/// Amplitudes with which the modes ring, rad/s² of the hub: a jump of the commanded acceleration by
/// `Δα` makes mode k ring with a torque of `bₖ²Δα`. Ringings of several jumps add up as if their
/// phases had nothing to do with each other.
///
/// The exact rod follows its modes in steps that take from each a part of its amplitude, and all of
/// the highest, which stands for all that are left out. An arm without damping rings on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ringing<const MODES: usize> {
    /// `bₖ²`, kg m²; the last is the rest of the arm's inertia about the axis.
    inertia: [f64; MODES],
    /// Part of its amplitude that a mode of the arm keeps over a tick, by its damping.
    kept: [f64; MODES],
    /// Part of its amplitude that a mode of the exact rod keeps over a tick.
    followed: [f64; MODES],
    /// Amplitudes of the arm and of the exact rod, rad/s².
    arm: [f64; MODES],
    exact: [f64; MODES],
}

impl<const MODES: usize> Ringing<MODES> {
    /// At rest, for an exact rod that takes `steps` steps for each tick of `tick` s.
    pub fn new(rod: &Rod<MODES>, tick: f64, steps: f64) -> Self {
        let (last, damping) = (MODES - 1, rod.scene().damping);
        let rest = rod.kinetics(&[0.0; MODES]);
        let mut inertia = rest.coupling.each(|b| b * b);
        inertia[last] = (rest.inertia - inertia[..last].iter().sum::<f64>()).max(0.0);
        // The frequency of the highest is too high: of those that it stands for, none decays more
        // slowly than the one below it.
        let frequency = |k: usize| rod.frequency()[k.min(last - 1)];
        let kept = array(|k| {
            let decay = 0.5 * (damping.alpha + damping.beta * frequency(k) * frequency(k));
            libm::exp(-decay * tick)
        });
        let followed = array(|k| {
            let turn = frequency(k) * tick / steps;
            if k == last || turn > MOST { 0.0 } else { kept[k] * libm::pow(growth(turn), steps) }
        });
        Self { inertia, kept, followed, arm: [0.0; MODES], exact: [0.0; MODES] }
    }

    /// Adds what a jump of the commanded acceleration, rad/s², makes ring.
    pub fn jump(&mut self, by: f64) {
        let louder = |amplitude: f64| sqrt(amplitude * amplitude + by * by);
        for k in 0..MODES {
            self.arm[k] = louder(self.arm[k]);
            self.exact[k] = if self.followed[k] > 0.0 { louder(self.exact[k]) } else { 0.0 };
        }
    }

    /// Goes on by a tick.
    pub fn tick(&mut self) {
        for k in 0..MODES {
            self.arm[k] *= self.kept[k];
            self.exact[k] *= self.followed[k];
        }
    }

    /// Largest torque of the ringing that the exact rod has lost by now, N m.
    pub fn unseen(&self) -> f64 {
        (0..MODES).map(|k| self.inertia[k] * (self.arm[k] - self.exact[k])).sum()
    }
}

/// Growth of an undamped oscillation in a step of the classical Runge-Kutta method of fourth order
/// that turns it by `turn` rad, up to 2.8: below 1.
fn growth(turn: f64) -> f64 {
    let square = turn * turn;
    let cube = square * square * square;
    sqrt((1.0 - cube / 72.0 + cube * square / 576.0).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Damping, Hub, Link, Scene};

    const TICK: f64 = 0.01;

    /// A rod of six modes, and the steps a tick that turn its second highest by 1.4 rad.
    fn rod(beta: f64) -> (Rod<6>, f64) {
        let mut scene = Scene::new(Link { length: 0.5, mass: 0.2, bending_stiffness: 2.0 });
        scene.hub = Hub { radius: 0.2, inertia: 0.3, ..scene.hub };
        scene.damping = Damping { beta, ..scene.damping };
        let rod = Rod::of_polynomials::<6>(&scene).expect("rod");
        let steps = rod.frequency()[4] * TICK / 1.4;
        (rod, steps)
    }

    /// Inertia about the axis without that of the lowest modes, kg m².
    fn without(rod: &Rod<6>, modes: usize) -> f64 {
        let rest = rod.kinetics(&[0.0; 6]);
        rest.inertia - rest.coupling[..modes].iter().map(|b| b * b).sum::<f64>()
    }

    #[test]
    fn the_highest_mode_is_lost_at_once_and_the_next_two_in_a_long_trial() {
        let (rod, steps) = rod(0.0);
        let mut ringing = Ringing::new(&rod, TICK, steps);
        assert_eq!(ringing.unseen(), 0.0);
        ringing.jump(2.0);
        assert!((ringing.unseen() / (2.0 * without(&rod, 5)) - 1.0).abs() < 1e-12);
        for _ in 0..400 {
            ringing.tick();
        }
        // And a part of the third.
        let (lost, two) = (ringing.unseen() / 2.0, without(&rod, 3));
        assert!(two <= lost && lost < 1.2 * two, "{lost} of {two}");
    }

    #[test]
    fn jumps_add_up_at_phases_of_their_own() {
        let (rod, steps) = rod(0.0);
        let mut ringing = Ringing::new(&rod, TICK, steps);
        ringing.jump(3.0);
        ringing.jump(4.0);
        assert!((ringing.unseen() / (5.0 * without(&rod, 5)) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn what_a_damped_arm_has_lost_itself_is_not_missed() {
        let (rod, steps) = rod(2e-4);
        let mut ringing = Ringing::new(&rod, TICK, steps);
        ringing.jump(1.0);
        let first = ringing.unseen();
        ringing.tick();
        assert!(first > 0.0 && ringing.unseen() < 0.1 * first);
    }

    #[test]
    fn the_growth_is_that_of_one_step() {
        for turn in [0.1, 0.8, 1.5, 2.5] {
            // Of x'' = −x from (1, 0).
            let slope = |[x, v]: [f64; 2]| [v, -x];
            let from = |k: [f64; 2], h: f64| [1.0 + h * k[0], h * k[1]];
            let k1 = slope([1.0, 0.0]);
            let k2 = slope(from(k1, 0.5 * turn));
            let k3 = slope(from(k2, 0.5 * turn));
            let k4 = slope(from(k3, turn));
            let sum = [0, 1].each(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
            let [x, v] = from(sum, turn);
            let stepped = sqrt(x * x + v * v);
            assert!((growth(turn) - stepped).abs() < 1e-12, "{turn}: {stepped}");
        }
    }
}
