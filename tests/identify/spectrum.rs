//! Spectra of unevenly sampled logs.

use std::f64::consts::TAU;

use stillbeam_sim::identify::spectrum::Spectrum;

#[test]
fn a_sine_shows_at_its_frequency_with_its_amplitude() {
    let time: Vec<f64> = (0..3000).map(|k| 1e-3 * f64::from(k) + 2e-5 * f64::from(k % 7)).collect();
    let value: Vec<f64> = time.iter().map(|t| 4.0 + 0.7 * (TAU * 12.3 * t).sin()).collect();
    let spectrum = Spectrum::of(&time, &value);
    let peak = spectrum.peak(1.0, 400.0, &|_| true).expect("a peak");
    assert!((peak.frequency - 12.3).abs() < 0.05, "{peak:?}");
    assert!((peak.amplitude - 0.7).abs() < 0.02 && peak.prominence > 50.0, "{peak:?}");
}
