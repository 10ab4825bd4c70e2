//! The maps as a page, pictures and a table.

use std::path::{Path, PathBuf};

use maud::{Markup, html};

use super::condition::{self, Loss};
use super::document::Findings;
use super::map::Map;
use super::rule::RULES;
use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::plot::{Axis, Chart, Dash, Series};
use stillbeam_sim::report::parts::{figure, page};
use stillbeam_sim::solver::ELEMENTS;

/// Name of the table beside the page.
const DATA: &str = "maps.csv";

/// Writes `index.html`, `maps.csv` and a picture for each map into a folder. Returns the page's
/// path.
pub fn write(folder: &Path, findings: &Findings) -> Result<PathBuf, Error> {
    let index = folder.join("index.html");
    let moving: Vec<Chart> = findings.moving().iter().map(moving_chart).collect();
    let spinning: Vec<Chart> = findings.spinning().iter().map(spinning_chart).collect();
    let rules = rule_charts();
    let conditions = vec![solution_chart(&fine_losses()?), product_chart(&findings.losses)];
    let text = render(&moving, &spinning, &rules, &conditions)?;
    let named = |maps: &[Map], what: &str, charts: &[Chart]| {
        let name = |map: &Map| format!("{what}-{}.svg", map.name);
        maps.iter().map(name).zip(charts.to_vec()).collect::<Vec<_>>()
    };
    let mut pictures = named(findings.moving(), "moves", &moving);
    pictures.extend(named(findings.spinning(), "spins", &spinning));
    pictures
        .extend(["rules-radius.svg", "rules-period.svg"].map(str::to_owned).into_iter().zip(rules));
    let names = ["condition-solution.svg", "condition-product.svg"].map(str::to_owned);
    pictures.extend(names.into_iter().zip(conditions));
    let mut files = Files::default();
    for (name, chart) in pictures {
        let svg = chart.svg()?;
        files.add(&folder.join(name), |file| file.write_all(svg.as_bytes()))?;
    }
    files.add(&folder.join(DATA), |file| {
        let mut csv = csv::Writer::from_writer(file);
        csv.write_record(["map", "solver", "x", "y", "verdict"])?;
        for (what, maps) in [("moves", findings.moving()), ("spins", findings.spinning())] {
            for map in maps {
                for (x, y, verdict) in &map.cells {
                    let numbers = [x, y].map(|x| format!("{x:.4e}"));
                    let [x, y] = &numbers;
                    csv.write_record([what, &map.title, x, y, verdict.name()])?;
                }
            }
        }
        csv.flush()
    })?;
    files.add(&index, |file| file.write_all(text.as_bytes()))?;
    files.finish()?;
    Ok(index)
}

/// Draws the picture of `docs/stability.md`: elastica with two modes, fast, over rates.
pub fn picture(findings: &Findings) -> Result<String, Error> {
    let elastica = findings.spinning().iter().find(|map| map.name == "elastica-2-fast");
    let elastica = elastica.ok_or_else(|| Error::new("maps: must hold elastica-2-fast"))?;
    spinning_chart(elastica).svg()
}

fn moving_chart(map: &Map) -> Chart {
    let x = Axis::log("first frequency, Hz").limits(0.07, 1.4e3);
    map.chart(x, Axis::log("tick, s").limits(7e-5, 1.4))
}

/// Draws a map over rates.
fn spinning_chart(map: &Map) -> Chart {
    let x = Axis::log("\u{3c9}\u{2081}h, rad").limits(0.008, 12.5);
    map.chart(x, Axis::linear("rate that is held, \u{3c9}\u{2081}").limits(-0.2, 5.2))
}

/// Draws the spectral radius and the period error of Newmark's rule.
fn rule_charts() -> Vec<Chart> {
    let turns: Vec<f64> = (0..=300).map(|k| 10f64.powf(-1.0 + f64::from(k) / 100.0)).collect();
    let label = |k: usize| {
        let rule = RULES[k];
        format!("\u{3b4} = {}, \u{3b2} = {:.3}", rule.delta, rule.beta)
    };
    let x = || Axis::log("\u{3c9}h, rad");
    let radius =
        Chart::new("Spectral radius", x(), Axis::linear("largest eigenvalue").limits(0.7, 1.6))
            .with_all((0..RULES.len()).map(|k| {
                Series::line(label(k), turns.iter().map(|&turn| (turn, RULES[k].radius(turn))))
            }));
    let period =
        Chart::new("Error of the period", x(), Axis::linear("% of the period").limits(-40.0, 60.0))
            .with_all((0..RULES.len()).map(|k| {
                let points = turns.iter().map(|&turn| (turn, 100.0 * RULES[k].period_error(turn)));
                Series::line(label(k), points.filter(|point| point.1.is_finite()))
            }));
    vec![radius, period]
}

