//! Kinematics of the chain: every point that has mass, with its Jacobian.

use nalgebra::{DMatrix, DVector, Matrix2xX, RowDVector, Vector2};

use super::chain::{Chain, Strip};

/// All coordinates, their rates and their accelerations.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    pub q: DVector<f64>,
    pub v: DVector<f64>,
    pub a: DVector<f64>,
}

/// A frame on the chain: a point and the direction of the tangent there.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Global position, m, its velocity and its acceleration.
    pub place: Vector2<f64>,
    pub velocity: Vector2<f64>,
    pub acceleration: Vector2<f64>,
    /// Derivative of the position over the coordinates.
    pub jacobian: Matrix2xX<f64>,
    /// Angle of the tangent, rad, its rate and its acceleration.
    pub angle: f64,
    pub rate: f64,
    pub turning: f64,
    /// Derivative of the angle over the coordinates.
    pub row: RowDVector<f64>,
}

/// Everything that has mass, a row for each direction of a point and for each rotation.
pub(super) struct Inertias {
    /// Derivative of the rows' displacements over the coordinates.
    pub jacobian: DMatrix<f64>,
    /// Mass, kg, or inertia, kg m².
    pub weights: DVector<f64>,
    /// Acceleration with drag and weight: `a + αv + g`.
    pub motions: DVector<f64>,
    /// Frames at the roots of the links (the clamps) and at their ends.
    pub roots: Vec<Frame>,
    pub ends: Vec<Frame>,
    used: usize,
    alpha: f64,
    gravity: f64,
}

/// A piece of a strip at a point of the quadrature: its derivatives over the length.
struct Piece<'a> {
    tangent: Vector2<f64>,
    velocity: Vector2<f64>,
    acceleration: Vector2<f64>,
    /// `ψₖ` there.
    shapes: &'a [f64],
}

impl<'a> Piece<'a> {
    fn of(strip: &Strip, shapes: &'a [f64], motion: &Motion, root: &Frame) -> Self {
        let (mut angle, mut rate, mut turning) = (root.angle, root.rate, root.turning);
        for (coordinate, shape) in strip.curvatures().zip(shapes) {
            angle += shape * motion.q[coordinate];
            rate += shape * motion.v[coordinate];
            turning += shape * motion.a[coordinate];
        }
        let (sin, cos) = angle.sin_cos();
        let (tangent, normal) = (Vector2::new(cos, sin), Vector2::new(-sin, cos));
        let acceleration = turning * normal - rate * rate * tangent;
        Self { tangent, velocity: rate * normal, acceleration, shapes }
    }
}

impl Frame {
    fn ground(size: usize) -> Self {
        Self {
            place: Vector2::zeros(),
            velocity: Vector2::zeros(),
            acceleration: Vector2::zeros(),
            jacobian: Matrix2xX::zeros(size),
            angle: 0.0,
            rate: 0.0,
            turning: 0.0,
            row: RowDVector::zeros(size),
        }
    }

    /// Turns the frame by a coordinate, or by a share of it.
    fn turn(&mut self, motion: &Motion, coordinate: usize, share: f64) {
        self.angle += share * motion.q[coordinate];
        self.rate += share * motion.v[coordinate];
        self.turning += share * motion.a[coordinate];
        self.row[coordinate] += share;
    }

    /// Moves the frame along its tangent, by a rigid piece of `length` m.
    fn forward(&mut self, length: f64) {
        let tangent = self.tangent() * length;
        let normal = Vector2::new(-tangent.y, tangent.x);
        self.jacobian += normal * &self.row;
        self.place += tangent;
        self.velocity += normal * self.rate;
        self.acceleration += normal * self.turning - tangent * (self.rate * self.rate);
    }

    fn tangent(&self) -> Vector2<f64> {
        let (sin, cos) = self.angle.sin_cos();
        Vector2::new(cos, sin)
    }
}

impl Inertias {
    /// Computes the chain in a state of motion. The accelerations may be those of the driven joints
    /// alone: `motions` then lacks `jacobian · a` of the others.
    pub fn of(chain: &Chain, motion: &Motion) -> Self {
        let mechanism = &chain.mechanism;
        let rows = chain.links.len() * (2 * chain.rule.points.len() + 4) + 3;
        let mut all = Self {
            jacobian: DMatrix::zeros(rows, chain.size),
            weights: DVector::zeros(rows),
            motions: DVector::zeros(rows),
            roots: Vec::new(),
            ends: Vec::new(),
            used: 0,
            alpha: mechanism.damping.alpha,
            gravity: mechanism.gravity,
        };
        let mut frame = Frame::ground(chain.size);
        for (index, strip) in chain.links.iter().enumerate() {
            let (joint, link) = (&mechanism.joints[index], &mechanism.links[index]);
            // The motor's parts: mass on the axis, stator on the link before, hub on this one.
            all.add_mass(joint.mass, &frame);
            all.add_inertia(joint.stator_inertia, &frame);
            frame.turn(motion, strip.angle, 1.0);
            all.add_hub(joint.inertia, &frame);
            frame.forward(joint.radius);
            all.roots.push(frame.clone());
            frame = all.add_link(chain, index, motion, frame);
            frame.forward(link.tip_offset);
            all.ends.push(frame.clone());
        }
        frame.forward(mechanism.payload.offset);
        all.add_mass(mechanism.payload.mass, &frame);
        all.add_inertia(mechanism.payload.inertia, &frame);
        all
    }

