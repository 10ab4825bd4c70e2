//! Counts instructions on the emulated target and writes `docs/instructions.csv` and the tables of
//! `docs/instructions.md`. With `--check`, fails instead if a tick has grown by more than 2 %; with
//! `--list`, prints what ticks cost and writes nothing.

use std::collections::BTreeMap;
use std::process::ExitCode;
use std::{env, fs};

use stillbeam_tests::{cycles, instructions, page, parts, root};

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let done = match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => write(),
        ["--check"] => check(),
        ["--list"] => instructions::count().map(|bench| print!("{}", instructions::csv(&bench))),
        _ => Err("usage: instructions [--check | --list]".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn write() -> Result<(), String> {
    let bench = instructions::count()?;
    let soft = page::Soft {
        cortex_m3: instructions::count_soft()?,
        cortex_m0: instructions::count_smallest()?,
        riscv: instructions::count_riscv()?,
    };
    let mut minimal = BTreeMap::new();
    for count in &bench.counts {
        if !minimal.contains_key(&count.id) {
            minimal.insert(count.id.clone(), instructions::minimal(&count.id)?);
        }
    }
    let prepared = parts::METHODS.iter().map(|(_, id)| instructions::prepared(id));
    let prepared = prepared.collect::<Result<Vec<_>, _>>()?;
    let path = root().join("docs/instructions.csv");
    fs::write(&path, instructions::csv(&bench)).map_err(|e| format!("{path:?}: {e}"))?;
    let path = root().join("docs/instructions.md");
    let text = fs::read_to_string(&path).map_err(|e| format!("{path:?}: {e}"))?;
    let estimates = cycles::estimate()?;
    let tables = page::tables(&bench, &soft, &minimal, &prepared, &estimates);
    let text = page::replace(&text, &tables)?;
    fs::write(&path, text).map_err(|e| format!("{path:?}: {e}"))
}

fn check() -> Result<(), String> {
    let path = root().join("docs/instructions.csv");
    let csv = fs::read_to_string(&path).map_err(|e| format!("{path:?}: {e}"))?;
    let found = instructions::regressions(&instructions::count()?, &csv, 2)?;
    if found.is_empty() { Ok(()) } else { Err(found.join("\n")) }
}
