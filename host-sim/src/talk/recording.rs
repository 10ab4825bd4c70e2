//! A log of the board: the firmware samples hub angle and sensor while it makes a motion that is
//! fit for identification.

use std::collections::VecDeque;
use std::io::{self, Write};

use stillbeam::{PlainMove, Scene};
use stillbeam_protocol::{Command, Sample};

use super::{Answer, Excitation, Session};
use crate::arm::natural;
use crate::error::Error;
use crate::table::significant;

/// Moves that wait in the firmware's queue at most: a cubic takes one of eight segments.
const AHEAD: usize = 4;

/// Time at rest before the first move, s.
const BEFORE: f64 = 0.1;

/// Longest motion, s. Beyond 71 minutes the samples' times would begin anew.
const LONGEST: f64 = 3600.0;

/// A recording of one axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Name of the sensor's column.
    pub column: String,
    /// Rows as they came.
    pub samples: Vec<Sample>,
    /// Samples that the line was too slow for, or that found no hub angle.
    pub lost: u32,
}

impl Recording {
    /// Writes the rows as CSV: `t_s`, `hub_angle_rad` and the sensor's column. What was lost is a
    /// gap in the times.
    ///
    /// # Errors
    /// Errors are those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        csv.write_record(["t_s", "hub_angle_rad", &self.column])?;
        for Sample { time, hub, value } in &self.samples {
            let seconds = format!("{}.{:06}", time / 1_000_000, time % 1_000_000);
            let hub = significant(hub.radians(), 9).to_string();
            csv.write_record([seconds, hub, value.to_string()])?;
        }
        csv.flush()
    }
}

/// Switches an axis on, records it while it makes the motion, and switches it off. `turn` is the
/// largest angle of the hub, rad; what [`Excitation::moves`] says if none is given.
///
/// # Errors
/// An axis that does not exist, a turn that the limits do not allow, a request that the firmware
/// refuses, samples that do not come. Others are those of [`Session::ask`]. The axis is switched
/// off if it was switched on.
pub fn record(
    session: &mut Session,
    axis: u8,
    excitation: Excitation,
    turn: Option<f64>,
) -> Result<Recording, Error> {
    let moves = moves(session, axis, excitation, turn)?;
    demand(session, axis, "enable", Command::Enable)?;
    let recorded = along(session, axis, &moves);
    let off = demand(session, axis, "disable", Command::Disable).and_then(|_| session.wait(1));
    recorded.and_then(|recording| off.map(|()| recording))
}

/// Plans the motion from the arm's description, for a hub at 0 rad.
fn moves(
    session: &Session,
    axis: u8,
    excitation: Excitation,
    turn: Option<f64>,
) -> Result<Vec<PlainMove>, Error> {
    let replica = session.replica(axis).ok_or_else(|| {
        let last = session.axes().saturating_sub(1);
        Error::new(format_args!("--axis = {axis}: must be 0 to {last}"))
    })?;
    let [frequency, ..] = natural::frequencies(&Scene::from(*replica.scene()))?;
    let moves = excitation.moves(frequency, replica.limits(), turn)?;
    let length: f64 = moves.iter().map(PlainMove::duration).sum();
    if length > LONGEST {
        return Err(Error::new(format_args!(
            "--record: the motion of an arm of {frequency} Hz takes {length} s; must be at most \
             {LONGEST} s"
        )));
    }
    Ok(moves)
}

/// Records an enabled axis while it makes the moves.
fn along(session: &mut Session, axis: u8, moves: &[PlainMove]) -> Result<Recording, Error> {
    // The first setpoint tells where the hub is.
    session.wait(1)?;
    let begin = session.history(axis).last().map_or(0.0, |tick| tick.setpoint.angle.radians());
    session.keep_samples(axis);
    let Answer::Recording(column) = demand(session, axis, "record", Command::Record(true))? else {
        return Err(Error::new("firmware: no recording has begun"));
    };
    session.wait((BEFORE / session.tick()).ceil() as u32)?;
    let made = make(session, axis, moves, begin);
    let ended = demand(session, axis, "record", Command::Record(false));
    made?;
    let Answer::Recorded { samples: sent, lost } = ended? else {
        return Err(Error::new("firmware: no recording has ended"));
    };
    let samples = session.take_samples();
    if samples.len() != sent as usize {
        return Err(Error::new(format_args!(
            "--record: {} samples came of {sent} that were sent; must be all of them: look after \
             the line",
            samples.len()
        )));
    }
    Ok(Recording { column, samples, lost })
}

/// Makes moves one behind the other, as many waiting as the queue has room for, and goes on until
/// the last is over. Their angles count from `begin`, rad.
fn make(session: &mut Session, axis: u8, moves: &[PlainMove], begin: f64) -> Result<(), Error> {
    let h = session.tick();
    let (mut ends, mut end) = (VecDeque::new(), session.now());
    for motion in moves {
        if ends.len() == AHEAD {
            let first: u32 = ends.pop_front().unwrap_or(0);
            session.wait(first.saturating_sub(session.now()))?;
        }
        demand(session, axis, "move", Command::Move(from(begin, *motion)))?;
        end = end.max(session.now()) + (motion.duration() / h).ceil() as u32;
        ends.push_back(end);
    }
    session.wait(end.saturating_sub(session.now()) + 1)
}

/// Returns the move of a hub that was at `begin` rad instead of 0.
fn from(begin: f64, motion: PlainMove) -> PlainMove {
    match motion {
        PlainMove::To { profile, duration, to } => {
            PlainMove::To { profile, duration, to: begin + to }
        }
        other => other,
    }
}

/// Sends a request, named by `what`, that must be accepted.
fn demand(session: &mut Session, axis: u8, what: &str, command: Command) -> Result<Answer, Error> {
    match session.ask(axis, command)? {
        Answer::Refused(why) | Answer::Full(why) => {
            Err(Error::new(format_args!("--record: {what} {axis} was refused: {why}")))
        }
        answer => Ok(answer),
    }
}
