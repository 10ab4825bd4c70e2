//! Integrates the rod in time with a library's Runge-Kutta methods.

use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use nalgebra::{SMatrix, SVector};

use super::equations::Rod;
use super::{Integrator, Load, Options, Resume};
use crate::reference::advance::{NOT_FINITE, advance, failure};
use crate::reference::carrying::global;
use crate::reference::integrators::{explicit, implicit};
use crate::reference::schedule::{Schedule, Stretch};
use crate::reference::{ReferenceError, Sample};

/// State of the rod. The first column holds the unknowns, rad, the second their rates divided by
/// the rod's first angular frequency, so that one tolerance fits both.
type State<const N: usize> = SMatrix<f64, N, 2>;

/// The rod on one stretch of the commanded motion.
struct Motion<'a, const N: usize, const P: usize, const S: usize> {
    rod: &'a Rod<N, P, S>,
    schedule: &'a Schedule<'a>,
    stretch: Stretch<'a>,
    /// First angular frequency, rad/s.
    scale: f64,
}

impl<const N: usize, const P: usize, const S: usize> ODE<f64, State<N>> for Motion<'_, N, P, S> {
    fn diff(&self, t: f64, y: &State<N>, dydt: &mut State<N>) {
        let (a, v) = split(y, self.scale);
        let hub = self.schedule.hub_within(&self.stretch, t);
        let at = self.rod.configuration(&a, &v);
        let acceleration = self.rod.acceleration(&at, &a, &v, &hub);
        dydt.set_column(0, &v);
        dydt.set_column(1, &(acceleration / self.scale));
    }
}

fn split<const N: usize>(y: &State<N>, scale: f64) -> (SVector<f64, N>, SVector<f64, N>) {
    (y.column(0).into_owned(), y.column(1) * scale)
}

/// Solves the whole run with N unknowns.
pub(super) fn run<const N: usize, const P: usize, const S: usize>(
    rod: &Rod<N, P, S>,
    schedule: &Schedule<'_>,
    options: &Options,
    progress: &dyn Fn(f64),
) -> Result<Vec<Sample>, ReferenceError> {
    let frequencies = rod.frequencies();
    let scale = frequencies[0];
    let integrator = options.integrator.unwrap_or_else(|| choose(frequencies[N - 1], rod.loss()));

    let mut y = at_rest(rod, schedule)?;
    let mut samples = Vec::new();
    for &t in schedule.initial() {
        samples.push(sample(rod, schedule, scale, t, &y));
    }
    for stretch in schedule.stretches() {
        let motion = Motion { rod, schedule, stretch, scale };
        let mut visit = |t, y: &State<N>| {
            samples.push(sample(rod, schedule, scale, t, y));
            progress(t / schedule.duration());
        };
        y = go(integrator, options.tolerance, &motion, y, &mut visit, &mut |_, _| ())?;
    }
    Ok(samples)
}

/// Returns the rod in static equilibrium at the beginning of the run.
fn at_rest<const N: usize, const P: usize, const S: usize>(
    rod: &Rod<N, P, S>,
    schedule: &Schedule<'_>,
) -> Result<State<N>, ReferenceError> {
    let start = schedule.hub(0.0);
    let rest = rod
        .equilibrium(&start)
        .ok_or(ReferenceError::NoEquilibrium { angle: start.angle.radians() })?;
    let mut y = State::<N>::zeros();
    y.set_column(0, &rest);
    Ok(y)
}

