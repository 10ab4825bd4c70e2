//! Mechanisms that are embedded in the program, by name.

use std::path::Path;

use super::{MechanismScene, is_mechanism};
use crate::error::Error;

macro_rules! embedded {
    ($($name:literal: $about:literal,)*) => {
        /// Embedded mechanisms: `(name, description, text of the file)`.
        const EMBEDDED: &[(&str, &str, &str)] =
            &[$(($name, $about, include_str!(concat!("../../scenes/", $name, ".toml"))),)*];
    };
}

embedded! {
    "two-links": "mechanism: two flexible links (member D), a motor of 50 g at the elbow",
    "forearm": "mechanism: a rigid upper arm and a flexible forearm (member D), fast",
    "four-bar": "mechanism: crank, coupler and rocker on two pivots; the crank turns once",
    "latch": "mechanism: an arm of three links that closes on a pivot while it runs",
}

/// Returns name and description of every embedded mechanism.
pub fn list() -> impl Iterator<Item = (&'static str, &'static str)> {
    EMBEDDED.iter().map(|&(name, about, _)| (name, about))
}

/// Opens an embedded mechanism by name, or a scene file of a mechanism by path. Returns `None` for
/// anything else, which may be the scene of a single link.
pub fn open(name_or_path: &str) -> Result<Option<MechanismScene>, Error> {
    if let Some((name, _, text)) = EMBEDDED.iter().find(|entry| entry.0 == name_or_path) {
        return MechanismScene::parse(name, text).map(Some);
    }
    match std::fs::read_to_string(Path::new(name_or_path)) {
        Ok(text) if is_mechanism(&text) => MechanismScene::parse(name_or_path, &text).map(Some),
        _ => Ok(None),
    }
}
