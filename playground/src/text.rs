//! A text of fixed capacity, for the page to read.

use core::fmt::{Display, Write};

/// Most bytes of a text. The longest refusal of the core has half of them.
const CAPACITY: usize = 512;

/// A text in UTF-8. What does not fit is cut at a character.
#[derive(Clone, Debug)]
pub struct Text {
    bytes: [u8; CAPACITY],
    len: usize,
}

impl Text {
    /// No text.
    pub const EMPTY: Self = Self { bytes: [0; CAPACITY], len: 0 };

    /// Formats a value.
    pub fn of(value: &dyn Display) -> Self {
        let mut text = Self::EMPTY;
        // What is cut is no error.
        let _ = write!(text, "{value}");
        text
    }

    /// Address of the first byte.
    pub fn as_ptr(&self) -> *const u8 {
        self.bytes.as_ptr()
    }

    /// Number of bytes.
    pub fn len(&self) -> usize {
        self.len
    }
}

impl Write for Text {
    fn write_str(&mut self, words: &str) -> core::fmt::Result {
        for letter in words.chars() {
            let end = self.len + letter.len_utf8();
            let Some(place) = self.bytes.get_mut(self.len..end) else {
                return Err(core::fmt::Error);
            };
            letter.encode_utf8(place);
            self.len = end;
        }
        Ok(())
    }
}
