//! Identified arms as one page: log and fit, residual, spectrum, what to trust.

use maud::{Markup, PreEscaped, html};

use super::moving;
use super::panel::Panel;
use super::report::{ModeReport, Report};
use super::request::Identified;
use super::spectrum::Spectrum;
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Series};
use crate::report::parts::{Table, page};
use crate::table::significant;

/// Points of a curve at most. Of more, the extremes of neighbours are drawn.
const POINTS: usize = 1600;

/// Width and height of a chart, units.
const SIZE: (u32, u32) = (1040, 300);

/// Periods in the picture that shows single ones.
const CLOSE: f64 = 12.0;

/// Returns the page.
pub fn text(title: &str, identified: &Identified) -> Result<String, Error> {
    let report = &identified.report;
    let mut charts = Vec::new();
    for panel in &identified.panels {
        charts.extend(panel_charts(panel, report)?);
    }
    let body = html! {
        header {
            h1 { "From a log to an arm" }
            p.lead { (title) ": " (report.case) ", " (report.logs.join(", ")) }
        }
        (modes(&report.modes))
        (arm(report))
        p {
            "The fit explains " (significant(report.fit_percent, 4)) " % of what was fitted and "
            (significant(report.validation_percent, 4)) " % of what was held out: 100 (1 \u{2212} \
            \u{2016}y \u{2212} \u{177}\u{2016}/\u{2016}y \u{2212} \u{233}\u{2016})."
            @if let (Some(delay), Some(scale)) = (report.delay_s, report.scale) {
                " The sensor lags by " (significant(1e3 * delay, 3)) " ms and shows "
                (significant(scale, 4)) " " (report.unit) " per rad."
            }
        }
        (trust(report))
        @if let Some(panel) = identified.panels.first() { (moves(panel, report)) }
        @for picture in &charts { figure { div.charts { (PreEscaped(picture)) } } }
    };
    Ok(page(title, &body))
}

fn moves(panel: &Panel, report: &Report) -> Markup {
    let animation = moving::animation(panel, report);
    animation.figure(&html! {
        "The arm " (animation.speed()) ", over and over: deflected as the sensor of " (panel.log)
        " shows, and as the fit does. The sensor\u{2019}s largest reading is drawn as a fifth of the \
         length."
    })
}

fn modes(modes: &[ModeReport]) -> Markup {
    let range = |interval: [f64; 2], factor: f64, digits: usize| {
        format!(
            "{} to {}",
            significant(factor * interval[0], digits),
            significant(factor * interval[1], digits)
        )
    };
    let row = |(index, mode): (usize, &ModeReport)| {
        vec![
            (index + 1).to_string(),
            significant(mode.frequency_hz, 5).to_string(),
            range(mode.frequency_interval_hz, 1.0, 5),
            significant(100.0 * mode.damping_ratio, 3).to_string(),
            range(mode.damping_interval, 100.0, 3),
            range([mode.amplitude[1], mode.amplitude[0]], 1.0, 3),
        ]
    };
    let table = Table {
        caption: "Modes of small vibrations, with 95 % intervals".to_owned(),
        header: vec!["mode", "frequency, Hz", "interval", "damping, %", "interval", "seen at"],
        rows: modes.iter().enumerate().map(row).collect(),
        key: None,
    };
    table.markup()
}

fn arm(report: &Report) -> Markup {
    let Some(arm) = &report.arm else { return html! {} };
    let row = |value: &super::report::Fitted| {
        vec![
            format!("{}, {}", value.key, value.unit),
            value.documented.map_or("\u{2013}".to_owned(), |x| significant(x, 4).to_string()),
            significant(value.fitted, 4).to_string(),
            value.change_percent().map_or("\u{2013}".to_owned(), |x| format!("{x:+.1}")),
        ]
    };
    let table = Table {
        caption: format!("The arm of {}", arm.scene),
        header: vec!["", "documented", "fitted", "change, %"],
        rows: arm.values.iter().map(row).collect(),
        key: None,
    };
    table.markup()
}

fn trust(report: &Report) -> Markup {
    html! {
        aside {
            h3 { "What to trust" }
            @if report.warnings.is_empty() {
                p { "Nothing in the log speaks against the figures and their intervals." }
            } @else {
                ul { @for warning in &report.warnings { li { (warning) } } }
            }
        }
    }
}

fn panel_charts(panel: &Panel, report: &Report) -> Result<Vec<String>, Error> {
    let unit = &report.unit;
    let Panel { log, time, measured, fitted, .. } = panel;
    let curve = |values: &[f64]| thinned(time, values);
    let pair = |title: String, from: f64, to: f64| {
        let inside = |values: &[f64]| {
            let rows = time.iter().zip(values).filter(|row| (from..=to).contains(row.0));
            let (time, values): (Vec<f64>, Vec<f64>) = rows.map(|row| (*row.0, *row.1)).unzip();
            thinned(&time, &values)
        };
        Chart::new(title, Axis::tight("time, s"), Axis::linear(unit.clone()))
            .sized(SIZE.0, SIZE.1)
            .with(Series::line("measured", inside(measured)).colour(Colour::Grey).width(3))
            .with(Series::line("fitted", inside(fitted)).colour(Colour::Blue))
    };
    let (begin, end) = (time[0], time[time.len() - 1]);
    let close = CLOSE / report.modes[0].frequency_hz;
    let left: Vec<f64> = measured.iter().zip(fitted).map(|(y, fit)| y - fit).collect();
    let residual = Chart::new("Residual", Axis::tight("time, s"), Axis::linear(unit.clone()))
        .sized(SIZE.0, SIZE.1)
        .with(Series::line("residual", curve(&left)).colour(Colour::Vermilion));
    let spectrum = |values: &[f64]| {
        let spectrum = Spectrum::of(time, values);
        let points = spectrum.amplitude.iter().enumerate().skip(1);
        let points: Vec<(f64, f64)> =
            points.map(|(k, a)| (k as f64 * spectrum.spacing, *a)).collect();
        let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        thinned(&x, &y)
    };
    let frequencies = Chart::new("Spectrum", Axis::log("frequency, Hz"), Axis::log(unit.clone()))
        .sized(SIZE.0, SIZE.1)
        .with(Series::line("measured", spectrum(measured)).colour(Colour::Grey))
        .with(Series::line("residual", spectrum(&left)).colour(Colour::Vermilion));
    let frequencies = report.modes.iter().enumerate().fold(frequencies, |chart, (k, mode)| {
        chart.mark(mode.frequency_hz, format!("mode {}", k + 1))
    });
    let mut charts = vec![pair(format!("{log}: log and fit"), begin, end)];
    if end - begin > 1.5 * close {
        charts.push(pair("The first periods".to_owned(), begin, begin + close));
    }
    charts.extend([residual, frequencies]);
    charts.iter().map(Chart::svg).collect()
}

/// Returns the points of a curve, of many only the extremes of each block of neighbours.
fn thinned(x: &[f64], y: &[f64]) -> Vec<(f64, f64)> {
    let block = (2 * x.len()).div_ceil(POINTS);
    if block < 3 {
        return x.iter().copied().zip(y.iter().copied()).collect();
    }
    let mut points = Vec::new();
    for (x, y) in x.chunks(block).zip(y.chunks(block)) {
        let by = |k: &usize, other: &usize| y[*k].total_cmp(&y[*other]);
        let low = (0..y.len()).min_by(by).unwrap_or(0);
        let high = (0..y.len()).max_by(by).unwrap_or(0);
        let (first, second) = (low.min(high), low.max(high));
        points.push((x[first], y[first]));
        points.push((x[second], y[second]));
    }
    points
}
