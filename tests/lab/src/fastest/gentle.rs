//! Moves with a piecewise-linear acceleration for arms known to a range, with a residual that may
//! be left, and in a given duration.

use std::f64::consts::PI;

use stillbeam::planner::{FastestMove, Objective, Planner, Request};
use stillbeam::{Limits, Profile, Scene};
use stillbeam_sim::error::Error;
use stillbeam_sim::plan::judge::{Judgement, Motion};
use stillbeam_sim::plan::shortest::{self, INTERVALS};
use stillbeam_sim::scenes;

use crate::markers::Block;
use crate::table::aligned;

/// Names of the blocks.
pub const NAMES: [&str; 3] = ["fastest-robust", "fastest-within", "gentlest"];

/// Ticks of a first period.
const TICKS: f64 = 1000.0;

/// The arms of the tables.
const ARMS: [(&str, &str); 2] = [("member A with 30 g", "a-tip30"), ("member D bare", "d-fast")];

/// An arm with a planner of short ticks.
struct Case {
    arm: Scene,
    period: f64,
    tick: f64,
}

impl Case {
    fn open(scene: &str) -> Result<Self, Error> {
        let arm = scenes::open(scene)?.arm;
        let period = Planner::<f64, 2>::new(&arm, 0.01)?.first_period();
        Ok(Self { arm, period, tick: period / TICKS })
    }

    fn judge(
        &self,
        motion: impl Into<stillbeam_sim::step::Motion>,
        error: f64,
    ) -> Result<Judgement, Error> {
        Motion::of(0.0, motion, self.tick).judge(&self.arm, error)
    }
}

/// Measures and writes the three tables.
pub fn blocks() -> Result<[Block; 3], Error> {
    let [robust, within, gentlest] = NAMES;
    Ok([
        Block::new(robust, of_robust()?),
        Block::new(within, of_within()?),
        Block::new(gentlest, of_gentlest()?),
    ])
}

/// Residual that may be left, of L, of the columns.
const RESIDUALS: [f64; 4] = [0.01, 0.03, 0.05, 0.1];

fn of_robust() -> Result<String, Error> {
    let case = Case::open("a-tip30")?;
    let mut header = vec!["frequency known to".to_owned()];
    header.extend(RESIDUALS.iter().map(|x| format!("at most {} %", 100.0 * x)));
    let mut lines = vec![header];
    for spread in [0.05, 0.1, 0.15, 0.2, 0.3] {
        let planner = Planner::<f64, 2>::robust(&case.arm, case.tick, spread)?;
        let mut line = vec![format!("\u{b1}{:.0} %", 100.0 * spread)];
        for residual in RESIDUALS {
            let duration = 2.0 * case.period;
            let acceleration = Some(9.0 * PI / (duration * duration));
            let limits = Limits { acceleration, ..Limits::default() };
            let request = Request::from_rest(0.0, PI).limits(limits).any_deflection();
            let found = planner.fastest::<INTERVALS>(&request.residual(residual))?;
            line.push(match found {
                Some(plan) => {
                    let mut most = 0.0_f64;
                    for look in -4..=4 {
                        let error = spread * f64::from(look) / 4.0;
                        most = most.max(case.judge(shortest::path(&plan), error)?.residual);
                    }
                    let periods = plan.duration() / case.period;
                    format!("{periods:.3} T\u{2081} ({:.2})", 100.0 * most)
                }
                None => "\u{2013}".into(),
            });
        }
        lines.push(line);
    }
    Ok(aligned(&lines))
}

fn of_within() -> Result<String, Error> {
    let allowed = [0.0, 5e-4, 2e-3, 0.01, 0.02, 0.05];
    let mut header = vec!["arm".to_owned(), "limits of an S-curve of".to_owned()];
    header.extend(allowed.iter().map(|x| format!("{} %", 100.0 * x)));
    let mut lines = vec![header];
    for (name, scene) in ARMS {
        let case = Case::open(scene)?;
        let planner = Planner::<f64, 2>::new(&case.arm, case.tick)?;
        for ratio in [1.0, 2.0, 3.0] {
            let peaks = Profile::SCurve.peaks(PI, ratio * case.period);
            let [rate, acceleration, jerk] = [peaks.rate, peaks.acceleration, peaks.jerk].map(Some);
            let limits = Limits { rate, acceleration, jerk, ..Limits::default() };
            let mut line = vec![name.to_owned(), format!("{ratio} T\u{2081}")];
            for residual in allowed {
                let request = Request::from_rest(0.0, PI).limits(limits).any_deflection();
                let found = planner.fastest::<INTERVALS>(&request.residual(residual))?;
                line.push(match found {
                    Some(plan) => {
                        let left = case.judge(shortest::path(&plan), 0.0)?.residual;
                        let periods = plan.duration() / case.period;
                        format!("{periods:.3} ({:.3})", 100.0 * left)
                    }
                    None => "\u{2013}".into(),
                });
            }
            lines.push(line);
        }
    }
    Ok(aligned(&lines))
}

/// Integral of the squared torque in the rod over a motion, (N m)² s.
fn effort(judged: &Judgement) -> f64 {
    let during = judged.samples.windows(2).take_while(|pair| pair[1].t <= judged.duration + 1e-9);
    during
        .map(|pair| {
            let [a, b] = [pair[0].torque, pair[1].torque];
            (pair[1].t - pair[0].t) * (a * a + a * b + b * b) / 3.0
        })
        .sum()
}

fn of_gentlest() -> Result<String, Error> {
    let mut lines = vec![
        ["arm", "duration", "motion", "rate", "acceleration", "torque", "effort", "residual"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for (name, scene) in ARMS {
        let case = Case::open(scene)?;
        let planner = Planner::<f64, 2>::new(&case.arm, case.tick)?;
        for ratio in [1.0, 1.5, 2.0, 3.0] {
            let duration = ratio * case.period;
            let request = Request::from_rest(0.0, PI).duration(duration).any_deflection();
            let still = planner.plan(&request)?;
            let easy = planner.gentlest::<INTERVALS>(&request.objective(Objective::Effort))?;
            let mut motions = vec![("still", Some(case.judge(still.motion(), 0.0)?))];
            let path = |plan: Option<FastestMove<INTERVALS>>| {
                plan.map(|plan| case.judge(shortest::path(&plan), 0.0)).transpose()
            };
            motions.push(("least peak", path(planner.gentlest(&request)?)?));
            motions.push(("least effort", path(easy)?));
            let unit = motions[0].1.as_ref().map_or(f64::NAN, effort);
            for (motion, judged) in motions {
                let Some(judged) = judged else { continue };
                lines.push(vec![
                    name.to_owned(),
                    format!("{ratio} T\u{2081}"),
                    motion.to_owned(),
                    format!("{:.2}", judged.rate * duration / PI),
                    format!("{:.2}", judged.acceleration * duration * duration / PI),
                    format!("{:.1}", 1e3 * judged.torque),
                    format!("{:.3}", effort(&judged) / unit),
                    format!("{:.3}", 100.0 * judged.residual),
                ]);
            }
        }
    }
    Ok(aligned(&lines))
}
