//! The examples in C and C++ print the core's own setpoints, and the core's own bytes.

use std::fs;

use stillbeam::axis::{Axis, Policy, StopLimits};
use stillbeam::drive::odrive;
use stillbeam::motor::{Direction, Drivetrain, Joint, Ratio};
use stillbeam::prepared::Prepared;
use stillbeam::stepper::Elastica2;
use stillbeam::{Angle, Limits, PlainMove, Profile};

use crate::compile::{self, folder};

/// A row of an example's output: whole numbers, bits of the values, the drive's bytes.
#[derive(Debug, PartialEq)]
struct Row {
    number: u32,
    turns: i32,
    bits: [u32; 6],
    odrive: String,
}

/// Reads what an example printed.
fn rows(csv: &str) -> Vec<Row> {
    let mut lines = csv.lines();
    let header = "number,turns,part,rate,acceleration,torque,tip_x,tip_y,odrive";
    assert_eq!(lines.next(), Some(header));
    let row = |line: &str| {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), 9, "{line}");
        let value = |i: usize| fields[i].parse::<f32>().expect("a number").to_bits();
        Row {
            number: fields[0].parse().expect("a number"),
            turns: fields[1].parse().expect("a number"),
            bits: [2, 3, 4, 5, 6, 7].map(value),
            odrive: fields[8].to_owned(),
        }
    };
    lines.map(row).collect()
}

/// The words of the exported arm.
fn words() -> Vec<u32> {
    let text = fs::read_to_string(folder().join("examples/arm.h")).expect("examples/arm.h");
    let numbers = text.split("0x").skip(1).map(|rest| &rest[..8]);
    numbers.map(|digits| u32::from_str_radix(digits, 16).expect("eight digits")).collect()
}

/// The same move by the core alone.
fn core() -> Vec<Row> {
    let stepper = Elastica2::<f32>::load(&words(), 0.01).expect("the exported arm");
    let limits = Limits { rate: Some(15.0), acceleration: Some(150.0), ..Limits::default() };
    let policy = Policy { limits, stop: StopLimits::OF_MOVES, patience: 0.0, missed: 0 };
    let origin = Angle { turns: 0, part: 0.0 };
    let mut axis = Axis::<_, 8>::new(stepper, origin, policy).expect("an axis");
    let joint = Joint { ratio: Ratio { motor: 6, link: 1 }, ..Joint::direct(1.0) };
    let train = Drivetrain::<f32>::new(&joint, Direction::Same, 0.0).expect("a gear");
    axis.enable(origin).expect("a disabled axis");
    let motion = PlainMove::To { profile: Profile::Quintic, duration: 0.4, to: 1.57 };
    let planned = axis.plan_context().and_then(|context| context.plan(&motion));
    axis.take(&planned.expect("a move within the limits")).expect("an empty queue");
    let row = |_| {
        let tick = axis.tick();
        let at = tick.setpoint;
        let values = [at.angle.part, at.rate, at.acceleration, at.torque, at.tip[0], at.tip[1]];
        let bytes = odrive::encode(&train.demand(&at)).expect("finite").payload;
        Row {
            number: tick.number,
            turns: at.angle.turns,
            bits: values.map(f32::to_bits),
            odrive: bytes.iter().map(|byte| format!("{byte:02x}")).collect(),
        }
    };
    (0..=60).map(row).collect()
}

#[test]
fn the_example_in_c_has_the_bits_of_the_core() {
    let rows = rows(&compile::run("cc", &["-std=c11"], "examples/host/main.c"));
    assert!(rows.iter().any(|row| f32::from_bits(row.bits[5]).abs() > 0.01), "the arm bends");
    assert_eq!(rows, core());
}

#[test]
fn the_example_in_cpp_has_the_bits_of_the_core() {
    let rows = rows(&compile::run("c++", &["-std=c++11"], "examples/host/main.cpp"));
    assert_eq!(rows, core());
}

/// Against stubs of what their platforms provide: the calls of this library are the right ones.
#[test]
fn the_examples_of_other_platforms_compile() {
    compile::check("cc", &["-std=c11"], "examples/freertos/task.c");
    let sketch = "examples/arduino/examples/OneMove/OneMove.ino";
    compile::check("c++", &["-std=c++11", "-x", "c++"], sketch);
}
