//! Refuses a planned move that the drive's frames cannot carry, before it is accepted.

use stillbeam::drive::{DemandPeaks, odrive};
use stillbeam::motor::Drivetrain;
use stillbeam::{Error, PlannedMove, Setpoint, UniformScene};

/// Refuses a move whose position, velocity or torque does not fit the drive's frame.
///
/// Position and velocity are those of the plan. The torque is that of the arm as if it were rigid,
/// at the move's greatest acceleration and in the worst place under gravity: what of it vibration
/// adds is only known tick by tick, and is counted as saturated if it does not fit.
///
/// # Errors
/// The value that does not fit, with the range.
pub(crate) fn admit(
    scene: &UniformScene,
    train: &Drivetrain<f32>,
    planned: &PlannedMove<f32>,
) -> Result<(), Error> {
    let summary = planned.summary();
    let inertia = scene.hub.inertia + scene.rigid_inertia();
    let weight = scene.in_plane_gravity() * scene.first_moment();
    let (rate, acceleration) = (summary.peaks.rate as f32, summary.peaks.acceleration as f32);
    let setpoint = Setpoint {
        angle: summary.end.angle.cast(),
        rate,
        acceleration,
        torque: inertia as f32 * acceleration + weight.abs() as f32,
        tip: [0.0; 2],
    };
    let mut peaks = DemandPeaks::default();
    peaks.note(&train.demand(&setpoint));
    odrive::RANGE.admit(&peaks)
}

#[cfg(test)]
mod tests {
    use stillbeam::{PlainMove, Profile};
    use stillbeam_protocol::Refusal;

    use crate::axes::{CONFIGURATIONS, Joint};
    use crate::bench::enabled;

    fn ask(joint: &mut Joint, duration: f64, to: f64) -> Result<u32, Refusal<'static>> {
        let motion = PlainMove::To { profile: Profile::Quintic, duration, to };
        let planned = joint.axis.plan_context()?.plan(&motion)?;
        Ok(joint.take(&planned)?)
    }

    /// A gear so high that the shaft turns faster than an ODrive's frame can say, within the hub's
    /// limits.
    #[test]
    fn a_velocity_that_the_frame_does_not_hold_is_refused_before_it_begins() {
        let mut configuration = CONFIGURATIONS[0];
        configuration.joint.ratio.motor = 100;
        let mut joint = enabled(&configuration);
        let refused = ask(&mut joint, 1.0, 1.25);
        let Err(Refusal::Range { parameter: "drive.velocity", value, max, .. }) = refused else {
            panic!("{refused:?}")
        };
        // A quintic's peak rate is 15/8 of its mean.
        let exact = 100.0 * 15.0 / 8.0 * 1.25 / core::f64::consts::TAU;
        assert!((value - exact).abs() < 1e-3 && (max - 32.767).abs() < 1e-5, "{value}, {max}");
        assert!(joint.axis.rests(), "nothing has begun");
        assert!(ask(&mut joint, 1.5, 1.25).is_ok());
    }

    /// A rotor so heavy that it alone takes more torque than the frame holds.
    #[test]
    fn a_torque_that_the_frame_does_not_hold_is_refused_before_it_begins() {
        let mut configuration = CONFIGURATIONS[1];
        configuration.joint.rotor_inertia = 2.0;
        let mut joint = enabled(&configuration);
        let refused = ask(&mut joint, 1.0, 3.0);
        let Err(Refusal::Range { parameter: "drive.torque", value, .. }) = refused else {
            panic!("{refused:?}")
        };
        // The rotor by the quintic's peak acceleration, 10/sqrt(3) of turn/T^2, and the arm's half
        // newton metre and friction beside it.
        let rotor = 2.0 * 5.773_503 * 3.0;
        assert!((rotor..rotor + 1.5).contains(&value), "{value}");
        assert!(ask(&mut joint, 2.0, 3.0).is_ok());
    }
}
