//! The numbers and transcripts of `docs/firmware.md`. A command writes them, a test
//! checks them.

use std::fmt::Write;

use stillbeam_lab::markers::{self, Block};
use stillbeam_protocol::Command;
use stillbeam_sim::talk::{
    Answer, DEMONSTRATION, FAULTS, FIRST, Machine, STILL, Session, converse,
};

use crate::emulator::{self, Clock, LIMIT};
use crate::{firmware, image};

/// Instructions of 10 ms on the emulated board at 64 ns each, and the half of them that the tick
/// may have.
const INSTRUCTIONS: u32 = 156_250;
const SHARE: u32 = INSTRUCTIONS / 2;

/// Methods in the table of axes: their names on the page and in the list of methods.
pub const FITTED: [(&str, &str); 17] = [
    ("rigid", "RigidArm"),
    ("newmark 1 consistent", "Newmark1"),
    ("newmark 1 nodal", "Newmark1Nodal"),
    ("newmark 2 consistent", "Newmark2"),
    ("newmark 4 consistent", "Newmark4"),
    ("newmark 8 consistent", "Newmark8"),
    ("newmark 1 lumped", "Lumped1"),
    ("newmark 2 lumped", "Lumped2"),
    ("newmark 4 lumped", "Lumped4"),
    ("newmark 8 lumped", "Lumped8"),
    ("modal 1", "Modal1"),
    ("modal 2", "Modal2"),
    ("modal 3", "Modal3"),
    ("elastica 1 fast", "Elastica1"),
    ("elastica 2 fast", "Elastica2"),
    ("elastica 2 fine", "Elastica2Fine"),
    ("elastica 3 fine", "Elastica3Fine"),
];

/// Features of the application that sets arms up on the target.
const SET_UP: &str = "mps2,set-up";

/// Instructions of a tick of two axes in the application's profile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fit {
    /// Worst tick while both move.
    pub moving: u32,
    /// Worst tick of all, in which both plan their stop.
    pub worst: u32,
}

impl Fit {
    /// Returns the number of axes for which the tick has time.
    pub fn axes(&self) -> u32 {
        2 * SHARE / self.worst
    }
}

/// Runs the demonstrations and measures the application's images.
///
/// # Errors
/// An error is returned if something is missing, or does not build or run.
pub fn blocks() -> Result<Vec<Block>, String> {
    let whole = talk("mps2", &DEMONSTRATION, "stillbeam-sim talk")?;
    let first = talk("mps2", &FIRST, &spelled(&FIRST))?;
    let faults = talk("mps2", &FAULTS, &spelled(&FAULTS))?;
    let still = talk("mps2", &STILL, &spelled(&STILL))?;
    let set_up = talk(SET_UP, &STILL, "")?;
    let stack = whole.stack.max(faults.stack).max(still.stack);
    Ok(vec![
        Block::new("transcript", whole.transcript),
        Block::new("first", first.transcript),
        Block::new("faults", faults.transcript),
        Block::new("still", still.transcript),
        Block::new("sizes", sizes(stack, set_up.stack)?),
    ])
}

/// Returns the page with those of the blocks that it has a place for.
///
/// # Errors
/// An error is returned if a block begins and does not end.
pub fn replace(page: &str, blocks: &[Block]) -> Result<String, String> {
    let own = blocks.iter().filter(|block| markers::has(page, &block.name)).cloned();
    markers::fill(page, &own.collect::<Vec<_>>()).map_err(|error| error.to_string())
}

/// A conversation with the emulated board.
struct Talk {
    transcript: String,
    /// Deepest stack, bytes.
    stack: u32,
}

/// Returns the command that takes these steps.
fn spelled(steps: &[&str]) -> String {
    let quoted = steps.iter().map(|step| match step.contains(' ') {
        true => format!("\"{step}\""),
        false => (*step).to_owned(),
    });
    let mut lines = vec!["stillbeam-sim talk".to_owned()];
    for step in quoted {
        match lines.last_mut() {
            Some(line) if line.len() + step.len() < 96 => {
                write!(line, " {step}").expect("a string")
            }
            _ => lines.push(format!("    {step}")),
        }
    }
    lines.join(" \\\n")
}

fn talk(features: &str, steps: &[&str], command: &str) -> Result<Talk, String> {
    let image = firmware::application(features)?;
    let mut text = format!("```text\n$ {command}\n");
    let mut run = || {
        let mut session = Session::begin(Machine::emulate(&image)?)?;
        converse(&mut session, steps, &mut |line| {
            writeln!(text, "{line}").expect("a string");
        })?;
        session.ask(0, Command::Status)
    };
    match run() {
        Ok(Answer::Status(status)) => Ok(Talk { transcript: text + "```\n", stack: status.stack }),
        Ok(other) => Err(format!("status: {other:?}")),
        Err(error) => Err(error.to_string()),
    }
}

fn sizes(stack: u32, set_up: u32) -> Result<String, String> {
    let mut text = "| features | flash | statics | deepest stack |\n|---|---|---|---|\n".to_owned();
    let not_run = || "not run".to_owned();
    let images =
        [("mps2", stack.to_string()), (SET_UP, set_up.to_string()), ("nucleo-g474re", not_run())];
    for (features, stack) in images {
        let footprint = image::footprint(&firmware::application(features)?)?;
        writeln!(text, "| {features} | {} | {} | {stack} |", footprint.flash, footprint.ram)
            .expect("a string");
    }
    Ok(text)
}

/// Builds and runs the image of two axes with one method, by its name in the list of methods.
///
/// # Errors
/// An error is returned if something is missing or fails: the build, the emulator or the image.
pub fn fit(id: &str) -> Result<Fit, String> {
    let printed = emulator::run(&firmware::fit(id)?, Clock::Instructions, LIMIT)?;
    let printed = String::from_utf8_lossy(&printed);
    let numbers: Vec<u32> = printed.trim().split(',').filter_map(|n| n.parse().ok()).collect();
    match numbers[..] {
        [moving, worst] => Ok(Fit { moving, worst }),
        _ => Err(format!("fit with {id} printed {printed}")),
    }
}

/// Returns the number of axes that fit, by the cost of a tick of two with each method.
///
/// # Errors
/// Errors are those of [`fit`].
pub fn axes() -> Result<Block, String> {
    let mut text = "| method | two axes moving | worst tick of two | axes in half of 10 ms |\n\
                    |---|---|---|---|\n"
        .to_owned();
    for (name, id) in FITTED {
        text += &row(name, &fit(id)?);
    }
    Ok(Block::new("axes", text))
}

/// Formats a line of the table of axes.
pub fn row(name: &str, fit: &Fit) -> String {
    format!("| {name} | {} | {} | {} |\n", fit.moving, fit.worst, fit.axes())
}
