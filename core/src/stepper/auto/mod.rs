//! The cheapest stepper that is good enough, chosen once for an arm and its moves.

mod exact;
mod ladder;
mod trial;

pub use ladder::{Choice, Rung};

use super::{Elastica, ElasticaState, Modal, ModalState, Response, Rigid, Stepper, check_tick};
use crate::beam::{EightElements, Rod};
use crate::math::Scalar;
use crate::motion::{Hub, Limits, Move, Peaks, Plan, Start};
use crate::{Error, Scene};
use trial::Trial;

/// One of the steppers of [`Rung::ladder`], known at run time only.
///
/// It takes the room of the largest; a firmware that knows its arm links the stepper itself.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)] // The steppers' own names.
#[allow(clippy::large_enum_variant)] // There is no heap to put one on.
pub enum Auto<T> {
    Rigid(Rigid<T>),
    Modal1(Modal<T, 1>),
    Modal2(Modal<T, 2>),
    Modal3(Modal<T, 3>),
    Elastica1(Elastica<T, 1>),
    Elastica2(Elastica<T, 2>),
    Elastica3(Elastica<T, 3>),
}

/// The state of [`Auto`]: of the same variant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
#[allow(clippy::large_enum_variant)]
pub enum AutoState<T> {
    Rigid(()),
    Modal1(ModalState<T, 1>),
    Modal2(ModalState<T, 2>),
    Modal3(ModalState<T, 3>),
    Elastica1(ElasticaState<T, 1>),
    Elastica2(ElasticaState<T, 2>),
    Elastica3(ElasticaState<T, 3>),
}

/// `$body` for the stepper of whatever variant.
macro_rules! each {
    ($auto:expr, $stepper:ident => $body:expr) => {
        match $auto {
            Auto::Rigid($stepper) => $body,
            Auto::Modal1($stepper) => $body,
            Auto::Modal2($stepper) => $body,
            Auto::Modal3($stepper) => $body,
            Auto::Elastica1($stepper) => $body,
            Auto::Elastica2($stepper) => $body,
            Auto::Elastica3($stepper) => $body,
        }
    };
}

/// `$body` for the stepper and its state; `$otherwise` for a state of another stepper.
macro_rules! each_with_state {
    ($auto:expr, $state:expr, ($stepper:ident, $own:ident) => $body:expr, $otherwise:expr) => {
        match ($auto, $state) {
            (Auto::Rigid($stepper), AutoState::Rigid($own)) => $body,
            (Auto::Modal1($stepper), AutoState::Modal1($own)) => $body,
            (Auto::Modal2($stepper), AutoState::Modal2($own)) => $body,
            (Auto::Modal3($stepper), AutoState::Modal3($own)) => $body,
            (Auto::Elastica1($stepper), AutoState::Elastica1($own)) => $body,
            (Auto::Elastica2($stepper), AutoState::Elastica2($own)) => $body,
            (Auto::Elastica3($stepper), AutoState::Elastica3($own)) => $body,
            _ => $otherwise,
        }
    };
}

impl<T: Scalar> Auto<T> {
    /// The response to a state of another stepper.
    const NOTHING: Response<T> = Response { torque: T::ZERO, tip: [T::ZERO; 2] };

    /// Sets up one rung; `bend` as in [`Elastica::new`], other rungs have no use for it.
    pub fn new(scene: &Scene, tick: f64, rung: Rung, bend: f64) -> Result<Self, Error> {
        let model = || EightElements::consistent(scene);
        Ok(match rung {
            Rung::Rigid => Self::Rigid(Rigid::new(scene, tick)?),
            Rung::Modal(1) => Self::Modal1(Modal::new(&model()?, tick)?),
            Rung::Modal(2) => Self::Modal2(Modal::new(&model()?, tick)?),
            Rung::Modal(_) => Self::Modal3(Modal::new(&model()?, tick)?),
            Rung::Elastica(1, quality) => {
                Self::Elastica1(Elastica::new(&Rod::new(scene)?, tick, quality, bend)?)
            }
            Rung::Elastica(2, quality) => {
                Self::Elastica2(Elastica::new(&Rod::new(scene)?, tick, quality, bend)?)
            }
            Rung::Elastica(_, quality) => {
                Self::Elastica3(Elastica::new(&Rod::new(scene)?, tick, quality, bend)?)
            }
        })
    }

    /// The cheapest rung whose tip stays within `tolerance`, a fraction of the link's length, of
    /// where the real one is, over these moves from rest at `from` rad and one first period after
    /// them; with the error to expect.
    ///
    /// Every rung is tried, cheapest first, on the moves themselves, beside the exact rod in six
    /// modes and small steps; a rung that is further off than the tolerance is given up at once. What
    /// that costs at set-up stands in `docs/auto.md`.
    ///
    /// # Errors
    /// No rung is good enough: [`Error::Tolerance`] with the error of the finest; or the finest cannot
    /// be set up for these moves, and why.
    pub fn choose(
        scene: &Scene,
        tick: f64,
        from: f64,
        moves: &[Move],
        tolerance: f64,
    ) -> Result<(Self, Choice), Error> {
        let tick = check_tick(tick)?;
        let tolerance = Error::check("solver.tolerance", tolerance, 1e-6, 1.0, "of the length")?;
        let expected_bend = expected_bend(scene, tick, from, moves)?;
        let (least, most) = Elastica::<f32, 3>::BEND;
        let bend = expected_bend.clamp(least, most);
        let trial = Trial::new(scene, tick, from, moves)?;
        let mut steps = 0;
        let mut attempt = |rung: Rung| {
            if rung.is_elastica() && expected_bend > most {
                return Err(Error::BendsTooFar { bend: expected_bend, max: most });
            }
            // The last is tried to the end, to tell its error.
            let stop = if rung == Rung::FINEST { f64::INFINITY } else { tolerance };
            let outcome = trial.run(Auto::<f32>::new(scene, tick, rung, bend)?, stop)?;
            steps += outcome.steps;
            Ok(Choice { rung, error: ladder::expected(&outcome), bend, steps })
        };
        let mut reason = Error::Tolerance { tolerance, best: f64::INFINITY };
        for rung in Rung::ladder(scene) {
            match attempt(rung) {
                Ok(choice) if choice.error <= tolerance => {
                    return Ok((Self::new(scene, tick, rung, bend)?, choice));
                }
                Ok(choice) => reason = Error::Tolerance { tolerance, best: choice.error },
                // The moves are planned and the scene is valid: it is the rung that cannot do it.
                Err(error) => reason = error,
            }
        }
        Err(reason)
    }
}

