//! The assembled beam: what every stepper of the small-deflection kind is built from.

use super::assembly::{Assembly, CHAIN, MassMatrix};
use super::lumped::Condensation;
use crate::Error;
use crate::hub::HubState;
use crate::math::{Band, Each, Scalar, array};
use crate::scene::{AxisKind, LinkShape, Scene, Uniform};

/// One consistent element, the paper's choice.
pub type OneElement<T = f64> = Model<2, 2, T>;
/// Two consistent elements.
pub type TwoElements<T = f64> = Model<4, 4, T>;
/// Four consistent elements.
pub type FourElements<T = f64> = Model<8, 4, T>;
/// Eight consistent elements.
pub type EightElements<T = f64> = Model<16, 4, T>;

/// Small deflections `q` of the link in the hub frame:
///
/// `M q̈ + (αM + βK) q̇ + [K + θ̇²G − g sinχ K_P] q = −F(θ̈ + αθ̇) − g cosχ f_g`
///
/// `N` degrees of freedom (deflection `w`, m, and slope `φ`, of each node from clamp to tip),
/// matrices of band width `W`. SI units, in the precision of the scene, immutable once built.
#[derive(Clone, Debug, PartialEq)]
pub struct Model<const N: usize, const W: usize, T = f64> {
    scene: Scene<T, Uniform>,
    /// `J_r` and S of the undeformed arm about the axis, see [`Scene::rigid_inertia`].
    rigid_inertia: T,
    first_moment: T,
    mass: Band<T, N, W>,
    stiffness: Band<T, N, W>,
    spin: Band<T, N, W>,
    tension: Band<T, N, W>,
    shortening: Band<T, N, W>,
    coupling: [T; N],
    weight: [T; N],
    root: [T; N],
    tip_slope: [T; N],
    tip: usize,
}

impl<T: Scalar, const N: usize, const W: usize> Model<N, W, T> {
    /// The model with consistent mass, `N/2` elements: 1, 2, 4 or 8.
    ///
    /// Use the aliases [`OneElement`] to [`EightElements`]; other shapes do not compile.
    pub fn consistent<S: LinkShape>(scene: &Scene<T, S>) -> Result<Self, Error> {
        const {
            assert!(matches!(N, 2 | 4 | 8 | 16), "1, 2, 4 or 8 elements");
            assert!(W == if N < CHAIN { N } else { CHAIN }, "band width of a chain of elements");
        }
        let scene = scene.validate()?;
        let chain = Assembly::<T, N>::new(&scene, MassMatrix::Consistent);
        let narrow = |a: &Band<T, N, CHAIN>| {
            let mut band = Band::ZERO;
            for i in 0..N {
                for j in (i + 1).saturating_sub(W)..=i {
                    band.add(i, j, a.get(i, j));
                }
            }
            band
        };
        Self {
            rigid_inertia: scene.rigid_inertia(),
            first_moment: scene.first_moment(),
            scene: scene.shaped(Uniform),
            mass: narrow(&chain.mass),
            stiffness: narrow(&chain.stiffness),
            spin: narrow(&chain.spin),
            tension: narrow(&chain.tension),
            shortening: narrow(&chain.shortening),
            coupling: chain.coupling,
            weight: chain.weight,
            root: chain.root,
            tip_slope: array(|i| if i + 1 == N { T::ONE } else { T::ZERO }),
            tip: N - 2,
        }
        .upright()
    }

    /// The stiffness at `θ̇` and χ: `K + θ̇²G − g sinχ K_P`.
    pub fn tangent(&self, rate: T, sin: T) -> Band<T, N, W> {
        let gravity = self.scene.in_plane_gravity();
        self.stiffness.plus(rate * rate, &self.spin).plus(-gravity * sin, &self.tension)
    }

    /// Static equilibrium of a hub at rest at an angle of that sine and cosine:
    /// `[K − g sinχ K_P] q = −g cosχ f_g`.
    pub fn equilibrium(&self, sin: T, cos: T) -> [T; N] {
        let gravity = self.scene.in_plane_gravity();
        let load = self.weight.each(|f| -gravity * cos * f);
        self.tangent(T::ZERO, sin).factor().solve(&load)
    }

    /// The scene this was built from, its link's shape left out.
    pub fn scene(&self) -> &Scene<T, Uniform> {
        &self.scene
    }

    /// `J_r`: inertia of the undeformed link and payload about the axis, kg m².
    pub fn rigid_inertia(&self) -> T {
        self.rigid_inertia
    }

    /// `S`: first moment of mass of the undeformed link and payload about the axis, kg m.
    pub fn first_moment(&self) -> T {
        self.first_moment
    }

