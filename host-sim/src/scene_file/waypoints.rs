//! The waypoints of a move: rows of time, angle, rate and acceleration.

use stillbeam::motion::{Spline, Waypoint};

use crate::error::Error;
use crate::waypoints::{Places, Waypoints};

/// Most rounds of a path.
const MOST_ROUNDS: u32 = 100_000;

/// Most rows of a path, all rounds included.
const MOST_ROWS: usize = 100_000;

/// Waypoints as a move's table has them, in s and rad.
pub(super) struct Rows<'a> {
    /// Rows of two to four numbers.
    pub rows: &'a [Vec<f64>],
    /// Name of the spline.
    pub profile: Option<&'a str>,
    /// Number of rounds.
    pub repeat: Option<u32>,
    /// Angle at which the hub begins, rad; `None` behind a turning hub.
    pub at: Option<f64>,
}

impl Rows<'_> {
    /// Returns the path.
    pub fn build(&self) -> Result<Waypoints, Error> {
        let rows = self.rows.iter().enumerate();
        let mut rows: Vec<Waypoint> =
            rows.map(|(k, row)| waypoint(k, row)).collect::<Result<_, _>>()?;
        rising(&rows)?;
        let (first, acceleration) = self.begin(&mut rows)?;
        let Some(last) = rows.last().copied() else {
            return Err(Error::new(
                "move.waypoints: must be one row at least behind t = 0, e.g. [[0.5, 0.2], [1.0, 0.3]]",
            ));
        };
        let rounds = self.rounds(rows.len())?;
        let turn = match (self.at, rounds) {
            (_, 1) => 0.0,
            (Some(at), _) => last.angle - at,
            (None, _) => {
                return Err(Error::new(
                    "move.repeat: must be absent behind a turning hub, where no round begins as \
                     another ends",
                ));
            }
        };
        let round = rows.len();
        let all = (0..rounds)
            .map(f64::from)
            .flat_map(|k| rows.iter().map(move |row| row.shifted(k * last.time, k * turn)));
        let path = Waypoints::new(self.spline()?, all.collect(), Places::List { first, round });
        Ok(path.beginning_with(acceleration))
    }

    /// Takes away a row at t = 0, which must be where the hub is. Returns the number of the first
    /// row that is left, and the acceleration that the row gives.
    fn begin(&self, rows: &mut Vec<Waypoint>) -> Result<(usize, Option<f64>), Error> {
        let Some(row) = rows.first().copied().filter(|row| row.time == 0.0) else {
            return Ok((0, None));
        };
        let Some(at) = self.at else {
            return Err(Error::new(
                "move.waypoints[0]: t = 0 s: must be absent behind a turning hub; the path begins \
                 where the move before it ends",
            ));
        };
        if row.angle != at {
            return Err(Error::new(format_args!(
                "move.waypoints[0]: {} rad at t = 0 s: must be {at} rad, where the move begins",
                row.angle
            )));
        }
        if let Some(rate) = row.rate.filter(|rate| *rate != 0.0) {
            return Err(Error::new(format_args!(
                "move.waypoints[0]: {rate} rad/s at t = 0 s: must be 0 or absent, the hub is at rest \
                 there"
            )));
        }
        rows.remove(0);
        Ok((1, row.acceleration))
    }

    fn rounds(&self, rows: usize) -> Result<u32, Error> {
        let rounds = self.repeat.unwrap_or(1);
        let fits = (1..=MOST_ROUNDS).contains(&rounds) && rounds as usize * rows <= MOST_ROWS;
        if fits {
            return Ok(rounds);
        }
        Err(Error::new(format_args!(
            "move.repeat = {rounds}: must be 1 to {}, a hundred thousand rows in all",
            (MOST_ROWS / rows.max(1)).max(1)
        )))
    }

    fn spline(&self) -> Result<Spline, Error> {
        match self.profile {
            // An acceleration is kept by a quintic only.
            None if self.rows.iter().any(|row| row.len() > 3) => Ok(Spline::Quintic),
            None => Ok(Spline::Cubic),
            Some(name) => Spline::named(name).ok_or_else(|| {
                let known = Spline::ALL.map(Spline::name).join(" or ");
                Error::new(format_args!(
                    "move.profile = \"{name}\": must be {known} between waypoints, or absent"
                ))
            }),
        }
    }
}

fn waypoint(k: usize, row: &[f64]) -> Result<Waypoint, Error> {
    let number = |x: Option<&f64>| x.copied();
    let shape = |given: String| {
        Error::new(format_args!(
            "move.waypoints[{k}] = [{given}]: must be [t in s, angle], [t, angle, rate] or [t, angle, \
             rate, acceleration], finite numbers"
        ))
    };
    let text = || row.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    match row {
        [time, angle, rest @ ..] if rest.len() <= 2 && row.iter().all(|x| x.is_finite()) => {
            let (rate, acceleration) = (number(rest.first()), number(rest.get(1)));
            Ok(Waypoint { time: *time, angle: *angle, rate, acceleration })
        }
        _ => Err(shape(text())),
    }
}

fn rising(rows: &[Waypoint]) -> Result<(), Error> {
    let mut before = None;
    for (k, row) in rows.iter().enumerate() {
        let wanted = match before {
            None if row.time < 0.0 => "0 or later, it counts from the move's beginning".to_owned(),
            Some(time) if row.time == time => {
                format!("later than {time} s: two rows are given for one time")
            }
            Some(time) if row.time < time => {
                format!("later than {time} s, the time of the row before it")
            }
            _ => {
                before = Some(row.time);
                continue;
            }
        };
        return Err(Error::new(format_args!(
            "move.waypoints[{k}][0]: t = {} s: must be {wanted}",
            row.time
        )));
    }
    Ok(())
}
