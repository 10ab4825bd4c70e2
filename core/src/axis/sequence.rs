//! Sequence numbers: how a receiver tells a fresh setpoint from a stale one.

/// Number of the tick that a payload belongs to, modulo 2¹⁶: 655 s at 10 ms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sequence(pub u16);

/// Place of a sequence number relative to the last one accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Freshness {
    /// The next one.
    Next,
    /// A later one. The field counts the numbers missing in between.
    Skipped(u16),
    /// The same again: nothing new has been computed.
    Repeated,
    /// An earlier one. To be dropped.
    Stale,
}

impl Sequence {
    /// The next number.
    pub fn next(self) -> Self {
        Self(self.0.wrapping_add(1))
    }

    /// Returns the place of `self` relative to `last`. Half of the numbers are ahead of any other,
    /// half behind: serial number arithmetic as in RFC 1982.
    pub fn after(self, last: Self) -> Freshness {
        match self.0.wrapping_sub(last.0) {
            0 => Freshness::Repeated,
            1 => Freshness::Next,
            ahead @ 2..0x8000 => Freshness::Skipped(ahead - 1),
            _ => Freshness::Stale,
        }
    }
}
