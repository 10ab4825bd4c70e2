//! Texts with parts that a command writes: between `<!-- PAGE:NAME -->` and `<!-- /PAGE -->`.

use stillbeam_sim::error::Error;

/// The text with each block, a name and what it holds, in its place.
///
/// # Errors
/// A marker that is missing, by its name.
pub fn fill(text: &str, page: &str, blocks: &[(String, String)]) -> Result<String, Error> {
    let end = format!("<!-- /{page} -->");
    let mut text = text.to_owned();
    for (name, block) in blocks {
        let start = format!("<!-- {page}:{name} -->");
        let missing =
            || Error::new(format_args!("{name}: must be a text with {start} and {end} after it"));
        let begin = text.find(&start).ok_or_else(missing)? + start.len();
        let length = text[begin..].find(&end).ok_or_else(missing)?;
        text.replace_range(begin..begin + length, &format!("\n{block}"));
    }
    Ok(text)
}

/// The first line that is another in the second text.
pub fn difference<'a>(old: &'a str, new: &'a str) -> Option<(&'a str, &'a str)> {
    old.lines().zip(new.lines()).find(|(old, new)| old != new)
}
