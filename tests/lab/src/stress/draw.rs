//! Draws random scenes, each from its own number.

use std::f64::consts::TAU;

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::scene::{PointMass, Section, Varied};
use stillbeam::{Damping, Hub, Limits, Link, Mount, Move, Payload, Profile, Scene};

use stillbeam_sim::scene_file::{Deduced, SceneFile};
use stillbeam_sim::solver::{ELEMENTS, Mass, Method, Quality, Scalar, Solver, SolverKeys};
use stillbeam_sim::step::Step;

use super::measured::measured;
use super::mounted::mounted;
use crate::random::{decades, sign};

/// Drawn quantities and their ranges, for a page.
pub const RANGES: [(&str, &str); 16] = [
    ("link", "length 0.03 to 10 m, mass 1 g to 100 kg"),
    ("bending stiffness", "10⁻⁶ to 10⁶ N m², or such that ω₁h is 10⁻³·⁵ to 10²"),
    ("payload over link mass", "0, 10⁻³ to 10³; with rotary inertia in half of the scenes"),
    ("payload beyond the tip", "in three of ten, up to L"),
    ("sections", "in four of ten, 1 to 4; stiffness and mass over two decades"),
    ("masses on the link", "in three of ten, 1 or 2, of 10⁻³ to 3 link masses"),
    ("measured", "an eighth: frequencies in place of EI, of the joint or of both, ratios, tapers"),
    ("joint", "in three of ten, 0.1 to 1000 EI/L; some with damping of its own"),
    ("hub radius", "0, 10⁻² L to 10 L"),
    ("tick", "0.1 ms to 1 s"),
    ("damping of the first mode", "0, 10⁻⁴ to 10 of critical, by α, by β or by both"),
    ("gravity", "0, 10⁻² to 100 m/s²"),
    ("moves", "1 µrad to 100 turns, in 5 to 5,000 ticks, every profile"),
    ("spin", "up to 5 ω₁, held"),
    ("mount", "a hub that turns, a carriage, a carrier at up to 2 ω₁, gravity tilted and turned"),
    ("after the move", "as long as the move, at most 200 ticks"),
];

/// A scene and its solvers.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The scene; its `[solver]` table is empty.
    pub scene: SceneFile,
    /// One solver of each family, in f64.
    pub solvers: Vec<Solver>,
    /// Rayleigh's estimate of the first frequency, rad/s.
    pub omega: f64,
}

/// Draws the scene of that number under that seed: that of [`draw_plain`], and features that only
/// some arms have, from numbers of their own.
pub fn draw(seed: u64, index: u64) -> Drawn {
    let plain = draw_plain(seed, index);
    let mut rng = StdRng::seed_from_u64(!seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index);
    let mut arm = plain.scene.arm;
    let (length, mass) = (arm.link.length, arm.link.mass);
    arm.shape = shape(&mut rng, length, mass);
    let link = arm.link.bending_stiffness / length;
    let mut softness = 1.0;
    if rng.random_bool(0.3) {
        let stiffness = link * decades(&mut rng, -1.0, 3.0);
        arm.hub.stiffness = Some(stiffness);
        softness += 3.0 * link / stiffness;
    }
    let omega = plain.omega / softness.sqrt();
    if rng.random_bool(0.3) {
        arm.damping.joint = Damping::joint_of_ratio(decades(&mut rng, -4.0, 0.5), omega).min(1e3);
    }
    if rng.random_bool(0.3) {
        let offset = rng.random_range(0.0..1.0) * length;
        // Lumped elements take an offset with some rotary inertia only.
        let least = 1e-4 * arm.payload.mass * offset * offset;
        arm.payload = Payload { offset, inertia: arm.payload.inertia.max(least), ..arm.payload };
    }
    let featured = Drawn { scene: SceneFile { arm, ..plain.scene }, omega, ..plain };
    mounted(measured(featured, seed, index), seed, index)
}

