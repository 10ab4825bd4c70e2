//! A screw or a belt between the motor and a carriage.

use core::f64::consts::TAU;

use super::Ratio;
use crate::Error;

/// Least and greatest lead, m: a ratio's whole numbers reach no further.
const LEAD: (f64, f64) = (1e-4, 1e3);

/// Most steps of the continued fraction: the denominators grow as the golden ratio's powers at
/// least, and 65,535 is its 23rd.
const STEPS: u32 = 32;

impl Ratio {
    /// The ratio of a screw or a belt that moves a carriage by `lead` m per turn of the motor.
    ///
    /// On a linear axis a position of `s` m is an angle of `s/2π` turns, so that `n = 2π/lead`. The
    /// motor's torque is then the force times `lead/2π`, and its inertia counts likewise.
    ///
    /// Error: the nearest fraction of whole numbers up to 65,535 is within 9e-6 of `n` for leads
    /// of 1 mm or more, and within 2e-5 below, less than what a screw's own pitch is known to.
    ///
    /// # Errors
    /// A lead that is not 1e-4 to 1e3 m.
    pub fn of_lead(lead: f64) -> Result<Self, Error> {
        let (least, most) = LEAD;
        let n = TAU / Error::check("motor.lead", lead, least, most, "m")?;
        Ok(nearest(n))
    }
}

/// The nearest fraction to `x` whose numerator and denominator fit: the last convergent of its
/// continued fraction that does, or the last fraction between that one and the next.
fn nearest(x: f64) -> Ratio {
    let most = u64::from(u16::MAX);
    let (mut before, mut last) = ([0u64, 1], [1u64, 0]);
    let mut rest = x;
    for _ in 0..STEPS {
        let whole = libm::floor(rest) as u64;
        let room = |i: usize| (most - before[i]).checked_div(last[i]).unwrap_or(u64::MAX);
        let taken = whole.min(room(0)).min(room(1));
        let next = [0, 1].map(|i| taken * last[i] + before[i]);
        if taken < whole {
            let off = |fraction: [u64; 2]| (fraction[0] as f64 / fraction[1] as f64 - x).abs();
            // Neither a numerator nor a denominator of 0 is a gear.
            let usable = |fraction: [u64; 2]| fraction[0] > 0 && fraction[1] > 0;
            if usable(next) && (!usable(last) || off(next) < off(last)) {
                last = next;
            }
            break;
        }
        (before, last) = (last, next);
        let part = rest - whole as f64;
        if part < 1e-12 * rest {
            break;
        }
        rest = 1.0 / part;
    }
    Ratio { motor: last[0] as u16, link: last[1] as u16 }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::{LEAD, Ratio};

    #[test]
    fn the_fraction_keeps_its_stated_error() {
        let (least, most) = LEAD;
        // Interpreted, a hundred leads take a second.
        let count = if cfg!(miri) { 100 } else { 3000 };
        for i in 0..=count {
            let lead = least * libm::pow(most / least, f64::from(i) / f64::from(count));
            let ratio = Ratio::of_lead(lead).expect("a lead in range");
            assert!(ratio.validate().is_ok(), "{lead}: {ratio:?}");
            let error = (ratio.value::<f64>() * lead / TAU - 1.0).abs();
            let bound = if lead < 1e-3 { 2e-5 } else { 9e-6 };
            assert!(error < bound, "{lead} m: {ratio:?} is off by {error:e}");
        }
    }

    /// 355/113 is π to seven digits: a lead of 20 mm is 100π turns of the motor per turn of 2π m.
    #[test]
    fn a_lead_of_20_mm_is_a_well_known_fraction() {
        assert_eq!(Ratio::of_lead(0.02), Ok(Ratio { motor: 35_500, link: 113 }));
        assert!(Ratio::of_lead(0.0).is_err() && Ratio::of_lead(f64::NAN).is_err());
    }
}
