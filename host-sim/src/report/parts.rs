//! Pieces of a page: figures, tables, numbers.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::animation;
use crate::error::Error;
use crate::number::{self, Digits};
use crate::plot::Chart;

/// Returns a whole self-contained page, with the script of the animations if it holds any.
pub fn page(title: &str, body: &Markup) -> String {
    let is_moving = body.0.contains(&format!("<figure class=\"{}\"", animation::CLASS));
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(include_str!("style.css"))) }
            }
            body {
                (body)
                @if is_moving { script { (PreEscaped(animation::CONTROL)) } }
            }
        }
    };
    page.into_string()
}

/// Returns charts side by side where the page is wide enough, with a caption.
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

/// A table of numbers, right-aligned except for the first column.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Caption of the table.
    pub caption: String,
    /// Column names with units.
    pub header: Vec<&'static str>,
    /// Cells.
    pub rows: Vec<Vec<String>>,
    /// Row to highlight, if any.
    pub key: Option<usize>,
}

impl Table {
    /// Returns the table as HTML.
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

/// Formats seconds as milliseconds with that many decimals, no unit.
pub fn ms(seconds: f64, decimals: usize) -> String {
    fixed(1e3 * seconds, decimals)
}

/// Formats a fraction as a percentage with that many decimals, with its sign.
pub fn percent(fraction: f64, decimals: usize) -> String {
    typeset(&number::percent(fraction, 1.0, Digits::Decimals(decimals)))
}

/// Formats a number with that many decimals.
pub fn fixed(value: f64, decimals: usize) -> String {
    typeset(&Digits::Decimals(decimals).show(value))
}

/// Returns a number with a true minus, and its unit on the same line.
fn typeset(number: &str) -> String {
    number.replace('-', "\u{2212}").replace(' ', "\u{a0}")
}

/// Converts metres over time to millimetres over time.
pub fn millimetres(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.into_iter().map(|(t, x)| (t, 1e3 * x)).collect()
}
