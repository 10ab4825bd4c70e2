//! Link arguments and the memory of QEMU's machine `virt`, which the workspace's `memory.x` takes
//! in.

use std::path::Path;
use std::{env, fs};

/// All of the machine's memory that is used, program and data: it begins where QEMU starts.
const MEMORY: &str = "MEMORY\n{\n  RAM : ORIGIN = 0x80000000, LENGTH = 16M\n}\n";

/// Where riscv-rt puts its sections.
const SECTIONS: [&str; 6] = ["TEXT", "RODATA", "DATA", "BSS", "HEAP", "STACK"];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=../../memory.x");
    let folder = env::var_os("OUT_DIR").expect("cargo sets it");
    println!("cargo:rustc-link-search={}", Path::new(&folder).display());
    println!("cargo:rustc-link-arg-bins=-Tmemory.x");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    let aliases = SECTIONS.map(|section| format!("REGION_ALIAS(\"REGION_{section}\", RAM);\n"));
    let text = MEMORY.to_owned() + &aliases.concat();
    fs::write(Path::new(&folder).join("board.x"), text).expect("the build folder is writable");
}
