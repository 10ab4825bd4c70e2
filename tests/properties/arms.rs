//! Random arms and moves.

use proptest::prelude::*;
use stillbeam::model::Rod;
use stillbeam::scene::{Section, Varied};
use stillbeam::{Damping, Hub, Link, Mount, Move, Payload, Profile, Scene};

/// h, s.
pub const TICK: f64 = 0.01;

/// Tip angle that a random move bends its arm to at most, rad; steppers are fitted for half as much
/// again.
pub const BEND: f64 = 1.0;

/// Arms with a first period of a few ticks to a few seconds, payloads to four link masses; half of
/// them with a joint that gives, with a payload beyond the tip, with a link of sections.
pub fn arms() -> impl Strategy<Value = Scene> {
    (
        (0.1..2.0, 0.005..2.0, 0.03..1.5),
        (0.0..0.3, 0.0..4.0, 0.0..0.02),
        (0.0..1.0, 0.0..0.01, any::<bool>()),
        (prop::option::of(4.0..100.0), prop::option::of(0.0..0.15), shapes()),
    )
        .prop_map(
            |(
                (length, mass, period),
                (radius, payload, inertia),
                (alpha, beta, upright),
                (joint, offset, shape),
            )| {
                // EI from the wanted first period of link and payload, within a few per cent where
                // the link is clamped and uniform.
                let moved = mass * (0.2427 + payload);
                let omega: f64 = std::f64::consts::TAU / period;
                let stiffness = omega * omega * moved * length * length * length / 3.0;
                let offset: f64 = offset.unwrap_or(0.0);
                let give = joint.map_or(0.0, |joint: f64| 3.0 / joint);
                let sag = (1.0 + give + 3.0 * offset) * moved * 9.81 * length * length
                    / (3.0 * stiffness);
                Scene {
                    link: Link { length, mass, bending_stiffness: stiffness },
                    shape,
                    hub: Hub {
                        radius: radius * length,
                        inertia: 0.1 * mass * length * length,
                        stiffness: joint.map(|joint| joint * stiffness / length),
                    },
                    payload: Payload {
                        mass: payload * mass,
                        // Lumped elements take an offset with some rotary inertia only.
                        inertia: (inertia + 1e-3 * payload * offset * offset)
                            * (mass * length * length),
                        offset: offset * length,
                    },
                    damping: Damping { alpha, beta: beta * period, joint: 0.2 * beta * period },
                    // Weight only where the arm carries it without bending far.
                    gravity: if upright && sag < 0.1 { 9.81 } else { 0.0 },
                    mount: Mount::ROTARY,
                }
            },
        )
}

/// Uniform links, and links of two sections that taper.
fn shapes() -> impl Strategy<Value = Varied> {
    let ends = || (0.5..2.0, 0.5..2.0);
    prop::option::of((0.2..0.8, ends(), ends())).prop_map(|cut| {
        let Some((at, (ei0, ei1), (rho0, rho1))) = cut else { return Varied::UNIFORM };
        let section = |length, ei, rho| Section::linear(length, ei, rho).expect("a section");
        let sections =
            [section(at, [ei0, ei1], [rho0, rho1]), section(1.0 - at, [ei1, ei1], [rho1, rho0])];
        Varied::of_sections(&sections).expect("a link").1
    })
}

/// Arms in the horizontal plane.
pub fn level_arms() -> impl Strategy<Value = Scene> {
    arms().prop_map(|scene| Scene { gravity: 0.0, ..scene })
}

/// A rest-to-rest move: its profile, turn in rad, duration in s.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    pub profile: Profile,
    pub by: f64,
    pub duration: f64,
}

impl Turn {
    /// The move from there.
    pub fn from(&self, from: f64) -> Move {
        Move::To { profile: self.profile, duration: self.duration, to: from + self.by }
    }

    /// The same profile, turning `factor` times as far.
    pub fn times(self, factor: f64) -> Self {
        Self { by: factor * self.by, ..self }
    }

    /// The same move, or a shorter turn that bends the arm by [`BEND`] at most.
    pub fn gentle(self, scene: &Scene) -> Self {
        let rod = Rod::<1>::new(scene).expect("an arm");
        let acceleration = self.profile.peaks(self.by, self.duration).acceleration;
        let (sag, bend) = (rod.bend(0.0), rod.bend(acceleration));
        self.times(((BEND - sag) / (bend - sag)).min(1.0))
    }
}

/// Rest-to-rest moves of whole ticks, long enough to be told from the rounding of angles.
pub fn turns() -> impl Strategy<Value = Turn> {
    let profiles = prop::sample::select(Profile::ALL.to_vec());
    (0.05_f64..4.0, any::<bool>(), 20_u32..300, profiles).prop_map(|(by, back, ticks, profile)| {
        Turn { profile, by: if back { -by } else { by }, duration: f64::from(ticks) * TICK }
    })
}

/// The rate of a spin-up in `duration` s, or a slower one that bends the arm by [`BEND`] at most.
pub fn gentle_spin(scene: &Scene, rate: f64, duration: f64) -> f64 {
    let rod = Rod::<1>::new(scene).expect("an arm");
    let (sag, bend) = (rod.bend(0.0), rod.bend(2.0 * rate.abs() / duration));
    rate * ((BEND - sag) / (bend - sag)).min(1.0)
}
