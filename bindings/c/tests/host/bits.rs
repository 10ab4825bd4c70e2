//! Every call of C does what the core does, to the bit: `every_call.c` once more in Rust.

use std::fmt::Write;

use stillbeam::axis::{Axis, Cause, Change, Policy, StopLimits, Tick};
use stillbeam::drive::{cia402, moteus, odrive};
use stillbeam::model::Rod;
use stillbeam::motion::optimal::Bounds;
use stillbeam::motion::{Spline, Waypoint};
use stillbeam::motor::{Direction, Drivetrain, Joint, Ratio};
use stillbeam::planner::Planner;
use stillbeam::stepper::{Elastica2, Quality};
use stillbeam::{
    Angle, Damping, Hub, HubState, Limits, Link, Move, Payload, PlainMove, PlannedMove, Profile,
    UniformScene,
};

use crate::compile;

const TICK: f64 = 0.010;
const ACCELERATION: f64 = 80.0;

fn scene(payload: f64) -> UniformScene {
    UniformScene {
        hub: Hub { radius: 0.02, inertia: 0.0, stiffness: Some(40.0) },
        payload: Payload { mass: payload, inertia: 0.0, offset: 0.0 },
        damping: Damping { alpha: 0.05, beta: 1e-4, joint: 0.0 },
        gravity: 9.81,
        ..UniformScene::uniform(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
    }
}

fn stepper(payload: f64) -> Elastica2<f32> {
    let rod = Rod::<2>::new(&scene(payload)).expect("an arm");
    let bend = Elastica2::<f32>::nearest_bend(rod.bend(ACCELERATION));
    Elastica2::new(&rod, TICK, Quality::Fast, bend).expect("an arm")
}

/// The axis and what it has printed.
struct Run {
    axis: Axis<Elastica2<f32>, 8>,
    printed: String,
}

impl Run {
    fn new() -> Self {
        let limits =
            Limits { rate: Some(15.0), acceleration: Some(ACCELERATION), ..Limits::default() };
        let policy = Policy { limits, stop: StopLimits::OF_MOVES, patience: 0.2, missed: 2 };
        let origin = Angle { turns: 0, part: 0.0 };
        let axis = Axis::new(stepper(0.030), origin, policy).expect("an axis");
        Self { axis, printed: String::new() }
    }

    fn print(&mut self, tick: &Tick<f32>) {
        let at = tick.setpoint;
        let cause = match self.axis.cause() {
            None => 0,
            Some(Cause::Requested) => 1,
            Some(Cause::LinkLost) => 2,
            Some(Cause::MissedTicks) => 3,
            Some(Cause::FollowLost) => 4,
            Some(_) => 5,
        };
        let (number, mode, turns) = (tick.number, tick.mode as i32, at.angle.turns);
        write!(self.printed, "{number} {mode} {cause} {turns}").expect("a string");
        let values = [at.angle.part, at.rate, at.acceleration, at.torque, at.tip[0], at.tip[1]];
        for value in values {
            write!(self.printed, " {:08x}", value.to_bits()).expect("a string");
        }
        self.printed.push('\n');
    }

    fn tick(&mut self, count: u32) {
        for _ in 0..count {
            self.axis.heard();
            let tick = self.axis.tick();
            self.print(&tick);
        }
    }

    fn enable(&mut self, radians: f64) {
        self.axis.enable(Angle::from_radians(radians).cast()).expect("a mode that is enabled");
    }

    fn take(&mut self, planned: &PlannedMove<f32>) {
        let begins = self.axis.take(planned).expect("room");
        let ticks = planned.summary().ticks;
        writeln!(self.printed, "accepted {begins} {ticks}").expect("a string");
    }

    fn reach(&mut self, motion: impl FnOnce(Bounds) -> Move) {
        let bounds = Bounds { rate: 6.0, acceleration: 40.0, deceleration: 30.0, jerk: 2000.0 };
        let context = self.axis.plan_context().expect("an enabled axis");
        self.take(&context.plan(&motion(bounds)).expect("a move within the limits"));
    }

    fn go(&mut self, motion: PlainMove) {
        let context = self.axis.plan_context().expect("an enabled axis");
        self.take(&context.plan(&motion).expect("a move within the limits"));
    }

    fn waypoints(&mut self) {
        let mut rows: Vec<Waypoint> = (1..=24)
            .map(|i| {
                let angle = 0.02 * f64::from(i) + 0.004 * f64::from((i - 1) % 3);
                Waypoint::at(0.055 * f64::from(i), angle)
            })
            .collect();
        rows[4].rate = Some(0.5);
        let mut path = self.axis.path(Spline::Quintic).expect("an enabled axis");
        let mut offered = 0;
        loop {
            let until = if offered < 10 { 10 } else { rows.len() };
            // As the binding does: offer while there is room, hand over, and again.
            loop {
                while offered < until && path.has_room() {
                    path.offer(rows[offered]).expect("a row");
                    offered += 1;
                }
                if offered == rows.len() {
                    path.close();
                }
                self.axis.advance(&mut path).expect("rows within the limits");
                if offered == until || !path.has_room() {
                    break;
                }
            }
            if path.is_done() {
                break;
            }
            self.tick(1);
        }
        self.tick(60);
    }

    fn drives(&mut self) {
        let joint = Joint {
            ratio: Ratio { motor: 50, link: 3 },
            efficiency: 0.9,
            rotor_inertia: 1e-5,
            coulomb: 0.01,
            viscous: 0.001,
            torque_constant: 1.0,
        };
        let train = Drivetrain::<f32>::new(&joint, Direction::Opposite, 0.125).expect("a gear");
        let tick = self.axis.tick();
        self.print(&tick);
        let demand = train.demand(&tick.setpoint);
        let servo = moteus::Servo::new(1, 0.1).expect("a servo");
        let node = cia402::Drive::new(1, 16_384, 0.5).expect("a node");
        let mut bytes = odrive::encode(&demand).expect("finite").payload.to_vec();
        bytes.extend(servo.encode(&demand).expect("finite").payload);
        bytes.extend(node.encode(&demand).expect("finite").payload);
        let bytes: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        let shaft = Angle { turns: 0, part: 0.0 }.plus(3.7).cast();
        let angle = train.mapping().to_link(shaft).radians();
        // Seventeen digits in C, the fewest in Rust: both give back every bit.
        writeln!(self.printed, "drives {bytes} {angle:?}").expect("a string");
    }

    fn follow(&mut self) {
        let (h, acceleration) = (0.010_f32, 8.0_f32);
        for k in 0..20_u8 {
            let t = h * f32::from(k);
            let part = 0.5 * acceleration * t * t / 6.283_185_5;
            let angle = Angle { turns: 0, part };
            let hub = HubState { acceleration, ..HubState::turning(angle, acceleration * t) };
            self.axis.heard();
            let tick = self.axis.follow(Some(&hub));
            self.print(&tick);
        }
        for _ in 0..60 {
            let tick = self.axis.follow(None);
            self.print(&tick);
        }
    }

    fn all(mut self) -> String {
        let to = |profile, duration, to| PlainMove::To { profile, duration, to };
        self.tick(2);
        self.enable(0.25);
        self.go(to(Profile::Trapezoid, 0.4, 1.0));
        self.go(PlainMove::Dwell { duration: 0.1 });
        self.go(PlainMove::SpinUp { duration: 0.2, rate: 2.0 });
        self.tick(80);
        let angle = Angle::from_radians(0.5).cast();
        let target = Change::Target { angle, rate: 0.1, duration: 0.4 };
        self.axis.change(&target).expect("within the limits");
        self.tick(50);
        self.axis.change(&Change::Hold).expect("an enabled axis");
        self.tick(30);
        self.drives();
        let planner = Planner::<f32, 2>::new(&scene(0.030), TICK).expect("a planner");
        let context = self.axis.plan_context().expect("an enabled axis");
        self.take(&context.plan_still(&planner, 0.0, Some(0.5)).expect("a still move"));
        self.tick(60);
        self.waypoints();
        self.go(to(Profile::SCurve, 0.5, 0.0));
        self.tick(55);
        self.axis.replace(stepper(0.060)).expect("at rest");
        self.tick(5);
        self.follow();
        self.enable(0.0);
        self.reach(|bounds| Move::Reach { to: 0.8, rate: 0.5, bounds });
        self.tick(50);
        self.reach(|bounds| Move::Ramp { rate: 0.0, bounds });
        self.tick(10);
        self.go(to(Profile::Cycloid, 0.5, 1.5));
        self.tick(10);
        self.axis.missed(3);
        self.tick(40);
        self.axis.disable();
        self.tick(2);
        self.printed
    }
}

/// Splits the angle off a line of drives, as its bits; of other lines there is none.
fn exact(line: &str) -> (&str, Option<u64>) {
    match line.rsplit_once(' ') {
        Some((bytes, angle)) if line.starts_with("drives") => {
            (bytes, Some(angle.parse::<f64>().expect("an angle").to_bits()))
        }
        _ => (line, None),
    }
}

#[test]
fn every_call_has_the_bits_of_the_core() {
    let printed = compile::run("cc", &["-std=c11"], "tests/host/every_call.c");
    let expected = Run::new().all();
    for (k, (is, needed)) in printed.lines().zip(expected.lines()).enumerate() {
        assert_eq!(exact(is), exact(needed), "line {k}");
    }
    assert_eq!(printed.lines().count(), expected.lines().count());
    // All four modes, and every reason to stop that the run has.
    for mode in [" 0 0 0 ", " 1 0 0 ", " 2 4 0 ", " 3 4 0 ", " 2 3 0 ", " 3 3 0 ", " 0 3 0 "] {
        assert!(printed.contains(mode), "mode, cause, turns:{mode}");
    }
}
