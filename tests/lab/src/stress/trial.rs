//! Runs one method on one scene, in f64 and in f32.

use std::panic::{AssertUnwindSafe, catch_unwind};

use stillbeam::{Move, Setpoint};

use super::draw::Drawn;
use super::growth::grows;
use stillbeam_sim::dispatch;
use stillbeam_sim::error::Error;
use stillbeam_sim::run::each_tick;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Scalar, Solver};

/// Least scale of compared deflections, fraction of L. They are compared relative to the peak, but
/// at least to this: a thousand times the swing at which an arm is let sleep.
pub const FLOOR: f64 = 1000.0 * stillbeam::stepper::SLEEP;

/// Relative change of EI by which a run's condition is measured, in f64.
const NUDGE: f64 = 1e-8;

/// Verdict on a run.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The run was not accepted, for this reason with its numbers left out.
    Refused(String),
    /// The program panicked with this message.
    Panicked(String),
    /// The run reached its end.
    Ran(Run),
}

/// A run in both precisions, and once more of an arm that is a little stiffer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// First tick with a field that is not finite, or an angle's part outside ±½ turn, f64 and f32.
    pub broken: [Option<u64>; 2],
    /// Distance from the last move's target, rad, f32.
    pub off_target: f64,
    /// Largest deflection, over L, f64.
    pub peak: f64,
    /// Largest difference of deflections, over their peak, see [`FLOOR`].
    pub deflection: f64,
    /// Largest difference of torques, over their peak.
    pub torque: f64,
    /// Condition of the deflection: its relative change divided by a relative change of EI, at
    /// least 1. A vibration of N rad has ½N and more. A resonance or a step that feeds the arm has
    /// any.
    pub condition: f64,
    /// True if the arm swings up during the last rest, by its own physics or by the method's, or if
    /// that of elastica deflects by more than its length. Such runs are not compared.
    pub rings_up: bool,
    /// Ticks.
    pub ticks: u64,
    /// Peak rate of the hub, rad/s.
    pub rate: f64,
}

/// Runs one solver of a scene.
pub fn trial(drawn: &Drawn, solver: &Solver) -> Verdict {
    let run = AssertUnwindSafe(|| both(drawn, solver));
    match catch_unwind(run) {
        Ok(Ok(run)) => Verdict::Ran(run),
        Ok(Err(error)) => Verdict::Refused(reason(&error.to_string())),
        Err(payload) => {
            let text = payload.downcast_ref::<String>().map(String::as_str);
            let text = text.or(payload.downcast_ref::<&str>().copied()).unwrap_or("?");
            Verdict::Panicked(reason(text))
        }
    }
}

/// Fields of a setpoint that are kept.
#[derive(Clone, Copy)]
struct Sample {
    deflection: f64,
    torque: f64,
}

#[derive(Default)]
struct Record {
    samples: Vec<Sample>,
    broken: Option<u64>,
    angle: f64,
    rate: f64,
}

impl Record {
    fn of(scene: &SceneFile, solver: &Solver) -> Result<Self, Error> {
        let mut record = Self::default();
        each_tick(&*dispatch::stepper(scene, solver)?, scene, |generator, k, _| {
            record.take(k, &generator.tick().precise());
        })?;
        Ok(record)
    }

    fn take(&mut self, k: u64, setpoint: &Setpoint<f64>) {
        if self.broken.is_none() && !is_sound(setpoint) {
            self.broken = Some(k);
        }
        let (deflection, torque) = (setpoint.deflection(), setpoint.torque);
        self.samples.push(Sample { deflection, torque });
        self.angle = setpoint.angle.radians();
        self.rate = self.rate.max(setpoint.rate.abs());
    }
}

fn is_sound(s: &Setpoint<f64>) -> bool {
    let all = [s.angle.part, s.rate, s.acceleration, s.torque, s.tip[0], s.tip[1]];
    all.iter().all(|x| x.is_finite()) && s.angle.part.abs() <= 0.5
}

