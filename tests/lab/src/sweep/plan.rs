//! The numbered cases of a sweep, and the reference solutions they share.

use std::sync::OnceLock;

use super::row::CaseId;
use super::spec::Spec;
use stillbeam_sim::error::Error;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::SolverKeys;
use stillbeam_sim::trajectory::Trajectory;
use stillbeam_sim::truth::{self, Reference};

/// Every case of a sweep, in order. The order, and with it each number, depends on the spec alone.
pub struct Plan {
    /// Name that tells this sweep from others: a hash of scenes, solvers and the program's version.
    pub name: String,
    /// The scenes.
    pub scenes: Vec<SceneFile>,
    /// The cases, scene by scene.
    pub cases: Vec<Case>,
    motions: Vec<Motion>,
}

/// One solver on one scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Index of the scene.
    pub scene: usize,
    /// The solver, without the keys that its method does not read.
    pub keys: SolverKeys,
    /// Index of the reference solution.
    pub motion: usize,
}

/// One commanded motion of a scene. Ticks that divide every duration share one. If a tick rounds a
/// duration, the motion is another and so is its solution.
struct Motion {
    /// Trajectory at the finest of the ticks.
    trajectory: Trajectory,
    scene: usize,
    /// The ticks that share it, s.
    ticks: Vec<f64>,
    /// Setpoint times of these ticks, rising.
    times: Vec<f64>,
    solution: OnceLock<Result<Vec<stillbeam_sim::table::Row>, Error>>,
}

impl Plan {
    /// Opens the scenes and checks every solver on every scene before anything is run.
    pub fn new(spec: &Spec) -> Result<Self, Error> {
        let scenes: Vec<SceneFile> = spec
            .scenes
            .iter()
            .map(|name| stillbeam_sim::scenes::open(name))
            .collect::<Result<_, _>>()?;
        let solvers = spec.solvers();
        let mut plan = Self { name: String::new(), scenes, cases: Vec::new(), motions: Vec::new() };
        for scene in 0..plan.scenes.len() {
            if plan.scenes[..scene].iter().any(|other| other.name == plan.scenes[scene].name) {
                let name = &plan.scenes[scene].name;
                return Err(Error::new(format_args!(
                    "scenes: \"{name}\" given twice; each scene must be named once"
                )));
            }
            for keys in &solvers {
                let tick = keys.resolve()?.tick;
                let motion = plan.motion(scene, tick)?;
                plan.cases.push(Case { scene, keys: *keys, motion });
            }
        }
        for motion in &mut plan.motions {
            motion.times.sort_by(f64::total_cmp);
            let close = 1e-6 * motion.trajectory.tick();
            motion.times.dedup_by(|b, a| *b - *a <= close);
        }
        plan.name = plan.hash();
        Ok(plan)
    }

    /// Returns the index of the motion of a scene at that tick, an existing one or a new one.
    fn motion(&mut self, scene: usize, tick: f64) -> Result<usize, Error> {
        let file = &self.scenes[scene];
        let place = |error: Error| error.within(format_args!("{} at {tick} s", file.name));
        let trajectory = file.trajectory(tick).map_err(place)?;
        let same = |motion: &Motion| {
            motion.scene == scene && same_durations(&motion.trajectory, &trajectory)
        };
        let index = self.motions.iter().position(same).unwrap_or_else(|| {
            let (ticks, times, solution) = (Vec::new(), Vec::new(), OnceLock::new());
            let trajectory = trajectory.clone();
            self.motions.push(Motion { trajectory, scene, ticks, times, solution });
            self.motions.len() - 1
        });
        let motion = &mut self.motions[index];
        if !motion.ticks.contains(&tick) {
            motion.ticks.push(tick);
            motion.times.extend((0..=trajectory.ticks()).map(|k| k as f64 * tick));
            if tick < motion.trajectory.tick() {
                motion.trajectory = trajectory;
            }
        }
        Ok(index)
    }

    /// Returns FNV-1a over the inputs of the rows, 16 hexadecimal digits.
    fn hash(&self) -> String {
        let mut hash = 0xcbf2_9ce4_8422_2325_u64;
        let mut add = |text: &str| {
            for byte in text.bytes().chain([0]) {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        };
        add(env!("CARGO_PKG_VERSION"));
        for scene in &self.scenes {
            add(&format!("{scene:?}"));
        }
        for case in &self.cases {
            add(&format!("{} {:?}", case.scene, case.keys));
        }
        format!("{hash:016x}")
    }

    /// Returns the scene of a case.
    pub fn scene(&self, case: &Case) -> &SceneFile {
        &self.scenes[case.scene]
    }

    /// Returns a case's identification in its row.
    pub fn id(&self, index: usize) -> CaseId {
        CaseId {
            sweep: self.name.clone(),
            case: index as u64 + 1,
            cases: self.cases.len() as u64,
            scene: self.scene(&self.cases[index]).name.clone(),
        }
    }

    /// Returns the number of reference solutions that the cases share.
    pub fn references(&self) -> usize {
        self.motions.len()
    }

    /// Returns a reference solution by number, solved on first use.
    pub fn reference(&self, index: usize) -> Result<&[stillbeam_sim::table::Row], Error> {
        let motion = &self.motions[index];
        let scene = &self.scenes[motion.scene];
        let solution = motion.solution.get_or_init(|| {
            truth::solve(Reference::Rod, scene, &motion.trajectory, &motion.times, &|_| ())
                .map_err(|error| error.within(&scene.name))
        });
        solution.as_deref().map_err(Clone::clone)
    }
}

/// True if the moves have the same lengths, to a nanosecond.
fn same_durations(a: &Trajectory, b: &Trajectory) -> bool {
    let nanoseconds = |trajectory: &Trajectory| -> Vec<i64> {
        let seconds = |ticks: u32| f64::from(ticks) * trajectory.tick();
        trajectory
            .plans()
            .iter()
            .map(|plan| (seconds(plan.summary.ticks) * 1e9).round() as i64)
            .collect()
    };
    nanoseconds(a) == nanoseconds(b)
}
