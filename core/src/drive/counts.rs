//! Values to whole counts.

/// `value` in counts of `per_unit` to the unit, to nearest (halves to even), and whether it had to
/// be cut to `min..=max`.
pub(super) fn count(value: f32, per_unit: f32, min: i32, max: i32) -> (i32, bool) {
    // f64, because an f32 cannot tell 2³¹ − 1 from 2³¹.
    let counts = libm::rint(f64::from(value) * f64::from(per_unit));
    let clamped = counts.clamp(f64::from(min), f64::from(max));
    (clamped as i32, clamped != counts)
}

/// Counts in an i16, in the same way as [`count`].
pub(super) fn count_i16(value: f32, per_unit: f32) -> (i16, bool) {
    let (counts, saturated) = count(value, per_unit, i16::MIN.into(), i16::MAX.into());
    (counts as i16, saturated)
}
