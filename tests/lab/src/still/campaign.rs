//! Still moves by the thousand: random arms from rest to rest, and random interruptions.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::model::Rod;
use stillbeam::planner::{Kinematics, Planner, Request, Target};
use stillbeam::scene::Varied;
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Damping, Generator, Hub, Limits, Link, Mount, Move, Payload, Profile, Scene};

use super::interruption::{self, kind};
use crate::campaign;
use stillbeam_sim::error::Error;
use stillbeam_sim::plan::judge::Motion;
use stillbeam_sim::reference::rod;

/// Draws a random arm: first period 0.1 to 2 s, payload to four link masses, hub radius to 0.3 L.
/// Half of the arms are damped, a third are under gravity that bends them by at most 5 % of L.
pub(crate) fn arm(rng: &mut StdRng) -> Scene {
    let (length, mass, period) =
        (rng.random_range(0.1..2.0), rng.random_range(0.005..2.0), rng.random_range(0.1..2.0));
    let payload: f64 = rng.random_range(0.0..4.0);
    let omega: f64 = std::f64::consts::TAU / period;
    let moved: f64 = mass * (0.2427 + payload);
    let damped = if rng.random_bool(0.5) { 1.0 } else { 0.0 };
    let upright = rng.random_bool(0.33);
    let bending_stiffness = omega * omega * moved * f64::powi(length, 3) / 3.0;
    let sag = moved * 9.81 * length * length / (3.0 * bending_stiffness);
    Scene {
        link: Link { length, mass, bending_stiffness },
        shape: Varied::UNIFORM,
        hub: Hub { radius: length * rng.random_range(0.0..0.3), ..Hub::default() },
        payload: Payload {
            mass: payload * mass,
            inertia: mass * length * length * rng.random_range(0.0..0.02),
            offset: 0.0,
        },
        damping: Damping {
            alpha: damped * rng.random_range(0.0..1.0),
            beta: damped * period * rng.random_range(0.0..0.01),
            joint: 0.0,
        },
        gravity: if upright { 9.81 * f64::min(1.0, 0.05 / sag) } else { 0.0 },
        mount: Mount::ROTARY,
    }
}

/// Returns the setpoint interval: 10 ms, or a twentieth of a first period if that is less.
pub(crate) fn tick(arm: &Scene) -> Result<f64, Error> {
    Ok(f64::min(0.01, rod::first_period(arm)? / 20.0))
}

/// One move from rest to rest.
#[derive(Clone, Copy, Debug)]
pub struct Rest {
    /// Duration in first periods.
    pub ratio: f64,
    /// Residuals of the still move and of the linear one, by the judge, over L. An error if
    /// refused.
    pub residual: Result<(f64, f64), &'static str>,
    /// True if the reference rod was the judge. Otherwise three modes in f64 at half the step were.
    pub by_rod: bool,
}

