//! Link arguments. They stand here because a member's own `.cargo/config.toml` is not read when
//! cargo runs in the workspace root, and the image would come out empty.

use std::path::Path;
use std::{env, fs};

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=../memory.x");
    // cortex-m-rt's script, which takes in memory.x; no page alignment, so no gaps in the flash.
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rustc-link-arg-bins=--nmagic");
    // cortex-m-rt's script takes in the names of the board's handlers; there are none.
    let folder = env::var_os("OUT_DIR").expect("cargo sets it");
    fs::write(Path::new(&folder).join("device.x"), "").expect("the build folder is writable");
    println!("cargo:rustc-link-search={}", Path::new(&folder).display());
}
