//! Static equilibrium of the inextensible rod under its own weight, exact kinematics: what an arm
//! at rest hangs to, whatever model moved it there.

use ode_solvers::{Rk4, SVector, System};
use stillbeam::Scene;
use stillbeam::motion::Angle;

use crate::error::Error;

/// Gravity is raised to its value in this many steps, so that Newton's iteration follows the
/// equilibrium that the arm sags to, not another one.
const LOAD_STEPS: u32 = 8;

/// Steps of the fourth-order integration along the link.
const STATIONS: f64 = 256.0;

/// `φ, φ', Y`, and the change of `φ, φ'` with `φ'(0)`.
type Shot = SVector<f64, 5>;

/// Hub-frame Y of the tip with the hub at rest at angle `hub`, m.
///
/// `EI φ'' = g cos(θ + φ) [m_p + ρA(L − x)]`, `φ(0) = 0`, `φ'(L) = 0`, `Y = ∫sin φ dx`
/// (inextensible rod, φ relative to the hub), by shooting on `φ'(0)`. Error below 1e-9 L.
pub fn deflection(scene: &Scene, hub: Angle<f64>) -> Result<f64, Error> {
    if scene.gravity == 0.0 {
        return Ok(0.0);
    }
    let mut curvature = 0.0;
    let mut shot = Shot::zeros();
    for step in 1..=LOAD_STEPS {
        let gravity = scene.gravity * f64::from(step) / f64::from(LOAD_STEPS);
        let rod = Rod { scene, gravity, hub: hub.radians() };
        for _ in 0..20 {
            shot = rod.shoot(curvature)?;
            let correction = shot[1] / shot[4];
            curvature -= correction;
            if correction.abs() * scene.link.length < 1e-11 {
                break;
            }
        }
    }
    if shot[1].abs() * scene.link.length > 1e-8 {
        return Err(Error::new(format_args!(
            "gravity.acceleration = {}: no static equilibrium found; accepted is less gravity or a \
             stiffer link",
            scene.gravity
        )));
    }
    Ok(shot[2])
}

struct Rod<'a> {
    scene: &'a Scene,
    gravity: f64,
    hub: f64,
}

impl Rod<'_> {
    /// Integrates from the clamp to the tip.
    fn shoot(&self, curvature: f64) -> Result<Shot, Error> {
        let start = Shot::from([0.0, curvature, 0.0, 0.0, 1.0]);
        let length = self.scene.link.length;
        let mut rod = Rk4::new(self, 0.0, start, length, length / STATIONS);
        rod.integrate().map_err(|error| Error::new(format_args!("static equilibrium: {error}")))?;
        Ok(*rod.y_out().last().unwrap_or(&start))
    }
}

impl System<f64, Shot> for &Rod<'_> {
    fn system(&self, x: f64, y: &Shot, dy: &mut Shot) {
        let scene = self.scene;
        let outboard = scene.payload.mass + scene.mass_per_length() * (scene.link.length - x);
        let load = self.gravity * outboard / scene.link.bending_stiffness;
        let (sin, cos) = (self.hub + y[0]).sin_cos();
        dy[0] = y[1];
        dy[1] = load * cos;
        dy[2] = y[0].sin();
        dy[3] = y[4];
        dy[4] = -load * sin * y[3];
    }
}
