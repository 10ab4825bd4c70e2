//! Identified arms, held against the truth.

use stillbeam_sim::error::Error;
use stillbeam_sim::identify::report::Report;
use stillbeam_sim::identify::{Identified, Request};

use super::arm::{Case, Kind};

/// Outcome of one log.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    /// Kind of the log.
    pub kind: Kind,
    /// Frequency over the truth, less one.
    pub frequency: f64,
    /// Damping ratio over the truth, less one.
    pub damping: f64,
    /// EI over the truth, less one.
    pub stiffness: f64,
    /// True if the interval of the frequency holds the truth.
    pub holds_frequency: bool,
    /// True if the interval of the damping ratio holds the truth.
    pub holds_damping: bool,
    /// Delay less the truth, first periods. Zero of a ring-down.
    pub delay: f64,
    /// Fit, %.
    pub fit_percent: f64,
}

/// Identifies a case from its log, by the command's own means.
pub fn identified(case: &Case) -> Result<Report, Error> {
    Ok(identify(case)?.report)
}

fn identify(case: &Case) -> Result<Identified, Error> {
    let request = Request {
        modes: Some(1),
        lowpass: case.lowpass,
        sensor: case.sensor,
        scene: Some(("synthetic".to_owned(), case.claimed())),
        ..Request::default()
    };
    request.identify(vec![case.log()?])
}

/// Holds what is identified of a case against its truth.
pub fn judge(case: &Case) -> Result<Judged, Error> {
    let Identified { report, arm, .. } = identify(case)?;
    let mode = &report.modes[0];
    let (hz, ratio) = (case.frequency[0], case.ratio[0]);
    let holds = |interval: [f64; 2], truth: f64| (interval[0]..=interval[1]).contains(&truth);
    let stiffness = arm.map_or(f64::NAN, |arm| arm.link.bending_stiffness);
    Ok(Judged {
        kind: case.kind,
        frequency: mode.frequency_hz / hz - 1.0,
        damping: mode.damping_ratio / ratio - 1.0,
        stiffness: stiffness / case.arm.link.bending_stiffness - 1.0,
        holds_frequency: holds(mode.frequency_interval_hz, hz),
        holds_damping: holds(mode.damping_interval, ratio),
        delay: report.delay_s.map_or(0.0, |delay| (delay - case.delay) * hz),
        fit_percent: report.fit_percent,
    })
}
