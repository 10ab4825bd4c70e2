//! Integrates the chain in time with a library's Runge-Kutta methods.

use differential_equations::linalg::Matrix;
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use nalgebra::DVector;

use super::begin::{begin, pinned};
use super::chain::Chain;
use super::equations::Freedom;
use super::kinematics::{Inertias, Motion};
use crate::mechanism::Moving;
use crate::mechanism::table::Row;
use crate::reference::ReferenceError;
use crate::reference::advance::{advance, failure};
use crate::reference::integrators::{explicit, implicit};
use crate::reference::mechanism::timetable::{Stretch, Timetable};

/// State of the free coordinates, then of their rates divided by [`Flight::scale`], so that one
/// tolerance fits both.
type State = Vec<f64>;

/// The chain on one stretch of the commanded motion.
struct Flight<'a> {
    chain: &'a Chain,
    timetable: &'a Timetable<'a>,
    stretch: Stretch<'a>,
    freedom: &'a Freedom,
    /// Joints that are driven.
    driven: Vec<usize>,
    /// First angular frequency, rad/s.
    scale: f64,
}

impl ODE<f64, State> for Flight<'_> {
    fn diff(&self, t: f64, y: &State, dydt: &mut State) {
        let mut motion = self.motion(y, |joint| self.timetable.within(&self.stretch, joint, t));
        // A loop that locks has no acceleration. The step is then refused as not finite.
        let solved = self.chain.accelerate(&mut motion, self.freedom).is_some();
        let n = self.freedom.free.len();
        for (k, &i) in self.freedom.free.iter().enumerate() {
            dydt[k] = motion.v[i];
            dydt[n + k] = if solved { motion.a[i] / self.scale } else { f64::NAN };
        }
    }

    fn jacobian(&self, t: f64, y: &State, j: &mut Matrix<f64>) {
        self.fill_jacobian(t, y, j);
    }
}

impl Flight<'_> {
    /// Fills in the stiff part of the Jacobian. The iterations that use it converge on the exact
    /// equations all the same.
    fn fill_jacobian(&self, t: f64, y: &State, j: &mut Matrix<f64>) {
        let motion = self.motion(y, |joint| self.timetable.within(&self.stretch, joint, t));
        let n = self.freedom.free.len();
        let Some([by_place, by_rate]) = self.chain.stiff_part(&motion, self.freedom) else {
            return;
        };
        for row in 0..n {
            for column in 0..n {
                j[(row, column)] = 0.0;
                j[(row, n + column)] = if row == column { self.scale } else { 0.0 };
                j[(n + row, column)] = by_place[(row, column)] / self.scale;
                j[(n + row, n + column)] = by_rate[(row, column)];
            }
        }
    }

    /// Puts the free coordinates and the commanded ones together.
    fn motion(&self, y: &State, commanded: impl Fn(usize) -> Moving) -> Motion {
        let size = self.chain.size;
        let mut motion =
            Motion { q: DVector::zeros(size), v: DVector::zeros(size), a: DVector::zeros(size) };
        let n = self.freedom.free.len();
        for (k, &i) in self.freedom.free.iter().enumerate() {
            motion.q[i] = y[k];
            motion.v[i] = y[n + k] * self.scale;
        }
        for &joint in &self.driven {
            let i = self.chain.links[joint].angle;
            let Moving { angle, rate, acceleration } = commanded(joint);
            (motion.q[i], motion.v[i], motion.a[i]) = (angle, rate, acceleration);
        }
        motion
    }

    fn state(&self, motion: &Motion) -> State {
        let free = &self.freedom.free;
        let rates = free.iter().map(|&i| motion.v[i] / self.scale);
        free.iter().map(|&i| motion.q[i]).chain(rates).collect()
    }

    /// Returns the whole motion at `t`, seen from before, and its row.
    fn sample(&self, t: f64, y: &State) -> Result<Row, ReferenceError> {
        let mut motion = self.motion(y, |joint| self.timetable.before(joint, t));
        let torques = self.chain.accelerate(&mut motion, self.freedom).ok_or_else(|| locked(t))?;
        Ok(row(self.chain, t, &motion, &torques))
    }
}

