//! The paths of a tick that cost differently, in the order of the instruction table's columns.

/// One path of a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Path {
    /// Words for it in the bench's lines; none for the plain tick.
    pub words: &'static str,
    /// Name of its column in the table.
    pub column: &'static str,
}

/// Inside a move; taking up the next segment of a move, the hub turning or `still`; taking up the
/// hold after the last, likewise; holding a rate; at rest, the arm ringing; at rest and asleep.
pub const PATHS: [Path; 8] = [
    Path { words: "", column: "tick" },
    Path { words: "next-segment", column: "next_segment" },
    Path { words: "next-segment still", column: "next_segment_still" },
    Path { words: "landing", column: "landing" },
    Path { words: "landing still", column: "landing_still" },
    Path { words: "cruise", column: "cruise" },
    Path { words: "at-rest", column: "at_rest" },
    Path { words: "at-rest asleep", column: "asleep" },
];
