//! The least that a user needs: set-up, one move, the ticks of it. Its sections are the flash and
//! RAM of the tables; it prints the worst stack as four bytes.
//!
//! The method to be linked is chosen when this is built, by the environment variable
//! `STILLBEAM_METHOD` (a name in the list of methods, `Still2`: elastica with a planner of still
//! moves, or `Fastest2`: elastica with a planner of the fastest ones).
#![no_std]
#![no_main]

use core::hint::black_box;

use cortex_m_rt::entry;
use semihosting::io::{self, Write};
use semihosting::process;
use stillbeam::model::Rod;
use stillbeam::motion::Spline;
use stillbeam::planner::{Planner, Request};
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Error, Generator, Limits, Link, PlainMove, Profile, UniformScene};
use stillbeam_firmware::{exit, stack};
use stillbeam_golden::methods::{Method, Visitor, visit_all};

stillbeam_firmware::unused_interrupts!();

const CHOSEN: &str = match option_env!("STILLBEAM_METHOD") {
    Some(name) => name,
    None => "Newmark1",
};

/// Of `stillbeam_firmware::exit_on_panic`'s two lines, the one that needs no formatting.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    process::exit(exit::PANICKED)
}

/// True if the chosen method has run; why not is not told, so that no text of it is linked.
struct Chosen(Option<()>);

impl Visitor for Chosen {
    #[inline(always)]
    fn visit<M: Method>(&mut self) {
        if const { same(M::ID, CHOSEN) } {
            self.0 = one_move::<M>();
        }
    }
}

/// The paper's member B with 30 g, of which the compiler knows nothing.
#[inline(always)]
fn scene() -> UniformScene {
    let mut scene = black_box(UniformScene::uniform(Link {
        length: 0.4,
        mass: 0.01904,
        bending_stiffness: 0.042656,
    }));
    scene.payload.mass = 0.030;
    scene
}

/// The arm in elastica, for the moves that a planner makes.
#[inline(always)]
fn arm<const QUEUE: usize>(
    scene: &UniformScene,
) -> Result<Generator<Elastica<f32, 2>, QUEUE>, Error> {
    let rod = Rod::<2>::new(scene)?;
    let stepper = Elastica::<f32, 2>::new(&rod, 0.010, Quality::Fast, rod.bend(10.0))?;
    Generator::new(stepper, 0.0)
}

/// A function of its own, whose part of the stack is free again before the arm moves.
#[inline(never)]
fn set_up<M: Method>() -> Option<M::Stepper> {
    M::stepper(&scene(), 0.010).ok()
}

/// Set-up, and the paper's move of member B. A board would write each setpoint to its drive.
#[inline(never)]
fn one_move<M: Method>() -> Option<()> {
    let stepper = set_up::<M>();
    // The generator borrows the stepper, and stays where it is made: no copy is on the stack.
    let mut made = Generator::<_, 2>::new(stepper.as_ref()?, 0.0);
    let arm = made.as_mut().ok()?;
    // The profile is known, so that only it is planned; duration and angle are not.
    let (duration, to) = black_box((2.0, core::f64::consts::PI));
    let motion = PlainMove::To { profile: Profile::Cubic, duration, to };
    arm.push(&motion).ok()?;
    for _ in 0..=400 {
        black_box(arm.tick());
    }
    Some(())
}

/// The same with a still move, planned here.
#[inline(never)]
fn one_still_move() -> Result<(), Error> {
    let scene = scene();
    let mut arm = arm::<2>(&scene)?;
    let planner = Planner::<f32, 2>::new(&scene, 0.010)?;
    let request = Request::from_rest(0.0, black_box(core::f64::consts::PI)).duration(2.0);
    arm.push(&planner.plan(&request.any_deflection())?.plain())?;
    for _ in 0..=400 {
        black_box(arm.tick());
    }
    Ok(())
}

/// The same with the fastest move within an S-curve's limits, followed as a path.
#[inline(never)]
fn one_fastest_move() -> Result<(), Error> {
    let scene = scene();
    let mut arm = arm::<4>(&scene)?;
    let planner = Planner::<f32, 2>::new(&scene, 0.010)?;
    let (to, acceleration, torque) = black_box((core::f64::consts::PI, 5.0, 0.06));
    let limits = Limits {
        rate: Some(3.0),
        acceleration: Some(acceleration),
        jerk: Some(40.0),
        torque: Some(torque),
        ..Limits::default()
    };
    let request = Request::from_rest(0.0, to).limits(limits).any_deflection();
    let plan = planner.fastest::<12>(&request)?.ok_or(Error::NotAtRest { rate: 0.0 })?;
    let mut path = arm.path(Spline::Cubic)?;
    let mut rows = plan.waypoints();
    for _ in 0..=400 {
        arm.feed(&mut path, &mut rows).map_err(|refused| refused.error)?;
        black_box(arm.tick());
    }
    Ok(())
}

/// `a == b`, for use in constants: the methods that were not chosen are not even generated.
const fn same(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut i = 0;
    while i < a.len() && i < b.len() && a[i] == b[i] {
        i += 1;
    }
    i == a.len() && i == b.len()
}

#[entry]
fn main() -> ! {
    stack::paint();
    // An unknown method leaves nothing.
    let mut chosen = Chosen(None);
    visit_all(&mut chosen);
    if const { same("Still2", CHOSEN) } {
        chosen.0 = one_still_move().ok();
    }
    if const { same("Fastest2", CHOSEN) } {
        chosen.0 = one_fastest_move().ok();
    }
    let stack = stack::deepest() as u32;
    let sent = io::stdout().and_then(|mut out| out.write_all(&stack.to_le_bytes()));
    process::exit(if chosen.0.is_some() && sent.is_ok() { 0 } else { 1 })
}
