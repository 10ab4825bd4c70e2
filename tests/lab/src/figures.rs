//! The figures of README: cells of the tables of other pages, so that they are computed once.

use std::path::Path;

use stillbeam_sim::error::Error;

use crate::markers::{self, Block};
use crate::pages::read;
use crate::table::aligned;

/// Motions of `docs/still.md`, and their words in README.
const MOTIONS: [(&str, &str); 4] = [
    ("cubic", "cubic, torque of a rigid arm"),
    ("cubic, ZV", "cubic behind a ZV shaper"),
    ("quintic, ZVD", "quintic behind a ZVD shaper"),
    ("still", "**still move**"),
];

/// Solvers of `docs/accuracy.md`, the beginnings of their rows in `docs/instructions.csv`, and
/// their words in README.
const SOLVERS: [(&str, &str, &str); 4] = [
    ("rigid, 10 ms, f32", "rigid,0,,no-damping no-gravity", "nothing bends"),
    (
        "newmark, 1 consistent element, 10 ms, f32",
        "newmark,1,consistent,no-damping no-gravity",
        "the paper's: one element, Newmark",
    ),
    (
        "modal, 2 modes of 8 consistent elements, 10 ms, f32",
        "modal,2,,no-damping no-gravity",
        "two modes, small deflections",
    ),
    (
        "elastica, 2 modes, fast, 10 ms, f32",
        "elastica,2,fast,no-damping no-gravity",
        "**exact kinematics, two modes**",
    ),
];

/// Returns the block of README from the pages below `root`.
///
/// # Errors
/// A page cannot be read, or has no such cell.
pub fn blocks(root: &Path) -> Result<Vec<Block>, Error> {
    let page = |name: &str| read(&root.join(name));
    let contest = Table::of("docs/still.md", &page("docs/still.md")?, "contest-2")?;
    let accuracy = Table::of("docs/accuracy.md", &page("docs/accuracy.md")?, "accuracy")?;
    let counts = page("docs/instructions.csv")?;
    let mut motions =
        vec![header(["half a turn in two first periods", "left", "5 % off", "10 % off"])];
    for (row, words) in MOTIONS {
        let cell = |column: &str| contest.cell(row, column);
        motions.push(vec![words.to_owned(), cell("0 %")?, cell("+5 %")?, cell("+10 %")?]);
    }
    let mut solvers = vec![header(["setpoints by", "tip off by", "instructions a tick"])];
    for (row, begin, words) in SOLVERS {
        let count = counts.lines().find_map(|line| line.strip_prefix(&format!("{begin},")));
        let count = count.and_then(|rest| rest.split(',').next());
        let count = count.ok_or_else(|| missing("docs/instructions.csv", begin))?;
        solvers.push(vec![words.to_owned(), accuracy.cell(row, "d-fast")?, count.to_owned()]);
    }
    let text = format!("{}\n{}", aligned(&motions), aligned(&solvers));
    Ok(vec![Block::new("figures", text)])
}

fn header<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

fn missing(page: &str, cell: &str) -> Error {
    Error::new(format_args!("{page}: has no {cell}; README takes its figure from there"))
}

/// A table in Markdown.
struct Table {
    page: &'static str,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn of(page: &'static str, text: &str, block: &str) -> Result<Self, Error> {
        let block = markers::block(text, block).map_err(|error| error.within(page))?;
        let lines = block.lines().filter(|line| line.starts_with('|'));
        let cells = |line: &str| line.split('|').map(|cell| cell.trim().to_owned()).collect();
        Ok(Self { page, rows: lines.map(cells).collect() })
    }

    fn cell(&self, row: &str, column: &str) -> Result<String, Error> {
        let header = self.rows.first().map_or(&[][..], Vec::as_slice);
        let column = header.iter().position(|cell| cell == column);
        let found = self.rows.iter().find(|cells| cells.get(1).is_some_and(|cell| cell == row));
        let cell = column.and_then(|column| found?.get(column));
        cell.cloned().ok_or_else(|| missing(self.page, row))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_is_found_by_its_row_and_column() {
        let text = "<!-- lab:t -->\n| a | x | y |\n| - | - | - |\n| p | 1 | 2 |\n| q | 3 | 4 |\n<!-- /lab -->\n";
        let table = Table::of("page.md", text, "t").unwrap();
        assert_eq!(table.cell("q", "x").unwrap(), "3");
        let error = table.cell("r", "x").unwrap_err().to_string();
        assert!(error.starts_with("page.md: has no r"), "{error}");
    }
}
