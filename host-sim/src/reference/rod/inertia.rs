//! Weight of the link on its own unknowns and on its hub: inertia, drag and gravity.

use nalgebra::SVector;
use stillbeam::hub::HubState;

use super::super::carrying::Carrying;
use super::equations::{Configuration, Rod, dot};

/// Forces and moments of accelerations, drag and gravity included.
pub(super) struct Inertia<const P: usize> {
    /// Moments on the angles at the points, N m.
    moments: [f64; P],
    /// Moment on the angle at the tip, of the payload's own inertia, N m.
    twist: f64,
    /// Force at the clamp along hub-frame Y, N.
    pub shear: f64,
}

impl<const N: usize, const P: usize, const S: usize> Rod<N, P, S> {
    /// Returns what the link weighs on a hub that moves as `hub` says, at rates `v` (rad/s) and
    /// accelerations `acceleration` (rad/s²) of the unknowns. Drag and weight count as
    /// accelerations.
    pub fn inertia(
        &self,
        at: &Configuration<P>,
        v: &SVector<f64, N>,
        acceleration: &SVector<f64, N>,
        hub: &HubState<f64>,
    ) -> Inertia<P> {
        let Carrying { rate, acceleration: turn, velocity, push, weight } =
            self.carrier.carrying(hub);
        let (alpha, radius) = (self.scene.damping.alpha, self.scene.hub.radius);
        let spin = at.rate.map(|own| rate + own);
        let mut turning = self.at_points(acceleration);
        for (turning, spin) in turning.iter_mut().zip(&spin) {
            *turning += turn + alpha * spin;
        }
        let clamp = [
            weight[0] - rate * rate * radius,
            weight[1] + (turn + alpha * rate) * radius + push + alpha * velocity,
        ];
        let tip = self.at_tip(acceleration) + turn + alpha * (rate + self.at_tip(v));
        self.weigh(at, &spin, &turning, tip, clamp)
    }

    /// Returns what a turn of the whole arm about its hub, as one body, weighs per rad/s².
    pub fn inertia_of_turn(&self, at: &Configuration<P>) -> Inertia<P> {
        self.weigh(at, &[0.0; P], &[1.0; P], 1.0, [0.0, self.scene.hub.radius])
    }

    /// Returns what masses weigh whose link turns, at its points, by rates `spin` (rad/s) and
    /// accelerations `turning` (rad/s²), by `tip` at its tip, and at whose clamp the acceleration
    /// is `clamp` (hub-frame X and Y, m/s²).
    ///
    /// Each point adds `−ω̇ sin φ − ω² cos φ` and `ω̇ cos φ − ω² sin φ` to the accelerations of the
    /// stations outboard of it, and feels their forces across its own direction.
    fn weigh(
        &self,
        at: &Configuration<P>,
        spin: &[f64; P],
        turning: &[f64; P],
        tip: f64,
        clamp: [f64; 2],
    ) -> Inertia<P> {
        let (mut x, mut y) = ([0.0; P], [0.0; P]);
        for p in 0..P {
            let inward = spin[p] * spin[p];
            x[p] = -turning[p] * at.sin[p] - inward * at.cos[p];
            y[p] = turning[p] * at.cos[p] - inward * at.sin[p];
        }
        let shear = dot(&self.outboard, &y) + self.mass * clamp[1];
        let (along, across) = (share(&self.shared, &x), share(&self.shared, &y));
        let mut moments = [0.0; P];
        for p in 0..P {
            moments[p] = at.cos[p] * (across[p] + self.outboard[p] * clamp[1])
                - at.sin[p] * (along[p] + self.outboard[p] * clamp[0]);
        }
        Inertia { moments, twist: self.scene.payload.inertia * tip, shear }
    }

    /// Returns the parts of an inertia that the unknowns feel, N m.
    pub fn projected(&self, inertia: &Inertia<P>) -> SVector<f64, N> {
        SVector::from_fn(|k, _| {
            dot(&self.by_shape[k], &inertia.moments) + self.tip[k] * inertia.twist
        })
    }

    /// Returns the moment about the hub's axis, N m.
    pub fn about_axis(&self, inertia: &Inertia<P>) -> f64 {
        inertia.about_clamp() + self.scene.hub.radius * inertia.shear
    }
}

impl<const P: usize> Inertia<P> {
    /// Returns the moment about the clamp, N m.
    pub fn about_clamp(&self) -> f64 {
        self.moments.iter().sum::<f64>() + self.twist
    }
}

/// Returns the product of the inertia that points share, kg m², with values at the points.
fn share<const P: usize>(shared: &[[f64; P]; P], values: &[f64; P]) -> [f64; P] {
    let mut sum = [0.0; P];
    for (row, value) in shared.iter().zip(values) {
        for p in 0..P {
            sum[p] += row[p] * value;
        }
    }
    sum
}
