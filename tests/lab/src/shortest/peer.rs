//! Ruckig's answer to the same question.

use rsruckig::prelude::*;

use super::draw::Case;

/// Signs under which Ruckig is asked, as its limits belong to a sign of the acceleration: those of
/// a hub that turns forward, of one that turns backward, or the lower of both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turning {
    /// The rate is never negative.
    Forward,
    /// The rate is never positive.
    Backward,
    /// The rate changes its sign.
    Both,
}

/// Returns Ruckig's duration, s, or its refusal.
pub fn duration(case: &Case, turning: Turning) -> Result<f64, String> {
    let bounds = &case.bounds;
    let mut ruckig = Ruckig::<1, ThrowErrorHandler>::new(None, 0.01);
    let mut input = InputParameter::<1>::new(None);
    [input.current_velocity[0], input.current_acceleration[0]] = case.from;
    [input.target_velocity[0], input.target_acceleration[0]] = case.to;
    input.target_position[0] = case.distance;
    input.max_velocity[0] = bounds.rate;
    let least = bounds.acceleration.min(bounds.deceleration);
    let [highest, lowest] = match turning {
        Turning::Forward => [bounds.acceleration, bounds.deceleration],
        Turning::Backward => [bounds.deceleration, bounds.acceleration],
        Turning::Both => [least, least],
    };
    input.max_acceleration[0] = highest;
    input.min_acceleration = Some(DataArrayOrVec::new(None, -lowest));
    input.max_jerk[0] = bounds.jerk;
    let mut trajectory = Trajectory::<1>::new(None);
    ruckig.calculate(&input, &mut trajectory).map_err(|error| format!("{error:?}"))?;
    Ok(trajectory.get_duration())
}
