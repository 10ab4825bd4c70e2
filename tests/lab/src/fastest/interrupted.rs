//! Fastest moves that are broken off at random, by the thousand.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::model::Rod;
use stillbeam::motion::{Segment, Spline};
use stillbeam::planner::{FastestMove, Planner, Request, Target};
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Damping, Generator, Limits, Profile, Scene};
use stillbeam_sim::error::Error;

use crate::campaign;
use crate::random;
use crate::still::campaign::{arm, tick};
use crate::still::interruption::{ahead, finer, kind, refusals, residual};

/// Knots of the acceleration in half of a move, as on a target.
const KNOTS: usize = 12;

/// Instants within a tick at which the limits are looked at.
const LOOKS: u32 = 8;

/// Factor of the drive's limits over the first move's: a curve that leaves it while it holds a
/// limit has to go on with the same acceleration for a moment.
const ROOM: f64 = 1.25;

/// Outcome of an interruption.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// Largest part of a limit of rate or acceleration by which the fastest move exceeds it,
    /// between the ticks too.
    pub before: f64,
    /// The same of what follows the interruption, and the drive's limits.
    pub behind: f64,
    /// Residual that the planner stated, over L.
    pub stated: f64,
    /// Residual by a finer simulation in f64 from the same state, over L.
    pub residual: f64,
    /// True if the hub stops on its way.
    pub by_way_of_rest: bool,
}

/// Outcome of each interruption, or the reason of its refusal.
pub type Interruptions = Vec<Result<Outcome, &'static str>>;

/// Draws random fastest moves and breaks each off once: a new target or a stop.
pub fn interruptions(
    seed: u64,
    arms: usize,
    each: usize,
    done: &(dyn Fn() + Sync),
) -> Result<Interruptions, Error> {
    let all = campaign::each("arm", 0..arms as u64, done, |index| {
        let mut rng = StdRng::seed_from_u64(seed.wrapping_add(index));
        // The kind is for arms that look the same backwards in time.
        let arm = Scene { damping: Damping::default(), gravity: 0.0, ..arm(&mut rng) };
        let case = Case::new(&arm)?;
        (0..each).map(|_| case.interrupt(&mut rng)).collect::<Result<Interruptions, Error>>()
    });
    Ok(all.into_iter().collect::<Result<Vec<_>, Error>>()?.into_iter().flatten().collect())
}

struct Case {
    arm: Scene,
    tick: f64,
    planner: Planner<f32, 2>,
    fine: Planner<f64, 2>,
    rod: Rod<2>,
}

impl Case {
    fn new(arm: &Scene) -> Result<Self, Error> {
        let tick = tick(arm)?;
        Ok(Self {
            arm: *arm,
            tick,
            planner: Planner::new(arm, tick)?,
            fine: Planner::new(arm, tick / 3.0)?,
            rod: Rod::new(arm)?,
        })
    }

    /// Limits of a turn by `to` rad: an acceleration, a rate besides, a jerk besides.
    fn limits(&self, rng: &mut StdRng, to: f64) -> Limits {
        let period = self.planner.first_period();
        let peaks = Profile::SCurve.peaks(to, period * rng.random_range(1.2..4.0));
        let bounds = rng.random_range(0..3);
        Limits {
            acceleration: Some(peaks.acceleration),
            rate: (bounds > 0).then_some(peaks.rate),
            jerk: (bounds > 1).then_some(peaks.jerk),
            ..Limits::default()
        }
    }