fn both(drawn: &Drawn, solver: &Solver) -> Result<Run, Error> {
    let scene = &drawn.scene;
    let run = |scene: &SceneFile, scalar| Record::of(scene, &Solver { scalar, ..*solver });
    let (double, single) = (run(scene, Scalar::F64)?, run(scene, Scalar::F32)?);
    let mut stiffer = scene.clone();
    stiffer.arm.link.bending_stiffness *= 1.0 + NUDGE;
    // At the edge of what is accepted it may be refused: then it says nothing.
    let nudged = run(&stiffer, Scalar::F64).ok();
    let length = scene.arm.link.length;
    let most = |of: &dyn Fn(&Sample) -> f64| {
        double.samples.iter().map(|sample| of(sample).abs()).fold(0.0, f64::max)
    };
    let apart = |other: &[Sample], of: &dyn Fn(&Sample) -> f64| {
        let pairs = double.samples.iter().zip(other);
        // f64::max would drop what is no number.
        pairs.map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, |most: f64, apart| {
            if apart.is_nan() { f64::INFINITY } else { most.max(apart) }
        })
    };
    let (peak, torque) = (most(&|s| s.deflection), most(&|s| s.torque));
    let target = scene.moves.last().and_then(|step| match step.motion.as_move() {
        Some(Move::To { to, .. }) => Some(to),
        _ => None,
    });
    let scale = peak.max(FLOOR * length);
    let condition = nudged.map_or(f64::INFINITY, |nudged| {
        apart(&nudged.samples, &|s| s.deflection) / (peak.max(f64::MIN_POSITIVE) * NUDGE)
    });
    let rest = scene.moves.last().map_or(0.0, |step| step.settle / solver.tick) as usize;
    // What rests for less than four periods cannot be seen to swing up.
    let seen = rest as f64 * drawn.omega * solver.tick > 4.0 * std::f64::consts::TAU;
    let rest = if seen { rest } else { 0 };
    let rings_up = [&double, &single].into_iter().any(|record| {
        let deflections: Vec<f64> = record.samples.iter().map(|s| s.deflection).collect();
        grows(&deflections, rest, length)
    });
    Ok(Run {
        broken: [double.broken, single.broken],
        off_target: target.map_or(0.0, |to| (single.angle - to).abs()),
        peak: peak / length,
        deflection: apart(&single.samples, &|s| s.deflection) / scale,
        torque: apart(&single.samples, &|s| s.torque) / torque.max(f64::MIN_POSITIVE),
        condition: condition.max(1.0),
        rings_up: rings_up || (solver.method == Method::Elastica && peak > length),
        ticks: double.samples.len() as u64,
        rate: double.rate,
    })
}

/// Returns a message with every number left out, so that equal reasons read the same.
pub fn reason(message: &str) -> String {
    let mut text = String::new();
    let mut inside = false;
    let chars: Vec<char> = message.chars().collect();
    for (i, &c) in chars.iter().enumerate() {
        let next_is_digit = chars.get(i + 1).is_some_and(char::is_ascii_digit);
        let after_word = i > 0 && (chars[i - 1].is_alphanumeric() || chars[i - 1] == '_');
        let begins = (c.is_ascii_digit() && !after_word) || (c == '-' && next_is_digit);
        inside = begins || (inside && (c.is_ascii_digit() || matches!(c, '.' | 'e' | '-')));
        // A full stop or an exponent's letter ends a number too.
        if inside && matches!(c, '.' | 'e') && !next_is_digit && chars.get(i + 1) != Some(&'-') {
            inside = false;
        }
        if !inside {
            text.push(c);
        } else if !text.ends_with('…') {
            text.push('…');
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::reason;

    #[test]
    fn reasons_hold_no_numbers() {
        let given = "link.mass = 1e-9: must be 0.0000001 to 100000 kg, not -3.5.";
        assert_eq!(reason(given), "link.mass = …: must be … to … kg, not ….");
        assert_eq!(reason("N m^2 and rad/s^2"), "N m^… and rad/s^…");
    }
}
