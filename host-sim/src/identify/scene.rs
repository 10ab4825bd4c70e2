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

#[cfg(test)]
mod tests {
    use super::*;

    const ARM: &str = "# The arm.\n[link]\nlength = 0.5\nmaterial = \"aluminium\"\nwidth = 0.04\n\
                       thickness = 0.004 # measured\nfrequency = 3.8\n\n[payload]\nmass = 0.5\n\n\
                       [damping]\nratio = 0.01\nfrom = \"beta\"\n";

    #[test]
    fn a_scene_keeps_what_was_not_fitted_and_runs() {
        let mut arm = SceneFile::parse_arm("arm", ARM).unwrap().arm;
        arm.link.bending_stiffness *= 0.9;
        (arm.damping.alpha, arm.damping.beta) = (0.02, 1e-4);
        let text = fitted(ARM, &arm, &[], &["log.csv".to_owned()]).unwrap();
        assert!(text.starts_with("# Fitted to log.csv by `stillbeam-sim identify`.\n# The arm.\n"));
        assert!(text.contains("thickness = 0.004 # measured\n"), "{text}");
        let scene = SceneFile::parse("fitted", &text).unwrap();
        assert!((scene.arm.link.bending_stiffness / arm.link.bending_stiffness - 1.0).abs() < 1e-6);
        assert_eq!((scene.arm.damping.alpha, scene.arm.damping.beta), (0.02, 1e-4));
        assert_eq!(scene.moves.len(), 1);
    }

    #[test]
    fn a_payload_and_a_clamp_are_written_too() {
        let bare = "link = { length = 0.4, mass = 0.0224, bending_stiffness = 0.46 }\n\
                    [move]\nprofile = \"cubic\"\nduration = 1.0\nto = 1.0\n";
        let mut arm = SceneFile::parse("arm", bare).unwrap().arm;
        arm.payload.mass = 0.031;
        arm.hub.stiffness = Some(12.5);
        let free = [Free::Payload, Free::Clamp];
        let text = fitted(bare, &arm, &free, &["log.csv".to_owned()]).unwrap();
        let scene = SceneFile::parse("fitted", &text).unwrap();
        assert_eq!((scene.arm.payload.mass, scene.arm.hub.stiffness), (0.031, Some(12.5)));
        assert_eq!(scene.arm.link.bending_stiffness, 0.46);
    }
}
