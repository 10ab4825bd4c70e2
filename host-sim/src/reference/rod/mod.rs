//! The geometrically exact, inextensible rod: relative angle in integrated Legendre polynomials,
//! Runge-Kutta in time.
//!
//! A point of the link at hub-frame `X = r + ∫₀ˣ cos φ`, `Y = ∫₀ˣ sin φ` with `φ = Σ aₖ ψₖ`, has
//! no other unknowns than the aₖ: spin stiffening, foreshortening and inertial nonlinearity are in
//! the kinematics. Largest error against the same rod with one polynomial more: 1e-5 of L on mild
//! moves.

/// Makes the rod of a scene with that many unknowns, whose type depends on it, and hands it to the
/// expression.
macro_rules! with_rod {
    ($scene:expr, $order:expr, |$rod:ident| $body:expr) => {
        with_rod!(@each $scene, $order, $rod, $body, 5 6 7 8)
    };
    (@each $scene:expr, $order:expr, $rod:ident, $body:expr, $($n:literal)*) => {
        match ($order, $scene.shape.is_uniform()) {
            $(
                ($n, true) => { let $rod = UniformRod::<$n>::new($scene); $body }
                ($n, false) => { let $rod = VariedRod::<$n>::new($scene); $body }
            )*
            (order, _) => Err(ReferenceError::Options {
                given: format!("order = {order}"),
                wanted: "5 to 8 polynomials",
            }),
        }
    };
}

mod driven;
mod equations;
mod inertia;
pub(super) mod legendre;
mod march;
mod statics;

pub(crate) use driven::{Driven, Response, driven};
use equations::{UniformRod, VariedRod};
use stillbeam::hub::HubState;
use stillbeam::{Angle, Scene};

use super::option::within;
use super::schedule::Schedule;
use super::{ReferenceError, Sample};
use crate::trajectory::Trajectory;

/// Polynomials of what is asked of the rod without options.
const ORDER: usize = 7;

/// Options of the rod's solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Number of polynomials, 5 to 8.
    pub order: usize,
    /// Relative and absolute tolerance of a step, on angles in rad and on their rates over the
    /// link's first angular frequency; 1e-12 to 1e-4.
    pub tolerance: f64,
    /// Fixed choice of the integrator; `None` chooses by the scene's damping.
    pub integrator: Option<Integrator>,
}

/// The Runge-Kutta method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Integrator {
    /// Dormand and Prince, order 8(5,3). The step is bound by the highest polynomial's frequency
    /// ω (about 6/ω), or by its decay (about 6/βω²).
    Explicit,
    /// Kværnø, order 5(4), L-stable: for strong stiffness-proportional damping.
    Implicit,
}

impl Default for Options {
    fn default() -> Self {
        Self { order: 7, tolerance: 1e-9, integrator: None }
    }
}

/// Solves a run of the scene and samples it at `times` (s, ascending, within the run).
///
/// The arm starts from rest in static equilibrium at the first angle. The motion is plane, the hub
/// frame as in [`Scene`]. See [`Options`] for errors.
pub fn solve(
    scene: &Scene,
    trajectory: &Trajectory,
    times: &[f64],
    options: &Options,
) -> Result<Vec<Sample>, ReferenceError> {
    solve_with(scene, trajectory, times, options, &|_| ())
}

/// Solves as [`solve`] does and calls `progress` with the fraction of the run that is done, 0 to 1.
pub fn solve_with(
    scene: &Scene,
    trajectory: &Trajectory,
    times: &[f64],
    options: &Options,
    progress: &dyn Fn(f64),
) -> Result<Vec<Sample>, ReferenceError> {
    let scene = scene.validate()?;
    within("tolerance", options.tolerance, [1e-12, 1e-4], "1e-12 to 1e-4")?;
    let schedule = Schedule::new(trajectory, times)?;
    with_rod!(&scene, options.order, |rod| march::run(&rod, &schedule, options, progress))
}

