//! Hub motions from files: a CSV of times and angles, or a `trajectory_msgs/JointTrajectory` of
//! ROS 2 as JSON or YAML. They command a scene in place of its own moves.
//!
//! A file's rows are taken as waypoints, which the hub passes, or as samples, to which a smooth
//! motion is fitted ([`samples`]).

mod csv;
mod joint_trajectory;

use std::path::Path;
use std::sync::Arc;

use clap::ValueEnum;
use stillbeam::hub::HubState;
use stillbeam::motion::{Spline, Waypoint};
use stillbeam::stepper::{AnyMotion, Rigid, Stepper};
use stillbeam::{Angle, Scene};

use crate::error::Error;
use crate::samples;
use crate::scene_file::SceneFile;
use crate::step::{Motion, Step};
use crate::waypoints::{Places, Waypoints};

/// Number of rows without a rate above which a CSV is taken as samples, unless asked otherwise.
const MANY: usize = 50;

/// Rate that counts as none in a file's first row, rad/s.
const NONE: f64 = 1e-9;

/// How the rows of a file are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Taking {
    /// The hub passes every row.
    Waypoints,
    /// The rows are measured: the motion comes close to them, as smoothly as their noise lets it.
    Samples,
}

/// Polynomials between waypoints.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Between {
    /// Cubics; accelerations of the file are not read.
    Cubic,
    /// Quintics.
    Quintic,
}

/// Options with which a file is read. `None` lets the file decide.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// Name of the joint.
    pub joint: Option<String>,
    /// Waypoints or samples.
    pub taking: Option<Taking>,
    /// Polynomials between waypoints.
    pub between: Option<Between>,
    /// Noise of samples, rad, root mean square.
    pub noise: Option<f64>,
}

/// A row of a file.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    /// Time, s.
    time: f64,
    /// θ, rad.
    angle: f64,
    /// θ̇, rad/s.
    rate: Option<f64>,
    /// θ̈, rad/s².
    acceleration: Option<f64>,
    /// Where it stands, e.g. `motion.csv: line 7`.
    place: String,
}

/// A file as read: rows at rising times.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionFile {
    name: String,
    rows: Vec<Row>,
    /// True if the hub moves from where it is to the first row, as with a trajectory whose first
    /// time is not 0.
    approaches: bool,
    /// True if the rows may be measured ones.
    may_be_samples: bool,
}

