//! The runs of the study, the findings in short, and contradictions in the paper's data.

use maud::{Markup, html};

use super::Section;
use super::parts::{Table, fixed, ms};
use crate::study::link_mass::{PAPER_READ, PAPER_THEORY, Reading};
use crate::study::{Run, Study};

/// Writes the title and the conditions.
pub(super) fn head(study: &Study) -> Markup {
    let row = |what: &str, scene: &str, run: &Run| {
        vec![what.to_owned(), scene.to_owned(), run.solver.describe()]
    };
    let elements = Run::clone(&study.elements.meshes[0].consistent.run);
    let member = &study.members.members[0].undamped.run;
    let mut rows = vec![
        row("Fig. 1", "d-fast", &study.tip_path.flexible),
        row("Fig. 2", "d-fast", &elements),
        row("Fig. 5", "a-tip30", &study.steps.finest),
        row("Fig. 6", "a-tip30 to d-tip30", member),
        vec!["Profiles".into(), "b-tip30, other durations".into(), String::new()],
        row("Setpoints", "b-tip30", &study.setpoints.flexible),
    ];
    rows[1][2] =
        rows[1][2].replace("1 consistent element", "1 to 8 elements, lumped and consistent");
    rows[2][2] = rows[2][2].replace("0.1 ms", "0.1 to 100 ms");
    rows[4][2] = study.profiles.solver.describe();
    html! {
        h1 { "Stillbeam: the paper\u{2019}s study" }
        p.lead {
            "A motor turns a slender link; the link bends, lags and swings. Stillbeam computes, in \
             the control cycle, where the tip will be and which torque the motor needs. This page \
             repeats the numerical runs of "
            cite { "A. Kato and D. Isobe, \u{201c}Calculating Trajectories for Flexible \
                    Manipulators by Using Finite Element Method\u{201d}" }
            " (in Japanese) and numbers its figures as the paper does. Figures 3 and 4 \
             show the rig; the curves measured on it are not reproduced."
        }
        div.scroll {
            p.caption {
                "What was run: stillbeam-sim " (env!("CARGO_PKG_VERSION")) ". Every move is a \
                 cubic over \u{3c0} rad in a horizontal plane, but for those that the profiles \
                 are compared by. Hub radius 0: the paper\u{2019}s rig clamps its links at some \
                 distance from the motor\u{2019}s axis, which its text does not give. All curves \
                 are computed; none is measured."
            }
            table.words {
                thead { tr { th { "Part" } th { "Scene" } th { "Solver" } } }
                tbody { @for row in &rows { tr { @for cell in row { td { (cell) } } } } }
            }
        }
        p.soft {
            "Newmark is the paper\u{2019}s scheme (\u{3b4} = 1/2, \u{3b2} = 1/4) on cubic beam \
             elements, small deflections with centrifugal stiffening and foreshortening; \
             f32 is the precision on the target. L is the link\u{2019}s length, 0.4 m. \
             Peak deflection: the largest sideways distance of the tip from the line along the \
             hub. Residual: the same after the hub has stopped."
        }
    }
}

/// Lists the findings, a line each.
pub(super) fn in_short(study: &Study) -> Markup {
    let lines = study.findings();
    html! { section { h2 { "In short" } ul { @for line in &lines { li { (line) } } } } }
}

/// Writes the section on the link mass that contradicts the paper's period.
pub(super) fn link_mass(study: &Study) -> Section {
    let found = &study.link_mass;
    let row = |name: &str, reading: &Reading| {
        vec![
            name.to_owned(),
            fixed(reading.link.mass, 4),
            fixed(reading.link.bending_stiffness, 3),
            ms(reading.period, 2),
        ]
    };
    let table = Table {
        caption: "First period of the bare link, 0.4 m, by eight consistent elements".into(),
        header: vec!["Reading", "Mass, kg", "EI, N\u{a0}m\u{b2}", "Period, ms"],
        rows: vec![
            row("As section 3 prints it", &found.printed),
            row("Table 1(d): 69 GPa \u{d7} 1.333e\u{2212}11 m\u{2074}", &found.table),
            row("Member D with section 3\u{2019}s EI: used here", &found.used),
        ],
        key: Some(2),
    };
    let body = html! {
        aside {
            h3 {
                "The paper prints 0.215 kg; its own period says 0.0224 kg"
            }
            p {
                "Section 3 gives its link as 0.4 m, " (found.printed.link.mass) " kg, EI = "
                (found.printed.link.bending_stiffness) " N\u{a0}m\u{b2}, and a theoretical bending \
                 period of " (ms(PAPER_THEORY, 1)) " ms. These do not agree: such a link swings \
                 with " (ms(found.printed.period, 1)) " ms, more than three times as slowly. With "
                (found.used.link.mass) " kg, the mass of the paper\u{2019}s aluminium member D in \
                 its table 1(d), the same stiffness gives " (ms(found.used.period, 2)) " ms. The \
                 printed mass must be a slip, and this study uses " (found.used.link.mass)
                " kg wherever it repeats section 3."
            }
            p {
                "Table 1(d) has a slip of its own: it repeats member B\u{2019}s second moment of \
                 area, 1.333e\u{2212}11 m\u{2074}, with which the period would be "
                (ms(found.table.period, 1)) " ms. A strip of 10 mm \u{d7} 2 mm has \
                 6.667e\u{2212}12 m\u{2074}, and times 69 GPa that is section 3\u{2019}s EI = 0.46."
            }
        }
        (table.markup())
        p {
            "The " (ms(PAPER_READ, 1)) " ms that the paper reads from its curve are 248 of its \
             steps of 0.4 ms; the closed formula for the continuous beam gives "
            (ms(study.elements.theory, 2)) " ms."
        }
    };
    Section { id: "link-mass", title: "The link mass in section 3", body }
}
