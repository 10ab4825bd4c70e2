use stillbeam::Scalar;

/// Worst error of sine and cosine over ±½ turn.
fn worst<T: Scalar>() -> f64 {
    (-50_000..=50_000)
        .map(|i| {
            let x = T::from_f64(f64::from(i) / 100_000.0);
            let (sin, cos) = x.sin_cos_turns();
            let exact = (core::f64::consts::TAU * x.to_f64()).sin_cos();
            (sin.to_f64() - exact.0).abs().max((cos.to_f64() - exact.1).abs())
        })
        .fold(0.0, f64::max)
}

#[test]
fn sine_and_cosine_keep_their_stated_error() {
    assert!(worst::<f32>() <= 1.5e-7, "f32: {:e}", worst::<f32>());
    assert!(worst::<f64>() <= 4e-16, "f64: {:e}", worst::<f64>());
}

#[test]
fn quarter_turns_are_exact() {
    for (turns, expected) in
        [(0.0, (0.0, 1.0)), (0.25, (1.0, 0.0)), (0.5, (0.0, -1.0)), (-0.25, (-1.0, 0.0))]
    {
        assert_eq!(f32::from_f64(turns).sin_cos_turns(), (expected.0 as f32, expected.1 as f32));
        assert_eq!(turns.sin_cos_turns(), expected);
    }
}
