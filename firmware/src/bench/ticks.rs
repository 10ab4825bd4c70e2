//! Every method through two moves and a rest, with all terms and with the terms left out that a
//! scene need not have.

use core::fmt::Write;
use core::hint::black_box;

use stillbeam::motion::{Limits, Plan};
use stillbeam::{Error, Generator, Hub, HubState, Move, Payload, Profile, Stepper, UniformScene};

use stillbeam_golden::methods::{Method, Visitor, visit_own};
use stillbeam_golden::paths::PATHS;

use crate::scenes::{FULL, LEAN, NONE, TICK};
use crate::stopwatch::{Counter, Stopwatch};
use crate::tick::tick;

/// First hub angle, rad.
const FROM: f64 = -0.3;

/// Scenes by what they lack. The last two show that payload and hub radius change no operation.
const SCENES: [(&str, UniformScene); 6] = [
    ("", FULL),
    ("no-gravity", UniformScene { gravity: 0.0, ..FULL }),
    ("no-damping", UniformScene { damping: NONE, ..FULL }),
    (NEITHER, LEAN),
    ("no-damping no-gravity no-payload", UniformScene { payload: NOTHING, ..LEAN }),
    (
        "no-damping no-gravity no-radius",
        UniformScene { hub: Hub { radius: 0.0, inertia: 1e-4, stiffness: None }, ..LEAN },
    ),
];
const NEITHER: &str = "no-damping no-gravity";
const NOTHING: Payload = Payload { mass: 0.0, inertia: 0.0, offset: 0.0 };

const fn to(profile: Profile, duration: f64, to: f64) -> Move {
    Move::To { profile, duration, to }
}

/// Any bulge: what it costs does not depend on its size.
const fn still(duration: f64, to: f64) -> Move {
    Move::Still { duration, to, bulge: [0.01, 0.1, 0.02, -0.1, 0.01, 0.05] }
}

/// The table's run: an S-curve, which is seven cubics, a cubic, and a rest. Both cross quarters of
/// a turn, and bend the scenes' arm less than elastica is set up for.
const MOVES: [Move; 2] = [to(Profile::SCurve, 1.6, 3.0), to(Profile::Cubic, 1.5, -1.4)];

/// The other motions, which cost the same with every method: counted with the cheapest. A
/// trapezoid is three cubics.
const MOTIONS: [(&str, &[Move]); 4] = [
    ("quintic", &[to(Profile::Quintic, 1.0, 3.0), to(Profile::Quintic, 0.7, -1.4)]),
    ("cycloid", &[to(Profile::Cycloid, 1.0, 3.0), to(Profile::Cycloid, 0.7, -1.4)]),
    ("still", &[still(1.0, 3.0), still(0.7, -1.4)]),
    ("spin-up", &[Move::SpinUp { duration: 1.0, rate: 3.0 }]),
];

/// Prints the table's lines.
pub fn print<C: Counter>(watch: &Stopwatch<C>, output: &mut impl Write) {
    let mut bench = Bench { watch, output };
    visit_own(&mut bench);
}

struct Bench<'a, C, W> {
    watch: &'a Stopwatch<C>,
    output: &'a mut W,
}

impl<C: Counter, W: Write> Visitor for Bench<'_, C, W> {
    fn visit<M: Method>(&mut self) {
        // Without an FPU two of the scenes: a tick takes twenty times as long there.
        let counted = |name| cfg!(target_abi = "eabihf") || ["", NEITHER].contains(&name);
        for (name, scene) in SCENES.iter().filter(|(name, s)| counted(*name) && M::fits(s)) {
            self.rows::<M>(M::QUALITY, &[M::SKIP, name], scene, &MOVES);
        }
        if M::METHOD == "rigid" {
            for (motion, moves) in &MOTIONS {
                self.rows::<M>(motion, &[NEITHER], &LEAN, moves);
            }
        }
    }
}

