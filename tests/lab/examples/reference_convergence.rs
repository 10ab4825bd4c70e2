//! The two reference solvers converging to each other: largest tip distance (fraction of L) and
//! torque difference (fraction of the peak, away from jumps) between fem and rod, over elements
//! and steps, and the order from one row or column to the next.
//!
//! `cargo run -p stillbeam-lab --example reference_convergence [SCENE ...]`

#[path = "../tests/common/mod.rs"]
mod common;

use std::time::Instant;

use common::{Error, NAMES, Truth, difference, truth};
use stillbeam_sim::reference::{ReferenceError, Sample, fem, rod};

fn main() -> Result<(), ReferenceError> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    for name in NAMES {
        if !asked.is_empty() && !asked.iter().any(|asked| asked == name) {
            continue;
        }
        let truth = truth(name);
        println!("# {name}");
        against_truth(&truth)?;
        let reference = orders(&truth)?;
        // Halvings of the step, and the step at which elements are compared, s.
        let (longest, halvings, fixed) = match name {
            "d-fast" => (2e-4, 5, 1.25e-5),
            "spin-up" => (1e-3, 3, 2.5e-4),
            _ => (1e-3, 5, 5e-5),
        };
        steps(&truth, &reference, longest, halvings)?;
        elements(&truth, &reference, fixed)?;
        println!();
    }
    Ok(())
}

/// Both with their defaults.
fn against_truth(truth: &Truth) -> Result<(), ReferenceError> {
    let times = truth.times();
    let begin = Instant::now();
    let run = rod::solve(&truth.scene, &truth.trajectory, &times, &rod::Options::default())?;
    println!("rod: {}, {:.2?}", line(truth.error(&run)), begin.elapsed());
    let begin = Instant::now();
    let run = fem::solve(&truth.scene, &truth.trajectory, &times, &fem::Options::default())?;
    println!("fem: {}, {:.2?}", line(truth.error(&run)), begin.elapsed());
    Ok(())
}

/// The rod by polynomials, against 8 of them, which are returned.
fn orders(truth: &Truth) -> Result<Vec<Sample>, ReferenceError> {
    let solve = |order| {
        let options = rod::Options { order, ..Default::default() };
        let begin = Instant::now();
        let run = rod::solve(&truth.scene, &truth.trajectory, &truth.times(), &options)?;
        Ok::<_, ReferenceError>((run, begin.elapsed()))
    };
    let (best, time) = solve(8)?;
    println!("rod, 8 polynomials: {time:.2?}");
    for order in 5..8 {
        let (run, time) = solve(order)?;
        let error = difference(&truth.scene, &truth.trajectory, &run, &best);
        println!("rod, {order} polynomials against 8: {}, {time:.2?}", line(error));
    }
    Ok(best)
}

fn steps(truth: &Truth, rod: &[Sample], longest: f64, halvings: u32) -> Result<(), ReferenceError> {
    let mut before = None;
    for k in 0..=halvings {
        let step = longest / f64::from(1 << k);
        before = Some(compare(truth, rod, 32, step, before)?);
    }
    Ok(())
}

fn elements(truth: &Truth, rod: &[Sample], step: f64) -> Result<(), ReferenceError> {
    let mut before = None;
    for elements in [2, 4, 8, 16, 32] {
        before = Some(compare(truth, rod, elements, step, before)?);
    }
    Ok(())
}

fn compare(
    truth: &Truth,
    rod: &[Sample],
    elements: usize,
    step: f64,
    before: Option<Error>,
) -> Result<Error, ReferenceError> {
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
    println!("fem, {elements:2} elements, {step:.3e} s: {}{order}, {time:.2?}", line(error));
    Ok(error)
}

fn line(error: Error) -> String {
    format!("tip {:.2e}, torque {:.2e}", error.tip, error.torque)
}
