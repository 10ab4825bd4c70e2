//! Blocks of a page that a command writes: between `<!-- lab:NAME -->` and `<!-- /lab -->`, each on
//! a line of its own. The text around them is written by hand.

use stillbeam_sim::error::Error;

const END: &str = "<!-- /lab -->";

/// A block of a page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Block {
    /// Name in the marker.
    pub name: String,
    /// Lines between the markers.
    pub text: String,
}

impl Block {
    /// Creates a block of a name and a text.
    pub fn new(name: impl Into<String>, text: String) -> Self {
        Self { name: name.into(), text }
    }
}

/// A line that differs between a page and the same page written anew.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Number of the line, from 1.
    pub line: usize,
    /// The line on the page; `None` if the page ends before it.
    pub old: Option<String>,
    /// The line as it is now; `None` if the page written anew ends before it.
    pub new: Option<String>,
}

/// Returns the page with each block in its place.
///
/// # Errors
/// An error is returned if the markers of a block are missing or wrong. It names the block.
pub fn fill(page: &str, blocks: &[Block]) -> Result<String, Error> {
    let mut page = page.to_owned();
    for Block { name, text } in blocks {
        let (begin, end) = place(&page, name)?;
        let text = text.trim_end_matches('\n');
        page.replace_range(begin..end, &format!("\n{text}\n"));
    }
    Ok(page)
}

/// Returns the text between the markers of a block on the page.
///
/// # Errors
/// Errors are those of [`fill`].
pub fn block<'a>(page: &'a str, name: &str) -> Result<&'a str, Error> {
    let (begin, end) = place(page, name)?;
    Ok(page[begin..end].trim_start_matches('\n'))
}

/// True if the page has a marker of that name.
pub fn has(page: &str, name: &str) -> bool {
    page.contains(&start(name))
}

/// Finds the first line in which two texts differ. A text that goes on after the end of the other
/// differs too.
pub fn difference(old: &str, new: &str) -> Option<Difference> {
    let (mut olds, mut news) = (old.lines(), new.lines());
    for line in 1.. {
        match (olds.next(), news.next()) {
            (None, None) => break,
            (old, new) if old == new => {}
            (old, new) => {
                let [old, new] = [old, new].map(|line| line.map(str::to_owned));
                return Some(Difference { line, old, new });
            }
        }
    }
    None
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [old, new] = [&self.old, &self.new].map(|line| line.as_deref().unwrap_or("(no line)"));
        write!(f, "{}: {old} is now {new}", self.line)
    }
}

fn start(name: &str) -> String {
    format!("<!-- lab:{name} -->")
}

/// Returns the bytes between the two markers.
fn place(page: &str, name: &str) -> Result<(usize, usize), Error> {
    let start = start(name);
    let missing = || {
        Error::new(format_args!(
            "lab:{name}: not on the page; must be there, between a line {start} and a line {END}"
        ))
    };
    let begin = page.find(&start).ok_or_else(missing)? + start.len();
    let length = page[begin..].find(END).ok_or_else(missing)?;
    if page[begin..begin + length].contains("<!-- lab:") {
        return Err(Error::new(format_args!(
            "lab:{name}: another block begins in it; there must be a line {END} before that"
        )));
    }
    Ok((begin, begin + length))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# T\n<!-- lab:a -->\nold\n<!-- /lab -->\n\n<!-- lab:b -->\n<!-- /lab -->\n";

    #[test]
    fn blocks_are_filled_by_name() {
        let blocks = [Block::new("b", "2\n3\n".into()), Block::new("a", "1".into())];
        let filled = fill(PAGE, &blocks).unwrap();
        let wanted =
            "# T\n<!-- lab:a -->\n1\n<!-- /lab -->\n\n<!-- lab:b -->\n2\n3\n<!-- /lab -->\n";
        assert_eq!(filled, wanted);
        assert_eq!(fill(&filled, &blocks).unwrap(), filled);
        assert_eq!(block(&filled, "b").unwrap(), "2\n3\n");
        assert!(has(PAGE, "a") && !has(PAGE, "c"));
    }

    #[test]
    fn markers_that_do_not_fit_are_refused() {
        for page in ["none", "<!-- lab:a -->", "<!-- lab:a -->\n<!-- lab:b -->\n<!-- /lab -->"] {
            let error = fill(page, &[Block::new("a", String::new())]).unwrap_err().to_string();
            assert!(error.starts_with("lab:a: ") && error.contains("must "), "{error}");
        }
    }

    /// A table that has lost or gained its last line is another table.
    #[test]
    fn a_change_of_length_is_a_difference() {
        assert_eq!(difference("a\nb\n", "a\nb\n"), None);
        let changed = difference("a\nb\n", "a\nc\n").unwrap();
        assert_eq!(changed.to_string(), "2: b is now c");
        let shorter = difference("a\nb\n", "a\n").unwrap();
        assert_eq!(shorter.to_string(), "2: b is now (no line)");
        let longer = difference("a\n", "a\nb\n").unwrap();
        assert_eq!((longer.line, longer.new.as_deref()), (2, Some("b")));
    }
}
