//! The numbers in `docs/firmware.md` and the transcript in `README.md`: written by a command, checked
//! by a test.

use std::fmt::Write;

use stillbeam_protocol::Command;
use stillbeam_sim::talk::{
    Answer, DEMONSTRATION, FAULTS, FIRST, Machine, STILL, Session, converse,
};

use crate::{firmware, image, root};

/// Instructions of 10 ms on the emulated board at 64 ns each, and the half of them that the tick may
/// have.
const INSTRUCTIONS: u32 = 156_250;
const SHARE: u32 = INSTRUCTIONS / 2;

/// The application's own stepper in the instruction table.
const OWN: &str = "newmark 1 nodal";

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
    let whole = talk("mps2", &DEMONSTRATION, "stillbeam-sim talk")?;
    let first = talk("mps2", &FIRST, &spelled(&FIRST))?;
    let faults = talk("mps2", &FAULTS, &spelled(&FAULTS))?;
    let still = talk("mps2,still", &STILL, &spelled(&STILL))?;
    let stack = whole.stack.max(faults.stack);
    Ok(vec![
        Block { name: "transcript", text: whole.transcript },
        Block { name: "first", text: first.transcript },
        Block { name: "faults", text: faults.transcript },
        Block { name: "still", text: still.transcript },
        Block { name: "sizes", text: sizes(stack, still.stack)? },
        Block { name: "axes", text: axes(whole.cost)? },
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

/// A conversation with the emulated board.
struct Talk {
    transcript: String,
    /// Instructions of a tick of both axes, in a move.
    cost: u32,
    /// Deepest, bytes.
    stack: u32,
}

/// The command that takes these steps.
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
    let mut moving = 0;
    let mut run = || {
        let mut session = Session::begin(Machine::emulate(&image)?)?;
        converse(&mut session, steps, &mut |line| {
            writeln!(text, "{line}").expect("a string");
            let words: Vec<&str> = line.split_whitespace().collect();
            if let [_, "s", "|", _, "tick:", cost, "instructions", ..] = words.as_slice() {
                moving = moving.max(cost.parse().unwrap_or(0));
            }
        })?;
        session.ask(0, Command::Status)
    };
    match run() {
        Ok(Answer::Status(status)) => {
            Ok(Talk { transcript: text + "```\n", cost: moving, stack: status.stack })
        }
        Ok(other) => Err(format!("status: {other:?}")),
        Err(error) => Err(error.to_string()),
    }
}

fn sizes(stack: u32, still: u32) -> Result<String, String> {
    let mut text = "| features | flash | statics | deepest stack |\n|---|---|---|---|\n".to_owned();
    let not_run = || "not run".to_owned();
    let images = [
        ("mps2", stack.to_string()),
        ("mps2,still", still.to_string()),
        ("nucleo-g474re", not_run()),
        ("nucleo-g474re,still", not_run()),
    ];
    for (features, stack) in images {
        let footprint = image::footprint(&firmware::application(features)?)?;
        writeln!(text, "| {features} | {} | {} | {stack} |", footprint.flash, footprint.ram)
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
        // A plan is no tick; a rigid arm's rows name the motion where it is not the cubic.
        let other_motion = method == "rigid" && !quality.is_empty();
        if method == "plan" || skip.contains("no-spin") || other_motion {
            continue;
        }
        let name = [method, size, quality].join(" ");
        let worst: u32 = worst.parse().map_err(|_| format!("{}: {line}", path.display()))?;
        match methods.iter_mut().find(|(known, _)| *known == name.trim()) {
            Some((_, most)) => *most = worst.max(*most),
            None => methods.push((name.trim().to_owned(), worst)),
        }
    }
    let own = methods.iter().find(|(name, _)| name == OWN);
    let own = own.ok_or(format!("{}: no {OWN}", path.display()))?.1;
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
