//! The options with which a motion file takes the place of a scene's moves.

use std::path::PathBuf;

use stillbeam_sim::console;
use stillbeam_sim::error::Error;
use stillbeam_sim::motion_file::{Between, MotionFile, Options, Taking};
use stillbeam_sim::scene_file::SceneFile;

#[derive(clap::Args)]
pub struct MotionArgs {
    /// Hub motion in place of the scene's moves: CSV with t_s and hub_angle_rad, or a
    /// JointTrajectory of ROS 2 as JSON or YAML
    #[arg(long, value_name = "FILE")]
    motion: Option<PathBuf>,
    /// Joint of the trajectory
    #[arg(long, value_name = "NAME", requires = "motion")]
    joint: Option<String>,
    /// How the rows are taken [default: samples if more than 50 rows of a CSV have no rate, else
    /// waypoints]
    #[arg(long = "as", value_enum, requires = "motion")]
    taking: Option<Taking>,
    /// Polynomials between waypoints [default: quintic if the file has accelerations, else cubic]
    #[arg(long, value_enum, requires = "motion")]
    spline: Option<Between>,
    /// Noise of samples in rad, root mean square; 0 passes every row [default: estimated]
    #[arg(long, value_name = "RAD", requires = "motion", allow_negative_numbers = true)]
    noise: Option<f64>,
}

impl MotionArgs {
    /// True if a file is to take the place of the scene's moves.
    pub fn is_given(&self) -> bool {
        self.motion.is_some()
    }

    /// Opens the scene that the motion is for: with a file of motion, an arm without moves is one.
    pub fn open(&self, name_or_path: &str) -> Result<SceneFile, Error> {
        match self.motion {
            Some(_) => console::open_arm(name_or_path),
            None => console::open(name_or_path),
        }
    }

    /// Returns the scene with the file's motion, if there is one, and notes on how it was taken.
    pub fn command(&self, scene: SceneFile, tick: f64) -> Result<(SceneFile, Vec<String>), Error> {
        let Some(path) = &self.motion else { return Ok((scene, Vec::new())) };
        let options = Options {
            joint: self.joint.clone(),
            taking: self.taking,
            between: self.spline,
            noise: self.noise,
        };
        MotionFile::read(path, self.joint.as_deref())?.command(scene, &options, tick)
    }
}
