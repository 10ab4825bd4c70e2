//! The study as one self-contained HTML page.

mod fig1;
mod fig2;
mod fig5;
mod fig6;
mod findings;
mod mechanisms;
pub mod parts;
mod profiles;
mod setpoints;
mod stillness;

use maud::{Markup, html};

use crate::error::Error;
use crate::report::parts::page;
use crate::study::Study;

/// Labels that several figures share.
const TIME: &str = "time, s";
const TIP_X: &str = "tip X, m";
/// Label over the line that ends a move.
const STOP: &str = "hub stops";

/// A chapter of the page.
struct Section {
    id: &'static str,
    title: &'static str,
    body: Markup,
}

/// Renders the whole page. The same study gives the same text, byte for byte.
pub fn render(study: &Study) -> Result<String, Error> {
    let sections = [
        findings::link_mass(study),
        fig1::section(study)?,
        fig2::section(study)?,
        fig5::section(study)?,
        fig6::section(study)?,
        profiles::section(study)?,
        setpoints::section(study)?,
        stillness::section(study)?,
        mechanisms::section(study)?,
    ];
    let body = html! {
        header { (findings::head(study)) (findings::in_short(study)) }
        nav aria-label="Contents" {
            h2 { "Contents" }
            ol { @for section in &sections {
                li { a href={ "#" (section.id) } { (section.title) } }
            } }
        }
        main {
            @for section in &sections {
                section id=(section.id) { h2 { (section.title) } (section.body) }
            }
        }
    };
    Ok(page("Stillbeam: the paper's study", &body))
}
