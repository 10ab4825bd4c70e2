//! The parts between the drive's torque command and the arm.

use stillbeam::motor::{Joint, Ratio};

use crate::error::Error;

/// Motor, gear and friction of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts {
    /// The gear.
    pub gear: Gear,
    /// Friction at the hub.
    pub friction: Friction,
    /// The motor.
    pub motor: Motor,
}

/// A gear between the motor's shaft and the hub.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gear {
    /// n, turns of the motor per turn of the hub.
    pub ratio: Ratio,
    /// η, above 0.3 to 1; 1 is lossless. The loss is a friction proportional to the torque of the
    /// mesh: `(1/η − 1)|τ_g|` where the motor drives, `(1 − η)|τ_g|` where the load does.
    pub efficiency: f64,
    /// k, stiffness between motor and hub, N m/rad of the hub. `None` is a rigid gear.
    pub stiffness: Option<f64>,
    /// d, damping of that compliance, N m s/rad of the hub.
    pub damping: f64,
    /// Gap by which the hub can turn without the motor, rad of the hub. Needs a stiffness.
    pub backlash: f64,
    /// Inertia of shaft and flange on the hub's side, kg m², beyond the scene's hub.
    pub output_inertia: f64,
}

/// Friction at the hub: Coulomb, Stribeck and viscous.
///
/// The level is `τ_C + (τ_S − τ_C) exp(−(θ̇/θ̇_S)²)`. A bristle's relative deflection z follows the
/// hub, `ż = (θ̇ − |θ̇| z)/x₀`, and the torque is the level times z, with `bθ̇` and a damping of
/// the bristle added. Reversals take a turn of a few x₀ ("presliding"), as measured friction does;
/// at an even rate z is ±1 and the friction that of the textbook. After Dahl (1968) and Canudas de
/// Wit et al. (1995).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Friction {
    /// τ_C, N m.
    pub coulomb: f64,
    /// τ_S, at which the hub breaks away, N m; τ_C or more.
    pub breakaway: f64,
    /// θ̇_S, rate at which the Stribeck effect has faded to 1/e, rad/s.
    pub stribeck_rate: f64,
    /// b, N m s/rad.
    pub viscous: f64,
    /// x₀, rad.
    pub presliding: f64,
}

/// A motor and its torque controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// J_m of the rotor about its own axis, kg m².
    pub rotor_inertia: f64,
    /// Largest torque, N m. `None` is without limit.
    pub torque: Option<f64>,
    /// Fastest change of the torque, N m/s. `None` is without limit.
    pub torque_rate: Option<f64>,
    /// Speed of the shaft, rad/s, beyond which the motor gives no more torque forward.
    pub speed: Option<f64>,
    /// Cogging.
    pub cogging: Cogging,
}

/// Cogging torque, `A sin(pθ_m)` of the shaft's angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cogging {
    /// A, N m.
    pub amplitude: f64,
    /// p, periods a turn of the shaft.
    pub periods: u32,
}

impl Default for Gear {
    /// A rigid, lossless direct drive.
    fn default() -> Self {
        let ratio = Ratio { motor: 1, link: 1 };
        Self {
            ratio,
            efficiency: 1.0,
            stiffness: None,
            damping: 0.0,
            backlash: 0.0,
            output_inertia: 0.0,
        }
    }
}

impl Default for Friction {
    /// None.
    fn default() -> Self {
        Self { coulomb: 0.0, breakaway: 0.0, stribeck_rate: 0.05, viscous: 0.0, presliding: 1e-3 }
    }
}

impl Default for Motor {
    /// A massless one without limits.
    fn default() -> Self {
        let cogging = Cogging { amplitude: 0.0, periods: 84 };
        Self { rotor_inertia: 0.0, torque: None, torque_rate: None, speed: None, cogging }
    }
}

