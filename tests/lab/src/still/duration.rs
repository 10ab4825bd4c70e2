//! Durations of motions under the same limits.

use rsruckig::prelude::*;
use stillbeam::planner::{Planner, Request};
use stillbeam::{Limits, Profile, Scene};

use stillbeam_sim::error::Error;

/// Durations of a turn from rest to rest within the same limits, s.
#[derive(Clone, Copy, Debug)]
pub struct Durations {
    /// The limits.
    pub limits: Limits,
    /// Duration of the profile whose peaks are the limits.
    pub profile: f64,
    /// Duration of the time-optimal motion of a rigid arm; `None` without a limit of jerk.
    pub rigid: Option<f64>,
    /// Duration of the still move.
    pub still: f64,
}

/// Computes the durations under the limits that `profile` needs to turn by `to` rad in `duration`
/// s.
pub fn durations(
    arm: &Scene,
    profile: Profile,
    to: f64,
    duration: f64,
    tick: f64,
) -> Result<Durations, Error> {
    let peaks = profile.peaks(to, duration);
    // The rate limits nothing where only the acceleration is to be equal.
    let smooth = peaks.jerk.is_finite();
    let limits = Limits {
        rate: smooth.then_some(peaks.rate),
        acceleration: Some(peaks.acceleration),
        jerk: smooth.then_some(peaks.jerk),
        ..Limits::default()
    };
    let planner = Planner::<f32, 2>::new(arm, tick)?;
    let still = planner.plan(&Request::from_rest(0.0, to).limits(limits))?;
    let rigid = match limits {
        Limits { rate: Some(rate), acceleration: Some(acceleration), jerk: Some(jerk), .. } => {
            Some(time_optimal(to, rate, acceleration, jerk)?)
        }
        _ => None,
    };
    Ok(Durations { limits, profile: duration, rigid, still: still.duration() })
}

/// Returns the duration of the shortest rest-to-rest motion of one rigid axis, by Ruckig.
fn time_optimal(to: f64, rate: f64, acceleration: f64, jerk: f64) -> Result<f64, Error> {
    let mut ruckig = Ruckig::<1, ThrowErrorHandler>::new(None, 0.01);
    let mut input = InputParameter::<1>::new(None);
    input.target_position[0] = to;
    input.max_velocity[0] = rate;
    input.max_acceleration[0] = acceleration;
    input.max_jerk[0] = jerk;
    let mut trajectory = Trajectory::<1>::new(None);
    ruckig
        .calculate(&input, &mut trajectory)
        .map_err(|error| Error::new(format_args!("ruckig: {error:?}")))?;
    Ok(trajectory.get_duration())
}
