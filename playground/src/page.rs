//! The one page's memory.

use core::cell::UnsafeCell;

use crate::arm::{Arm, FACTS};
use crate::input;
use crate::motion::{Kind, Motion, Refusal};
use crate::setpoints::Rows;
use crate::shape::{POINTS, Points};
use crate::text::Text;

/// All that the module keeps between calls.
#[derive(Debug)]
pub struct Page {
    pub input: [f64; input::LENGTH],
    pub facts: [f64; FACTS],
    pub text: Text,
    pub arm: Option<Arm>,
    pub motions: [Result<Motion, Refusal>; Kind::COUNT],
    pub shape: Points,
}

impl Page {
    const EMPTY: Self = Self {
        input: [0.0; input::LENGTH],
        facts: [0.0; FACTS],
        text: Text::EMPTY,
        arm: None,
        motions: [const { Err(Refusal::NotSetUp) }; Kind::COUNT],
        shape: [[0.0; 2]; POINTS],
    };

    /// Leaves the reason of a refusal as the text. Returns true if there is none.
    pub fn settle(&mut self, done: Result<(), Refusal>) -> bool {
        self.text = done.as_ref().err().map_or(Text::EMPTY, |refusal| Text::of(refusal));
        done.is_ok()
    }

    /// Leaves the reason of a refusal as the text. Returns the count, or 0.
    pub fn counted(&mut self, count: Result<usize, Refusal>) -> usize {
        let found = *count.as_ref().unwrap_or(&0);
        self.settle(count.map(drop));
        found
    }
}

/// The rows of each motion, and those of a run of which only the residual is asked for. Apart from
/// the rest, and zero at first, so that the module's file does not hold them.
#[derive(Debug)]
pub struct Tables {
    pub rows: [Rows; Kind::COUNT],
    pub scratch: Rows,
}

impl Tables {
    const EMPTY: Self = Self { rows: [Rows::EMPTY; Kind::COUNT], scratch: Rows::EMPTY };
}

struct Shared<T>(UnsafeCell<T>);

// SAFETY: the module has one thread. It imports no function, so that no call from the page comes
// in while another is under way.
unsafe impl<T> Sync for Shared<T> {}

static PAGE: Shared<Page> = Shared(UnsafeCell::new(Page::EMPTY));
static TABLES: Shared<Tables> = Shared(UnsafeCell::new(Tables::EMPTY));

/// Hands the page's memory to an action. Not to be called within an action.
pub fn with<R>(action: impl FnOnce(&mut Page, &mut Tables) -> R) -> R {
    // SAFETY: one thread and no call within a call, see above; the references end with the action.
    unsafe { action(&mut *PAGE.0.get(), &mut *TABLES.0.get()) }
}