impl<C: Counter, W: Write> Bench<'_, C, W> {
    #[inline(never)]
    fn rows<M: Method>(
        &mut self,
        quality: &str,
        skip: &[&str],
        scene: &UniformScene,
        moves: &[Move],
    ) {
        let (arm, setup) = self.watch.count(|| set_up::<M>(black_box(scene)));
        let mut arm = arm.expect("the bench's scenes are accepted");
        let (first, planning) = self.watch.count(|| arm.push(&moves[0]));
        first.expect("the bench's moves are accepted");
        for motion in &moves[1..] {
            arm.push(motion).expect("the bench's moves are accepted");
        }
        let run = Run::of(moves);
        let mut counts = [Extremes::NONE; PATHS.len()];
        for k in 0..=run.ticks + 50 {
            let asleep = arm.is_asleep();
            let (still, count) = self.count(&mut arm);
            counts[if asleep { ASLEEP } else { run.path(k, still) }].take(count);
        }
        // In equilibrium from the first tick, which takes up the hold, and awake in the second.
        let mut arm = set_up::<M>(scene).expect("accepted above");
        for _ in 0..20 {
            let asleep = arm.is_asleep();
            let (_, count) = self.count(&mut arm);
            if asleep {
                counts[ASLEEP].take(count);
            }
        }
        for (path, count) in PATHS.iter().zip(counts).filter(|(_, count)| *count != Extremes::NONE)
        {
            write!(self.output, "tick,{},{},{},{quality},", M::ID, M::METHOD, M::SIZE)
                .expect("the host takes the lines");
            let words = skip.iter().chain([&path.words]).filter(|word| !word.is_empty());
            for (i, word) in words.enumerate() {
                let gap = if i == 0 { "" } else { " " };
                write!(self.output, "{gap}{word}").expect("the host takes the lines");
            }
            writeln!(self.output, ",{},{},{}", count.least, count.worst, setup + planning)
                .expect("the host takes the lines");
        }
    }
}

impl<C: Counter, W: Write> Bench<'_, C, W> {
    /// One tick: whether the hub stands still after it, and what it took. Apart, so that what
    /// surrounds the call is the same for all.
    #[inline(never)]
    fn count<S: Stepper<Scalar = f32>>(&self, arm: &mut Generator<S, 16>) -> (bool, u32) {
        let (setpoint, count) = self.watch.count(|| tick(black_box(arm)));
        (setpoint.rate == 0.0, count)
    }
}

#[inline(never)]
fn set_up<M: Method>(scene: &UniformScene) -> Result<Generator<M::Stepper, 16>, Error> {
    Generator::new(M::stepper(scene, TICK)?, FROM)
}

/// Index in [`PATHS`] of the last one.
const ASLEEP: usize = PATHS.len() - 1;

/// At which ticks a segment ends.
#[derive(Default)]
struct Run {
    ends: [u32; 16],
    segments: usize,
    ticks: u32,
}

impl Run {
    fn of(moves: &[Move]) -> Self {
        let mut run = Self::default();
        let mut start = HubState::resting_at(FROM).expect("the bench's moves are accepted");
        for motion in moves {
            let plan = Plan::new(motion, start, &Limits::default(), TICK);
            let plan = plan.expect("the bench's moves are accepted");
            for segment in &plan.segments {
                run.ticks += segment.count();
                run.ends[run.segments] = run.ticks;
                run.segments += 1;
            }
            start = plan.summary.end;
        }
        run
    }

    /// Index in [`PATHS`] of tick `k` of an arm that is awake.
    fn path(&self, k: u32, still: bool) -> usize {
        let still = usize::from(still);
        match k {
            _ if k > self.ticks => 5 + still,
            _ if k == self.ticks => 3 + still,
            _ if k == 0 || self.ends[..self.segments].contains(&k) => 1 + still,
            _ => 0,
        }
    }
}

/// Least and worst count.
#[derive(Clone, Copy, PartialEq)]
struct Extremes {
    least: u32,
    worst: u32,
}

impl Extremes {
    const NONE: Self = Self { least: u32::MAX, worst: 0 };

    fn take(&mut self, count: u32) {
        self.least = self.least.min(count);
        self.worst = self.worst.max(count);
    }
}
