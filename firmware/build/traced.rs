//! The arms of the program `traced`: each method with everything a scene can have, and with less.

use std::fmt::Write;

use stillbeam_golden::methods::{Method, Visitor, visit_all};

use crate::{arms, scenes};

/// The methods whose ticks are traced, by their names in the list of methods.
const METHODS: [&str; 5] = ["Newmark1", "Newmark1Nodal", "Modal2", "Elastica2", "Elastica2Fine"];

/// `TICK`, and `trace_all`, which hands every arm to `trace`, by method, terms and words.
pub fn text() -> String {
    let mut calls = Calls(String::new());
    visit_all(&mut calls);
    let tick = scenes::TICK;
    format!("const TICK: f64 = {tick:?};\nfn trace_all(output: &mut Output) {{\n{}}}\n", calls.0)
}

struct Calls(String);

impl Visitor for Calls {
    fn visit<M: Method>(&mut self) {
        if !METHODS.contains(&M::ID) {
            return;
        }
        for (terms, scene) in [("all", scenes::FULL), ("neither", scenes::LEAN)] {
            let stepper = M::stepper(&scene, scenes::TICK).expect("every method takes this arm");
            writeln!(
                self.0,
                "trace::<stillbeam_golden::methods::{}>(output, \"{terms}\", &{:?});",
                M::ID,
                arms::words(&stepper)
            )
            .expect("a string");
        }
    }
}
