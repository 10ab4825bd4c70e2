//! Steps of a conversation with the firmware, one for each group of words.

use std::fmt;
use std::str::FromStr;

use stillbeam::motion::{Spline, Waypoint};
use stillbeam::{Payload, PlainMove, Profile};
use stillbeam_protocol::{Change, Command};

use super::{Answer, Session};
use crate::error::Error;

/// One step of a conversation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A request to an axis.
    Ask(u8, Command),
    /// Goes on for a time, s.
    Wait(f64),
    /// Goes on for a time, s, without a word to the firmware.
    Silence(f64),
    /// Keeps the firmware from its tick for a time, s.
    Stall(f64),
    /// Goes on until every axis rests.
    Rest,
    /// Lets the encoder of an axis jump, turns of the motor.
    Jump(u8, f64),
    /// Lets the drive of an axis switch itself off with an error.
    Fail(u8),
    /// Cuts the line between the bus and the drive of an axis; with false, mends it.
    Cut(u8, bool),
}

/// Demonstration of every part of the policy. Both axes move, one is stopped on its way, one takes
/// up a payload, one gets an excessive request, the link is lost, the drives are switched off.
pub const DEMONSTRATION: [&str; 20] = [
    "enable 0",
    "enable 1",
    "move 0 quintic 1.7 1.57",
    "move 1 s-curve 1.0 -0.9",
    "move 0 cubic 2.0 -0.3",
    "rest",
    "payload 1 0.08",
    "move 1 cycloid 0.8 0.6",
    "move 0 trapezoid 1.8 1.2",
    "wait 0.9",
    "stop 0",
    "rest",
    "move 0 cubic 0.5 0",
    "enable 0",
    "move 0 cubic 0.1 3",
    "spin 1 0.5 4",
    "silence 1.3",
    "disable 0",
    "disable 1",
    "status 0",
];

/// A first conversation: one move, one stop on its way.
pub const FIRST: [&str; 8] = [
    "enable 0",
    "move 0 quintic 0.9 1.57",
    "wait 0.4",
    "stop 0",
    "rest",
    "move 0 cubic 0.5 0",
    "disable 0",
    "status 0",
];

/// Still moves, planned by the firmware: in a given time, in the shortest, behind another move,
/// with another payload. One is too short, one beyond a limit.
pub const STILL: [&str; 13] = [
    "enable 0",
    "enable 1",
    "still 0 1.57 1.2",
    "rest",
    "still 0 0.4",
    "still 0 -0.2 1.5",
    "rest",
    "still 0 0.5 0.1",
    "still 0 -1.5 0.76",
    "payload 0 0.05",
    "still 0 1.2 1.6",
    "rest",
    "status 0",
];

/// Faults in the middle of moves: a late tick, a missed one and too many of them.
pub const FAULTS: [&str; 13] = [
    "enable 0",
    "move 0 quintic 1.7 1.57",
    "wait 0.3",
    "stall 0.014",
    "status 0",
    "stall 0.025",
    "status 0",
    "rest",
    "move 0 quintic 1.7 0",
    "wait 0.5",
    "stall 0.045",
    "rest",
    "status 0",
];

/// Faults around a machine behind its drives: a move, a stop, an encoder that jumps, a drive that
/// faults on its way and is cleared, one whose line is cut and that its watchdog switches off, a
/// host that falls silent.
pub const MACHINE: [&str; 35] = [
    "enable 0",
    "enable 1",
    "move 0 quintic 1.7 1.57",
    "move 1 s-curve 1.0 -0.9",
    "rest",
    "move 0 quintic 1.7 0.2",
    "wait 0.8",
    "stop 0",
    "rest",
    "move 1 quintic 1.0 0.3",
    "wait 0.4",
    "jump 1 0.002",
    "rest",
    "move 1 quintic 1.0 -0.3",
    "wait 0.5",
    "fault 1",
    "wait 0.2",
    "rest",
    "enable 1",
    "clear 1",
    "wait 0.2",
    "enable 1",
    "move 1 quintic 1.0 0.4",
    "wait 0.5",
    "cut 1",
    "wait 0.5",
    "rest",
    "enable 1",
    "mend 1",
    "wait 0.2",
    "clear 1",
    "wait 0.2",
    "enable 1",
    "move 0 quintic 1.7 0.9",
    "silence 1.0",
];

/// Steps that are accepted.
const ACCEPTED: &str = "enable A, disable A, stop A, move A PROFILE DURATION TO, still A TO \
     [DURATION], target A TO DURATION [RATE], duration A DURATION, hold A, cancel A, path A SPLINE, \
     row A TIME ANGLE [RATE], last A TIME ANGLE [RATE], spin A DURATION RATE, dwell A DURATION, \
     payload A MASS [INERTIA], home A ANGLE, status A, wait SECONDS, silence SECONDS, stall SECONDS, \
     rest, clear A, fault A, cut A, mend A, jump A TURNS";

impl FromStr for Step {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        let mut words = text.split_whitespace();
        let step = match words.next().unwrap_or("") {
            "rest" => Some(Self::Rest),
            "wait" => number(words.next()).map(Self::Wait),
            "stall" => number(words.next()).map(Self::Stall),
            "silence" => number(words.next()).map(Self::Silence),
            "jump" => axis(words.next()).zip(number(words.next())).map(|(a, x)| Self::Jump(a, x)),
            "fault" => axis(words.next()).map(Self::Fail),
            "cut" => axis(words.next()).map(|axis| Self::Cut(axis, true)),
            "mend" => axis(words.next()).map(|axis| Self::Cut(axis, false)),
            verb => {
                let axis = axis(words.next());
                axis.zip(command(verb, &mut words)).map(|(axis, command)| Self::Ask(axis, command))
            }
        };
        step.filter(|_| words.next().is_none())
            .ok_or_else(|| Error::new(format_args!("step = \"{text}\": must be {ACCEPTED}")))
    }
}

