//! Where a chain is at rest: its sag under gravity, and the angles that close a loop.

use super::factors::Factors;
use super::pose::Vector;
use super::{Chain, ChainState, JointState, Model};
use crate::Error;
use crate::hub::Angle;
use crate::math::{Complex, Scalar, array};

/// Most Newton steps.
const STEPS: usize = 200;
/// Largest change of a coordinate in one of them, rad.
const STRIDE: f64 = 0.2;
/// Change of the coordinates, rad, below which the search has ended.
const DONE: f64 = 1e-12;
/// Least stiffness, of that of the spring at the pin, above which a place is taken for stable: the
/// error of the differences is below it.
const UNSTABLE: f64 = -1e-8;
/// Step of the differences that the stiffness is taken from, rad: their error is its square.
const DIFFERENCE: f64 = 1e-5;

impl<T: Scalar, const LINKS: usize, const W: usize, const Q: usize> Model<T, LINKS, W, Q> {
    /// The same model in the precision of set-up.
    pub(super) fn precise(&self) -> Model<f64, LINKS, W, Q> {
        Model {
            links: self.links.map(|body| body.cast()),
            load: self.load.cast(),
            gravity: self.gravity.to_f64(),
            alpha: self.alpha.to_f64(),
            beta: self.beta.to_f64(),
            turns: 1.0 / core::f64::consts::TAU,
        }
    }
}

/// Coordinates at rest; angles of joints in rad.
pub(super) struct Rest<const LINKS: usize, const W: usize> {
    pub q: [[f64; W]; LINKS],
    pub force: Vector<f64>,
}

impl<const LINKS: usize, const W: usize, const Q: usize> Model<f64, LINKS, W, Q> {
    pub(super) fn in_turns(&self, q: &[[f64; W]; LINKS]) -> [[f64; W]; LINKS] {
        let mut q = *q;
        for row in &mut q {
            row[0] = Angle::from_radians(row[0]).part;
        }
        q
    }

    /// Force that is missing on every coordinate at rest.
    fn missing(&self, rest: &Rest<LINKS, W>) -> [[f64; W]; LINKS] {
        let still = [[0.0; W]; LINKS];
        let pose = self.pose(&self.in_turns(&rest.q));
        let mut missing = self.inverse_dynamics(&pose, &still, &still, Some(rest.force));
        for j in 0..LINKS {
            for k in 1..W {
                missing[j][k] += self.links[j].stiffness[k] * rest.q[j][k];
            }
        }
        missing
    }

    /// Changes the free coordinates until nothing is missing and the end is on `pin`. Newton's
    /// method for the augmented Lagrangian: the pin is a stiff spring and a force that grows by
    /// what the spring still holds. Returns the largest last change, rad, and the gap at the pin,
    /// m. Where the place is unstable, the change is infinite.
    fn settle<const C: usize>(
        &self,
        rest: &mut Rest<LINKS, W>,
        free: &[bool; C],
        pin: Option<Vector<f64>>,
    ) -> (f64, f64) {
        let spring = self.spring();
        let (mut change, mut gap) = (f64::INFINITY, 0.0);
        for _ in 0..STEPS {
            let mut right: [f64; C] = flat(&self.missing(rest)).map(|force: f64| -force);
            let mut stiffness = self.tangent(rest, free);
            let (mut missed, mut moves) = ([0.0; 2], [[0.0; 2]; C]);
            if let Some(pin) = pin {
                let pose = self.pose(&self.in_turns(&rest.q));
                let tip = self.tip(&pose);
                moves = flat(&self.tip_moves(&pose));
                missed = [tip[0] - pin[0], tip[1] - pin[1]];
                for i in 0..C {
                    right[i] -= spring * (moves[i][0] * missed[0] + moves[i][1] * missed[1]);
                    for p in 0..=i {
                        let product = moves[i][0] * moves[p][0] + moves[i][1] * moves[p][1];
                        stiffness[i][p] += spring * product;
                    }
                }
            }
            let none = [[Complex::ZERO; W]; LINKS];
            let right = array(|j| array(|k| Complex::new(right[j * W + k], 0.0)));
            let factors = Factors::<f64, LINKS, W>::new(&stiffness, &none, free);
            let step: [f64; C] = flat(&factors.solve(&right).map(|row| row.map(|step| step.re)));
            change = step.iter().fold(0.0, |most: f64, step| most.max(step.abs()));
            gap = crate::math::sqrt(missed[0] * missed[0] + missed[1] * missed[1]);
            if !change.is_finite() {
                break;
            }
            let stride = if change > STRIDE { STRIDE / change } else { 1.0 };
            for (q, step) in rest.q.as_flattened_mut().iter_mut().zip(&step) {
                *q += stride * step;
            }
            // What the spring would still hold after the step, the pin holds from now on.
            if stride == 1.0 {
                for (moved, step) in moves.iter().zip(&step) {
                    missed[0] += moved[0] * step;
                    missed[1] += moved[1] * step;
                }
                for axis in 0..2 {
                    rest.force[axis] -= spring * missed[axis];
                }
            }
            if change < DONE {
                if factors.least_pivot(free) < UNSTABLE * spring {
                    change = f64::INFINITY;
                }
                break;
            }
        }
        (change, gap)
    }

