//! From a setpoint of the hub to the bytes that a drive receives.
//!
//! A drivetrain knows gear, friction and rotor, and turns hub angle and torque into what the
//! motor's shaft has to do. A drive's protocol then packs that demand into a payload.
//!
//! `cargo run -p stillbeam --example 05_motor_and_drive`

use stillbeam::drive::{ClassicFrame, cia402, moteus, odrive};
use stillbeam::model::OneElement;
use stillbeam::motor::{Direction, Drivetrain, Joint, Ratio};
use stillbeam::stepper::Newmark1;
use stillbeam::{Error, Generator, Link, Move, Profile, Scene};

/// Control period, s.
const TICK: f64 = 0.010;

/// Returns the bytes in hexadecimal.
fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x} ")).collect()
}

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let scene = Scene::new(Link { length: 0.5, mass: 0.054, bending_stiffness: 0.93 });
    let stepper = Newmark1::<f32>::new(&OneElement::consistent(&scene)?, TICK)?;
    let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
    arm.push(&Move::To { profile: Profile::Quintic, duration: 1.0, to: 1.57 })?;

    // The teeth, not a decimal number: no rounding builds up over days of rotation.
    let joint = Joint {
        ratio: Ratio { motor: 50, link: 1 },
        efficiency: 0.85,
        rotor_inertia: 2e-6,
        coulomb: 0.02,
        viscous: 0.005,
        torque_constant: 0.03,
    };
    let drivetrain = Drivetrain::<f32>::new(&joint, Direction::Opposite, 0.25)?;

    let can_open = cia402::Drive::new(1, 65_536, 0.1)?;
    // Three ticks without a setpoint, and the servo stops by itself.
    let servo = moteus::Servo::new(1, 3.0 * TICK)?;
    let node = odrive::Node::new(0)?;

    for k in 0..=100 {
        let setpoint = arm.tick();
        let demand = drivetrain.demand(&setpoint);
        // `None` is a value that is not finite: a drive may take a NaN for a command of its own.
        let pdo = can_open.encode(&demand).expect("finite");
        let registers = servo.encode(&demand).expect("finite");
        let frame = node.set_input_pos::<ClassicFrame>(&demand).expect("finite").payload;
        // What does not fit its format is cut to the nearest value, and said.
        assert!(!pdo.saturated.any() && !registers.saturated.any());

        if k % 25 == 0 {
            let turns = f64::from(demand.position.turns) + f64::from(demand.position.part);
            println!("t = {:.2} s", f64::from(k) * TICK);
            println!("  hub     {:.4} rad, {:.4} N m", setpoint.angle.radians(), setpoint.torque);
            println!("  shaft   {turns:.4} turns, {:.5} N m", demand.torque);
            println!("  CiA 402 {}", hex(&pdo.payload));
            println!("  moteus  {}", hex(&registers.payload));
            println!("  ODrive  {frame:02x?}");
        }
        // Read back, the drive's counts are the demand to half an increment of its encoder.
        let read = can_open.decode(&pdo.payload);
        let apart = read.position.turns as f32 - demand.position.turns as f32
            + (read.position.part - demand.position.part);
        assert!(apart.abs() < 0.6 / 65_536.0, "{apart}");
    }
    Ok(())
}
