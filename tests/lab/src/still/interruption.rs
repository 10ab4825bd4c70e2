//! The common parts of the campaigns of interruptions: the state in which a plan begins, its
//! residual in a finer simulation, and its refusals.

use std::collections::BTreeMap;

use stillbeam::planner::{Planner, StillMove, StopThenMove};
use stillbeam::stepper::{ArmState, Elastica};
use stillbeam::{Error, Generator, HubState};

/// Ticks from an interruption to the beginning of the move that is planned for it.
pub const AHEAD: u32 = 3;

/// Returns hub and arm where a plan begins, [`AHEAD`] ticks from now.
pub fn ahead(generator: &Generator<Elastica<f32, 2>, 8>) -> (HubState<f32>, ArmState<f32, 2>) {
    let mut ahead = generator.clone();
    for _ in 0..AHEAD {
        ahead.tick();
    }
    let hub = *ahead.hub();
    (hub, ahead.stepper().arm_state(ahead.state(), &hub))
}

/// Returns the same curve with `parts` times as many ticks.
pub fn finer(plan: &StillMove, parts: u32) -> StillMove {
    StillMove { ticks: parts * plan.ticks, tick: plan.tick / f64::from(parts), ..*plan }
}

/// Returns the residual of a course, m, by a planner with a third of its tick, from the arm's state
/// at its beginning. The residual of the first of two moves goes on through the second.
pub fn residual(fine: &Planner<f64, 2>, course: &StopThenMove, flex: &ArmState<f32, 2>) -> f64 {
    let wide =
        ArmState { coordinate: flex.coordinate.map(f64::from), rate: flex.rate.map(f64::from) };
    let left = |plan: &StillMove, flex| fine.predict(&finer(plan, 3), flex).residual;
    left(&course.first, Some(&wide)) + course.then.map_or(0.0, |then| left(&then, None))
}

/// Returns the kind of a refusal.
pub fn kind(error: &Error) -> &'static str {
    match error {
        Error::TooShort { .. } => "too short",
        Error::NotStill { .. } => "rings on",
        Error::DeflectsTooFar { .. } | Error::BendsTooFar { .. } => "bends too far",
        Error::LimitExceeded { parameter, .. } => parameter,
        _ => "other",
    }
}

/// Counts refusals by their kind, in words.
pub fn refusals<'a>(kinds: impl Iterator<Item = &'a &'static str>) -> String {
    let mut counts = BTreeMap::<&str, usize>::new();
    for kind in kinds {
        *counts.entry(kind).or_default() += 1;
    }
    let words: Vec<String> = counts.iter().map(|(kind, n)| format!("{kind} {n}")).collect();
    if words.is_empty() { "none".into() } else { words.join(", ") }
}
