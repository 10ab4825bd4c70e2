//! How finely a tick is made.

use core::fmt;

use crate::math::{Words, named, read};

/// Amount of work in a tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// One evaluation of the remainder a tick.
    Fast,
    /// Two half-steps.
    Fine,
}

impl fmt::Display for Quality {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Fast => "fast",
            Self::Fine => "fine",
        })
    }
}

impl Words for Quality {
    const LAYOUT: u32 = named("Quality");
    const BLANK: Self = Self::Fast;

    fn put(&self, sink: &mut dyn FnMut(u32)) {
        (*self == Self::Fine).put(sink);
    }

    fn fill(&mut self, source: &mut dyn FnMut() -> u32) {
        *self = if read(source) { Self::Fine } else { Self::Fast };
    }
}
