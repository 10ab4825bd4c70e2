//! Writes a row for each run, with more detail than [`summary`](super::summary) keeps.

use std::io::{self, Write};

use super::campaign::Judged;
use super::draw::method_name;
use super::trial::Verdict;

/// Names of the columns.
pub const HEADER: [&str; 13] = [
    "scene",
    "method",
    "verdict",
    "ticks",
    "first_turn",
    "spin",
    "gravity",
    "damping",
    "peak",
    "condition",
    "deflection_apart",
    "torque_apart",
    "broken_f32",
];

/// Writes the runs of scenes that are numbered from 0.
pub fn write(file: &mut dyn Write, judged: &[Judged]) -> io::Result<()> {
    let mut csv = csv::Writer::from_writer(file);
    csv.write_record(HEADER)?;
    for (index, (drawn, verdicts)) in judged.iter().enumerate() {
        let (arm, omega) = (&drawn.scene.arm, drawn.omega);
        let damping = 0.5 * (arm.damping.alpha / omega + arm.damping.beta * omega);
        for (solver, verdict) in verdicts {
            let turn = omega * solver.tick;
            let numbers = match verdict {
                Verdict::Ran(run) => [
                    run.rate / omega,
                    drawn.sag(),
                    damping,
                    run.peak,
                    run.condition,
                    run.deflection,
                    run.torque,
                    run.broken[1].map_or(-1.0, |tick| tick as f64),
                ]
                .map(|x| format!("{x:.3e}")),
                _ => Default::default(),
            };
            let (word, ticks) = match verdict {
                Verdict::Ran(run) => ("ran", run.ticks),
                Verdict::Refused(_) => ("refused", 0),
                Verdict::Panicked(_) => ("panicked", 0),
            };
            let head = [
                index.to_string(),
                method_name(solver),
                word.to_owned(),
                ticks.to_string(),
                format!("{turn:.3e}"),
            ];
            csv.write_record(head.iter().chain(&numbers))?;
        }
    }
    csv.flush()
}
