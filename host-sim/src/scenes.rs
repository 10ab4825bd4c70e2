//! Scenes that are embedded in the program, by name.

use std::path::Path;

use crate::error::Error;
use crate::mechanism;
use crate::scene_file::SceneFile;

macro_rules! embedded {
    ($($name:literal: $about:literal,)*) => {
        /// Embedded scenes: `(name, description, text of the file)`.
        const EMBEDDED: &[(&str, &str, &str)] =
            &[$(($name, $about, include_str!(concat!("../scenes/", $name, ".toml"))),)*];
    };
}

embedded! {
    "d-fast": "member D bare, \u{3c0} rad in 0.2 s: the paper's section 3, violent",
    "a-tip30": "member A with 30 g, \u{3c0} rad in 2 s",
    "b-tip30": "member B with 30 g, \u{3c0} rad in 2 s: arrives almost still",
    "c-tip30": "member C with 30 g, \u{3c0} rad in 2 s",
    "d-tip30": "member D with 30 g, \u{3c0} rad in 2 s",
    "d-tip30-quick": "member D with 30 g, \u{3c0} rad in two first periods, for a drive in the loop",
    "b-tip30-damped-hub": "member B with 30 g, damped, hub radius 40 mm",
    "s-gravity": "1 m arm in a vertical plane, payload with inertia",
    "spin-up": "10 m blade brought to 6 rad/s, after Simo and Vu-Quoc",
    "pick-and-place": "a queue of moves: out, drop, back",
}

/// Returns name and description of every embedded scene.
pub fn list() -> impl Iterator<Item = (&'static str, &'static str)> {
    EMBEDDED.iter().map(|&(name, about, _)| (name, about))
}

/// Returns the embedded scene of that name, if there is one.
pub fn named(name: &str) -> Option<Result<SceneFile, Error>> {
    EMBEDDED
        .iter()
        .find(|entry| entry.0 == name)
        .map(|(name, _, text)| SceneFile::parse(name, text))
}

/// Opens an embedded scene by name, or else a scene file by path.
pub fn open(name_or_path: &str) -> Result<SceneFile, Error> {
    open_with(name_or_path, SceneFile::read)
}

/// Opens a scene as [`open()`] does, but a file may be without moves.
pub fn open_arm(name_or_path: &str) -> Result<SceneFile, Error> {
    open_with(name_or_path, SceneFile::read_arm)
}

/// Returns the text of an embedded scene, or else of a scene file.
pub fn text(name_or_path: &str) -> Result<String, Error> {
    let embedded = EMBEDDED.iter().find(|entry| entry.0 == name_or_path);
    match embedded {
        Some((_, _, text)) => Ok((*text).to_owned()),
        None => std::fs::read_to_string(name_or_path)
            .map_err(|cause| Error::file(name_or_path.as_ref(), cause)),
    }
}

fn open_with(
    name_or_path: &str,
    read: fn(&Path) -> Result<SceneFile, Error>,
) -> Result<SceneFile, Error> {
    if mechanism::scenes::open(name_or_path).is_ok_and(|scene| scene.is_some()) {
        return Err(Error::new(format_args!(
            "scene = \"{name_or_path}\": a mechanism of several links; must be an arm of one [link] \
             here; run, reference, compare and plan take mechanisms"
        )));
    }
    named(name_or_path).unwrap_or_else(|| {
        read(name_or_path.as_ref()).map_err(|error| {
            let known = list().map(|(name, _)| name).collect::<Vec<_>>().join(", ");
            if Path::new(name_or_path).exists() {
                error
            } else {
                Error::new(format_args!(
                    "scene = \"{name_or_path}\": no such file; must be a scene file or one of \
                     {known}"
                ))
            }
        })
    })
}
