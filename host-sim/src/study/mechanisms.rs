//! The paper's inverse dynamics of link systems: the torques of all joints at once, of open chains,
//! of loops, and of an arm that becomes a loop.

use stillbeam::mechanism::Stiffness;

use crate::error::Error;
use crate::mechanism::table::Row;
use crate::mechanism::{MechanismScene, MechanismSolver, run, scenes};
use crate::reference::mechanism;
use crate::solver::Scalar;
use crate::truth::Reference;

/// Two runs of one mechanism with the same moves.
#[derive(Clone, Debug)]
pub struct Pair {
    /// The scene.
    pub scene: MechanismScene,
    /// The core's run at 10 ms in f32, links flexible.
    pub flexible: Vec<Row>,
    /// The run that it is shown beside, at the same times.
    pub other: Vec<Row>,
}

/// Results on mechanisms.
#[derive(Clone, Debug)]
pub struct Mechanisms {
    /// An open arm of two flexible links: the tick's nodal forces, carried to all joints at once,
    /// beside the reference rod's virtual work.
    pub open: Pair,
    /// A four-bar: flexible beside rigid links.
    pub looped: Pair,
    /// An arm of three links that closes on a pivot: the tick of 10 ms beside one of 1 ms with one
    /// coordinate more, in f64.
    pub closing: Pair,
}

impl Mechanisms {
    /// Runs the embedded mechanisms in the core, at 10 ms in f32.
    pub fn compute() -> Result<Self, Error> {
        let open = embedded("two-links")?;
        let drives = open.drives(open.solver()?.tick)?;
        let times = crate::truth::times_until(drives.duration(), drives.tick());
        let other = mechanism::solve(Reference::Rod, &open, &drives, &times, &|_| ())?;
        let looped = embedded("four-bar")?;
        let mut rigid = looped.clone();
        for link in &mut rigid.mechanism.links {
            link.stiffness = Stiffness::Rigid;
        }
        let closing = embedded("latch")?;
        let fine = MechanismSolver { tick: 0.001, scalar: Scalar::F64, coordinates: 3 };
        let fine: Vec<Row> = run::run(&closing, &fine)?.into_iter().step_by(10).collect();
        Ok(Self {
            open: Pair { flexible: ticked(&open)?, other, scene: open },
            looped: Pair { flexible: ticked(&looped)?, other: ticked(&rigid)?, scene: looped },
            closing: Pair { flexible: ticked(&closing)?, other: fine, scene: closing },
        })
    }
}

impl Pair {
    /// Returns the largest |torque| of a joint, counted from 0, N m: flexible and other.
    pub fn peaks(&self, joint: usize) -> [f64; 2] {
        [&self.flexible, &self.other]
            .map(|rows| rows.iter().map(|row| row.torques[joint].abs()).fold(0.0, f64::max))
    }

    /// Returns the largest difference of the torques of any joint, fraction of the largest torque.
    pub fn apart(&self) -> f64 {
        let rows = self.flexible.iter().zip(&self.other);
        let pairs = rows.flat_map(|(a, b)| a.torques.iter().zip(&b.torques));
        let largest = pairs.fold(0.0, |largest: f64, (a, b)| largest.max((a - b).abs()));
        let peak = (0..self.scene.mechanism.links.len()).map(|j| self.peaks(j)[1]);
        largest / peak.fold(f64::MIN_POSITIVE, f64::max)
    }
}

fn embedded(name: &str) -> Result<MechanismScene, Error> {
    scenes::open(name)?.ok_or_else(|| Error::new(format_args!("{name}: must be embedded")))
}

fn ticked(scene: &MechanismScene) -> Result<Vec<Row>, Error> {
    run::run(scene, &scene.solver()?)
}
