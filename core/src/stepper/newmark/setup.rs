//! An arm's matrices, made ready for ticks.

use super::Newmark;
use crate::Error;
use crate::math::{Band, Each, Ldl, Scalar, array, cast, dot, principal_axes, root, round};
use crate::model::Model;
use crate::scene::{Scene, Uniform};
use crate::stepper::terms::Terms;
use crate::stepper::{MOST_GRAVITY_CHANGE, SLEEP, check_tick};

/// Heaviest payload along principal axes, in link masses over the roundings of the tick's
/// precision: 17,000 of them in f32. The effective matrix is then as ill-conditioned as the squares
/// of the first two frequencies are apart, 80 times the ratio of the masses.
const HEAVIEST: f64 = 0.002;

/// Least pivot of the effective matrix along principal axes, of its diagonal and in roundings of
/// the tick's precision. What a heavy payload far beyond the tip leaves of the other coordinates is
/// a small difference of large numbers: a rounding of these would make it negative, and the step
/// would feed the arm.
const LEAST_PIVOT: f64 = 4.0;

/// By how much more `K` counts in the effective matrix than it should, in roundings a degree of
/// freedom. Where `4/h² M` is small against it, a `c` beyond `q*` feeds the arm: the rounding of
/// the two must not get it there. A mode that the tick resolves does not notice.
const MARGIN: f64 = 4.0;

/// By how much the rounding of `K q` may feed an arm, in roundings a tick: in f32, undamped arms of
/// four and eight elements gained 1e-8 and 1e-7 of their energy a tick.
const fn numerical_damping<const N: usize>() -> f64 {
    let share = N as f64 / 16.0;
    2.5 * share * share * share
}

impl<T: Scalar, const N: usize, const W: usize, const AXES: bool> Newmark<T, N, W, AXES> {
    #[inline(always)]
    pub(super) fn set_up<P: Scalar>(model: &Model<N, W, P>, tick: f64) -> Result<Self, Error> {
        let tick = check_tick(tick)?;
        let scene = model.scene();
        scene.check_no_carrier()?;
        Self::check_payload(scene)?;
        let (alpha, beta) = (scene.damping.alpha, scene.damping.beta);
        let gravity = scene.in_plane_gravity();
        let half = P::from_f64(0.5 * tick);
        let per_half = P::ONE / half;
        let principal = Self::axes(model);
        let band = |a: &Band<P, N, W>| if Self::PRINCIPAL { a.onto(&principal) } else { *a };
        let vector = |v: &[P; N]| onto(&principal, v);
        let (mass, stiffness) = (band(model.mass()), band(model.stiffness()));
        let damping = mass
            .scaled(per_half * alpha)
            .plus(per_half * beta, &stiffness)
            .plus(per_half, &band(&model.joint_damping()));
        let stiffer = P::ONE + P::from_f64(Self::margin());
        let effective = damping.plus(per_half * per_half, &mass).plus(stiffer, &stiffness);
        let [inertia, factors] = Self::factored(tick, &mass, &stiffness, &effective)?;
        let tension = band(model.tension()).scaled(gravity);
        let swings = if scene.mount.is_linear() { P::ZERO } else { P::ONE };
        let coupling = vector(model.coupling());
        let turn = inertia.solve(&coupling);
        let residual = model.rigid_inertia() - dot(&coupling, &turn);
        let scaled = |scale: P| cast(&coupling.each(|f| scale * f));
        let tip: [P; N] = principal.each(|axis| axis[model.tip()]);
        let stiff = half * half * Self::slowest(&coupling, &mass, &stiffness);
        Ok(Self {
            turn: cast(&turn.each(|b| half * b)),
            spin: band(model.spin()).map(round),
            effective: effective.map(round),
            coupling: scaled(-per_half * per_half),
            inertia: round(scene.hub.inertia + residual),
            twice_per_half: round(P::TWO * per_half),
            reach: round(scene.reach()),
            shortening: band(model.shortening()).map(round).half_form(),
            tip: cast(&tip),
            factors: factors.map(round),
            stiffness: stiffness.map(round),
            terms: Terms::of(scene),
            numerical_damping: T::EPSILON * T::from_f64(numerical_damping::<N>()),
            tip_last: model.tip() + 1 == N,
            awake: Self::awake(scene.link.length, &tip, stiff),
            tick,
            damping: damping.map(round),
            drag: scaled(alpha),
            drag_torque: scaled(per_half * alpha),
            alpha: round(alpha),
            rigid_drag: round(alpha * model.rigid_inertia()),
            tension: tension.map(round),
            bent: tension.map(|k| round(swings * k)).half_form(),
            weight: cast(&vector(model.weight()).each(|f| gravity * f)),
            swings: round(swings),
            moment: round(gravity * model.first_moment()),
            most: T::from_f64(MOST_GRAVITY_CHANGE * scene.link.length.to_f64()),
            gravity: scene.gravity_direction(),
            tip_slope: cast(&vector(model.tip_slope())),
        })
    }

