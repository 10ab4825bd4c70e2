//! The figures: charts, captions and tables.

use maud::html;

use super::Section;
use super::parts::{Table, figure, fixed, ms, percent};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Marker, Series};
use crate::study::elements::{Mesh, Variant};
use crate::study::members::{DAMPING, Member, Outcome};
use crate::study::setpoints::Setpoints;
use crate::study::{Run, Study};
use crate::table::Row;

const TIME: &str = "time, s";
const TIP_X: &str = "tip X, m";
/// What stands over the line that ends a move.
const STOP: &str = "hub stops";

/// Fig. 1.
pub(super) fn tip_path(study: &Study) -> Result<Section, Error> {
    let TipPathRuns { rigid, flexible } = TipPathRuns::of(study);
    let path = |run: &Run| run.rows.iter().map(|row| (row.tip_x_m, row.tip_y_m)).collect();
    let instants = |path: &Vec<(f64, f64)>| path.iter().copied().step_by(50).collect::<Vec<_>>();
    let (stiff, bent): (Vec<_>, Vec<_>) = (path(rigid), path(flexible));
    let chart =
        Chart::new("Fig. 1  Path of the tip", Axis::linear(TIP_X), Axis::linear("tip Y, m"))
            .sized(900, 580)
            .equal_scales()
            .with(Series::line("rigid link", stiff.clone()).colour(Colour::Ink).dash(Dash::Dashed))
            .with(Series::line("flexible link", bent.clone()).colour(Colour::Vermilion))
            .with(Series::scatter("every 20 ms, rigid", instants(&stiff)).colour(Colour::Ink))
            .with(
                Series::scatter("every 20 ms, flexible", instants(&bent))
                    .colour(Colour::Vermilion)
                    .marker(Marker::Ring),
            );
    let overshoot = study.tip_path.flexible.residual()?;
    let caption = html! {
        strong { "The flexible tip lags, overshoots and goes on swinging." }
        " Member D bare, \u{3c0} rad in 0.2 s (from right to left), 0.2 s of rest, undamped, "
        (flexible.solver.describe()) ". Peak deflection " (percent(flexible.peak(), 0))
        " of L, residual " (percent(overshoot, 0)) " of L. The curve leaves the circle because a \
         bent link is also a shorter one."
    };
    let body = html! { (figure(&[chart], &caption, "fig1-tip-path.csv")?) };
    Ok(Section { id: "fig1", title: "Fig. 1: rigid and flexible tip path", body })
}

struct TipPathRuns<'a> {
    rigid: &'a Run,
    flexible: &'a Run,
}

impl<'a> TipPathRuns<'a> {
    fn of(study: &'a Study) -> Self {
        Self { rigid: &study.tip_path.rigid, flexible: &study.tip_path.flexible }
    }
}

/// Fig. 2.
pub(super) fn elements(study: &Study) -> Result<Section, Error> {
    let meshes = &study.elements.meshes;
    let styles = [Dash::Dashed, Dash::Dotted, Dash::Solid, Dash::Solid];
    let colours = [Colour::Vermilion, Colour::Blue, Colour::Green, Colour::Ink];
    let chart = |title: &str, of: fn(&Mesh) -> &Variant| {
        let curve = |(index, mesh): (usize, &Mesh)| {
            let plural = if mesh.elements == 1 { "" } else { "s" };
            let label = format!("{} element{plural}", mesh.elements);
            Series::line(label, of(mesh).run.tip_x()).colour(colours[index]).dash(styles[index])
        };
        Chart::new(title, Axis::tight(TIME), Axis::linear(TIP_X).limits(-0.5, 0.5))
            .mark(meshes[0].lumped.run.move_time(), STOP)
            .with_all(meshes.iter().enumerate().map(curve))
    };
    let charts = [
        chart("Fig. 2(a)  Lumped mass", |mesh| &mesh.lumped),
        chart("Fig. 2(b)  Consistent mass", |mesh| &mesh.consistent),
    ];
    let caption = html! {
        strong { "With consistent mass one element already follows the converged curve; with \
                  lumped mass it does not even keep time." }
        " Tip X of member D bare, \u{3c0} rad in 0.2 s, 0.2 s of rest, undamped, newmark, 0.4 ms, \
         f64."
    };
    let row = |mesh: &Mesh| {
        vec![
            mesh.elements.to_string(),
            ms(mesh.lumped.period, 2),
            ms(mesh.consistent.period, 2),
            ms(mesh.lumped.read, 1),
            ms(mesh.consistent.read, 1),
        ]
    };
    let table = Table {
        caption: format!(
            "First period of member D. The continuous beam: {} ms. The paper: 99.8 ms in theory, \
             99.2 ms read from its curve.",
            ms(study.elements.theory, 2)
        ),
        header: vec![
            "Elements",
            "Lumped, ms",
            "Consistent, ms",
            "Lumped, read from the curve, ms",
            "Consistent, read from the curve, ms",
        ],
        rows: meshes.iter().map(row).collect(),
        key: Some(0),
    };
    let body = html! {
        (figure(&charts, &caption, "fig2-elements.csv")?)
        (table.markup())
        p.soft {
            "The first two columns of periods solve the eigenvalue problem ("
            a href="fig2-periods.csv" { "fig2-periods.csv" }
            "); the last two are twice the mean time between zeros of the deflection in the rest, \
             which holds barely two periods and some of the higher modes."
        }
    };
    Ok(Section { id: "fig2", title: "Fig. 2: number of elements and mass matrix", body })
}

