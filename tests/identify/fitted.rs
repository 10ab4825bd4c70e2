//! Scene files with what was fitted.

use stillbeam_sim::identify::arm::Free;
use stillbeam_sim::identify::scene::fitted;
use stillbeam_sim::scene_file::SceneFile;

const ARM: &str = "# The arm.\n[link]\nlength = 0.5\nmaterial = \"aluminium\"\nwidth = 0.04\n\
                   thickness = 0.004 # measured\nfrequency = 3.8\n\n[payload]\nmass = 0.5\n\n\
                   [damping]\nratio = 0.01\nfrom = \"beta\"\n";

#[test]
fn a_scene_keeps_what_was_not_fitted_and_runs() {
    let mut arm = SceneFile::parse_arm("arm", ARM).unwrap().arm;
    arm.link.bending_stiffness *= 0.9;
    (arm.damping.alpha, arm.damping.beta) = (0.02, 1e-4);
    let text = fitted(ARM, &arm, &[], &["log.csv".to_owned()]).unwrap();
    assert!(text.starts_with("# Fitted to log.csv by `stillbeam-sim identify`.\n# The arm.\n"));
    assert!(text.contains("thickness = 0.004 # measured\n"), "{text}");
    let scene = SceneFile::parse("fitted", &text).unwrap();
    assert!((scene.arm.link.bending_stiffness / arm.link.bending_stiffness - 1.0).abs() < 1e-6);
    assert_eq!((scene.arm.damping.alpha, scene.arm.damping.beta), (0.02, 1e-4));
    assert_eq!(scene.moves.len(), 1);
}

#[test]
fn a_payload_and_a_clamp_are_written_too() {
    let bare = "link = { length = 0.4, mass = 0.0224, bending_stiffness = 0.46 }\n\
                [move]\nprofile = \"cubic\"\nduration = 1.0\nto = 1.0\n";
    let mut arm = SceneFile::parse("arm", bare).unwrap().arm;
    arm.payload.mass = 0.031;
    arm.hub.stiffness = Some(12.5);
    let free = [Free::Payload, Free::Clamp];
    let text = fitted(bare, &arm, &free, &["log.csv".to_owned()]).unwrap();
    let scene = SceneFile::parse("fitted", &text).unwrap();
    assert_eq!((scene.arm.payload.mass, scene.arm.hub.stiffness), (0.031, Some(12.5)));
    assert_eq!(scene.arm.link.bending_stiffness, 0.46);
}
