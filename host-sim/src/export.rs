//! Prepared arms: the stepper of a scene as words that a program loads in place of its set-up.
//!
//! A firmware whose arms are scene files calls [`for_build_script`] in its build script; an arm is
//! then changed by editing its file.
//!
//! ```no_run
//! // In the `main` of build.rs; in Cargo.toml under [build-dependencies]:
//! // stillbeam-sim = { version = "0.2", default-features = false }
//! // Then in the firmware: include!(concat!(env!("OUT_DIR"), "/arm.rs"));
//! if let Err(error) = stillbeam_sim::export::for_build_script("arm.toml", "arm.rs", false) {
//!     panic!("{error}");
//! }
//! ```

use std::path::Path;

use stillbeam::planner::Planner;
use stillbeam::prepared::Prepare;

use crate::dispatch;
use crate::error::Error;
use crate::scene_file::SceneFile;
use crate::solver::Solver;
use crate::{output, scenes};

/// The steppers of an arm with each of its payloads, all of one type.
#[derive(Clone, Debug, PartialEq)]
pub struct PreparedArm {
    /// The scene's name.
    pub name: String,
    /// The solver in words; with `auto`, its choice.
    pub method: String,
    /// Rust type that loads the words.
    pub stepper: String,
    /// Control period, s.
    pub tick: f64,
    /// Masses of the payload, kg.
    pub payloads: Vec<f64>,
    /// Words of the stepper with each payload.
    pub arms: Vec<Vec<u32>>,
    /// Words of the planner of still moves with each payload; empty unless asked for.
    pub planners: Vec<Vec<u32>>,
}

/// Prepares the stepper that `solver` asks for: for the scene's own payload, or if `payloads` (kg)
/// are given, for each of them. With `still` also a planner of still moves in two modes for each.
///
/// # Errors
/// A payload or a scene that the method or the planner refuses; payloads for which `auto` chooses
/// different methods.
pub fn prepare(
    scene: &SceneFile,
    solver: &Solver,
    payloads: &[f64],
    still: bool,
) -> Result<PreparedArm, Error> {
    let own = [scene.arm.payload.mass];
    let payloads = if payloads.is_empty() { &own } else { payloads };
    let (mut arms, mut planners) = (Vec::new(), Vec::new());
    let mut first: Option<Type> = None;
    for &mass in payloads {
        let mut scene = scene.clone();
        scene.arm.payload.mass = mass;
        let stepper = dispatch::stepper(&scene, solver)?;
        let kind = Type(stepper.kind());
        let wanted = *first.get_or_insert(kind);
        if kind != wanted {
            return Err(Error::new(format_args!(
                "payload = {mass} kg: {} is chosen for it, must be {} as for {} kg; give the method",
                kind.rust(),
                wanted.rust(),
                payloads[0]
            )));
        }
        arms.push(stepper.words());
        if still {
            planners.push(words_of(&Planner::<f32, 2>::new(&scene.arm, solver.tick)?));
        }
    }
    Ok(PreparedArm {
        name: scene.name.clone(),
        method: solver.describe(),
        stepper: first.map(|kind| kind.rust()).unwrap_or_default(),
        tick: solver.tick,
        payloads: payloads.to_vec(),
        arms,
        planners,
    })
}

/// Prepares the arm of a scene file for the package whose build script calls it: writes Rust
/// constants to `file` in cargo's `OUT_DIR`, anew whenever the scene file changes. Method, tick and
/// payload are the scene's; with `still` also the planner.
///
/// # Errors
/// Those of [`prepare`]; a scene file that cannot be read; no `OUT_DIR` outside of a build script.
pub fn for_build_script(scene: &str, file: &str, still: bool) -> Result<(), Error> {
    let folder = std::env::var_os("OUT_DIR").ok_or_else(|| {
        Error::new("OUT_DIR = unset: must be set by cargo; call this from a build script")
    })?;
    println!("cargo:rerun-if-changed={scene}");
    write_rust(scene, &Path::new(&folder).join(file), still)
}

/// Prepares the arm of a scene file with the scene's own solver, and writes Rust constants.
///
/// # Errors
/// Those of [`prepare`]; a file that cannot be read or written.
pub fn write_rust(scene: &str, file: &Path, still: bool) -> Result<(), Error> {
    let scene = scenes::open(scene)?;
    let arm = prepare(&scene, &scene.solver.resolve()?, &[], still)?;
    output::write_whole(file, |out| out.write_all(arm.to_rust().as_bytes()))
}

fn words_of(value: &impl Prepare) -> Vec<u32> {
    let mut words = Vec::new();
    value.prepare(&mut |word| words.push(word));
    words
}

/// The type of a stepper: [`Prepared::KIND`](stillbeam::prepared::Prepared::KIND).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Type([u32; 3]);

impl Type {
    /// Writes the type as Rust does, e.g. `Elastica<f32, 2>`.
    fn rust(self) -> String {
        let [family, sizes, _] = self.0;
        let letters = family.to_le_bytes();
        let [n, w, variant, bytes] = sizes.to_le_bytes();
        let scalar = if bytes == 8 { "f64" } else { "f32" };
        let own = match &letters.map(|letter| letter.to_ascii_lowercase()) {
            b"rigi" => format!("Rigid<{scalar}>"),
            b"newm" if variant == 0 => format!("Newmark<{scalar}, {n}, {w}, false>"),
            b"newm" => format!("Newmark<{scalar}, {n}, {w}>"),
            b"moda" => format!("Modal<{scalar}, {n}>"),
            b"poin" => format!("Pointwise<{scalar}, {n}>"),
            _ => format!("Elastica<{scalar}, {n}>"),
        };
        if letters[0].is_ascii_uppercase() { format!("OnCarrier<{own}>") } else { own }
    }
}

