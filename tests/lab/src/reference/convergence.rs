//! The tables of the convergence of the two reference solvers.

use std::time::Instant;

use super::truth::{Apart, Truth, difference};
use stillbeam_sim::error::Error;
use stillbeam_sim::reference::{ReferenceError, Sample, fem, rod};

/// Writes, line by line, the differences of the two solvers from a truth and from each other over
/// polynomials, steps and elements, and the order from one line to the next.
///
/// # Errors
/// An error is returned if the truth cannot be read or a solver gives up.
pub fn of(name: &str, say: &dyn Fn(String)) -> Result<(), Error> {
    let truth = Truth::read(name)?;
    say(format!("# {name}"));
    run(name, &Study { truth: &truth, say }).map_err(|error| Error::new(error).within(name))
}

fn run(name: &str, study: &Study<'_>) -> Result<(), ReferenceError> {
    study.against_truth()?;
    let reference = study.orders()?;
    // Halvings of the step, and the step at which elements are compared, s.
    let (longest, halvings, fixed) = match name {
        "d-fast" => (2e-4, 5, 1.25e-5),
        "spin-up" => (1e-3, 3, 2.5e-4),
        _ => (1e-3, 5, 5e-5),
    };
    study.steps(&reference, longest, halvings)?;
    study.elements(&reference, fixed)
}

struct Study<'a> {
    truth: &'a Truth,
    say: &'a dyn Fn(String),
}

impl Study<'_> {
    /// Compares both solvers with their defaults to the truth.
    fn against_truth(&self) -> Result<(), ReferenceError> {
        let truth = self.truth;
        let times = truth.times();
        let begin = Instant::now();
        let run = rod::solve(&truth.scene, &truth.trajectory, &times, &rod::Options::default())?;
        (self.say)(format!("rod: {}, {:.2?}", line(truth.error(&run)), begin.elapsed()));
        let begin = Instant::now();
        let run = fem::solve(&truth.scene, &truth.trajectory, &times, &fem::Options::default())?;
        (self.say)(format!("fem: {}, {:.2?}", line(truth.error(&run)), begin.elapsed()));
        Ok(())
    }

    /// Solves the rod by polynomials, compares with 8 of them, and returns the solution with 8.
    fn orders(&self) -> Result<Vec<Sample>, ReferenceError> {
        let truth = self.truth;
        let solve = |order| {
            let options = rod::Options { order, ..Default::default() };
            let begin = Instant::now();
            let run = rod::solve(&truth.scene, &truth.trajectory, &truth.times(), &options)?;
            Ok::<_, ReferenceError>((run, begin.elapsed()))
        };
        let (best, time) = solve(8)?;
        (self.say)(format!("rod, 8 polynomials: {time:.2?}"));
        for order in 5..8 {
            let (run, time) = solve(order)?;
            let error = difference(&truth.scene, &truth.trajectory, &run, &best);
            (self.say)(format!("rod, {order} polynomials against 8: {}, {time:.2?}", line(error)));
        }
        Ok(best)
    }

    fn steps(&self, rod: &[Sample], longest: f64, halvings: u32) -> Result<(), ReferenceError> {
        let mut before = None;
        for k in 0..=halvings {
            let step = longest / f64::from(1 << k);
            before = Some(self.compare(rod, 32, step, before)?);
        }
        Ok(())
    }

    fn elements(&self, rod: &[Sample], step: f64) -> Result<(), ReferenceError> {
        let mut before = None;
        for elements in [2, 4, 8, 16, 32] {
            before = Some(self.compare(rod, elements, step, before)?);
        }
        Ok(())
    }

    fn compare(
        &self,
        rod: &[Sample],
        elements: usize,
        step: f64,
        before: Option<Apart>,
    ) -> Result<Apart, ReferenceError> {
        let truth = self.truth;
        let options =
            fem::Options { elements, step: Some(step), tolerance: 1e-8, ..Default::default() };
        let begin = Instant::now();
        let run = fem::solve(&truth.scene, &truth.trajectory, &truth.times(), &options)?;
        let error = difference(&truth.scene, &truth.trajectory, &run, rod);
        let order = before.map_or(String::new(), |before| {
            format!(
                ", order {:.1} / {:.1}",
                (before.tip / error.tip).log2(),
                (before.torque / error.torque).log2()
            )
        });
        let time = begin.elapsed();
        (self.say)(format!(
            "fem, {elements:2} elements, {step:.3e} s: {}{order}, {time:.2?}",
            line(error)
        ));
        Ok(error)
    }
}

fn line(error: Apart) -> String {
    format!("tip {:.2e}, torque {:.2e}", error.tip, error.torque)
}
