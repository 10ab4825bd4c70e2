//! Remedies for an exceeded limit: the shortest duration of the move, or the reason why none helps.

use std::cell::Cell;

use stillbeam::{Limits, Move, Profile, Remedy};

use super::refusal::seconds;
use super::{Case, Excess, Quantity, Refusal, Way, holding, kinematic, load};
use crate::error::Error;
use crate::reference::rod::{self, Options, Resume};
use crate::step::{Motion, Step};
use crate::trajectory::{Side, Trajectory};

/// Longest duration that is tried, ticks.
const MOST_TICKS: u32 = 1 << 24;

/// Number of increasing durations that are tried if a trial is cheap, and if it is a flight.
const TRIALS: u32 = 400;
const FLIGHTS: u32 = 60;

/// First periods that a search flies in all, which takes up to ten seconds. A limit a thousand
/// times too low takes moves so long that a search would not end. The refusal then says only that
/// it takes a longer move.
const BUDGET: f64 = 1000.0;

/// Flights as long as the duration aimed at that a search takes at least: a few up to the first
/// that keeps the limit, and a dozen shorter ones back. Where they exceed the budget none is begun.
const LEAST_FLIGHTS: f64 = 8.0;

/// Number of durations that are tried above the one that a quick search has found.
const CLOSER: u32 = 24;

/// Share of the aimed duration to which a search may leap. A load would be twice its limit there,
/// and a vibration at most doubles a load or cancels half of it.
const LEAP: f64 = 0.7;

/// Returns the refusal of a motion whose trajectory exceeds a kinematic limit.
pub fn of_motion(
    case: &Case<'_>,
    trajectory: &Trajectory,
    limits: &Limits,
    excess: Excess,
) -> Refusal {
    let way = plain_way(case, trajectory, limits, &excess).unwrap_or_else(|| {
        // Behind a shaper, copies of a move get in and out of step as it grows: small steps.
        let careful = case
            .shaper
            .map_or(u32::MAX, |shaper| (shaper.delay() / case.tick / 32.0).ceil().max(1.0) as u32);
        let keeps = |ticks| {
            let steps = lasting(case, excess.index, ticks);
            let case = case.with(&steps);
            let Ok(trajectory) = case.trajectory() else { return Ok(Some(1.5)) };
            Ok(excess_during(&case, &trajectory, limits, excess.index))
        };
        searched(case, &excess, TRIALS, careful, keeps).unwrap_or(Way::Remedy(Remedy::Longer))
    });
    Refusal { excess, count: case.steps.len(), way }
}

/// Returns the refusal of a motion along which the rod exceeds a load limit. `admit` gets the moves
/// with a duration that keeps the rod's limits. It returns true if whoever commands the motion
/// accepts them too. `progress` is called with the durations that are tried, throughout the search.
pub fn of_loads(
    case: &Case<'_>,
    trajectory: &Trajectory,
    limits: &Limits,
    found: &load::Found,
    admit: &dyn Fn(&[Step]) -> bool,
    progress: &dyn Fn(load::Progress),
) -> Result<Refusal, Error> {
    let excess = found.excess;
    let refusal = |way| Refusal { excess, count: case.steps.len(), way };
    if let Some(way) = plain_way(case, trajectory, limits, &excess) {
        return Ok(refusal(way));
    }
    let [begin, end] = [found.window.begin, found.window.end]
        .map(|t| trajectory.at(t, Side::Left).angle.radians());
    if let Some(held) = too_heavy(case, limits, &excess, begin, end)? {
        return Ok(refusal(Way::Remedy(Remedy::Weight(held))));
    }
    let period = rod::first_period(case.arm)?;
    let longer = Way::Remedy(Remedy::Longer);
    if LEAST_FLIGHTS * aimed_at(case, &excess) > BUDGET * period {
        return Ok(refusal(longer));
    }
    // A vibration that the move starts adds to the load or not, as its phase at the end is.
    let careful = (0.125 * period / case.tick).ceil().max(1.0) as u32;
    let flown = Cell::new(0.0);
    let affords = |ticks: u32| {
        let length = f64::from(ticks) * case.tick + period;
        flown.set(flown.get() + length / period);
        flown.get() < BUDGET
    };
    let keeps_in = |options: &Options, state: &Option<Resume>, ticks| {
        let tried = |_| progress(load::Progress::Tried(f64::from(ticks) * case.tick));
        tried(0.0);
        let steps = lasting(case, excess.index, ticks);
        let case = case.with(&steps);
        let Ok(trajectory) = case.trajectory() else { return Ok(Some(1.5)) };
        if let Some(stretch) = excess_during(&case, &trajectory, limits, excess.index) {
            return Ok(Some(stretch));
        }
        let windows = case.windows(&trajectory);
        let Some(window) = windows.iter().find(|window| window.index == excess.index) else {
            return Ok(None);
        };
        let (peaks, _) = load::fly(&case, &trajectory, window, options, state.as_ref(), &tried)?;
        Ok(peaks.excess(limits, excess.index).map(|excess| excess.quantity.stretch(excess.ratio())))
    };
    let [fine, quick] = &found.states;
    let way = searched(case, &excess, FLIGHTS, careful, |ticks| {
        // Beyond the budget nothing is flown any more, and nothing fits.
        if affords(ticks) { keeps_in(&load::QUICK, quick, ticks) } else { Ok(Some(1.0)) }
    })?;
    let Way::Remedy(Remedy::Duration(duration)) = way else {
        return Ok(refusal(if flown.get() < BUDGET { way } else { longer }));
    };
    // The finer flights have a budget of their own.
    flown.set(0.0);
    // By the finer flight, and by whoever commands it, a little more may be needed.
    let least = (duration / case.tick).round() as u32;
    for ticks in (0..CLOSER).map(|k| least + k.max(k * least / 200)) {
        if !affords(ticks) {
            break;
        }
        let taken = keeps_in(&load::FINE, fine, ticks)?.is_none()
            && admit(&lasting(case, excess.index, ticks));
        if taken {
            let duration = seconds(f64::from(ticks) * case.tick);
            return Ok(refusal(Way::Remedy(Remedy::Duration(duration))));
        }
    }
    Ok(refusal(longer))
}

