//! Worth of the setpoints: one machine, with less and with more of them.

use rayon::prelude::*;
use stillbeam::{Limits, Move, Scene};

use super::bench::{Bench, Feed, Trace};
use super::judge::{Commanded, Judged};
use super::setpoints::Setpoints;
use super::{Between, Machine};
use crate::error::Error;
use crate::number::Digits;
use crate::plan::Request;
use crate::plant::{Friction, Options};
use crate::reference::rod;
use crate::scene_file::SceneFile;
use crate::step::{Motion, Step};

/// A change that the setpoints do not know of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Unknown {
    /// None: the machine is as it is thought to be.
    None,
    /// The payload's mass times a factor.
    Payload(f64),
    /// The stiffness of the link times a factor.
    Stiffness(f64),
    /// The friction, all of it.
    Friction,
    /// The machine has no friction, and that is known.
    Frictionless,
}

/// One row of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trial {
    /// Parts of the setpoints that are sent.
    pub feed: Feed,
    /// Way between setpoints, if it is not the drive's own.
    pub between: Option<Between>,
    /// True if the moves are planned to arrive still.
    pub still: bool,
    /// The error of the model.
    pub unknown: Unknown,
}

/// A trial and what came of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The trial.
    pub trial: Trial,
    /// How far hub and tip are off.
    pub judged: Judged,
    /// Residual of the same arm whose hub follows exactly, fraction of L.
    pub exact: f64,
    /// The run.
    pub trace: Trace,
    /// Time by which the drive follows later, s.
    pub lag: f64,
}

/// All trials of a scene on a machine.
#[derive(Clone, Debug)]
pub struct Report {
    /// The arm of the scene.
    pub arm: Scene,
    /// The rows, in the order of the table.
    pub outcomes: Vec<Outcome>,
    /// The commanded motion of the scene's own moves.
    pub commanded: Commanded,
    /// h, s.
    pub tick: f64,
    /// Reason why there are no still moves, if so.
    pub no_still: Option<Error>,
}

/// Fineness of the trials. With finer ones the errors of hub and tip change by less than 1e-3 of
/// themselves.
const OPTIONS: Options = Options { order: 5, tolerance: 1e-7 };

impl Trial {
    /// The scene's own moves, with all that can be sent and nothing unknown.
    pub const PLAIN: Self =
        Self { feed: Feed::ALL, between: None, still: false, unknown: Unknown::None };
    /// The same with still moves.
    pub const STILL: Self = Self { still: true, ..Self::PLAIN };

    /// Returns the trials of the table. Those of the payload are left out for an arm without one.
    pub fn all(arm: &Scene) -> Vec<Self> {
        let mut all = vec![
            Self { feed: Feed::POSITION, ..Self::PLAIN },
            Self { feed: Feed::VELOCITY, ..Self::PLAIN },
            Self::PLAIN,
            Self { between: Some(Between::Linear), ..Self::PLAIN },
            Self { between: Some(Between::Hermite), ..Self::PLAIN },
            Self { unknown: Unknown::Friction, ..Self::PLAIN },
            Self::STILL,
            Self { between: Some(Between::Hermite), ..Self::STILL },
            Self { unknown: Unknown::Frictionless, ..Self::STILL },
            Self { unknown: Unknown::Friction, ..Self::STILL },
            Self { unknown: Unknown::Stiffness(0.9), ..Self::STILL },
            Self { unknown: Unknown::Stiffness(1.1), ..Self::STILL },
        ];
        if arm.payload.mass > 0.0 {
            all.push(Self { unknown: Unknown::Payload(0.9), ..Self::STILL });
            all.push(Self { unknown: Unknown::Payload(1.1), ..Self::STILL });
        }
        all
    }

    /// Returns what is sent and what is not known, in words.
    pub fn describe(&self) -> String {
        let feed = match self.feed {
            Feed { torque: true, .. } => "position, velocity, torque",
            Feed { velocity: true, .. } => "position, velocity",
            _ => "position",
        };
        let kind = if self.still { "still, " } else { "" };
        let between = match self.between {
            None => String::new(),
            Some(between) => format!(", {}", between.name()),
        };
        let percent = |what: &str, factor: f64| {
            format!("; {what} {:+.0} %", 100.0 * (factor - 1.0)).replace('-', "\u{2212}")
        };
        let unknown = match self.unknown {
            Unknown::None => String::new(),
            Unknown::Payload(factor) => percent("payload", factor),
            Unknown::Stiffness(factor) => percent("stiffness", factor),
            Unknown::Friction => "; friction not known".to_owned(),
            Unknown::Frictionless => "; no friction".to_owned(),
        };
        format!("{kind}{feed}{between}{unknown}")
    }

    /// Returns the arm as it is.
    fn arm(&self, arm: &Scene) -> Scene {
        match self.unknown {
            Unknown::Payload(factor) => {
                let mut heavier = *arm;
                heavier.payload.mass *= factor;
                heavier.payload.inertia *= factor;
                heavier
            }
            Unknown::Stiffness(factor) => arm.stiffened(factor),
            _ => *arm,
        }
    }

    /// Returns the machine as it is, and what of the setpoints is sent to it.
    fn machine(&self, machine: &Machine) -> (Machine, Feed) {
        let mut machine = *machine;
        if let Some(between) = self.between {
            machine.drive = machine.drive.with_between(between);
        }
        if self.unknown == Unknown::Frictionless {
            machine.parts.friction = Friction::default();
        }
        let friction = self.feed.friction && self.unknown != Unknown::Friction;
        (machine, Feed { friction, ..self.feed })
    }
}

