//! Scene files of mechanisms: TOML with `[[links]]`, in SI units.

use std::path::Path;

use serde::Deserialize;
use stillbeam::Limits;
use stillbeam::mechanism::{Closing, Closure, Joint, Link, Mechanism, Stiffness};
use stillbeam::scene::{Damping, Payload};

use super::limits::LimitsTable;
use super::moves::{self, MoveTable};
use super::solver::{MechanismKeys, MechanismSolver};
use super::{Drives, JointDrive};
use crate::document::Document;
use crate::error::Error;
use crate::reference::mechanism::rod;

/// A mechanism's scene as read: the chain, the moves of its joints and the length of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct MechanismScene {
    /// Name of the embedded scene, or the file's path.
    pub name: String,
    /// The chain. A driven joint's angle is the one its first move begins at.
    pub mechanism: Mechanism,
    /// Moves of the joints, in the order of the file.
    pub drives: Vec<JointDrive>,
    /// Length of the run, s.
    pub duration: f64,
    /// Limits of each joint's drive.
    pub limits: Vec<Limits>,
    /// The `[solver]` table.
    pub solver: MechanismKeys,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    links: Vec<LinkTable>,
    joints: Vec<JointTable>,
    #[serde(default)]
    payload: PayloadTable,
    #[serde(default)]
    damping: DampingTable,
    #[serde(default)]
    gravity: GravityTable,
    closure: Option<ClosureTable>,
    #[serde(default)]
    moves: Vec<MoveTable>,
    #[serde(default)]
    run: RunTable,
    #[serde(default)]
    solver: MechanismKeys,
}

/// A `[[links]]` table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LinkTable {
    length: f64,
    mass: f64,
    bending_stiffness: Option<f64>,
    #[serde(default)]
    rigid: bool,
    #[serde(default)]
    tip_offset: f64,
}

/// A `[[joints]]` table.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(super) struct JointTable {
    radius: f64,
    inertia: f64,
    mass: f64,
    stator_inertia: f64,
    passive: bool,
    pub(super) angle: Option<f64>,
    limits: LimitsTable,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct PayloadTable {
    mass: f64,
    inertia: f64,
    offset: f64,
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

/// A `[closure]` table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ClosureTable {
    pin: Option<[f64; 2]>,
    from: Option<f64>,
    #[serde(default)]
    release: Vec<i64>,
}

#[derive(Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct RunTable {
    duration: Option<f64>,
}

impl Default for JointTable {
    fn default() -> Self {
        let Joint { radius, inertia, mass, stator_inertia, passive, .. } = Joint::DRIVEN;
        let limits = LimitsTable::default();
        Self { radius, inertia, mass, stator_inertia, passive, angle: None, limits }
    }
}

/// Returns true if a text is the scene of a mechanism: if it has a list of links.
pub fn is_mechanism(text: &str) -> bool {
    let header = |line: &str| {
        let name = line.trim_start().strip_prefix("[[")?.split_once("]]")?.0;
        (name.trim() == "links").then_some(())
    };
    text.lines().any(|line| header(line).is_some())
}

impl MechanismScene {
    /// Reads and validates a scene file.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = std::fs::read_to_string(path).map_err(|cause| Error::file(path, cause))?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Parses and validates the text of a scene file. Errors begin with `name`, and the line and
    /// column of the key.
    pub fn parse(name: &str, text: &str) -> Result<Self, Error> {
        let document = Document::parse(name, text)?;
        let file = document.read()?;
        Self::build(name, file).map_err(|error| document.locate(&error))
    }

    fn build(name: &str, file: File) -> Result<Self, Error> {
        let tick = file.solver.resolve()?.tick;
        let mut mechanism = chain(&file, tick)?;
        let drives = moves::build(&file.moves, &file.joints, &mut mechanism)?;
        let last = drives.iter().map(|drive| drive.start + drive.motion.duration());
        let duration = match (file.run.duration, last.reduce(f64::max)) {
            (Some(duration), _) | (None, Some(duration)) => duration,
            (None, None) => {
                return Err(Error::new(
                    "run.duration: missing; must be the length of the run in s, as there are no \
                     moves",
                ));
            }
        };
        let name = name.to_owned();
        let limits = file.joints.iter().enumerate();
        let limits = limits.map(|(j, joint)| joint.limits.build(j, joint.passive));
        let limits = limits.collect::<Result<_, _>>()?;
        let scene = Self { name, mechanism, drives, duration, limits, solver: file.solver };
        scene.drives(tick)?;
        // A loop that cannot close is refused before anything runs.
        rod::initial(&scene.mechanism)?;
        Ok(scene)
    }

