//! Friction of bristles, and the loss of a gear that follows the same law.

use super::{Friction, Gear};

/// Time constant of the bristles' own damping at rest, s. It fades with the Stribeck rate, so that
/// a reversal at speed makes no peak.
const SETTLING: f64 = 5e-3;

impl Friction {
    /// Returns ż, 1/s, of a bristle's relative deflection `z` at `rate` rad/s.
    pub(super) fn follow(&self, z: f64, rate: f64) -> f64 {
        (rate - rate.abs() * z) / self.presliding
    }

    /// Returns the friction torque against a turn at `rate` rad/s, N m.
    pub(super) fn torque(&self, z: f64, rate: f64) -> f64 {
        let ratio = rate / self.stribeck_rate;
        let square = ratio * ratio;
        let level = self.coulomb + (self.breakaway - self.coulomb) * (-square).exp();
        level * (z + SETTLING / (1.0 + square) * self.follow(z, rate)) + self.viscous * rate
    }
}

impl Gear {
    /// Returns μ: the loss of the gear as a fraction of the torque of the mesh, which has the sign
    /// of `torque`, with its bristles at `z`.
    pub(super) fn loss(&self, torque: f64, z: f64) -> f64 {
        let along = if torque < 0.0 { -z } else { z };
        along * if along > 0.0 { 1.0 / self.efficiency - 1.0 } else { 1.0 - self.efficiency }
    }

    /// Returns the torque of a compliant mesh, N m, and the energy in it, J, at a `twist` rad of
    /// the motor ahead of the hub, which changes at `rate` rad/s.
    ///
    /// Damping comes in over the first tenth of the gap's width, and the teeth push but do not
    /// pull: without either, the torque would jump where they meet and part.
    pub(super) fn mesh(&self, twist: f64, rate: f64) -> (f64, f64) {
        let stiffness = self.stiffness.unwrap_or(0.0);
        let half = 0.5 * self.backlash;
        let pressed = (twist.abs() - half).max(0.0);
        let energy = 0.5 * stiffness * pressed * pressed;
        if half == 0.0 {
            return (stiffness * twist + self.damping * rate, energy);
        }
        let side = twist.signum();
        let contact = pressed / (pressed + 0.1 * self.backlash);
        let push = stiffness * pressed + side * self.damping * rate * contact;
        (side * push.max(0.0), energy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRICTION: Friction = Friction {
        coulomb: 0.1,
        breakaway: 0.15,
        stribeck_rate: 0.05,
        viscous: 0.02,
        presliding: 1e-3,
    };

    /// At an even rate the bristles stand at ±1, and the torque is the textbook's.
    #[test]
    fn an_even_rate_has_the_textbook_friction() {
        for rate in [-2.0, -0.04, 0.01, 0.7] {
            let z = f64::signum(rate);
            assert_eq!(FRICTION.follow(z, rate), 0.0);
            let level = 0.1 + 0.05 * (-(rate / 0.05_f64).powi(2)).exp();
            assert!((FRICTION.torque(z, rate) - (level * z + 0.02 * rate)).abs() < 1e-15);
        }
    }

    /// The gear's loss is what the core's joint says it is.
    #[test]
    fn loss_and_efficiency_agree() {
        let gear = Gear { efficiency: 0.8, ..Gear::default() };
        for (torque, z) in [(2.0, 1.0), (2.0, -1.0), (-2.0, 1.0), (-2.0, -1.0)] {
            let at_motor = torque * (1.0 + gear.loss(torque, z));
            let exact = if torque * z > 0.0 { torque / 0.8 } else { torque * 0.8 };
            assert!((at_motor - exact).abs() < 1e-12, "{torque}, {z}: {at_motor}");
        }
    }

    /// The mesh pushes on either side of its gap, never pulls, and has no jump.
    #[test]
    fn teeth_push_and_do_not_pull() {
        let gear = Gear { stiffness: Some(50.0), damping: 0.4, backlash: 0.02, ..Gear::default() };
        for rate in [-3.0, 0.0, 3.0] {
            let mut before = gear.mesh(-0.03, rate).0;
            for k in -3000..=3000 {
                let twist = 1e-5 * f64::from(k);
                let (torque, energy) = gear.mesh(twist, rate);
                assert!(torque * twist >= 0.0 && energy >= 0.0, "{twist}: {torque}");
                assert!((torque - before).abs() < 0.01, "{twist}: from {before} to {torque}");
                before = torque;
            }
            assert_eq!(gear.mesh(0.009, rate).0, 0.0);
        }
    }
}
