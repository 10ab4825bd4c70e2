//! Traffic of a host: moves within and beyond the limits, changes of mind, and a heartbeat.

use rand::Rng;
use rand::rngs::StdRng;
use stillbeam::motion::BULGE;
use stillbeam::{Limits, Payload, PlainMove, Profile};
use stillbeam_board::EDGES;
use stillbeam_board::machine::ticks;
use stillbeam_protocol::Command;

use super::Fault;

/// Ticks between two heartbeats, 0.1 s. The patience is five of them.
const HEARTBEAT: u32 = ticks(0.1);

/// Returns the commands of tick `k` and the number of them that are the fault itself.
pub fn say(fault: Fault, limits: &Limits, k: u32, rng: &mut StdRng) -> (Vec<Command>, u64) {
    let mut commands = Vec::new();
    // A drive reports first; then the axis is switched on, and on again after stops.
    if k == 3 || (k > 3 && rng.random_bool(0.02)) {
        commands.push(Command::Enable);
    }
    if k.is_multiple_of(HEARTBEAT) {
        commands.push(Command::Heartbeat);
    }
    if rng.random_bool(0.04) {
        commands.push(Command::Move(motion(limits, rng)));
    }
    for (chance, command) in [
        (0.004, Command::Stop),
        (0.003, Command::Disable),
        (0.02, Command::Status),
        (0.002, Command::Still { to: 0.5, duration: None }),
        (0.002, Command::Home(rng.random_range(-3.0..3.0))),
    ] {
        if rng.random_bool(chance) {
            commands.push(command);
        }
    }
    let before = commands.len();
    match fault {
        Fault::Overfull if rng.random_bool(0.02) => {
            let burst = rng.random_range(4..16);
            commands.extend((0..burst).map(|_| Command::Move(motion(limits, rng))));
        }
        Fault::Payload if rng.random_bool(0.1) => commands.push(Command::Payload(payload(rng))),
        Fault::Nonsense if rng.random_bool(0.2) => commands.push(nonsense(rng)),
        _ => {}
    }
    let injected = (commands.len() - before) as u64;
    (commands, injected)
}

/// Draws a move, mostly within the limits.
fn motion(limits: &Limits, rng: &mut StdRng) -> PlainMove {
    let (rate, acceleration) = (limits.rate.unwrap_or(1.0), limits.acceleration.unwrap_or(1.0));
    match rng.random_range(0..10) {
        0 => PlainMove::SpinUp {
            duration: rng.random_range(0.2..1.5),
            rate: rate * rng.random_range(-1.05..1.05),
        },
        1 | 2 => PlainMove::SpinUp { duration: rng.random_range(0.5..1.5), rate: 0.0 },
        3 => PlainMove::Dwell { duration: rng.random_range(0.005..0.5) },
        _ => {
            let profile = Profile::ALL[rng.random_range(0..Profile::ALL.len())];
            let to: f64 = rng.random_range(-3.0..3.0);
            let peaks = profile.peaks(to, 1.0);
            let least = (peaks.rate / rate).max((peaks.acceleration / acceleration).sqrt());
            PlainMove::To { profile, duration: least.max(0.02) * rng.random_range(0.9..2.0), to }
        }
    }
}

fn payload(rng: &mut StdRng) -> Payload {
    let value = |rng: &mut StdRng| match rng.random_range(0..8) {
        0 => any(rng),
        1 => -0.01,
        2 => 1e5,
        _ => rng.random_range(0.0..0.1),
    };
    Payload { mass: value(rng), inertia: 1e-3 * value(rng), offset: 0.0 }
}

/// Draws a number of any bits, one of [`EDGES`], or one from −10 to 10.
pub fn any(rng: &mut StdRng) -> f64 {
    match rng.random_range(0..3) {
        0 => f64::from_bits(rng.random()),
        1 => EDGES[rng.random_range(0..EDGES.len())],
        _ => rng.random_range(-10.0..10.0),
    }
}

/// Draws a command that no sound host sends.
fn nonsense(rng: &mut StdRng) -> Command {
    let profile = Profile::ALL[rng.random_range(0..Profile::ALL.len())];
    match rng.random_range(0..8) {
        0 => Command::Move(PlainMove::To { profile, duration: any(rng), to: any(rng) }),
        1 => Command::Move(PlainMove::SpinUp { duration: any(rng), rate: any(rng) }),
        2 => Command::Move(PlainMove::Dwell { duration: any(rng) }),
        3 => Command::Home(any(rng)),
        4 => Command::Payload(Payload { mass: any(rng), inertia: any(rng), offset: any(rng) }),
        6 => Command::Still { to: any(rng), duration: Some(any(rng)) },
        5 => Command::Move(PlainMove::Still {
            duration: any(rng),
            to: any(rng),
            bulge: core::array::from_fn(|_| any(rng)),
        }),
        // Plausible, but for a bulge that makes it violent.
        _ => Command::Move(PlainMove::Still {
            duration: rng.random_range(0.3..2.0),
            to: rng.random_range(-1.0..1.0),
            bulge: core::array::from_fn::<_, BULGE, _>(|_| rng.random_range(-2.0..2.0)),
        }),
    }
}