    /// Stiffness of a spring at the pin, N/m: far above that of the links.
    fn spring(&self) -> f64 {
        let mut spring: f64 = 1.0;
        for body in &self.links {
            let length: f64 = body.lengths.iter().sum();
            spring = spring.max(
                1e3 * (body.stiffness[1] + body.mass_beyond * self.gravity * length)
                    / (length * length),
            );
        }
        spring
    }

    /// Derivative of the missing forces, lower triangle.
    pub(super) fn tangent<const C: usize>(
        &self,
        rest: &Rest<LINKS, W>,
        free: &[bool; C],
    ) -> [[f64; C]; C] {
        let mut matrix = [[0.0; C]; C];
        for p in (0..C).filter(|&p| free[p]) {
            let mut beside = Rest { q: rest.q, force: rest.force };
            beside.q[p / W][p % W] += DIFFERENCE;
            let above: [f64; C] = flat(&self.missing(&beside));
            beside.q[p / W][p % W] -= 2.0 * DIFFERENCE;
            let below: [f64; C] = flat(&self.missing(&beside));
            for i in p..C {
                matrix[i][p] = (above[i] - below[i]) / (2.0 * DIFFERENCE);
            }
            // A loop that nothing holds in one place stays near where it began.
            if p % W == 0 {
                matrix[p][p] += 1e-9 * self.spring();
            }
        }
        matrix
    }
}

fn flat<V: Copy, const LINKS: usize, const W: usize, const C: usize>(
    slots: &[[V; W]; LINKS],
) -> [V; C] {
    core::array::from_fn(|i| slots[i / W][i % W])
}

impl<T: Scalar, const LINKS: usize, const W: usize, const C: usize, const Q: usize>
    Chain<T, LINKS, W, C, Q>
{
    /// The chain at rest in static equilibrium, its driven joints at these angles, rad. Those of
    /// passive joints are the mechanism's: of an open chain as they are, of a loop changed until it
    /// closes. Set-up only.
    ///
    /// # Errors
    /// [`Error::OpenLoop`] if the end does not reach its pin, [`Error::Buckles`] if gravity leaves
    /// no stable place to rest that is found.
    pub fn at_rest(&self, angles: &[f64; LINKS]) -> Result<ChainState<T, LINKS, W>, Error> {
        let model = self.model.precise();
        let pin = self.pin.map(|pin| pin.map(T::to_f64));
        let mut rest = Rest { q: [[0.0; W]; LINKS], force: [0.0; 2] };
        for j in 0..LINKS {
            let angle = if self.open[j * W] { self.passive_angles[j].to_f64() } else { angles[j] };
            rest.q[j][0] = Error::check("moves.from", angle, -1e6, 1e6, "rad")?;
        }
        let mut free = if pin.is_some() { self.closed } else { self.open };
        if pin.is_none() {
            for j in 0..LINKS {
                free[j * W] = false;
            }
        }
        let (change, gap) = model.settle(&mut rest, &free, pin);
        if gap > 1e-6 * self.length {
            return Err(Error::OpenLoop { gap });
        }
        if !(..1e-6).contains(&change) {
            return Err(Error::Buckles { gravity: model.gravity });
        }
        Ok(self.resting(&model, &rest, pin.is_some()))
    }

    fn resting(
        &self,
        model: &Model<f64, LINKS, W, Q>,
        rest: &Rest<LINKS, W>,
        closed: bool,
    ) -> ChainState<T, LINKS, W> {
        let f = T::from_f64;
        let missing = model.missing(rest);
        let free = if closed { &self.closed } else { &self.open };
        let zero = [[T::ZERO; W]; LINKS];
        let mut shape = rest.q.map(|row| row.map(f));
        for row in &mut shape {
            row[0] = T::ZERO;
        }
        let mut state = ChainState {
            joints: rest.q.map(|row| JointState::at_rest(Angle::from_radians(row[0]).cast())),
            shape,
            rate: zero,
            acceleration: zero,
            torque: array(|j| if free[j * W] { T::ZERO } else { f(missing[j][0]) }),
            pin: if closed { self.pin } else { None },
            force: rest.force.map(f),
            ends: [[T::ZERO; 2]; LINKS],
            tips: [[T::ZERO; 2]; LINKS],
        };
        self.locate(&mut state);
        state
    }
}