    /// `M`, payload included.
    pub fn mass(&self) -> &Band<T, N, W> {
        &self.mass
    }

    /// `K`, bending.
    pub fn stiffness(&self) -> &Band<T, N, W> {
        &self.stiffness
    }

    /// `G = K_g − M_t`: centrifugal stiffening less softening, per θ̇². None on a carriage.
    pub fn spin(&self) -> &Band<T, N, W> {
        &self.spin
    }

    /// `K_P`: stiffness from the link's own hanging weight, per −g sinχ.
    pub fn tension(&self) -> &Band<T, N, W> {
        &self.tension
    }

    /// `S = ∫N'N'ᵀdx`: the tip's hub-frame X is `r + L − ½ qᵀSq`.
    pub fn shortening(&self) -> &Band<T, N, W> {
        &self.shortening
    }

    /// `F`: inertia coupling to the hub's acceleration; on a carriage it is `f_g`.
    pub fn coupling(&self) -> &[T; N] {
        &self.coupling
    }

    /// `f_g`: gravity load per −g cosχ.
    pub fn weight(&self) -> &[T; N] {
        &self.weight
    }

    /// The root's angle, `φ₀ = rootᵀq`: zero where the link is clamped without give.
    pub fn root(&self) -> &[T; N] {
        &self.root
    }

    /// `β_J k φ₀φ₀ᵀ` over `q`: the joint's own damping, beside Rayleigh's `αM + βK`.
    pub fn joint_damping(&self) -> Band<T, N, W> {
        let loss = self.scene.damping.joint * self.scene.hub.stiffness.unwrap_or(T::ZERO);
        let mut damping = Band::ZERO;
        for i in 0..W.min(N) {
            for j in 0..=i {
                damping.add(i, j, loss * self.root[i] * self.root[j]);
            }
        }
        damping
    }

    /// The tip's angle, `φ(L) = tip_slopeᵀq`.
    pub fn tip_slope(&self) -> &[T; N] {
        &self.tip_slope
    }

    /// Index of the tip's deflection in `q`.
    pub fn tip(&self) -> usize {
        self.tip
    }

    /// Refuses a link that could not stand upright: its small deflections would have no
    /// equilibrium there. A carriage holds it one way only.
    fn upright(self) -> Result<Self, Error> {
        let gravity = self.scene.in_plane_gravity();
        let steepest = match self.scene.mount.axis {
            AxisKind::Rotary => T::ONE,
            AxisKind::Linear => {
                let mut hub = HubState::<T>::ZERO;
                self.scene.gravity_direction().aim(&mut hub);
                hub.sin
            }
        };
        if self.stiffness.plus(-gravity * steepest, &self.tension).factored().is_positive() {
            Ok(self)
        } else {
            Err(Error::Buckles { gravity: self.scene.gravity.to_f64() })
        }
    }
}

impl<const N: usize> Model<N, N> {
    /// The model with lumped mass, `D/2` elements: 1, 2, 4 or 8.
    ///
    /// The massless rotations are condensed statically, `A → TᵀAT` with
    /// `T = [I; −K_φφ⁻¹K_φw]`, which fills the matrices: `N` is the number of elements, one more
    /// where the payload's rotary inertia keeps the tip's rotation.
    pub fn lumped<const D: usize>(scene: &Scene<f64, impl LinkShape>) -> Result<Self, Error> {
        const { assert!(matches!(D, 2 | 4 | 8 | 16), "1, 2, 4 or 8 elements") }
        let scene = scene.validate()?;
        // A point beyond the tip would leave a direction of the tip's motion without mass.
        let lever = scene.payload.mass * scene.payload.offset * scene.payload.offset;
        Error::check("payload.inertia", scene.payload.inertia, 1e-4 * lever, 1e6, "kg m^2")?;
        let chain = Assembly::<f64, D>::new(&scene, MassMatrix::Lumped);
        let needed = Condensation::<D, N>::kept(&chain);
        if needed != N {
            return Err(Error::DegreesOfFreedom { given: N, needed });
        }
        let t = Condensation::<D, N>::new(&chain);
        Self {
            rigid_inertia: scene.rigid_inertia(),
            first_moment: scene.first_moment(),
            scene: scene.shaped(Uniform),
            mass: t.matrix(&chain.mass),
            stiffness: t.matrix(&chain.stiffness),
            spin: t.matrix(&chain.spin),
            tension: t.matrix(&chain.tension),
            shortening: t.matrix(&chain.shortening),
            coupling: t.vector(&chain.coupling),
            weight: t.vector(&chain.weight),
            root: t.vector(&chain.root),
            tip_slope: *t.row(D - 1),
            tip: D / 2 - 1,
        }
        .upright()
    }
}
