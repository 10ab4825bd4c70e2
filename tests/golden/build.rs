//! Writes the embedded scenes as constants: the target cannot read TOML, and
//! `host-sim/scenes/*.toml` stay the one place for scenes.

use std::path::Path;
use std::{env, fs};

use stillbeam_sim::scenes;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let mut text = String::from("&[\n");
    for (name, _) in scenes::list() {
        let file = scenes::named(name)
            .unwrap_or_else(|| panic!("{name} is listed"))
            .unwrap_or_else(|error| panic!("{error}"));
        let solver = file.solver.resolve().unwrap_or_else(|error| panic!("{error}"));
        // `Debug` of these types is how they are written in Rust, every bit of a number included.
        text += &format!(
            "Run {{ name: {name:?}, scene: {:?}, from: {:?}, moves: &{:?}, tick: {:?} }},\n",
            file.arm,
            file.from,
            file.motions(),
            solver.tick
        );
    }
    text += "]\n";
    let folder = env::var_os("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&folder).join("scenes.rs"), text).expect("the build folder is writable");
}
