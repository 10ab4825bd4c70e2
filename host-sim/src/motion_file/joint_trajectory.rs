//! A `trajectory_msgs/JointTrajectory` of ROS 2, alone or in a goal of `FollowJointTrajectory`.

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::Row;
use crate::error::Error;

/// A goal, or the trajectory itself. Fields that tell nothing of the motion are not read.
#[derive(Deserialize)]
struct Message {
    joint_names: Option<Vec<String>>,
    points: Option<Vec<Point>>,
    trajectory: Option<Box<Self>>,
    goal: Option<Box<Self>>,
}

#[derive(Deserialize)]
struct Point {
    positions: Vec<f64>,
    #[serde(default)]
    velocities: Vec<f64>,
    #[serde(default)]
    accelerations: Vec<f64>,
    time_from_start: Duration,
}

/// `builtin_interfaces/Duration`, or that of ROS 1.
#[derive(Deserialize)]
struct Duration {
    #[serde(alias = "secs")]
    sec: i64,
    #[serde(alias = "nsecs", default)]
    nanosec: i64,
}

/// Reads the rows of a joint. If the trajectory has several, `joint` must name one.
pub(super) fn read(
    name: &str,
    text: &str,
    json: bool,
    joint: Option<&str>,
) -> Result<Vec<Row>, Error> {
    let mut message: Message = if json { from_json(name, text)? } else { from_yaml(name, text)? };
    while let Some(inner) = message.goal.take().or(message.trajectory.take()) {
        message = *inner;
    }
    let absent = |key: &str| Error::new(format_args!("{name}: {key}: missing; {WANTED}"));
    let names = message.joint_names.ok_or_else(|| absent("joint_names"))?;
    let points = message.points.ok_or_else(|| absent("points"))?;
    let column = column(name, &names, joint)?;
    let rows = points.iter().enumerate();
    let rows: Vec<Row> =
        rows.map(|(k, point)| row(name, k, point, column)).collect::<Result<_, _>>()?;
    if rows.is_empty() {
        return Err(Error::new(format_args!("{name}: points: none; must be one at least")));
    }
    Ok(rows)
}

/// Returns the index of the joint.
fn column(name: &str, names: &[String], joint: Option<&str>) -> Result<usize, Error> {
    let all = || names.join(", ");
    match (joint, names) {
        (None, [_]) => Ok(0),
        (None, _) => Err(Error::new(format_args!(
            "{name}: joint_names: {} joints; --joint must name one of {}",
            names.len(),
            all()
        ))),
        (Some(joint), names) => names.iter().position(|found| found == joint).ok_or_else(|| {
            Error::new(format_args!("--joint = {joint}: must be one of {}, as in {name}", all()))
        }),
    }
}

fn row(name: &str, k: usize, point: &Point, column: usize) -> Result<Row, Error> {
    let place = format!("{name}: points[{k}]");
    let value = |key: &str, list: &[f64]| match list.get(column) {
        Some(value) => Ok(*value),
        None => Err(Error::new(format_args!(
            "{place}: {key}: {} numbers; must be one for each joint, {} at least",
            list.len(),
            column + 1
        ))),
    };
    let optional = |key: &str, list: &[f64]| {
        if list.is_empty() { Ok(None) } else { value(key, list).map(Some) }
    };
    let Duration { sec, nanosec } = point.time_from_start;
    let time = sec as f64 + 1e-9 * nanosec as f64;
    if !(0.0..=1e9).contains(&time) {
        return Err(Error::new(format_args!(
            "{place}: time_from_start = {time} s: must be 0 or later"
        )));
    }
    Ok(Row {
        time,
        angle: value("positions", &point.positions)?,
        rate: optional("velocities", &point.velocities)?,
        acceleration: optional("accelerations", &point.accelerations)?,
        place: place.clone(),
    })
}

/// Requirement named where a file cannot be read.
const WANTED: &str = "must be a trajectory_msgs/JointTrajectory with joint_names and points, each \
                      with positions and time_from_start { sec, nanosec }";

fn from_json<T: DeserializeOwned>(name: &str, text: &str) -> Result<T, Error> {
    let mut json = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(&mut json).map_err(|error| {
        let path = error.path().to_string();
        let place = if path == "." { String::new() } else { format!("{path}: ") };
        Error::new(format_args!("{name}: {place}{}; {WANTED}", error.inner()))
    })
}

fn from_yaml<T: DeserializeOwned>(name: &str, text: &str) -> Result<T, Error> {
    // `ros2 topic echo` ends every message with a line of its own.
    let text = text.trim_end();
    let text = text.strip_suffix("---").unwrap_or(text);
    let options = serde_saphyr::options! { budget: None, with_snippet: false };
    serde_saphyr::from_str_with_options(text, options).map_err(|error| {
        let place = error
            .location()
            .map_or(String::new(), |at| format!("line {}, column {}: ", at.line(), at.column()));
        Error::new(format_args!("{name}: {place}{}; {WANTED}", error.without_snippet()))
    })
}