    /// Refuses a payload beyond [`HEAVIEST`].
    fn check_payload<P: Scalar>(scene: &Scene<P, Uniform>) -> Result<(), Error> {
        if !Self::PRINCIPAL {
            return Ok(());
        }
        let most = HEAVIEST / T::EPSILON.to_f64() * scene.link.mass.to_f64();
        Error::check("payload.mass", scene.payload.mass, 0.0, most, "kg").map(drop)
    }

    /// The axes that `q` is taken along: the principal ones, or the nodes' own.
    fn axes<P: Scalar>(model: &Model<N, W, P>) -> [[P; N]; N] {
        if Self::PRINCIPAL {
            return principal_axes(model.stiffness(), model.spin());
        }
        array(|i| array(|j| if i == j { P::ONE } else { P::ZERO }))
    }

    /// Factors of `M` and of the effective matrix, unless the tick leaves one of them no digits.
    fn factored<P: Scalar>(
        tick: f64,
        mass: &Band<P, N, W>,
        stiffness: &Band<P, N, W>,
        effective: &Band<P, N, W>,
    ) -> Result<[Ldl<P, N, W>; 2], Error> {
        let (inertia, factors) = (mass.factored(), effective.factored());
        let longest = Self::check_longest(tick, &inertia, stiffness)?;
        Self::check_shortest(tick, longest, effective, &factors)?;
        Ok([inertia, factors])
    }

    /// Refuses a tick so long that `4/h² M` is a rounding of `K`. The effective matrix would leave
    /// a mass that is not positive, and the step would feed the arm: refused from where a pivot of
    /// the one is that of the other.
    fn check_longest<P: Scalar>(
        tick: f64,
        inertia: &Ldl<P, N, W>,
        stiffness: &Band<P, N, W>,
    ) -> Result<f64, Error> {
        let lightest = least::<P, N>(|i| inertia.pivot(i) / stiffness.get(i, i));
        let longest = P::TWO * root(lightest / P::from_f64(T::EPSILON.to_f64()));
        Error::check("solver.tick", tick, 1e-6, longest.to_f64(), "s")?;
        Ok(longest.to_f64())
    }

    /// Refuses a tick so short that `K` is a rounding of `4/h² M` where little mass moves, beside
    /// coordinates that move a heavy payload: see [`LEAST_PIVOT`]. The pivots grow with the square
    /// of the tick.
    fn check_shortest<P: Scalar>(
        tick: f64,
        longest: f64,
        effective: &Band<P, N, W>,
        factors: &Ldl<P, N, W>,
    ) -> Result<(), Error> {
        if !Self::PRINCIPAL {
            return Ok(());
        }
        let left = least::<P, N>(|i| factors.pivot(i) / effective.get(i, i));
        let wanted = P::from_f64(LEAST_PIVOT * T::EPSILON.to_f64());
        if left >= wanted {
            return Ok(());
        }
        let shortest = tick * root(wanted / left).to_f64();
        let unit = "s with so heavy a payload on so soft an arm; modal takes a shorter one";
        Error::check("solver.tick", tick, shortest, shortest.max(longest), unit).map(drop)
    }

    /// By how much more than 1 `K` counts in the effective matrix, see [`MARGIN`].
    fn margin() -> f64 {
        if Self::PRINCIPAL { 0.0 } else { MARGIN * N as f64 * T::EPSILON.to_f64() }
    }

    /// `ω₁²` by Rayleigh's quotient of the shape that turning bends the arm to.
    fn slowest<P: Scalar>(coupling: &[P; N], mass: &Band<P, N, W>, stiffness: &Band<P, N, W>) -> P {
        let bent = if Self::PRINCIPAL { *coupling } else { stiffness.factored().solve(coupling) };
        dot(&bent, coupling) / dot(&bent, &mass.times(&bent))
    }

    /// Weights of [`Newmark::awake`] for a link of `length` m, `stiff` being `(½hω₁)²` by
    /// Rayleigh's quotient.
    fn awake<P: Scalar>(length: P, tip: &[P; N], stiff: P) -> [T; 2] {
        let floor = P::from_f64(SLEEP) * length;
        // Principal coordinates by what they move the tip together; nodes' by their deflection or,
        // a slope, by that of a link's length.
        let long = length * length;
        let reach = match Self::PRINCIPAL {
            true => dot(tip, tip),
            false if long > P::ONE => long,
            false => P::ONE,
        };
        let weight = reach / (floor * floor * stiff);
        [weight / stiff, weight].each(round)
    }
}

/// The least of `N` values.
fn least<P: Scalar, const N: usize>(of: impl Fn(usize) -> P) -> P {
    (1..N).map(&of).fold(of(0), |x, y| if y < x { y } else { x })
}

/// `vᵢᵀf` for the axes `vᵢ`.
#[inline(never)]
fn onto<P: Scalar, const N: usize>(axes: &[[P; N]; N], f: &[P; N]) -> [P; N] {
    axes.each(|axis| dot(&axis, f))
}
