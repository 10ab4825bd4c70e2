//! The page of the playground: the core in a browser, an arm that bends as it moves.
//!
//! `host-sim/playground/index.html` is one file that needs no network and can be served as it is.
//! Its sources are the crate `playground`; the tests build it anew and compare.

/// The page, HTML.
pub const PAGE: &str = include_str!("../playground/index.html");
