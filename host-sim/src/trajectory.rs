//! The commanded motion of a whole scene, at any time. It is the core's plan, kept in f64 for
//! solvers that choose their own steps.

use stillbeam::hub::{Angle, HubState};
use stillbeam::motion::{Limits, MoveSummary, Path, Plan, RowError, Segment, Shaper};
use stillbeam::{Error as CoreError, Move};

use crate::error::Error;
use crate::step::Motion;
use crate::waypoints::Waypoints;

/// Side from which a jump of the commanded acceleration is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The value just before the jump.
    Left,
    /// The value just after the jump.
    Right,
}

/// Motions end to end, from rest.
#[derive(Clone, Debug)]
pub struct Trajectory {
    pieces: Vec<Piece>,
    plans: Vec<Planned>,
    /// The hub at the end.
    end: HubState<f64>,
    /// Ticks at which motions other than dwells end.
    arrivals: Vec<u64>,
    tick: f64,
    ticks: u64,
    /// Shaper that the whole motion has passed, if any.
    shaper: Option<Shaper>,
}

/// One segment and the time it covers.
#[derive(Clone, Debug)]
struct Piece {
    begin: f64,
    end: f64,
    /// Time of the segment's first whole tick.
    first: f64,
    segment: Segment<f64>,
}

/// A planned motion: a move or a path.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// Its segments, first to last.
    pub segments: Vec<Segment<f64>>,
    /// Duration, end and peaks.
    pub summary: MoveSummary,
}

impl Trajectory {
    /// Plans the moves from rest at `from` rad. Needs at least one move.
    pub fn plan(from: f64, moves: &[Move], limits: &Limits, tick: f64) -> Result<Self, CoreError> {
        let mut trajectory = Self::resting(from, tick)?;
        for motion in moves {
            trajectory.append_move(motion, limits)?;
        }
        Ok(trajectory)
    }

    /// Creates a trajectory without a motion, at rest at `from` rad. It is one from the first
    /// motion on that is appended.
    pub fn resting(from: f64, tick: f64) -> Result<Self, CoreError> {
        Ok(Self {
            pieces: Vec::new(),
            plans: Vec::new(),
            end: HubState::resting_at(from)?,
            arrivals: Vec::new(),
            tick,
            ticks: 0,
            shaper: None,
        })
    }

    /// Appends a motion, held against no limit.
    ///
    /// # Errors
    /// Refusals of the core; of a path with the place of the row.
    pub fn append(&mut self, motion: &Motion) -> Result<(), Error> {
        match motion {
            Motion::Move(motion) => Ok(self.append_move(motion, &Limits::default())?),
            Motion::Path(path) => self.append_path(path),
        }
    }

    fn append_move(&mut self, motion: &Move, limits: &Limits) -> Result<(), CoreError> {
        let Plan { segments, summary } = Plan::new(motion, self.end, limits, self.tick)?;
        self.lay(&segments);
        let arrives = !matches!(motion, Move::Dwell { .. });
        self.take(Planned { segments: segments.iter().copied().collect(), summary }, arrives);
        Ok(())
    }

    fn append_path(&mut self, path: &Waypoints) -> Result<(), Error> {
        let rows = path.rows(self.tick);
        let refused =
            |error: RowError| Error::new(error.error).within(path.place(error.row as usize));
        let core = Path::new(path.spline(), self.end, &Limits::default(), self.tick)?;
        let begun =
            path.begun(core).map_err(|error| Error::new(error).within(path.place_of_begin()))?;
        let surveyed = begun.survey(rows.iter().copied()).map_err(refused)?;
        let segments = begun.segments(rows.iter().copied());
        let segments = segments.collect::<Result<Vec<_>, _>>().map_err(refused)?;
        let end = rows.last().map_or(self.end, |row| {
            let angle = Angle::from_radians(row.angle);
            let acceleration = path.end_acceleration_of(row);
            HubState { acceleration, ..HubState::turning(angle, row.rate.unwrap_or(0.0)) }
        });
        let ticks = path.ticks(self.tick);
        let rounded_by = f64::from(ticks) * self.tick - path.duration();
        let summary = MoveSummary { end, ticks, peaks: *surveyed.peaks(), rounded_by };
        self.lay(&segments);
        self.take(Planned { segments, summary }, true);
        Ok(())
    }

