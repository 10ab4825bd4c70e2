//! The shortest duration of a move under every limit of a scene.

use stillbeam::motion::Plan;
use stillbeam::{HubState, Limits, Move, Remedy};

use super::refusal::seconds;
use super::{Case, Excess, Refusal, Way, kinematic, load, remedy};
use crate::error::Error;
use crate::step::Motion;

/// Number of searches that may follow each other: one behind the shaper, one for each load, and one
/// more for what they do to each other.
const TRIALS: u32 = 4;

/// Number of growing durations that are tried for a motion without a formula.
const DURATIONS: u32 = 200;

/// Returns the shortest duration in whole ticks, s, of the case's last move, in which it keeps
/// every limit of rate, acceleration, deceleration, jerk, torque and clamp moment. The duration
/// that the move comes with does not matter; those of the moves before it do.
///
/// Without a shaper and without limits of loads it is the core's [`Plan::shortest`]. Behind a
/// shaper, and for the loads, it is searched from below: a vibration that an earlier move has left
/// may let a longer move exceed a limit that a shorter one keeps, and the shortest is then the
/// first that is met.
///
/// # Errors
/// No limit at all, one that no duration keeps, or one that an earlier move exceeds.
pub fn shortest(case: &Case<'_>, limits: &Limits, progress: &dyn Fn(f64)) -> Result<f64, Error> {
    let Some((last, earlier)) = case.steps.split_last() else {
        return Err(Error::new("moves: none; must be one at least"));
    };
    let start = case.with(earlier).end()?;
    let mut duration = first(case, &last.motion, start, limits)?;
    let mut trials = 0;
    while let Some(refusal) = refused_in(duration, case, limits, progress)? {
        trials += 1;
        if trials > TRIALS {
            return Err(refusal.into());
        }
        duration = named(refusal, earlier.len())?;
    }
    // The search flies with a small error, which may have cost it a tick.
    while trials > 0 && duration > 1.5 * case.tick {
        let less = seconds(duration - case.tick);
        if refused_in(less, case, limits, progress)?.is_some() {
            break;
        }
        duration = less;
    }
    Ok(duration)
}

/// Returns the first limit that a motion exceeds whose last move takes `duration` s.
fn refused_in(
    duration: f64,
    case: &Case<'_>,
    limits: &Limits,
    progress: &dyn Fn(f64),
) -> Result<Option<Refusal>, Error> {
    let mut steps = case.steps.to_vec();
    if let Some(step) = steps.last_mut() {
        step.motion = step.motion.lasting(duration);
    }
    refusal(&case.with(&steps), limits, progress)
}

/// Returns a duration, s, below which none will do.
fn first(
    case: &Case<'_>,
    motion: &Motion,
    start: HubState<f64>,
    limits: &Limits,
) -> Result<f64, Error> {
    let kinematic = limits.kinematic();
    if *limits == Limits::default() {
        return Err(Error::new(
            "move.duration: missing; must be a number in s, or [limits] must hold a limit",
        ));
    }
    // Neither a path nor a move that ends turning has a formula.
    let motion = match motion {
        Motion::Path(_) | Motion::Move(Move::Pass { .. }) => return found(case, &kinematic),
        Motion::Move(motion) => motion,
    };
    if kinematic != Limits::default() && case.shaper.is_none() {
        return Ok(Plan::shortest(motion, start, &kinematic, case.tick)?.duration());
    }
    // A shaper lowers the peaks, so that the formulas say nothing: from a radian a tick on.
    match Plan::remedy(motion, start, &Limits::default(), case.tick) {
        Remedy::Duration(duration) => Ok(duration),
        _ => Ok(motion.duration()),
    }
}

/// Searches the shortest duration, s, in which the last motion keeps the limits of the hub's motion
/// and a radian a tick.
fn found(case: &Case<'_>, limits: &Limits) -> Result<f64, Error> {
    let found = remedy::shortest(0, 1.0, DURATIONS, 1, |ticks| {
        Ok(match excess_in(case, limits, ticks) {
            Ok(excess) => excess.map(|excess| excess.quantity.stretch(excess.ratio())),
            // It would turn by more than a radian in a tick.
            Err(_) => Some(1.5),
        })
    })?;
    let most = match found {
        Ok(ticks) => return Ok(f64::from(ticks) * case.tick),
        Err(most) => most,
    };
    let way = Way::None(f64::from(most) * case.tick);
    match excess_in(case, limits, most)? {
        Some(excess) => Err(Refusal { excess, count: case.steps.len(), way }.into()),
        None => Ok(f64::from(most) * case.tick),
    }
}

/// Returns the first limit of the hub's motion that is exceeded if the last motion takes that many
/// ticks.
fn excess_in(case: &Case<'_>, limits: &Limits, ticks: u32) -> Result<Option<Excess>, Error> {
    let mut steps = case.steps.to_vec();
    if let Some(step) = steps.last_mut() {
        step.motion = step.motion.lasting(f64::from(ticks) * case.tick);
    }
    let case = case.with(&steps);
    Ok(kinematic::excess(&case, &case.trajectory()?, limits))
}

/// Returns the first limit that a motion exceeds, by its refusal.
pub fn refusal(
    case: &Case<'_>,
    limits: &Limits,
    progress: &dyn Fn(f64),
) -> Result<Option<Refusal>, Error> {
    let trajectory = case.trajectory()?;
    if let Some(excess) = kinematic::excess(case, &trajectory, limits) {
        return Ok(Some(remedy::of_motion(case, &trajectory, limits, excess)));
    }
    match load::excess(case, &trajectory, limits, progress)? {
        Some(found) => {
            remedy::of_loads(case, &trajectory, limits, &found, &|_| true, &|_| ()).map(Some)
        }
        None => Ok(None),
    }
}

/// Returns the duration that a refusal of the move at `index` names, s.
fn named(refusal: Refusal, index: usize) -> Result<f64, Error> {
    match refusal.way {
        Way::Remedy(Remedy::Duration(duration)) if refusal.excess.index == index => Ok(duration),
        _ => Err(refusal.into()),
    }
}
