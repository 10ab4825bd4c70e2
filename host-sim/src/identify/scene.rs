//! The fitted arm as a scene file.

use stillbeam::Scene;
use toml_edit::{DocumentMut, Item, Table, value};

use super::arm::Free;
use crate::arm::natural;
use crate::error::Error;
use crate::scene_file::SceneFile;
use crate::table::significant;

/// Digits of a fitted value.
const DIGITS: usize = 7;

/// Relative error of a frequency that the digits leave.
const EXACT: f64 = 1e-5;

/// Returns the text of a scene with the fitted values in place of the documented ones. All else,
/// comments included, is as it was. A scene without moves gets one.
///
/// # Errors
/// An error is returned if the scene cannot hold the values: it is read back and must have the
/// fitted frequencies.
pub fn fitted(text: &str, arm: &Scene, free: &[Free], logs: &[String]) -> Result<String, Error> {
    let mut scene: DocumentMut =
        text.parse().map_err(|error: toml_edit::TomlError| Error::new(error.message()))?;
    let number = |x: f64| value(significant(x, DIGITS));
    let was_deduced = scene["link"].get("frequency").is_some();
    let free = if free.is_empty() { &[Free::Stiffness][..] } else { free };
    if free.contains(&Free::Stiffness) || was_deduced {
        remove(&mut scene["link"], &["frequency", "youngs_modulus"]);
        scene["link"]["bending_stiffness"] = number(arm.link.bending_stiffness);
    }
    for (table, key, fitted) in [
        ("payload", "mass", free.contains(&Free::Payload).then_some(arm.payload.mass)),
        ("hub", "stiffness", arm.hub.stiffness),
        ("damping", "alpha", Some(arm.damping.alpha)),
        ("damping", "beta", Some(arm.damping.beta)),
    ] {
        if let Some(fitted) = fitted {
            table_of(&mut scene, table)[key] = number(fitted);
        }
    }
    remove(&mut scene["damping"], &["ratio", "from", "joint", "joint_ratio"]);
    if !(scene.contains_key("move") || scene.contains_key("moves")) {
        add_move(&mut scene, arm)?;
    }
    let text = format!("# Fitted to {} by `stillbeam-sim identify`.\n{scene}", logs.join(", "));
    let read = SceneFile::parse("the fitted scene", &text)?;
    let (wanted, got) = (natural::frequencies(arm)?[0], natural::frequencies(&read.arm)?[0]);
    if (got / wanted - 1.0).abs() < EXACT {
        return Ok(text);
    }
    Err(Error::new(format_args!(
        "the fitted scene has {got:.5} Hz, must have {wanted:.5} Hz: a key of the scene gives the same \
         value once more"
    )))
}

/// Adds a move of half a radian, or of 0.1 m, slow enough for the arm.
fn add_move(scene: &mut DocumentMut, arm: &Scene) -> Result<(), Error> {
    let duration = (4.0 / natural::frequencies(arm)?[0]).max(1.0);
    let to = if arm.mount.is_linear() { 0.1 } else { 0.5 };
    let mut table = Table::new();
    table["profile"] = value("quintic");
    table["duration"] = value(significant(duration, 2));
    table["to"] = value(to);
    scene["move"] = Item::Table(table);
    Ok(())
}

fn table_of<'a>(scene: &'a mut DocumentMut, key: &str) -> &'a mut Item {
    if !scene.contains_key(key) {
        scene[key] = Item::Table(Table::new());
    }
    &mut scene[key]
}

fn remove(item: &mut Item, keys: &[&str]) {
    if let Some(table) = item.as_table_like_mut() {
        keys.iter().for_each(|key| drop(table.remove(key)));
    }
}
