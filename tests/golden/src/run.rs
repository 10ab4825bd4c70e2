//! Runs every scene with every method, the same way on host and target.

use stillbeam::model::Rod;
use stillbeam::planner::{Planner, Request, Target};
use stillbeam::prepared::{Prepare, Prepared};
use stillbeam::stepper::{Elastica, Quality};
use stillbeam::{Angle, Error, Generator, Setpoint};

use crate::methods::{HAS_FPU, Method, Visitor, visit_all, visit_few};
use crate::motions::{self, FEW_WAYPOINTS, MOTIONS, WAYPOINTS};
use crate::scenes::{Run, SCENES};

/// Segments of the longest scene, at least.
const QUEUE: usize = 32;

/// One scene with one method.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Position in the run, from 0.
    pub index: u32,
    /// The scene's name.
    pub scene: &'static str,
    /// [`Method::METHOD`].
    pub method: &'static str,
    /// [`Method::SIZE`].
    pub size: u32,
    /// [`Method::QUALITY`].
    pub quality: &'static str,
    /// [`Method::SKIP`].
    pub skip: &'static str,
}

/// Steps every case through its moves and the time after them, and hands every setpoint to `sink`
/// with its tick, from 0. Returns the cases that ran.
///
/// A method that does not carry the rate of a scene has no setpoints of it.
///
/// # Errors
/// The first scene or move that the core refuses for any other reason; none of the embedded ones
/// is.
pub fn run<F>(sink: &mut F) -> Result<u32, Error>
where
    F: FnMut(&Case, u32, &Setpoint<f32>) + ?Sized,
{
    run_by(sink, visit_all, &STILL_SCENES, WAYPOINTS)
}

/// Runs as [`run()`] does what processors without a floating-point unit run, on any processor: a
/// method of each way to step, and one arm with still moves.
///
/// # Errors
/// Errors are those of [`run()`].
pub fn run_few<F>(sink: &mut F) -> Result<u32, Error>
where
    F: FnMut(&Case, u32, &Setpoint<f32>) + ?Sized,
{
    run_by(sink, visit_few, &STILL_SCENES[..1], FEW_WAYPOINTS)
}

/// Runs what the processor runs which this is compiled for: everything, or without a floating-point
/// unit what [`run_few`] does.
///
/// # Errors
/// Errors are those of [`run()`].
pub fn run_own<F>(sink: &mut F) -> Result<u32, Error>
where
    F: FnMut(&Case, u32, &Setpoint<f32>) + ?Sized,
{
    if HAS_FPU { run(sink) } else { run_few(sink) }
}

/// The methods that `visit` shows, then still moves and the motions that no scene has.
fn run_by<'a, F>(
    sink: &'a mut F,
    visit: fn(&mut Runner<'a, F>),
    still: &[&str],
    waypoints: u32,
) -> Result<u32, Error>
where
    F: FnMut(&Case, u32, &Setpoint<f32>) + ?Sized,
{
    let mut runner = Runner { sink, cases: 0, result: Ok(()) };
    visit(&mut runner);
    runner.stills(still);
    runner.motions(waypoints);
    runner.result.map(|()| runner.cases)
}

struct Runner<'a, F: ?Sized> {
    sink: &'a mut F,
    cases: u32,
    result: Result<(), Error>,
}

impl<F: FnMut(&Case, u32, &Setpoint<f32>) + ?Sized> Visitor for Runner<'_, F> {
    fn visit<M: Method>(&mut self) {
        for scene in SCENES.iter().filter(|run| M::fits(&run.scene)) {
            let case = Case {
                index: self.cases,
                scene: scene.name,
                method: M::METHOD,
                size: M::SIZE,
                quality: M::QUALITY,
                skip: M::SKIP,
            };
            self.cases += 1;
            let result = one::<M>(scene, &mut |k, setpoint| (self.sink)(&case, k, setpoint));
            if !matches!(result, Err(Error::TooFast { .. })) {
                self.result = self.result.and(result);
            }
        }
    }
}

/// Words of the largest prepared stepper of the list, at least.
const WORDS: usize = 1024;

