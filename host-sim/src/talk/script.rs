//! Conversations, step by step and over and over.

use stillbeam_protocol::Command;

use super::{Answer, Session, Step};
use crate::error::Error;

/// Takes steps one by one and hands out the result of each, line by line: its time, the request,
/// the answer. The firmware's log follows below it.
///
/// # Errors
/// An error is returned at the first word group that is no step, before any is taken. Others are
/// those of [`Step::take`].
pub fn converse(
    session: &mut Session,
    steps: &[&str],
    print: &mut dyn FnMut(&str),
) -> Result<(), Error> {
    let parsed: Vec<Step> = steps.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
    print(&format!("{} axes, a tick of {} ms", session.axes(), 1e3 * session.tick()));
    logged(session, print);
    for (text, step) in steps.iter().zip(parsed) {
        let begin = f64::from(session.now()) * session.tick();
        let said = step.take(session)?;
        print(format!("{begin:5.2} s  {text:<24} {said}").trim_end());
        logged(session, print);
    }
    session.wait(1)?;
    logged(session, print);
    compared(session, print);
    Ok(())
}

/// Repeats steps until `seconds` of virtual time have passed, and hands out a line each round.
///
/// # Errors
/// Errors are those of [`converse`], and that of a round in which something was refused that the
/// first round was not, or the other way about: the firmware has drifted.
pub fn endure(
    session: &mut Session,
    steps: &[&str],
    seconds: f64,
    print: &mut dyn FnMut(&str),
) -> Result<(), Error> {
    if !(seconds > 0.0 && seconds <= 1e6) {
        return Err(Error::new(format_args!(
            "--for = {seconds} s: must be above 0, and 1e6 s at most"
        )));
    }
    let parsed: Vec<Step> = steps.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
    let mut first = None;
    let mut rounds = 0;
    while f64::from(session.now()) * session.tick() < seconds {
        let mut refused = Vec::new();
        for (step, text) in parsed.iter().zip(steps) {
            let said = step.take(session)?;
            if let Some(why) = said.strip_prefix("refused: ") {
                refused.push(format!("{text}: {why}"));
            }
        }
        rounds += 1;
        let time = f64::from(session.now()) * session.tick();
        let expected = first.get_or_insert_with(|| refused.clone());
        if *expected != refused {
            return Err(Error::new(format_args!(
                "round {rounds}, {time:.2} s: refused {refused:?}, in the first round {expected:?}"
            )));
        }
        print(&format!("{time:7.2} s  round {rounds}, {} refused as in the first", refused.len()));
    }
    for axis in 0..session.axes() {
        let answer = session.ask(axis, Command::Status)?;
        if let Answer::Status(_) = answer {
            print(&format!("axis {axis}: {answer}"));
        }
    }
    compared(session, print);
    Ok(())
}

/// Prints how machines followed, and how many setpoints and frames were compared.
fn compared(session: &Session, print: &mut dyn FnMut(&str)) {
    for axis in 0..session.axes() {
        if let Some([behind, energy]) = session.followed(axis) {
            print(&format!(
                "axis {axis}: hub at most {behind:.4} rad behind its setpoint, energy balanced to \
                 {energy:.1e}"
            ));
        }
    }
    let [setpoints, frames] = session.compared();
    let what = format!("{setpoints} setpoints and {frames} drive frames");
    print(&format!("{what}, all equal to the host's to the bit"));
}

/// Prints what the firmware has logged.
fn logged(session: &mut Session, print: &mut dyn FnMut(&str)) {
    let h = session.tick();
    for (made, line) in session.log() {
        print(format!("{:5.2} s  | {line}", f64::from(made) * h).trim_end());
    }
}
