//! The motions of the comparison, each as short as the limits of a case allow.

use std::f64::consts::PI;
use std::time::Instant;

use stillbeam::math::Scalar;
use stillbeam::motion::optimal::Bounds;
use stillbeam::motion::{Plan, Shaper, ShaperKind};
use stillbeam::planner::{Planner, Request};
use stillbeam::{Angle, HubState, Move, Profile};
use stillbeam_sim::error::Error;
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::plan::shortest::{self, INTERVALS};
use stillbeam_sim::reference::rod;

use super::cases::Case;

/// Intervals of half a move on a target.
pub const ON_TARGET: usize = 12;

/// Time for which a planner is run again and again, s.
const MEASURED: f64 = 0.05;

/// A motion and how it does.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name in the table.
    pub name: String,
    /// Duration, first periods, and residual, fraction of L; `None` where it cannot be had.
    pub found: Option<[f64; 2]>,
    /// Time to plan it, s.
    pub planned_in: Option<f64>,
}

/// Judges every motion of a case.
pub fn entries(case: &Case) -> Result<Vec<Entry>, Error> {
    let mut all = Vec::new();
    for (name, base) in bases(case) {
        let mut kinds = vec![None];
        kinds.extend([ShaperKind::Zv, ShaperKind::Mzv, ShaperKind::Zvd, ShaperKind::Ei].map(Some));
        for kind in kinds {
            let name = kind.map_or_else(
                || name.to_owned(),
                |kind| format!("{name}, {}", kind.name().to_uppercase()),
            );
            let found = base.map(|base| shaped(case, base, kind)).transpose()?;
            all.push(Entry { name, found, planned_in: None });
        }
    }
    all.push(still(case)?);
    all.push(fastest::<f32, ON_TARGET>(case, "fastest, 12 intervals, f32")?);
    all.push(fastest::<f64, INTERVALS>(case, "fastest, 24 intervals, f64")?);
    let bound = shortest::rigid_bound(PI, &case.limits, case.tick).map(|t| [t / case.period, 0.0]);
    all.push(Entry { name: "rigid bound".into(), found: bound, planned_in: None });
    Ok(all)
}

/// Unshaped motions, in the shortest durations within the limits of the hub's motion. A limit of
/// the torque is not theirs: only a simulation knows it.
fn bases(case: &Case) -> [(&'static str, Option<Move>); 3] {
    let start = HubState::at_rest(Angle::from_radians(0.0));
    let limits = case.limits.kinematic();
    let own = case.limits.torque.is_none();
    let shortest = |profile| {
        let motion = Move::To { profile, duration: 1.0, to: PI };
        Plan::shortest(&motion, start, &limits, case.tick).ok().filter(|_| own)
    };
    let bounds = Bounds::new(&limits, case.tick).ok();
    let optimal = bounds.filter(|_| own).map(|bounds| Move::Reach { to: PI, rate: 0.0, bounds });
    [
        ("cubic", shortest(Profile::Cubic)),
        ("S-curve", shortest(Profile::SCurve)),
        ("time-optimal", optimal),
    ]
}

fn shaped(case: &Case, base: Move, kind: Option<ShaperKind>) -> Result<[f64; 2], Error> {
    let damping = rod::first_damping_ratio(&case.arm)?;
    let motion = Motion::of(0.0, base, case.tick);
    let motion = match kind {
        Some(kind) => motion.shaped(Shaper::new(kind, 1.0 / case.period, damping)?),
        None => motion,
    };
    let judged = motion.judge(&case.arm, 0.0)?;
    Ok([judged.duration / case.period, judged.residual])
}

fn still(case: &Case) -> Result<Entry, Error> {
    let planner = Planner::<f32, 2>::new(&case.arm, case.tick)?;
    let request = Request::from_rest(0.0, PI).limits(case.limits).any_deflection();
    let plan = planner.plan(&request).ok();
    let found = plan.map(|plan| {
        let judged = Motion::of(0.0, plan.motion(), case.tick).judge(&case.arm, 0.0)?;
        Ok::<_, Error>([judged.duration / case.period, judged.residual])
    });
    let planned_in = Some(timed(|| planner.plan(&request).is_ok()));
    Ok(Entry { name: "still".into(), found: found.transpose()?, planned_in })
}

fn fastest<T: Scalar, const N: usize>(case: &Case, name: &str) -> Result<Entry, Error> {
    let planner = Planner::<T, 2>::new(&case.arm, case.tick)?;
    let request = Request::from_rest(0.0, PI).limits(case.limits).any_deflection();
    let found = planner.fastest::<N>(&request)?.map(|plan| {
        let judged = Motion::of(0.0, shortest::path(&plan), case.tick).judge(&case.arm, 0.0)?;
        Ok::<_, Error>([judged.duration / case.period, judged.residual])
    });
    let planned_in = Some(timed(|| planner.fastest::<N>(&request).is_ok()));
    Ok(Entry { name: name.into(), found: found.transpose()?, planned_in })
}

/// Mean time of a call, s.
fn timed(mut plan: impl FnMut() -> bool) -> f64 {
    let start = Instant::now();
    let mut calls = 0;
    while start.elapsed().as_secs_f64() < MEASURED {
        std::hint::black_box(plan());
        calls += 1;
    }
    start.elapsed().as_secs_f64() / f64::from(calls)
}
