//! Paths through waypoints.

mod arm;
mod curve;
mod queue;

use stillbeam::hub::HubState;
use stillbeam::motion::{Path, Segment, Spline, Waypoint};
use stillbeam::stepper::Rigid;
use stillbeam::{Angle, Generator, Limits, Link, Scene};

pub const TICK: f64 = 0.01;

fn scene() -> Scene {
    Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 })
}

pub fn rest() -> HubState<f64> {
    HubState::at_rest(Angle::from_radians(0.0))
}

fn path(spline: Spline, start: HubState<f64>) -> Path {
    Path::new(spline, start, &Limits::default(), TICK).expect("a path")
}

pub fn generator() -> Generator<Rigid<f64>, 8> {
    Generator::new(Rigid::new(&scene(), TICK).expect("stepper"), 0.0).expect("generator")
}

fn segments(path: Path, rows: &[Waypoint]) -> Vec<Segment<f64>> {
    path.segments(rows.iter().copied()).map(|segment| segment.expect("a row")).collect()
}

/// The hub from both sides of every border, and at every tick, in s from the path's beginning.
pub fn borders(segments: &[Segment<f64>]) -> Vec<[HubState<f64>; 2]> {
    let mut found = Vec::new();
    for pair in segments.windows(2) {
        let before = pair[1].ticks_before();
        let end = f64::from(pair[0].count()) - before;
        found.push([pair[0].hub_at(end), pair[1].hub_at(-before)]);
    }
    found
}
