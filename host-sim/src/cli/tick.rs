//! The option that takes the place of a scene's tick.

use stillbeam_sim::mechanism::MechanismScene;
use stillbeam_sim::scene_file::SceneFile;

#[derive(clap::Args)]
pub struct TickArgs {
    /// Setpoint interval in s, to whose whole multiples durations are rounded [default: the
    /// scene's, else 0.01]
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    tick: Option<f64>,
}

impl TickArgs {
    /// Returns the scene at the typed tick, or as it is.
    pub fn applied(&self, mut scene: SceneFile) -> SceneFile {
        scene.solver.tick = self.tick.or(scene.solver.tick);
        scene
    }

    /// Returns the mechanism at the typed tick, or as it is.
    pub fn applied_to_mechanism(&self, mut scene: MechanismScene) -> MechanismScene {
        scene.solver.tick = self.tick.or(scene.solver.tick);
        scene
    }
}
