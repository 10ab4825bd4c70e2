//! Conditions on a plan: the residual that it may leave, the quantity that it keeps least.

use stillbeam::planner::Objective;

use crate::error::Error;

/// Conditions on moves with a piecewise-linear acceleration. None by default.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Residual vibration that the arm may keep, of L.
    pub residual: Option<f64>,
    /// Quantity that a move of a given duration keeps least.
    pub least: Option<Objective>,
    /// True if the acceleration is zero at both ends though no jerk is limited. Every still move
    /// meets it.
    pub eased: bool,
}

impl Options {
    /// True if there is one that moves with a piecewise-linear acceleration alone can meet.
    pub fn is_some(&self) -> bool {
        self.residual.is_some() || self.least.is_some()
    }

    /// Checks that the conditions go with a duration, or with none.
    pub fn validate(self, duration: Option<f64>) -> Result<Self, Error> {
        if let Some(residual) = self.residual
            && !(residual > 0.0 && residual <= 0.2)
        {
            return Err(Error::new(format_args!(
                "within = {residual} of the link's length: must be above 0, and 0.2 at most; leave \
                 it away for a move that leaves as little as can be"
            )));
        }
        if self.residual.is_some() && duration.is_some() && self.least.is_none() {
            return Err(Error::new(
                "within: takes effect on the shortest move, but a duration is given; leave one of \
                 them away, or say with `least` what the duration is to be used for",
            ));
        }
        if self.least.is_some() && duration.is_none() {
            return Err(Error::new(
                "least: says what a given duration is to be used for; give a duration too",
            ));
        }
        Ok(self)
    }

    /// The error where no move meets the conditions.
    pub(super) fn unmet(&self) -> Error {
        let key = if self.least.is_some() { "least" } else { "within" };
        Error::new(format_args!(
            "{key}: no such move was found. It is planned from rest to rest for an arm without \
             damping, gravity or a limit of the clamp moment, within at least one limit or in a \
             duration of 0.9 first periods or more; leave {key} away, or raise limits or duration"
        ))
    }
}

/// Returns a residual in parts of the link's length, m, from a text: `0.2mm` or `3%`.
pub fn residual(text: &str, length: f64) -> Result<f64, Error> {
    let number = |digits: &str| digits.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    let found = match (text.strip_suffix("mm"), text.strip_suffix('%')) {
        (Some(digits), _) => number(digits).map(|x| 1e-3 * x / length),
        (_, Some(digits)) => number(digits).map(|x| 0.01 * x),
        _ => None,
    };
    found.ok_or_else(|| {
        Error::new(format_args!(
            "--within = {text}: must be a length in mm or a part of the link's length in %, e.g. \
             0.2mm or 3%"
        ))
    })
}

/// Returns the quantity of that name.
pub fn least(name: &str) -> Result<Objective, Error> {
    match name {
        "acceleration" => Ok(Objective::Acceleration),
        "effort" => Ok(Objective::Effort),
        _ => Err(Error::new(format_args!(
            "--least = {name}: must be acceleration (its peak) or effort (the integral of the \
             squared torque, which warms the motor)"
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::{Options, least, residual};

    #[test]
    fn residuals_have_a_unit() {
        let near = |text: &str, part: f64| {
            let found = residual(text, 0.4).expect("a residual");
            assert!((found - part).abs() < 1e-15, "{text}: {found}");
        };
        near("0.2mm", 5e-4);
        near("3%", 0.03);
        near("3 %", 0.03);
        for text in ["0.03", "mm", "three%", "1e999%"] {
            assert!(residual(text, 0.4).is_err(), "{text}");
        }
    }

    #[test]
    fn conditions_go_with_a_duration_or_without() {
        let within = Options { residual: Some(0.01), ..Options::default() };
        assert!(within.validate(None).is_ok() && within.validate(Some(1.0)).is_err());
        let gentle =
            Options { least: Some(least("effort").expect("a name")), ..Options::default() };
        assert!(gentle.validate(Some(1.0)).is_ok() && gentle.validate(None).is_err());
        for residual in [0.0, -0.1, 0.21, f64::NAN] {
            let within = Options { residual: Some(residual), ..Options::default() };
            assert!(within.validate(None).is_err());
        }
        assert!(least("heat").is_err());
    }
}
