//! Stiffness of link and joint from measured frequencies, by least squares.
//!
//! With the masses known, the frequencies follow from EI and the joint's stiffness k. The unknowns,
//! ln EI, ln k or both, minimise `Σ (ln fᵢ − ln f̂ᵢ)²`, the relative errors of the measured f̂ᵢ. As
//! many frequencies as unknowns are met exactly.

use nalgebra::{DMatrix, DVector};
use stillbeam::Scene;

use crate::arm::natural;
use crate::error::Error;

/// Range of `ln κ`, `κ = kL/EI`, in which a joint can be told from a clamp and from a free hinge: a
/// factor of 10⁴ either way.
const JOINT: f64 = 9.2;

/// Step of ln k in a central difference.
const DIFFERENCE: f64 = 1e-4;

/// Largest relative error of a frequency that a fit may leave.
const MISFIT: f64 = 0.2;

/// Deduced values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unknown {
    /// EI of the whole link, by one factor.
    Link,
    /// k of the joint.
    Joint,
    /// Both.
    Both,
}

/// κ of the joints that a fit starts from.
const STARTS: [f64; 2] = [0.3, 300.0];

/// Largest relative error of frequencies that are met exactly.
const EXACT: f64 = 1e-9;

/// Result of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fit {
    /// Factor of the link's EI.
    pub stiffness: f64,
    /// k of the joint, N m/rad. `None` for a clamped link.
    pub joint: Option<f64>,
    /// Largest relative error of a frequency.
    pub misfit: f64,
}

impl Fit {
    /// True if both are the same but for rounding.
    fn is_like(&self, other: &Self) -> bool {
        let joints = self.joint.zip(other.joint);
        joints.is_some_and(|(one, other)| (one / other - 1.0).abs() < 1e-3)
    }
}

/// Fits the unknowns to frequencies of the first modes, Hz. The arm is taken as it is in all else:
/// its EI is the one that is scaled, its joint the one that is kept if it is no unknown.
pub(super) fn fit(arm: &Scene, measured: &[f64], unknown: Unknown) -> Result<Fit, Error> {
    Problem { arm, measured, unknown }.solve()
}

struct Problem<'a> {
    arm: &'a Scene,
    measured: &'a [f64],
    unknown: Unknown,
}

/// A trial: the logarithm of the factor of EI, and of k if there is a joint.
#[derive(Clone, Copy, Debug)]
struct Point {
    link: f64,
    joint: Option<f64>,
}

