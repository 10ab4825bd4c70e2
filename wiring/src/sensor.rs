//! Sensors on the arms.

use stillbeam::Angle;

/// Sensors of a board, one an axis at most, read in the tick. A board's file implements it with
/// its converter.
pub trait Sensor {
    /// Name of the column in a log. Its ending is the unit, as `identify` reads it:
    /// `tip_deflection_m`, `tip_acceleration_m_s2`, `strain_v`.
    const COLUMN: &'static str;

    /// Number of axes with a sensor, the first ones.
    const AXES: usize;

    /// Reads the sensor of an axis, in the column's unit.
    ///
    /// `time` is that since the recording's first tick, µs modulo 2³², and `hub` the hub's angle.
    /// A converter needs neither.
    fn read(&mut self, axis: usize, time: u32, hub: Angle<f32>) -> f32;
}
