//! The pin that closes a chain to a loop.

use heapless::Vec;

use super::{MAX_LINKS, Mechanism};
use crate::Error;

/// A pin in the ground on which the end of the chain turns freely.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// Where the pin is, or when the chain closes.
    pub begins: Closing,
    /// Joints, counted from 0, whose motors let go when the chain closes.
    pub release: Vec<usize, MAX_LINKS>,
}

/// The beginning of a closure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Closing {
    /// Closed from the beginning on a pin at this place `(x, y)`, m.
    OnPin([f64; 2]),
    /// Closes while it runs, at this time in s, on a pin where the end is then.
    At(f64),
}

impl Closure {
    /// A chain that is a loop from the beginning, its pin at `pin`, m.
    pub const fn on_pin(pin: [f64; 2]) -> Self {
        Self { begins: Closing::OnPin(pin), release: Vec::new() }
    }

    /// A chain that closes at `time` s where its end is then. No joint is released.
    pub const fn at(time: f64) -> Self {
        Self { begins: Closing::At(time), release: Vec::new() }
    }

    pub(super) fn validate(&self, mechanism: &Mechanism) -> Result<(), Error> {
        match self.begins {
            Closing::OnPin(pin) => {
                for place in pin {
                    Error::check("closure.pin", place, -1e4, 1e4, "m")?;
                }
            }
            Closing::At(time) => {
                Error::check("closure.from", time, 0.0, 1e9, "s")?;
            }
        }
        let count = mechanism.links.len();
        for (at, &joint) in self.release.iter().enumerate() {
            // Joints are told to the user counted from 1.
            let number = (joint + 1) as f64;
            Error::check("closure.release", number, 1.0, count as f64, "as the joint's number")?;
            if mechanism.joints[joint].passive || self.release[..at].contains(&joint) {
                return Err(Error::PassiveJoint { parameter: "closure.release", joint: joint + 1 });
            }
        }
        self.check_freedoms(mechanism)
    }

    /// Refuses a loop that has no two freedoms for the pin to take.
    fn check_freedoms(&self, mechanism: &Mechanism) -> Result<(), Error> {
        let free = (0..mechanism.links.len()).filter(|&j| mechanism.is_free_when_closed(j)).count();
        let bends = mechanism.links.iter().filter(|link| link.bends()).count();
        let freedoms = (free + 2 * bends) as f64;
        let unit = "free joints, a link that bends counted twice";
        Error::check("closure", freedoms, 2.0, 3.0 * MAX_LINKS as f64, unit).map(drop)
    }
}
