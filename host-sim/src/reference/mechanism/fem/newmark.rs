//! Newmark's rule with equilibrium iterations, on the unknowns of the mesh.

use super::Options;
use super::model::Model;
use super::pose::{State, System};
use crate::mechanism::Moving;
use crate::mechanism::table::Row;
use crate::reference::ReferenceError;
use crate::reference::fem::node::Change;

/// Newton steps that are allowed for an equilibrium.
const ITERATIONS: usize = 40;
/// Load steps on the way to the static equilibrium.
const LOAD_STEPS: u32 = 16;
/// Stiffness of the links against being stretched by an impact, of their own a s². The time in
/// which a wave of stretch runs through an element is far below its root.
const IMPACT: f64 = 1e-6;

/// State of the mechanism at one time, and working storage.
pub(super) struct March {
    model: Model,
    options: Options,
    state: State,
    next: State,
    system: System,
}

impl March {
    /// Creates the mechanism at rest, its links straight, with its joints at the given angles.
    pub fn new(model: Model, options: &Options, angles: &[f64]) -> Self {
        let state = model.straight(angles);
        let (next, system) = (state.clone(), model.system());
        Self { model, options: *options, state, next, system }
    }

    /// Moves to the static equilibrium. Returns false if there is none that is stable.
    pub fn settle(&mut self) -> bool {
        let change = Change { displacement: 1.0, rate: 0.0, acceleration: 0.0 };
        if self.model.mechanism.gravity == 0.0 && self.is_balanced() {
            return true;
        }
        for step in 1..=LOAD_STEPS {
            self.model.share = f64::from(step) / f64::from(LOAD_STEPS);
            self.next.clone_from(&self.state);
            if self.equilibrate(&change, 0.0, true).is_err() {
                return false;
            }
            std::mem::swap(&mut self.state, &mut self.next);
        }
        true
    }

    /// True if the state is in equilibrium, as straight links without weight are.
    fn is_balanced(&mut self) -> bool {
        let change = Change { displacement: 1.0, rate: 0.0, acceleration: 0.0 };
        self.model.assemble(&self.state, &change, &mut self.system);
        self.size() <= self.options.tolerance.max(self.rounding())
    }