/// One scene with one method, its stepper loaded from its own words. The last record holds their
/// checksum in place of a setpoint: it tells whether set-up has given the same bits.
fn one<M: Method>(run: &Run, sink: &mut impl FnMut(u32, &Setpoint<f32>)) -> Result<(), Error> {
    let (mut words, mut count) = ([0; WORDS], 0);
    M::stepper(&run.scene, run.tick)?.prepare(&mut |word| {
        words[count] = word;
        count += 1;
    });
    let stepper = M::Stepper::load(&words[..count], run.tick)?;
    let mut arm = Generator::<_, QUEUE>::new(stepper, run.from)?;
    let mut ticks = 0;
    for motion in run.moves {
        ticks += arm.push(motion)?.ticks;
    }
    for k in 0..=ticks {
        sink(k, &arm.tick());
    }
    let angle = Angle { turns: words[count - 1] as i32, part: 0.0 };
    let checksum = Setpoint { angle, rate: 0.0, acceleration: 0.0, torque: 0.0, tip: [0.0; 2] };
    sink(ticks + 1, &checksum);
    Ok(())
}

/// The arm of the motions that no scene has.
pub const MOTION_SCENE: &str = "d-tip30";

/// Arms whose moves are planned anew, still, and are changed half-way.
pub const STILL_SCENES: [&str; 4] = ["d-fast", "a-tip30", "b-tip30-damped-hub", "s-gravity"];

impl<F: FnMut(&Case, u32, &Setpoint<f32>) + ?Sized> Runner<'_, F> {
    /// Plans made where they run: every bit of them is in the setpoints.
    fn stills(&mut self, names: &[&str]) {
        for scene in SCENES.iter().filter(|run| names.contains(&run.name)) {
            let case = Case {
                index: self.cases,
                scene: scene.name,
                method: "still",
                size: 2,
                quality: "",
                skip: "",
            };
            self.cases += 1;
            let result = one_still(scene, &mut |k, setpoint| (self.sink)(&case, k, setpoint));
            self.result = self.result.and(result);
        }
    }

    fn motions(&mut self, waypoints: u32) {
        for motion in MOTIONS {
            for scene in SCENES.iter().filter(|run| run.name == MOTION_SCENE) {
                let case = Case {
                    index: self.cases,
                    scene: scene.name,
                    method: motion,
                    size: 1,
                    quality: "",
                    skip: "",
                };
                self.cases += 1;
                let sink = &mut |k, setpoint: &Setpoint<f32>| (self.sink)(&case, k, setpoint);
                let result = motions::one(motion, waypoints, scene, sink);
                self.result = self.result.and(result);
            }
        }
    }
}

fn one_still(run: &Run, sink: &mut impl FnMut(u32, &Setpoint<f32>)) -> Result<(), Error> {
    let planner = Planner::<f32, 2>::new(&run.scene, run.tick)?;
    let rod = Rod::<2>::new(&run.scene)?;
    let stepper = Elastica::<f32, 2>::new(&rod, run.tick, Quality::Fast, 0.5)?;
    let mut arm = Generator::<_, QUEUE>::new(stepper, run.from)?;
    let (there, back) = (run.from + 1.0, run.from + 0.2);
    let duration = 1.5 * planner.first_period();
    let request = Request::from_rest(run.from, there).duration(duration).any_deflection();
    arm.push(&planner.plan(&request)?.motion())?;
    let mut k = 0;
    let mut tick = |arm: &mut Generator<_, QUEUE>, ticks: u32| {
        for _ in 0..ticks {
            sink(k, &arm.tick());
            k += 1;
        }
    };
    tick(&mut arm, 7);
    let mut ahead = arm.clone();
    ahead.tick();
    let flex = ahead.stepper().arm_state(ahead.state(), ahead.hub());
    let request = Request::from_hub(ahead.hub().precise(), Target::Angle(back)).arm(flex);
    let plan = planner.plan(&request.duration(2.0 * duration).any_deflection())?;
    arm.redirect(0, &plan)?;
    tick(&mut arm, plan.ticks + 10);
    Ok(())
}
