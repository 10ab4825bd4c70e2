//! A path through waypoints, with the place of every row in the file that it comes from.

use std::sync::Arc;

use stillbeam::Error as CoreError;
use stillbeam::motion::{Path, Spline, Waypoint};

/// Share of a tick within which a time counts as a whole number of ticks.
const WHOLE: f64 = 1e-3;

/// A path from the angle where the hub is, through rows of time, angle, rate and acceleration.
///
/// It is cheap to clone.
#[derive(Clone, Debug, PartialEq)]
pub struct Waypoints {
    spline: Spline,
    rows: Arc<[Waypoint]>,
    /// Acceleration with which the path begins, rad/s²; `None` is the hub's own.
    begin: Option<f64>,
    places: Places,
}

/// Where the rows of a path stand.
#[derive(Clone, Debug, PartialEq)]
pub enum Places {
    /// In the list `waypoints` of a scene file, from the row of that number on; as many again in
    /// every round.
    List {
        /// Number of the first row behind the beginning.
        first: usize,
        /// Rows of a round.
        round: usize,
    },
    /// In a file: the name of each row's place.
    File(Arc<[String]>),
    /// In a file of samples, between whose rows the path has its own.
    Samples(Arc<str>),
}

impl Waypoints {
    /// Creates the path. Times rise from above 0; there is a row at least.
    pub fn new(spline: Spline, rows: Vec<Waypoint>, places: Places) -> Self {
        Self { spline, rows: rows.into(), begin: None, places }
    }

    /// Returns the path with an acceleration at its beginning, rad/s²; `None` is the hub's own.
    pub fn beginning_with(self, acceleration: Option<f64>) -> Self {
        Self { begin: acceleration, ..self }
    }

    /// Returns a path of the core with this path's acceleration at its beginning.
    ///
    /// # Errors
    /// An acceleration of a cubic spline, which has its own.
    pub fn begun(&self, path: Path) -> Result<Path, CoreError> {
        match self.begin {
            Some(acceleration) => path.beginning_with(acceleration),
            None => Ok(path),
        }
    }

    /// Polynomials between the rows.
    pub fn spline(&self) -> Spline {
        self.spline
    }

    /// Returns the time of the last row, s.
    pub fn duration(&self) -> f64 {
        self.rows.last().map_or(0.0, |row| row.time)
    }

    /// Returns the rate at the end, rad/s.
    pub fn end_rate(&self) -> f64 {
        self.rows.last().and_then(|row| row.rate).unwrap_or(0.0)
    }

    /// Returns the acceleration with which a path ends whose last row this is, rad/s². A quintic
    /// ends with what the row gives; a cubic's jumps to 0.
    pub fn end_acceleration_of(&self, row: &Waypoint) -> f64 {
        row.acceleration.filter(|_| self.spline == Spline::Quintic).unwrap_or(0.0)
    }

    /// Returns the angle at the last row, rad.
    pub fn end_angle(&self) -> f64 {
        self.rows.last().map_or(0.0, |row| row.angle)
    }

    /// Returns the whole ticks of `tick` s that the path takes. A part of a tick counts as one.
    pub fn ticks(&self, tick: f64) -> u32 {
        (self.duration() / tick - WHOLE).ceil().max(1.0) as u32
    }

    /// Returns the rows of the path with setpoints every `tick` s. The path ends at a tick: if the
    /// last row lies within one, the hub goes on at its rate to the end of that.
    pub fn rows(&self, tick: f64) -> Vec<Waypoint> {
        let mut rows = self.rows.to_vec();
        let end = f64::from(self.ticks(tick)) * tick;
        if let Some(last) = rows.last_mut() {
            let (rate, lacking) = (last.rate.unwrap_or(0.0), end - last.time);
            if lacking.abs() <= WHOLE * tick {
                last.time = end;
            } else {
                last.rate = Some(rate);
                if self.spline == Spline::Quintic {
                    last.acceleration = Some(0.0);
                }
                let angle = last.angle + rate * lacking;
                rows.push(Waypoint::at(end, angle).turning(rate));
            }
        }
        rows
    }

    /// Returns the same path in another duration, s.
    pub fn lasting(&self, duration: f64) -> Self {
        let stretch = duration / self.duration();
        let row = |row: &Waypoint| Waypoint {
            time: row.time * stretch,
            angle: row.angle,
            rate: row.rate.map(|rate| rate / stretch),
            acceleration: row.acceleration.map(|a| a / (stretch * stretch)),
        };
        let begin = self.begin.map(|a| a / (stretch * stretch));
        Self { rows: self.rows.iter().map(row).collect(), begin, ..self.clone() }
    }

    /// Returns the place of the row of that number, counted as the core does.
    pub fn place(&self, row: usize) -> String {
        let row = row.min(self.rows.len().saturating_sub(1));
        match &self.places {
            Places::List { first, round } => {
                format!("move.waypoints[{}]", first + row % round)
            }
            Places::File(places) => places.get(row).cloned().unwrap_or_default(),
            Places::Samples(name) => format!("{name}: t_s = {:.6}", self.rows[row].time),
        }
    }

    /// Returns the place of the row at which the path begins.
    pub fn place_of_begin(&self) -> String {
        match &self.places {
            Places::List { .. } => "move.waypoints[0]".to_owned(),
            _ => self.place(0),
        }
    }

    /// Returns the place of the row to which the hub is on its way at `time` s from the path's
    /// beginning.
    pub fn place_at(&self, time: f64) -> String {
        self.place(self.rows.partition_point(|row| row.time < time - 1e-9))
    }
}
