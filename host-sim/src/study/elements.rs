//! Fig. 2: the number of elements and their mass matrix.

use super::{Run, tip_path};
use crate::dispatch::first_period;
use crate::error::Error;
use crate::solver::{ELEMENTS, Mass, Scalar, SolverKeys};

/// Runs and periods of member D over the number of elements.
#[derive(Clone, Debug)]
pub struct Elements {
    /// 1, 2, 4 and 8 elements.
    pub meshes: Vec<Mesh>,
    /// The continuous beam's first period, `2π L²/λ² √(ρA/EI)` with `cos λ cosh λ = −1`, s.
    pub theory: f64,
}

/// One number of elements.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Number of elements.
    pub elements: usize,
    /// Lumped mass: half of the element's mass at each node.
    pub lumped: Variant,
    /// Consistent mass, by the shape functions.
    pub consistent: Variant,
}

/// One mass matrix.
#[derive(Clone, Debug)]
pub struct Variant {
    /// First period, s.
    pub period: f64,
    /// Period between zeros of the deflection in the rest after the move, s. A reader of the curve
    /// finds this period.
    pub read: f64,
    /// The run.
    pub run: Run,
}

/// First root of `cos λ cosh λ = −1`.
const LAMBDA: f64 = 1.875_104_068_711_961;

impl Elements {
    /// Runs member D bare, π in 0.2 s and 0.2 s of rest, at the paper's 0.4 ms.
    pub fn compute() -> Result<Self, Error> {
        let mesh = |elements| -> Result<Mesh, Error> {
            Ok(Mesh {
                elements,
                lumped: variant(elements, Mass::Lumped)?,
                consistent: variant(elements, Mass::Consistent)?,
            })
        };
        let meshes = ELEMENTS.into_iter().map(mesh).collect::<Result<Vec<_>, _>>()?;
        let arm = meshes[0].consistent.run.scene.arm;
        let link = arm.link;
        let slowness = (arm.mass_per_length() / link.bending_stiffness).sqrt();
        let theory = std::f64::consts::TAU * (link.length / LAMBDA).powi(2) * slowness;
        Ok(Self { meshes, theory })
    }
}

fn variant(elements: usize, mass: Mass) -> Result<Variant, Error> {
    let keys = SolverKeys {
        elements: Some(elements as i64),
        mass: Some(mass),
        tick: Some(tip_path::TICK),
        scalar: Some(Scalar::F64),
        ..SolverKeys::default()
    };
    let run = Run::embedded("d-fast", keys)?;
    let period = first_period(&run.scene.arm, elements, mass)?;
    Ok(Variant { period, read: period_read(&run)?, run })
}

/// Returns twice the mean time between zeros of the deflection after the move.
fn period_read(run: &Run) -> Result<f64, Error> {
    let rest: Vec<_> = run.rows.iter().filter(|row| row.t_s >= run.move_time()).collect();
    let zeros: Vec<f64> = rest
        .windows(2)
        .filter(|pair| pair[0].deflection_m * pair[1].deflection_m < 0.0)
        .map(|pair| {
            let (a, b) = (pair[0], pair[1]);
            let share = a.deflection_m / (a.deflection_m - b.deflection_m);
            a.t_s + share * (b.t_s - a.t_s)
        })
        .collect();
    match zeros.as_slice() {
        [first, .., last] => Ok(2.0 * (last - first) / (zeros.len() - 1) as f64),
        _ => Err(Error::new("no period to read: fewer than two zeros in the rest after the move")),
    }
}
