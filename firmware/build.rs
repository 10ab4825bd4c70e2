//! Link arguments, and the prepared arms of the application and of small programs. The arguments
//! stand here because a member's own `.cargo/config.toml` is not read when cargo runs in the
//! workspace root, and the image would come out empty.

#[path = "build/arms.rs"]
mod arms;
#[path = "src/bench/scenes.rs"]
mod scenes;
#[path = "build/traced.rs"]
mod traced;

use std::path::Path;
use std::{env, fs};

use stillbeam_golden::methods::{Method, Visitor, visit_all};
use stillbeam_golden::scenes::SCENES;

/// Where the application's boards are, one file each.
const BOARDS: &str = "src/bin/application/boards";

/// The exported arm of the example in C, which the program `prepared_axis` has too.
const EXPORTED: &str = "../bindings/c/examples/arm.h";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-changed=build");
    println!("cargo:rerun-if-changed=../memory.x");
    println!("cargo:rerun-if-changed={BOARDS}");
    // cortex-m-rt's script, which takes in memory.x; no page alignment, so no gaps in the flash.
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rustc-link-arg-bins=--nmagic");

    let chosen = chosen();
    let folder = env::var_os("OUT_DIR").expect("cargo sets it");
    let folder = Path::new(&folder);
    println!("cargo:rustc-link-search={}", folder.display());
    let board = chosen.as_deref().unwrap_or("mps2");
    let memory = memory(Path::new(BOARDS).join(board).with_extension("rs").as_path());
    fs::write(folder.join("board.x"), memory).expect("the build folder is writable");
    // The report's level, read where its macros are expanded.
    println!("cargo:rustc-env=DEFMT_LOG=info");
    // The one method of the program `prepared`.
    println!("cargo:rerun-if-env-changed=STILLBEAM_METHOD");
    let method = env::var("STILLBEAM_METHOD").unwrap_or_else(|_| "Newmark1Nodal".into());
    fs::write(folder.join("prepared.rs"), prepared(&method)).expect("the build folder is writable");
    println!("cargo:rerun-if-changed=src/bench/scenes.rs");
    fs::write(folder.join("traced.rs"), traced::text()).expect("the build folder is writable");
    println!("cargo:rerun-if-changed={EXPORTED}");
    fs::write(folder.join("exported.rs"), exported()).expect("the build folder is writable");
    if let Some(board) = &chosen {
        fs::write(folder.join("arms.rs"), arms::text()).expect("the build folder is writable");
        println!("cargo:rustc-link-arg-bin=application=-Tdefmt.x");
        // The image names its board, so that none is taken for another's: a symbol, no byte.
        println!("cargo:rustc-link-arg-bin=application=--defsym=_board_{board}=0");
    }
    if board == "mps2" {
        // cortex-m-rt's script takes in the names of the board's handlers from here, or where there
        // is one, from the crate of the processor's registers. Here a program has its own table.
        fs::write(folder.join("device.x"), "").expect("the build folder is writable");
    }
    if chosen.as_deref() == Some("mps2") {
        // The stack's top: 64 KiB for statics and stack, room for every method's set-up. What the
        // application may take of them is a test's to say.
        println!("cargo:rustc-link-arg-bin=application=--defsym=_stack_start=0x20010000");
    }
}

/// The arm of the program `prepared` as constants: what set-up on the target would have computed,
/// to the bit. Other names than those of methods are for other programs.
fn prepared(method: &str) -> String {
    struct Chosen<'a> {
        method: &'a str,
        text: Option<String>,
    }
    impl Visitor for Chosen<'_> {
        fn visit<M: Method>(&mut self) {
            if M::ID != self.method {
                return;
            }
            let run = SCENES.iter().find(|run| run.name == "b-tip30").expect("the paper's arm");
            let stepper = M::stepper(&run.scene, run.tick).expect("every method takes this arm");
            let words = arms::words(&stepper);
            let known = match (M::METHOD, M::QUALITY) {
                ("elastica", "fast") => format!(
                    "use stillbeam::stepper::{{Elastica, ElasticaFast}};\n\
                     fn known(stepper: &Elastica<f32, {k}>) -> Option<ElasticaFast<'_, f32, {k}>> {{\n    \
                     stepper.fast()\n}}\n",
                    k = M::SIZE
                ),
                _ => "fn known<S>(stepper: &S) -> Option<&S> {\n    Some(stepper)\n}\n".into(),
            };
            self.text = Some(format!(
                "use stillbeam_golden::methods::{} as Chosen;\n\
                 const TICK: f64 = {:?};\n\
                 static ARM: [u32; {}] = {words:?};\n{known}",
                M::ID,
                run.tick,
                words.len()
            ));
        }
    }
    let mut chosen = Chosen { method, text: None };
    visit_all(&mut chosen);
    chosen.text.unwrap_or_else(|| {
        format!("compile_error!(\"STILLBEAM_METHOD = {method}: must be a name in methods/src/lib.rs\");\n")
    })
}

/// The exported arm of the example in C as constants of Rust: its tick and its words.
fn exported() -> String {
    let text = fs::read_to_string(EXPORTED).unwrap_or_else(|error| panic!("{EXPORTED}: {error}"));
    let tick = text.split("STILLBEAM_TICK ").nth(1).and_then(|rest| rest.lines().next());
    let tick = tick.unwrap_or_else(|| panic!("{EXPORTED}: STILLBEAM_TICK"));
    let words: Vec<&str> = text.split("0x").skip(1).map(|rest| &rest[..8]).collect();
    let list: String = words.iter().map(|digits| format!("0x{digits}, ")).collect();
    format!("const TICK: f64 = {tick};\nstatic ARM: [u32; {}] = [{list}];\n", words.len())
}

/// The board whose feature is on, by its file's name.
fn chosen() -> Option<String> {
    let files = fs::read_dir(BOARDS).expect("the boards' folder");
    let names = files.filter_map(|file| {
        let path = file.expect("the boards' folder").path();
        if path.is_dir() {
            return None;
        }
        Some(path.file_stem()?.to_str()?.to_owned())
    });
    let mut on = names
        .filter(|name| env::var_os(format!("CARGO_FEATURE_{}", name.to_uppercase())).is_some());
    let chosen = on.next();
    assert!(on.next().is_none(), "features: one board at a time");
    chosen
}

/// The memory regions in a board's file: its lines that begin with `//! FLASH` and `//! RAM`.
fn memory(board: &Path) -> String {
    let text = fs::read_to_string(board).unwrap_or_else(|e| panic!("{}: {e}", board.display()));
    let regions: Vec<&str> = ["FLASH", "RAM"]
        .iter()
        .filter_map(|region| {
            let mut lines = text.lines().filter_map(|line| line.strip_prefix("//! "));
            lines.find(|line| line.starts_with(region) && line.contains("ORIGIN"))
        })
        .collect();
    assert!(regions.len() == 2, "{}: `//! FLASH : ORIGIN = …` and RAM", board.display());
    format!("MEMORY\n{{\n  {}\n}}\n", regions.join("\n  "))
}