impl Parts {
    /// Returns the parts if every value is in range.
    ///
    /// # Errors
    /// The first field that is not, with its value and range.
    pub fn validate(self) -> Result<Self, Error> {
        let Self { gear, friction, motor } = self;
        gear.ratio.validate()?;
        check("gear.efficiency", gear.efficiency, 0.3, 1.0, "")?;
        if let Some(stiffness) = gear.stiffness {
            check("gear.stiffness", stiffness, 1e-3, 1e9, "N m/rad")?;
            let wanted = "kg m^2 with gear.stiffness, which parts the rotor from the hub";
            check("motor.rotor_inertia", motor.rotor_inertia, 1e-9, 1e3, wanted)?;
        } else if gear.backlash > 0.0 {
            return Err(Error::new(format_args!(
                "gear.backlash = {}: must be absent without gear.stiffness",
                gear.backlash
            )));
        }
        check("gear.damping", gear.damping, 0.0, 1e6, "N m s/rad")?;
        check("gear.backlash", gear.backlash, 0.0, 1.0, "rad")?;
        check("gear.output_inertia", gear.output_inertia, 0.0, 1e6, "kg m^2")?;
        check("friction.coulomb", friction.coulomb, 0.0, 1e6, "N m")?;
        let least = friction.coulomb;
        check("friction.breakaway", friction.breakaway, least, 1e6, "N m, coulomb or more")?;
        check("friction.stribeck_rate", friction.stribeck_rate, 1e-6, 1e3, "rad/s")?;
        check("friction.viscous", friction.viscous, 0.0, 1e6, "N m s/rad")?;
        check("friction.presliding", friction.presliding, 1e-6, 0.1, "rad")?;
        check("motor.rotor_inertia", motor.rotor_inertia, 0.0, 1e3, "kg m^2")?;
        for (name, value, unit) in [
            ("motor.torque", motor.torque, "N m"),
            ("motor.torque_rate", motor.torque_rate, "N m/s"),
            ("motor.speed", motor.speed, "rad/s"),
        ] {
            if let Some(value) = value {
                check(name, value, 1e-6, 1e9, unit)?;
            }
        }
        check("motor.cogging", motor.cogging.amplitude, 0.0, 1e6, "N m")?;
        check("motor.cogging_periods", motor.cogging.periods.into(), 1.0, 1e4, "")?;
        Ok(self)
    }

    /// n.
    pub fn ratio(&self) -> f64 {
        self.gear.ratio.value::<f64>()
    }

    /// The joint by which the core turns hub torques into motor torques: with the friction that is
    /// `known`, or with none. The gear's output inertia counts as a part of the rotor's.
    pub fn joint(&self, known: bool) -> Joint<f64> {
        let of = |value: f64| if known { value } else { 0.0 };
        let output = self.gear.output_inertia / self.ratio().powi(2);
        Joint {
            ratio: self.gear.ratio,
            efficiency: self.gear.efficiency,
            rotor_inertia: self.motor.rotor_inertia + output,
            coulomb: of(self.friction.coulomb),
            viscous: of(self.friction.viscous),
            torque_constant: 1.0,
        }
    }
}

impl Motor {
    /// Returns the torque that the motor gives for `wanted` N m, `dt` s after it gave `before` N m,
    /// with its shaft at `speed` rad/s; true if it is not what is wanted.
    pub fn limited(&self, wanted: f64, before: f64, dt: f64, speed: f64) -> (f64, bool) {
        let mut torque = wanted;
        if let Some(rate) = self.torque_rate {
            torque = torque.clamp(before - rate * dt, before + rate * dt);
        }
        if let Some(most) = self.torque {
            torque = torque.clamp(-most, most);
        }
        if self.speed.is_some_and(|most| speed.abs() >= most && torque * speed > 0.0) {
            torque = 0.0;
        }
        (torque, torque != wanted)
    }
}

pub(super) fn check(
    field: &str,
    value: f64,
    least: f64,
    most: f64,
    unit: &str,
) -> Result<(), Error> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    let gap = if unit.is_empty() { "" } else { " " };
    Err(Error::new(format_args!("{field} = {value}: must be {least} to {most}{gap}{unit}")))
}