/// Computes the rounding errors at many values of ω₁h, for a curve.
fn fine_losses() -> Result<Vec<Loss>, Error> {
    let turns: Vec<f64> = (0..=24).map(|k| 10f64.powf(-4.0 + f64::from(k) / 4.0)).collect();
    condition::losses(&turns)
}

/// Draws the error of a solution in f32 over ω₁h.
fn solution_chart(losses: &[Loss]) -> Chart {
    let of = |elements: usize, scaled: usize| {
        let of = losses.iter().filter(move |loss| loss.elements == elements);
        of.map(move |loss| (loss.turn, loss.solved[scaled].max(1e-9)))
    };
    Chart::new(
        "Solution of the effective matrix in f32",
        Axis::log("\u{3c9}\u{2081}h, rad"),
        Axis::log("tip off by, of itself"),
    )
    .with_all(ELEMENTS.map(|n| {
        let label = if n == 1 { "1 element".to_owned() } else { format!("{n} elements") };
        Series::line(label, of(n, 0))
    }))
    .with(Series::line("8, scaled", of(8, 1)).dash(Dash::Dashed))
}

/// Draws the error of `K q` in f32 over the number of elements.
fn product_chart(losses: &[Loss]) -> Chart {
    let of = |way: usize| {
        let least = losses.iter().map(|loss| loss.turn).fold(f64::INFINITY, f64::min);
        let one = losses.iter().filter(move |loss| loss.turn == least);
        one.map(move |loss| (loss.elements as f64, loss.product[way]))
    };
    Chart::new(
        "K q in f32",
        Axis::log("elements").limits(0.9, 9.0),
        Axis::log("first mode's restoring force off by, of itself"),
    )
    .with(Series::line("assembled", of(0)))
    .with(Series::line("by the elements\u{2019} deformations", of(1)).dash(Dash::Dashed))
}

fn render(
    moving: &[Chart],
    spinning: &[Chart],
    rules: &[Chart],
    conditions: &[Chart],
) -> Result<String, Error> {
    let move_caption = html! {
        strong { "A move and what follows it." }
        " A quintic of three first periods, 20 ticks at least, bends an undamped arm by a tenth of a \
         radian; six periods of rest follow, 1,500 ticks at least. Judged by the same kinematics at ticks of a twentieth of \
         a radian. Diagonals are lines of equal " span { "\u{3c9}\u{2081}h" } "."
    };
    let spin_caption = html! {
        strong { "A hub that goes on turning." }
        " Spun up in five first periods, 20 ticks at least, then held for 1,500 ticks. The last picture \
         is a trapezoidal rule on the nonlinear problem, with equilibrium iterations: unconditionally \
         stable for a linear arm, it is not so here. Rates above one radian a tick are refused."
    };
    let rule_caption = html! {
        strong { "Newmark\u{2019}s rule with other parameters, on one mode." }
        " The core\u{2019}s is the first: stable at any tick, its period too long by "
        "(\u{3c9}h)\u{b2}/12. With a smaller \u{3b2} it is so up to a bound only."
    };
    let condition_caption = html! {
        strong { "What rounding leaves of the effective matrix." }
        " Scaling the degrees of freedom, as a non-dimensional assembly does, leaves the solution as it is. \
         What loses digits is " i { "K q" } " of an assembled matrix, with the third power of the number of \
         elements."
    };
    let body = html! {
        header {
            h1 { "Where the methods are stable" }
            p.lead {
                "Green: deflections true to 1 % of their peak. Orange: not, but they do not grow. \
                 Crosses: they grow after the move. Grey rings: refused."
            }
        }
        main {
            (section("moves", "Tick and frequency", &figure(moving, &move_caption, DATA)?))
            (section("spins", "Rate of turning", &figure(spinning, &spin_caption, DATA)?))
            (section("rules", "Other rules", &figure(rules, &rule_caption, DATA)?))
            (section("condition", "Rounding", &figure(conditions, &condition_caption, DATA)?))
        }
    };
    Ok(page("Where the methods are stable", &body))
}

fn section(id: &str, title: &str, content: &Markup) -> Markup {
    html! { section id=(id) { h2 { (title) } (content) } }
}
