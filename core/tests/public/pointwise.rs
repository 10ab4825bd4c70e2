//! The resolution of `pointwise`, beyond that of `elastica`.

use stillbeam::model::Rod;
use stillbeam::stepper::{Elastica, Pointwise, Quality};
use stillbeam::{Generator, Link, Move, Profile, Scene, Stepper};

const PI: f64 = core::f64::consts::PI;

/// Tip after every fifth millisecond of half a turn by a cubic of `duration` s, in ticks of `tick`
/// s, and as long behind it.
fn tips<S: Stepper<Scalar = f64>>(
    stepper: S,
    duration: f64,
    mut each: impl FnMut(usize, [f64; 2]),
) {
    let every = (0.005 / stepper.tick() + 0.5) as usize;
    let count = (2.0 * duration / stepper.tick() + 0.5) as usize;
    let mut generator = Generator::<_, 4>::new(stepper, 0.0).expect("a generator");
    generator.push(&Move::To { profile: Profile::Cubic, duration, to: PI }).expect("a move");
    for k in 0..=count {
        let [x, y] = generator.tick().tip;
        if k % every == 0 {
            each(k / every, [x, y]);
        }
    }
}

/// Scene `d-fast`, whose cubic begins and ends with jumps of the acceleration: against four modes
/// in ticks of 0.25 ms three modes in ticks of 5 ms err by less than 2e-5 of L, and an expansion by
/// five times that.
#[test]
fn the_third_mode_rings_as_the_bent_link_does() {
    let arm = Scene::new(Link { length: 0.4, mass: 0.0224, bending_stiffness: 0.46 });
    let mut truth = [[0.0; 2]; 81];
    tips(Pointwise::<f64, 4>::new(&arm, 0.000_25).expect("an arm"), 0.2, |k, tip| truth[k] = tip);
    let most = |off: &mut f64, k: usize, tip: [f64; 2]| {
        *off = off.max(libm::hypot(tip[0] - truth[k][0], tip[1] - truth[k][1]) / arm.link.length);
    };
    let (mut ours, mut expanded) = (0.0, 0.0);
    let pointwise = Pointwise::<f64, 3>::new(&arm, 0.005).expect("an arm");
    assert_eq!(pointwise.steps(), 6);
    tips(pointwise, 0.2, |k, tip| most(&mut ours, k, tip));
    let rod = Rod::<3>::new(&arm).expect("a rod");
    let elastica = Elastica::<f64, 3>::new(&rod, 0.005, Quality::Fine, 0.5).expect("an arm");
    tips(elastica, 0.2, |k, tip| most(&mut expanded, k, tip));
    assert!(ours < 2e-5 && expanded > 8e-5, "{ours} {expanded}");
}
