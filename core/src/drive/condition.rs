//! The condition of a drive, in one word for every protocol.

/// A drive's report of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Condition {
    /// The power stage is off. The drive can be switched on.
    Off,
    /// On its way between off and on, or busy with something else than the setpoints.
    Busy,
    /// The drive follows its setpoints.
    On,
    /// The drive has switched itself off, with the protocol's own number for the reason.
    Fault(u32),
}
