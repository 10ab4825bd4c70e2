#![forbid(unsafe_code)]
//! Energy of an arm, and what damping takes of it, by the model alone. No stepper has a part in it,
//! so that it can judge all of them. It needs the core only, so that Miri can run what uses it.

mod balance;

pub use balance::{Balance, imbalance};

use stillbeam::model::{Model, Modes, Rod};
use stillbeam::{AxisKind, HubState};

/// Energy of an arm at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy {
    /// Kinetic energy of the hub, `½J_hω²`, J.
    pub hub: f64,
    /// Kinetic energy of link and payload, J.
    pub carried: f64,
    /// Strain energy, J.
    pub bending: f64,
    /// Potential energy of the weight, zero at the height of the hub, J.
    pub raised: f64,
    /// Power that damping takes, W: drag `2αT` of link and payload, and the strip's.
    pub dissipation: f64,
}

impl Energy {
    /// Returns the sum, J.
    pub fn total(&self) -> f64 {
        self.hub + self.carried + self.bending + self.raised
    }

    /// Returns the energy of a level arm that vibrates on a hub at rest, J: link, payload and
    /// strip. It is never negative.
    pub fn of_vibration(&self) -> f64 {
        self.carried + self.bending
    }
}

/// Returns the energy of small deflections `q` with rates `q_dot`, nodal coordinates:
///
/// `T = ½J_rω² + ωFᵀq̇ + ½q̇ᵀMq̇ − ½ω²qᵀGq` of link and payload, `½qᵀKq` of the strip,
/// `g[sinχ(S − ½qᵀK_Pq) + cosχ f_gᵀq]` of the weight. The strip takes `βq̇ᵀKq̇`, the
/// joint its own.
///
/// Sine and cosine are those of χ, which a generator keeps for an arm under gravity. On a linear
/// axis `ω` is the velocity of the carriage, whose own mass rises with it.
pub fn small<const N: usize, const W: usize>(
    model: &Model<N, W>,
    hub: &HubState<f64>,
    q: &[f64; N],
    q_dot: &[f64; N],
) -> Energy {
    let (scene, omega) = (model.scene(), hub.rate);
    let stiffness = model.stiffness().half_form();
    let carried = 0.5 * model.rigid_inertia() * omega * omega
        + omega * dot(model.coupling(), q_dot)
        + model.mass().half_form().at(q_dot)
        - omega * omega * model.spin().half_form().at(q);
    let own = model.first_moment();
    let height = if scene.mount.is_linear() {
        hub.cos * own * hub.angle.radians() - hub.sin * model.tension().half_form().at(q)
    } else {
        hub.sin * (own - model.tension().half_form().at(q))
    } + hub.cos * dot(model.weight(), q);
    Energy {
        hub: 0.5 * scene.hub.inertia * omega * omega,
        carried,
        bending: stiffness.at(q),
        raised: scene.in_plane_gravity() * height,
        dissipation: 2.0 * scene.damping.alpha * carried
            + 2.0 * scene.damping.beta * stiffness.at(q_dot)
            + 2.0 * model.joint_damping().half_form().at(q_dot),
    }
}