/// Draws the scene of that number under that seed, its link uniform and clamped without give, its
/// payload at the tip. Cases that campaigns have found are named by these numbers.
pub fn draw_plain(seed: u64, index: u64) -> Drawn {
    let mut rng = StdRng::seed_from_u64(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ index);
    let rng = &mut rng;
    let length = decades(rng, -1.5, 1.0);
    let mass = decades(rng, -3.0, 2.0);
    let tick = decades(rng, -4.0, 0.0);
    let payload = Payload {
        mass: if rng.random_bool(0.1) { 0.0 } else { mass * decades(rng, -3.0, 3.0) },
        ..Payload::default()
    };
    let inertia = if rng.random_bool(0.5) { decades(rng, -4.0, -1.0) } else { 0.0 };
    let payload = Payload { inertia: inertia * payload.mass * length * length, ..payload };
    let moved = 0.2427 * mass + payload.mass + payload.inertia * 2.25 / (length * length);
    let stiffness = if rng.random_bool(0.5) {
        decades(rng, -6.0, 6.0)
    } else {
        let omega = decades(rng, -3.5, 2.0) / tick;
        omega * omega * moved * length.powi(3) / 3.0
    };
    let omega = (3.0 * stiffness / (moved * length.powi(3))).sqrt();
    let radius = if rng.random_bool(0.2) { 0.0 } else { length * decades(rng, -2.0, 1.0) };
    let hub_inertia = if rng.random_bool(0.5) { 0.0 } else { mass * decades(rng, -4.0, 1.0) };
    let arm = Scene {
        link: Link { length, mass, bending_stiffness: stiffness },
        shape: Varied::UNIFORM,
        hub: Hub { radius, inertia: hub_inertia, stiffness: None },
        payload,
        damping: damping(rng, omega),
        gravity: gravity(rng, moved * length * length / (3.0 * stiffness)),
        mount: Mount::ROTARY,
    };
    let bends = omega * omega * length / (length + radius);
    let (from, moves) = moves(rng, omega, tick, bends);
    let solvers = solvers(rng, tick);
    let scene = SceneFile {
        shortest: Vec::new(),
        blended: Vec::new(),
        shaper: None,
        name: format!("stress {seed}/{index}"),
        arm,
        from,
        moves,
        limits: Limits::default(),
        solver: SolverKeys::default(),
        deduced: Deduced::default(),
        remarks: Vec::new(),
    };
    Drawn { scene, solvers, omega }
}

impl Drawn {
    /// Returns the sag of the tip with the arm level, over L.
    pub fn sag(&self) -> f64 {
        self.scene.arm.gravity / (self.omega * self.omega * self.scene.arm.link.length)
    }
}

/// Draws a uniform link, or up to four sections, and up to two masses on it.
fn shape(rng: &mut StdRng, length: f64, mass: f64) -> Varied {
    let mut shape = Varied::UNIFORM;
    if rng.random_bool(0.4) {
        let count = rng.random_range(1..5);
        let sections: Vec<Section> = (0..count)
            .map(|_| {
                let ei = [decades(rng, -1.0, 1.0), decades(rng, -1.0, 1.0)];
                let rho = [decades(rng, -1.0, 1.0), decades(rng, -1.0, 1.0)];
                Section::linear(decades(rng, -1.0, 0.0), ei, rho).expect("within range")
            })
            .collect();
        shape = Varied::of_sections(&sections).expect("a link").1;
    }
    let count = if rng.random_bool(0.7) { 0 } else { rng.random_range(1..3) };
    (0..count).fold(shape, |shape, _| {
        let position = rng.random_range(0.0..1.0) * length;
        let mounted = PointMass { position, mass: mass * decades(rng, -3.0, 0.5) };
        shape.with_mass(length, mounted).expect("on the link")
    })
}

/// Draws a fraction of critical damping of the first mode, by α, by β or by both.
fn damping(rng: &mut StdRng, omega: f64) -> Damping {
    let ratio = if rng.random_bool(0.4) { 0.0 } else { decades(rng, -4.0, 1.0) };
    let share = match rng.random_range(0..3) {
        0 => 0.0,
        1 => 1.0,
        _ => rng.random_range(0.0..1.0),
    };
    Damping {
        alpha: 2.0 * ratio * omega * share,
        beta: 2.0 * ratio / omega * (1.0 - share),
        joint: 0.0,
    }
}

/// Draws gravity. Half of the arms that feel it are given no more than they carry. `softness` is
/// the tip's sag at 1 m/s², over L.
fn gravity(rng: &mut StdRng, softness: f64) -> f64 {
    if rng.random_bool(0.4) {
        return 0.0;
    }
    let gravity = decades(rng, -2.0, 2.0);
    if rng.random_bool(0.5) { gravity.min(0.3 / softness) } else { gravity }
}

