//! A scene to start from: its text with comments, and what to measure first.

mod measure;

pub use measure::{Doubt, doubts};

use crate::error::Error;
use crate::reference::rod;
use crate::scene_file::SceneFile;

/// Setpoint interval of the scene, s.
pub const TICK: f64 = 0.01;

/// Duration of a move that is not given, first periods.
const PERIODS: f64 = 2.0;

/// A strip on a motor, and a move, as they are asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Starter {
    /// From the clamp to the tip, m.
    pub length: f64,
    /// Name of the material.
    pub material: String,
    /// Size across the plane of motion, m.
    pub width: f64,
    /// Size in the plane of motion, m.
    pub thickness: f64,
    /// At the tip, kg.
    pub payload: f64,
    /// First frequency as measured, Hz. `None` leaves it to the material.
    pub frequency: Option<f64>,
    /// Damping ratio of the first mode as measured.
    pub damping: Option<f64>,
    /// Hub angle at the end of the move, rad.
    pub to: f64,
    /// Duration, s. `None` takes two first periods.
    pub duration: Option<f64>,
}

impl Starter {
    /// Returns the arm, without a move.
    ///
    /// # Errors
    /// Refusals of a scene file.
    pub fn arm(&self) -> Result<SceneFile, Error> {
        SceneFile::parse_arm("the arm", &self.arm_text(""))
    }

    /// Returns the text of the scene file, which is accepted by `run`.
    ///
    /// # Errors
    /// Refusals of a scene file, as a line of the file called `name`.
    pub fn text(&self, name: &str) -> Result<String, Error> {
        let period = rod::first_period(&self.arm()?.arm)?;
        let duration = self.duration.unwrap_or_else(|| whole_ticks(PERIODS * period));
        let text = format!(
            "# A flexible arm, written by `stillbeam-sim new`. SI units: m, kg, s, N m, rad.\n\n{}\n\
             {}\n{LIMITS}\n[solver]\ntick = {TICK:?}\n",
            self.arm_text(&format!("{:.4}", 1.0 / period)),
            self.move_text(duration, period)
        );
        SceneFile::parse(name, &text)?;
        Ok(text)
    }

    fn arm_text(&self, expected: &str) -> String {
        let Self { length, material, width, thickness, payload, .. } = self;
        let frequency = match self.frequency {
            Some(frequency) => {
                format!(
                    "# Measured with the payload on and the hub held.\nfrequency = {frequency:?}"
                )
            }
            None => format!(
                "# The first frequency as measured, with the payload on and the hub held, stands in\n\
                 # for the material's stiffness. By this file it is {expected} Hz.\n\
                 # frequency = {expected}\n\
                 # The link's own mass as weighed, kg, stands in for the material's density.\n\
                 # mass ="
            ),
        };
        let damping = match self.damping {
            Some(ratio) => format!("ratio = {ratio:?}\nfrom = \"beta\""),
            None => "# The ratio of the first mode as measured: 0.01 is 1 % of critical damping.\n\
                     # ratio = 0.01\n# from = \"beta\""
                .to_owned(),
        };
        format!(
            "[link]\n# The part that bends, from the clamp to the tip.\nlength = {length:?}\n\
             # Or youngs_modulus (Pa) and density (kg/m^3).\nmaterial = \"{material}\"\n\
             # A strip; the thickness is its size in the plane of motion. A tube has diameter and \
             wall.\nwidth = {width:?}\nthickness = {thickness:?}\n{frequency}\n\n[payload]\n\
             mass = {payload:?}\n\n[damping]\n{damping}\n"
        )
    }

    fn move_text(&self, duration: f64, period: f64) -> String {
        let Self { to, .. } = self;
        format!(
            "[move]\n# A move after which the arm is at rest. Others: cubic, quintic, cycloid, \
             trapezoid, s-curve.\nprofile = \"still\"\n# {:.2} first periods. Without it: the shortest \
             within the limits.\nduration = {duration:?}\nfrom = 0.0\nto = {to:?}  # {:.1} degrees\n\
             settle = {:?}\n",
            duration / period,
            to.to_degrees(),
            whole_ticks(f64::max(0.5, period))
        )
    }
}

/// The drive's limits, which a new user looks up later.
const LIMITS: &str = "[limits]\n# Of the drive. A move that exceeds one is refused, with what would \
    do.\n# torque = 2.0        # N m\n# rate = 20.0         # rad/s\n# acceleration = 100.0  # rad/s^2\n";

/// Rounds a time up to whole ticks, and to the digits that name them.
fn whole_ticks(time: f64) -> f64 {
    (time / TICK - 1e-9).ceil() / (1.0 / TICK)
}
