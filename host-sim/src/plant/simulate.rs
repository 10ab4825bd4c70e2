//! The machine in time.

use differential_equations::ode::OrdinaryNumericalMethod;
use stillbeam::{AxisKind, Scene};

use super::Parts;
use super::derivative::{Driving, Row, State, System};
use crate::error::Error;
use crate::reference::ReferenceError;
use crate::reference::advance::{NOT_FINITE, advance, failure};
use crate::reference::integrators::{explicit, explicit_loose, implicit};
use crate::reference::rod::{Integrator, driven};

/// Torque of the motor at its shaft, N m, after its limits.
pub enum Effort<'a> {
    /// The same for the whole time.
    Held(f64),
    /// Over time, s.
    Over(&'a dyn Fn(f64) -> f64),
    /// The torque that gives the hub the acceleration, rad/s², that is wanted at a time, an angle
    /// and a rate: a drive without limit of bandwidth, on a rigid gear.
    Along(&'a dyn Fn(f64, f64, f64) -> f64),
}

impl Effort<'_> {
    /// Returns the torque at time `t` s, if that does not depend on the machine; else 0.
    pub(super) fn torque(&self, t: f64) -> f64 {
        match self {
            Self::Held(torque) => *torque,
            Self::Over(torque) => torque(t),
            Self::Along(_) => 0.0,
        }
    }
}

/// Fineness of a simulation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Number of the rod's polynomials, 5 to 8.
    pub order: usize,
    /// Tolerance of a step, relative and absolute.
    pub tolerance: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { order: 7, tolerance: 1e-9 }
    }
}

/// The machine at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shown {
    /// Time, s.
    pub t: f64,
    /// θ, rad.
    pub angle: f64,
    /// θ̇, rad/s.
    pub rate: f64,
    /// Angle of the motor's shaft, turns.
    pub shaft: f64,
    /// Rate of the shaft, rad/s.
    pub shaft_rate: f64,
    /// The tip in the global frame, m.
    pub tip: [f64; 2],
    /// The tip's Y in the hub frame, m.
    pub deflection: f64,
}

/// Tolerance from which on a method of order 5 takes fewer evaluations than one of order 8.
const LOOSE: f64 = 1e-6;

/// Fastest vibration of the hub against the rotor that is followed, rad/s.
const FASTEST: f64 = 2e4;

/// A motor, a gear, a hub and an arm, from rest on.
pub struct Plant {
    system: System,
    y: State,
    t: f64,
    /// Step that the integrator proposed last, s.
    step: Option<f64>,
    tolerance: f64,
    integrator: Integrator,
    /// Energy at the beginning, J.
    begin: f64,
}

impl Plant {
    /// Puts the machine at rest at the hub angle `angle` rad, where the arm hangs in equilibrium.
    ///
    /// # Errors
    /// A part out of range, a carriage or a carrier that turns, or an arm without equilibrium.
    pub fn at_rest(
        scene: &Scene,
        parts: &Parts,
        angle: f64,
        options: &Options,
    ) -> Result<Self, Error> {
        let parts = parts.validate()?;
        let scene = scene.validate()?;
        if scene.mount.axis == AxisKind::Linear {
            return Err(Error::new(
                "axis = \"linear\": must be a hub that turns, in a machine with its motor",
            ));
        }
        if scene.mount.carrier != 0.0 {
            return Err(Error::new(format_args!(
                "carrier.rate = {}: must be 0 in a machine with its motor",
                scene.mount.carrier
            )));
        }
        let mut scene = scene;
        scene.hub.inertia += parts.gear.output_inertia;
        let arm = driven(&scene, options.order)?;
        let a = arm.equilibrium(angle).ok_or(ReferenceError::NoEquilibrium { angle })?;
        let [scale, _] = arm.frequencies();
        let inertia = arm.respond(&a, &(a * 0.0), angle, 0.0).inertia;
        refuse_stiff(&parts, inertia)?;
        let integrator = arm.integrator();
        let whole = inertia + parts.motor.rotor_inertia * parts.ratio().powi(2);
        let system = System { arm, parts, scale, energy: (whole * scale * scale).max(1e-9) };
        let mut y = State::zeros();
        y.fixed_rows_mut::<8>(0).copy_from(&a);
        y[Row::Hub as usize] = angle;
        y[Row::Motor as usize] = angle;
        let begin = system.stored(&y);
        let tolerance = options.tolerance;
        Ok(Self { system, y, t: 0.0, step: None, tolerance, integrator, begin })
    }