/// Draws a move, a move and back, or a spin-up that goes on turning, each with a rest. `bends` is
/// about the acceleration that bends the arm by a radian.
fn moves(rng: &mut StdRng, omega: f64, tick: f64, bends: f64) -> (f64, Vec<Step>) {
    let few = rng.random_bool(0.95);
    let ticks: f64 =
        if few { decades(rng, 0.7, 2.3) } else { decades(rng, 2.3, 3.7) }.max(5.0).round();
    // Most moves are such that a stepper could take them; the others show that it says no.
    let tame = rng.random_bool(0.75);
    let from = sign(rng) * decades(rng, -3.0, 2.0) * f64::from(u8::from(rng.random_bool(0.5)));
    let settle = |ticks: f64| ticks.min(200.0) * tick;
    if rng.random_bool(0.2) {
        let mut rate: f64 = omega * rng.random_range(0.0..5.0);
        let mut duration = ticks * tick;
        if tame {
            rate = rate.min(0.9 / tick);
            duration = duration.max((2.0 * rate / bends).min(5000.0 * tick));
        }
        let motion = Move::SpinUp { duration, rate: sign(rng) * rate };
        let held = 4.0 * ticks;
        return (from, vec![Step { motion: motion.into(), settle: held.min(1000.0) * tick }]);
    }
    let mut angle = decades(rng, -6.0, (100.0 * TAU).log10());
    let mut ticks = ticks;
    if tame {
        ticks = ticks.max((2.2 * angle).ceil()).min(5000.0);
        if rng.random_bool(0.6) {
            let duration = ticks * tick;
            angle = angle.min(bends * duration * duration / 6.3);
        }
    }
    // Not a whole number of ticks.
    let duration = (ticks + rng.random_range(-0.4..0.4)) * tick;
    let profile = Profile::ALL[rng.random_range(0..Profile::ALL.len())];
    let to = from + sign(rng) * angle;
    let there = Step { motion: Move::To { profile, duration, to }.into(), settle: settle(ticks) };
    if rng.random_bool(0.2) {
        let back = Step { motion: Move::To { profile, duration, to: from }.into(), ..there };
        return (from, vec![Step { settle: 0.0, ..there }, back]);
    }
    (from, vec![there])
}

/// Returns one solver of each family. `auto` is among them for one scene in four hundred, because
/// it runs the ladder beside the exact rod.
fn solvers(rng: &mut StdRng, tick: f64) -> Vec<Solver> {
    let base = Solver { tick, scalar: Scalar::F64, ..Solver::PAPER };
    let pick = |rng: &mut StdRng, n: usize| rng.random_range(0..n);
    let elements = ELEMENTS[pick(rng, ELEMENTS.len())];
    let mass = [Mass::Consistent, Mass::Lumped][pick(rng, 2)];
    let quality = [Quality::Fast, Quality::Fine][pick(rng, 2)];
    let mut all = vec![
        Solver { method: Method::Rigid, ..base },
        Solver { method: Method::Newmark, elements, mass, ..base },
        Solver { method: Method::Modal, elements: 8, modes: 1 + pick(rng, 3), ..base },
        Solver { method: Method::Elastica, quality, modes: 1 + pick(rng, 3), ..base },
    ];
    let tolerance = decades(rng, -4.0, -1.0);
    if rng.random_bool(0.0025) {
        let torque_tolerance = (10.0 * tolerance).min(1.0);
        all.push(Solver { method: Method::Auto, tolerance, torque_tolerance, ..base });
    }
    all
}

/// Returns a solver without its tick and precision, e.g. `newmark, 4 consistent elements`.
pub fn method_name(solver: &Solver) -> String {
    match solver.method {
        Method::Rigid => "rigid".into(),
        Method::Newmark => format!("newmark, {} {}", solver.elements, solver.mass.name()),
        Method::Modal => format!("modal, {}", solver.modes),
        Method::Elastica => format!("elastica, {} {}", solver.modes, solver.quality.name()),
        Method::Pointwise => format!("pointwise, {}", solver.modes),
        Method::Auto => "auto".into(),
    }
}
