//! Conversations that are ready to be held.

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
