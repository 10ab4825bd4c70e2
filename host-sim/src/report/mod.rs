//! The study as one HTML page that needs nothing but itself.

mod figures;
mod findings;
pub mod parts;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::error::Error;
use crate::study::Study;

/// A chapter of the page.
struct Section {
    id: &'static str,
    title: &'static str,
    body: Markup,
}

/// The whole page. The same study gives the same text, byte for byte.
pub fn render(study: &Study) -> Result<String, Error> {
    let sections = [
        findings::link_mass(study),
        figures::tip_path(study)?,
        figures::elements(study)?,
        figures::steps(study)?,
        figures::members(study)?,
        figures::profiles(study)?,
        figures::setpoints(study)?,
    ];
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Stillbeam: the paper's study" }
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body {
                header { (findings::head(study)) }
                nav aria-label="Contents" {
                    ol { @for section in &sections {
                        li { a href={ "#" (section.id) } { (section.title) } }
                    } }
                }
                main {
                    (findings::in_short(study))
                    @for section in &sections {
                        section id=(section.id) { h2 { (section.title) } (section.body) }
                    }
                }
            }
        }
    };
    Ok(page.into_string())
}
