//! The tables of docs/accuracy.md, with errors by a sweep.

use super::answers::short;
use super::execute;
use super::plan::Plan;
use super::row::Row;
use super::spec::Spec;
use crate::markers::Block;
use crate::table::aligned;
use stillbeam_sim::error::Error;
use stillbeam_sim::solver::SolverKeys;

/// A table: a line a solver, a column a scene.
pub struct Table {
    /// Name of its block.
    pub name: &'static str,
    cell: fn(&Row) -> f64,
}

/// Tables of the pages.
pub const TABLES: [Table; 2] = [
    Table { name: "accuracy", cell: |row| 100.0 * row.errors.tip_max },
    Table { name: "torque", cell: |row| 100.0 * row.errors.torque },
];

/// Returns the rows of the embedded set, in the order of its plan.
pub fn rows() -> Result<Vec<Row>, Error> {
    let spec = Spec::parse("readme.toml", include_str!("../../sweeps/readme.toml"))?;
    execute::errors(&Plan::new(&spec)?)
}

/// Returns the tables as blocks of a page.
pub fn blocks(rows: &[Row]) -> Vec<Block> {
    TABLES.iter().map(|table| Block::new(table.name, table.markdown(rows))).collect()
}

impl Table {
    /// Formats a line for each solver, a column for each scene. The cost of a tick is left out: a
    /// desktop's nanoseconds are another machine's, and no test could check them.
    fn markdown(&self, rows: &[Row]) -> String {
        let scenes = super::picture::scenes(rows);
        let mut solvers: Vec<SolverKeys> = Vec::new();
        for row in rows {
            if !solvers.contains(&row.keys) {
                solvers.push(row.keys);
            }
        }
        let mut lines: Vec<Vec<String>> =
            vec![[&["solver"], &scenes[..]].concat().iter().map(|s| s.to_string()).collect()];
        for keys in solvers {
            let of_solver = rows.iter().filter(|row| row.keys == keys);
            let name = super::picture::describe(keys);
            let errors = of_solver.map(|row| short((self.cell)(row)));
            lines.push([name].into_iter().chain(errors).collect());
        }
        aligned(&lines)
    }
}

#[cfg(test)]
mod tests {
    use super::super::row::tests::row;
    use super::*;

    #[test]
    fn a_cell_is_an_error_in_percent() {
        let rows = [row(1, 0.1304, Some(40.0)), row(2, 0.002, Some(80.0))];
        let [accuracy, torque] = <[Block; 2]>::try_from(blocks(&rows)).unwrap();
        assert_eq!((accuracy.name.as_str(), torque.name.as_str()), ("accuracy", "torque"));
        let cells: Vec<Vec<&str>> = accuracy
            .text
            .lines()
            .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
            .collect();
        assert_eq!(cells[0], ["solver", "d-fast"]);
        assert_eq!([cells[2][1], cells[3][1]], ["13.0", "0.200"]);
        assert!(torque.text.ends_with(" 1.00 |\n"), "{}", torque.text);
        // What a tick took is not in it.
        assert_eq!(blocks(&[row(1, 0.1304, None), row(2, 0.002, None)])[0], accuracy);
    }
}
