//! Kinds of faults to be injected.

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// No fault, which shows how often the same traffic is accepted without one.
    None,
    /// Frames lose their end or are lost, and the line goes dead for up to a second.
    Cut,
    /// Bits flip and bytes are inserted.
    Garbled,
    /// Frames overtake each other by up to 20 ticks.
    Reordered,
    /// Frames come up to four times, at once or later.
    Duplicated,
    /// Frames are whole but their numbers are not: not finite, absurd, or of a still move whose
    /// bulge no drive could follow.
    Nonsense,
    /// Ticks come late by up to a period.
    LateTicks,
    /// Up to nine ticks in a row do not take place.
    MissedTicks,
    /// More moves at once than the queue holds.
    Overfull,
    /// The payload changes at any time, to any value.
    Payload,
    /// At power-up the line holds garbage, the drive reports garbage, the counter stands anywhere.
    PowerUp,
    /// The frames between board and drive are altered.
    Drive,
    /// After a freeze of up to ten periods the ticks that were missed come all at once.
    Bursts,
}

impl Fault {
    /// Every kind, in the order of the table.
    pub const ALL: [Self; 13] = [
        Self::None,
        Self::Cut,
        Self::Garbled,
        Self::Reordered,
        Self::Duplicated,
        Self::Nonsense,
        Self::LateTicks,
        Self::MissedTicks,
        Self::Overfull,
        Self::Payload,
        Self::PowerUp,
        Self::Drive,
        Self::Bursts,
    ];

    /// Returns the name in the table.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Cut => "stream cut",
            Self::Garbled => "stream garbled",
            Self::Reordered => "frames reordered",
            Self::Duplicated => "frames duplicated",
            Self::Nonsense => "nonsense in whole frames",
            Self::LateTicks => "ticks late",
            Self::MissedTicks => "ticks missed",
            Self::Overfull => "queue overfull",
            Self::Payload => "payload changed any time",
            Self::PowerUp => "garbage at power-up",
            Self::Drive => "drive's frames altered",
            Self::Bursts => "ticks in bursts",
        }
    }
}