impl MotionFile {
    /// Reads a file: CSV if it ends in `.csv`, else a joint trajectory, JSON if it ends in `.json`
    /// and YAML otherwise.
    pub fn read(path: &Path, joint: Option<&str>) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|cause| {
            Error::file(path, format_args!("{cause}; it must be a motion: CSV, JSON or YAML"))
        })?;
        let name = path.display().to_string();
        let ends_in =
            |ending: &str| path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending));
        let file = if ends_in("csv") {
            if let Some(joint) = joint {
                return Err(Error::new(format_args!(
                    "--joint = {joint}: must be absent with a CSV, which has one joint"
                )));
            }
            let rows = csv::read(&name, &text)?;
            Self { name, rows, approaches: false, may_be_samples: true }
        } else {
            let rows = joint_trajectory::read(&name, &text, ends_in("json"), joint)?;
            let approaches = rows[0].time != 0.0;
            Self { name, rows, approaches, may_be_samples: false }
        };
        file.check()?;
        Ok(file)
    }

    /// Refuses numbers that are not finite and times that do not rise.
    fn check(&self) -> Result<(), Error> {
        let mut before: Option<f64> = None;
        for row in &self.rows {
            let refuse = |key: &str, value: f64, wanted: &str| {
                Err(Error::new(format_args!("{}: {key} = {value}: must be {wanted}", row.place)))
            };
            let keys = [
                ("time", Some(row.time)),
                ("angle", Some(row.angle)),
                ("rate", row.rate),
                ("acceleration", row.acceleration),
            ];
            for (key, value) in keys {
                if let Some(value) = value.filter(|value| !value.is_finite()) {
                    return refuse(self.column(key), value, "a finite number");
                }
            }
            let time = self.column("time");
            match before {
                Some(last) if row.time == last => {
                    return refuse(time, row.time, "later than the row before: two have one time");
                }
                Some(last) if row.time < last => {
                    let wanted = format!("later than {last}, the time of the row before");
                    return refuse(time, row.time, &wanted);
                }
                _ => before = Some(row.time),
            }
        }
        Ok(())
    }

    /// Returns a quantity's name in the file.
    fn column(&self, quantity: &str) -> &'static str {
        let csv = self.may_be_samples;
        match quantity {
            "time" if csv => csv::COLUMNS[0],
            "angle" if csv => csv::COLUMNS[1],
            "rate" if csv => csv::COLUMNS[2],
            "acceleration" if csv => csv::COLUMNS[3],
            "time" => "time_from_start",
            "angle" => "positions",
            "rate" => "velocities",
            _ => "accelerations",
        }
    }

    /// Returns the scene with this motion in place of its moves, and notes on how it was taken.
    /// `tick` is that of the run, s.
    pub fn command(
        &self,
        scene: SceneFile,
        options: &Options,
        tick: f64,
    ) -> Result<(SceneFile, Vec<String>), Error> {
        let measured = self.rows.len() > MANY && self.rows.iter().all(|row| row.rate.is_none());
        let taking = options.taking.unwrap_or(if self.may_be_samples && measured {
            Taking::Samples
        } else {
            Taking::Waypoints
        });
        let (from, path, notes) = match taking {
            Taking::Waypoints => self.waypoints(&scene, options)?,
            Taking::Samples => self.samples(&scene.arm, options, tick)?,
        };
        let moves = vec![Step { motion: Motion::Path(path), settle: 0.0 }];
        let (shortest, blended) = (Vec::new(), Vec::new());
        let scene = SceneFile { from, moves, shortest, blended, ..scene };
        scene.trajectory(tick)?;
        Ok((scene, notes))
    }

    fn waypoints(
        &self,
        scene: &SceneFile,
        options: &Options,
    ) -> Result<(f64, Waypoints, Vec<String>), Error> {
        if let Some(noise) = options.noise {
            return Err(Error::new(format_args!(
                "--noise = {noise}: must be absent with waypoints, which are passed as they are; \
                 --as samples takes the rows as measured"
            )));
        }
        let accelerates = self.rows.iter().any(|row| row.acceleration.is_some());
        let spline = match options.between {
            Some(Between::Quintic) => Spline::Quintic,
            None if accelerates => Spline::Quintic,
            Some(Between::Cubic) | None => Spline::Cubic,
        };
        let first = &self.rows[0];
        let (from, begin) = if self.approaches {
            (scene.from, 0.0)
        } else {
            if let Some(rate) = first.rate.filter(|rate| rate.abs() > NONE) {
                return Err(Error::new(format_args!(
                    "{}: {} = {rate}: must be 0, the run begins at rest",
                    first.place,
                    self.column("rate")
                )));
            }
            (first.angle, first.time)
        };
        let rows = &self.rows[usize::from(!self.approaches)..];
        if rows.is_empty() {
            return Err(Error::new(format_args!("{}: one row; must be two at least", self.name)));
        }
        let waypoint = |row: &Row| Waypoint {
            time: row.time - begin,
            angle: row.angle,
            rate: row.rate,
            acceleration: row.acceleration.filter(|_| spline == Spline::Quintic),
        };
        let places = rows.iter().map(|row| row.place.clone()).collect();
        let path =
            Waypoints::new(spline, rows.iter().map(waypoint).collect(), Places::File(places));
        let begin = first.acceleration.filter(|_| spline == Spline::Quintic && !self.approaches);
        let path = path.beginning_with(begin);
        let note = format!(
            "{}: {} rows in {} s, taken as waypoints with {spline} polynomials between them",
            self.name,
            self.rows.len(),
            shown(path.duration())
        );
        Ok((from, path, vec![note]))
    }

    fn samples(
        &self,
        arm: &Scene,
        options: &Options,
        tick: f64,
    ) -> Result<(f64, Waypoints, Vec<String>), Error> {
        if let Some(between) = options.between {
            let name =
                between.to_possible_value().map_or(String::new(), |v| v.get_name().to_owned());
            return Err(Error::new(format_args!(
                "--spline = {name}: must be absent with samples, whose motion is a cubic spline"
            )));
        }
        let begin = self.rows[0].time;
        let times: Vec<f64> = self.rows.iter().map(|row| row.time - begin).collect();
        let angles: Vec<f64> = self.rows.iter().map(|row| row.angle).collect();
        let fitted = samples::smoothed(&times, &angles, options.noise, tick)
            .map_err(|error| error.within(&self.name))?;
        let notes = self.notes(&fitted, options, torque(arm, tick, fitted.acceleration_error)?);
        let places = Places::Samples(Arc::from(self.name.as_str()));
        Ok((fitted.from, Waypoints::new(Spline::Cubic, fitted.rows, places), notes))
    }

    fn notes(&self, fitted: &samples::Smoothed, options: &Options, torque: f64) -> Vec<String> {
        let name = &self.name;
        let count = self.rows.len();
        let length = shown(self.rows[count - 1].time - self.rows[0].time);
        let unread = self.rows.iter().any(|row| row.rate.is_some() || row.acceleration.is_some());
        let unread = if unread { "; rates and accelerations are not read" } else { "" };
        let whose = if options.noise.is_some() { "as given" } else { "as the rows show" };
        vec![
            format!(
                "{name}: {count} rows in {length} s, taken as samples, knots {} s apart{unread}",
                shown(fitted.knot)
            ),
            format!(
                "{name}: noise {:.2e} rad ({whose}), no row farther than {:.2e} rad from the motion; \
                 standard deviation {:.2e} rad/s^2 of the acceleration, {torque:.2e} N m of a rigid \
                 arm\u{2019}s torque",
                fitted.noise, fitted.farthest, fitted.acceleration_error
            ),
        ]
    }
}

/// Returns the torque of an arm that does not bend, without gravity, for an acceleration, N m.
fn torque(arm: &Scene, tick: f64, acceleration: f64) -> Result<f64, Error> {
    let arm = Scene { gravity: 0.0, ..*arm };
    let rigid = Rigid::<f64>::new(&arm, tick)?;
    let hub = HubState { acceleration, ..HubState::at_rest(Angle::default()) };
    Ok(rigid.response::<AnyMotion>(&rigid.equilibrium(&hub), &hub).torque)
}

/// Rounds a time to a nanosecond.
fn shown(time: f64) -> f64 {
    (time * 1e9).round() / 1e9
}