    /// Recomputes the accelerations when the commanded ones jump. Carrying the old ones across
    /// would cost the rule its second order.
    pub fn restart(&mut self, drives: &[Moving], time: f64) -> Result<(), ReferenceError> {
        self.next.clone_from(&self.state);
        self.next.drives.copy_from_slice(drives);
        let change = Change { displacement: 0.0, rate: 0.0, acceleration: 1.0 };
        self.equilibrate(&change, time, false)?;
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// Advances by a step of h s, to the time at which the drives are as given: `u⁺ = u + h u̇ +
    /// ¼h²(ü + ü⁺)`, `u̇⁺ = u̇ + ½h(ü + ü⁺)` (δ = 1/2, β = 1/4), iterated to equilibrium.
    pub fn step(&mut self, drives: &[Moving], time: f64, h: f64) -> Result<(), ReferenceError> {
        for i in 0..self.state.u.len() {
            let (u, v, a) = (self.state.u[i], self.state.v[i], self.state.a[i]);
            self.next.u[i] = u + h * v + 0.5 * h * h * a;
            self.next.v[i] = v + h * a;
            self.next.a[i] = a;
        }
        self.next.drives.copy_from_slice(drives);
        let change = Change { displacement: 1.0, rate: 2.0 / h, acceleration: 4.0 / (h * h) };
        self.equilibrate(&change, time, false)?;
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// Advances by a step of h s of the implicit Euler rule, `u⁺ = u + h u̇⁺`, `u̇⁺ = u̇ + h ü⁺`.
    /// It lets what an impact leaves at the tip, far above what the links' damping carries, die
    /// out, where Newmark's rule would keep it. Accelerations before the step take no part.
    pub fn step_softly(
        &mut self,
        drives: &[Moving],
        time: f64,
        h: f64,
    ) -> Result<(), ReferenceError> {
        self.next.clone_from(&self.state);
        for (u, v) in self.next.u.iter_mut().zip(&self.state.v) {
            *u += h * v;
        }
        self.next.a.fill(0.0);
        self.next.drives.copy_from_slice(drives);
        let change = Change { displacement: 1.0, rate: 1.0 / h, acceleration: 1.0 / (h * h) };
        self.equilibrate(&change, time, false)?;
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// Lets the released joints go, stops the tip by an impact and pins it where it is. Links do
    /// not stretch in an impact.
    pub fn close(&mut self) -> Option<()> {
        let mechanism = self.model.mechanism.clone();
        let released = Model::new(&mechanism, &self.options, true, None)?;
        let mut state = self.model.carry_over(&self.state, &released);
        let mut system = released.system();
        released.assemble_impact(&state, IMPACT, &mut system);
        let mut change = system.residual;
        system.tangent.solve(&mut change, true)?;
        for (rate, change) in state.v.iter_mut().zip(&change) {
            *rate -= change;
        }
        let tip = released.ends(&state, mechanism.links.len() - 1).end;
        let pinned = Model::new(&mechanism, &self.options, true, Some([tip.q.x, tip.q.y]))?;
        self.model = released;
        self.state = state;
        self.become_model(pinned);
        Some(())
    }

    /// Goes on with the same mechanism in other unknowns.
    pub fn become_model(&mut self, model: Model) {
        self.state = self.model.carry_over(&self.state, &model);
        self.next = self.state.clone();
        self.system = model.system();
        self.model = model;
    }

    /// Applies Newton's method to `next`, moved along `change`.
    fn equilibrate(
        &mut self,
        change: &Change,
        time: f64,
        stable: bool,
    ) -> Result<(), ReferenceError> {
        let mut before = f64::INFINITY;
        for _ in 0..ITERATIONS {
            self.model.assemble(&self.next, change, &mut self.system);
            let size = self.size();
            // Very stiff parts keep the residual above the tolerance by rounding alone: there it
            // is small and gets no smaller.
            let rounding = size <= self.rounding() && size > 0.1 * before;
            if size <= self.options.tolerance || rounding {
                return Ok(());
            }
            before = size;
            if self.system.tangent.solve(&mut self.system.residual, stable).is_none() {
                break;
            }
            for (i, delta) in self.system.residual.iter().take(self.next.u.len()).enumerate() {
                self.next.u[i] -= change.displacement * delta;
                self.next.v[i] -= change.rate * delta;
                self.next.a[i] -= change.acceleration * delta;
            }
        }
        let reason = "no equilibrium within the tolerance; use a smaller step".to_owned();
        Err(ReferenceError::Integration { time, reason })
    }

    /// Returns the size of the residual against the largest `EI/L²`, moments taken at the total
    /// length.
    fn size(&self) -> f64 {
        let length = self.model.mechanism.total_length();
        let residual = self.system.residual.iter().zip(&self.model.layout.unknowns);
        let largest = residual.fold(0.0, |largest: f64, (force, unknown)| {
            let size = force.abs() / if unknown.is_rotation() { length } else { 1.0 };
            // f64::max would drop a NaN.
            if size.is_nan() { f64::INFINITY } else { largest.max(size) }
        });
        largest / self.force()
    }

    /// Largest `EI/L²`, N. A chain of rigid links takes the force that turns its mass in a second.
    fn force(&self) -> f64 {
        let links = &self.model.mechanism.links;
        let of = |link: &stillbeam::mechanism::Link| {
            if link.bends() {
                link.bending_stiffness() / (link.length * link.length)
            } else {
                link.mass * link.length
            }
        };
        links.iter().map(of).fold(f64::MIN_POSITIVE, f64::max)
    }

    /// Returns the residual that rounding of places may leave: `ε |u|/l₀` of stretch, times EA.
    fn rounding(&self) -> f64 {
        let options = &self.options;
        let element = |link: &stillbeam::mechanism::Link| link.length / options.elements as f64;
        let mechanism = &self.model.mechanism;
        let shortest = mechanism.links.iter().map(element).fold(f64::INFINITY, f64::min);
        16.0 * f64::EPSILON * options.axial_stiffness * mechanism.total_length() / shortest
    }

    /// Returns the row of the present state, with the drives as given.
    pub fn sample(&mut self, t: f64) -> Row {
        let change = Change { displacement: 0.0, rate: 0.0, acceleration: 1.0 };
        self.model.assemble(&self.state, &change, &mut self.system);
        self.model.row(t, &self.state, &self.system)
    }
}
