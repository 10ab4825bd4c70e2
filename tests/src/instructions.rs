//! The instruction table: the counts of the bench, as CSV and as the page in `docs/`.

use std::collections::BTreeMap;
use std::path::Path;

use stillbeam_golden::paths::PATHS;

use crate::emulator::{self, Board, Clock, LIMIT};
use crate::{firmware, image};

/// Returns the header of the CSV: the key of a row, then a column for the worst tick of each path.
pub fn header() -> String {
    let paths = PATHS.map(|path| path.column).join(",");
    format!("method,size,quality,skip,{paths}")
}

/// Key of a row: method, size, quality, skip.
pub type Key = [String; 4];

/// Instructions of one path of one method.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Count {
    /// Method, size, quality, skip.
    pub key: Key,
    /// The method's name in the list of methods.
    pub id: String,
    /// Least instructions of any tick.
    pub least: u32,
    /// Worst instructions of any tick.
    pub worst: u32,
    /// Instructions of the set-up: stepper, generator and the first move's plan.
    pub setup: u32,
}

/// One implementation of sine and cosine.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    /// Name of the implementation.
    pub name: String,
    /// Least instructions for both.
    pub least: u32,
    /// Worst instructions for both.
    pub worst: u32,
    /// Largest absolute error.
    pub error: String,
}

/// Output of the bench.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bench {
    /// Counts of ticks.
    pub counts: Vec<Count>,
    /// Counts of sines and cosines.
    pub functions: Vec<Function>,
}

/// Flash, RAM without stack and worst stack of a minimal image, bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Minimal {
    /// Flash: loaded bytes.
    pub flash: u64,
    /// RAM of statics.
    pub ram: u64,
    /// Deepest stack of set-up, one move and its ticks.
    pub stack: u32,
}

/// Builds and runs the bench.
///
/// # Errors
/// An error is returned if something is missing or fails: the build, the emulator or the bench.
pub fn count() -> Result<Bench, String> {
    let image = firmware::build("bench")?;
    parse(&String::from_utf8_lossy(&emulator::run(&image, Clock::Instructions, LIMIT)?))
}

/// Builds the bench for a processor without floating-point unit and runs it there.
///
/// # Errors
/// Errors are those of [`count`].
pub fn count_soft() -> Result<Bench, String> {
    let image = firmware::build_soft("bench")?;
    let printed = emulator::run_on(Board::An385, &image, Clock::Instructions, LIMIT)?;
    parse(&String::from_utf8_lossy(&printed))
}

/// Builds the bench for the smallest processors, Cortex-M0 and M0+, and runs it. Their instructions
/// are executed by the emulated Cortex-M3: as many as on their own core.
///
/// # Errors
/// Errors are those of [`count`].
pub fn count_smallest() -> Result<Bench, String> {
    let image = firmware::build_smallest("bench")?;
    let printed = emulator::run_on(Board::An385, &image, Clock::Instructions, LIMIT)?;
    parse(&String::from_utf8_lossy(&printed))
}

/// Builds the bench for RV32IMAC and runs it there.
///
/// # Errors
/// Errors are those of [`count`].
pub fn count_riscv() -> Result<Bench, String> {
    let image = firmware::build_riscv("bench")?;
    let printed = emulator::run_on(Board::RiscV, &image, Clock::Instructions, LIMIT)?;
    parse(&String::from_utf8_lossy(&printed))
}

/// Builds and runs the minimal image of one method, by its name in the list of methods.
///
/// # Errors
/// Errors are those of [`count`].
pub fn minimal(id: &str) -> Result<Minimal, String> {
    measure(&firmware::build_with("minimal", "STILLBEAM_METHOD", id)?)
}

/// Builds and runs the image that loads a prepared arm, by its method's name in the list.
///
/// # Errors
/// Errors are those of [`count`].
pub fn prepared(id: &str) -> Result<Minimal, String> {
    measure(&firmware::build_with("prepared", "STILLBEAM_METHOD", id)?)
}

/// Runs an image that prints its deepest stack as four bytes.
fn measure(image: &Path) -> Result<Minimal, String> {
    let footprint = image::footprint(image)?;
    let printed = emulator::run(image, Clock::Host, LIMIT)?;
    let stack = printed.try_into().map_err(|_| format!("{}: four bytes", image.display()))?;
    Ok(Minimal { flash: footprint.flash, ram: footprint.ram, stack: u32::from_le_bytes(stack) })
}

