//! Faults that are put into the loop.

use stillbeam::axis::Cause;

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
    /// The drive switches itself off, with a brake, and its heartbeat says so.
    DriveFault,
    /// The bus is cut: nothing comes from the drive or reaches it, and its watchdog switches it
    /// off.
    BusCut,
}

impl Fault {
    /// Every fault, in the order of the table.
    pub const ALL: [Self; 9] = [
        Self::None,
        Self::Stop,
        Self::LinkCut,
        Self::MissedTicks,
        Self::LostSetpoints,
        Self::EncoderJump,
        Self::Saturation,
        Self::DriveFault,
        Self::BusCut,
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
            Self::BusCut => "bus cut",
        }
    }

    /// Reason for which the axis has to stop on its way, if it has to.
    pub fn cause(self) -> Option<Cause> {
        match self {
            Self::None | Self::LostSetpoints | Self::EncoderJump | Self::Saturation => None,
            Self::Stop => Some(Cause::Requested),
            Self::LinkCut => Some(Cause::LinkLost),
            Self::MissedTicks => Some(Cause::MissedTicks),
            Self::DriveFault => Some(Cause::DriveFault),
            Self::BusCut => Some(Cause::DriveLost),
        }
    }
}
