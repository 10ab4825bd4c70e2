//! The mechanisms of `tests/truth/mechanisms`: how far the references and the core are from their
//! solutions.

pub mod page;
pub mod random;
pub mod summary;

use std::path::Path;

use stillbeam_sim::error::Error;
use stillbeam_sim::mechanism::compare::{Comparison, compare};
use stillbeam_sim::mechanism::table::{self, Row};
use stillbeam_sim::mechanism::{MechanismKeys, MechanismScene, run};
use stillbeam_sim::reference::mechanism;
use stillbeam_sim::truth::Reference;

/// Names of the scenes.
pub const NAMES: [&str; 5] = ["arm-dd", "arm-bc-sag", "rigid-forearm", "four-bar", "latch"];

/// A mechanism of `tests/truth/mechanisms` with its solution.
pub struct Truth {
    /// The scene.
    pub scene: MechanismScene,
    /// The solution, every 10 ms.
    pub rows: Vec<Row>,
}

/// Solvers that are compared with a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solver {
    /// A reference with its usual options.
    Reference(Reference),
    /// The core in f32 with so many curvatures a link, at a tick in s.
    Core(i64, f64),
}

/// The solvers of the page, in the order of its columns.
pub const SOLVERS: [Solver; 6] = [
    Solver::Reference(Reference::Rod),
    Solver::Reference(Reference::Fem),
    Solver::Core(2, 0.01),
    Solver::Core(3, 0.01),
    Solver::Core(2, 0.005),
    Solver::Core(3, 0.005),
];

impl Truth {
    /// Reads a scene and its solution.
    ///
    /// # Errors
    /// An error is returned if a file is missing or wrong.
    pub fn read(name: &str) -> Result<Self, Error> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../truth/mechanisms");
        let scene = MechanismScene::read(&folder.join(format!("{name}.toml")))?;
        let count = scene.mechanism.links.len();
        let rows = table::read(&folder.join(format!("{name}.csv")), count)?;
        Ok(Self { scene, rows })
    }

    /// Returns the times of the solution, s.
    pub fn times(&self) -> Vec<f64> {
        self.rows.iter().map(|row| row.t).collect()
    }

    /// Runs a solver and compares it with the solution.
    ///
    /// # Errors
    /// An error is returned if the solver has none.
    pub fn error(&self, solver: Solver) -> Result<Comparison, Error> {
        let scene = &self.scene;
        let rows = match solver {
            Solver::Reference(reference) => {
                let drives = scene.drives(scene.solver()?.tick)?;
                mechanism::solve(reference, scene, &drives, &self.times(), &|_| ())?
            }
            Solver::Core(coordinates, tick) => {
                let keys = MechanismKeys {
                    tick: Some(tick),
                    coordinates: Some(coordinates),
                    ..MechanismKeys::default()
                };
                run::run(scene, &keys.resolve()?)?
            }
        };
        self.compare(&rows)
    }

    /// Compares rows with the solution, at the times that both have.
    ///
    /// # Errors
    /// An error is returned if they have none.
    pub fn compare(&self, rows: &[Row]) -> Result<Comparison, Error> {
        compare(rows, &self.rows, &self.scene)
    }
}
