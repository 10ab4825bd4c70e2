//! A part of `cargo lab identify` in every test run.

use stillbeam_lab::identify::{Case, Judged, Kind, SEED, campaign, judge};

/// Logs that are identified here, of the thousand of the campaign.
const COUNT: u64 = 12;

fn of(results: &[Judged], kind: Kind) -> impl Iterator<Item = &Judged> {
    results.iter().filter(move |result| result.kind == kind)
}

/// 95 % intervals hold the truth in at least 90 % of the logs, and errors keep what is promised.
#[test]
fn intervals_hold_the_truth() {
    let results = campaign(SEED, 0..COUNT, &|| ()).expect("a campaign");
    assert_eq!(results.len() as u64, COUNT);
    let share = |holds: fn(&Judged) -> bool| {
        results.iter().filter(|result| holds(result)).count() as f64 / COUNT as f64
    };
    let (frequency, damping) = (share(|r| r.holds_frequency), share(|r| r.holds_damping));
    assert!(frequency >= 0.9 && damping >= 0.9, "{frequency} {damping}");
    for (kind, hz, ratio) in [(Kind::Long, 5e-4, 0.10), (Kind::Short, 2e-3, 0.30)] {
        for result in of(&results, kind) {
            assert!(result.frequency.abs() < hz, "{result:?}");
            assert!(result.damping.abs() < ratio, "{result:?}");
        }
    }
    for result in results.iter().filter(|result| result.kind.is_forced()) {
        assert!(result.delay.abs() < 0.02, "{result:?}");
        assert!(result.fit_percent > 85.0, "{result:?}");
    }
    for result in of(&results, Kind::Accelerometer) {
        assert!(result.stiffness.abs() < 2e-3, "the sensor's mass is told from EI: {result:?}");
    }
}

/// A record of less than two periods is refused, whatever is in it.
#[test]
fn under_two_periods_is_refused() {
    for index in 0..5 {
        let case = Case::random(SEED, index).expect("a case");
        let case = Case { periods: 1.7, noise: 30.0, ..case };
        let error = judge(&case).expect_err("too short").to_string();
        assert!(error.contains("periods"), "{index}: {error}");
    }
}