/// Returns the duration, s, at which the exceeded quantity would keep its limit if it fell as the
/// hub's own does; 0 for a step that does not exist.
fn aimed_at(case: &Case<'_>, excess: &Excess) -> f64 {
    let duration = case.steps.get(excess.index).map_or(0.0, |step| step.motion.duration());
    duration * excess.quantity.stretch(excess.ratio())
}

/// Returns the load that holds the arm at rest between two hub angles, rad, if it exceeds the
/// limit.
pub fn too_heavy(
    case: &Case<'_>,
    limits: &Limits,
    excess: &Excess,
    begin: f64,
    end: f64,
) -> Result<Option<f64>, Error> {
    let [torque, moment] = holding(case.arm, begin, end)?;
    let held = match excess.quantity {
        Quantity::Torque => torque,
        Quantity::Moment => moment,
        _ => return Ok(None),
    };
    let limit = excess.quantity.limit(limits, case.tick).unwrap_or(f64::INFINITY);
    Ok((held > limit).then_some(held))
}

/// Returns the remedy that needs no trial of a duration, if there is one.
fn plain_way(
    case: &Case<'_>,
    trajectory: &Trajectory,
    limits: &Limits,
    excess: &Excess,
) -> Option<Way> {
    let Motion::Move(motion) = &case.steps.get(excess.index)?.motion else {
        // A path's acceleration jumps where it begins or ends with one, or at a row with a rate.
        let jumps = excess.quantity == Quantity::Jerk && excess.peak.value.is_infinite();
        let smoother = jumps.then_some(Way::Remedy(Remedy::Smoother));
        return smoother.or_else(|| stretched(case, trajectory, limits, excess));
    };
    match (*motion, excess.quantity) {
        (Move::SpinUp { .. }, Quantity::Rate | Quantity::Turn) => {
            let limit = excess.quantity.limit(limits, case.tick)?;
            let windows = case.windows(trajectory);
            let window = windows.iter().find(|window| window.index == excess.index)?;
            let rate = [(window.begin, Side::Right), (window.end, Side::Left)]
                .map(|(t, side)| trajectory.at(t, side).rate)
                .into_iter()
                .find(|rate| rate.abs() > limit)?;
            Some(Way::Remedy(Remedy::Slower(rate)))
        }
        (_, Quantity::Jerk) if excess.peak.value.is_infinite() => Some(match motion {
            Move::To { profile: Profile::Cubic | Profile::Trapezoid, .. }
            | Move::Pass { profile: Profile::Cubic | Profile::Trapezoid, .. } => {
                Way::Remedy(Remedy::Smoother)
            }
            _ => Way::Pulses(case.shaper.map_or(0.0, |shaper| shaper.delay())),
        }),
        // A still move in another time is another move, which only its planner knows.
        (Move::Still { .. } | Move::Dwell { .. }, _) => Some(Way::Remedy(Remedy::Longer)),
        (Move::Reach { .. } | Move::Ramp { .. }, _) => Some(Way::Bounds),
        _ => None,
    }
}

