//! Scene files: TOML in SI units, read as a validated arm and its moves.

mod angle_unit;
mod moves;
mod notes;
mod shaper;
mod units;
mod waypoints;

use std::fmt::Display;
use std::path::Path;

use serde::Deserialize;
use stillbeam::material::{MATERIALS, Material, Strip};
use stillbeam::motion::Shaper;
use stillbeam::{Damping, Hub, Limits, Link, Move, Payload, Scene};

use self::angle_unit::AngleUnit;
use self::moves::{Here, MoveTable, Planning};
use self::shaper::ShaperTable;
pub use self::units::angle as angle_remark;
use crate::document::Document;
use crate::error::Error;
use crate::limits::{self, Case, remedy};
use crate::solver::SolverKeys;
use crate::step::{Motion, Step};
use crate::trajectory::Trajectory;

/// A scene as read: the arm, its moves, and the file's solver keys.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// Name of the embedded scene, or the file's path.
    pub name: String,
    /// The arm.
    pub arm: Scene,
    /// Hub angle at the beginning, rad.
    pub from: f64,
    /// Moves of the hub, each with the time to settle after it.
    pub moves: Vec<Step>,
    /// Shaper that the moves pass, each with its rest.
    pub shaper: Option<Shaper>,
    /// Limits of the drive.
    pub limits: Limits,
    /// The `[solver]` table.
    pub solver: SolverKeys,
    /// Indices of the moves whose duration is the shortest within the limits.
    pub shortest: Vec<usize>,
    /// Remarks on values that are probably in another unit, one line each.
    pub remarks: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    unit: Option<AngleUnit>,
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
    deceleration: Option<f64>,
    jerk: Option<f64>,
    torque: Option<f64>,
    moment: Option<f64>,
}

impl SceneFile {
    /// Reads and validates a scene file.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|cause| {
            Error::file(path, format_args!("{cause}; it must be a scene file or a scene's name"))
        })?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Parses and validates the text of a scene file. Errors begin with `name`, and the line and
    /// column of the key.
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let document = Document::parse(name, text)?;
        let file = document.read()?;
        Self::build(name, file).map_err(|error| document.locate(&error))
    }

    fn build(name: &str, mut file: File) -> Result<Self, Error> {
        let gravity = file.gravity.acceleration;
        let arm = Scene {
            link: file.link.build()?,
            hub: Hub { radius: file.hub.radius, inertia: file.hub.inertia },
            payload: Payload { mass: file.payload.mass, inertia: file.payload.inertia },
            damping: Damping { alpha: file.damping.alpha, beta: file.damping.beta },
            gravity,
        }
        .validate()?;
        let unit = file.unit.unwrap_or_default();
        unit.convert_limits(&mut file.limits);
        let limits = Limits {
            rate: file.limits.rate,
            acceleration: file.limits.acceleration,
            deceleration: file.limits.deceleration,
            jerk: file.limits.jerk,
            torque: file.limits.torque,
            moment: file.limits.moment,
        }
        .validate()?;
        let (mut tables, many) = match (file.motion.take(), file.moves.take()) {
            (Some(one), None) => (vec![one], false),
            (None, Some(many)) if !many.is_empty() => (many, true),
            _ => {
                return Err(Error::new("move: must be either [move] or one or more [[moves]]"));
            }
        };
        tables.iter_mut().for_each(|table| unit.convert_move(table));
        let remarks = units::remarks(&file, &arm, &tables);
        // A move that is refused may have been meant in another unit.
        let remarked = |error: Error| match remarks.first() {
            Some(remark) => Error::new(format_args!("{error}; {remark}")),
            None => unit.remarked(error),
        };
        let from = tables[0].begin();
        let mut here = Here { angle: Some(from), rate: 0.0 };
        let tick = file.solver.resolve()?.tick;
        let shaper = file.shaper.as_ref().map(|table| table.build(&arm)).transpose()?;
        let mut moves: Vec<Step> = Vec::new();
        for (index, table) in tables.iter().enumerate() {
            let (steps, shaper) = (&moves[..], shaper.as_ref());
            let before = Case { arm: &arm, from, steps, shaper, tick };
            let planning = Planning { before, limits: &limits, count: tables.len() };
            let step = table.build(index, &mut here, &planning).map_err(|error| {
                let place = place_of(index);
                // A limit's refusal says itself which move it is.
                if !many || error.to_string().contains("moves[") {
                    error
                } else {
                    error.within(place)
                }
            });
            moves.push(step.map_err(remarked)?);
        }
        let (name, solver) = (name.to_owned(), file.solver);
        let lasts = |table: &MoveTable| table.duration.is_some() || table.waypoints.is_some();
        let shortest = (0..tables.len()).filter(|&index| !lasts(&tables[index])).collect();
        let scene =
            Self { name, arm, from, moves, shaper, limits, solver, shortest, remarks: Vec::new() };
        scene.trajectory(tick).map_err(remarked)?;
        Ok(Self { remarks, ..scene })
    }

    /// Returns the moves and their shaper, to be held against limits.
    pub fn case(&self, tick: f64) -> Case<'_> {
        let Self { arm, from, moves, shaper, .. } = self;
        Case { arm, from: *from, steps: moves, shaper: shaper.as_ref(), tick }
    }

    /// Returns the commanded motion behind its shaper, every duration rounded to whole ticks. It
    /// keeps the limits of rate, acceleration and jerk. At least a first period of rest follows the
    /// last arrival.
    pub fn trajectory(&self, tick: f64) -> Result<Trajectory, Error> {
        let case = self.case(tick);
        let trajectory = case.trajectory()?;
        match limits::kinematic::excess(&case, &trajectory, &self.limits) {
            Some(excess) => {
                let refusal = remedy::of_motion(&case, &trajectory, &self.limits, excess);
                Err(case.placed(&trajectory, refusal))
            }
            None => Ok(trajectory),
        }
    }

    /// Returns the motions with their dwells, in order.
    pub fn motions(&self) -> Vec<Motion> {
        self.moves.iter().flat_map(Step::motions).collect()
    }

    /// Returns the moves with their dwells, as a generator's queue takes them, or `None` if a path
    /// through waypoints is among them.
    pub fn queue(&self) -> Option<Vec<Move>> {
        self.motions().iter().map(Motion::as_move).collect()
    }
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
    Error::new(format_args!(
        "{field}: missing beside {other} = {value}; both must be given, or neither"
    ))
}

fn clash(field: &str, other: &str, value: impl Display) -> Error {
    Error::new(format_args!(
        "{field}: given beside {other} = {value}; only one of the two must be given"
    ))
}
