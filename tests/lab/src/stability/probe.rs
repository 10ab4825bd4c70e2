//! Runs a method once and judges it.

use stillbeam::model::Modes;
use stillbeam::{Hub, Limits, Link, Move, Payload, Profile, Scene};

use crate::stress::growth::grows;
use stillbeam_sim::dispatch;
use stillbeam_sim::error::Error;
use stillbeam_sim::run::each_tick;
use stillbeam_sim::scene_file::{Deduced, SceneFile};
use stillbeam_sim::solver::{Method, Quality, Scalar, Solver, SolverKeys};
use stillbeam_sim::step::Step;

/// Verdict on a run, from good to bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Deflections are true to 1 % of their peak.
    Accurate,
    /// Deflections are not accurate, but they do not grow.
    Inaccurate,
    /// Deflections grow after the move, or are not numbers.
    Unstable,
    /// The run is not accepted.
    Refused,
}

impl Verdict {
    /// Returns the name in a table.
    pub fn name(self) -> &'static str {
        match self {
            Self::Accurate => "accurate to 1 %",
            Self::Inaccurate => "inaccurate",
            Self::Unstable => "unstable",
            Self::Refused => "refused",
        }
    }

    /// All verdicts, in order.
    pub const ALL: [Self; 4] = [Self::Accurate, Self::Inaccurate, Self::Unstable, Self::Refused];
}

/// Motion of the hub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Task {
    /// A quintic of three first periods, 20 ticks at least, that bends the arm by 0.1 rad; then
    /// rest.
    Move,
    /// A spin-up in five first periods, 20 ticks at least, to this many times ω₁, held.
    Spin(f64),
}

/// Returns the ticks at the end of a run in which nothing may grow: six first periods, at least
/// 1,500 and at most 20,000.
fn held(turn: f64) -> f64 {
    (6.0 * std::f64::consts::TAU / turn).ceil().clamp(1500.0, 20_000.0)
}

/// L of the arm, m.
const LENGTH: f64 = 0.5;

/// Ticks after the move that are compared.
const COMPARED: f64 = 60.0;

/// Returns an undamped level arm with a mass at the tip as heavy as the link, a hub of a tenth of
/// L, and that first frequency in rad/s.
pub fn arm(omega: f64) -> Result<Scene, Error> {
    let unit = Scene {
        hub: Hub { radius: 0.1 * LENGTH, inertia: 0.0, stiffness: None },
        payload: Payload { mass: 0.05, inertia: 0.0, offset: 0.0 },
        ..Scene::new(Link { length: LENGTH, mass: 0.05, bending_stiffness: 1.0 })
    };
    let model = stillbeam::model::EightElements::consistent(&unit)?;
    let share = omega / Modes::of(&model).frequency[0];
    Ok(Scene { link: Link { bending_stiffness: share * share, ..unit.link }, ..unit })
}

/// Returns the scene of a task, which ends `after` ticks after its move.
pub fn scene(arm: &Scene, omega: f64, tick: f64, task: Task, after: f64) -> SceneFile {
    let period = std::f64::consts::TAU / omega;
    let whole = |periods: f64| (periods * period / tick).ceil().max(20.0) * tick;
    let motion = match task {
        Task::Move => {
            let duration = whole(3.0);
            // The tip of a beam with its mass at the end lags by θ̈/ω² of the arm's reach.
            let reach = (arm.hub.radius + arm.link.length) / arm.link.length;
            let acceleration = 0.07 * omega * omega / reach;
            let angle = acceleration * duration * duration / 5.77;
            Move::To { profile: Profile::Quintic, duration, to: angle.min(0.4 * duration / tick) }
        }
        Task::Spin(share) => Move::SpinUp { duration: whole(5.0), rate: share * omega },
    };
    SceneFile {
        shortest: Vec::new(),
        name: "probe".into(),
        arm: *arm,
        from: 0.0,
        shaper: None,
        moves: vec![Step { motion: motion.into(), settle: after * tick }],
        limits: Limits::default(),
        solver: SolverKeys::default(),
        deduced: Deduced::default(),
        remarks: Vec::new(),
    }
}

/// Judges a solver on a task at its tick, the arm's first frequency in rad/s.
pub fn judge(solver: &Solver, omega: f64, task: Task) -> Result<Verdict, Error> {
    let arm = arm(omega)?;
    let held = held(omega * solver.tick);
    let Ok(found) = deflections(&scene(&arm, omega, solver.tick, task, held), solver) else {
        return Ok(Verdict::Refused);
    };
    // What rests for less than four periods cannot be seen to grow.
    let seen = held * omega * solver.tick > 4.0 * std::f64::consts::TAU;
    let held = if seen { held as usize } else { 0 };
    Ok(verdict(&found, &truth(&arm, solver, omega, task)?, held))
}

/// Returns the deflections at the ticks by the same kinematics: three modes in f64 at ticks of a
/// twentieth of a radian of the first, or a 64th of the judged tick.
pub fn truth(arm: &Scene, solver: &Solver, omega: f64, task: Task) -> Result<Vec<f64>, Error> {
    let finer = (omega * solver.tick / 0.05).ceil().clamp(1.0, 64.0);
    let method = if solver.method == Method::Elastica { Method::Elastica } else { Method::Modal };
    let fine = Solver {
        method,
        modes: 3,
        elements: 8,
        quality: Quality::Fine,
        scalar: Scalar::F64,
        tick: solver.tick / finer,
        ..Solver::PAPER
    };
    let scene = scene(arm, omega, solver.tick, task, COMPARED);
    Ok(deflections(&scene, &fine)
        .map_or(Vec::new(), |fine| fine.into_iter().step_by(finer as usize).collect()))
}

/// Judges deflections by true ones, which may end sooner. Those of the last `held` ticks must not
/// grow.
pub fn verdict(found: &[f64], truth: &[f64], held: usize) -> Verdict {
    if found.iter().any(|w| !w.is_finite()) || grows(found, held, LENGTH) {
        return Verdict::Unstable;
    }
    let peak = truth.iter().fold(0.0, |peak: f64, w| peak.max(w.abs()));
    let apart = found.iter().zip(truth).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
    // Without a truth nothing is accurate.
    if apart <= 0.01 * peak && !truth.is_empty() { Verdict::Accurate } else { Verdict::Inaccurate }
}

/// Returns the deflection at every tick, m.
pub fn deflections(scene: &SceneFile, solver: &Solver) -> Result<Vec<f64>, Error> {
    let mut all = Vec::new();
    each_tick(&*dispatch::stepper(scene, solver)?, scene, |generator, _, _| {
        all.push(generator.tick().precise().deflection());
    })?;
    Ok(all)
}
