//! Drawn arms as they are measured: frequencies in place of a stiffness, ratios in place of a
//! damping, sizes of a section that tapers. They take the way of a scene file.

use std::f64::consts::TAU;

use rand::rngs::StdRng;
use rand::{Rng, SeedableRng};
use stillbeam::scene::Varied;
use stillbeam::{Damping, Hub, Scene};
use stillbeam_sim::arm::natural;
use stillbeam_sim::scene_file::SceneFile;

use super::draw::Drawn;
use crate::random::decades;

/// Puts a measured arm in the place of an eighth of the drawn ones, with the same length, masses
/// and about the same first frequency. An arm that the measurements do not tell stays as drawn.
///
/// From numbers of its own, so that what else is drawn stays what it is.
pub fn measured(drawn: Drawn, seed: u64, index: u64) -> Drawn {
    let mut rng = StdRng::seed_from_u64(seed.wrapping_mul(0xa076_1d64_78bd_642f) ^ index);
    if !rng.random_bool(0.125) {
        return drawn;
    }
    let text = text(&mut rng, &drawn);
    let Ok(file) = SceneFile::parse_arm("measured", &text) else { return drawn };
    let Scene { mount, gravity, .. } = drawn.scene.arm;
    let arm = Scene { mount, gravity, ..file.arm };
    let omega = natural::frequencies(&arm).map_or(drawn.omega, |hertz| TAU * hertz[0]);
    let scene = SceneFile { arm, deduced: file.deduced, remarks: file.remarks, ..drawn.scene };
    Drawn { scene, omega, ..drawn }
}

/// The arm as a scene file.
fn text(rng: &mut StdRng, drawn: &Drawn) -> String {
    let arm = &drawn.scene.arm;
    let (link, hub, payload) = (&arm.link, &arm.hub, &arm.payload);
    let (stiffness, hertz) = frequency(rng, drawn);
    format!(
        "[link]\nlength = {:e}\nmass = {:e}\nfrequency = {hertz:?}\n{}{}\
         [hub]\nradius = {:e}\ninertia = {:e}\n{stiffness}\
         [payload]\nmass = {:e}\ninertia = {:e}\noffset = {:e}\n{}",
        link.length,
        link.mass,
        sizes(rng, link.length),
        if stiffness.is_empty() { String::new() } else { stiff_link(drawn, hertz.len()) },
        hub.radius,
        hub.inertia,
        payload.mass,
        payload.inertia,
        payload.offset,
        damping(rng)
    )
}

/// The line that asks for a joint, or none, and what was measured, Hz: one frequency, up to three
/// that no link has exactly, or those of a joint.
fn frequency(rng: &mut StdRng, drawn: &Drawn) -> (&'static str, Vec<f64>) {
    let arm = Scene { shape: Varied::UNIFORM, damping: Damping::default(), ..drawn.scene.arm };
    let link = arm.link.bending_stiffness / arm.link.length;
    let joint = Some(link * decades(rng, -1.0, 2.0));
    let with = |stiffness| {
        let arm = Scene { hub: Hub { stiffness, ..arm.hub }, ..arm };
        natural::frequencies(&arm).map_or(vec![drawn.omega / TAU], Vec::from)
    };
    let count = rng.random_range(1..4);
    let (line, mut hertz) = match rng.random_range(0..3) {
        0 => ("", vec![drawn.omega / TAU]),
        1 => ("", with(None)),
        _ => ("stiffness = \"deduced\"\n", with(joint)),
    };
    hertz.truncate(count);
    for value in &mut hertz {
        *value *= 1.0 + rng.random_range(-0.05..0.05);
    }
    (line, hertz)
}

/// The stiffness that a file gives where one frequency is to tell the joint alone.
fn stiff_link(drawn: &Drawn, frequencies: usize) -> String {
    let stiffness = drawn.scene.arm.link.bending_stiffness;
    if frequencies == 1 { format!("bending_stiffness = {stiffness:e}\n") } else { String::new() }
}

/// Sizes of the section, or none. Their scale does not matter, as mass and stiffness are given.
fn sizes(rng: &mut StdRng, length: f64) -> String {
    let size = |part: f64| format!("{:e}", part * length);
    let taper = rng.random_range(0.3..1.0);
    match rng.random_range(0..4) {
        0 => String::new(),
        1 => {
            format!("width = {}\nthickness = [{}, {}]\n", size(0.1), size(0.01), size(0.01 * taper))
        }
        2 => format!("diameter = [{}, {}]\n", size(0.02), size(0.02 * taper)),
        _ => format!(
            "diameter = [{}, {}]\nwall = {}\n",
            size(0.03),
            size(0.03 * taper),
            size(0.003 * taper)
        ),
    }
}

/// No damping, the ratio of a term, or two ratios.
fn damping(rng: &mut StdRng) -> String {
    let [one, other] = [decades(rng, -4.0, -0.5), decades(rng, -4.0, -0.5)];
    match rng.random_range(0..4) {
        0 => String::new(),
        1 => format!("[damping]\nratio = {one:e}\nfrom = \"alpha\"\n"),
        2 => format!("[damping]\nratio = {one:e}\nfrom = \"beta\"\n"),
        _ => format!("[damping]\nratio = [{one:e}, {other:e}]\n"),
    }
}

#[cfg(test)]
mod tests {
    use crate::stress::draw::draw;

    /// Measured arms are drawn, of every kind: of one frequency and of more, with joint and
    /// without, sizes that taper, damping by ratios.
    #[test]
    fn measured_arms_are_among_the_drawn() {
        let drawn: Vec<_> = (0..400).map(|index| draw(8, index).scene).collect();
        let some = |what: &str, is: &dyn Fn(&stillbeam_sim::scene_file::SceneFile) -> bool| {
            let count = drawn.iter().filter(|scene| is(scene)).count();
            assert!(count >= 2, "{what}: {count} of 400");
        };
        some("a link", &|scene| scene.deduced.bending_stiffness.is_some());
        some("a joint", &|scene| scene.deduced.hub_stiffness.is_some());
        some("several frequencies", &|scene| scene.deduced.frequency_misfit.is_some());
        some("a ratio", &|scene| scene.deduced.lines().iter().any(|line| line.contains("ratio")));
    }
}
