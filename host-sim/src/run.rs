//! Runs the core on a scene: the same generator as on the target, in f32 or f64.

use std::marker::PhantomData;

use stillbeam::beam::Model;
use stillbeam::stepper::{Newmark, Rigid, Stepper};
use stillbeam::{Error as CoreError, Generator, Move, Scalar as Real, Setpoint};

use crate::error::Error;
use crate::model_choice::{Visitor, with_model};
use crate::scene_file::SceneFile;
use crate::solver::{Method, Scalar, Solver};
use crate::table::Row;

/// Segments that can wait in the desktop's generator: two of the longest moves.
const QUEUE: usize = 14;

/// Runs a scene from its beginning to the end of the last rest: a row every tick, from t = 0.
///
/// At the end of a move the row holds the left-hand acceleration and torque.
pub fn run(scene: &SceneFile, solver: &Solver) -> Result<Vec<Row>, Error> {
    let rows = match solver.scalar {
        Scalar::F32 => run_in::<f32>(scene, solver),
        Scalar::F64 => run_in::<f64>(scene, solver),
    }?;
    let torque = rows.iter().map(|row| row.torque_nm.abs()).fold(0.0, f64::max);
    scene.limits.admit_torque(torque)?;
    Ok(rows)
}

fn run_in<T: Real>(scene: &SceneFile, solver: &Solver) -> Result<Vec<Row>, Error> {
    match solver.method {
        Method::Rigid => drive(Rigid::<T>::new(&scene.arm, solver.tick)?, scene),
        Method::Newmark => {
            let run = NewmarkRun::<T> { scene, solver, scalar: PhantomData };
            with_model(&scene.arm, solver.elements, solver.mass, run)
        }
    }
}

struct NewmarkRun<'a, T> {
    scene: &'a SceneFile,
    solver: &'a Solver,
    scalar: PhantomData<T>,
}

impl<T: Real> Visitor for NewmarkRun<'_, T> {
    type Output = Vec<Row>;

    fn visit<const N: usize, const W: usize>(self, model: Model<N, W>) -> Result<Vec<Row>, Error> {
        let stepper = Newmark::<T, N, W>::new(&model, self.solver.tick)?;
        drive(if self.solver.spin { stepper } else { stepper.without_spin() }, self.scene)
    }
}

/// Feeds the moves to a generator as its queue takes them, and ticks through all of them.
pub fn drive<S: Stepper>(stepper: S, scene: &SceneFile) -> Result<Vec<Row>, Error> {
    let tick = stepper.tick();
    let mut generator = Generator::<S, QUEUE>::new(stepper, scene.from)?;
    generator.limit(scene.limits)?;
    let motions = scene.motions();
    let mut waiting = motions.iter().peekable();
    let mut ends = Vec::new();
    let mut total = 0;
    let mut rows = Vec::new();
    for k in 0.. {
        while let Some(&&motion) = waiting.peek() {
            match generator.push(&motion) {
                Ok(plan) => {
                    total += u64::from(plan.ticks);
                    if !matches!(motion, Move::Dwell { .. }) {
                        ends.push(total);
                    }
                    waiting.next();
                }
                Err(CoreError::QueueFull { .. }) => break,
                Err(error) => return Err(error.into()),
            }
        }
        let setpoint = generator.tick();
        let shown = if ends.contains(&k) { generator.setpoint_before() } else { setpoint };
        rows.push(row(k as f64 * tick, &shown));
        if k == total {
            return Ok(rows);
        }
    }
    Ok(rows)
}

/// A setpoint in the units of the table.
pub fn row<T: Real>(t: f64, setpoint: &Setpoint<T>) -> Row {
    Row {
        t_s: t,
        hub_angle_rad: setpoint.angle.radians(),
        hub_rate_rad_s: setpoint.rate.to_f64(),
        hub_accel_rad_s2: setpoint.acceleration.to_f64(),
        tip_x_m: setpoint.tip[0].to_f64(),
        tip_y_m: setpoint.tip[1].to_f64(),
        deflection_m: setpoint.deflection.to_f64(),
        torque_nm: setpoint.torque.to_f64(),
    }
}
