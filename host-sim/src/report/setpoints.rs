//! Feed-forward setpoints of one move.

use maud::html;

use super::parts::{figure, fixed, millimetres};
use super::{STOP, Section, TIME, TIP_X};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::study::setpoints::Setpoints;
use crate::study::{Run, Study};
use crate::table::Row;

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let Setpoints { flexible, rigid } = &study.setpoints;
    let chart = |title: &str, y: &str| {
        let chart = Chart::new(title, Axis::tight(TIME), Axis::linear(y)).sized(520, 270);
        chart.mark(flexible.move_time(), STOP)
    };
    let line = |points: Vec<(f64, f64)>| Series::line("", points).colour(Colour::Blue);
    let torque = |run: &Run| column(run, |row| 1e3 * row.torque_nm);
    let charts = [
        chart("Hub angle", "angle, rad").with(line(column(flexible, |row| row.hub_angle_rad))),
        chart("Hub rate", "rate, rad/s").with(line(column(flexible, |row| row.hub_rate_rad_s))),
        chart("Hub acceleration", "acceleration, rad/s\u{b2}")
            .with(line(column(flexible, |row| row.hub_accel_rad_s2))),
        chart("Hub torque", "torque, mN\u{a0}m")
            .with(Series::line("flexible link", torque(flexible)).colour(Colour::Blue))
            .with(
                Series::line("rigid link", torque(rigid))
                    .colour(Colour::Vermilion)
                    .dash(Dash::Dashed),
            ),
        chart("Deflection", "deflection, mm").with(line(millimetres(flexible.deflection()))),
        chart("Tip X", TIP_X).with(line(flexible.tip_x())),
    ];
    let peak = |run| fixed(1e3 * Setpoints::peak_torque(run), 1);
    let caption = html! {
        strong { "What a controller receives every 10 ms: where the hub shall be, the torque that \
                  takes it there, and where the tip then is." }
        " Member B with 30 g, \u{3c0} rad in 2 s, 2 s of rest, undamped, "
        (flexible.solver.describe()) ", as on the target. A rigid model asks for a torque that \
         falls evenly from " (peak(rigid)) " mN m to its opposite; the flexible link needs up to "
        (peak(flexible)) " mN m, at other times, and a little after the move to hold the hub \
         against what still swings. A cubic\u{2019}s acceleration jumps at both ends and a rigid \
         link\u{2019}s torque with it; the flexible link\u{2019}s hardly does, as the hub has no inertia \
         here. The fine ripple on the torque is the element\u{2019}s second mode. The row at the end \
         of the move holds the values just before the jump."
    };
    let body = html! { (figure(&charts, &caption, "setpoints.csv")?) };
    Ok(Section { id: "setpoints", title: "Feed-forward setpoints of one move", body })
}

fn column(run: &Run, of: fn(&Row) -> f64) -> Vec<(f64, f64)> {
    run.rows.iter().map(|row| (row.t_s, of(row))).collect()
}