    /// Adds a link from the frame of its root. Returns the frame of its far end.
    fn add_link(&mut self, chain: &Chain, index: usize, motion: &Motion, root: Frame) -> Frame {
        let (strip, link) = (&chain.links[index], &chain.mechanism.links[index]);
        let pieces: Vec<Piece<'_>> =
            chain.shapes.iter().map(|shapes| Piece::of(strip, shapes, motion, &root)).collect();
        // The same memory for every point: there are as many frames as points of mass.
        let mut frame = root.clone();
        let mut columns = vec![Vector2::zeros(); strip.order];
        let mut go_to = |frame: &mut Frame, weights: &[f64]| {
            frame.place = root.place;
            frame.velocity = root.velocity;
            frame.acceleration = root.acceleration;
            let mut normals = Vector2::zeros();
            columns.fill(Vector2::zeros());
            for (piece, weight) in pieces.iter().zip(weights) {
                let length = weight * link.length;
                frame.place += length * piece.tangent;
                frame.velocity += length * piece.velocity;
                frame.acceleration += length * piece.acceleration;
                let normal = length * Vector2::new(-piece.tangent.y, piece.tangent.x);
                normals += normal;
                for (column, shape) in columns.iter_mut().zip(piece.shapes) {
                    *column += *shape * normal;
                }
            }
            frame.jacobian.copy_from(&root.jacobian);
            frame.jacobian.ger(1.0, &normals, &root.row.transpose(), 1.0);
            for (coordinate, column) in strip.curvatures().zip(&columns) {
                let mut own = frame.jacobian.column_mut(coordinate);
                own += column;
            }
        };
        for (weights, share) in chain.running.iter().zip(&chain.rule.weights) {
            go_to(&mut frame, weights);
            self.add_mass(share * link.mass, &frame);
        }
        go_to(&mut frame, &chain.rule.weights);
        // Only the first shape is not zero at the end, where it is 1.
        if let Some(first) = strip.curvatures().next() {
            frame.turn(motion, first, 1.0);
        }
        frame
    }

    fn add_mass(&mut self, mass: f64, frame: &Frame) {
        let drag = frame.acceleration + frame.velocity * self.alpha;
        let motions = [drag.x, drag.y + self.gravity];
        for (axis, motion) in motions.into_iter().enumerate() {
            self.jacobian.set_row(self.used, &frame.jacobian.row(axis));
            self.weights[self.used] = mass;
            self.motions[self.used] = motion;
            self.used += 1;
        }
    }

    fn add_inertia(&mut self, inertia: f64, frame: &Frame) {
        self.add_rotation(inertia, frame, frame.turning + self.alpha * frame.rate);
    }

    /// Adds a hub. As with one link, drag does not act on it.
    fn add_hub(&mut self, inertia: f64, frame: &Frame) {
        self.add_rotation(inertia, frame, frame.turning);
    }

    fn add_rotation(&mut self, inertia: f64, frame: &Frame, motion: f64) {
        self.jacobian.set_row(self.used, &frame.row);
        self.weights[self.used] = inertia;
        self.motions[self.used] = motion;
        self.used += 1;
    }

    /// Returns the mass matrix, `Σ m JᵀJ`.
    pub fn mass(&self) -> DMatrix<f64> {
        self.jacobian.tr_mul(&self.weighted())
    }

    /// Returns the forces of inertia, drag and weight on the coordinates, `Σ m Jᵀ(a + αv + g)`.
    pub fn forces(&self) -> DVector<f64> {
        self.jacobian.tr_mul(&self.weights.component_mul(&self.motions))
    }

    fn weighted(&self) -> DMatrix<f64> {
        let mut rows = self.jacobian.clone();
        for mut column in rows.column_iter_mut() {
            column.component_mul_assign(&self.weights);
        }
        rows
    }

    /// Returns the frame of the chain's tip.
    pub fn tip(&self) -> &Frame {
        self.ends.last().expect("a chain has links")
    }
}
