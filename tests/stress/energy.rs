//! Undamped arms that ring on.

use stillbeam_lab::stress::energy;

/// Their energy does not grow: by a thousandth in modes of any kind, by what rounding puts into the
/// highest of many elements in f32.
#[test]
fn an_arm_that_rings_on_gains_nothing() {
    let rings = energy::rings(8, 0, 12, 200_000, &|| ());
    assert!(rings.len() > 200, "{}", rings.len());
    for ring in rings {
        let rounded = ring.method.starts_with("newmark") && ring.method.ends_with("f32");
        let most = if rounded { 0.05 } else { 1e-3 };
        assert!(ring.growth < most, "{ring:?}");
    }
}
