//! Runs steppers beside the exact rod along the motion that they are meant for.

use core::ops::ControlFlow;

use super::candidate::{Candidate, Tick};
use super::exact::{Exact, Load, Shape};
use super::ladder::{Assessment, Outcome};
use super::peak::Peak;
use super::ringing::Ringing;
use crate::Error;
use crate::hub::HubState;
use crate::model::Rod;
use crate::motion::{Commanded, Kink, Stretch};
use crate::scene::Scene;
use crate::stepper::Stepper;

/// Longest rest after the motion, ticks.
const MAX_SETTLE: f64 = 2000.0;

/// Modes of the exact rod, of as many polynomials. Where the motion jumps, what five leave out is a
/// tenth of a tolerance of 1e-3; six leave a tenth of that.
pub(super) const MODES: usize = 6;

/// Part of a tick within which a time counts as whole.
const NEAR: f64 = 1e-6;

/// Ticks beside a jump of the commanded acceleration within which the torque is not compared.
const BESIDE: f64 = 1.5;

/// Change of the commanded acceleration, of its peak, from which on it is a jump: a hundred times
/// what an f32 rounds it by.
const JUMP: f64 = 1e-4;

/// Ticks between two looks at whether the arm has come to rest.
const LOOK: u64 = 16;

/// Arm and motion on which steppers are tried.
pub(super) struct Trial<'a> {
    exact: Exact<f32, MODES>,
    /// At rest.
    ringing: Ringing<MODES>,
    motion: &'a dyn Commanded,
    /// Rest after the motion, ticks.
    settle: f64,
    /// L, m.
    length: f64,
}

/// A flight under way.
struct Flight<'t, 'a, 'c, S: Stepper> {
    trial: &'t Trial<'a>,
    candidates: &'c mut [Candidate<S>],
    /// Distance from the exact rod beyond which a candidate is given up, fraction of L.
    most: f64,
    shape: Option<Shape<f32, MODES>>,
    /// The coming tick.
    next: u64,
    /// The hub at the latest tick, just after; and where the stretch has ended.
    before: HubState<f32>,
    landing: Option<HubState<f32>>,
    /// A stretch began between the latest tick and the coming one.
    broken: bool,
    /// The arm and the hub rest, until the stretch ends.
    still: bool,
    /// Tick up to which torques are not compared.
    blocked: f64,
    steps: u32,
    deflection: f64,
    /// Largest torque at a tick, N m.
    at_ticks: f64,
    ringing: Ringing<MODES>,
    torque: Peak,
    moment: Peak,
}

impl<'a> Trial<'a> {
    /// With a rest of one first period after the motion; ticks of `tick` s.
    pub fn new(scene: &Scene, tick: f64, motion: &'a dyn Commanded) -> Result<Self, Error> {
        let rod = Rod::<MODES>::of_polynomials::<MODES>(scene)?;
        let period = core::f64::consts::TAU / rod.frequency()[0];
        let settle = libm::ceil(period / tick).clamp(1.0, MAX_SETTLE);
        let exact = Exact::new(&rod, tick, motion.ticks() as f64 + settle);
        let ringing = Ringing::new(&rod, tick, exact.steps_a_tick());
        Ok(Self { exact, ringing, motion, settle, length: scene.link.length })
    }

    /// A stepper to be tried.
    pub fn candidate<S: Stepper>(&self, stepper: S) -> Result<Candidate<S>, Error> {
        let mut first = HubState::ZERO;
        self.motion.fly(&mut |stretch| {
            first = HubState { rate: 0.0, acceleration: 0.0, ..(stretch.hub)(stretch.begin) };
            ControlFlow::Break(())
        })?;
        Candidate::new(stepper, self.motion, &first)
    }

    /// Tries them all at once: the exact rod, which is what a trial costs, flies once. Ends early
    /// when none of them is within `most` of L. `progress` is given the part that is done.
    pub fn fly<S: Stepper>(
        &self,
        candidates: &mut [Candidate<S>],
        most: f64,
        progress: &mut dyn FnMut(f64),
    ) -> Result<impl Fn(&Candidate<S>) -> Assessment + use<S>, Error> {
        let mut flight = Flight {
            trial: self,
            candidates,
            most,
            shape: None,
            next: 0,
            before: HubState::ZERO,
            landing: None,
            broken: false,
            still: false,
            blocked: 0.0,
            steps: 0,
            deflection: 0.0,
            at_ticks: 0.0,
            ringing: self.ringing,
            torque: Peak::default(),
            moment: Peak::default(),
        };
        let mut gone = false;
        let all = self.motion.ticks() as f64 + self.settle;
        let mut each = |stretch: &Stretch<'_>| {
            let flown = flight.along(stretch, all, progress);
            gone |= flown.is_break();
            flown
        };
        self.motion.fly(&mut each)?;
        if !gone {
            flight.rest(all, progress);
        }
        for candidate in flight.candidates.iter_mut() {
            candidate.finish();
        }
        let Flight { steps, deflection, at_ticks, torque, moment, .. } = flight;
        Ok(move |candidate: &Candidate<S>| {
            let Candidate { distance, torque: apart, .. } = *candidate;
            let outcome = Outcome { distance, deflection, torque: apart, peak: at_ticks };
            let (peak_torque, peak_moment) = (torque.most(), moment.most());
            Assessment {
                tip: outcome.tip(),
                torque: outcome.torque(),
                peak_torque,
                peak_moment,
                steps,
            }
        })
    }
}

