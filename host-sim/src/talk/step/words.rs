//! The words of a step.

use std::str::FromStr;

use stillbeam::motion::{Spline, Waypoint};
use stillbeam::{Payload, PlainMove, Profile};
use stillbeam_protocol::{Change, Command};

use super::Step;
use crate::error::Error;

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
            Command::Still { to, duration: optional(words)? }
        }
        "spin" => {
            let (duration, rate) = (number(words.next())?, number(words.next())?);
            Command::Move(PlainMove::SpinUp { duration, rate })
        }
        "target" => {
            let (angle, duration) = (number(words.next())?, number(words.next())?);
            let rate = optional(words)?.unwrap_or(0.0);
            Command::Change(Change::Target { angle, rate, duration })
        }
        "duration" => Command::Change(Change::Duration(number(words.next())?)),
        "path" => Command::Path(Spline::named(words.next()?)?),
        "row" | "last" => {
            let (time, angle) = (number(words.next())?, number(words.next())?);
            let row = Waypoint { rate: optional(words)?, ..Waypoint::at(time, angle) };
            Command::Waypoint { row, last: verb == "last" }
        }
        "hold" => Command::Change(Change::Hold),
        "cancel" => Command::Change(Change::Cancel),
        "dwell" => Command::Move(PlainMove::Dwell { duration: number(words.next())? }),
        "payload" => {
            let mass = number(words.next())?;
            let inertia = optional(words)?.unwrap_or(0.0);
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

/// Parses a number that may be left away. `None` for what is no number.
fn optional<'a>(words: &mut impl Iterator<Item = &'a str>) -> Option<Option<f64>> {
    match words.next() {
        Some(word) => number(Some(word)).map(Some),
        None => Some(None),
    }
}
