//! Pieces of a page: figures, tables, numbers.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::error::Error;
use crate::plot::Chart;

/// A whole page that needs nothing but itself.
pub fn page(title: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body { (body) }
        }
    };
    page.into_string()
}

/// Charts side by side where the page is wide enough, and what to see in them.
pub fn figure(charts: &[Chart], caption: &Markup, data: &str) -> Result<Markup, Error> {
    let pictures = charts.iter().map(Chart::svg).collect::<Result<Vec<_>, _>>()?;
    Ok(html! {
        figure {
            div class=(if pictures.len() > 1 { "charts two" } else { "charts" }) {
                @for picture in &pictures { (PreEscaped(picture)) }
            }
            figcaption { (caption) " Data: " a href=(data) { (data) } "." }
        }
    })
}

/// A table of numbers, right-aligned but for the first column.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// What it shows.
    pub caption: String,
    /// Column names with units.
    pub header: Vec<&'static str>,
    /// Cells.
    pub rows: Vec<Vec<String>>,
    /// The row to point out, if any.
    pub key: Option<usize>,
}

impl Table {
    /// As HTML.
    pub fn markup(&self) -> Markup {
        html! {
            div.scroll {
                p.caption { (self.caption) }
                table aria-label=(self.caption) {
                    thead { tr { @for name in &self.header { th scope="col" { (name) } } } }
                    tbody {
                        @for (index, row) in self.rows.iter().enumerate() {
                            tr.key[self.key == Some(index)] {
                                @for cell in row { td { (cell) } }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Seconds as milliseconds with that many decimals, no unit.
pub fn ms(seconds: f64, decimals: usize) -> String {
    fixed(1e3 * seconds, decimals)
}

/// A fraction as a percentage with that many decimals, with its sign.
pub fn percent(fraction: f64, decimals: usize) -> String {
    format!("{}\u{a0}%", fixed(1e2 * fraction, decimals))
}

/// A number with that many decimals.
pub fn fixed(value: f64, decimals: usize) -> String {
    format!("{value:.decimals$}").replace('-', "\u{2212}")
}

/// Metres over time to millimetres over time.
pub fn millimetres(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.into_iter().map(|(t, x)| (t, 1e3 * x)).collect()
}
