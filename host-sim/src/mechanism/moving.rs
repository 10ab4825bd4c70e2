//! A mechanism as it bends and turns, drawn as a picture that moves.

use super::MechanismScene;
use super::picture::{joints, shape};
use super::table::Row;
use crate::animation::{Animation, Arm, Frame, INTERVALS, Ink, Panel};

/// Draws a run, whose rows are evenly spaced. Returns `None` of fewer than two rows.
pub fn animation(scene: &MechanismScene, rows: &[Row]) -> Option<Animation> {
    let stride = rows.len().saturating_sub(1).div_ceil(INTERVALS).max(1);
    let shown: Vec<&Row> = rows.iter().step_by(stride).collect();
    let (first, last) = (shown.first()?, shown.last()?);
    let seconds = last.t - first.t;
    if seconds <= 0.0 {
        return None;
    }
    let frames = shown.iter().map(|row| frame(scene, row)).collect();
    let arm = Arm { label: scene.name.clone(), ink: Ink::Blue, frames };
    Some(Animation {
        label: format!("The mechanism {} as it bends and turns", scene.name),
        goal: None,
        quantity: "deflections, mm".to_owned(),
        factor: 1e3,
        seconds,
        panels: vec![Panel { arms: vec![arm], remark: remark(scene) }],
    })
}

fn frame(scene: &MechanismScene, row: &Row) -> Frame {
    let line = shape(scene, row).into_iter().map(|(x, y)| [x, y]).collect();
    let inner = 1..row.ends.len();
    Frame { line, joints: joints(row)[inner].to_vec(), deflections: row.deflections.clone() }
}

/// Says what holds the tip.
fn remark(scene: &MechanismScene) -> String {
    match super::closes_at(&scene.mechanism) {
        None => "open chain".to_owned(),
        Some(0.0) => "closed by a pin".to_owned(),
        Some(time) => format!("closes at {time} s"),
    }
}