    /// Goes on to time `until` s under an effort.
    ///
    /// # Errors
    /// An integrator that cannot go on, with the time.
    pub fn advance(&mut self, until: f64, effort: &Effort<'_>) -> Result<(), Error> {
        let span = until - self.t;
        if span <= 1e-13 * until.max(1.0) {
            return Ok(());
        }
        let first = self.step.map_or(0.0, |step| step.min(span));
        let tolerance = self.tolerance;
        match self.integrator {
            Integrator::Explicit if tolerance >= LOOSE => {
                self.march(explicit_loose(tolerance, first), until, effort)?;
            }
            Integrator::Explicit => {
                self.march(explicit(tolerance, first), until, effort)?;
            }
            Integrator::Implicit => {
                self.march(implicit(tolerance, first), until, effort)?;
            }
        }
        Ok(())
    }

    fn march(
        &mut self,
        mut method: impl OrdinaryNumericalMethod<f64, State>,
        until: f64,
        effort: &Effort<'_>,
    ) -> Result<(), ReferenceError> {
        let driving = Driving { system: &self.system, effort };
        let begin = self.t;
        method.init(&driving, begin, until, &self.y).map_err(|error| failure(begin, error))?;
        advance(&mut method, &driving, [begin, until], NOT_FINITE, &mut |_, _| ())?;
        (self.y, self.t, self.step) = (*method.y(), until, Some(method.h()));
        Ok(())
    }

    /// The machine now.
    pub fn shown(&self) -> Shown {
        let now = self.system.motion(&self.y);
        let [x, deflection] = self.system.arm.tip(&now.a);
        let (sin, cos) = now.angle.sin_cos();
        let (shaft, shaft_rate) = self.system.shaft(&self.y);
        Shown {
            t: self.t,
            angle: now.angle,
            rate: now.rate,
            shaft,
            shaft_rate,
            tip: [x * cos - deflection * sin, x * sin + deflection * cos],
            deflection,
        }
    }

    /// Shaft angle, turns, and rate, rad/s.
    pub fn shaft(&self) -> (f64, f64) {
        self.system.shaft(&self.y)
    }

    /// The parts.
    pub fn parts(&self) -> &Parts {
        &self.system.parts
    }

    /// Work of the motor since the beginning, J.
    pub fn work(&self) -> f64 {
        self.y[Row::Work as usize] * self.system.energy
    }

    /// Energy that friction, gear and damping took since the beginning, J.
    pub fn lost(&self) -> f64 {
        self.y[Row::Loss as usize] * self.system.energy
    }

    /// Energy that is stored beyond that at the beginning, J.
    pub fn stored(&self) -> f64 {
        self.system.stored(&self.y) - self.begin
    }

    /// Energy that appeared from nowhere since the beginning, J: stored, less work, plus losses.
    pub fn energy_error(&self) -> f64 {
        self.stored() - self.work() + self.lost()
    }
}

/// Refuses a gear whose spring swings a hub without inertia faster than can be followed. At once,
/// the hub feels `inertia` kg m²: that of its own and of the link's root.
fn refuse_stiff(parts: &Parts, inertia: f64) -> Result<(), Error> {
    let Some(stiffness) = parts.gear.stiffness else { return Ok(()) };
    let least = stiffness / (FASTEST * FASTEST);
    if inertia >= least {
        return Ok(());
    }
    Err(Error::new(format_args!(
        "gear.output_inertia = {}: must be at least {:.2e} kg m^2 more, or hub.inertia of the scene, \
         beside gear.stiffness = {stiffness}",
        parts.gear.output_inertia,
        least - inertia
    )))
}
