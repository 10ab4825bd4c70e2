//! The cheapest stepper that is good enough, chosen once for an arm and its moves.

mod candidate;
mod choose;
mod exact;
mod ladder;
mod on_carrier;
mod peak;
mod ringing;
mod trial;

use choose::choose_for_moves;
pub use choose::{NoChoice, assess, choose};
pub use ladder::{Assessment, Choice, Rung, Tolerance};

use crate::hub::{GravityDirection, HubState};
use crate::math::Scalar;
use crate::model::{EightElements, Rod};
use crate::motion::{Move, Peaks};
use crate::prepared::Prepare;
use crate::stepper::{
    Elastica, ElasticaState, FastPaths, HubMotion, KinkMoments, Modal, ModalState, Response, Rigid,
    Stepper,
};
use crate::{Error, Scene};

/// One of the steppers of [`Rung::ladder`], known at run time only.
///
/// Its size is that of the largest; a firmware that knows its arm links the stepper itself.
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

    /// Sets up the cheapest rung whose tip and torque stay within `tolerance` of the real ones,
    /// over these moves from rest at `from` rad and one first period after them: see [`choose`]. On
    /// a carrier that turns, [`OnCarrier`](crate::stepper::OnCarrier) has the same.
    ///
    /// # Errors
    /// [`Error::Tolerance`] with the error of the finest rung if none is good enough, or why the
    /// finest cannot be set up for these moves.
    pub fn choose(
        scene: &Scene,
        tick: f64,
        from: f64,
        moves: &[Move],
        tolerance: &Tolerance,
    ) -> Result<(Self, Choice), Error> {
        scene.check_no_carrier()?;
        let choice = choose_for_moves(scene, tick, from, moves, tolerance)?;
        Ok((Self::chosen(scene, tick, &choice)?, choice))
    }

    /// Sets up what was chosen.
    pub fn chosen(scene: &Scene, tick: f64, choice: &Choice) -> Result<Self, Error> {
        Self::new(scene, tick, choice.rung, choice.bend)
    }
}

impl<T: Scalar> Stepper for Auto<T> {
    type Scalar = T;
    type State = AutoState<T>;

    // The same for every rung, so that each ticks on the paths that it takes when it is linked
    // itself.
    const FAST: FastPaths = every_rung_has(
        FastPaths::BOTH,
        [
            Rigid::<T>::FAST,
            Modal::<T, 1>::FAST,
            Modal::<T, 2>::FAST,
            Modal::<T, 3>::FAST,
            Elastica::<T, 1>::FAST,
            Elastica::<T, 2>::FAST,
            Elastica::<T, 3>::FAST,
        ],
    );

    fn tick(&self) -> f64 {
        each!(self, s => s.tick())
    }

    #[inline(always)]
    fn gravity(&self) -> &GravityDirection<T> {
        each!(self, s => s.gravity())
    }

    fn admit(&self, peaks: &Peaks, held: f64) -> Result<(), Error> {
        each!(self, s => s.admit(peaks, held))
    }

    fn equilibrium(&self, hub: &HubState<T>) -> AutoState<T> {
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
    fn is_linear_fast(&self, rate: T) -> bool {
        each!(self, s => s.is_linear_fast(rate))
    }

    #[inline(always)]
    fn step<M: HubMotion>(
        &self,
        state: &mut AutoState<T>,
        before: &HubState<T>,
        after: &HubState<T>,
    ) {
        each_with_state!(self, state, (s, own) => s.step::<M>(own, before, after), ());
    }

    #[inline(always)]
    fn response<M: HubMotion>(&self, state: &AutoState<T>, hub: &HubState<T>) -> Response<T> {
        each_with_state!(self, state, (s, own) => s.response::<M>(own, hub), Self::NOTHING)
    }

    fn tip_angle(&self, state: &AutoState<T>) -> T {
        each_with_state!(self, state, (s, own) => s.tip_angle(own), T::ZERO)
    }

    #[inline(always)]
    fn kink(&self, state: &mut AutoState<T>, moments: KinkMoments<'_, T>) {
        each_with_state!(self, state, (s, own) => s.kink(own, moments), ());
    }

    #[inline(always)]
    fn is_settled(&self, state: &AutoState<T>) -> bool {
        each_with_state!(self, state, (s, own) => s.is_settled(own), false)
    }
}

/// The words of the stepper itself, which a program loads by its own type.
impl<T: Scalar> Prepare for Auto<T> {
    fn kind(&self) -> [u32; 3] {
        each!(self, s => s.kind())
    }

    fn period(&self) -> f64 {
        self.tick()
    }

    fn put_own(&self, sink: &mut dyn FnMut(u32)) {
        each!(self, s => s.put_own(sink));
    }
}

/// Returns `paths`, which every rung must have: one that differed would tick otherwise than when it
/// is linked.
const fn every_rung_has(paths: FastPaths, rungs: [FastPaths; 7]) -> FastPaths {
    let mut k = 0;
    while k < rungs.len() {
        let rung = rungs[k];
        assert!(rung.linear == paths.linear && rung.at_rest == paths.at_rest, "the rungs differ");
        k += 1;
    }
    paths
}