impl Report {
    /// Runs all trials. `done` is called after each.
    ///
    /// # Errors
    /// Refusals of a scene or a machine. A scene whose moves have no still counterpart is
    /// not refused: its still rows are left out.
    pub fn of(
        scene: &SceneFile,
        machine: &Machine,
        trials: &[Trial],
        done: &(dyn Fn() + Sync),
    ) -> Result<Self, Error> {
        let plain = Commands::of(with_rest(scene.clone())?)?;
        let stilled = still(scene).and_then(with_rest).and_then(Commands::of);
        let outcomes = trials
            .par_iter()
            .filter_map(|trial| {
                let commands = if trial.still { stilled.as_ref().ok()? } else { &plain };
                let outcome = commands.carry_out(trial, machine);
                done();
                Some(outcome)
            })
            .collect::<Result<Vec<_>, Error>>()?;
        let tick = plain.setpoints.tick;
        let (arm, no_still) = (scene.arm, stilled.err());
        Ok(Self { arm, outcomes, commanded: plain.commanded, tick, no_still })
    }

    /// Returns the outcome of a trial, if it was made.
    pub fn find(&self, trial: &Trial) -> Option<&Outcome> {
        self.outcomes.iter().find(|outcome| outcome.trial == *trial)
    }

    /// Says in one line what feed-forward bought.
    pub fn conclusion(&self) -> String {
        let of = |trial: Trial| self.find(&trial).map(|outcome| outcome.judged);
        let mut text = String::new();
        if let (Some(less), Some(more)) =
            (of(Trial { feed: Feed::POSITION, ..Trial::PLAIN }), of(Trial::PLAIN))
        {
            let show = |x: f64| Digits::Three.show(x);
            text += &format!(
                "feed-forward makes the hub's largest error {:.0} times smaller: {} rad instead of {}",
                less.hub / more.hub,
                show(more.hub),
                show(less.hub)
            );
            let left = show(100.0 * more.residual);
            text += &match of(Trial::STILL).filter(|still| still.residual != more.residual) {
                Some(still) => format!(
                    "; a still move leaves {} % of L of vibration instead of {left}",
                    show(100.0 * still.residual)
                ),
                None => format!("; {left} % of L of vibration is left"),
            };
        }
        text
    }
}

/// A scene with its setpoints and its commanded motion.
struct Commands {
    scene: SceneFile,
    setpoints: Setpoints,
    commanded: Commanded,
}

impl Commands {
    fn of(scene: SceneFile) -> Result<Self, Error> {
        let setpoints = Setpoints::of(&scene)?;
        let commanded = Commanded::of(&scene.arm, &scene.trajectory(setpoints.tick)?)?;
        Ok(Self { scene, setpoints, commanded })
    }

    fn carry_out(&self, trial: &Trial, machine: &Machine) -> Result<Outcome, Error> {
        let Self { scene, setpoints, commanded } = self;
        let arm = trial.arm(&scene.arm);
        let (machine, feed) = trial.machine(machine);
        let lag = machine.servo(setpoints.tick)?.lag();
        let trace = Bench::new(&arm, &machine, setpoints, feed, &OPTIONS)?.run()?;
        let judged = commanded.judge(&arm, &trace, lag)?;
        let exact = Commanded::exact_residual(&arm, &scene.trajectory(setpoints.tick)?)?;
        Ok(Outcome { trial: *trial, judged, exact, trace, lag })
    }
}

/// Adds a rest that is long enough to see what a move leaves, of a drive that lags by a tick.
fn with_rest(mut scene: SceneFile) -> Result<SceneFile, Error> {
    let tick = scene.solver.resolve()?.tick;
    let period = rod::first_period(&scene.arm)?;
    let duration = 1.1 * period.max(6.0 * tick) + 4.0 * tick;
    for step in &mut scene.moves {
        step.settle = step.settle.min(duration);
    }
    scene.moves.push(Step { motion: Move::Dwell { duration }.into(), settle: 0.0 });
    Ok(scene)
}

/// Returns the scene with moves in its moves' place that arrive still, in the same durations.
fn still(scene: &SceneFile) -> Result<SceneFile, Error> {
    let tick = scene.solver.resolve()?.tick;
    let mut stilled = scene.clone();
    let mut from = scene.from;
    for step in &mut stilled.moves {
        let Motion::Move(motion) = &step.motion else {
            return Err(Error::new("move.waypoints: no still move takes the place of a path"));
        };
        match *motion {
            Move::Dwell { .. } => {}
            Move::To { duration, to, .. } => {
                let request = Request {
                    arm: scene.arm,
                    from,
                    to,
                    duration: Some(duration),
                    limits: Limits::default(),
                    robust: None,
                    options: crate::plan::Options::default(),
                    tick,
                };
                step.motion = request.plan()?.plan.motion().into();
                from = to;
            }
            // A still move already.
            other => {
                from = end(&other).ok_or_else(|| {
                    Error::new("move.rate: no still move takes the place of one that ends turning")
                })?
            }
        }
    }
    Ok(stilled)
}

/// Returns the angle, rad, at which a move from rest to rest ends.
fn end(motion: &Move) -> Option<f64> {
    match motion {
        Move::Still { to, .. } => Some(*to),
        _ => None,
    }
}
