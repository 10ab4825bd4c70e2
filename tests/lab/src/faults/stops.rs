//! Stops the board at every tick of a move, for every cause.

use stillbeam::axis::{Cause, Mode};
use stillbeam::planner::{Planner, Request};
use stillbeam::{PlainMove, Profile};
use stillbeam_board::machine::{CONFIGURATIONS, Configuration, TICK, ticks};
use stillbeam_board::{Board, Drive, PERIOD, Watch};
use stillbeam_protocol::Command;

use super::Outcome;
use stillbeam_sim::error::Error;

/// Ticks of the moves, 1.2 s, and a few after them.
const TICKS: u32 = ticks(1.3);

/// Returns moves of every profile, a spin-up and its end, and a still move if it can be planned.
/// Each has another move waiting behind it.
fn moves(configuration: &Configuration) -> Result<Vec<PlainMove>, Error> {
    let mut moves =
        Profile::ALL.map(|p| PlainMove::To { profile: p, duration: 1.2, to: 1.5 }).to_vec();
    moves.push(PlainMove::SpinUp { duration: 1.0, rate: 0.8 * 5.0 });
    let planner = Planner::<f32, 2>::new(&configuration.scene, TICK)?;
    let duration = 1.2_f64.max(2.0 * planner.first_period());
    let request = Request::from_rest(0.0, 1.0).duration(duration).any_deflection();
    moves.push(planner.plan(&request)?.plain());
    Ok(moves)
}

/// Runs all stops and returns their outcome.
pub fn all() -> Result<Outcome, Error> {
    let mut outcome = Outcome::default();
    for configuration in &CONFIGURATIONS {
        for motion in moves(configuration)? {
            for cause in [Cause::Requested, Cause::LinkLost, Cause::MissedTicks] {
                for at in 1..TICKS {
                    outcome.add(one(configuration, motion, cause, at)?);
                }
            }
        }
    }
    Ok(outcome)
}

fn one(
    configuration: &Configuration,
    motion: PlainMove,
    cause: Cause,
    at: u32,
) -> Result<Outcome, Error> {
    let mut configuration = *configuration;
    if cause == Cause::LinkLost {
        configuration.policy.patience = f64::from(at) * TICK;
    }
    let mut board = Board::new(&configuration, 0)?;
    let mut watch = Watch::new(&configuration.policy.limits, configuration.joint.ratio, TICK);
    let mut drive = Drive::at(0.125);
    let mut now = 0_u32;
    board.hear_drive(&drive.report(board.node()));
    board.ask(Command::Home(0.0));
    board.ask(Command::Enable);
    board.ask(Command::Move(motion));
    board.ask(Command::Move(PlainMove::To { profile: Profile::Cubic, duration: 1.5, to: 0.3 }));
    for k in 0..at + 400 {
        if k == at && cause == Cause::Requested {
            board.ask(Command::Stop);
        }
        now += if k == at && cause == Cause::MissedTicks { 5 * PERIOD } else { PERIOD };
        if cause != Cause::LinkLost {
            board.ask(Command::Heartbeat);
        }
        // Every tick comes in time here.
        let Some(step) = board.tick(now) else { continue };
        watch.see(&step);
        drive.follow(&step);
    }
    let mut outcome = Outcome::of(&board, &watch);
    outcome.injected = 1;
    if board.axis().mode() != Mode::Stopped || board.axis().cause() != Some(cause) {
        let (mode, cause) = (board.axis().mode(), board.axis().cause());
        outcome.broken.push(format!("stop at tick {at}: ends {mode:?}, {cause:?}"));
    }
    for broken in &mut outcome.broken {
        *broken = format!("{motion:?} stopped at {at}, {cause:?}: {broken}");
    }
    Ok(outcome)
}