impl Problem<'_> {
    /// Fits from both ends of a joint's range, as two frequencies may be those of a stiff link
    /// behind a soft joint and of a soft link behind a stiff one.
    fn solve(&self) -> Result<Fit, Error> {
        let [soft, stiff] = STARTS.map(|start| self.descend(start));
        let (soft, stiff) = (soft?, stiff?);
        if self.unknown != Unknown::Both {
            return self.judged(soft);
        }
        let is_exact = self.measured.len() == 2;
        let (mut fits, mut refusal) = (Vec::new(), None);
        for point in [soft, stiff].into_iter().filter(|point| !self.is_beyond(*point)) {
            match self.judged(point) {
                Ok(fit) if !is_exact || fit.misfit < EXACT => fits.push(fit),
                Ok(_) => {}
                Err(error) => refusal = Some(error),
            }
        }
        fits.sort_by(|one, other| one.misfit.total_cmp(&other.misfit));
        match (&fits[..], refusal) {
            ([], Some(error)) if !is_exact => Err(error),
            ([], _) => Err(self.no_joint()?),
            ([one, other], _) if is_exact && !one.is_like(other) => Err(self.ambiguous(one, other)),
            ([best, ..], _) => Ok(*best),
        }
    }

    /// Takes Gauss-Newton steps from a joint of that κ, none of them longer than a factor of e.
    fn descend(&self, start: f64) -> Result<Point, Error> {
        let mut point = self.start(start)?;
        for _ in 0..200 {
            let (errors, slopes) = self.linearised(point)?;
            let step = slopes
                .svd(true, true)
                .solve(&-errors, 1e-14)
                .map_err(|reason| Error::new(format_args!("{}: {reason}", self.name())))?;
            let step = &step / step.amax().max(1.0);
            point = self.moved(point, &step);
            if self.is_beyond(point) || step.amax() < 1e-12 {
                break;
            }
        }
        Ok(point)
    }

    /// Starts with the clamped link that fits best, and a joint of that κ.
    fn start(&self, joint: f64) -> Result<Point, Error> {
        let clamped = self.logarithms(None)?;
        let count = self.measured.len() as f64;
        let mean = self.pairs(&clamped).map(|(own, measured)| measured - own).sum::<f64>() / count;
        let link = if self.unknown == Unknown::Joint { 0.0 } else { 2.0 * mean };
        let joint = match self.unknown {
            Unknown::Link => self.arm.hub.stiffness.map(f64::ln),
            Unknown::Joint | Unknown::Both => Some((joint * self.unit()).ln() + link),
        };
        Ok(Point { link, joint })
    }

    /// Returns the errors `ln fᵢ − ln f̂ᵢ` at a point, and their slopes along the unknowns.
    ///
    /// Scaling EI and k alike scales every fᵢ² likewise: with g of the unscaled link,
    /// `ln fᵢ = s/2 + gᵢ(ln k − s)`, s the logarithm of the factor.
    fn linearised(&self, point: Point) -> Result<(DVector<f64>, DMatrix<f64>), Error> {
        let at = |shift: f64| {
            self.logarithms(point.joint.map(|joint| (joint - point.link + shift).exp()))
        };
        let [here, below, above] = match point.joint {
            Some(_) => [at(0.0)?, at(-DIFFERENCE)?, at(DIFFERENCE)?],
            None => [at(0.0)?; 3],
        };
        let errors = self.pairs(&here).map(|(own, measured)| 0.5 * point.link + own - measured);
        let errors = DVector::from_iterator(self.measured.len(), errors);
        let slope = |i: usize| (above[i] - below[i]) / (2.0 * DIFFERENCE);
        let columns: &[fn(f64) -> f64] = match self.unknown {
            Unknown::Link => &[|joint| 0.5 - joint],
            Unknown::Joint => &[|joint| joint],
            Unknown::Both => &[|joint| 0.5 - joint, |joint| joint],
        };
        let slopes =
            DMatrix::from_fn(self.measured.len(), columns.len(), |i, j| columns[j](slope(i)));
        Ok((errors, slopes))
    }

    fn moved(&self, Point { link, joint }: Point, step: &DVector<f64>) -> Point {
        match self.unknown {
            Unknown::Link => Point { link: link + step[0], joint },
            Unknown::Joint => Point { link, joint: joint.map(|joint| joint + step[0]) },
            Unknown::Both => {
                Point { link: link + step[0], joint: joint.map(|joint| joint + step[1]) }
            }
        }
    }

    /// Returns ln κ.
    fn joint(&self, point: Point) -> Option<f64> {
        point.joint.map(|joint| joint - point.link - self.unit().ln())
    }

    fn is_beyond(&self, point: Point) -> bool {
        self.joint(point).is_some_and(|joint| joint.abs() > JOINT)
    }

    fn judged(&self, point: Point) -> Result<Fit, Error> {
        let joint = self.joint(point);
        if joint.is_some_and(|joint| joint > JOINT) {
            return Err(self.not_softer()?);
        }
        if joint.is_some_and(|joint| joint < -JOINT) {
            return Err(self.not_stiffer()?);
        }
        let (errors, _) = self.linearised(point)?;
        let misfit = errors.amax();
        if misfit.is_nan() || misfit >= MISFIT {
            let nearest: Vec<String> = self
                .measured
                .iter()
                .zip(errors.iter())
                .map(|(measured, error)| format!("{:.4}", measured * error.exp()))
                .collect();
            return Err(Error::new(format_args!(
                "{}: must be frequencies of one arm to {:.0} %; the nearest of this one are {} Hz",
                self.name(),
                100.0 * MISFIT,
                nearest.join(", ")
            )));
        }
        let joint = match self.unknown {
            Unknown::Link => self.arm.hub.stiffness,
            Unknown::Joint | Unknown::Both => point.joint.map(f64::exp),
        };
        Ok(Fit { stiffness: point.link.exp(), joint, misfit })
    }

    /// The error of frequencies that leave a joint nothing to give.
    fn not_softer(&self) -> Result<Error, Error> {
        let clamped = self.logarithms(None)?.map(f64::exp);
        Ok(Error::new(format_args!(
            "{}: must be less than {:.4} Hz, that of the clamped link, for a joint that gives; leave \
             hub.stiffness out, or give a stiffer link",
            self.name(),
            clamped[0]
        )))
    }

    /// The error of frequencies that no joint gives.
    fn no_joint(&self) -> Result<Error, Error> {
        let clamped = self.logarithms(None)?.map(f64::exp);
        Ok(Error::new(format_args!(
            "{}: must be those of a link behind a joint: the second over the first is {:.3}, that of \
             the clamped link {:.3}; leave hub.stiffness out, or measure again",
            self.name(),
            self.measured[1] / self.measured[0],
            clamped[1] / clamped[0]
        )))
    }

    /// The error of two frequencies that two joints give.
    fn ambiguous(&self, one: &Fit, other: &Fit) -> Error {
        let told = |fit: &Fit| {
            let stiffness = fit.stiffness * self.arm.link.bending_stiffness;
            let joint = fit.joint.unwrap_or(f64::INFINITY);
            format!("EI = {stiffness:.4} N m^2 behind {joint:.4} N m/rad")
        };
        Error::new(format_args!(
            "{}: must be three frequencies here, as two are those of {} and of {}; or give the link\u{2019}s \
             stiffness and one frequency",
            self.name(),
            told(one),
            told(other)
        ))
    }

    /// The error of frequencies that no link reaches behind this joint, or no joint below this
    /// link.
    fn not_stiffer(&self) -> Result<Error, Error> {
        let hinged = self.logarithms(Some(self.unit() * (-JOINT).exp()))?;
        Ok(match (self.unknown, self.arm.hub.stiffness) {
            (Unknown::Link, Some(joint)) => {
                // Of a link as stiff as one can be told from a rigid one.
                let scale = joint / (self.unit() * (-JOINT).exp());
                let most = (hinged[0] + 0.5 * scale.ln()).exp();
                Error::new(format_args!(
                    "{}: must be less than {most:.4} Hz, that of a rigid link behind hub.stiffness = \
                     {joint} N m/rad; use a stiffer joint or lower frequencies",
                    self.name()
                ))
            }
            _ => Error::new(format_args!(
                "{}: must be more than {:.4} Hz for this link, else nothing holds it; use a softer \
                 link or higher frequencies",
                self.name(),
                hinged[0].exp()
            )),
        })
    }

    /// Returns `EI/L` of the link, N m: the stiffness of a joint with κ = 1.
    fn unit(&self) -> f64 {
        self.arm.link.bending_stiffness / self.arm.link.length
    }

    /// Returns ln fᵢ of the unscaled link behind a joint.
    fn logarithms(&self, joint: Option<f64>) -> Result<[f64; natural::MODES], Error> {
        let mut arm = *self.arm;
        arm.hub.stiffness = joint;
        Ok(natural::frequencies(&arm)?.map(f64::ln))
    }

    /// Pairs logarithms of frequencies with those of the measured ones.
    fn pairs<'a>(
        &'a self,
        own: &'a [f64; natural::MODES],
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        own.iter().zip(self.measured).map(|(own, measured)| (*own, measured.ln()))
    }

    fn name(&self) -> String {
        match self.measured {
            [one] => format!("link.frequency = {one}"),
            all => format!("link.frequency = {all:?}"),
        }
    }
}
