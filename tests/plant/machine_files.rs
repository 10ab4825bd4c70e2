//! Machine files: what is accepted is kept, what is not is refused by its key.

use stillbeam_sim::plant::{Options, Plant};
use stillbeam_sim::scenes;
use stillbeam_sim::servo::{Machine, Protocol};

#[test]
fn every_embedded_machine_is_one() {
    for name in ["odrive-tuned", "moteus-tuned", "cia402-tuned", "geared"] {
        let machine = Machine::open(name).expect(name);
        let file = format!("{}/machines/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        assert_eq!(Machine::open(&file).expect("the same file"), machine, "{name}");
    }
    let error = Machine::open("no-such").expect_err("no machine").to_string();
    assert!(error.contains("no-such") && error.contains("odrive-tuned"), "{error}");
}

#[test]
fn an_empty_file_is_the_default() {
    assert_eq!(Machine::parse("m", "").expect("a machine"), Machine::default());
}

#[test]
fn what_is_out_of_range_is_named() {
    for (text, wanted) in [
        ("[gear]\nefficiency = 0.1", "m:2:14: gear.efficiency = 0.1: must be 0.3 to 1"),
        ("[gear]\nbacklash = 0.01", "m:2:12: gear.backlash = 0.01: must be absent without"),
        ("[gear]\nstiffness = 10.0\n[motor]\nrotor_inertia = 0.0", "motor.rotor_inertia = 0: must"),
        ("[friction]\ncoulomb = 0.2\nbreakaway = 0.1", "friction.breakaway = 0.1: must be 0.2"),
        ("[encoder]\ncounts = 2", "m:2:10: encoder.counts = 2: must be 4 to"),
        ("[odrive]\nrate = 10.0", "odrive.rate = 10: must be 100 to 40000"),
        ("[odrive]\nbandwidth = 9000.0", "odrive.bandwidth = 9000: must be below"),
        ("[moteus]\nrate = 1000.0\nbandwidth = 850.0", "moteus.bandwidth = 850: must be below 0.8"),
        ("[odrive]\nbetween = \"cubic\"", "odrive.between"),
        ("[odrive]\n[moteus]", "must be one of the three tables"),
        ("[motor]\ntorques = 1.0", "torques"),
        ("[cia402]\nrated_torque = 0.0", "drive.rated_torque = 0: must be"),
    ] {
        let error = Machine::parse("m", text).expect_err(text).to_string();
        assert!(error.contains(wanted), "{text}: {error}");
        assert!(!error.contains('\n'), "{error}");
    }
}

#[test]
fn a_hub_without_inertia_behind_a_spring_is_refused() {
    let text = "[gear]\nstiffness = 2000.0";
    let machine = Machine::parse("m", text).expect("a machine");
    let scene = scenes::open("d-tip30").expect("an embedded scene");
    let plant = Plant::at_rest(&scene.arm, &machine.parts, 0.0, &Options::default());
    let error = plant.err().expect("no inertia").to_string();
    assert!(error.starts_with("gear.output_inertia = 0: must be at least"), "{error}");
}

#[test]
fn drives_are_known_by_name() {
    for name in Protocol::NAMES {
        assert_eq!(Protocol::named(name).expect("a drive").name(), name);
    }
    assert_eq!(Protocol::named("servo"), None);
}
