//! The remedy for a limit that a move exceeds. It is separate from the error, so that a target
//! which asks for no remedy does not link the search for one.

use core::fmt;

/// A change that would keep a limit which a move exceeds, or the reason why no duration does.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Remedy {
    /// This duration, s: the shortest whole number of ticks that keeps every limit.
    Duration(f64),
    /// A longer duration; how long is not known to the layer that refuses.
    Longer,
    /// No duration: the acceleration jumps, so its jerk is infinite. Another profile does.
    Smoother,
    /// No duration: the move ends at this rate, rad/s, or begins with it.
    Slower(f64),
    /// No duration: holding the arm against its weight on the way takes this much, N m.
    Weight(f64),
    /// No duration up to the longest that a move may have, s.
    Nearer(f64),
}

impl fmt::Display for Remedy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Duration(duration) => write!(f, "a duration of {} s fits", Plain(duration)),
            Self::Longer => write!(f, "use a longer move or raise the limit"),
            Self::Smoother => write!(
                f,
                "the acceleration jumps, so no duration helps; use quintic, cycloid, s-curve or still"
            ),
            Self::Slower(rate) => {
                write!(f, "the hub turns at {} rad/s at an end, so no duration helps", Plain(rate))
            }
            Self::Weight(held) => write!(
                f,
                "holding the arm against its weight takes {held:.6} N m on the way, so no duration helps"
            ),
            Self::Nearer(longest) => {
                let longest = Plain(longest);
                write!(f, "no duration up to {longest} s helps; turn by less or raise the limit")
            }
        }
    }
}

/// A number without the digits that binary arithmetic adds: 0.71, not 0.7100000000000001. It is
/// displayed in the fewest decimals, nine at most, that are right to 1e-9 of it.
struct Plain(f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, mut power, mut decimals) = (self.0, 1.0, 0);
        while decimals < 9 && libm::fabs(libm::round(x * power) / power - x) > 1e-9 * libm::fabs(x)
        {
            power *= 10.0;
            decimals += 1;
        }
        write!(f, "{x:.decimals$}")
    }
}
