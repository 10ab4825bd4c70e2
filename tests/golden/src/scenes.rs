//! The embedded scenes: those of `host-sim/scenes/*.toml`, as constants, because the target cannot
//! read TOML. `cargo run -p stillbeam-tests --bin scenes` writes `embedded.in` from the scene
//! files, and a test of `stillbeam-tests` fails where the two differ.

use stillbeam::{Move, UniformScene};

/// A scene with what happens in it.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The scene's name.
    pub name: &'static str,
    /// The arm.
    pub scene: UniformScene,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// The moves, from rest, with the time to settle after each.
    pub moves: &'static [Move],
    /// h, s.
    pub tick: f64,
}

/// Every embedded scene.
// A scene file's 3.14159265358979 is a number of its user's, not a constant of ours.
#[allow(clippy::approx_constant)]
pub const SCENES: &[Run] = {
    // The names that the generated text uses without a path.
    use stillbeam::AxisKind::Rotary;
    use stillbeam::Move::{Dwell, SpinUp, To};
    use stillbeam::Profile::{Cubic, Cycloid, Quintic, SCurve, Trapezoid};
    use stillbeam::scene::Uniform;
    use stillbeam::{Damping, Hub, Link, Mount, Payload, Scene};
    include!("embedded.in")
};