    fn interrupt(&self, rng: &mut StdRng) -> Result<Result<Outcome, &'static str>, Error> {
        let to: f64 = rng.random_range(0.2..3.0) * random::sign(rng);
        let limits = self.limits(rng, to);
        let planned = self.planner.fastest::<KNOTS>(&Request::from_rest(0.0, to).limits(limits))?;
        let when: f64 = rng.random_range(0.0..1.25);
        let target = rng.random_bool(0.6).then(|| rng.random_range(-3.0..3.0));
        let Some(fastest) = planned else { return Ok(Err("no fastest move")) };
        let before = excess_of_rows(&limits, &fastest);
        let bend = self.rod.bend(1.5 * ROOM * fastest.peaks.acceleration).min(1.5);
        let stepper = Elastica::<f32, 2>::new(&self.rod, self.tick, Quality::Fine, bend)?;
        let mut generator = Generator::<_, 8>::new(stepper, 0.0)?;
        let mut path = generator.path(Spline::Cubic)?;
        let mut rows = fastest.waypoints();
        for _ in 0..=(when * f64::from(fastest.ticks)) as u32 {
            if let Err(refused) = generator.feed(&mut path, &mut rows) {
                return Ok(Err(kind(&refused.error)));
            }
            generator.tick();
        }
        self.change(&mut generator, target, &limits, before)
    }

    /// Breaks the motion off three ticks from now and judges what follows.
    fn change(
        &self,
        generator: &mut Generator<Elastica<f32, 2>, 8>,
        target: Option<f64>,
        limits: &Limits,
        before: f64,
    ) -> Result<Result<Outcome, &'static str>, Error> {
        let (hub, flex) = ahead(generator);
        let rate = limits.rate.map(|rate| ROOM * rate);
        let acceleration = limits.acceleration.map(|acceleration| ROOM * acceleration);
        let drive = Limits { rate, acceleration, ..Limits::default() };
        let end = target.map_or(Target::Stop, Target::Angle);
        let request = Request::from_hub(hub.precise(), end).arm(flex).limits(drive);
        let course = match self.planner.plan_by_stop(&request) {
            Err(error) => return Ok(Err(kind(&error))),
            Ok(course) => course,
        };
        if let Err(error) = generator.redirect(2, &course.first) {
            return Ok(Err(kind(&error)));
        }
        let curves = [Some(course.first), course.then].into_iter().flatten();
        let curves: Vec<_> = curves.map(|plan| finer(&plan, LOOKS).segment()).collect();
        let length = self.arm.link.length;
        Ok(Ok(Outcome {
            before,
            behind: excess(&drive, curves.iter()),
            stated: course.predict(&self.planner, Some(&flex)).residual / length,
            residual: residual(&self.fine, &course, &flex) / length,
            by_way_of_rest: course.then.is_some(),
        }))
    }
}

/// Largest part of a limit of rate or acceleration by which a fastest move exceeds it anywhere,
/// from its rows alone: between two of them the acceleration is a straight line.
fn excess_of_rows(limits: &Limits, fastest: &FastestMove<KNOTS>) -> f64 {
    let mut most = f64::NEG_INFINITY;
    let mut see = |value: f64, limit: Option<f64>| {
        if let Some(limit) = limit {
            most = most.max(value.abs() / limit - 1.0);
        }
    };
    let (mut time, mut angle, mut rate) = (0.0, fastest.from, 0.0);
    for row in fastest.waypoints() {
        let (span, end) = (row.time - time, row.rate.unwrap_or(f64::NAN));
        let way = 6.0 * (row.angle - angle) / (span * span);
        let begins = way - (4.0 * rate + 2.0 * end) / span;
        let ends = (2.0 * rate + 4.0 * end) / span - way;
        see(begins, limits.acceleration);
        see(ends, limits.acceleration);
        see(end, limits.rate);
        if begins * ends < 0.0 {
            see(rate + 0.5 * span * begins * begins / (begins - ends), limits.rate);
        }
        (time, angle, rate) = (row.time, row.angle, end);
    }
    most
}

/// Largest part of a limit of rate or acceleration by which curves exceed it at their ticks.
fn excess<'a>(limits: &Limits, curves: impl Iterator<Item = &'a Segment<f64>>) -> f64 {
    let mut most = f64::NEG_INFINITY;
    for curve in curves {
        for k in 0..=curve.count() {
            let hub = curve.hub(k);
            for (value, limit) in [(hub.rate, limits.rate), (hub.acceleration, limits.acceleration)]
            {
                if let Some(limit) = limit {
                    most = most.max(value.abs() / limit - 1.0);
                }
            }
        }
    }
    most
}

/// Writes the results of interruptions of fastest moves, drawn with that seed.
pub fn page(seed: u64, all: &Interruptions) -> String {
    let outcomes: Vec<_> = all.iter().filter_map(|one| one.ok()).collect();
    let most = |of: fn(&Outcome) -> f64| outcomes.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    let mut left: Vec<f64> = outcomes.iter().map(|one| 100.0 * one.residual).collect();
    left.sort_by(f64::total_cmp);
    let quantile = |share: f64| crate::table::quantile(&left, share).unwrap_or(f64::NAN);
    format!(
        "{} interruptions, seed {seed}: a new target or a stop.\n\n\
         | | |\n| --- | --: |\n\
         | planned | {} |\n| of them with a stop on the way | {} |\n| refused | {} |\n\
         | largest excess of the fastest move over a limit, between ticks too, of the limit | {:.1e} |\n\
         | the same behind the interruption, over the drive's | {:.1e} |\n\
         | residual, median, % of L | {:.4} |\n| residual, 99 % | {:.3} |\n\
         | residual, largest | {:.3} |\n\
         | residual beyond what the planner states, largest | {:.3} |\n",
        all.len(),
        outcomes.len(),
        outcomes.iter().filter(|one| one.by_way_of_rest).count(),
        refusals(all.iter().filter_map(|one| one.as_ref().err())),
        most(|one| one.before),
        most(|one| one.behind),
        quantile(0.5),
        quantile(0.99),
        quantile(1.0),
        100.0 * most(|one| one.residual - one.stated),
    )
}
