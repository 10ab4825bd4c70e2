//! Changes of mind as they come over the wire.

use stillbeam::axis::{Axis, Change as Motion};
use stillbeam::{Angle, Error, Stepper};
use stillbeam_protocol::Change;

/// Greatest rate of a target, rad/s.
const MAX_RATE: f64 = 1e6;

/// Changes an axis' motion. A few thousand instructions, with the tick masked.
///
/// # Errors
/// An angle or a rate that is no number or out of range, and those of [`Axis::change`]. Nothing has
/// changed then.
pub(crate) fn carry_out<S: Stepper<Scalar = f32>, const QUEUE: usize>(
    axis: &mut Axis<S, QUEUE>,
    change: &Change,
) -> Result<(), Error> {
    // One call for each: a program that makes one kind of change holds no code for the others.
    match *change {
        Change::Target { angle, rate, duration } => {
            let (min, max) = crate::HOME_RANGE;
            Error::check("target.angle", angle, min, max, "rad")?;
            Error::check("target.rate", rate, -MAX_RATE, MAX_RATE, "rad/s")?;
            let (angle, rate) = (Angle::from_radians(angle).cast(), rate as f32);
            axis.change(&Motion::Target { angle, rate, duration })
        }
        Change::Duration(duration) => axis.change(&Motion::Duration(duration)),
        Change::Hold => axis.change(&Motion::Hold),
        Change::Cancel => axis.change(&Motion::Cancel),
    }
}

#[cfg(test)]
mod tests {
    use stillbeam_protocol::{Command, Refusal};

    use super::*;
    use crate::axes::{CONFIGURATIONS, Joint};
    use crate::bench::{enabled, tick};

    fn change(joint: &mut Joint, change: Change) -> Result<(), Refusal<'static>> {
        joint.carry_out(&Command::Change(change))
    }

    #[test]
    fn a_target_is_met_with_its_rate() {
        let mut joint = enabled(&CONFIGURATIONS[0]);
        tick(&mut joint);
        let target = Change::Target { angle: 0.2, rate: 0.1, duration: 0.5 };
        assert_eq!(change(&mut joint, target), Ok(()));
        let last = (0..50).map(|_| tick(&mut joint)).last().expect("ticks");
        assert!((last.angle.radians() - 0.25).abs() < 1e-5, "{last:?}");
        assert!((last.rate - 0.1).abs() < 1e-5, "{last:?}");
        assert_eq!(change(&mut joint, Change::Hold), Ok(()));
        for _ in 0..200 {
            tick(&mut joint);
        }
        assert!(joint.axis.rests());
    }

    #[test]
    fn what_is_no_target_is_refused_and_changes_nothing() {
        let mut joint = enabled(&CONFIGURATIONS[0]);
        let before = tick(&mut joint);
        let of = |angle, rate| Change::Target { angle, rate, duration: 0.5 };
        let refused = [
            (of(f64::NAN, 0.0), "target.angle"),
            (of(f64::INFINITY, 0.0), "target.angle"),
            (of(0.1, f64::NAN), "target.rate"),
            (of(0.1, 1e300), "target.rate"),
            (of(900.0, 0.0), "target.angle"),
        ];
        for (target, name) in refused {
            let refusal = change(&mut joint, target).expect_err(name);
            let Refusal::Range { parameter, .. } = refusal else { panic!("{refusal:?}") };
            assert_eq!(parameter, name);
        }
        let fast = Change::Target { angle: 3.0, rate: 0.0, duration: 0.1 };
        let refusal = change(&mut joint, fast).expect_err("limits");
        assert!(matches!(refusal, Refusal::Range { parameter: "limits.rate", .. }), "{refusal:?}");
        assert!(change(&mut joint, Change::Duration(1.0)).is_err(), "no move is under way");
        assert_eq!(tick(&mut joint), before);
    }
}