/// Fig. 5.
pub(super) fn steps(study: &Study) -> Result<Section, Error> {
    let steps = &study.steps;
    let finest = format!("{} ms", ms(steps.finest.solver.tick, 1));
    let shown = [
        (0.01, Colour::Vermilion, Dash::Dashed),
        (0.02, Colour::Blue, Dash::Dotted),
        (0.05, Colour::Green, Dash::Solid),
        (0.1, Colour::Purple, Dash::Solid),
    ];
    let curves = shown.into_iter().filter_map(|(tick, colour, dash)| {
        let step = steps.steps.iter().find(|step| step.run.solver.tick == tick)?;
        let label = format!("{} ms", ms(tick, 0));
        Some(Series::line(label, step.run.tip_x()).colour(colour).dash(dash))
    });
    let time = Chart::new("Fig. 5  Tip X over time", Axis::tight(TIME), Axis::linear(TIP_X))
        .sized(560, 400)
        .mark(steps.finest.move_time(), STOP)
        .with(Series::line(finest, steps.finest_tip_x()).colour(Colour::Ink))
        .with_all(curves);
    let points = |of: fn(&crate::study::steps::Step) -> f64| -> Vec<(f64, f64)> {
        steps.steps.iter().map(|step| (1e3 * step.run.solver.tick, 1e2 * of(step))).collect()
    };
    let order = Chart::new(
        "Error over the step",
        Axis::log("step, ms"),
        Axis::log("tip error against 0.1 ms, % of L"),
    )
    .sized(560, 400)
    .with(Series::line("largest", points(|step| step.tip_max)).marker(Marker::Dot))
    .with(
        Series::line("root mean square", points(|step| step.tip_rms))
            .marker(Marker::Ring)
            .dash(Dash::Dashed),
    );
    let caption = html! {
        strong { "At 10 ms amplitude and period have converged, as the paper finds; from 50 ms on \
                  the swing runs late." }
        " Member A with 30 g, \u{3c0} rad in 2 s, 2 s of rest, undamped, newmark, 1 consistent \
         element, f64. Left: steps of 1, 2 and 5 ms would lie on the black curve. Right: a \
         tenth of the step is a hundredth of the error, second order."
    };
    let row = |step: &crate::study::steps::Step| {
        vec![
            ms(step.run.solver.tick, 0),
            percent(step.tip_max, 4),
            percent(step.tip_rms, 4),
            percent(step.residual, 2),
        ]
    };
    let table = Table {
        caption: format!(
            "Distance of the tip from the run at {} ms, whose residual is {} of L. All in % of L.",
            ms(steps.finest.solver.tick, 1),
            percent(steps.finest_residual, 2),
        ),
        header: vec!["Step, ms", "Largest", "Root mean square", "Residual"],
        rows: steps.steps.iter().map(row).collect(),
        key: steps.steps.iter().position(|step| step.run.solver.tick == 0.01),
    };
    let body = html! {
        (figure(&[time, order], &caption, "fig5-steps.csv")?)
        (table.markup())
        p.soft { "The same numbers: " a href="fig5-errors.csv" { "fig5-errors.csv" } "." }
    };
    Ok(Section { id: "fig5", title: "Fig. 5: length of the time step", body })
}

