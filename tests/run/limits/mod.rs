//! Limits on what is commanded: shaped or not, between the ticks, by the arm that the motor feels.

mod kinematic;
mod loads;

use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};

const LINK: &str = "[link]\nlength = 0.4\nmass = 0.0224\nbending_stiffness = 0.46\n";

const PAYLOAD: &str = "[payload]\nmass = 0.03\n";

fn parse(text: &str) -> Result<SceneFile, String> {
    SceneFile::parse("test", text).map_err(|error| error.to_string())
}

/// The number behind a word of a message.
fn number_after(text: &str, word: &str) -> f64 {
    let rest = text.split(word).nth(1).unwrap_or_else(|| panic!("{word} is not in: {text}"));
    let end = rest.find(|c: char| !"0123456789.e-".contains(c)).unwrap_or(rest.len());
    rest[..end].parse().unwrap_or_else(|_| panic!("no number after {word} in: {text}"))
}

fn elastica(tick: f64) -> Solver {
    Solver { method: Method::Elastica, tick, ..Solver::default() }
}
