//! Remarks on values that are probably in another unit. No value is refused, because it may be
//! meant.
//!
//! A value is judged by the arm it belongs to. A link is longer than thick, a section of any solid
//! has a stiffness that fits its mass, damping leaves a vibration. Thresholds lie a hundred times
//! beyond what arms have. A wrong prefix makes a factor of a thousand.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use stillbeam::Scene;

use super::notes::Groups;
use super::{File, LinkTable, MoveTable};
use crate::reference::rod;

/// Longest link, m. No robot's link is longer; lengths in millimetres exceed it by far.
const LONGEST: f64 = 30.0;

/// Softest solid, Pa.
const SOFTEST: f64 = 1e6;

/// `EI/μ²` of a section, m⁵/(kg s²): `E/12ρ²` times the square's ratio of sides. Steel 270,
/// aluminium 800, carbon 3,000; a hundredth of that for a tape, fifty times for a tube.
const SECTION: (f64, f64) = (0.02, 5e5);

/// Heaviest payload, in link masses.
const PAYLOAD: f64 = 200.0;

/// Damping ratio of the first mode beyond which a move can leave no vibration.
const DAMPED: f64 = 0.5;

/// Fastest joint, rad/s.
const FASTEST: f64 = 50.0;

/// Longest tick and longest move, s.
const TICK: f64 = 0.1;
const MOVE: f64 = 120.0;

/// Returns all remarks on a file whose arm is `arm`, one line each.
pub(super) fn remarks(file: &File, arm: &Scene, moves: &[MoveTable]) -> Vec<String> {
    let mut lines = link(&file.link);
    lines.extend(hub_and_payload(arm));
    lines.extend(damping(arm));
    if file.gravity.acceleration == 1.0 {
        lines.push("gravity.acceleration = 1: it is in m/s^2 (1 g = 9.81 m/s^2)".to_owned());
    }
    if let Some(rate) = file.limits.rate.filter(|rate| *rate > FASTEST && file.unit.is_none()) {
        lines.push(format!(
            "limits.rate = {rate}: {rate} rad/s are {:.0} rpm; rates are in rad/s ({rate} deg/s = \
             {:.4} rad/s)",
            rate * 60.0 / TAU,
            rate.to_radians()
        ));
    }
    if let Some(tick) = file.solver.tick.filter(|tick| *tick > TICK) {
        let milli = 1e-3 * tick;
        lines.push(format!("solver.tick = {tick}: ticks are in s ({tick} ms = {milli} s)"));
    }
    lines.extend(motions(moves, file.unit.is_none()));
    lines
}

/// Returns the remark on an angle beyond two turns, unless it is a multiple of a quarter turn.
pub fn angle(value: f64) -> Option<String> {
    let quarters = value / FRAC_PI_2;
    let in_turns = (quarters - quarters.round()).abs() < 1e-3;
    (value.abs() > 2.0 * TAU && !in_turns).then(|| {
        format!(
            "{value} rad are {:.1} turns; angles are in rad ({value} deg = {:.4} rad)",
            value.abs() / TAU,
            value.to_radians()
        )
    })
}

/// `radians` is true if the angles are in rad because the file names no unit.
fn motions(moves: &[MoveTable], radians: bool) -> Vec<String> {
    let mut groups = Groups::default();
    for (index, table) in moves.iter().enumerate() {
        if table.profile.as_deref() == Some("spin-up") {
            // Whoever turns on and on has angles of many turns.
            break;
        }
        let rows = table.waypoints.iter().flatten().enumerate();
        let of_rows = rows.map(|(k, row)| (format!("waypoints[{k}]"), row.get(1).copied()));
        let keys = [("from".to_owned(), table.from), ("to".to_owned(), table.to)];
        for (key, value) in keys.into_iter().chain(of_rows).filter(|_| radians) {
            if let (Some(value), Some(text)) = (value, value.and_then(angle)) {
                groups.add(index, format!("{key} = {value}: {text}"));
            }
        }
        if let Some(long) =
            table.duration.filter(|t| *t > MOVE && table.profile.as_deref() != Some("dwell"))
        {
            let milli = 1e-3 * long;
            groups.add(
                index,
                format!("duration = {long}: durations are in s ({long} ms = {milli} s)"),
            );
        }
    }
    groups.lines(moves.len())
}

