//! Scene files: TOML in SI units to a validated arm and its moves.

mod moves;
mod shaper;

use std::fmt::Display;
use std::path::Path;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use stillbeam::material::{MATERIALS, Material, Strip};
use stillbeam::motion::Shaper;
use stillbeam::{Damping, Hub, Limits, Link, Move, Payload, Scene};

use self::moves::{MoveTable, Planning};
use self::shaper::ShaperTable;
use crate::error::Error;
use crate::limits::{self, Case, remedy};
use crate::solver::SolverKeys;
use crate::trajectory::Trajectory;

/// A scene as read: the arm, what it shall do, and what the file says of the solver.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// Name of the embedded scene, or the file's path.
    pub name: String,
    /// The arm.
    pub arm: Scene,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// What the hub does, each move with the time to settle after it.
    pub moves: Vec<Step>,
    /// What the moves pass, each with its rest.
    pub shaper: Option<Shaper>,
    /// Limits of the drive.
    pub limits: Limits,
    /// The `[solver]` table.
    pub solver: SolverKeys,
}

/// One move and the rest after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The move.
    pub motion: Move,
    /// Time after it, s; 0 for none.
    pub settle: f64,
}

impl Step {
    /// The move and the dwell after it, if there is one.
    pub fn motions(&self) -> impl Iterator<Item = Move> + use<> {
        let dwell = (self.settle > 0.0).then_some(Move::Dwell { duration: self.settle });
        std::iter::once(self.motion).chain(dwell)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    link: LinkTable,
    #[serde(default)]
    hub: HubTable,
    #[serde(default)]
    payload: PayloadTable,
    #[serde(default)]
    damping: DampingTable,
    #[serde(default)]
    gravity: GravityTable,
    #[serde(rename = "move")]
    motion: Option<MoveTable>,
    moves: Option<Vec<MoveTable>>,
    shaper: Option<ShaperTable>,
    #[serde(default)]
    limits: LimitsTable,
    #[serde(default)]
    solver: SolverKeys,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LinkTable {
    length: f64,
    mass: Option<f64>,
    bending_stiffness: Option<f64>,
    youngs_modulus: Option<f64>,
    second_moment: Option<f64>,
    material: Option<String>,
    width: Option<f64>,
    thickness: Option<f64>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct HubTable {
    radius: f64,
    inertia: f64,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct PayloadTable {
    mass: f64,
    inertia: f64,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct DampingTable {
    alpha: f64,
    beta: f64,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct GravityTable {
    acceleration: f64,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct LimitsTable {
    rate: Option<f64>,
    acceleration: Option<f64>,
    jerk: Option<f64>,
    torque: Option<f64>,
    moment: Option<f64>,
}

impl SceneFile {
    /// Reads and validates a scene file.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|cause| {
            Error::file(path, format_args!("{cause}; must be a scene file or a scene's name"))
        })?;
        let place = path.display().to_string();
        Self::parse(&place, &text).map_err(|error| error.within(&place))
    }

    /// Parses and validates the text of a scene file.
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let file: File = from_toml(text)?;
        let gravity = file.gravity.acceleration;
        let arm = Scene {
            link: file.link.build()?,
            hub: Hub { radius: file.hub.radius, inertia: file.hub.inertia },
            payload: Payload { mass: file.payload.mass, inertia: file.payload.inertia },
            damping: Damping { alpha: file.damping.alpha, beta: file.damping.beta },
            gravity,
        }
        .validate()?;
        let limits = Limits {
            rate: file.limits.rate,
            acceleration: file.limits.acceleration,
            jerk: file.limits.jerk,
            torque: file.limits.torque,
            moment: file.limits.moment,
        }
        .validate()?;
        let (tables, many) = match (file.motion, file.moves) {
            (Some(one), None) => (vec![one], false),
            (None, Some(many)) if !many.is_empty() => (many, true),
            _ => {
                return Err(Error::new("move: must be either [move] or one or more [[moves]]"));
            }
        };
        let from = tables[0].from.unwrap_or(0.0);
        let mut at = Some(from);
        let tick = file.solver.resolve()?.tick;
        let shaper = file.shaper.map(|table| table.build(&arm)).transpose()?;
        let mut moves: Vec<Step> = Vec::new();
        for (index, table) in tables.iter().enumerate() {
            let (steps, shaper) = (&moves[..], shaper.as_ref());
            let before = Case { arm: &arm, from, steps, shaper, tick };
            let planning = Planning { before, limits: &limits, count: tables.len() };
            let step = table.build(index, &mut at, &planning).map_err(|error| {
                let place = place_of(index);
                // A limit's refusal says itself which move it is.
                if !many || error.to_string().contains(&place) {
                    error
                } else {
                    error.within(place)
                }
            });
            moves.push(step?);
        }
        let name = name.to_owned();
        let scene = Self { name, arm, from, moves, shaper, limits, solver: file.solver };
        scene.trajectory(tick)?;
        Ok(scene)
    }

    /// The moves and what they pass, to be held against limits.
    pub fn case(&self, tick: f64) -> Case<'_> {
        let Self { arm, from, moves, shaper, .. } = self;
        Case { arm, from: *from, steps: moves, shaper: shaper.as_ref(), tick }
    }

    /// The commanded motion with every duration rounded to whole ticks, its shaper passed, within
    /// the limits of rate, acceleration and jerk. A first period of rest at least follows the last
    /// arrival.
    pub fn trajectory(&self, tick: f64) -> Result<Trajectory, Error> {
        let case = self.case(tick);
        let trajectory = case.trajectory()?;
        match limits::kinematic::excess(&case, &trajectory, &self.limits) {
            Some(excess) => Err(remedy::of_motion(&case, &trajectory, &self.limits, excess).into()),
            None => Ok(trajectory),
        }
    }

    /// The moves with their dwells, as the generator's queue takes them.
    pub fn motions(&self) -> Vec<Move> {
        self.moves.iter().flat_map(Step::motions).collect()
    }

    /// What rounding to whole ticks changed, and what a shaper adds, a line each.
    pub fn roundings(&self, tick: f64) -> Result<Vec<String>, Error> {
        let trajectory = self.trajectory(tick)?;
        let motions = self.motions();
        let report = motions.iter().zip(trajectory.plans()).filter_map(|(motion, plan)| {
            let asked = motion.duration();
            // Not worth a word: what a decimal fraction of a second lacks in binary.
            (plan.outline.rounded_by.abs() > 1e-9 * asked).then(|| {
                let key = if matches!(motion, Move::Dwell { .. }) { "settle" } else { "duration" };
                let rounded = f64::from(plan.outline.ticks) * tick;
                format!(
                    "move.{key} = {asked} s is no multiple of the tick ({tick} s): rounded to \
                     {} s",
                    (rounded * 1e9).round() / 1e9
                )
            })
        });
        let shaped = self.shaper.as_ref().map(|shaper| {
            let (delay, pulses) = (shaper.delay(), shaper.pulses().len());
            format!("the shaper\u{2019}s {pulses} pulses add {delay:.4} s to the motion")
        });
        Ok(report.chain(shaped).chain(self.longer_rest(&trajectory)).collect())
    }
}

impl SceneFile {
    /// A line on the rest that is added behind the moves, if any is.
    fn longer_rest(&self, trajectory: &Trajectory) -> Option<String> {
        let added = trajectory.plans().get(self.motions().len())?;
        let rest = trajectory.duration() - trajectory.arrivals().last()?;
        Some(format!(
            "the run goes on at rest for {} s after the last arrival, {} s longer than the moves say: \
             over a first period its residual vibration shows",
            (rest * 1e9).round() / 1e9,
            (f64::from(added.outline.ticks) * trajectory.tick() * 1e9).round() / 1e9
        ))
    }
}

/// Reads a TOML text into a table; the error names the field.
pub(crate) fn from_toml<T: DeserializeOwned>(text: &str) -> Result<T, Error> {
    let document = toml::Deserializer::parse(text).map_err(|error| Error::new(error.message()))?;
    serde_path_to_error::deserialize(document).map_err(|error| {
        let path = error.path().to_string();
        let message = error.inner().message().to_owned();
        if path == "." { Error::new(message) } else { Error::new(message).within(path) }
    })
}

fn place_of(index: usize) -> String {
    format!("moves[{index}]")
}

impl LinkTable {
    fn build(&self) -> Result<Link, Error> {
        let strip = match (self.width, self.thickness) {
            (Some(width), Some(thickness)) => Some(Strip { width, thickness }.validate()?),
            (None, None) => None,
            (Some(width), None) => return Err(missing("link.thickness", "width", width)),
            (None, Some(thickness)) => return Err(missing("link.width", "thickness", thickness)),
        };
        let material = self.material.as_deref().map(named_material).transpose()?;
        let modulus = match (self.youngs_modulus, material) {
            (Some(_), Some(material)) => {
                return Err(clash("link.youngs_modulus", "material", material.name));
            }
            (modulus, material) => modulus.or(material.map(|m| m.youngs_modulus)),
        };
        let second_moment = match (self.second_moment, strip) {
            (Some(_), Some(strip)) => {
                return Err(clash("link.second_moment", "width", strip.width));
            }
            (moment, strip) => moment.or(strip.map(|s| s.second_moment())),
        };
        let mass = match (self.mass, material, strip) {
            (Some(mass), ..) => mass,
            (None, Some(material), Some(strip)) => material.density * strip.area() * self.length,
            _ => {
                return Err(Error::new(
                    "link.mass: missing; must be a mass in kg, or material with width and \
                     thickness",
                ));
            }
        };
        let stiffness = match (self.bending_stiffness, modulus, second_moment) {
            (Some(_), Some(modulus), _) if material.is_none() => {
                return Err(clash("link.bending_stiffness", "youngs_modulus", modulus));
            }
            (Some(stiffness), ..) => stiffness,
            (None, Some(modulus), Some(second_moment)) => {
                return Ok(Link::from_section(self.length, mass, modulus, second_moment)?);
            }
            _ => {
                return Err(Error::new(
                    "link.bending_stiffness: missing; must be EI in N m^2, or youngs_modulus \
                     or material with second_moment or width and thickness",
                ));
            }
        };
        Ok(Link { length: self.length, mass, bending_stiffness: stiffness })
    }
}

fn named_material(name: &str) -> Result<&'static Material, Error> {
    Material::named(name).ok_or_else(|| {
        let known = MATERIALS.map(|material| material.name).join(", ");
        Error::new(format_args!("link.material = \"{name}\": must be {known}"))
    })
}

fn missing(field: &str, other: &str, value: f64) -> Error {
    Error::new(format_args!("{field}: missing beside {other} = {value}; must be both or neither"))
}

fn clash(field: &str, other: &str, value: impl Display) -> Error {
    Error::new(format_args!("{field}: given beside {other} = {value}; must be one of the two"))
}
