//! Charts of the setpoints that came back.

use maud::html;
use stillbeam::Setpoint;
use stillbeam::axis::{Mode, Tick};

use super::Session;
use crate::error::Error;
use crate::plot::{Axis, Chart, Series};
use crate::report::parts;

/// Draws a page with the setpoints of every axis while its drive was on.
///
/// # Errors
/// A chart cannot be drawn.
pub fn page(session: &Session) -> Result<String, Error> {
    let sections = (0..session.axes()).map(|axis| {
        let angle = |s: &Setpoint<f32>| s.angle.radians();
        let charts = [
            chart(session, axis, "Hub angle", "angle, rad", angle),
            chart(session, axis, "Rate", "rate, rad/s", |s| s.rate.into()),
            chart(session, axis, "Torque", "hub torque, N m", |s| s.torque.into()),
            chart(session, axis, "Deflection", "tip, mm", |s| 1e3 * f64::from(s.deflection())),
        ];
        let pictures = charts.iter().map(Chart::svg).collect::<Result<Vec<_>, _>>()?;
        Ok(html! {
            section {
                h2 { "Axis " (axis) }
                figure {
                    div.charts.two {
                        @for picture in &pictures { (maud::PreEscaped(picture)) }
                    }
                }
            }
        })
    });
    let sections = sections.collect::<Result<Vec<_>, Error>>()?;
    let [setpoints, frames] = session.compared();
    let body = html! {
        header {
            h1 { "What the firmware sent" }
            p.lead {
                (setpoints) " setpoints and " (frames) " drive frames, every one equal to the \
                 host's own to the last bit. Nothing is drawn while a drive is off; grey lines \
                 are where an axis is enabled and where a stop begins."
            }
        }
        main { @for section in &sections { (section) } }
    };
    Ok(parts::page("Stillbeam: what the firmware sent", &body))
}

fn chart(
    session: &Session,
    axis: u8,
    title: &str,
    label: &str,
    of: impl Fn(&Setpoint<f32>) -> f64,
) -> Chart {
    let h = session.tick();
    let time = |tick: &Tick<f32>| f64::from(tick.number) * h;
    let history = session.history(axis);
    let mut chart = Chart::new(title, Axis::tight("time, s"), Axis::linear(label));
    for stretch in history.chunk_by(|a, b| a.mode == b.mode) {
        // Where a stop ends, the curve shows.
        let Some(first) = stretch.first() else { continue };
        match first.mode {
            Mode::Enabled => chart = chart.mark(time(first), "on"),
            Mode::Stopping => chart = chart.mark(time(first), "stop"),
            Mode::Disabled | Mode::Stopped => {}
        }
    }
    let on = history.chunk_by(|a, b| (a.mode == Mode::Disabled) == (b.mode == Mode::Disabled));
    let on = on.filter(|stretch| stretch.iter().all(|tick| tick.mode != Mode::Disabled));
    chart.with_all(on.map(|stretch| {
        let points = stretch.iter().map(|tick| (time(tick), of(&tick.setpoint)));
        Series::line("", points.collect::<Vec<_>>()).colour(crate::plot::Colour::Blue)
    }))
}
