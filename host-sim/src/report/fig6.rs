//! Fig. 6: the four members.

use maud::{Markup, html};

use super::parts::{Table, figure, fixed, millimetres, percent};
use super::{STOP, Section, TIME, TIP_X};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::study::members::{DAMPING, Member, Outcome};
use crate::study::{Run, Study};

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let members = &study.members.members;
    let each = |chart: fn(char, &Member) -> Chart| -> Vec<Chart> {
        ('a'..).zip(members).map(|(letter, member)| chart(letter, member)).collect()
    };
    let damping = format!("\u{3b1} = {} 1/s, \u{3b2} = {} s", DAMPING.alpha, DAMPING.beta);
    let solver = members.first().map(|member| member.undamped.run.solver.describe());
    let caption = html! {
        strong { "Tip X, the paper\u{2019}s quantity." }
        " 30 g at the tip, \u{3c0} rad in 2 s, 2 s of rest, " (solver.unwrap_or_default())
        ". Solid: undamped. Dashed: damped with " (damping) ". "
        strong { "These two values are an illustration:" }
        " the paper fits its damping to its experiments and does not print it."
    };
    let swing_caption = html! {
        strong { "The same runs seen from the hub: undamped, member B hardly moves once the hub \
                  has stopped; the others go on swinging." }
        " Sideways deflection of the tip, same curves as above, each with its own scale. At the \
         end of the move the link lies along X, so the swing shows here rather than in tip X."
    };
    let body = html! {
        (figure(&each(tip_x), &caption, "fig6-members.csv")?)
        (figure(&each(deflection), &swing_caption, "fig6-members.csv")?)
        (table(members))
        p.soft { "The same numbers: " a href="fig6-summary.csv" { "fig6-summary.csv" }
            ". A ratio of 1 says that the largest swing of all comes after the hub has stopped." }
        @if let Some(quiet) = study.members.quiet() { (why(quiet)) }
    };
    Ok(Section { id: "fig6", title: "Fig. 6: members A to D with 30 g", body })
}

fn tip_x(letter: char, member: &Member) -> Chart {
    let title = format!("Fig. 6({letter}): member {}, {}", member.name, member.material);
    let y = Axis::linear(TIP_X).limits(-0.45, 0.45);
    pair(Chart::new(title, Axis::tight(TIME), y).sized(520, 300), member, Run::tip_x)
}

fn deflection(_: char, member: &Member) -> Chart {
    let title = format!("Deflection, member {}, {}", member.name, member.material);
    let y = Axis::linear("deflection, mm");
    let chart = Chart::new(title, Axis::tight(TIME), y).sized(520, 300);
    pair(chart, member, |run| millimetres(run.deflection()))
}

fn pair(chart: Chart, member: &Member, values: fn(&Run) -> Vec<(f64, f64)>) -> Chart {
    let (undamped, damped) = (values(&member.undamped.run), values(&member.damped.run));
    chart
        .mark(member.undamped.run.move_time(), STOP)
        .with(Series::line("undamped", undamped).colour(Colour::Blue))
        .with(
            Series::line("damped (illustrative)", damped)
                .colour(Colour::Vermilion)
                .dash(Dash::Dashed),
        )
}

fn table(members: &[Member]) -> Markup {
    let row = |member: &Member| {
        let link = member.undamped.run.scene.arm.link;
        let end = |outcome: &Outcome| {
            [
                fixed(1e2 * outcome.peak, 2),
                fixed(1e2 * outcome.residual, 2),
                fixed(outcome.ratio(), 3),
            ]
        };
        [
            format!("{} ({})", member.name, member.material),
            fixed(1e3 * link.mass, 2),
            fixed(link.bending_stiffness, 4),
            fixed(member.period, 4),
            fixed(member.ratio(), 3),
        ]
        .into_iter()
        .chain(end(&member.undamped))
        .chain(end(&member.damped))
        .collect()
    };
    let table = Table {
        caption: "Members with 30 g at the tip. Period: eight consistent elements. Peak and \
                  residual deflection in % of L, their ratio; first undamped, then damped \
                  (illustrative)."
            .into(),
        header: vec![
            "Member",
            "Mass, g",
            "EI, N\u{a0}m\u{b2}",
            "Period, s",
            "2 s in periods",
            "Peak, undamped",
            "Residual",
            "Ratio",
            "Peak, damped",
            "Residual",
            "Ratio",
        ],
        rows: members.iter().map(row).collect(),
        key: members.iter().position(|member| member.name == 'B'),
    };
    table.markup()
}

fn why(quiet: &Member) -> Markup {
    html! {
        p {
            "Why damping makes it worse for member B: undamped, it arrives almost still by a \
             coincidence of timing. The swing that the first half of the move excites is undone by \
             the second half, its mirror image; " a href="#profiles" { "which duration does that" }
            " is shown next. Damping breaks the mirror, the halves no longer cancel, and the \
             residual rises from " (percent(quiet.undamped.residual, 2)) " to "
            (percent(quiet.damped.residual, 2)) " of L. The paper reports the same."
        }
    }
}
