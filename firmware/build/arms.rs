//! The application's arms, set up on the desktop: every axis with every payload of its table.

use std::fmt::Write;
use std::iter;

use stillbeam::planner::Planner;
use stillbeam::prepared::Prepare;
use stillbeam::{Payload, UniformScene};
use stillbeam_wiring::Configuration;
use stillbeam_wiring::axes::{CONFIGURATIONS, TICK, stepper};

/// Most bytes of the payloads in words: a refusal goes in one frame.
const ROOM: usize = 120;

/// `ARMS`, a table of arms an axis, as constants of Rust: what set-up on the target would have
/// computed, to the bit.
pub fn text() -> String {
    let axes =
        CONFIGURATIONS.iter().enumerate().map(|(axis, configuration)| of(axis, configuration));
    format!(
        "static ARMS: [PreparedArms; {}] = [{}];\n",
        CONFIGURATIONS.len(),
        axes.collect::<String>()
    )
}

fn of(axis: usize, configuration: &Configuration) -> String {
    let payloads: Vec<Payload> = iter::once(configuration.scene.payload)
        .chain(configuration.payloads.iter().copied())
        .collect();
    let mut arms = String::new();
    for &payload in &payloads {
        let scene = UniformScene { payload, ..configuration.scene };
        let named = format!("wiring/src/axes.rs: axis {axis} with {}", described(&payload));
        let stepper = stepper(&scene).unwrap_or_else(|error| panic!("{named}: {error}"));
        // Without one the arm still makes every other move.
        let planner = match Planner::<f32, 2>::new(&scene, TICK) {
            Ok(planner) => words(&planner),
            Err(error) => {
                println!("cargo:warning={named}: no still moves: {error}");
                Vec::new()
            }
        };
        let stepper = words(&stepper);
        writeln!(
            arms,
            "PreparedArm {{ payload: {payload:?}, stepper: &{stepper:?}, planner: &{planner:?} }},"
        )
        .expect("a string");
    }
    format!("PreparedArms {{ payloads: {:?}, arms: &[{arms}] }},", listed(&payloads))
}

/// The words that load it.
pub fn words(prepared: &impl Prepare) -> Vec<u32> {
    let mut words = Vec::new();
    prepared.prepare(&mut |word| words.push(word));
    words
}

/// The payloads in words; those that find no room are counted.
fn listed(payloads: &[Payload]) -> String {
    let mut text = String::new();
    for (i, payload) in payloads.iter().enumerate() {
        let one = described(payload);
        if text.len() + one.len() > ROOM {
            write!(text, " and {} more", payloads.len() - i).expect("a string");
            break;
        }
        let comma = if i > 0 { ", " } else { "" };
        write!(text, "{comma}{one}").expect("a string");
    }
    text
}

fn described(payload: &Payload) -> String {
    let Payload { mass, inertia, offset } = *payload;
    let mut text = format!("{mass} kg");
    if inertia != 0.0 {
        write!(text, " with {inertia} kg m^2").expect("a string");
    }
    if offset != 0.0 {
        write!(text, " at {offset} m").expect("a string");
    }
    text
}
