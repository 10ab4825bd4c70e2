//! The arm whose ticks are counted, with everything a scene can have and with less.

use stillbeam::scene::Uniform;
use stillbeam::{Damping, Hub, Link, Mount, Payload, UniformScene};

/// Setpoint interval, s.
pub const TICK: f64 = 0.010;

/// Member B with everything a scene can have.
pub const FULL: UniformScene = UniformScene {
    link: Link { length: 0.4, mass: 0.01904, bending_stiffness: 0.042656 },
    shape: Uniform,
    hub: Hub { radius: 0.04, inertia: 1e-4, stiffness: None },
    payload: Payload { mass: 0.03, inertia: 0.0, offset: 0.0 },
    damping: Damping { alpha: 0.15, beta: 0.002, joint: 0.0 },
    gravity: 0.5,
    mount: Mount::ROTARY,
};

/// No damping.
pub const NONE: Damping = Damping { alpha: 0.0, beta: 0.0, joint: 0.0 };

/// Neither damping nor gravity.
pub const LEAN: UniformScene = UniformScene { damping: NONE, gravity: 0.0, ..FULL };