/// Reads the bench's lines.
///
/// # Errors
/// An error is returned for the first line that is not one of the bench's.
pub fn parse(lines: &str) -> Result<Bench, String> {
    let mut bench = Bench::default();
    for line in lines.lines() {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |i: usize| fields[i].parse().map_err(|_| format!("the bench printed {line}"));
        match fields[..] {
            ["unit", "instructions"] => {}
            ["tick", id, method, size, quality, skip, ..] if fields.len() == 9 => {
                bench.counts.push(Count {
                    key: [method, size, quality, skip].map(str::to_owned),
                    id: id.to_owned(),
                    least: number(6)?,
                    worst: number(7)?,
                    setup: number(8)?,
                });
            }
            ["function", name, _, _, error] => bench.functions.push(Function {
                name: name.to_owned(),
                least: number(2)?,
                worst: number(3)?,
                error: error.to_owned(),
            }),
            _ => return Err(format!("the bench printed {line}")),
        }
    }
    if bench.counts.is_empty() { Err("the bench printed nothing".into()) } else { Ok(bench) }
}

/// Splits `skip` into the words for what the scene or the method leaves out, and those of the path.
fn split(skip: &str) -> (String, String) {
    let (terms, path): (Vec<_>, Vec<_>) =
        skip.split_whitespace().partition(|word| word.starts_with("no-"));
    (terms.join(" "), path.join(" "))
}

/// True if a row would repeat others. A payload and a hub radius change no operation, which a test
/// asserts.
fn repeats(count: &Count) -> bool {
    ["no-payload", "no-radius"].iter().any(|word| count.key[3].contains(word))
}

/// Returns the CSV of ticks: a row for each key, a column for each path.
pub fn csv(bench: &Bench) -> String {
    let mut rows: Vec<(String, [String; PATHS.len()])> = Vec::new();
    for count in bench.counts.iter().filter(|count| !repeats(count)) {
        let (terms, path) = split(&count.key[3]);
        let row = format!("{},{terms}", count.key[..3].join(","));
        let column = PATHS.iter().position(|known| known.words == path);
        let column = column.unwrap_or_else(|| panic!("{path}: no column of this path"));
        let at = rows.iter().position(|(known, _)| *known == row).unwrap_or(rows.len());
        if at == rows.len() {
            rows.push((row, Default::default()));
        }
        rows[at].1[column] = count.worst.to_string();
    }
    let lines = rows.iter().map(|(row, worst)| format!("{row},{}\n", worst.join(",")));
    format!("{}\n{}", header(), lines.collect::<String>())
}

/// Reads the worst tick of each method, size, quality and skip in a CSV.
///
/// # Errors
/// An error is returned for the header or the first line that is not as expected.
pub fn ticks(csv: &str) -> Result<BTreeMap<Key, u32>, String> {
    let mut lines = csv.lines();
    let header = header();
    if lines.next() != Some(&header) {
        return Err(format!("the columns are to be {header}"));
    }
    let mut ticks = BTreeMap::new();
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        if fields.len() != 4 + PATHS.len() {
            return Err(format!("not {} columns: {line}", 4 + PATHS.len()));
        }
        for (path, worst) in PATHS.iter().zip(&fields[4..]).filter(|(_, worst)| !worst.is_empty()) {
            let worst = worst.parse().map_err(|_| format!("not a number: {line}"))?;
            let skip = [fields[3], path.words].join(" ");
            let key = [fields[0], fields[1], fields[2], skip.trim()].map(str::to_owned);
            ticks.insert(key, worst);
        }
    }
    Ok(ticks)
}

/// Returns the ticks that grew by more than `percent` against the CSV, and rows that only one of
/// them has.
///
/// # Errors
/// An error is returned if the CSV is not one.
pub fn regressions(bench: &Bench, csv: &str, percent: u32) -> Result<Vec<String>, String> {
    let mut before = ticks(csv)?;
    let mut found = Vec::new();
    for count in bench.counts.iter().filter(|count| !repeats(count)) {
        let name = count.key.join(",");
        let Some(was) = before.remove(&count.key) else {
            found.push(format!("{name}: not in docs/instructions.csv"));
            continue;
        };
        let is = count.worst;
        if u64::from(is) * 100 > u64::from(was) * u64::from(100 + percent) {
            found.push(format!("{name}: the worst tick grew from {was} to {is}"));
        }
    }
    found.extend(before.keys().map(|key| format!("{}: no longer counted", key.join(","))));
    Ok(found)
}