/// Loads at the hub at one instant of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// Time, s.
    pub t: f64,
    /// τ at the hub, J_h θ̈ included, N m.
    pub torque: f64,
    /// M, bending moment at the clamp, N m.
    pub moment: f64,
    /// True for the first instant of a stretch with one formula. The loads may jump before it.
    pub jumped: bool,
}

/// A state of the rod in the middle of a flight.
#[derive(Clone, Debug, PartialEq)]
pub struct Resume {
    /// Time, s.
    t: f64,
    /// Unknowns and scaled rates.
    state: Vec<f64>,
}

/// Simulates the arm from `resume`, or else from rest at the beginning, to `until` s. `visit` sees
/// the loads at every step of the integrator and on both sides of every break. The steps resolve
/// the fastest vibration of the rod.
///
/// Returns the final state, from which a flight with the same options can resume.
pub fn watch(
    scene: &Scene,
    trajectory: &Trajectory,
    options: &Options,
    resume: Option<&Resume>,
    until: f64,
    visit: &mut dyn FnMut(Load),
) -> Result<Resume, ReferenceError> {
    let scene = scene.validate()?;
    let schedule = Schedule::new(trajectory, &[])?;
    with_rod!(&scene, options.order, |rod| {
        march::watch(&rod, &schedule, options, resume, until, visit)
    })
}

/// Returns hub torque and bending moment at the clamp, N m, of the arm at rest under its own weight
/// with the hub at `angle`.
pub fn rest_loads(scene: &Scene, angle: Angle<f64>) -> Result<[f64; 2], ReferenceError> {
    Ok(at_rest(scene, angle)?.loads)
}

/// The arm at rest.
struct Rest {
    /// Hub torque and bending moment at the clamp, N m.
    loads: [f64; 2],
    /// Hub-frame X and Y of the tip, m.
    tip: [f64; 2],
}

/// Solves for the arm at rest under its own weight with the hub at `angle`.
fn at_rest(scene: &Scene, angle: Angle<f64>) -> Result<Rest, ReferenceError> {
    let scene = scene.validate()?;
    let (sin, cos) = angle.sin_cos();
    let hub = HubState { sin, cos, ..HubState::at_rest(angle) };
    with_rod!(&scene, ORDER, |rod| {
        let a = rod
            .equilibrium(&hub)
            .ok_or(ReferenceError::NoEquilibrium { angle: angle.radians() })?;
        let still = a.map(|_| 0.0);
        let configuration = rod.configuration(&a, &still);
        let loads = rod.loads(&configuration, &still, &still, &hub);
        Ok(Rest { loads, tip: rod.tip(&configuration) })
    })
}

/// Returns the first natural period of the straight arm on a hub that is held, s.
pub fn first_period(scene: &Scene) -> Result<f64, ReferenceError> {
    let scene = scene.validate()?;
    with_rod!(&scene, ORDER, |rod| Ok(std::f64::consts::TAU / rod.frequencies()[0]))
}

/// Returns the damping ratio of the first mode of the straight arm on a hub that is held, the
/// joint's own damping included.
pub fn first_damping_ratio(scene: &Scene) -> Result<f64, ReferenceError> {
    let scene = scene.validate()?;
    Ok(stillbeam::model::Rod::<1>::new(&scene)?.damping_ratio()[0])
}

/// Returns the hub-frame Y of the tip, m, of the arm at rest under its own weight with the hub at
/// `angle`. A run's residual vibration is measured from it, whatever model made the run. Error
/// below 1e-9 L.
pub fn rest_deflection(scene: &Scene, angle: Angle<f64>) -> Result<f64, ReferenceError> {
    rest_tip(scene, angle).map(|[_, y]| y)
}

/// Returns hub-frame X and Y of the tip, m, of the arm at rest under its own weight with the hub at
/// `angle`.
pub fn rest_tip(scene: &Scene, angle: Angle<f64>) -> Result<[f64; 2], ReferenceError> {
    Ok(at_rest(scene, angle)?.tip)
}
