#![doc = "Turns an arm by a quarter so that it arrives still: the program of README."]
#![no_std]
#![no_main]

use cortex_m::peripheral::Peripherals;
use panic_halt as _;
use stillbeam::planner::{Planner, Request};
use stillbeam::stepper::{Elastica2, Quality};
use stillbeam::{Error, Generator, Link, Scene, model::Rod};

/// Set-up, once: the arm, and a move of 1.57 rad in 0.6 s.
fn arm() -> Result<Generator<Elastica2<f32>, 8>, Error> {
    let mut scene = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    scene.payload.mass = 0.030;
    let rod = Rod::<2>::new(&scene)?;
    // Fitted for the bend that accelerations up to 100 rad/s² make.
    let stepper = Elastica2::new(&rod, 0.010, Quality::Fast, rod.bend(100.0))?;
    let mut arm = Generator::new(stepper, 0.0)?;
    let request = Request::from_rest(0.0, 1.57).duration(0.6);
    arm.push(&Planner::<f32, 2>::new(&scene, 0.010)?.plan(&request)?.motion())?;
    Ok(arm)
}

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut timer = Peripherals::take().expect("taken once").SYST;
    let mut arm = arm().expect("a link, a tick and a move within their ranges");
    timer.set_reload(1_680_000 - 1); // 10 ms of 168 MHz
    timer.enable_counter();
    loop {
        if timer.has_wrapped() {
            // Angle, rate, acceleration and torque, to your drive.
            core::hint::black_box(arm.tick());
        }
    }
}