    /// Returns the solver of the file's keys.
    pub fn solver(&self) -> Result<MechanismSolver, Error> {
        self.solver.resolve()
    }

    /// Returns the commanded motion of every joint. Starts, durations and the length of the run are
    /// rounded to whole ticks of `tick` s.
    pub fn drives(&self, tick: f64) -> Result<Drives, Error> {
        Drives::plan(&self.mechanism, &self.drives, self.duration, tick)
    }
}

/// Builds the chain, its time of closing rounded to whole ticks.
fn chain(file: &File, tick: f64) -> Result<Mechanism, Error> {
    let links: Vec<Link> =
        file.links.iter().enumerate().map(|(k, link)| link.build(k)).collect::<Result<_, _>>()?;
    let mut mechanism = Mechanism::new(&links)?;
    if file.joints.len() != links.len() {
        return Err(Error::new(format_args!(
            "joints = {}: must be as many [[joints]] as [[links]], {}",
            file.joints.len(),
            links.len()
        )));
    }
    for (joint, table) in mechanism.joints.iter_mut().zip(&file.joints) {
        *joint = table.build();
    }
    let PayloadTable { mass, inertia, offset } = file.payload;
    mechanism.payload = Payload { mass, inertia, offset };
    let DampingTable { alpha, beta } = file.damping;
    mechanism.damping = Damping { alpha, beta, joint: 0.0 };
    mechanism.gravity = file.gravity.acceleration;
    if let Some(closure) = &file.closure {
        mechanism.closure = Some(closure.build(links.len(), tick)?);
    }
    mechanism.validate()?;
    Ok(mechanism)
}

impl LinkTable {
    fn build(&self, index: usize) -> Result<Link, Error> {
        let &Self { length, mass, bending_stiffness, rigid, tip_offset } = self;
        let stiffness = match (bending_stiffness, rigid) {
            (Some(stiffness), false) => Stiffness::Bending(stiffness),
            (None, true) => Stiffness::Rigid,
            (None, false) => {
                return Err(Error::new(format_args!(
                    "links[{index}].bending_stiffness: missing; must be a number in N m², or \
                     rigid = true beside it"
                )));
            }
            (Some(stiffness), true) => {
                return Err(Error::new(format_args!(
                    "links[{index}].bending_stiffness = {stiffness}: must be absent with \
                     rigid = true"
                )));
            }
        };
        Ok(Link { length, mass, stiffness, tip_offset })
    }
}

impl JointTable {
    fn build(&self) -> Joint {
        let &Self { radius, inertia, mass, stator_inertia, passive, angle, .. } = self;
        let angle = angle.unwrap_or(0.0);
        Joint { radius, inertia, mass, stator_inertia, passive, angle }
    }
}

impl ClosureTable {
    fn build(&self, count: usize, tick: f64) -> Result<Closure, Error> {
        let begins = match (self.pin, self.from) {
            (Some(pin), None) => Closing::OnPin(pin),
            (None, Some(from)) => Closing::At((from / tick).round() * tick),
            (Some(_), Some(from)) => {
                return Err(Error::new(format_args!(
                    "closure.from = {from}: must be absent beside closure.pin; a chain that closes \
                     while it runs is pinned where its end then is"
                )));
            }
            (None, None) => {
                return Err(Error::new(
                    "closure.pin: missing; must be a place [x, y] in m, or closure.from a time in s",
                ));
            }
        };
        let mut release = Vec::new();
        for &number in &self.release {
            release.push(joint_index(number, count, "closure.release")?);
        }
        // Any order will do; twice the same is once.
        release.sort_unstable();
        release.dedup();
        Ok(Closure { begins, release: release.into_iter().collect() })
    }
}

/// Returns the index of a joint that the file counts from 1.
pub(super) fn joint_index(number: i64, count: usize, field: &str) -> Result<usize, Error> {
    let index = usize::try_from(number - 1).ok().filter(|&index| index < count);
    index.ok_or_else(|| {
        Error::new(format_args!("{field} = {number}: there is no such joint; must be 1 to {count}"))
    })
}
