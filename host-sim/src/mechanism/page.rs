//! A mechanism's run as one self-contained page.

use maud::html;

use super::table::Row;
use super::{MechanismScene, moving, picture};
use crate::error::Error;
use crate::report::parts::{figure, page};

/// Renders the page of a run: the mechanism drawn, and the curves of its joints. `solver` says in a
/// few words what made the rows, `data` names the file that holds them.
pub fn render(
    scene: &MechanismScene,
    solver: &str,
    rows: &[Row],
    data: &str,
) -> Result<String, Error> {
    let drawn = html! {
        "The links at seven times, evenly over the run; rings are joints. Thin: the path of the tip."
    };
    let curves = html! {
        "Relative angles of all joints, passive ones too, the torques of the drives, and every \
         link\u{2019}s end across its own clamp."
    };
    let body = html! {
        header { h1 { (scene.name) } p.lead { (solver) } }
        @if let Some(moving) = moving::animation(scene, rows) {
            (moving.figure(&html! {
                "The run " (moving.speed()) ", over and over. Thin: the path of the tip. Below: the \
                 first link\u{2019}s deflection solid, the second\u{2019}s dashed, the third\u{2019}s \
                 dotted."
            }))
        }
        (figure(&[picture::poses(scene, rows)], &drawn, data)?)
        (figure(&picture::curves(scene, rows), &curves, data)?)
    };
    Ok(page(&scene.name, &body))
}
