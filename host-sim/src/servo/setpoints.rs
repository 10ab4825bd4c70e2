//! The setpoints that a firmware sends along a scene's moves.

use stillbeam::stepper::Stepper;
use stillbeam::{Scalar, Setpoint};

use crate::dispatch::{StepperVisitor, with_stepper};
use crate::error::Error;
use crate::run::each_tick;
use crate::scene_file::SceneFile;

/// The setpoints of a run, one a tick.
#[derive(Clone, Debug)]
pub struct Setpoints {
    /// h, s.
    pub tick: f64,
    /// The setpoints, from t = 0 on.
    pub list: Vec<Sent>,
}

/// One tick's setpoint.
#[derive(Clone, Copy, Debug)]
pub struct Sent {
    /// The setpoint that is sent. Where the acceleration jumps it is the right-hand value.
    pub setpoint: Setpoint<f64>,
    /// The same with acceleration and torque from before a jump at this tick, where a move ends.
    pub before: Setpoint<f64>,
}

impl Setpoints {
    /// Runs the scene's method along its moves.
    ///
    /// # Errors
    /// Refusals of a run; a shaper, which no generator has.
    pub fn of(scene: &SceneFile) -> Result<Self, Error> {
        let solver = scene.solver.resolve()?;
        let list = with_stepper(scene, &solver, Ticks { scene })?;
        Ok(Self { tick: solver.tick, list })
    }
}

struct Ticks<'a> {
    scene: &'a SceneFile,
}

impl StepperVisitor for Ticks<'_> {
    type Output = Vec<Sent>;

    fn visit<S: Stepper + Clone>(self, stepper: S) -> Result<Vec<Sent>, Error> {
        let mut list = Vec::new();
        each_tick(stepper, self.scene, |generator, _, ends| {
            let setpoint = precise(&generator.tick());
            let before = if ends { precise(&generator.setpoint_before()) } else { setpoint };
            list.push(Sent { setpoint, before });
        })?;
        Ok(list)
    }
}

fn precise<T: Scalar>(setpoint: &Setpoint<T>) -> Setpoint<f64> {
    Setpoint {
        angle: setpoint.angle.precise(),
        rate: setpoint.rate.to_f64(),
        acceleration: setpoint.acceleration.to_f64(),
        torque: setpoint.torque.to_f64(),
        tip: setpoint.tip.map(|x| x.to_f64()),
    }
}
