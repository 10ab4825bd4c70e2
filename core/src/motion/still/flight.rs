//! An arm flown through a move in its exact kinematics.

use core::f64::consts::TAU;

use super::effort::Oscillation;
use crate::Error;
use crate::beam::Rod;
use crate::math::{Scalar, sqrt};
use crate::motion::{Hub, Segment};
use crate::stepper::{Elastica, ElasticaState, Quality, Stepper};

/// One arm that a move is planned for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arm<T, const K: usize> {
    pub stepper: Elastica<T, K>,
    pub oscillation: Oscillation<T>,
    omega: f64,
    /// `ψ(L)`, and it over ω.
    slope: [T; 2],
}

impl<T: Scalar, const K: usize> Arm<T, K> {
    pub fn new(rod: &Rod<K>, tick: f64, bend: f64) -> Result<Self, Error> {
        let damping = rod.scene().damping;
        let omega = rod.frequency()[0];
        let decay = 0.5 * (damping.alpha + damping.beta * omega * omega);
        let damped = sqrt((omega * omega - decay * decay).max(0.01 * omega * omega));
        let slope = rod.tip_slope()[0];
        let coupling = rod.kinetics(&[0.0; K]).coupling[0];
        let f = T::from_f64;
        Ok(Self {
            stepper: Elastica::new(rod, tick, Quality::Fine, bend)?,
            oscillation: Oscillation {
                decay,
                damped,
                ratio: [f(decay / damped), f(omega / damped)],
                gain: f(slope * coupling / omega),
                alpha: f(damping.alpha),
            },
            omega,
            slope: [f(slope), f(slope / omega)],
        })
    }

    pub fn first_period(&self) -> f64 {
        TAU / self.omega
    }

    /// Angle of the tip by the first mode after half of a move from rest, rad.
    pub fn in_the_middle(&self, curve: &Segment<T>, ticks: u32) -> T {
        let (state, _) = self.fly(curve, ticks / 2, None);
        self.slope[0] * state.coordinate[0]
    }

    /// `ψ (a − a_static)` and `ψ p/ω` of the first mode after the move, rad.
    pub fn at_the_end(
        &self,
        curve: &Segment<T>,
        ticks: u32,
        from: Option<&ElasticaState<T, K>>,
    ) -> [T; 2] {
        let (state, hub) = self.fly(curve, ticks, from);
        let rest = self.stepper.equilibrium(&hub);
        [
            self.slope[0] * (state.coordinate[0] - rest.coordinate[0]),
            self.slope[1] * state.momentum[0],
        ]
    }

    fn fly(
        &self,
        curve: &Segment<T>,
        ticks: u32,
        from: Option<&ElasticaState<T, K>>,
    ) -> (ElasticaState<T, K>, Hub<T>) {
        let mut hub = curve.hub(0);
        let mut state = match from {
            Some(state) => *state,
            None => self.stepper.equilibrium(&hub),
        };
        for k in 1..=ticks {
            let after = curve.hub(k);
            self.stepper.step(&mut state, &hub, &after);
            hub = after;
        }
        (state, hub)
    }
}
