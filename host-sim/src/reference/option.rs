//! The ranges of solvers' options.

use super::ReferenceError;

/// Refuses a value that is not within `min` to `max`; `wanted` says the range in words.
pub(super) fn within(
    name: &str,
    value: f64,
    [min, max]: [f64; 2],
    wanted: &'static str,
) -> Result<(), ReferenceError> {
    if (min..=max).contains(&value) {
        return Ok(());
    }
    Err(ReferenceError::Options { given: format!("{name} = {value}"), wanted })
}
