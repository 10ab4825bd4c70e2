//! The reference rod on a hub that a torque drives.

use pyo3::prelude::*;
use stillbeam_sim::plant::{Effort, Motor, Options, Plant as Machine, Shown};
use stillbeam_sim::reference::rod;

use crate::error::refused;
use crate::machine;
use crate::scene::Scene;

/// Motor, gear, friction and arm, from rest on.
#[pyclass(module = "stillbeam._stillbeam")]
pub struct Plant {
    plant: Machine,
    motor: Motor,
    time: f64,
    /// Torque that the motor gives, N m.
    torque: f64,
}

/// The machine at an instant: t s, θ rad, θ̇ rad/s, deflection m, tip x and y m, torque N m.
type Instant = (f64, f64, f64, f64, f64, f64, f64);

#[pymethods]
impl Plant {
    #[new]
    fn new(
        py: Python<'_>,
        scene: &Scene,
        on: Option<&Bound<'_, PyAny>>,
        angle: f64,
        order: usize,
        tolerance: f64,
    ) -> PyResult<Self> {
        let parts = machine::of(on)?.parts;
        let options = Options { order, tolerance };
        let plant = py.detach(|| Machine::at_rest(&scene.file.arm, &parts, angle, &options));
        Ok(Self { plant: plant.map_err(refused)?, motor: parts.motor, time: 0.0, torque: 0.0 })
    }

    /// Holds a torque of the motor, N m at its shaft, for a duration, s. The motor gives of it what
    /// its limits allow. Returns the machine then.
    fn advance(&mut self, py: Python<'_>, torque: f64, duration: f64) -> PyResult<Instant> {
        let (_, speed) = self.plant.shaft();
        (self.torque, _) = self.motor.limited(torque, self.torque, duration, speed);
        self.time += duration;
        let (plant, until, torque) = (&mut self.plant, self.time, self.torque);
        py.detach(|| plant.advance(until, &Effort::Held(torque))).map_err(refused)?;
        Ok(self.shown())
    }

    /// Returns the machine now.
    fn shown(&self) -> Instant {
        let Shown { angle, rate, deflection, tip: [x, y], .. } = self.plant.shown();
        (self.time, angle, rate, deflection, x, y, self.torque)
    }

    /// Largest torque of the motor, N m, if it has a limit.
    #[getter]
    fn torque_limit(&self) -> Option<f64> {
        self.motor.torque
    }

    /// Returns hub-frame X and Y of the resting tip at a hub angle, m.
    #[staticmethod]
    fn rest_tip(scene: &Scene, angle: f64) -> PyResult<[f64; 2]> {
        let angle = stillbeam::Angle::from_radians(angle);
        rod::rest_tip(&scene.file.arm, angle).map_err(|error| refused(error.into()))
    }
}
