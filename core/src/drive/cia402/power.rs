//! CiA 402's power drive state machine: from the statusword to the next controlword.

use super::status::Status;
use crate::drive::Condition;

/// State of the drive, as its statusword (0x6041) tells it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum State {
    /// The drive starts up by itself.
    NotReadyToSwitchOn,
    /// Off.
    SwitchOnDisabled,
    /// Off; high voltage may be applied.
    ReadyToSwitchOn,
    /// The power stage is on, without torque.
    SwitchedOn,
    /// The drive follows its setpoints.
    OperationEnabled,
    /// The drive brakes by itself.
    QuickStopActive,
    /// The drive reacts to a fault by itself.
    FaultReactionActive,
    /// Off, until the fault is reset.
    Fault,
}

/// The state that the state machine is to reach.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Operation enabled. A fault is left as it is.
    On,
    /// Ready to switch on.
    Off,
    /// Faults reset, and off.
    Reset,
}

const DISABLE_VOLTAGE: u16 = 0x0000;
const SHUTDOWN: u16 = 0x0006;
const SWITCH_ON: u16 = 0x0007;
const ENABLE_OPERATION: u16 = 0x000f;
const FAULT_RESET: u16 = 0x0080;

/// Cyclic synchronous position, in 0x6060 and 0x6061.
const CYCLIC_SYNCHRONOUS_POSITION: i8 = 8;

/// The master's side of the state machine, one step a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PowerDrive {
    /// True if the last controlword held the reset's bit: a reset is its rising edge.
    resetting: bool,
}

/// The frames of one cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    /// 0x6040.
    pub controlword: u16,
    /// 0x607A that is to be sent in place of the setpoint's: the actual position, until the drive
    /// follows. It is then enabled without a jump.
    pub hold: Option<i32>,
}

impl State {
    /// The state in a statusword. `None` for a pattern that the profile does not have.
    pub fn of(statusword: u16) -> Option<Self> {
        Some(match (statusword & 0x4f, statusword & 0x6f) {
            (0x00, _) => Self::NotReadyToSwitchOn,
            (0x40, _) => Self::SwitchOnDisabled,
            (_, 0x21) => Self::ReadyToSwitchOn,
            (_, 0x23) => Self::SwitchedOn,
            (_, 0x27) => Self::OperationEnabled,
            (_, 0x07) => Self::QuickStopActive,
            (0x0f, _) => Self::FaultReactionActive,
            (0x08, _) => Self::Fault,
            _ => return None,
        })
    }

    /// The condition. Of a fault the number is 0; [`super::Emergency`] has the code.
    pub fn condition(self) -> Condition {
        match self {
            Self::SwitchOnDisabled | Self::ReadyToSwitchOn => Condition::Off,
            Self::OperationEnabled => Condition::On,
            Self::Fault | Self::FaultReactionActive => Condition::Fault(0),
            Self::NotReadyToSwitchOn | Self::SwitchedOn | Self::QuickStopActive => Condition::Busy,
        }
    }
}

impl PowerDrive {
    /// Returns what is to be sent in answer to a status. One transition is asked for at a time.
    ///
    /// Operation is not enabled before 0x6061 says that the drive is in cyclic synchronous
    /// position: in another mode it would take the target for something else.
    pub fn step(&mut self, status: &Status, wanted: Wanted) -> Step {
        let state = State::of(status.statusword);
        let in_mode = status.mode == CYCLIC_SYNCHRONOUS_POSITION;
        let mut controlword = match (wanted, state) {
            (Wanted::Reset, Some(State::Fault)) if !self.resetting => FAULT_RESET,
            (Wanted::On, Some(State::SwitchOnDisabled)) => SHUTDOWN,
            (Wanted::On, Some(State::ReadyToSwitchOn)) => SWITCH_ON,
            (Wanted::On, Some(State::SwitchedOn)) if in_mode => ENABLE_OPERATION,
            (Wanted::On, Some(State::SwitchedOn)) => SWITCH_ON,
            (Wanted::On, Some(State::OperationEnabled)) if in_mode => ENABLE_OPERATION,
            (_, Some(State::QuickStopActive | State::Fault | State::FaultReactionActive)) => {
                DISABLE_VOLTAGE
            }
            (_, Some(State::NotReadyToSwitchOn) | None) => DISABLE_VOLTAGE,
            _ => SHUTDOWN,
        };
        if self.resetting {
            controlword &= !FAULT_RESET;
        }
        self.resetting = controlword & FAULT_RESET != 0;
        let follows = controlword == ENABLE_OPERATION && state == Some(State::OperationEnabled);
        Step { controlword, hold: (!follows).then_some(status.position) }
    }
}
