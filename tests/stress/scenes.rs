//! Random scenes far outside of what an arm is.

use stillbeam_lab::stress::{campaign, energy};

#[test]
fn random_scenes_neither_panic_nor_leave_their_bounds() {
    let summary = campaign::run(5, 1000, None, &|_| ()).expect("a campaign");
    assert_eq!(summary.scenes, 1000);
    for (name, counts) in &summary.methods {
        assert_eq!(counts.panicked, 0, "{name}: {:?}", summary.failures);
        assert_eq!(counts.not_finite, 0, "{name}: {:?}", summary.failures);
        assert_eq!(counts.off_target, 0, "{name}: {:?}", summary.failures);
        // A campaign that refuses everything would hold as well.
        let most = if name == "auto" { 0.9 } else { 0.7 };
        let refused = counts.refused as f64 / (counts.refused + counts.ran) as f64;
        assert!(refused < most, "{name}: {refused}");
        if !name.starts_with("elastica") {
            assert_eq!(counts.above, 0, "{name}: {:?}", summary.failures);
        }
    }
    assert!(summary.reasons.len() >= 6, "{:?}", summary.reasons);
    assert!(summary.ticks > 1_000_000, "{}", summary.ticks);
}

#[test]
fn a_campaign_does_not_depend_on_how_it_is_cut() {
    let whole = campaign::run(6, 40, None, &|_| ()).expect("a campaign");
    let folder = std::env::temp_dir().join(format!("stillbeam-stress-{}", std::process::id()));
    let part = folder.join("part.toml");
    for scenes in [15, 40] {
        let cut = campaign::run(6, scenes, Some(&part), &|_| ()).expect("a part");
        assert_eq!(cut.scenes, scenes);
        if scenes == 40 {
            assert_eq!(cut, whole);
        }
    }
    std::fs::remove_dir_all(folder).expect("a folder that was made");
}

#[test]
fn undamped_arms_gain_no_energy() {
    let rings = energy::rings(8, 0, 4, 50_000, &|| ());
    let of = |method: &str| rings.iter().filter(|ring| ring.method == method).count();
    assert!(of("modal, 2, f32") >= 3 && of("newmark, 4, f64") >= 3);
    for ring in rings {
        let linear = ring.method.starts_with("modal") || ring.method == "newmark, 4, f64";
        // Eight elements lose the digits of `K q`.
        let small = ring.turn < 0.1 && ring.method != "newmark, 8, f32";
        if linear || small {
            assert!(ring.growth < 1e-3, "{ring:?}");
        }
    }
}