/// Solves the whole run.
pub(super) fn run(
    chain: &Chain,
    timetable: &Timetable<'_>,
    tolerance: f64,
    progress: &dyn Fn(f64),
) -> Result<Vec<Row>, ReferenceError> {
    let mut motion = begin(chain)?;
    let mut samples = Vec::new();
    let pin = pinned(chain);
    let mut freedom = Freedom { free: chain.free(pin.is_some()), pin };
    let [scale, highest] = chain.frequencies(&motion, &freedom.free);
    let stiff = chain.mechanism.damping.beta * highest > 8.0;
    let mut closed = freedom.pin.is_some();
    for stretch in timetable.stretches() {
        if stretch.closed && !closed {
            let free = chain.free(true);
            let pin = chain.catch(&mut motion, &free).ok_or_else(|| locked(stretch.begin))?;
            freedom = Freedom { free, pin: Some(pin) };
            closed = true;
        }
        let driven = chain.driven(closed);
        let flight =
            Flight { chain, timetable, stretch: *stretch, freedom: &freedom, driven, scale };
        let mut y = flight.state(&motion);
        if stretch.begin == 0.0 {
            for &t in timetable.initial() {
                samples.push(flight.sample(t, &y)?);
            }
        }
        let mut visit = |t: f64, y: &State| -> Result<(), ReferenceError> {
            samples.push(flight.sample(t, y)?);
            progress(t / timetable.duration());
            Ok(())
        };
        y = if stiff {
            march(implicit(tolerance, 0.0), &flight, y, &mut visit)?
        } else {
            march(explicit(tolerance, 0.0), &flight, y, &mut visit)?
        };
        motion = flight.motion(&y, |joint| timetable.before(joint, stretch.end));
    }
    Ok(samples)
}

/// Integrates one stretch. Calls `visit` at its sample times, each the end of a step without
/// interpolation. Returns the state at the end.
fn march(
    mut method: impl OrdinaryNumericalMethod<f64, State>,
    flight: &Flight<'_>,
    start: State,
    visit: &mut dyn FnMut(f64, &State) -> Result<(), ReferenceError>,
) -> Result<State, ReferenceError> {
    let Stretch { begin, end, times, .. } = flight.stretch;
    if start.is_empty() {
        times.iter().try_for_each(|&t| visit(t, &start))?;
        return Ok(start);
    }
    method.init(flight, begin, end, &start).map_err(|error| failure(begin, error))?;
    let (inside, at_end) = times.split_at(times.partition_point(|&t| t < end));
    for &t in inside {
        advance(&mut method, flight, [begin, t], LOCKED, &mut |_, _| ())?;
        visit(t, method.y())?;
    }
    advance(&mut method, flight, [begin, end], LOCKED, &mut |_, _| ())?;
    for &t in at_end {
        visit(t, method.y())?;
    }
    Ok(method.y().clone())
}

/// Reason of a chain whose accelerations are lost.
const LOCKED: &str = "the loop locks: its free joints and links cannot follow";

fn locked(time: f64) -> ReferenceError {
    ReferenceError::Integration { time, reason: LOCKED.to_owned() }
}

/// Returns the row of a state of motion with these forces on all coordinates.
pub(super) fn row(chain: &Chain, t: f64, motion: &Motion, torques: &DVector<f64>) -> Row {
    let inertias = Inertias::of(chain, motion);
    let joints = chain.links.iter().map(|link| motion.q[link.angle]).collect();
    let torques = chain.links.iter().map(|link| torques[link.angle]).collect();
    let deflection = |(root, end): (&super::kinematics::Frame, &super::kinematics::Frame)| {
        let away = end.place - root.place;
        let (sin, cos) = root.angle.sin_cos();
        away.y * cos - away.x * sin
    };
    Row {
        t,
        joints,
        ends: inertias.ends.iter().map(|end| end.place.into()).collect(),
        deflections: inertias.roots.iter().zip(&inertias.ends).map(deflection).collect(),
        torques,
    }
}
