//! Arms that were set up on the desktop, one a payload: the target picks and sets nothing up.

use stillbeam::{Payload, UniformScene};
use stillbeam_protocol::Refusal;

/// The arm of an axis with one payload, as words of [`stillbeam::prepared`].
#[derive(Clone, Copy, Debug)]
pub struct PreparedArm {
    /// Payload of the arm.
    pub payload: Payload,
    /// Words of the method's stepper.
    pub stepper: &'static [u32],
    /// Words of the planner of still moves, none if it refuses the arm.
    pub planner: &'static [u32],
}

/// The arms of one axis.
#[derive(Clone, Copy, Debug)]
pub struct PreparedArms {
    /// Each arm, that of power-up first.
    pub arms: &'static [PreparedArm],
    /// Payloads of these in words, for a refusal.
    pub payloads: &'static str,
}

impl PreparedArms {
    /// Returns the arm that carries `payload`, all of whose numbers have to be those of the table.
    ///
    /// # Errors
    /// No arm was prepared with it. The refusal names the first number that no arm has which
    /// agrees so far, and the payloads that were prepared.
    pub fn pick(&self, payload: &Payload) -> Result<&'static PreparedArm, Refusal<'static>> {
        let numbers = |of: &Payload| {
            [
                ("payload.mass", of.mass, "kg"),
                ("payload.inertia", of.inertia, "kg m^2"),
                ("payload.offset", of.offset, "m"),
            ]
        };
        let mut agreeing = 0;
        for arm in self.arms {
            let pairs = numbers(&arm.payload).into_iter().zip(numbers(payload));
            let agrees = pairs.take_while(|((_, has, _), (_, asked, _))| has == asked).count();
            if agrees == numbers(payload).len() {
                return Ok(arm);
            }
            agreeing = agreeing.max(agrees);
        }
        let (parameter, value, unit) = numbers(payload)[agreeing];
        Err(Refusal::NotPrepared { parameter, value, unit, prepared: self.payloads })
    }

    /// Returns the words of the planner of a scene's still moves.
    ///
    /// # Errors
    /// Those of [`Self::pick`]; no planner took the arm when it was prepared.
    pub fn planner(&self, scene: &UniformScene) -> Result<&'static [u32], Refusal<'static>> {
        match self.pick(&scene.payload)?.planner {
            [] => Err(Refusal::NoPlanner),
            words => Ok(words),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axes::CONFIGURATIONS;

    const fn arm(mass: f64, inertia: f64, planner: &'static [u32]) -> PreparedArm {
        PreparedArm { payload: Payload { mass, inertia, offset: 0.0 }, stepper: &[], planner }
    }

    static ARMS: PreparedArms = PreparedArms {
        arms: &[arm(0.03, 0.0, &[1]), arm(0.05, 0.0, &[2]), arm(0.05, 1e-4, &[])],
        payloads: "0.03 kg, 0.05 kg, 0.05 kg with 0.0001 kg m^2",
    };

    /// The number that is refused and its unit.
    fn refused(mass: f64, inertia: f64, offset: f64) -> (&'static str, &'static str) {
        match ARMS.pick(&Payload { mass, inertia, offset }) {
            Err(Refusal::NotPrepared { parameter, value, unit, prepared }) => {
                let given = [mass, inertia, offset].map(f64::to_bits);
                assert!(given.contains(&value.to_bits()), "{value}");
                assert_eq!(prepared, ARMS.payloads);
                (parameter, unit)
            }
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_payload_of_the_table_is_picked_by_all_of_its_numbers() {
        for arm in ARMS.arms {
            let picked = ARMS.pick(&arm.payload).expect("it is in the table");
            assert_eq!(picked.payload, arm.payload);
        }
    }

    #[test]
    fn another_payload_is_refused_by_the_number_that_none_has() {
        assert_eq!(refused(0.04, 0.0, 0.0), ("payload.mass", "kg"));
        assert_eq!(refused(f64::NAN, 0.0, 0.0), ("payload.mass", "kg"));
        assert_eq!(refused(0.05, 0.2, 0.0), ("payload.inertia", "kg m^2"));
        assert_eq!(refused(0.03, 1e-4, 0.0), ("payload.inertia", "kg m^2"));
        assert_eq!(refused(0.05, 1e-4, 0.01), ("payload.offset", "m"));
    }

    #[test]
    fn an_arm_that_no_planner_takes_has_none() {
        let planner = |payload| ARMS.planner(&UniformScene { payload, ..CONFIGURATIONS[0].scene });
        assert_eq!(planner(ARMS.arms[1].payload), Ok(&[2][..]));
        assert_eq!(planner(ARMS.arms[2].payload), Err(Refusal::NoPlanner));
    }
}