impl<S: Stepper> Flight<'_, '_, '_, S> {
    /// Flies along one stretch.
    fn along(
        &mut self,
        stretch: &Stretch<'_>,
        all: f64,
        progress: &mut dyn FnMut(f64),
    ) -> ControlFlow<()> {
        let first = (stretch.hub)(stretch.begin);
        if self.shape.is_none() {
            self.shape = Some(self.trial.exact.equilibrium(&first));
            self.landing = Some(HubState { rate: 0.0, acceleration: 0.0, ..first });
        }
        self.still = false;
        self.enter(stretch.begin, &first);
        if is_tick(stretch.begin, self.next) {
            let arrival = self.landing.unwrap_or(first);
            self.answer(&arrival, &first);
        } else {
            self.broken = true;
        }
        let mut at = stretch.begin;
        while (self.next as f64) < stretch.end - NEAR {
            let tick = self.next as f64;
            self.advance(stretch, at, tick);
            at = tick;
            let hub = (stretch.hub)(tick);
            self.answer(&hub, &hub);
            if !self.candidates.iter().any(|candidate| candidate.follows(self.most)) {
                return ControlFlow::Break(());
            }
            progress(tick / all);
        }
        self.advance(stretch, at, stretch.end);
        self.landing = Some((stretch.hub)(stretch.end));
        ControlFlow::Continue(())
    }

    /// Goes on as the motion has ended, for a first period.
    fn rest(&mut self, all: f64, progress: &mut dyn FnMut(f64)) {
        let Some(end) = self.landing else { return };
        let begin = self.trial.motion.ticks() as f64;
        let held = HubState { acceleration: 0.0, ..end };
        let turned = held.rate * self.trial.exact.tick() / core::f32::consts::TAU;
        let hub = |ticks: f64| {
            let mut hub = held;
            if turned != 0.0 {
                hub.angle = held.angle.plus(turned * (ticks - begin) as f32);
                hub.update_sin_cos(0.0);
            }
            hub
        };
        let stretch =
            Stretch { begin, end: begin + self.trial.settle, hub: &hub, rests: held.rate == 0.0 };
        if self.along(&stretch, all, progress).is_continue() {
            let last = hub(stretch.end);
            self.answer(&last, &last);
        }
    }

    /// Takes note of how the acceleration jumps where a stretch begins.
    fn enter(&mut self, begin: f64, first: &HubState<f32>) {
        let Some(landing) = self.landing else { return };
        let jump = f64::from(first.acceleration - landing.acceleration).abs();
        if jump <= JUMP * self.trial.motion.peaks().acceleration {
            return;
        }
        self.ringing.jump(jump);
        self.blocked = begin + BESIDE;
        // The latest tick is nearer than a tick, the one before it nearer than two.
        let both = begin - (self.next as f64 - 2.0) < BESIDE - NEAR;
        for candidate in self.candidates.iter_mut() {
            candidate.forget(both);
        }
        if let Some(shape) = &self.shape {
            let (_, before) = self.trial.exact.answer(shape, &landing);
            self.torque.see(f64::from(before.torque));
            self.moment.see(f64::from(before.moment));
        }
        self.torque.jump();
        self.moment.jump();
    }

    fn advance(&mut self, stretch: &Stretch<'_>, begin: f64, end: f64) {
        let Some(shape) = &mut self.shape else { return };
        let exact = &self.trial.exact;
        if stretch.rests && !self.still && self.next.is_multiple_of(LOOK) {
            self.still = exact.is_still(shape, &(stretch.hub)(begin));
        }
        if self.still {
            return;
        }
        let (torque, moment) = (&mut self.torque, &mut self.moment);
        self.steps += exact.advance(shape, stretch.hub, begin, end, &mut |load| {
            torque.see(f64::from(load.torque));
            moment.see(f64::from(load.moment));
        });
    }

    /// Compares at the coming tick.
    fn answer(&mut self, arrival: &HubState<f32>, after: &HubState<f32>) {
        let Some(shape) = &self.shape else { return };
        let (tip, Load { torque, .. }) = self.trial.exact.answer(shape, after);
        self.deflection = self.deflection.max(f64::from(tip[1]).abs() / self.trial.length);
        self.at_ticks = self.at_ticks.max(f64::from(torque).abs());
        let motion = self.trial.motion;
        let kinked = self.broken && self.next > 0 && motion.moves().is_none();
        let tick = Tick {
            number: self.next,
            before: self.before,
            arrival: *arrival,
            after: *after,
            kink: if kinked { motion.kink(self.next - 1) } else { Kink::NONE },
        };
        let compared = self.next as f64 >= self.blocked - NEAR;
        let unseen = self.ringing.unseen();
        for candidate in self.candidates.iter_mut().filter(|one| one.follows(self.most)) {
            if let Some(response) = candidate.tick(motion, &tick) {
                candidate.watch(&response, tip, torque, unseen, self.trial.length);
                if !compared {
                    candidate.forget(false);
                }
            }
        }
        self.ringing.tick();
        self.before = *after;
        self.broken = false;
        self.next += 1;
    }
}

/// True if that time is the tick of that number.
fn is_tick(time: f64, number: u64) -> bool {
    (time - number as f64).abs() < NEAR
}
