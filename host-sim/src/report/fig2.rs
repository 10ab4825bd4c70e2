//! Fig. 2: number of elements and mass matrix.

use maud::html;

use super::parts::{Table, figure, millimetres, ms};
use super::{STOP, Section, TIME, TIP_X};
use crate::error::Error;
use crate::plot::{Axis, Chart, Colour, Dash, Series};
use crate::study::elements::{Mesh, Variant};
use crate::study::{Run, Study};

/// The section.
pub(super) fn section(study: &Study) -> Result<Section, Error> {
    let meshes = &study.elements.meshes;
    let lumped: fn(&Mesh) -> &Variant = |mesh| &mesh.lumped;
    let consistent: fn(&Mesh) -> &Variant = |mesh| &mesh.consistent;
    let tip_x = |title: &str, of| {
        let y = Axis::linear(TIP_X).limits(-0.5, 0.5);
        curves(Chart::new(title, Axis::tight(TIME), y), meshes, of, Run::tip_x)
    };
    let deflection = |title: &str, of| {
        let y = Axis::linear("deflection, mm").limits(-160.0, 160.0);
        let chart = Chart::new(title, Axis::tight(TIME), y);
        curves(chart, meshes, of, |run| millimetres(run.deflection()))
    };
    let charts = [
        tip_x("Fig. 2(a): tip X, lumped mass", lumped),
        tip_x("Fig. 2(b): tip X, consistent mass", consistent),
        deflection("Deflection, lumped mass", lumped),
        deflection("Deflection, consistent mass", consistent),
    ];
    let caption = html! {
        strong { "With consistent mass one element already follows the converged curve; with \
                  lumped mass it does not even keep time." }
        " Member D bare, \u{3c0} rad in 0.2 s, 0.2 s of rest, undamped, newmark, 0.4 ms, f64. The \
         paper shows tip X; as the move ends with the link along X, the swing after it stands out \
         better in the lower row, the sideways deflection seen from the hub."
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
            "Lumped, from the curve, ms",
            "Consistent, from the curve, ms",
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
            "). The last two are twice the mean time between zeros of the deflection in the rest, \
             the way one reads a plot."
        }
    };
    Ok(Section { id: "fig2", title: "Fig. 2: number of elements and mass matrix", body })
}

/// Adds a curve for each mesh, the finest broad and below the others.
fn curves(
    chart: Chart,
    meshes: &[Mesh],
    of: fn(&Mesh) -> &Variant,
    values: fn(&Run) -> Vec<(f64, f64)>,
) -> Chart {
    let styles = [
        (Colour::Vermilion, Dash::Dashed, 2),
        (Colour::Blue, Dash::Dotted, 2),
        (Colour::Ink, Dash::Solid, 1),
        (Colour::Sky, Dash::Solid, 6),
    ];
    let curve = |(mesh, (colour, dash, width)): (&Mesh, _)| {
        let plural = if mesh.elements == 1 { "" } else { "s" };
        let label = format!("{} element{plural}", mesh.elements);
        Series::line(label, values(&of(mesh).run)).colour(colour).dash(dash).width(width)
    };
    let stop = meshes.first().map_or(0.0, |mesh| mesh.lumped.run.move_time());
    chart.mark(stop, STOP).with_all(meshes.iter().zip(styles).rev().map(curve))
}
