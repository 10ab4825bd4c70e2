//! A setpoint in the precision of its tick, known at run time only.

use stillbeam::{AxisKind, Setpoint};

/// A setpoint in the precision of its tick. What is computed from it is computed in that precision,
/// as on the target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnySetpoint {
    /// As on the target.
    F32(Setpoint<f32>),
    /// In double precision.
    F64(Setpoint<f64>),
}

/// A precision of the tick.
pub trait Scalar: stillbeam::Scalar + Send + Sync + 'static {
    /// Returns a setpoint of this precision.
    fn any(setpoint: Setpoint<Self>) -> AnySetpoint;
}

impl Scalar for f32 {
    fn any(setpoint: Setpoint<f32>) -> AnySetpoint {
        AnySetpoint::F32(setpoint)
    }
}

impl Scalar for f64 {
    fn any(setpoint: Setpoint<f64>) -> AnySetpoint {
        AnySetpoint::F64(setpoint)
    }
}

impl AnySetpoint {
    /// Returns the same numbers in double precision.
    pub fn precise(&self) -> Setpoint<f64> {
        match self {
            Self::F32(setpoint) => precise(setpoint),
            Self::F64(setpoint) => *setpoint,
        }
    }

    /// Returns the tip in the global frame `(x, y)`, m, on an axis of that kind.
    pub fn global_tip_on(&self, axis: AxisKind) -> [f64; 2] {
        match self {
            Self::F32(setpoint) => setpoint.global_tip_on(axis).map(f64::from),
            Self::F64(setpoint) => setpoint.global_tip_on(axis),
        }
    }

    /// Returns the payload's centre in the global frame `(x, y)`, m, `offset` m beyond the tip.
    /// `tip_angle` (rad) is that of the same tick: see [`AnyGenerator::tip_angle`].
    ///
    /// [`AnyGenerator::tip_angle`]: crate::AnyGenerator::tip_angle
    pub fn global_payload_on(&self, axis: AxisKind, offset: f64, tip_angle: f64) -> [f64; 2] {
        match self {
            Self::F32(setpoint) => {
                payload(setpoint, axis, offset as f32, tip_angle as f32).map(f64::from)
            }
            Self::F64(setpoint) => payload(setpoint, axis, offset, tip_angle),
        }
    }
}

fn precise<T: stillbeam::Scalar>(setpoint: &Setpoint<T>) -> Setpoint<f64> {
    Setpoint {
        angle: setpoint.angle.precise(),
        rate: setpoint.rate.to_f64(),
        acceleration: setpoint.acceleration.to_f64(),
        torque: setpoint.torque.to_f64(),
        tip: setpoint.tip.map(|x| x.to_f64()),
    }
}

fn payload<T: stillbeam::Scalar>(
    setpoint: &Setpoint<T>,
    axis: AxisKind,
    offset: T,
    tip_angle: T,
) -> [T; 2] {
    let tip = setpoint.payload_centre(offset, tip_angle);
    Setpoint { tip, ..*setpoint }.global_tip_on(axis)
}
