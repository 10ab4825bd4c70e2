//! Faults that are put into the loop.

/// A fault in the middle of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// None: the move is made to its end.
    None,
    /// The host asks for a stop.
    Stop,
    /// The host falls silent.
    LinkCut,
    /// Up to eight ticks do not take place.
    MissedTicks,
    /// One setpoint in three does not reach the drive.
    LostSetpoints,
    /// The encoder jumps by up to a hundredth of a turn.
    EncoderJump,
    /// The motor gives no more than four fifths of the torque that the move takes.
    Saturation,
    /// The drive switches itself off, with a brake, and reports its fault; the host switches the
    /// axis off.
    DriveFault,
}

impl Fault {
    /// Every fault, in the order of the table.
    pub const ALL: [Self; 8] = [
        Self::None,
        Self::Stop,
        Self::LinkCut,
        Self::MissedTicks,
        Self::LostSetpoints,
        Self::EncoderJump,
        Self::Saturation,
        Self::DriveFault,
    ];

    /// Name in the table.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Stop => "stop asked for",
            Self::LinkCut => "link cut",
            Self::MissedTicks => "ticks missed",
            Self::LostSetpoints => "setpoints lost",
            Self::EncoderJump => "encoder jumps",
            Self::Saturation => "motor saturates",
            Self::DriveFault => "drive faults",
        }
    }

    /// True if the axis is to stop on its way.
    pub fn stops(self) -> bool {
        matches!(self, Self::Stop | Self::LinkCut | Self::MissedTicks)
    }
}
