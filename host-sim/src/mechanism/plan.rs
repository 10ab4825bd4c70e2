//! Moves of all joints of an open chain that arrive still, judged by the reference rod.

use stillbeam::chain::ChainPlanner;
use stillbeam::mechanism::Mechanism;
use stillbeam::{Limits, Move, Profile};

use super::table::Row;
use super::{Drives, JointDrive, MechanismScene};
use crate::error::Error;
use crate::reference::mechanism::rod;
use crate::truth;

/// First periods that a move takes if no duration is asked for.
const PERIODS: f64 = 2.0;

/// Request for a still move.
#[derive(Clone, Debug)]
pub struct Request<'a> {
    /// The chain, and the tick.
    pub scene: &'a MechanismScene,
    /// Angle of every joint at the beginning, rad.
    pub from: Vec<f64>,
    /// Angle of every joint at the end, rad.
    pub to: Vec<f64>,
    /// Duration, s. `None` asks for twice the first period at the end.
    pub duration: Option<f64>,
    /// Limits of each joint's drive.
    pub limits: Vec<Limits>,
}

/// A plan and its judgement.
#[derive(Clone, Debug)]
pub struct Planned {
    /// Move of every joint.
    pub moves: Vec<Move>,
    /// Duration in whole ticks, s.
    pub duration: f64,
    /// First period at the final pose, s.
    pub first_period: f64,
    /// Flights that the search took.
    pub flights: u32,
    /// The move and a first period after it, in the reference rod.
    pub still: Flown,
    /// The same with quintics in the same time.
    pub quintic: Flown,
}

/// A flight of the reference rod.
#[derive(Clone, Debug)]
pub struct Flown {
    /// Rows, one every tick.
    pub rows: Vec<Row>,
    /// Largest distance of a joint or the tip from its place at rest, over a first period after the
    /// arrival, fraction of the total length.
    pub residual: f64,
}

/// Result of the planner, whatever the number of links.
struct Found {
    moves: Vec<Move>,
    first_period: f64,
    flights: u32,
}

impl Request<'_> {
    /// Plans and judges.
    pub fn carry_out(&self) -> Result<Planned, Error> {
        let count = self.scene.mechanism.links.len();
        for (key, angles) in [("--from", &self.from), ("--to", &self.to)] {
            if angles.len() != count {
                return Err(Error::new(format_args!(
                    "{key} = {angles:?}: must be {count} angles in rad, one a joint, e.g. {}",
                    vec!["0.5"; count].join(",")
                )));
            }
        }
        let tick = self.scene.solver()?.tick;
        // Three curvatures: two err by more than a still move leaves.
        let Found { moves, first_period, flights } = match count {
            2 => self.find::<2, 8>(tick)?,
            3 => self.find::<3, 12>(tick)?,
            _ => {
                return Err(Error::new(format_args!(
                    "links = {count}: must be 2 or 3 to be planned; describe one link as an arm, \
                     with [link]"
                )));
            }
        };
        let duration = moves.first().map_or(0.0, Move::duration);
        let profile = Profile::Quintic;
        let quintics: Vec<Move> =
            self.to.iter().map(|&to| Move::To { profile, duration, to }).collect();
        Ok(Planned {
            duration,
            first_period,
            flights,
            still: self.fly(&moves, duration, first_period)?,
            quintic: self.fly(&quintics, duration, first_period)?,
            moves,
        })
    }

    fn find<const LINKS: usize, const C: usize>(&self, tick: f64) -> Result<Found, Error> {
        let mechanism = &self.scene.mechanism;
        let planner = ChainPlanner::<f64, LINKS, 4, C, 5>::new(mechanism, tick)?
            .with_limits(std::array::from_fn(|j| self.limits[j]))?;
        let [from, to] = [&self.from, &self.to].map(|angles| std::array::from_fn(|j| angles[j]));
        let first_period = planner.period(&to)?;
        let plan = planner.plan(&from, &to, self.duration.unwrap_or(PERIODS * first_period))?;
        Ok(Found { moves: plan.moves.to_vec(), first_period, flights: plan.flights })
    }

    /// Flies moves that begin together in the reference rod, and a first period after them.
    fn fly(&self, moves: &[Move], duration: f64, first_period: f64) -> Result<Flown, Error> {
        let tick = self.scene.solver()?.tick;
        let mechanism = self.posed(&self.from);
        let drive = |(joint, &motion): (usize, &Move)| JointDrive {
            joint,
            start: 0.0,
            motion: motion.into(),
        };
        let drives: Vec<JointDrive> = moves.iter().enumerate().map(drive).collect();
        let whole = duration + (first_period / tick).ceil() * tick;
        let drives = Drives::plan(&mechanism, &drives, whole, tick)?;
        let times = truth::times_until(drives.duration(), tick);
        let options = rod::Options::default();
        let rows = rod::solve(&mechanism, &drives, &times, &options, &|_| ())?;
        let rest = rod::at_rest(&self.posed(&self.to))?;
        let length = mechanism.total_length();
        let apart = |row: &Row| {
            let ends = row.ends.iter().zip(&rest.ends);
            ends.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max) / length
        };
        let after = rows.iter().filter(|row| row.t >= duration - 1e-9);
        let residual = after.map(apart).fold(0.0, f64::max);
        Ok(Flown { rows, residual })
    }

    /// Returns the chain with its joints at these angles.
    fn posed(&self, angles: &[f64]) -> Mechanism {
        let mut mechanism = self.scene.mechanism.clone();
        for (joint, angle) in mechanism.joints.iter_mut().zip(angles) {
            joint.angle = *angle;
        }
        mechanism
    }
}
