//! Results of a sweep, as a page and as text.

use std::path::{Path, PathBuf};

use maud::{Markup, html};

use super::answers::bases;
use super::picture::{Picture, describe, ends, overview};
use super::row;
use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::report::parts::{Table, figure, page};
use stillbeam_sim::scenes;

/// Writes `index.html`, and a picture and the rows of each scene beside it, into a folder. Returns
/// the page's path.
pub fn write(folder: &Path, pictures: &[Picture<'_>]) -> Result<PathBuf, Error> {
    let page = folder.join("index.html");
    let text = render(pictures)?;
    let mut files = Files::default();
    for picture in pictures {
        let svg = picture.chart().svg()?;
        let name = file_name(&picture.scene);
        let path = folder.join(format!("{name}.svg"));
        files.add(&path, |file| file.write_all(svg.as_bytes()))?;
        let csv = folder.join(format!("{name}.csv"));
        files.add(&csv, |file| row::write(file, picture.rows.iter().copied()))?;
    }
    files.add(&page, |file| file.write_all(text.as_bytes()))?;
    files.finish()?;
    Ok(page)
}

/// Returns a file name for a scene, which may be a path.
fn file_name(scene: &str) -> String {
    scene.chars().map(|c| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' }).collect()
}

fn render(pictures: &[Picture<'_>]) -> Result<String, Error> {
    let sections = pictures.iter().map(section).collect::<Result<Vec<_>, _>>()?;
    let body = html! {
        header {
            h1 { "Run time against error" }
            p.lead {
                "Each mark is one solver on one scene. Its error is the largest distance \
                 of the tip from the reference rod, which shares no method with it; its \
                 time is what a second of motion takes on the machine that ran the sweep, \
                 so that a shorter tick costs what it costs."
            }
            p.soft {
                "A tick is one call of the generator: commanded motion, step, torque and \
                 tip. Times tell solvers apart; they are not those of the target, whose \
                 instructions are counted elsewhere. The torque error leaves out what lies \
                 beside a jump of the commanded acceleration, and is a share of the peak \
                 torque."
            }
        }
        nav aria-label="Contents" {
            ol {
                li { a href="#overview" { "What a choice costs" } }
                @for picture in pictures {
                    li { a href={ "#" (file_name(&picture.scene)) } { (picture.scene) } }
                }
            }
        }
        main {
            section id="overview" {
                h2 { "What a choice costs" }
                @for table in overviews(pictures) { (table.markup()) }
            }
            @for section in &sections { (section) }
        }
    };
    Ok(page("Stillbeam: run time against error", &body))
}

fn section(picture: &Picture<'_>) -> Result<Markup, Error> {
    let name = file_name(&picture.scene);
    let diverged = picture.rows.iter().filter(|row| row.errors.tip_max.is_infinite()).count();
    let caption = html! {
        (picture.rows.len()) " cases"
        @if diverged > 0 { ", " (diverged) " of which diverge and have no mark" }
        ". The line joins those that no other beats in both. "
        (ends(picture))
    };
    Ok(html! {
        section id=(name) {
            h2 { (picture.scene) }
            @if let Some((_, about)) = scenes::list().find(|(name, _)| *name == picture.scene) {
                p { (about) }
            }
            (figure(&[picture.chart()], &caption, &format!("{name}.csv"))?)
            @for (base, answers) in &picture.answers {
                @if !answers.is_empty() {
                    h3 { "What a choice costs around " (describe(*base)) }
                    ul { @for answer in answers { li {
                        strong { (answer.question.text) ". " } (answer.sentence())
                    } } }
                    (Picture::answer_table(*base, answers).markup())
                }
            }
            h3 { "The front" }
            (picture.front_table().markup())
        }
    })
}

/// Returns the same results for a terminal.
pub fn text(picture: &Picture<'_>) -> String {
    let mut text = format!("{}: {} cases\n{}\n", picture.scene, picture.rows.len(), ends(picture));
    text += &plain(&picture.front_table());
    for (base, answers) in &picture.answers {
        if !answers.is_empty() {
            text += &format!("What a choice costs around {}:\n", describe(*base));
            for answer in answers {
                text += &format!("  {}\n    {}\n", answer.question.text, answer.sentence());
            }
        }
        let unanswered = Picture::unanswered(answers);
        if !unanswered.is_empty() {
            let missing = unanswered.join("; ");
            text += &format!("  no rows around {} for: {missing}\n", describe(*base));
        }
    }
    text + "\n"
}

/// Returns the overviews of all scenes.
pub fn overviews(pictures: &[Picture<'_>]) -> Vec<Table> {
    (0..bases().len()).filter_map(|base| overview(pictures, base)).collect()
}

/// Returns the overviews for a terminal.
pub fn summary(pictures: &[Picture<'_>]) -> String {
    let block = |table: &Table| format!("{}\n{}\n", table.caption, plain(table));
    overviews(pictures).iter().map(block).collect()
}

/// Formats columns of even width, a long header over two lines.
fn plain(table: &Table) -> String {
    let split = |name: &str| -> [String; 2] {
        match (name.split_once(", "), name.split_once(" against ")) {
            (Some((quantity, unit)), _) => [quantity.to_owned(), unit.to_owned()],
            (None, Some((a, b))) => [a.to_owned(), format!("against {b}")],
            (None, None) => [name.to_owned(), String::new()],
        }
    };
    let heads: Vec<[String; 2]> = table.header.iter().map(|name| split(name)).collect();
    let lines = (0..2)
        .map(|line| heads.iter().map(|head| head[line].clone()).collect())
        .chain(table.rows.iter().cloned());
    let lines: Vec<Vec<String>> = lines.collect();
    let width = |c: usize| lines.iter().map(|line| line[c].chars().count()).max();
    let widths: Vec<usize> = (0..heads.len()).map(|c| width(c).unwrap_or(0)).collect();
    let mut text = String::new();
    for line in &lines {
        for (c, (cell, &width)) in line.iter().zip(&widths).enumerate() {
            text += &if c == 0 { format!("  {cell:<width$}") } else { format!("  {cell:>width$}") };
        }
        text.truncate(text.trim_end().len());
        text += "\n";
    }
    text
}
