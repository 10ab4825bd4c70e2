//! The setpoints that a firmware sends along a scene's moves.

use stillbeam::Setpoint;

use crate::dispatch;
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
        let mut list = Vec::new();
        each_tick(&*dispatch::stepper(scene, &solver)?, scene, |generator, _, ends| {
            let setpoint = generator.tick().precise();
            let before = if ends { generator.setpoint_before().precise() } else { setpoint };
            list.push(Sent { setpoint, before });
        })?;
        Ok(Self { tick: solver.tick, list })
    }
}
