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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::{run, scenes};

    /// The joints that are drawn are the ends of the links, and a loop's tip stays on its pin.
    #[test]
    fn joints_and_pin_are_where_the_table_has_them() {
        for name in ["two-links", "four-bar"] {
            let scene = scenes::open(name).expect("a name").expect("a scene");
            let rows = run::run(&scene, &scene.solver().expect("a solver")).expect("a run");
            let animation = animation(&scene, &rows).expect("a picture");
            let frames = &animation.panels[0].arms[0].frames;
            let stride = rows.len().div_ceil(frames.len());
            assert!(frames.len() > 50 && frames.len() <= INTERVALS + 1, "{}", frames.len());
            for (frame, row) in frames.iter().zip(rows.iter().step_by(stride)) {
                assert_eq!(frame.line.last(), row.ends.last());
                assert_eq!(frame.joints, row.ends[..row.ends.len() - 1]);
                assert_eq!(frame.deflections, row.deflections);
            }
            let count = scene.mechanism.links.len();
            let dashed = animation.svg().matches("stroke-dasharray=\"7 5\"").count();
            assert_eq!(dashed, usize::from(count > 1), "{name}");
        }
    }
}