/// Plans random moves from rest to rest, 0.9 to 4 first periods. The reference rod judges every
/// `rod_each`-th.
pub fn rests(
    seed: u64,
    count: usize,
    rod_each: usize,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Rest>, Error> {
    let found = campaign::each("move", 0..count as u64, done, |index| {
        let mut rng = StdRng::seed_from_u64(seed.wrapping_add(index));
        let arm = arm(&mut rng);
        let tick = tick(&arm)?;
        let planner = Planner::<f32, 2>::new(&arm, tick)?;
        let (from, to) = (rng.random_range(-3.2..3.2), rng.random_range(-3.2..3.2));
        let ratio = rng.random_range(0.9..4.0);
        let duration = ratio * planner.first_period() + 0.5 * tick;
        let by_rod = index.is_multiple_of(rod_each as u64);
        let request = Request::from_rest(from, to).duration(duration).any_deflection();
        let plan = planner.plan(&request).and_then(|plan| {
            planner.predict(&plan, None).admit(&Limits::default(), arm.link.length)?;
            Ok(plan)
        });
        let residual = match plan {
            Err(error) => Err(kind(&error)),
            Ok(plan) => {
                let linear = planner.plan(&request.kinematics(Kinematics::Linear))?;
                let length = arm.link.length;
                let judge = |motion: Move| -> Result<f64, Error> {
                    Ok(Motion::of(from, motion, tick).judge(&arm, 0.0)?.residual)
                };
                Ok(if by_rod {
                    (judge(plan.motion())?, judge(linear.motion())?)
                } else {
                    let fine = Planner::<f64, 3>::new(&arm, tick)?;
                    let left = |plan| fine.predict(plan, None).residual / length;
                    (left(&plan), left(&linear))
                })
            }
        };
        Ok(Rest { ratio, residual, by_rod })
    });
    found.into_iter().collect()
}

/// One interrupted move.
#[derive(Clone, Copy, Debug)]
pub struct Interruption {
    /// Outcome of the interruption, or the reason of its refusal.
    pub outcome: Result<Outcome, &'static str>,
}

/// Outcome of an interruption.
#[derive(Clone, Copy, Debug)]
pub struct Outcome {
    /// Largest of rate and acceleration at any tick over its limit, less 1.
    pub excess: f64,
    /// Residual that the planner stated, over L.
    pub stated: f64,
    /// Residual by a finer simulation in f64 from the same state, over L.
    pub residual: f64,
    /// True if the hub stops on its way.
    pub by_way_of_rest: bool,
}

/// Draws random interruptions of random moves: a new target, a stop, another payload.
pub fn interruptions(
    seed: u64,
    arms: usize,
    each: usize,
    done: &(dyn Fn() + Sync),
) -> Result<Vec<Interruption>, Error> {
    let all = campaign::each("arm", 0..arms as u64, done, |index| {
        let mut rng = StdRng::seed_from_u64(seed.wrapping_add(index));
        let arm = arm(&mut rng);
        let case = Case::new(&arm, &mut rng)?;
        (0..each).map(|_| case.interrupt(&mut rng)).collect::<Result<Vec<_>, Error>>()
    });
    Ok(all.into_iter().collect::<Result<Vec<_>, Error>>()?.into_iter().flatten().collect())
}

/// An arm, with its own payload and with another.
struct Case {
    arm: Scene,
    tick: f64,
    period: f64,
    planners: [Planner<f32, 2>; 2],
    fine: [Planner<f64, 2>; 2],
    rod: Rod<2>,
}

impl Case {
    fn new(arm: &Scene, rng: &mut StdRng) -> Result<Self, Error> {
        let tick = tick(arm)?;
        let mut other = *arm;
        other.payload.mass *= rng.random_range(0.7..1.4);
        let rod = Rod::new(arm)?;
        Ok(Self {
            arm: *arm,
            tick,
            period: rod::first_period(arm)?,
            planners: [Planner::new(arm, tick)?, Planner::new(&other, tick)?],
            fine: [Planner::new(arm, tick / 3.0)?, Planner::new(&other, tick / 3.0)?],
            rod,
        })
    }

    fn interrupt(&self, rng: &mut StdRng) -> Result<Interruption, Error> {
        let to: f64 = rng.random_range(-3.0..3.0);
        let duration = self.period * rng.random_range(1.5..4.0);
        let profile = Profile::ALL[rng.random_range(0..Profile::ALL.len())];
        let peaks = profile.peaks(to, duration);
        // For what the redirected move may need, see the limits below.
        let most = peaks.acceleration.max(0.5 / (self.period * self.period));
        let bend = self.rod.bend(1.5 * most).min(1.5);
        let stepper = Elastica::<f32, 2>::new(&self.rod, self.tick, Quality::Fine, bend)?;
        let mut generator = Generator::<_, 8>::new(stepper, 0.0)?;
        // A first move that the stepper itself refuses is nothing to interrupt.
        let Ok(summary) = generator.push(&Move::To { profile, duration, to }) else {
            return Ok(Interruption { outcome: Err("first move bends too far") });
        };
        // Before its end, or shortly after it with the arm still ringing.
        let when = rng.random_range(1..summary.ticks + summary.ticks / 4);
        for _ in 0..=when {
            generator.tick();
        }
        let (hub, flex) = interruption::ahead(&generator);
        let (planner, target) = match rng.random_range(0..3) {
            0 => (0, Some(rng.random_range(-3.0..3.0))),
            // A stop, wherever that is.
            1 => (0, None),
            _ => (1, Some(to)),
        };
        // At least what the hub does already: a quarter more than what either takes.
        let rate = 1.25 * f64::max(peaks.rate, f64::from(hub.rate).abs()).max(0.2 / self.period);
        let acceleration = f64::max(peaks.acceleration, f64::from(hub.acceleration).abs());
        let acceleration = 1.25 * acceleration.max(0.5 / (self.period * self.period));
        let limits =
            Limits { rate: Some(rate), acceleration: Some(acceleration), ..Limits::default() };
        let end = target.map_or(Target::Stop, Target::Angle);
        let request = Request::from_hub(hub.precise(), end).arm(flex).limits(limits);
        let plans = &self.planners[planner];
        let course = match plans.plan_by_stop(&request) {
            Err(error) => return Ok(Interruption { outcome: Err(kind(&error)) }),
            Ok(course) => course,
        };
        if let Err(error) = generator.redirect(2, &course.first) {
            return Ok(Interruption { outcome: Err(kind(&error)) });
        }
        if let Some(then) = course.then {
            generator.push(&then.motion())?;
        }
        let mut excess = f64::NEG_INFINITY;
        let ticks = course.first.ticks + course.then.map_or(0, |then| then.ticks);
        for _ in 0..ticks + 3 {
            generator.tick();
            let hub = *generator.hub();
            let over = |value: f32, limit: f64| f64::from(value).abs() / limit - 1.0;
            excess = excess.max(over(hub.rate, rate)).max(over(hub.acceleration, acceleration));
        }
        let length = self.arm.link.length;
        let residual = interruption::residual(&self.fine[planner], &course, &flex) / length;
        let stated = course.predict(plans, Some(&flex)).residual / length;
        let by_way_of_rest = course.then.is_some();
        Ok(Interruption { outcome: Ok(Outcome { excess, stated, residual, by_way_of_rest }) })
    }
}
