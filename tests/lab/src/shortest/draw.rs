//! Draws random motions from state to state, each from its own number.

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::motion::optimal::{Bounds, TimeOptimal};
use stillbeam::{Angle, HubState};

use crate::random::{decades, sign};

/// Kinds of cases, drawn in turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Rest to rest.
    Rest,
    /// Both ends anywhere within the limits.
    Inside,
    /// A start beyond the limit of rate or acceleration, or about to be.
    Outside,
    /// Both ends within the limits, deceleration other than acceleration.
    Uneven,
    /// Acceleration that may jump.
    Jumping,
    /// No limit of acceleration.
    JerkOnly,
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 6] =
        [Self::Rest, Self::Inside, Self::Outside, Self::Uneven, Self::Jumping, Self::JerkOnly];

    /// Returns its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest to rest",
            Self::Inside => "state to state",
            Self::Outside => "start beyond a limit",
            Self::Uneven => "deceleration of its own",
            Self::Jumping => "no limit of jerk",
            Self::JerkOnly => "no limit of acceleration",
        }
    }
}

/// Two states of the hub, rates in rad/s and accelerations in rad/s², and limits.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Its kind.
    pub kind: Kind,
    /// Rate and acceleration at the beginning.
    pub from: [f64; 2],
    /// Rate and acceleration at the end.
    pub to: [f64; 2],
    /// Angle to turn by, rad.
    pub distance: f64,
    /// The limits.
    pub bounds: Bounds,
}

impl Case {
    /// Returns the hub at the beginning.
    pub fn start(&self) -> HubState<f64> {
        let [rate, acceleration] = self.from;
        HubState { acceleration, ..HubState::turning(Angle::default(), rate) }
    }

    /// Returns the hub at the end.
    pub fn end(&self) -> HubState<f64> {
        let [rate, acceleration] = self.to;
        let angle = Angle::from_radians(self.distance);
        HubState { acceleration, ..HubState::turning(angle, rate) }
    }
}

/// Draws the case of that number under that seed.
pub fn draw(seed: u64, index: u64) -> Case {
    let mut rng = StdRng::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index);
    let rng = &mut rng;
    let kind = Kind::ALL[(index % Kind::ALL.len() as u64) as usize];
    let bounds = bounds(rng, kind);
    let (from, to) = match kind {
        Kind::Rest => ([0.0; 2], [0.0; 2]),
        Kind::Outside => (outside(rng, &bounds), end(rng, &bounds, None)),
        _ => {
            let from = inside(rng, &bounds, None);
            // Often the same rate.
            let same = rng.random_bool(0.2).then_some(from[0]);
            (from, end(rng, &bounds, same))
        }
    };
    let mut case = Case { kind, from, to, distance: 0.0, bounds };
    case.distance = distance(rng, &case);
    case
}

fn bounds(rng: &mut StdRng, kind: Kind) -> Bounds {
    let rate = decades(rng, -1.0, 2.0);
    // Times to reach the limit of the rate, and that of the acceleration, s.
    let acceleration = rate / decades(rng, -1.5, 0.5);
    let jerk = acceleration / decades(rng, -1.5, 0.5);
    let deceleration =
        if kind == Kind::Uneven { acceleration * decades(rng, -0.7, 0.7) } else { acceleration };
    match kind {
        Kind::Jumping => Bounds { rate, acceleration, deceleration, jerk: f64::INFINITY },
        Kind::JerkOnly => {
            Bounds { rate, acceleration: f64::INFINITY, deceleration: f64::INFINITY, jerk }
        }
        _ => Bounds { rate, acceleration, deceleration, jerk },
    }
}

/// A state from which the limits can be kept, of that rate if there is one; zero or at a limit now
/// and then.
fn inside(rng: &mut StdRng, bounds: &Bounds, rate: Option<f64>) -> [f64; 2] {
    let drawn = special(rng) * bounds.rate;
    let rate = rate.unwrap_or(drawn);
    let acceleration = special(rng);
    admitted([rate, acceleration * reach(bounds, rate, acceleration)], bounds)
}

/// A state before which the limits can have been kept: backwards in time, one from which they can.
fn end(rng: &mut StdRng, bounds: &Bounds, rate: Option<f64>) -> [f64; 2] {
    let [rate, acceleration] = inside(rng, bounds, rate);
    let [rate, acceleration] = admitted([rate, -acceleration], bounds);
    [rate, -acceleration]
}

/// Limit of an acceleration of that sign at that rate.
fn reach(bounds: &Bounds, rate: f64, acceleration: f64) -> f64 {
    if bounds.jerk.is_infinite() {
        return 0.0;
    }
    let limit = if rate * acceleration < 0.0 { bounds.deceleration } else { bounds.acceleration };
    if limit.is_finite() { limit } else { (2.0 * bounds.rate * bounds.jerk).sqrt() }
}

/// Lowers an acceleration after which the rate would exceed its limit, with 1e-6 to spare.
fn admitted([rate, acceleration]: [f64; 2], bounds: &Bounds) -> [f64; 2] {
    let spare = (bounds.rate - rate * acceleration.signum()).max(0.0);
    let most = (1.0 - 1e-6) * (2.0 * bounds.jerk.min(1e300) * spare).sqrt();
    // A hub that turns back speeds up then.
    let limit = if rate * acceleration < 0.0 {
        bounds.acceleration.min(bounds.deceleration)
    } else {
        bounds.acceleration
    };
    let most = most.min(limit);
    [rate, acceleration.clamp(-most, most)]
}

/// −1 to 1; 0 or an end now and then.
fn special(rng: &mut StdRng) -> f64 {
    match rng.random_range(0..8) {
        0 | 1 => 0.0,
        2 => 1.0,
        3 => -1.0,
        _ => rng.random_range(-1.0..1.0),
    }
}

/// A state beyond a limit, by up to its double, or about to pass the limit of the rate.
fn outside(rng: &mut StdRng, bounds: &Bounds) -> [f64; 2] {
    let [mut v, mut a] = [1.0, 1.0].map(|most: f64| rng.random_range(-most..most));
    match rng.random_range(0..4) {
        0 => v = v.signum() * rng.random_range(1.0..2.0),
        1 => a = a.signum() * rng.random_range(1.0..2.0),
        2 => (v, a) = (2.0 * v, 2.0 * a),
        _ => (v, a) = (rng.random_range(0.8..1.0), rng.random_range(0.8..1.0)),
    }
    [v * bounds.rate, a * bounds.acceleration]
}

/// A distance on the scale of the limits, or a little off that of the fastest change of the rate.
fn distance(rng: &mut StdRng, case: &Case) -> f64 {
    let Bounds { rate, acceleration, jerk, .. } = case.bounds;
    let time = if jerk.is_infinite() {
        rate / acceleration
    } else if acceleration.is_infinite() {
        (rate / jerk).sqrt()
    } else {
        (rate / acceleration).max((rate / jerk).sqrt())
    };
    let scale = sign(rng) * rate * time;
    match rng.random_range(0..4) {
        0 => scale * decades(rng, -5.0, 0.0),
        1 => {
            let ramp = TimeOptimal::ramp(&case.start(), case.to[0], &case.bounds);
            let turned = ramp.map_or(0.0, |ramp| ramp.end().angle.since(case.start().angle));
            std::f64::consts::TAU * turned + scale * decades(rng, -5.0, 0.0)
        }
        _ => scale * decades(rng, -1.0, 1.5),
    }
}
