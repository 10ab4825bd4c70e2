//! The generator, stepped by hand.

use pyo3::prelude::*;
use pyo3::types::{IntoPyDict, PyDict};
use stillbeam::Move;
use stillbeam::motion::Limits;
use stillbeam_erased::AnyGenerator;
use stillbeam_sim::dispatch;
use stillbeam_sim::error::Error;
use stillbeam_sim::run::row;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::{Method, Solver};

use crate::error::{core, refused};
use crate::keys;
use crate::rows::Rows;
use crate::scene::Scene;

/// A generator, its scene and the end of its queue.
#[pyclass(module = "stillbeam._stillbeam")]
pub struct Generator {
    generator: Box<dyn AnyGenerator>,
    scene: Py<Scene>,
    tick: f64,
    /// Ticks that were made.
    made: u64,
    /// Where the queue ends: hub angle, rad, and rate, rad/s.
    end: (f64, f64),
}

#[pymethods]
impl Generator {
    #[new]
    fn new(
        py: Python<'_>,
        scene: Py<Scene>,
        angle: Option<f64>,
        acceleration: Option<f64>,
        solver: &Bound<'_, PyDict>,
    ) -> PyResult<Self> {
        let file = &scene.get().file;
        let (solver, ..) = keys::resolve(solver, file)?;
        let angle = angle.unwrap_or(file.from);
        let acceleration = bound(file, &solver, acceleration)?;
        let generator =
            py.detach(|| set_up(file, &solver, angle, acceleration)).map_err(refused)?;
        Ok(Self { generator, scene, tick: solver.tick, made: 0, end: (angle, 0.0) })
    }

    /// Puts a move behind the others, by the keys of a scene's `[move]`. Returns its duration, s.
    fn push(&mut self, py: Python<'_>, keys: &Bound<'_, PyDict>) -> PyResult<f64> {
        let table = keys.copy()?;
        let (angle, rate) = self.end;
        table.set_item("from", self.scene.get().in_own_unit(angle)?)?;
        let changes = PyDict::new(py);
        changes.set_item("move", py.None())?;
        changes.set_item("solver", [("tick", self.tick)].into_py_dict(py)?)?;
        let bare = self.scene.get().changed(py, &changes)?;
        changes.set_item("move", &table)?;
        let planned = bare.changed(py, &changes)?;
        let motion = single(&planned.file, rate)?;
        let summary = self.generator.push(&motion).map_err(core)?;
        self.end = (summary.end.angle.radians(), summary.end.rate);
        Ok(f64::from(summary.ticks) * self.tick)
    }

    /// Goes to another target from where the hub is. Returns the duration, s.
    fn retarget(&mut self, angle: f64, duration: f64, rate: f64) -> PyResult<f64> {
        let ticks = self.generator.retarget(angle, rate, duration).map_err(core)?;
        self.end = (angle, rate);
        Ok(f64::from(ticks) * self.tick)
    }

    /// Makes a tick. Returns time s, hub angle rad, rate rad/s and acceleration rad/s², the tip in
    /// the global frame, its deflection, m, and the torque, N m.
    fn tick(&mut self) -> (f64, f64, f64, f64, f64, f64, f64, f64) {
        self.rows(1).list[0].numbers().into()
    }

    /// Makes `count` ticks and returns their setpoints.
    fn ticks(&mut self, py: Python<'_>, count: usize) -> Rows {
        py.detach(|| self.rows(count))
    }

    /// Control period, s.
    #[getter]
    fn period(&self) -> f64 {
        self.tick
    }

    /// True if no move is under way or waiting.
    #[getter]
    fn is_holding(&self) -> bool {
        self.generator.is_holding()
    }

    /// True if hub and arm rest.
    #[getter]
    fn is_asleep(&self) -> bool {
        self.generator.is_asleep()
    }

    /// Time of the next setpoint, s.
    #[getter]
    fn time(&self) -> f64 {
        self.made as f64 * self.tick
    }
}

impl Generator {
    fn rows(&mut self, count: usize) -> Rows {
        let arm = &self.scene.get().file.arm;
        let (axis, offset) = (arm.mount.axis, arm.payload.offset);
        let mut list = Vec::with_capacity(count);
        for _ in 0..count {
            let setpoint = self.generator.tick();
            let time = self.made as f64 * self.tick;
            list.push(row(time, axis, &setpoint, offset, self.generator.tip_angle()));
            self.made += 1;
        }
        Rows { list, axis, tick: self.tick }
    }
}

/// Builds the generator of a scene's arm, at rest at `angle` rad.
fn set_up(
    scene: &SceneFile,
    solver: &Solver,
    angle: f64,
    acceleration: Option<f64>,
) -> Result<Box<dyn AnyGenerator>, Error> {
    let mut generator = dispatch::stepper_for(scene, solver, acceleration)?.generator(angle)?;
    generator.limit(Limits { torque: None, moment: None, ..scene.limits })?;
    Ok(generator)
}

/// Returns the hub acceleration for which elastica is set up, rad/s²; `None` leaves it to the
/// scene's moves.
fn bound(scene: &SceneFile, solver: &Solver, given: Option<f64>) -> PyResult<Option<f64>> {
    if let Some(given) = given.filter(|given| !(0.0..=1e9).contains(given)) {
        let text = format!("acceleration = {given}: must be 0 to 1000000000 rad/s^2");
        return Err(refused(Error::new(text)));
    }
    if given.is_some() || !scene.moves.is_empty() {
        return Ok(given);
    }
    match (scene.limits.acceleration, solver.method) {
        (Some(limit), _) => Ok(Some(limit)),
        (None, Method::Elastica) => Err(refused(Error::new(
            "acceleration: missing; must be the greatest of the hub in rad/s^2, or the scene must have \
             limits.acceleration or moves: elastica is set up for it",
        ))),
        (None, _) => Ok(None),
    }
}

/// Returns the one move of a scene, from a hub that turns at `rate` rad/s.
fn single(scene: &SceneFile, rate: f64) -> PyResult<Move> {
    let motion = scene.moves.first().and_then(|step| step.motion.as_move());
    let Some(motion) = motion else {
        let text = "move.waypoints: must be a move in a generator; run follows waypoints";
        return Err(refused(Error::new(text)));
    };
    Ok(match motion {
        Move::To { profile, duration, to } if rate != 0.0 => {
            Move::Pass { profile, duration, to, rate: 0.0 }
        }
        other => other,
    })
}