/// Fig. 6.
pub(super) fn members(study: &Study) -> Result<Section, Error> {
    let members = &study.members.members;
    let damping = format!("\u{3b1} = {} 1/s, \u{3b2} = {} s", DAMPING.alpha, DAMPING.beta);
    let chart = |(index, member): (usize, &Member)| {
        let letter = char::from(b'a' + index as u8);
        let title = format!("Fig. 6({letter})  Member {}, {}, 30 g", member.name, member.material);
        Chart::new(title, Axis::tight(TIME), Axis::linear(TIP_X).limits(-0.45, 0.45))
            .mark(member.undamped.run.move_time(), STOP)
            .with(Series::line("undamped", member.undamped.run.tip_x()).colour(Colour::Blue))
            .with(
                Series::line(format!("damped ({damping})"), member.damped.run.tip_x())
                    .colour(Colour::Vermilion)
                    .dash(Dash::Dashed),
            )
    };
    let charts: Vec<_> = members.iter().enumerate().map(chart).collect();
    let swing = |(index, member): (usize, &Member)| {
        let letter = char::from(b'a' + index as u8);
        let title = format!("Deflection, member {} ({letter})", member.name);
        let curve = |outcome: &Outcome| {
            outcome.run.rows.iter().map(|row| (row.t_s, 1e3 * row.deflection_m)).collect::<Vec<_>>()
        };
        Chart::new(title, Axis::tight(TIME), Axis::linear("deflection, mm"))
            .sized(520, 280)
            .mark(member.undamped.run.move_time(), STOP)
            .with(Series::line("undamped", curve(&member.undamped)).colour(Colour::Blue))
            .with(
                Series::line("damped", curve(&member.damped))
                    .colour(Colour::Vermilion)
                    .dash(Dash::Dashed),
            )
    };
    let swings: Vec<_> = members.iter().enumerate().map(swing).collect();
    let caption = html! {
        strong { "Member B, undamped, hardly moves once the hub has stopped; A and C go on \
                  swinging." }
        " \u{3c0} rad in 2 s, 2 s of rest, " (members[0].undamped.run.solver.describe())
        ". Dashed: " (damping) ", an illustration, since the paper fits its damping to its \
         experiments and does not print it."
    };
    let swing_caption = html! {
        strong { "The same runs seen from the hub." }
        " Sideways deflection of the tip. Member B\u{2019}s last half swing ends when the hub does; \
         damping shifts it out of step."
    };
    let row = |member: &Member| {
        let link = member.undamped.run.scene.arm.link;
        let half = |outcome: &Outcome| {
            [percent(outcome.peak, 2), percent(outcome.residual, 2), fixed(outcome.ratio(), 3)]
        };
        [
            format!("{} ({})", member.name, member.material),
            fixed(1e3 * link.mass, 2),
            fixed(link.bending_stiffness, 4),
            fixed(member.period, 4),
            fixed(member.ratio(), 3),
        ]
        .into_iter()
        .chain(half(&member.undamped))
        .chain(half(&member.damped))
        .collect()
    };
    let table = Table {
        caption: "Members with 30 g at the tip. Period: eight consistent elements. Deflections in \
                  % of L; ratio: residual over peak. Damped: illustrative values."
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
    let body = html! {
        (figure(&charts, &caption, "fig6-members.csv")?)
        (table.markup())
        (figure(&swings, &swing_caption, "fig6-summary.csv")?)
        @if let Some(quiet) = study.members.quiet() {
            p {
                "Why damping makes it worse: without damping member B arrives almost still by an \
                 accident of timing, the next section shows which. Damping breaks the symmetry of \
                 the swing during the move, so that the two halves no longer cancel, and the \
                 residual rises from " (percent(quiet.undamped.residual, 2)) " to "
                (percent(quiet.damped.residual, 2)) " of L. The paper reports the same."
            }
        }
    };
    Ok(Section { id: "fig6", title: "Fig. 6: members A to D with 30 g", body })
}

/// Why cubic.
pub(super) fn profiles(study: &Study) -> Result<Section, Error> {
    let profiles = &study.profiles;
    let styles = [
        (Colour::Vermilion, Dash::Solid, 3),
        (Colour::Blue, Dash::Dashed, 2),
        (Colour::Green, Dash::Dotted, 2),
        (Colour::Purple, Dash::Solid, 2),
        (Colour::Sky, Dash::Dashed, 2),
    ];
    let curve = |(curve, (colour, dash, width)): (&crate::study::profiles::Curve, _)| {
        let points = curve.points.iter().map(|&(x, y)| (x, 1e2 * y));
        Series::line(curve.profile.name(), points).colour(colour).dash(dash).width(width)
    };
    let chart = Chart::new(
        "Residual of member B with 30 g over the duration of the move",
        Axis::tight("duration of the move, first periods"),
        Axis::linear("residual, % of L").limits(0.0, 40.0),
    )
    .sized(900, 400)
    .mark(profiles.paper, "the paper\u{2019}s 2 s")
    .with_all(profiles.curves.iter().zip(styles).map(curve));
    let [first, second, third] = profiles.cubic_zeros.map(|zero| fixed(zero, 3));
    let caption = html! {
        strong { "At the paper\u{2019}s duration only the cubic is near a zero." }
        " \u{3c0} rad, undamped, " (profiles.solver.describe()) ". Residuals beyond 30 % of L are \
         outside what a small-deflection model can say."
    };
    let row = |curve: &crate::study::profiles::Curve| {
        vec![curve.profile.name().to_owned(), percent(curve.at_paper, 2)]
    };
    let table = Table {
        caption: "Residual of member B after the paper\u{2019}s 2 s, % of L".into(),
        header: vec!["Profile", "Residual"],
        rows: profiles.curves.iter().map(row).collect(),
        key: Some(0),
    };
    let body = html! {
        p {
            "The paper does not print the angle it commands, only that member B with 30 g hardly \
             vibrates after its 2 s. A cubic, \u{3b8} = \u{3c0}(3s\u{b2} \u{2212} 2s\u{b3}), \
             leaves a linear oscillator at rest where tan x = x, x = \u{3c0}T/T\u{2081}: at T/T\u{2081} = "
            (first) ", " (second) ", " (third) ", and so on. Member B\u{2019}s ratio is "
            (fixed(profiles.paper, 3)) ", next to the second. The other usual profiles leave more \
             there, so the cubic is what every scene of this study uses."
        }
        (figure(&[chart], &caption, "profiles.csv")?)
        (table.markup())
    };
    Ok(Section { id: "profiles", title: "Why the move is a cubic", body })
}

/// Setpoints.
pub(super) fn setpoints(study: &Study) -> Result<Section, Error> {
    let Setpoints { flexible, rigid } = &study.setpoints;
    let column = |run: &Run, of: fn(&Row) -> f64| -> Vec<(f64, f64)> {
        run.rows.iter().map(|row| (row.t_s, of(row))).collect()
    };
    let chart = |title: &str, unit: &str, of: fn(&Row) -> f64| {
        Chart::new(title, Axis::tight(TIME), Axis::linear(unit))
            .sized(520, 260)
            .mark(flexible.move_time(), STOP)
            .with(Series::line("", column(flexible, of)))
    };
    let torque: fn(&Row) -> f64 = |row| 1e3 * row.torque_nm;
    let charts = [
        chart("Hub angle", "angle, rad", |row| row.hub_angle_rad),
        chart("Hub rate", "rate, rad/s", |row| row.hub_rate_rad_s),
        chart("Hub acceleration", "acceleration, rad/s\u{b2}", |row| row.hub_accel_rad_s2),
        chart("Tip deflection in the hub frame", "deflection, mm", |row| 1e3 * row.deflection_m),
        Chart::new("Hub torque", Axis::tight(TIME), Axis::linear("torque, mN m"))
            .sized(520, 280)
            .mark(flexible.move_time(), STOP)
            .with(Series::line("flexible link", column(flexible, torque)))
            .with(
                Series::line("rigid link", column(rigid, torque))
                    .colour(Colour::Ink)
                    .dash(Dash::Dashed),
            ),
        chart("Tip X", TIP_X, |row| row.tip_x_m),
    ];
    let caption = html! {
        strong { "What a controller receives, every 10 ms." }
        " Member B with 30 g, \u{3c0} rad in 2 s, 2 s of rest, undamped, "
        (flexible.solver.describe()) ". The torque a rigid model asks for is a ramp from "
        (fixed(1e3 * Setpoints::peak_torque(rigid), 1)) " mN m down to its opposite; the flexible \
         link needs up to " (fixed(1e3 * Setpoints::peak_torque(flexible), 1)) " mN m at other \
         times, and a little afterwards to hold the hub against what still swings. A cubic\u{2019}s \
         acceleration jumps at both ends, and the torque with it; at the end of the move the table \
         has the left-hand values."
    };
    let body = html! { (figure(&charts, &caption, "setpoints.csv")?) };
    Ok(Section { id: "setpoints", title: "Feed-forward setpoints of one move", body })
}
