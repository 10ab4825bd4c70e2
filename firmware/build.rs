//! Link arguments. They stand here because a member's own `.cargo/config.toml` is not read when
//! cargo runs in the workspace root, and the image would come out empty.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=../memory.x");
    // cortex-m-rt's script, which takes in memory.x; no page alignment, so no gaps in the flash.
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rustc-link-arg-bins=--nmagic");
}
