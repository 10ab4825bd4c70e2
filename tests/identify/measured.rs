//! Measured logs of real arms. They are not part of the project: the folder is named by
//! `STILLBEAM_LOGS`, or lies at `../shared/logs` beside the project's own.

use std::path::PathBuf;

use stillbeam_sim::identify::arm::Sensor;
use stillbeam_sim::identify::forced::Lowpass;
use stillbeam_sim::identify::report::Report;
use stillbeam_sim::identify::{Identified, Request};
use stillbeam_sim::scene_file::SceneFile;

/// Returns the folder of the logs, or says in a line that there is none.
fn folder() -> Option<PathBuf> {
    let named = std::env::var_os("STILLBEAM_LOGS").map(PathBuf::from);
    let beside = || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../shared/logs"));
    let folder = named.unwrap_or_else(beside);
    if folder.is_dir() {
        return Some(folder);
    }
    println!("measured logs: not checked, there is no folder {}", folder.display());
    None
}

fn report(names: &[&str], request: Request) -> Option<Report> {
    let folder = folder()?;
    let logs = names.iter().map(|name| folder.join(name).with_extension("csv")).collect();
    let Identified { report, .. } = Request { logs, ..request }.carry_out().expect("a report");
    Some(report)
}

#[track_caller]
fn near(what: &str, value: f64, expected: f64, relative: f64) {
    let error = value / expected - 1.0;
    assert!(error.abs() <= relative, "{what}: {value} is not {expected}, off by {error:.2e}");
}

fn warned(report: &Report, words: &str) -> bool {
    report.warnings.iter().any(|warning| warning.contains(words))
}

fn strip(length: f64) -> Request {
    let text = format!(
        "[link]\nlength = {length}\nyoungs_modulus = 70e9\ndensity = 2700\nwidth = 0.05\nthickness = \
         0.002\n"
    );
    let arm = SceneFile::parse_arm("strip", &text).expect("a strip").arm;
    let sensor = Some(Sensor { at: length - 0.06, mass: 0.005 });
    Request { sensor, scene: Some(("strip".to_owned(), arm)), ..Request::default() }
}

#[test]
fn a_strip_released_into_saturation() {
    let Some(report) = report(&["strip30-ringdown"], strip(0.3)) else { return };
    let mode = &report.modes[0];
    near("small", mode.frequency_hz, 16.35, 1e-3);
    near("large", mode.large_frequency_hz.expect("amplitude terms"), 16.30, 1e-3);
    near("second mode", report.modes[1].frequency_hz, 107.6, 0.01);
    assert!(report.fit_percent >= 97.0, "{}", report.fit_percent);
    assert!(warned(&report, "clipped") && warned(&report, "changes with amplitude"));
    let arm = report.arm.expect("an arm");
    let stiff = arm.documented_frequency_hz[0] / mode.frequency_hz - 1.0;
    assert!((0.025..0.053).contains(&stiff), "the geometry is {stiff} too high");
}

#[test]
fn a_strip_released_by_hand() {
    let Some(report) = report(&["strip50-ringdown"], strip(0.5)) else { return };
    near("small", report.modes[0].frequency_hz, 6.06, 1e-3);
    near("small damping", report.modes[0].damping_ratio, 0.0014, 0.05);
    near("second mode", report.modes[1].frequency_hz, 39.05, 1e-3);
    assert!(report.fit_percent >= 97.0, "{}", report.fit_percent);
    let stiff = report.arm.expect("an arm").documented_frequency_hz[0] / 6.06 - 1.0;
    assert!((0.025..0.05).contains(&stiff), "the geometry is {stiff} too high");
}

#[test]
fn a_struck_steel_beam() {
    let text =
        "[link]\nlength = 0.759\nmaterial = \"steel\"\nwidth = 0.05066\nthickness = 0.00514\n";
    let arm = SceneFile::parse_arm("beam", text).expect("a beam").arm;
    let sensor = Some(Sensor { at: 0.75, mass: 0.0058 });
    let scene = Some(("beam".to_owned(), arm));
    let request = Request { sensor, scene, ..Request::default() };
    let Some(report) = report(&["steel-beam-impulse"], request) else { return };
    for (mode, (hz, ratio)) in
        report.modes.iter().zip([(6.620, 0.0030), (41.387, 0.0015), (116.88, 0.0024)])
    {
        near("frequency", mode.frequency_hz, hz, 1e-3);
        near("damping", mode.damping_ratio, ratio, 0.08);
    }
    let change = report.arm.expect("an arm").values[0].change_percent().expect("a handbook's EI");
    assert!((-17.0..-15.0).contains(&change), "{change}");
}

#[test]
fn a_link_behind_a_harmonic_drive() {
    let lowpass = Some(Lowpass { frequency: 2.0, ratio: 0.9 });
    let request = || Request { lowpass, ..Request::default() };
    let pair = ["link-hinf-30", "link-hinf-0"];
    for names in [pair, [pair[1], pair[0]]] {
        let Some(report) = report(&names, request()) else { return };
        let mode = &report.modes[0];
        near("frequency", mode.frequency_hz, 1.80, 0.02);
        assert!((mode.damping_ratio - 0.11).abs() < 0.02, "{}", mode.damping_ratio);
        assert!(report.fit_percent >= 90.0, "{}", report.fit_percent);
        assert!(report.validation_percent >= 85.0, "{}", report.validation_percent);
    }
    // Without its filter the sensor seems to lag.
    let report = report(&pair[..1], Request::default()).expect("the folder is there");
    assert!(warned(&report, "lags by") && warned(&report, "the part for validation is quiet"));
}

#[test]
fn a_bar_behind_a_gear_with_play() {
    let Some(report) = report(&["bar-prbs"], Request::default()) else { return };
    near("frequency", report.modes[0].frequency_hz, 3.47, 0.02);
    assert!(report.fit_percent < 80.0 && warned(&report, "likely gear play"), "{report:?}");
}