    /// Puts the segments of a motion behind the others.
    fn lay(&mut self, segments: &[Segment<f64>]) {
        let mut k = self.ticks;
        for segment in segments {
            let first = k as f64 * self.tick;
            let begin = first - segment.ticks_before() * self.tick;
            if let Some(last) = self.pieces.last_mut() {
                last.end = begin;
            }
            k += u64::from(segment.count());
            let end = k as f64 * self.tick;
            self.pieces.push(Piece { begin, end, first, segment: *segment });
        }
    }

    /// Goes on behind a motion whose pieces are laid.
    fn take(&mut self, planned: Planned, arrives: bool) {
        self.ticks += u64::from(planned.summary.ticks);
        if arrives {
            self.arrivals.push(self.ticks);
        }
        self.end = planned.summary.end;
        self.plans.push(planned);
    }

    /// Returns the same motion through a shaper, from rest to rest. The motion gets longer by the
    /// shaper's delay, rounded up to whole ticks.
    pub fn shaped(self, shaper: Shaper) -> Self {
        let added = (shaper.delay() / self.tick - 1e-9).ceil() as u64;
        let arrivals = self.arrivals.iter().map(|k| k + added).collect();
        Self { arrivals, ticks: self.ticks + added, shaper: Some(shaper), ..self }
    }

    /// Returns the hub at time `t` s. Before the beginning and after the end, the nearest of the
    /// two counts.
    pub fn at(&self, t: f64, side: Side) -> HubState<f64> {
        let Some(shaper) = &self.shaper else { return self.unshaped(t, side) };
        let mut sum = HubState { rate: 0.0, acceleration: 0.0, ..self.unshaped(0.0, Side::Right) };
        let start = sum.angle;
        let (eps, end) = (1e-9 * self.tick, self.pieces.last().map_or(0.0, |piece| piece.end));
        let mut turned = 0.0;
        for pulse in shaper.pulses() {
            let t = t - pulse.delay;
            let hub = self.unshaped(t, side);
            turned += pulse.amplitude * hub.angle.since(start);
            let within = match side {
                Side::Left => t > eps && t <= end + eps,
                Side::Right => t >= -eps && t < end - eps,
            };
            if within {
                sum.rate += pulse.amplitude * hub.rate;
                sum.acceleration += pulse.amplitude * hub.acceleration;
            }
        }
        sum.angle = Angle::plus(start, turned);
        (sum.sin, sum.cos) = sum.angle.sin_cos();
        sum
    }

    fn unshaped(&self, t: f64, side: Side) -> HubState<f64> {
        // Times within a nanotick of a border belong to it.
        let eps = 1e-9 * self.tick;
        let after = match side {
            Side::Left => self.pieces.partition_point(|piece| piece.begin < t - eps),
            Side::Right => self.pieces.partition_point(|piece| piece.begin <= t + eps),
        };
        let piece = &self.pieces[after.saturating_sub(1)];
        let t = t.clamp(piece.begin, piece.end);
        piece.segment.hub_at((t - piece.first) / self.tick)
    }

    /// Returns the times strictly inside the run at which the motion's formula changes. Its
    /// acceleration or a higher derivative may jump there. An integrator restarts at each.
    pub fn breaks(&self) -> Vec<f64> {
        let Some(shaper) = &self.shaper else {
            return self.pieces.iter().skip(1).map(|piece| piece.begin).collect();
        };
        let end = self.duration();
        let borders = self.pieces.iter().flat_map(|piece| [piece.begin, piece.end]);
        let mut all: Vec<f64> = borders
            .flat_map(|t| shaper.pulses().iter().map(move |pulse| t + pulse.delay))
            .filter(|&t| t > 1e-6 * self.tick && t < end - 1e-6 * self.tick)
            .collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|b, a| *b - *a < 1e-9 * self.tick);
        all
    }

    /// Returns the times at which moves end, dwells left out, s. A table holds the left-hand
    /// acceleration and torque there.
    pub fn arrivals(&self) -> impl Iterator<Item = f64> {
        self.arrivals.iter().map(|&k| k as f64 * self.tick)
    }

    /// Ticks of the whole run.
    pub fn ticks(&self) -> u64 {
        self.ticks
    }

    /// h, s.
    pub fn tick(&self) -> f64 {
        self.tick
    }

    /// Length of the whole run, s.
    pub fn duration(&self) -> f64 {
        self.ticks as f64 * self.tick
    }

    /// Returns the planned motions, in order.
    pub fn plans(&self) -> &[Planned] {
        &self.plans
    }
}
