//! Scene files: text, a scene, a run.

use stillbeam_sim::run::run;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::solver::Method;

/// Ticks that a scene may have to be run here; longer ones are read only.
const TICKS: u64 = 500;

/// A text is refused in one line, or is a scene whose run is refused in one line or is finite.
pub fn scene(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let scene = match SceneFile::parse("fuzz", text) {
        Ok(scene) => scene,
        Err(error) => return is_a_line(&error.to_string()),
    };
    let solver = match scene.solver.resolve() {
        Ok(solver) => solver,
        Err(error) => return is_a_line(&error.to_string()),
    };
    let ticks = match scene.trajectory(solver.tick) {
        Ok(trajectory) => {
            trajectory.plans().iter().map(|plan| u64::from(plan.summary.ticks)).sum::<u64>()
        }
        Err(error) => return is_a_line(&error.to_string()),
    };
    // `auto` runs a scene with every method, at a quarter of the tick too.
    let share = if solver.method == Method::Auto { 10 } else { 1 };
    if ticks > TICKS / share {
        return;
    }
    match run(&scene, &solver) {
        Ok(rows) => {
            assert_eq!(rows.len() as u64, ticks + 1);
            for row in &rows {
                let [x, y] = [row.tip_x_m, row.tip_y_m];
                let hub = [row.hub_angle_rad, row.hub_rate_rad_s, row.hub_accel_rad_s2];
                let all = [row.t_s, x, y, row.deflection_m, row.torque_nm];
                assert!(hub.iter().chain(&all).all(|x| x.is_finite()), "{row:?}");
            }
        }
        Err(error) => is_a_line(&error.to_string()),
    }
}

fn is_a_line(message: &str) {
    assert!(!message.is_empty() && !message.contains(['\n', '\r']), "{message:?}");
}