fn link(link: &LinkTable) -> Vec<String> {
    let mut lines = Vec::new();
    let metres = |key: &str, value: f64| {
        format!("link.{key} = {value}: lengths are in m ({value} mm = {} m)", 1e-3 * value)
    };
    if link.length > LONGEST {
        lines.push(metres("length", link.length));
    }
    let thick = 0.25 * link.length;
    let wide = [("width", link.width, link.length), ("thickness", link.thickness, thick)];
    for (key, value, most) in wide {
        if let Some(value) = value.filter(|value| *value > most) {
            lines.push(metres(key, value));
        }
    }
    if let Some(modulus) = link.youngs_modulus.filter(|modulus| *modulus < SOFTEST) {
        let (prefix, unit) = if modulus < 1e3 { (1e9, "GPa") } else { (1e6, "MPa") };
        lines.push(format!(
            "link.youngs_modulus = {modulus}: moduli are in Pa ({modulus} {unit} = {:e} Pa)",
            prefix * modulus
        ));
    }
    if let Some(moment) = link.second_moment.filter(|i| (12.0 * i).powf(0.25) > thick) {
        lines.push(format!(
            "link.second_moment = {moment}: it is in m^4 ({moment} mm^4 = {:e} m^4)",
            1e-12 * moment
        ));
    }
    // One wrong unit is told once.
    if lines.is_empty() {
        lines.extend(section(link));
    }
    lines
}

/// Returns the remark on a mass and a stiffness that no section of that length has together.
fn section(link: &LinkTable) -> Option<String> {
    let mass = link.mass?;
    let stiffness = link.bending_stiffness.or(link
        .youngs_modulus
        .zip(link.second_moment)
        .map(|(modulus, moment)| modulus * moment))?;
    let per_length = mass / link.length;
    let (least, most) = SECTION;
    let ratio = stiffness / (per_length * per_length);
    if ratio < least {
        let gram = 1e-3 * mass;
        Some(format!(
            "link.mass = {mass}: {per_length:.3} kg/m is far too heavy for a stiffness of \
             {stiffness} N m^2; masses are in kg ({mass} g = {gram} kg)"
        ))
    } else if ratio > most {
        Some(format!(
            "link.bending_stiffness = {stiffness}: far too stiff for {per_length:.3e} kg/m; it is in \
             N m^2 ({stiffness} N mm^2 = {:e} N m^2), masses are in kg",
            1e-6 * stiffness
        ))
    } else {
        None
    }
}

fn hub_and_payload(arm: &Scene) -> Vec<String> {
    let mut lines = Vec::new();
    let (link, payload, radius) = (&arm.link, &arm.payload, arm.hub.radius);
    if radius > 10.0 * link.length {
        let milli = 1e-3 * radius;
        lines.push(format!("hub.radius = {radius}: lengths are in m ({radius} mm = {milli} m)"));
    }
    if payload.mass > PAYLOAD * link.mass {
        lines.push(format!(
            "payload.mass = {}: {:.0} times the link\u{2019}s mass; masses are in kg ({} g = {} kg)",
            payload.mass,
            payload.mass / link.mass,
            payload.mass,
            1e-3 * payload.mass
        ));
    }
    let largest = (payload.mass + link.mass) * link.length * link.length;
    if payload.inertia > largest {
        lines.push(format!(
            "payload.inertia = {}: larger than of the arm\u{2019}s whole mass a link length away; it \
             is in kg m^2 ({} kg mm^2 = {:e} kg m^2)",
            payload.inertia,
            payload.inertia,
            1e-6 * payload.inertia
        ));
    }
    lines
}

fn damping(arm: &Scene) -> Vec<String> {
    let damping = arm.damping;
    if damping.alpha == 0.0 && damping.beta == 0.0 {
        return Vec::new();
    }
    let Ok(period) = rod::first_period(arm) else { return Vec::new() };
    let omega = 2.0 * PI / period;
    let ratios = [
        ("alpha", damping.alpha, 0.5 * damping.alpha / omega, "1/s"),
        ("beta", damping.beta, 0.5 * damping.beta * omega, "s"),
    ];
    ratios
        .into_iter()
        .filter(|(_, _, ratio, _)| *ratio > DAMPED)
        .map(|(key, value, ratio, unit)| {
            format!(
                "damping.{key} = {value}: a damping ratio of {ratio:.2} in the first mode; {key} is \
                 in {unit}, not a ratio"
            )
        })
        .collect()
}
