//! Time of a tick and of a set-up, and of the textbook's way of doing the same.
//!
//! `tick` is a step with its torque and tip, the hub turning, so that the spin terms change the
//! effective matrix every tick; `generator` adds the commanded motion. `textbook` does what `tick`
//! does in f64 with consistent mass: the ratio of the two is what preparing once saves.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use stillbeam::hub::{Angle, HubState};
use stillbeam::stepper::AnyMotion;
use stillbeam::{Generator, Move};
use stillbeam_erased::{Erasable, StepperVisitor, with_stepper};
use stillbeam_lab::baseline::Textbook;
use stillbeam_lab::sweep::picture::describe;
use stillbeam_lab::sweep::spec::Spec;
use stillbeam_sim::dispatch;
use stillbeam_sim::scene_file::SceneFile;
use stillbeam_sim::scenes;
use stillbeam_sim::solver::{ELEMENTS, Solver};

const SOLVERS: &str = r#"
    scenes = ["b-tip30"]
    [[grid]]
    method = ["rigid", "newmark"]
    elements = [1, 2, 4, 8]
    mass = ["consistent", "lumped"]
    scalar = ["f32", "f64"]
    [[grid]]
    spin = [false]
    elements = [1, 4]
    [[grid]]
    method = ["modal"]
    modes = [1, 2, 3]
    scalar = ["f32", "f64"]
    [[grid]]
    method = ["elastica"]
    modes = [1, 2]
    quality = ["fast", "fine"]
    scalar = ["f32", "f64"]
"#;

fn solvers() -> Vec<(String, Solver)> {
    let spec = Spec::parse("solvers", SOLVERS).expect("a spec of this file");
    let keys = spec.solvers();
    keys.iter().map(|&keys| (describe(keys), keys.resolve().expect("a known solver"))).collect()
}

fn scene() -> SceneFile {
    scenes::open("b-tip30").expect("an embedded scene")
}

/// A hub that turns steadily.
fn turning<T: stillbeam::Scalar>() -> HubState<T> {
    let angle = Angle::from_radians(0.5).cast();
    let (sin, cos) = angle.sin_cos();
    HubState { angle, sin, cos, rate: T::ONE, acceleration: T::ZERO }
}

struct Tick<'a>(&'a mut Criterion, &'a str);

impl StepperVisitor for Tick<'_> {
    type Output = ();

    fn visit<S: Erasable>(self, stepper: S) {
        let hub = black_box(turning::<S::Scalar>());
        let mut state = stepper.equilibrium(&hub);
        self.0.benchmark_group("tick").bench_function(self.1, |b| {
            b.iter(|| {
                stepper.step::<AnyMotion>(&mut state, &hub, &hub);
                stepper.response::<AnyMotion>(&state, &hub)
            });
        });
    }
}

struct WholeTick<'a>(&'a mut Criterion, &'a str);

impl StepperVisitor for WholeTick<'_> {
    type Output = ();

    fn visit<S: Erasable>(self, stepper: S) {
        let mut generator = Generator::<S, 8>::new(stepper, 0.0).expect("an angle");
        // Longer than any benchmark.
        generator.push(&Move::SpinUp { duration: 160_000.0, rate: 6.0 }).expect("a move");
        self.0.benchmark_group("generator").bench_function(self.1, |b| b.iter(|| generator.tick()));
    }
}

fn steppers(c: &mut Criterion) {
    let arm = scene();
    for (name, solver) in solvers() {
        let spec = dispatch::spec(&arm, &solver, None, None).expect("a stepper");
        with_stepper(&arm.arm, &spec, Tick(c, &name)).expect("a stepper");
        with_stepper(&arm.arm, &spec, WholeTick(c, &name)).expect("a stepper");
        c.benchmark_group("set-up").bench_function(&name, |b| {
            b.iter(|| dispatch::stepper(black_box(&arm), &solver));
        });
    }
}

fn textbook(c: &mut Criterion) {
    let arm = scene();
    let hub = black_box(turning::<f64>());
    let mut group = c.benchmark_group("textbook");
    for elements in ELEMENTS {
        let mut textbook = Textbook::new(&arm.arm, elements, 0.01);
        group.bench_function(BenchmarkId::new("elements", elements), |b| {
            b.iter(|| {
                textbook.step(&hub, &hub);
                textbook.response(&hub)
            });
        });
    }
    group.finish();
}

/// Sixty-odd benchmarks of nanoseconds: a second each is plenty.
fn brief() -> Criterion {
    let criterion = Criterion::default().without_plots();
    criterion.warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(1))
}

criterion_group! {
    name = benches;
    config = brief();
    targets = steppers, textbook
}
criterion_main!(benches);