impl PreparedArm {
    /// Writes the arm as Rust constants: `ARM` and `PLANNER`, or with several payloads tables
    /// `ARMS`, `PLANNERS` and `PAYLOADS`.
    pub fn to_rust(&self) -> String {
        let mut text: String = self.remarks().map(|line| format!("// {line}\n")).concat();
        if self.payloads.len() > 1 {
            text += &format!(
                "\n/// Masses of the payload, kg.\npub static PAYLOADS: [f64; {}] = [{}];\n",
                self.payloads.len(),
                self.masses()
            );
        }
        text += &self.rust_table("ARM", &self.stepper, &self.arms);
        if !self.planners.is_empty() {
            text += &self.rust_table("PLANNER", "Planner<f32, 2>", &self.planners);
        }
        text
    }

    /// Writes a constant, or with several payloads a table of them.
    fn rust_table(&self, name: &str, stands_for: &str, table: &[Vec<u32>]) -> String {
        let (type_name, tick) = (stands_for.replacen('<', "::<", 1), self.tick);
        let length = table.first().map_or(0, Vec::len);
        if let [words] = table {
            let words = rows("    ", words, ["[", "]"]);
            return format!(
                "\n/// Words for `{type_name}::load(&{name}, {tick:?})`.\n\
                 pub static {name}: [u32; {length}] = {words};\n"
            );
        }
        let rows: String = table
            .iter()
            .map(|words| format!("    {},\n", rows("        ", words, ["[", "    ]"])))
            .collect();
        format!(
            "\n/// Words for `{type_name}::load(&{name}S[i], {tick:?})`, one row a payload.\n\
             pub static {name}S: [[u32; {length}]; {}] = [\n{rows}];\n",
            table.len()
        )
    }

    /// Writes the arm as a C header: tables with a row for each payload.
    pub fn to_c(&self) -> String {
        let mut text: String = self.remarks().map(|line| format!("/* {line} */\n")).concat();
        text += &format!(
            "#ifndef STILLBEAM_ARM_H\n#define STILLBEAM_ARM_H\n\n#include <stdint.h>\n\n\
             #define STILLBEAM_ARMS {}\n\n/* Control period, s. */\n\
             #define STILLBEAM_TICK {:?}\n\n/* Masses of the payload, kg. */\n\
             static const double stillbeam_payloads[STILLBEAM_ARMS] = {{{}}};\n",
            self.payloads.len(),
            self.tick,
            self.masses()
        );
        text += &c_table("arm", &self.arms);
        if !self.planners.is_empty() {
            text += &c_table("planner", &self.planners);
        }
        text + "\n#endif\n"
    }

    /// Returns the arm as bytes, four a word, the lowest first: for each payload the stepper, and
    /// behind it the planner if there is one.
    pub fn to_bytes(&self) -> Vec<u8> {
        let planner = |i: usize| self.planners.get(i).into_iter().flatten();
        let words = self.arms.iter().enumerate().flat_map(|(i, arm)| arm.iter().chain(planner(i)));
        words.flat_map(|word| word.to_le_bytes()).collect()
    }

    /// Bytes of one payload.
    pub fn bytes_each(&self) -> usize {
        let length = |table: &[Vec<u32>]| table.first().map_or(0, |words| 4 * words.len());
        length(&self.arms) + length(&self.planners)
    }

    /// Says what the constants are, in lines without a mark of comment.
    fn remarks(&self) -> [String; 2] {
        [
            "Written by `stillbeam-sim export`: export the arm anew rather than edit it."
                .to_owned(),
            format!("Scene {}: {}, loaded by {}.", self.name, self.method, self.stepper),
        ]
    }

    /// Writes the payloads' masses as a list.
    fn masses(&self) -> String {
        self.payloads.iter().map(|mass| format!("{mass:?}")).collect::<Vec<_>>().join(", ")
    }
}

/// Writes a table of words in C, a row for each payload.
fn c_table(name: &str, table: &[Vec<u32>]) -> String {
    let length = table.first().map_or(0, Vec::len);
    let macro_name = format!("STILLBEAM_{}_WORDS", name.to_uppercase());
    let rows: String = table
        .iter()
        .map(|words| format!("    {},\n", rows("        ", words, ["{", "    }"])))
        .collect();
    format!(
        "\n#define {macro_name} {length}\n\
         static const uint32_t stillbeam_{name}s[STILLBEAM_ARMS][{macro_name}] = {{\n{rows}}};\n"
    )
}

/// Writes words eight a line, between brackets.
fn rows(indent: &str, words: &[u32], [open, close]: [&str; 2]) -> String {
    let line =
        |row: &[u32]| row.iter().map(|word| format!("{word:#010x}")).collect::<Vec<_>>().join(", ");
    let lines: String = words.chunks(8).map(|row| format!("{indent}{},\n", line(row))).collect();
    format!("{open}\n{lines}{close}")
}
