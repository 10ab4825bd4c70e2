//! Remarks on values that are probably in another unit. No value is refused, because it may be
//! meant.
//!
//! A value is judged by the arm it belongs to. A link is longer than thick, a section of any solid
//! has a stiffness that fits its mass, damping leaves a vibration. Thresholds lie a hundred times
//! beyond what arms have. A wrong prefix makes a factor of a thousand.

mod link;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use stillbeam::Scene;

use super::notes::Groups;
use super::{File, MoveTable};
use crate::reference::rod;

/// Heaviest payload, in link masses.
const PAYLOAD: f64 = 200.0;

/// Damping ratio of the first mode beyond which a move can leave no vibration.
const DAMPED: f64 = 0.5;

/// Softest joint, as a fraction of the link's `EI/L`.
const SOFT: f64 = 0.01;

/// Fastest joint, rad/s.
const FASTEST: f64 = 50.0;

/// Longest tick and longest move, s.
const TICK: f64 = 0.1;
const MOVE: f64 = 120.0;

/// Returns all remarks on a file whose arm is `arm`, one line each.
pub(super) fn remarks(file: &File, arm: &Scene, moves: &[MoveTable]) -> Vec<String> {
    let mut lines = link::remarks(&file.link, arm.link.length);
    lines.extend(hub_and_payload(arm));
    lines.extend(damping(arm));
    if file.gravity.acceleration == 1.0 {
        lines.push("gravity.acceleration = 1: it is in m/s^2 (1 g = 9.81 m/s^2)".to_owned());
    }
    let radians = file.unit.is_none() && !arm.mount.is_linear();
    if let Some(rate) = file.limits.rate.filter(|rate| radians && *rate > FASTEST) {
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
    lines.extend(motions(moves, radians));
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

/// `radians` is true if the angles are in rad because the axis turns and the file names no unit.
fn motions(moves: &[MoveTable], radians: bool) -> Vec<String> {
    let mut groups = Groups::default();
    for (index, table) in moves.iter().enumerate() {
        if matches!(table.profile.as_deref(), Some("spin-up" | "ramp")) {
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
    if payload.offset.abs() > link.length {
        let (offset, milli) = (payload.offset, 1e-3 * payload.offset);
        lines.push(format!(
            "payload.offset = {offset}: farther from the tip than the link is long; lengths are in m \
             ({offset} mm = {milli} m)"
        ));
    }
    let unit = link.bending_stiffness / link.length;
    if let Some(stiffness) = arm.hub.stiffness.filter(|stiffness| *stiffness < SOFT * unit) {
        lines.push(format!(
            "hub.stiffness = {stiffness}: the joint gives {:.0} times as much as the link; it is in N \
             m/rad ({stiffness} kN m/rad = {} N m/rad)",
            unit / stiffness,
            1e3 * stiffness
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