fn command<'a>(verb: &str, words: &mut impl Iterator<Item = &'a str>) -> Option<Command> {
    Some(match verb {
        "enable" => Command::Enable,
        "disable" => Command::Disable,
        "stop" => Command::Stop,
        "status" => Command::Status,
        "clear" => Command::Clear,
        "home" => Command::Home(number(words.next())?),
        "move" => {
            let profile = Profile::named(words.next()?)?;
            let (duration, to) = (number(words.next())?, number(words.next())?);
            Command::Move(PlainMove::To { profile, duration, to })
        }
        "still" => {
            let to = number(words.next())?;
            let duration =
                words.next().map(|word| number(Some(word)).ok_or(())).transpose().ok()?;
            Command::Still { to, duration }
        }
        "spin" => {
            let (duration, rate) = (number(words.next())?, number(words.next())?);
            Command::Move(PlainMove::SpinUp { duration, rate })
        }
        "target" => {
            let (angle, duration) = (number(words.next())?, number(words.next())?);
            let rate = words.next().map_or(Some(0.0), |word| number(Some(word)))?;
            Command::Change(Change::Target { angle, rate, duration })
        }
        "duration" => Command::Change(Change::Duration(number(words.next())?)),
        "path" => Command::Path(Spline::named(words.next()?)?),
        "row" | "last" => {
            let (time, angle) = (number(words.next())?, number(words.next())?);
            let rate = words.next().map(|word| number(Some(word)).ok_or(())).transpose().ok()?;
            let row = Waypoint { rate, ..Waypoint::at(time, angle) };
            Command::Waypoint { row, last: verb == "last" }
        }
        "hold" => Command::Change(Change::Hold),
        "cancel" => Command::Change(Change::Cancel),
        "dwell" => Command::Move(PlainMove::Dwell { duration: number(words.next())? }),
        "payload" => {
            let mass = number(words.next())?;
            let inertia = words.next().map_or(Some(0.0), |word| number(Some(word)))?;
            Command::Payload(Payload { mass, inertia, offset: 0.0 })
        }
        _ => return None,
    })
}

fn axis(word: Option<&str>) -> Option<u8> {
    word?.parse().ok()
}

/// Parses any number. The firmware decides on its range. The times of this script are checked when
/// they pass.
fn number(word: Option<&str>) -> Option<f64> {
    word?.parse().ok()
}

impl Step {
    /// Takes the step and returns its result in words.
    ///
    /// # Errors
    /// An error is returned if the firmware is gone or does otherwise than the host. A refusal is
    /// no error.
    pub fn take(&self, session: &mut Session) -> Result<String, Error> {
        match *self {
            Self::Ask(axis, Command::Waypoint { row, last }) => {
                session.offer(axis, row, last).map(|answer| said(&answer))
            }
            Self::Ask(axis, command) => session.ask(axis, command).map(|answer| said(&answer)),
            Self::Wait(seconds) => {
                session.wait(ticks(seconds, session)?)?;
                Ok(String::new())
            }
            Self::Silence(seconds) => {
                session.keep_silent(ticks(seconds, session)?)?;
                Ok(modes(session))
            }
            Self::Stall(seconds) => {
                session.stall(seconds)?;
                Ok(modes(session))
            }
            Self::Rest => {
                session.rest()?;
                Ok(modes(session))
            }
            Self::Jump(axis, turns) => {
                session.jump(axis, turns)?;
                Ok(String::new())
            }
            Self::Fail(axis) => {
                session.fail(axis)?;
                Ok(String::new())
            }
            Self::Cut(axis, cut) => {
                session.cut(axis, cut)?;
                Ok(String::new())
            }
        }
    }
}

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
        return Err(Error::new(format_args!("--for = {seconds} s: must be above 0 to 1e6 s")));
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
        if let Answer::Status(status) = session.ask(axis, Command::Status)? {
            print(&format!("axis {axis}: {}", said(&Answer::Status(status))));
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

fn ticks(seconds: f64, session: &Session) -> Result<u32, Error> {
    if (0.0..=3600.0).contains(&seconds) {
        Ok((seconds / session.tick()).round() as u32)
    } else {
        Err(Error::new(format_args!("wait = {seconds} s: must be 0 to 3600 s")))
    }
}

fn said(answer: &Answer) -> String {
    match answer {
        Answer::Accepted(tick) => format!("accepted before tick {tick}"),
        Answer::Refused(why) | Answer::Full(why) => format!("refused: {why}"),
        Answer::Status(status) => format!(
            "{:?}; a tick costs {} instructions, {} at worst; {} us late at most, {} missed, {} \
             early, {} overruns, {} dropped, {} garbled; stack {} bytes",
            status.mode,
            status.cost,
            status.worst,
            status.late,
            status.missed,
            status.early,
            status.overruns,
            status.dropped,
            status.garbled,
            status.stack
        ),
        Answer::Recording(column) => format!("recording {column}"),
        Answer::Recorded { samples, lost } => format!("{samples} samples, {lost} lost"),
    }
}

fn modes(session: &Session) -> String {
    let modes = (0..session.axes()).filter_map(|axis| {
        let replica = session.replica(axis)?;
        let angle = session.history(axis).last()?.setpoint.angle.radians();
        Some(format!("axis {axis} {} at {angle:.4} rad", Mode(replica)))
    });
    modes.collect::<Vec<_>>().join(", ")
}

/// The mode in lower case.
struct Mode<'a>(&'a super::Replica);

impl fmt::Display for Mode<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&format!("{:?}", self.0.mode()).to_lowercase())
    }
}
