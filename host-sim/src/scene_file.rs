//! Scene files: TOML in SI units, read as a validated arm and its moves.

mod angle_unit;
mod arm;
mod blend;
mod damping;
mod deduced;
mod link;
mod matter;
mod measured;
mod mount;
mod moves;
mod notes;
mod optimal;
mod section;
mod shaper;
mod sizes;
mod units;
mod values;
mod waypoints;

use std::path::Path;

use serde::Deserialize;
use stillbeam::motion::Shaper;
use stillbeam::{Limits, Move, Scene};

use self::angle_unit::AngleUnit;
use self::arm::{CarrierTable, GravityTable, HubTable, PayloadTable};
use self::damping::DampingTable;
pub use self::deduced::Deduced;
use self::link::LinkTable;
use self::moves::{Built, Here, MoveTable, Planning};
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
    /// Values of the arm that the file's measurements give.
    pub deduced: Deduced,
    /// Indices of the moves whose duration is the shortest within the limits.
    pub shortest: Vec<usize>,
    /// Blended moves: their index, and the rate with which each passes its end, rad/s.
    pub blended: Vec<(usize, f64)>,
    /// Remarks on values that are probably in another unit, one line each.
    pub remarks: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    unit: Option<AngleUnit>,
    link: LinkTable,
    axis: Option<String>,
    #[serde(default)]
    hub: HubTable,
    #[serde(default)]
    payload: PayloadTable,
    #[serde(default)]
    damping: DampingTable,
    #[serde(default)]
    gravity: GravityTable,
    #[serde(default)]
    carrier: CarrierTable,
    #[serde(rename = "move")]
    motion: Option<MoveTable>,
    moves: Option<Vec<MoveTable>>,
    shaper: Option<ShaperTable>,
    #[serde(default)]
    limits: LimitsTable,
    #[serde(default)]
    solver: SolverKeys,
}

/// Requirement named where a file cannot be run.
const MOVES: &str = "move: must be either [move] or one or more [[moves]]";

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
        Self::parse(&path.display().to_string(), &text_of(path)?)
    }

    /// Reads and validates a scene file that may be without moves: then the scene has none.
    pub fn read_arm(path: &Path) -> Result<Self, Error> {
        Self::parse_arm(&path.display().to_string(), &text_of(path)?)
    }

    /// Parses and validates the text of a scene file. Errors begin with `name`, and the line and
    /// column of the key.
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let scene = Self::parse_arm(name, text)?;
        if scene.moves.is_empty() {
            return Err(Error::new(MOVES).within(name));
        }
        Ok(scene)
    }

    /// Parses as [`SceneFile::parse`] does, but also a file without moves.
    pub fn parse_arm(name: &str, text: &str) -> Result<Self, Error> {
        let document = Document::parse(name, text)?;
        let file = document.read()?;
        Self::build(name, file).map_err(|error| document.locate(&error))
    }

    fn build(name: &str, file: File) -> Result<Self, Error> {
        let (arm, deduced) = arm::build(&file)?;
        Self::with_moves(name, file, arm, deduced).map_err(|error| error.on(arm.mount.axis))
    }

    /// Adds the moves and their limits to a validated arm.
    fn with_moves(name: &str, mut file: File, arm: Scene, deduced: Deduced) -> Result<Self, Error> {
        let unit = unit_of(&file, &arm)?;
        unit.convert_limits(&mut file.limits);
        let limits = file.limits.build()?;
        let (mut tables, many) = match (file.motion.take(), file.moves.take()) {
            (Some(one), None) => (vec![one], false),
            (None, Some(many)) if !many.is_empty() => (many, true),
            (None, None) => (Vec::new(), false),
            _ => return Err(Error::new(MOVES)),
        };
        tables.iter_mut().for_each(|table| unit.convert_move(table));
        let remarks = units::remarks(&file, &arm, &tables);
        let mut scene = Self {
            name: name.to_owned(),
            shaper: file.shaper.as_ref().map(|table| table.build(&arm)).transpose()?,
            arm,
            from: tables.first().map_or(0.0, MoveTable::begin),
            moves: Vec::new(),
            limits,
            solver: file.solver,
            deduced,
            shortest: MoveTable::without_duration(&tables),
            blended: Vec::new(),
            remarks: Vec::new(),
        };
        let tick = scene.solver.resolve()?.tick;
        let checked = scene.add_moves(&tables, many, tick).and_then(|()| {
            if tables.is_empty() { Ok(()) } else { scene.trajectory(tick).map(drop) }
        });
        match (checked, remarks.first()) {
            (Ok(()), _) => Ok(Self { remarks, ..scene }),
            // A move that is refused may have been meant in another unit.
            (Err(error), Some(remark)) => Err(Error::new(format_args!("{error}; {remark}"))),
            (Err(error), None) => Err(unit.remarked(error)),
        }
    }

    /// Builds the moves, each from where the one before it ends.
    fn add_moves(&mut self, tables: &[MoveTable], many: bool, tick: f64) -> Result<(), Error> {
        let mut here = Here { angle: Some(self.from), rate: 0.0 };
        for (index, table) in tables.iter().enumerate() {
            let planning =
                Planning { before: self.case(tick), limits: &self.limits, count: tables.len() };
            let next = tables.get(index + 1);
            let built = table.build(index, next, &mut here, &planning).map_err(|error| {
                let place = place_of(index);
                // A limit's refusal says itself which move it is.
                if !many || error.to_string().contains("moves[") {
                    error
                } else {
                    error.within(place)
                }
            })?;
            let Built { step, passes } = built;
            self.moves.push(step);
            self.blended.extend(passes.map(|rate| (index, rate)));
        }
        Ok(())
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

impl LimitsTable {
    fn build(&self) -> Result<Limits, Error> {
        let &Self { rate, acceleration, deceleration, jerk, torque, moment } = self;
        Ok(Limits { rate, acceleration, deceleration, jerk, torque, moment }.validate()?)
    }
}

/// Returns the unit of the angles, which a linear axis has none of.
fn unit_of(file: &File, arm: &Scene) -> Result<AngleUnit, Error> {
    match file.unit {
        Some(unit) if arm.mount.is_linear() => Err(Error::new(format_args!(
            "unit = \"{}\": must be absent with axis = \"linear\", whose moves and limits are in m",
            unit.name()
        ))),
        unit => Ok(unit.unwrap_or_default()),
    }
}

fn text_of(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|cause| {
        Error::file(path, format_args!("{cause}; it must be a scene file or a scene's name"))
    })
}

fn place_of(index: usize) -> String {
    format!("moves[{index}]")
}