/// Returns the duration of a path from rest that keeps the limits of the hub's motion. In a longer
/// time it passes the same angles, so that every peak follows from the factor.
fn stretched(
    case: &Case<'_>,
    trajectory: &Trajectory,
    limits: &Limits,
    excess: &Excess,
) -> Option<Way> {
    let windows = case.windows(trajectory);
    let window = windows.iter().find(|window| window.index == excess.index)?;
    let rests = trajectory.at(window.begin, Side::Left).rate == 0.0;
    if !rests || case.shaper.is_some() || !Quantity::KINEMATIC.contains(&excess.quantity) {
        return None;
    }
    let peaks = kinematic::peaks(trajectory, window.begin, window.end);
    let factors = Quantity::KINEMATIC.into_iter().filter_map(|quantity| {
        let limit = quantity.limit(limits, case.tick)?;
        Some(quantity.stretch(peaks.of(quantity, limits)?.value / limit))
    });
    let factor = factors.fold(1.0, f64::max);
    let duration = case.steps.get(excess.index)?.motion.duration() * factor;
    let ticks = (duration / case.tick - 1e-6).ceil();
    let fits = factor.is_finite() && ticks <= f64::from(MOST_TICKS);
    fits.then(|| Way::Remedy(Remedy::Duration(seconds(ticks * case.tick))))
}

/// Returns the factor by which the move must be longer to keep its kinematic limits. Returns `None`
/// if it keeps them.
fn excess_during(
    case: &Case<'_>,
    trajectory: &Trajectory,
    limits: &Limits,
    index: usize,
) -> Option<f64> {
    let windows = case.windows(trajectory);
    let window = windows.iter().find(|window| window.index == index)?;
    let excess = kinematic::excess_in(window, trajectory, limits)?;
    Some(excess.quantity.stretch(excess.ratio()))
}

/// Returns the moves, one of them with another duration.
fn lasting(case: &Case<'_>, index: usize, ticks: u32) -> Vec<Step> {
    let mut steps = case.steps.to_vec();
    if let Some(step) = steps.get_mut(index) {
        step.motion = step.motion.lasting(seconds(f64::from(ticks) * case.tick));
    }
    steps
}

/// Searches the shortest duration of the exceeding move with [`shortest`].
fn searched(
    case: &Case<'_>,
    excess: &Excess,
    trials: u32,
    careful: u32,
    keeps: impl FnMut(u32) -> Result<Option<f64>, Error>,
) -> Result<Way, Error> {
    let Some(step) = case.steps.get(excess.index) else {
        return Ok(Way::Remedy(Remedy::Longer));
    };
    let failing = step.motion.ticks(case.tick).unwrap_or(1);
    let first = excess.quantity.stretch(excess.ratio());
    Ok(match shortest(failing, first, trials, careful, keeps)? {
        Ok(ticks) => Way::Remedy(Remedy::Duration(seconds(f64::from(ticks) * case.tick))),
        Err(_) if case.shaper.is_some() && excess.index > 0 => {
            Way::Pulses(case.shaper.map_or(0.0, |shaper| shaper.delay()))
        }
        Err(most) => Way::None(f64::from(most) * case.tick),
    })
}

/// Returns the shortest duration beyond `failing`, whole ticks, that keeps the limits.
///
/// `keeps` returns the factor by which a duration would have to be longer, or `None` if it keeps
/// the limits. The durations go up to `LEAP` of that at once, then by no more than `careful` ticks
/// or a twentieth. They are then halved back to the last that failed. The error is the longest
/// duration that was tried.
pub fn shortest(
    failing: u32,
    first: f64,
    trials: u32,
    careful: u32,
    mut keeps: impl FnMut(u32) -> Result<Option<f64>, Error>,
) -> Result<Result<u32, u32>, Error> {
    let (mut failing, mut stretch) = (failing, first);
    for _ in 0..trials {
        // Less than a tick in a million is rounding.
        let aimed = (f64::from(failing) * stretch - 1e-6).ceil().min(f64::from(MOST_TICKS)) as u32;
        let leap = (f64::from(failing) * stretch * LEAP).min(f64::from(MOST_TICKS)) as u32;
        let cap = failing.saturating_add(careful.max(failing / 20)).max(leap);
        let mut reach = aimed.min(cap).max(failing + 1);
        if reach > MOST_TICKS {
            break;
        }
        if let Some(longer) = keeps(reach)? {
            (failing, stretch) = (reach, longer.max(1.0));
            continue;
        }
        while reach - failing > 1 {
            let middle = failing + (reach - failing) / 2;
            if keeps(middle)?.is_some() { failing = middle } else { reach = middle }
        }
        return Ok(Ok(reach));
    }
    Ok(Err(failing))
}
