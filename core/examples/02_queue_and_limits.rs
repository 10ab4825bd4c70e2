//! A queue of moves within limits, and a move that is refused.
//!
//! Moves wait in a queue of fixed size and follow each other without a gap. A move that exceeds a
//! limit is refused as a whole: nothing changes, and the generator says what would keep the limit.
//!
//! `cargo run -p stillbeam --example 02_queue_and_limits`

use stillbeam::model::EightElements;
use stillbeam::stepper::Modal2;
use stillbeam::{Error, Generator, Limits, Link, Move, Profile, Remedy, Scene};

/// Control period, s.
const TICK: f64 = 0.010;

/// Runs the example.
pub fn main() -> Result<(), Error> {
    let scene = Scene::new(Link { length: 0.5, mass: 0.054, bending_stiffness: 0.93 });
    // Two modes of small deflections: the cheapest method for an arm that bends by a few per cent.
    let stepper = Modal2::<f32>::new(&EightElements::consistent(&scene)?, TICK)?;
    // A quintic takes one of the eight places, a trapezoid three, an S-curve seven.
    let mut arm = Generator::<_, 8>::new(stepper, 0.0)?;
    // Limits of the hub's motion, kept between the ticks too.
    arm.limit(Limits { rate: Some(4.0), acceleration: Some(20.0), ..Limits::default() })?;

    let out = Move::To { profile: Profile::Quintic, duration: 0.8, to: 1.2 };
    let wait = Move::Dwell { duration: 0.1 };
    let back = Move::To { profile: Profile::Quintic, duration: 0.3, to: 0.0 };
    for motion in [out, wait] {
        let accepted = arm.push(&motion)?;
        println!(
            "accepted: {} ticks, peaks {:.2} rad/s and {:.1} rad/s^2",
            accepted.ticks, accepted.peaks.rate, accepted.peaks.acceleration
        );
    }

    // Back in 0.3 s is too fast for the rate. A refusal is an ordinary value, not a panic.
    let refusal = arm.push(&back).expect_err("4 rad/s are not enough for that");
    println!("refused:  {refusal}");
    assert!(matches!(refusal, Error::LimitExceeded { parameter: "limits.rate", .. }));

    // The remedy is computed on request only, so that firmware that never asks does not link it.
    let remedy = arm.remedy(&back);
    println!("remedy:   {remedy}");
    let Remedy::Duration(duration) = remedy else { panic!("{remedy}: a longer move does") };
    let accepted = arm.push(&back.lasting(duration))?;
    println!("accepted: {} ticks, peaks {:.2} rad/s", accepted.ticks, accepted.peaks.rate);
    assert!(accepted.peaks.rate <= 4.0);

    // Every tick until the queue is empty; the fastest one is what the limit is about.
    let mut fastest = 0.0f32;
    let mut ticks = 0;
    loop {
        let setpoint = arm.tick();
        fastest = fastest.max(setpoint.rate.abs());
        ticks += 1;
        if arm.is_holding() {
            assert!(setpoint.angle.radians().abs() < 1e-6);
            break;
        }
    }
    println!("\n{ticks} ticks; the hub turned at {fastest:.3} rad/s at most, the limit is 4 rad/s");
    assert!(fastest <= 4.0 * (1.0 + 1e-6), "{fastest}");
    Ok(())
}