/// Simulates the rod from `resume`, or from rest at the run's beginning, to `until` s. `visit` sees
/// the loads at both ends of every stretch, from within, and after every step between. Returns the
/// final state.
pub(super) fn watch<const N: usize, const P: usize, const S: usize>(
    rod: &Rod<N, P, S>,
    schedule: &Schedule<'_>,
    options: &Options,
    resume: Option<&Resume>,
    until: f64,
    visit: &mut dyn FnMut(Load),
) -> Result<Resume, ReferenceError> {
    let frequencies = rod.frequencies();
    let scale = frequencies[0];
    let integrator = options.integrator.unwrap_or_else(|| choose(frequencies[N - 1], rod.loss()));
    let mut y = match resume {
        Some(resume) => State::<N>::from_column_slice(&resume.state),
        None => at_rest(rod, schedule)?,
    };
    let begin = resume.map_or(0.0, |resume| resume.t);
    let close = 1e-6 * schedule.tick();
    for stretch in schedule.stretches() {
        let stretch =
            Stretch { begin: stretch.begin.max(begin), end: stretch.end.min(until), times: &[] };
        if stretch.end - stretch.begin <= close {
            continue;
        }
        let motion = Motion { rod, schedule, stretch, scale };
        let mut first = true;
        let mut see = |t: f64, y: &State<N>| {
            let hub = schedule.hub_within(&stretch, t);
            let (a, v) = split(y, scale);
            let at = rod.configuration(&a, &v);
            let acceleration = rod.acceleration(&at, &a, &v, &hub);
            let [torque, moment] = rod.loads(&at, &v, &acceleration, &hub);
            visit(Load { t, torque, moment, jumped: std::mem::take(&mut first) });
        };
        see(stretch.begin, &y);
        y = go(integrator, options.tolerance, &motion, y, &mut |_, _| (), &mut see)?;
    }
    Ok(Resume { t: until, state: y.as_slice().to_vec() })
}

/// Integrates one stretch with an integrator. See [`march`].
fn go<const N: usize, const P: usize, const S: usize>(
    integrator: Integrator,
    tolerance: f64,
    motion: &Motion<'_, N, P, S>,
    start: State<N>,
    visit: &mut dyn FnMut(f64, &State<N>),
    each_step: &mut dyn FnMut(f64, &State<N>),
) -> Result<State<N>, ReferenceError> {
    match integrator {
        Integrator::Explicit => march(explicit(tolerance, 0.0), motion, start, visit, each_step),
        Integrator::Implicit => march(implicit(tolerance, 0.0), motion, start, visit, each_step),
    }
}

/// Chooses the integrator by the damping. Stiffness-proportional damping makes the highest
/// polynomial decay at βω², and an explicit step is stable to about 6/βω² only. From βω = 8 on (a
/// damping ratio of 4) the implicit method takes fewer evaluations. Below, the vibration that has
/// to be followed binds both.
pub(super) fn choose(highest: f64, beta: f64) -> Integrator {
    if beta * highest > 8.0 { Integrator::Implicit } else { Integrator::Explicit }
}

/// Integrates one stretch. Calls `visit` at its sample times, each the end of a step without
/// interpolation, and `each_step` after every step. Returns the state at the end.
fn march<const N: usize, const P: usize, const S: usize>(
    mut method: impl OrdinaryNumericalMethod<f64, State<N>>,
    motion: &Motion<'_, N, P, S>,
    start: State<N>,
    visit: &mut dyn FnMut(f64, &State<N>),
    each_step: &mut dyn FnMut(f64, &State<N>),
) -> Result<State<N>, ReferenceError> {
    let Stretch { begin, end, times } = motion.stretch;
    method.init(motion, begin, end, &start).map_err(|error| failure(begin, error))?;
    let (inside, at_end) = times.split_at(times.partition_point(|&t| t < end));
    for &t in inside {
        advance(&mut method, motion, [begin, t], NOT_FINITE, each_step)?;
        visit(t, method.y());
    }
    advance(&mut method, motion, [begin, end], NOT_FINITE, each_step)?;
    for &t in at_end {
        visit(t, method.y());
    }
    Ok(*method.y())
}

fn sample<const N: usize, const P: usize, const S: usize>(
    rod: &Rod<N, P, S>,
    schedule: &Schedule<'_>,
    scale: f64,
    t: f64,
    y: &State<N>,
) -> Sample {
    let hub = schedule.hub(t);
    let (a, v) = split(y, scale);
    let at = rod.configuration(&a, &v);
    let acceleration = rod.acceleration(&at, &a, &v, &hub);
    let [x, deflection] = rod.tip(&at);
    Sample {
        t,
        angle: hub.angle.radians(),
        rate: hub.rate,
        acceleration: hub.acceleration,
        tip: global(&rod.scene, &hub, [x, deflection]),
        payload: global(&rod.scene, &hub, rod.payload(&at)),
        deflection,
        torque: rod.loads(&at, &v, &acceleration, &hub)[0],
    }
}
