//! Fig. 5: length of the time step.

use maud::html;

use super::parts::{Table, figure, fixed, millimetres, ms, percent};
use super::{STOP, Section, TIME, TIP_X};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Marker, Series};
use crate::study::steps::{Step, Steps};
use crate::study::{Run, Study};

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let steps = &study.steps;
    let time = |title: &str, y: Axis, values: fn(&Run) -> Vec<(f64, f64)>| {
        let chart = Chart::new(title, Axis::tight(TIME), y);
        curves(chart.mark(steps.finest.move_time(), STOP), steps, values)
    };
    let over_time = [
        time("Fig. 5: tip X", Axis::linear(TIP_X), Run::tip_x),
        time("Deflection", Axis::linear("deflection, mm"), |run| millimetres(run.deflection())),
    ];
    let caption = html! {
        strong { "At 10 ms amplitude and period have converged, as the paper finds; at 100 ms the \
                  swing runs late." }
        " Member A with 30 g, \u{3c0} rad in 2 s, 2 s of rest, undamped, newmark, 1 consistent \
         element, f64. Steps of 1, 2 and 5 ms would lie on the curve of "
        (ms(steps.finest.solver.tick, 1)) " ms."
    };
    let order_caption = html! {
        strong { "Second order: a tenth of the step, a hundredth of the error." }
        " Distance of the tip from the run at " (ms(steps.finest.solver.tick, 1)) " ms, at the \
         times that both have."
    };
    let row = |step: &Step| {
        vec![
            ms(step.run.solver.tick, 0),
            fixed(1e2 * step.tip_max, 4),
            fixed(1e2 * step.tip_rms, 4),
            fixed(1e2 * step.residual, 2),
        ]
    };
    let table = Table {
        caption: format!(
            "Distance of the tip from the run at {} ms, whose residual is {} of L.",
            ms(steps.finest.solver.tick, 1),
            percent(steps.finest_residual, 2),
        ),
        header: vec!["Step, ms", "Largest, % of L", "Root mean square, % of L", "Residual, % of L"],
        rows: steps.steps.iter().map(row).collect(),
        key: steps.steps.iter().position(|step| step.run.solver.tick == 0.01),
    };
    let body = html! {
        (figure(&over_time, &caption, "fig5-steps.csv")?)
        (table.markup())
        (figure(&[order(steps)], &order_caption, "fig5-errors.csv")?)
    };
    Ok(Section { id: "fig5", title: "Fig. 5: length of the time step", body })
}

/// Adds the finest run broad and below, some of the others over it.
fn curves(chart: Chart, steps: &Steps, values: fn(&Run) -> Vec<(f64, f64)>) -> Chart {
    let shown = [
        (0.01, Colour::Ink, Dash::Solid, 1),
        (0.02, Colour::Blue, Dash::Dotted, 2),
        (0.05, Colour::Green, Dash::Dashed, 2),
        (0.1, Colour::Vermilion, Dash::Solid, 2),
    ];
    let others = shown.into_iter().filter_map(|(tick, colour, dash, width)| {
        let step = steps.steps.iter().find(|step| step.run.solver.tick == tick)?;
        let label = format!("{} ms", ms(tick, 0));
        Some(Series::line(label, values(&step.run)).colour(colour).dash(dash).width(width))
    });
    let finest = format!("{} ms", ms(steps.finest.solver.tick, 1));
    chart
        .with(Series::line(finest, values(&steps.finest)).colour(Colour::Sky).width(6))
        .with_all(others)
}

fn order(steps: &Steps) -> Chart {
    let points = |of: fn(&Step) -> f64| -> Vec<(f64, f64)> {
        steps.steps.iter().map(|step| (1e3 * step.run.solver.tick, 1e2 * of(step))).collect()
    };
    Chart::new("Error over the step", Axis::log("step, ms"), Axis::log("tip error, % of L"))
        .sized(900, 380)
        .with(Series::line("largest", points(|step| step.tip_max)).marker(Marker::Dot))
        .with(
            Series::line("root mean square", points(|step| step.tip_rms))
                .marker(Marker::Ring)
                .dash(Dash::Dashed),
        )
}
