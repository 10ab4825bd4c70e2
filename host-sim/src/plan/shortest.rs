//! The fastest moves as paths, and the bound that they are held against.

use std::path::Path;

use stillbeam::motion::Spline;
use stillbeam::motion::optimal::{Bounds, TimeOptimal};
use stillbeam::planner::{FastestMove, ShortestMove};
use stillbeam::{Angle, HubState, Limits};

use crate::error::Error;
use crate::output::Files;
use crate::step::Motion;
use crate::waypoints::{Places, Waypoints};

/// Intervals of the acceleration in half a move. A target plans with half as many.
pub const INTERVALS: usize = 24;

/// Returns the motion of a plan.
pub fn motion<const N: usize>(plan: &ShortestMove<N>) -> Motion {
    match plan {
        ShortestMove::Still(still) => still.motion().into(),
        ShortestMove::Fastest(fastest) => path(fastest),
    }
}

/// Returns the path of a fastest move.
pub fn path<const N: usize>(fastest: &FastestMove<N>) -> Motion {
    let rows = fastest.waypoints().collect();
    Motion::Path(Waypoints::new(Spline::Cubic, rows, Places::Samples("plan".into())))
}

/// Returns the shortest time of a hub without an arm within the limits of rate, acceleration,
/// deceleration and jerk, s: no motion within them is shorter. `None` without a limit of
/// acceleration or jerk.
pub fn rigid_bound(turn: f64, limits: &Limits, tick: f64) -> Option<f64> {
    let bounds = Bounds::new(&limits.kinematic(), tick).ok()?;
    let [start, end] = [0.0, turn].map(|at| HubState::at_rest(Angle::from_radians(at)));
    Some(TimeOptimal::reach(&start, &end, &bounds).ok()?.duration())
}

/// Adds the rows of a fastest move as a motion file, which `run` and `export` read and any target
/// follows as a cubic path.
pub fn add_rows<const N: usize>(
    files: &mut Files,
    path: &Path,
    fastest: &FastestMove<N>,
) -> Result<(), Error> {
    let mut text = format!("t_s,hub_angle_rad,hub_rate_rad_s\n0,{},0\n", fastest.from);
    for row in fastest.waypoints() {
        // In full precision: rounded, the acceleration would jump from piece to piece.
        text += &format!("{},{},{}\n", row.time, row.angle, row.rate.unwrap_or(0.0));
    }
    files.add(path, |file| file.write_all(text.as_bytes()))?;
    Ok(())
}