/// Returns the energy of a rod that may bend far, modal coordinates `a` with rates `v`:
///
/// `T = ½vᵀMv + ωhᵀv + ½ω²T_θθ` of link and payload, `½Σωₖ²aₖ²` of the strip,
/// `g(X sinχ + Y cosχ)` of the weight. The strip takes `βΣωₖ²vₖ²`, the joint `β_J k φ̇₀²`
/// with the root at `φ₀ = Σψₖ(0)aₖ`.
pub fn exact<const K: usize>(
    rod: &Rod<K>,
    hub: &HubState<f64>,
    a: &[f64; K],
    v: &[f64; K],
) -> Energy {
    let (scene, omega) = (rod.scene(), hub.rate);
    let kinetics = rod.kinetics(a);
    let moved = kinetics.mass.map(|row| dot(&row, v));
    let carried = 0.5 * dot(&moved, v)
        + omega * dot(&kinetics.coupling, v)
        + 0.5 * omega * omega * kinetics.inertia;
    let stiffness = rod.frequency().map(|omega| omega * omega);
    let elastic = |x: &[f64; K]| dot(&stiffness, &x.map(|x| x * x));
    let root = dot(rod.root_slope(), v);
    let joint = scene.damping.joint * scene.hub.stiffness.unwrap_or(0.0);
    let [x, y] = kinetics.moment;
    // Link, payload and carriage rise with the carriage.
    let y = match scene.mount.axis {
        AxisKind::Rotary => y,
        AxisKind::Linear => y + (kinetics.inertia + scene.hub.inertia) * hub.angle.radians(),
    };
    Energy {
        hub: 0.5 * scene.hub.inertia * omega * omega,
        carried,
        bending: 0.5 * elastic(a),
        raised: scene.in_plane_gravity() * (hub.sin * x + hub.cos * y),
        dissipation: 2.0 * scene.damping.alpha * carried
            + scene.damping.beta * elastic(v)
            + joint * root * root,
    }
}

/// Returns nodal coordinates, or rates, of the modal ones that a [`stillbeam::stepper::Modal`]
/// holds: `ωₖ` times the mass-normalised coordinate of each mode.
pub fn nodal<const N: usize, const K: usize>(modes: &Modes<N>, state: &[f64; K]) -> [f64; N] {
    core::array::from_fn(|i| {
        (0..K).map(|k| modes.shape[k][i] * state[k] / modes.frequency[k]).sum()
    })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[cfg(test)]
mod tests {
    use stillbeam::model::EightElements;
    use stillbeam::{Angle, Link, Scene};

    use super::*;

    const ARM: Scene = Scene {
        gravity: 9.81,
        ..Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
    };

    /// A uniform link that does not bend, by hand: `½mL²/3 ω²` and `mg ½L sinθ`.
    #[test]
    fn a_straight_link_has_the_energy_of_a_rigid_one() {
        let angle = Angle::from_radians(0.5);
        let (sin, cos) = angle.sin_cos();
        let hub = HubState { sin, cos, ..HubState::turning(angle, 3.0) };
        let model = EightElements::consistent(&ARM).expect("a model");
        let rod = Rod::<3>::new(&ARM).expect("a rod");
        let Link { length, mass, .. } = ARM.link;
        let carried = mass * length * length / 6.0 * 9.0;
        let raised = 0.5 * mass * 9.81 * length * 0.5_f64.sin();
        for energy in
            [small(&model, &hub, &[0.0; 16], &[0.0; 16]), exact(&rod, &hub, &[0.0; 3], &[0.0; 3])]
        {
            assert!((energy.carried - carried).abs() < 1e-6 * carried, "{energy:?}");
            assert!((energy.raised - raised).abs() < 1e-6 * raised, "{energy:?}");
            assert_eq!((energy.bending, energy.dissipation), (0.0, 0.0));
        }
    }

    /// One mode that swings: the strip's energy at its end is the kinetic one in its middle.
    #[test]
    fn a_mode_has_as_much_of_either_energy() {
        let level = Scene { gravity: 0.0, ..ARM };
        let hub = HubState::at_rest(Angle::from_radians(0.0));
        let model = EightElements::consistent(&level).expect("a model");
        let modes = Modes::of(&model);
        // Of the stepper's state, `ωa` and `ωȧ`.
        let [bent, moved] =
            [[0.01, 0.0], [0.01 * modes.frequency[0], 0.0]].map(|state| nodal(&modes, &state));
        let most = small(&model, &hub, &bent, &[0.0; 16]);
        let middle = small(&model, &hub, &[0.0; 16], &moved);
        assert!((most.of_vibration() - 0.5e-4).abs() < 1e-12, "{most:?}");
        assert!((middle.of_vibration() - 0.5e-4).abs() < 1e-12, "{middle:?}");
    }
}
