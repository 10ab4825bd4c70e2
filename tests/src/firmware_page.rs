//! The numbers in `docs/firmware.md` and the transcript in `README.md`: written by a command, checked
//! by a test.

use std::fmt::Write;

use stillbeam_protocol::Command;
use stillbeam_sim::talk::{Answer, DEMONSTRATION, Machine, Session, converse};

use crate::{firmware, image, root};

/// Instructions of 10 ms on the emulated board at 64 ns each, and the half of them that the tick may
/// have.
const INSTRUCTIONS: u32 = 156_250;
const SHARE: u32 = INSTRUCTIONS / 2;

/// A block of a page: what is between its two lines is written by the command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Its name, as in `<!-- firmware: NAME -->`.
    pub name: &'static str,
    /// Its text.
    pub text: String,
}

/// Runs the demonstration, measures the images, reads the instruction table.
///
/// # Errors
/// What is missing, or does not build or run.
pub fn blocks() -> Result<Vec<Block>, String> {
    let (transcript, cost, stack) = talk()?;
    Ok(vec![
        Block { name: "transcript", text: transcript },
        Block { name: "sizes", text: sizes(stack)? },
        Block { name: "axes", text: axes(cost)? },
    ])
}

/// The page with those of the blocks that it has.
///
/// # Errors
/// A block begins and does not end.
pub fn replace(page: &str, blocks: &[Block]) -> Result<String, String> {
    blocks.iter().try_fold(page.to_owned(), |page, Block { name, text }| {
        let begin = format!("<!-- firmware: {name} -->\n");
        let end = "<!-- /firmware -->";
        let Some((before, rest)) = page.split_once(&begin) else { return Ok(page) };
        let (_, after) = rest.split_once(end).ok_or(format!("{begin} has no {end}"))?;
        Ok(format!("{before}{begin}{text}{end}{after}"))
    })
}

/// The demonstration's transcript, the cost of a tick of both axes in a move, and the worst stack.
fn talk() -> Result<(String, u32, u32), String> {
    let image = firmware::application("mps2")?;
    let mut text = "```text\n$ stillbeam-sim talk\n".to_owned();
    let mut moving = 0;
    let mut run = || {
        let mut session = Session::begin(Machine::emulate(&image)?)?;
        converse(&mut session, &DEMONSTRATION, &mut |line| {
            writeln!(text, "{line}").expect("a string");
            let words: Vec<&str> = line.split_whitespace().collect();
            if let [_, "s", "|", _, "tick:", cost, "instructions", ..] = words.as_slice() {
                moving = moving.max(cost.parse().unwrap_or(0));
            }
        })?;
        session.ask(0, Command::Status)
    };
    match run() {
        Ok(Answer::Status(status)) => Ok((text + "```\n", moving, status.stack)),
        Ok(other) => Err(format!("status: {other:?}")),
        Err(error) => Err(error.to_string()),
    }
}

fn sizes(stack: u32) -> Result<String, String> {
    let mut text = "| board | flash | statics | deepest stack |\n|---|---|---|---|\n".to_owned();
    for (board, stack) in [("mps2", stack.to_string()), ("nucleo-g474re", "not run".to_owned())] {
        let footprint = image::footprint(&firmware::application(board)?)?;
        writeln!(text, "| {board} | {} | {} | {stack} |", footprint.flash, footprint.ram)
            .expect("a string");
    }
    Ok(text)
}

/// How many axes fit: the worst tick of each method by the instruction table, and what the
/// application does beside it, which does not depend on the method.
fn axes(both: u32) -> Result<String, String> {
    let path = root().join("docs/instructions.csv");
    let table = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    let mut methods: Vec<(String, u32)> = Vec::new();
    for line in table.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let &[method, size, quality, skip, _, worst, ..] = cells.as_slice() else { continue };
        // A rigid arm's rows name the motion where it is not the cubic.
        if skip.contains("no-spin") || method == "rigid" && !quality.is_empty() {
            continue;
        }
        let name = [method, size, quality].join(" ");
        let worst: u32 = worst.parse().map_err(|_| format!("{}: {line}", path.display()))?;
        match methods.iter_mut().find(|(known, _)| *known == name.trim()) {
            Some((_, most)) => *most = worst.max(*most),
            None => methods.push((name.trim().to_owned(), worst)),
        }
    }
    let own = methods.iter().find(|(name, _)| name == "newmark 1 consistent");
    let own = own.ok_or(format!("{}: no newmark 1 consistent", path.display()))?.1;
    let beside = (both / 2).saturating_sub(own);
    let mut text = format!(
        "Beside the generator the application takes {beside} instructions an axis and tick.\n\n\
         | method | worst tick | axes in half of 10 ms |\n|---|---|---|\n"
    );
    for (name, worst) in methods {
        writeln!(text, "| {name} | {worst} | {} |", SHARE / (worst + beside)).expect("a string");
    }
    Ok(text)
}
