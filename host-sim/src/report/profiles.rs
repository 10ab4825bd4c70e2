//! The evidence that the paper's move is a cubic.

use maud::html;

use super::Section;
use super::parts::{Table, figure, fixed};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::study::Study;
use crate::study::profiles::Curve;

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let profiles = &study.profiles;
    let styles = [
        (Colour::Vermilion, Dash::Solid, 3),
        (Colour::Blue, Dash::Dashed, 2),
        (Colour::Green, Dash::Dotted, 2),
        (Colour::Purple, Dash::Solid, 2),
        (Colour::Sky, Dash::Dashed, 2),
    ];
    let curve = |(curve, (colour, dash, width)): (&Curve, _)| {
        let points = curve.points.iter().map(|&(x, y)| (x, 1e2 * y));
        Series::line(curve.profile.name(), points).colour(colour).dash(dash).width(width)
    };
    let chart = Chart::new(
        "Residual of member B with 30 g over the duration of the move",
        Axis::tight("duration of the move, first periods"),
        Axis::linear("residual, % of L").limits(0.0, 30.0),
    )
    .sized(900, 420)
    .mark(profiles.paper, "the paper\u{2019}s 2 s")
    .with_all(profiles.curves.iter().zip(styles).map(curve));
    let caption = html! {
        strong { "At the paper\u{2019}s duration only the cubic is near a zero." }
        " \u{3c0} rad, undamped, 2 s of rest, " (profiles.solver.describe()) ". Cut at 30 % of L, \
         beyond which a small-deflection model is a guess."
    };
    let table = Table {
        caption: "Residual of member B with 30 g after \u{3c0} rad in the paper\u{2019}s 2 s"
            .into(),
        header: vec!["Profile", "Residual, % of L"],
        rows: profiles
            .curves
            .iter()
            .map(|curve| vec![curve.profile.name().to_owned(), fixed(1e2 * curve.at_paper, 2)])
            .collect(),
        key: Some(0),
    };
    let [first, second, third] = profiles.cubic_zeros.map(|zero| fixed(zero, 3));
    let body = html! {
        p {
            "The paper does not print the angle it commands, only that member B with 30 g hardly \
             vibrates after its 2 s. A cubic, \u{3b8} = \u{3c0}(3s\u{b2} \u{2212} 2s\u{b3}) with \
             s = t/T, leaves a linear oscillator of period T\u{2081} at rest where tan x = x, \
             x = \u{3c0}T/T\u{2081}: at T/T\u{2081} = " (first) ", " (second) ", " (third)
            " and so on. Member B\u{2019}s ratio is " (fixed(profiles.paper, 3)) ", next to the \
             second. The other usual profiles leave at least " (fixed(study.profiles.margin(), 0))
            " times as much there, so the cubic is what the scenes of this study use."
        }
        (figure(&[chart], &caption, "profiles.csv")?)
        (table.markup())
    };
    Ok(Section { id: "profiles", title: "Why the move is a cubic", body })
}