/// The largest tip angle to expect of the moves, rad.
fn expected_bend(scene: &Scene, tick: f64, from: f64, moves: &[Move]) -> Result<f64, Error> {
    let mut start = Start::at_rest(from)?;
    let mut acceleration: f64 = 0.0;
    for motion in moves {
        let outline = Plan::new(motion, start, &Limits::default(), tick)?.outline;
        acceleration = acceleration.max(outline.peaks.acceleration);
        start = outline.end;
    }
    Ok(Rod::<1>::new(scene)?.bend(acceleration))
}

impl<T: Scalar> Stepper for Auto<T> {
    type Scalar = T;
    type State = AutoState<T>;

    // Every rung has both, so that each ticks on the paths that it takes when it is linked itself.
    const PLAIN: bool = every_rung_is(
        true,
        [
            Rigid::<T>::PLAIN,
            Modal::<T, 1>::PLAIN,
            Modal::<T, 2>::PLAIN,
            Modal::<T, 3>::PLAIN,
            Elastica::<T, 1>::PLAIN,
            Elastica::<T, 2>::PLAIN,
            Elastica::<T, 3>::PLAIN,
        ],
    );
    const RESTS: bool = every_rung_is(
        true,
        [
            Rigid::<T>::RESTS,
            Modal::<T, 1>::RESTS,
            Modal::<T, 2>::RESTS,
            Modal::<T, 3>::RESTS,
            Elastica::<T, 1>::RESTS,
            Elastica::<T, 2>::RESTS,
            Elastica::<T, 3>::RESTS,
        ],
    );

    fn tick(&self) -> f64 {
        each!(self, s => s.tick())
    }

    #[inline(always)]
    fn is_directed(&self) -> bool {
        each!(self, s => s.is_directed())
    }

    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
        each!(self, s => s.admit(peaks, held))
    }

    fn equilibrium(&self, hub: &Hub<T>) -> AutoState<T> {
        match self {
            Auto::Rigid(_) => AutoState::Rigid(()),
            Auto::Modal1(s) => AutoState::Modal1(s.equilibrium(hub)),
            Auto::Modal2(s) => AutoState::Modal2(s.equilibrium(hub)),
            Auto::Modal3(s) => AutoState::Modal3(s.equilibrium(hub)),
            Auto::Elastica1(s) => AutoState::Elastica1(s.equilibrium(hub)),
            Auto::Elastica2(s) => AutoState::Elastica2(s.equilibrium(hub)),
            Auto::Elastica3(s) => AutoState::Elastica3(s.equilibrium(hub)),
        }
    }

    #[inline(always)]
    fn step(&self, state: &mut AutoState<T>, before: &Hub<T>, after: &Hub<T>) {
        each_with_state!(self, state, (s, own) => s.step(own, before, after), ());
    }

    #[inline(always)]
    fn is_plain(&self, rate: T) -> bool {
        each!(self, s => s.is_plain(rate))
    }

    #[inline(always)]
    fn advance_in_cubic(
        &self,
        state: &mut AutoState<T>,
        before: &Hub<T>,
        after: &Hub<T>,
    ) -> Response<T> {
        each_with_state!(
            self, state,
            (s, own) => s.advance_in_cubic(own, before, after),
            Self::NOTHING
        )
    }

    #[inline(always)]
    fn swing(&self, state: &mut AutoState<T>, hub: &Hub<T>) {
        each_with_state!(self, state, (s, own) => s.swing(own, hub), ());
    }

    #[inline(always)]
    fn response_at_rest(&self, state: &AutoState<T>, hub: &Hub<T>) -> Response<T> {
        each_with_state!(self, state, (s, own) => s.response_at_rest(own, hub), Self::NOTHING)
    }

    fn shift(&self, state: &mut AutoState<T>, moment: T) {
        each_with_state!(self, state, (s, own) => s.shift(own, moment), ());
    }

    #[inline(always)]
    fn is_settled(&self, state: &AutoState<T>) -> bool {
        each_with_state!(self, state, (s, own) => s.is_settled(own), false)
    }

    #[inline(always)]
    fn response(&self, state: &AutoState<T>, hub: &Hub<T>) -> Response<T> {
        each_with_state!(self, state, (s, own) => s.response(own, hub), Self::NOTHING)
    }
}

/// `value`, which every rung must have: one that differed would tick otherwise than when it is linked.
const fn every_rung_is(value: bool, rungs: [bool; 7]) -> bool {
    let mut k = 0;
    while k < rungs.len() {
        assert!(rungs[k] == value, "the rungs differ");
        k += 1;
    }
    value
}
