//! How good the choices of `auto` are: random arms and moves, every rung of the ladder judged by
//! the reference rod. Writes `docs/auto.md`.
//!
//! ```sh
//! cargo run --release -p stillbeam-sim --example auto_choice -- 10000 docs/auto.md
//! ```

use std::fmt::Write as _;
use std::path::PathBuf;

use indicatif::{ParallelProgressIterator, ProgressBar, ProgressStyle};
use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use rayon::prelude::*;
use stillbeam::motion::Limits;
use stillbeam::stepper::{Auto, Rung};
use stillbeam::{Damping, Error, Generator, Link, Move, Profile, Scene};
use stillbeam_sim::reference::{Sample, rod};
use stillbeam_sim::trajectory::Trajectory;

const SEED: u64 = 20_261_122;
const TICK: f64 = 0.01;

/// An arm, a move and what is asked of it.
struct Case {
    arm: Scene,
    motion: Move,
    period: f64,
    tolerance: f64,
}

/// What came of it.
enum Verdict {
    /// The move would bend the arm beyond what elastica is made for.
    BendsTooFar,
    /// No choice was offered although a rung was good enough, or rightly so.
    Refused {
        needlessly: bool,
    },
    Chosen {
        exceeds: bool,
        rungs_too_dear: usize,
    },
}

impl Case {
    fn random(index: u64) -> Self {
        let mut rng = StdRng::seed_from_u64(SEED ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let log = |rng: &mut StdRng, from: f64, to: f64| {
            from * (to / from).powf(rng.random_range(0.0..1.0))
        };
        let (mass, length): (f64, f64) = (0.1, rng.random_range(0.2..1.2));
        let period = log(&mut rng, 0.1, 2.0);
        let payload: f64 =
            if rng.random_bool(0.3) { 0.0 } else { rng.random_range(0.0f64..2.0).powi(2) };
        let omega = std::f64::consts::TAU / period;
        // Of a massless cantilever with the link's effective mass at its tip.
        let stiffness = omega * omega * mass * (0.2427 + payload) * length.powi(3) / 3.0;
        let mut arm = Scene::new(Link { length, mass, bending_stiffness: stiffness });
        arm.payload.mass = payload * mass;
        if rng.random_bool(0.5) {
            arm.hub.radius = rng.random_range(0.0..0.5) * length;
        }
        if rng.random_bool(0.3) {
            arm.gravity = 9.81;
        }
        if rng.random_bool(0.3) {
            let beta = rng.random_range(0.0..0.02) / omega;
            arm.damping = Damping { alpha: rng.random_range(0.0..0.5), beta };
        }
        let duration = (log(&mut rng, 0.7, 6.0) * period).max(0.05);
        let profile = Profile::ALL[rng.random_range(0..Profile::ALL.len())];
        let motion = Move::To { profile, duration, to: rng.random_range(-3.1..3.1) };
        Self { arm, motion, period, tolerance: log(&mut rng, 2e-4, 5e-2) }
    }

    fn judge(&self) -> Result<Verdict, Box<dyn std::error::Error + Send + Sync>> {
        let moves = [self.motion];
        let choice = match Auto::<f32>::choose(&self.arm, TICK, 0.0, &moves, self.tolerance) {
            Ok((_, choice)) => Some(choice),
            Err(Error::Tolerance { .. }) => None,
            Err(Error::BendsTooFar { .. } | Error::Buckles { .. }) => {
                return Ok(Verdict::BendsTooFar);
            }
            Err(error) => return Err(error.to_string().into()),
        };
        let run = [self.motion, Move::Dwell { duration: self.period }];
        let trajectory = Trajectory::plan(0.0, &run, &Limits::default(), TICK)?;
        let times: Vec<f64> = (0..=trajectory.ticks()).map(|k| k as f64 * TICK).collect();
        let options = rod::Options { order: 5, tolerance: 1e-8, ..rod::Options::default() };
        let truth = rod::solve(&self.arm, &trajectory, &times, &options)?;
        // Set up as the choice was; for a refusal as generously as there is.
        let bend = choice.map_or(2.0, |choice| choice.bend);
        let mut good = [false; Rung::LADDER.len()];
        for (rung, good) in Rung::LADDER.into_iter().zip(&mut good) {
            *good = tip_error(&self.arm, &run, rung, bend, &truth)? <= self.tolerance;
        }
        let cheapest = good.iter().position(|&good| good);
        let Some(choice) = choice else {
            return Ok(Verdict::Refused { needlessly: cheapest.is_some() });
        };
        let chosen = Rung::LADDER.iter().position(|&rung| rung == choice.rung).unwrap_or(0);
        let rungs_too_dear = chosen.saturating_sub(cheapest.unwrap_or(chosen));
        Ok(Verdict::Chosen { exceeds: !good[chosen], rungs_too_dear })
    }
}

/// Largest distance of the tip from the truth, fraction of L.
fn tip_error(
    arm: &Scene,
    run: &[Move],
    rung: Rung,
    bend: f64,
    truth: &[Sample],
) -> Result<f64, Error> {
    let mut generator = Generator::<_, 14>::new(Auto::<f32>::new(arm, TICK, rung, bend)?, 0.0)?;
    for motion in run {
        generator.push(motion)?;
    }
    let distance = |sample: &Sample| {
        let [x, y] = generator.tick().global_tip();
        (f64::from(x) - sample.tip[0]).hypot(f64::from(y) - sample.tip[1])
    };
    Ok(truth.iter().map(distance).fold(0.0, f64::max) / arm.link.length)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: u64 = arguments.next().unwrap_or_else(|| "200".into()).parse()?;
    let page = arguments.next().map(PathBuf::from);
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} arms, {eta} to go")?;
    let bar = ProgressBar::new(count).with_style(style);
    let verdicts: Vec<_> = (0..count)
        .into_par_iter()
        .progress_with(bar)
        .map(|index| Case::random(index).judge().map_err(|e| format!("arm {index}: {e}")))
        .collect::<Result<_, _>>()?;

    let of = |wanted: &dyn Fn(&Verdict) -> bool| verdicts.iter().filter(|v| wanted(v)).count();
    let bends = of(&|v| matches!(v, Verdict::BendsTooFar));
    let refused = of(&|v| matches!(v, Verdict::Refused { .. }));
    let needless = of(&|v| matches!(v, Verdict::Refused { needlessly: true }));
    let exceeded = of(&|v| matches!(v, Verdict::Chosen { exceeds: true, .. }));
    let mut text = format!(
        "# How good the choices of `auto` are\n\n\
         {count} random arms and moves, seed {SEED}, written by `cargo run --release -p stillbeam-sim \
         --example auto_choice -- {count} docs/auto.md`, where the distribution stands. Every rung is \
         judged by the reference rod.\n\n| what came out | arms |\n| --- | ---: |\n\
         | refused: bends too far for any rung | {bends} |\n\
         | refused: no rung was expected to be good enough | {refused} |\n\
         | … of which one would have been | {needless} |\n"
    );
    for dear in 0..Rung::LADDER.len() {
        let n =
            of(&|v| matches!(v, Verdict::Chosen { rungs_too_dear, .. } if *rungs_too_dear == dear));
        if n > 0 {
            writeln!(
                text,
                "| chosen, {dear} rungs above the cheapest that was good enough | {n} |"
            )?;
        }
    }
    writeln!(text, "| … of all chosen, true error above the tolerance | {exceeded} |")?;
    print!("{text}");
    if let Some(page) = page {
        stillbeam_sim::output::write_whole(&page, |file| file.write_all(text.as_bytes()))?;
    }
    Ok(())
}
