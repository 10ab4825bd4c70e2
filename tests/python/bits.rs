//! Figures of the command line, for the package to be held to.

use std::path::Path;

use stillbeam_sim::solver::{Method, Scalar, SolverKeys};
use stillbeam_sim::table::{self, Row};
use stillbeam_sim::{advice, run, scenes};

/// Scenes of each kind: plain, damped, with gravity, with a queue of moves.
const SCENES: [&str; 4] = ["d-tip30-quick", "b-tip30-damped-hub", "s-gravity", "pick-and-place"];

/// Writes for each scene and method the columns of the run as numbers of eight bytes, one column
/// behind the other, and the CSV of the command line.
pub fn write(folder: &Path) {
    for name in SCENES {
        for method in [Method::Newmark, Method::Modal, Method::Elastica, Method::Auto] {
            keep(folder, name, method, None);
        }
    }
    keep(folder, "d-fast", Method::Elastica, Some(Scalar::F64));
}

fn keep(folder: &Path, name: &str, method: Method, scalar: Option<Scalar>) {
    let scene = scenes::open(name).expect("a scene");
    let keys = SolverKeys { method: Some(method), scalar, ..SolverKeys::default() };
    let keys = keys.or(scene.solver);
    let solver = keys.resolve().expect("a solver");
    let choice = (method == Method::Auto).then(|| {
        advice::chosen(&scene, &solver, &keys, &|_| (), &mut Vec::new()).expect("a choice")
    });
    let rows = run::run_with(&scene, &solver, choice.as_ref(), &|_| ()).expect("a run");
    let file = format!("{name}.{}.{}", method.name(), solver.scalar.name());
    let columns: [fn(&Row) -> f64; 8] = [
        |row| row.t_s,
        |row| row.hub_angle_rad,
        |row| row.hub_rate_rad_s,
        |row| row.hub_accel_rad_s2,
        |row| row.tip_x_m,
        |row| row.tip_y_m,
        |row| row.deflection_m,
        |row| row.torque_nm,
    ];
    let bytes: Vec<u8> = columns
        .iter()
        .flat_map(|column| rows.iter().flat_map(move |row| column(row).to_le_bytes()))
        .collect();
    std::fs::write(folder.join(format!("{file}.bin")), bytes).expect("a file");
    let path = folder.join(format!("{file}.csv"));
    table::write(&path, scene.arm.mount.axis, &rows).expect("a file");
}
