//! Newmark's rule with equilibrium iterations.

use nalgebra::Vector3;
use stillbeam::hub::HubState;

use super::block::Chain;
use super::model::Model;
use super::node::{Change, Deformation, Node};
use crate::reference::{ReferenceError, Sample};

/// Newton steps that are allowed for an equilibrium.
const ITERATIONS: usize = 25;
/// Load steps on the way to the static equilibrium.
const LOAD_STEPS: u32 = 16;

/// State of the arm at one time, and working storage.
pub(super) struct March {
    model: Model,
    /// Tolerance of a residual, relative to EI/L².
    tolerance: f64,
    state: Deformation,
    next: Deformation,
    nodes: Vec<Node>,
    residual: Vec<Vector3<f64>>,
    tangent: Chain,
}

impl March {
    /// Creates the arm at rest, undeformed.
    pub fn new(model: Model, tolerance: f64) -> Self {
        let n = model.nodes();
        Self {
            tolerance,
            state: Deformation::zeros(n),
            next: Deformation::zeros(n),
            nodes: vec![Node::default(); n],
            residual: vec![Vector3::zeros(); n],
            tangent: Chain::new(n),
            model,
        }
    }

    /// Moves to the static equilibrium at the hub's angle.
    pub fn settle(&mut self, hub: &HubState<f64>) -> Result<(), ReferenceError> {
        let gravity = self.model.gravity;
        let still = HubState { rate: 0.0, acceleration: 0.0, ..*hub };
        let change = Change { displacement: 1.0, rate: 0.0, acceleration: 0.0 };
        let unstable = ReferenceError::NoEquilibrium { angle: hub.angle.radians() };
        for step in 1..=LOAD_STEPS {
            self.model.gravity = gravity * f64::from(step) / f64::from(LOAD_STEPS);
            self.next.clone_from(&self.state);
            if self.equilibrate(&still, &change, 0.0).is_err() {
                return Err(unstable);
            }
            self.model.hold(&mut self.residual, &mut self.tangent);
            if !self.tangent.is_positive_definite(self.model.first()) {
                return Err(unstable);
            }
            std::mem::swap(&mut self.state, &mut self.next);
        }
        Ok(())
    }

    /// Recomputes the accelerations from displacements and velocities when the commanded
    /// acceleration jumps to that of `hub`. Carrying the old ones across would cost the rule its
    /// second order.
    pub fn restart(&mut self, hub: &HubState<f64>, time: f64) -> Result<(), ReferenceError> {
        self.next.clone_from(&self.state);
        let change = Change { displacement: 0.0, rate: 0.0, acceleration: 1.0 };
        self.equilibrate(hub, &change, time)?;
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// Advances the deformation u_d by a step of h s, to the time at which the hub is as given: `u⁺
    /// = u + h u̇ + ¼h²(ü + ü⁺)`, `u̇⁺ = u̇ + ½h(ü + ü⁺)` (δ = 1/2, β = 1/4), iterated to
    /// equilibrium.
    pub fn step(&mut self, hub: &HubState<f64>, time: f64, h: f64) -> Result<(), ReferenceError> {
        for i in self.model.first()..self.nodes.len() {
            let (u, v, a) = (self.state.u[i], self.state.v[i], self.state.a[i]);
            self.next.u[i] = u + h * v + 0.5 * h * h * a;
            self.next.v[i] = v + h * a;
            self.next.a[i] = a;
        }
        let change = Change { displacement: 1.0, rate: 2.0 / h, acceleration: 4.0 / (h * h) };
        self.equilibrate(hub, &change, time)?;
        std::mem::swap(&mut self.state, &mut self.next);
        Ok(())
    }

    /// Applies Newton's method to `next`, moved along `change`.
    fn equilibrate(
        &mut self,
        hub: &HubState<f64>,
        change: &Change,
        time: f64,
    ) -> Result<(), ReferenceError> {
        let mut before = f64::INFINITY;
        for _ in 0..ITERATIONS {
            self.model.place(hub, &self.next, &mut self.nodes);
            self.model.residual(&self.nodes, change, &mut self.residual, &mut self.tangent);
            let size = self.model.relative(&self.residual);
            // Very stiff parts keep the residual above the tolerance by rounding alone: there it
            // is small and gets no smaller.
            let rounding = size <= self.model.rounding() && size > 0.1 * before;
            if size <= self.tolerance || rounding {
                return Ok(());
            }
            before = size;
            let first = self.model.first();
            self.model.hold(&mut self.residual, &mut self.tangent);
            if self.tangent.solve(first, &mut self.residual).is_none() {
                break;
            }
            for i in first..self.nodes.len() {
                let delta = self.residual[i];
                self.next.u[i] -= change.displacement * delta;
                self.next.v[i] -= change.rate * delta;
                self.next.a[i] -= change.acceleration * delta;
            }
        }
        let reason = "no equilibrium within the tolerance; use a smaller step".to_owned();
        Err(ReferenceError::Integration { time, reason })
    }

    /// Returns the present state of the arm, its hub as given.
    pub fn sample(&mut self, t: f64, hub: &HubState<f64>) -> Sample {
        let change = Change { displacement: 0.0, rate: 0.0, acceleration: 1.0 };
        self.model.place(hub, &self.state, &mut self.nodes);
        self.model.residual(&self.nodes, &change, &mut self.residual, &mut self.tangent);
        let end = &self.nodes[self.nodes.len() - 1];
        let (tip, payload) = (end.q, self.model.payload(end));
        Sample {
            t,
            angle: hub.angle.radians(),
            rate: hub.rate,
            acceleration: hub.acceleration,
            tip: [tip.x, tip.y],
            payload,
            deflection: tip.y * hub.cos - tip.x * hub.sin,
            torque: self.model.torque(&self.residual[0], &self.nodes[0], hub),
        }
    }
}
