//! One method on one scene, in f64 and in f32.

use std::panic::{AssertUnwindSafe, catch_unwind};

use stillbeam::stepper::Stepper;
use stillbeam::{Move, Scalar as Real, Setpoint};

use super::draw::Drawn;
use crate::error::Error;
use crate::model_choice::{StepperVisitor, with_stepper};
use crate::run::each_tick;
use crate::scene_file::SceneFile;
use crate::solver::{Scalar, Solver};

/// Deflections are compared relative to the peak, but at least to this fraction of L: ten times what
/// an arm may still swing by when it is let sleep.
pub const FLOOR: f64 = 10.0 * stillbeam::stepper::SLEEP;

/// What a run has come to.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// Not accepted; the reason with its numbers left out.
    Refused(String),
    /// The program broke off: the message.
    Panicked(String),
    /// Ran to its end.
    Ran(Run),
}

/// A run in both precisions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Run {
    /// First tick with a field that is not finite, or an angle's part outside ±½ turn, f64 and f32.
    pub broken: [Option<u64>; 2],
    /// Distance from the last move's target, rad, f32.
    pub off_target: f64,
    /// Largest deflection, of L, f64.
    pub peak: f64,
    /// Largest difference of deflections, of their peak, see [`FLOOR`].
    pub deflection: f64,
    /// Largest difference of torques, of their peak.
    pub torque: f64,
    /// Ticks.
    pub ticks: u64,
}

/// Runs one solver of a scene.
pub fn trial(drawn: &Drawn, solver: &Solver) -> Verdict {
    let run = AssertUnwindSafe(|| both(&drawn.scene, solver));
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

/// What is kept of a setpoint.
#[derive(Clone, Copy)]
struct Sample {
    deflection: f64,
    torque: f64,
}

struct Record<'a> {
    scene: &'a SceneFile,
    samples: Vec<Sample>,
    broken: Option<u64>,
    angle: f64,
}

impl StepperVisitor for &mut Record<'_> {
    type Output = ();

    fn visit<S: Stepper + Clone>(self, stepper: S) -> Result<(), Error> {
        each_tick(stepper, self.scene, |generator, k, _| {
            let setpoint = generator.tick();
            if self.broken.is_none() && !is_sound(&setpoint) {
                self.broken = Some(k);
            }
            let (deflection, torque) = (setpoint.deflection().to_f64(), setpoint.torque.to_f64());
            self.samples.push(Sample { deflection, torque });
            self.angle = setpoint.angle.radians();
        })
    }
}

fn is_sound<T: Real>(s: &Setpoint<T>) -> bool {
    let all = [s.angle.part, s.rate, s.acceleration, s.torque, s.tip[0], s.tip[1]];
    all.iter().all(|x| x.is_finite()) && s.angle.part.to_f64().abs() <= 0.5
}

fn both(scene: &SceneFile, solver: &Solver) -> Result<Run, Error> {
    let run = |scalar: Scalar| -> Result<Record<'_>, Error> {
        let mut record = Record { scene, samples: Vec::new(), broken: None, angle: 0.0 };
        with_stepper(scene, &Solver { scalar, ..*solver }, &mut record)?;
        Ok(record)
    };
    let (double, single) = (run(Scalar::F64)?, run(Scalar::F32)?);
    let length = scene.arm.link.length;
    let most = |of: &dyn Fn(&Sample) -> f64| {
        double.samples.iter().map(|sample| of(sample).abs()).fold(0.0, f64::max)
    };
    let apart = |of: &dyn Fn(&Sample) -> f64| {
        let pairs = double.samples.iter().zip(&single.samples);
        pairs.map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, f64::max)
    };
    let (peak, torque) = (most(&|s| s.deflection), most(&|s| s.torque));
    let target = scene.moves.last().and_then(|step| match step.motion {
        Move::To { to, .. } => Some(to),
        _ => None,
    });
    Ok(Run {
        broken: [double.broken, single.broken],
        off_target: target.map_or(0.0, |to| (single.angle - to).abs()),
        peak: peak / length,
        deflection: apart(&|s| s.deflection) / peak.max(FLOOR * length),
        torque: apart(&|s| s.torque) / torque.max(f64::MIN_POSITIVE),
        ticks: double.samples.len() as u64,
    })
}

/// A message with every number left out, so that equal reasons read the same.
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
        let given = "link.mass = 1e-9: accepted is 0.0000001 to 100000 kg, not -3.5.";
        assert_eq!(reason(given), "link.mass = …: accepted is … to … kg, not ….");
        assert_eq!(reason("N m^2 and rad/s^2"), "N m^… and rad/s^…");
    }
}
