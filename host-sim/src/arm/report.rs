//! The figures of an arm, in SI units. Field names carry their units, as they stand in JSON.

use serde::Serialize;
use stillbeam::{Angle, Scene};

use super::method::{MethodReport, advise};
use super::natural::{self, MODES};
use crate::error::Error;
use crate::reference::rod;
use crate::scene_file::{Deduced, SceneFile};

/// Ticks a period from which a vibration shows in the setpoints: half of the Nyquist frequency.
pub const RESOLVED: f64 = 4.0;

/// The figures of an arm and of its scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ArmReport {
    /// The scene's name or file.
    pub scene: String,
    /// `L`, clamp to tip, m.
    pub length_m: f64,
    /// `r`, motor axis to clamp, m.
    pub hub_radius_m: f64,
    /// Mass of link, payload and what is mounted on the link, kg.
    pub mass_kg: f64,
    /// Mass of the link, kg.
    pub link_mass_kg: f64,
    /// Mass of what is mounted on the link, kg.
    pub mounted_mass_kg: f64,
    /// Mass of the payload, kg.
    pub payload_mass_kg: f64,
    /// Distance of the payload's centre of mass beyond the tip, m.
    pub payload_offset_m: f64,
    /// Stiffness of the joint between hub and link, N m/rad. Absent if it does not give.
    pub hub_stiffness_nm_rad: Option<f64>,
    /// Kind of the axis, `rotary` or `linear`.
    pub axis: &'static str,
    /// Inertia of the straight arm about the motor axis, hub included, kg m². Absent on a linear
    /// axis.
    pub inertia_kgm2: Option<f64>,
    /// Mass that a linear axis moves, the carriage's included, kg. Absent on one that turns.
    pub moved_mass_kg: Option<f64>,
    /// EI of the link, N m²: of one that is not uniform as of one that a force at the tip bends as
    /// far.
    pub bending_stiffness_nm2: f64,
    /// True if EI and mass per length are the same all along the link.
    pub is_uniform: bool,
    /// Frequencies of the first modes, hub held, without gravity, Hz.
    pub frequency_hz: [f64; MODES],
    /// Their periods, s.
    pub period_s: [f64; MODES],
    /// Their damping ratios.
    pub damping_ratio: [f64; MODES],
    /// Distance by which the tip hangs below the undeformed link with the arm held level, m. Zero
    /// without gravity, absent if the arm has no stable rest there.
    pub sag_m: Option<f64>,
    /// The same at the scene's first angle, across the undeformed link, m.
    pub sag_at_start_m: Option<f64>,
    /// The setpoint interval, s.
    pub tick_s: f64,
    /// Ticks in a period of each mode.
    pub ticks_per_period: [f64; MODES],
    /// Number of the first modes with at least four ticks a period.
    pub resolved_modes: usize,
    /// Values that were deduced from measurements.
    pub deduced: Deduced,
    /// The method that `auto` takes for the scene's moves. Absent without moves.
    pub method: Option<MethodReport>,
}

/// Describes the arm of a scene. Chooses a method if the scene has moves, which takes as long as
/// `auto` does.
pub fn describe(scene: &SceneFile) -> Result<ArmReport, Error> {
    let arm = &scene.arm;
    let tick = scene.solver.resolve()?.tick;
    let frequency = natural::frequencies(arm)?;
    let ticks = frequency.map(|f| 1.0 / (f * tick));
    let mounted = arm.shape.masses().map(|mass| mass.mass).sum();
    let method = if scene.moves.is_empty() { None } else { Some(advise(scene)?) };
    let against = || arm.rigid_inertia() + arm.hub.inertia;
    Ok(ArmReport {
        scene: scene.name.clone(),
        length_m: arm.link.length,
        hub_radius_m: arm.hub.radius,
        mass_kg: arm.link.mass + mounted + arm.payload.mass,
        link_mass_kg: arm.link.mass,
        mounted_mass_kg: mounted,
        payload_mass_kg: arm.payload.mass,
        payload_offset_m: arm.payload.offset,
        hub_stiffness_nm_rad: arm.hub.stiffness,
        axis: if arm.mount.is_linear() { "linear" } else { "rotary" },
        inertia_kgm2: (!arm.mount.is_linear()).then(against),
        moved_mass_kg: arm.mount.is_linear().then(against),
        bending_stiffness_nm2: arm.link.bending_stiffness,
        is_uniform: arm.shape.is_uniform(),
        frequency_hz: frequency,
        period_s: frequency.map(f64::recip),
        damping_ratio: natural::damping_ratios(arm, &frequency)?,
        // Level is across gravity, wherever that is turned to.
        sag_m: sag(arm, arm.mount.direction),
        sag_at_start_m: sag(arm, scene.from),
        tick_s: tick,
        ticks_per_period: ticks,
        resolved_modes: ticks.iter().take_while(|&&ticks| ticks >= RESOLVED).count(),
        deduced: scene.deduced.clone(),
        method,
    })
}

/// Returns how far the tip of the resting arm lies below the undeformed link, m: the negative
/// hub-frame Y by the reference rod. `None` if there is no stable rest.
fn sag(arm: &Scene, angle: f64) -> Option<f64> {
    // Not −0 of a straight arm.
    rod::rest_deflection(arm, Angle::from_radians(angle)).ok().map(|y| 0.0 - y)
}
