//! The core's folders import one way: none imports one that stands later in the order of the data.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The core's modules, in the order of the data. A module may import those before it.
const ORDER: [&str; 17] = [
    "math",
    "error",
    "prepared",
    "hub",
    "material",
    "scene",
    "mechanism",
    "model",
    "motion",
    "stepper",
    "generator",
    "chain",
    "planner",
    "select",
    "axis",
    "motor",
    "drive",
];

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Every Rust file below a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path.extension().is_some_and(|ending| ending == "rs") {
            found.push(path);
        }
    }
    found
}

/// The module of a file: its folder's or its own name below `src`.
fn module(file: &Path) -> String {
    let below = file.strip_prefix(sources()).unwrap();
    let first = below.components().next().unwrap().as_os_str().to_str().unwrap();
    first.trim_end_matches(".rs").to_owned()
}

/// The text without its comments, examples in them included.
fn code(text: &str) -> String {
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// The identifiers behind every `crate::` of a text: one each, or all of a list in braces.
fn imports(code: &str) -> Vec<String> {
    let mut found = Vec::new();
    for rest in code.split("crate::").skip(1) {
        let list = match rest.strip_prefix('{') {
            Some(list) => list.split('}').next().unwrap(),
            None => rest,
        };
        let items = if rest.starts_with('{') { list.split(',').collect() } else { vec![list] };
        for item in items {
            let name = item.trim().split(|c: char| !(c.is_alphanumeric() || c == '_')).next();
            found.extend(name.filter(|name| !name.is_empty()).map(str::to_owned));
        }
    }
    found
}

/// Which module each name comes from that the crate's root hands on.
fn handed_on() -> HashMap<String, String> {
    let root = code(&fs::read_to_string(sources().join("lib.rs")).unwrap());
    let mut names = HashMap::new();
    for statement in root.split("pub use ").skip(1) {
        let (module, list) = statement.split(';').next().unwrap().split_once("::").unwrap();
        for name in list.trim_matches(['{', '}']).split(',') {
            names.insert(name.trim().to_owned(), module.to_owned());
        }
    }
    names
}

#[test]
fn the_order_names_every_module() {
    let mut found: Vec<String> = files(&sources()).iter().map(|file| module(file)).collect();
    found.sort();
    found.dedup();
    found.retain(|name| name != "lib");
    let mut order = ORDER.map(str::to_owned).to_vec();
    order.sort();
    assert_eq!(found, order);
}

#[test]
fn no_module_imports_a_later_one() {
    let names = handed_on();
    let place = |module: &str| ORDER.iter().position(|name| *name == module);
    let mut upwards = Vec::new();
    let mut seen = 0;
    for file in files(&sources()) {
        let own = module(&file);
        if own == "lib" {
            continue;
        }
        for import in imports(&code(&fs::read_to_string(&file).unwrap())) {
            let from = names.get(&import).unwrap_or(&import);
            let Some(there) = place(from) else { continue };
            seen += 1;
            if there > place(&own).unwrap() {
                upwards.push(format!("{}: crate::{import} is of {from}", file.display()));
            }
        }
    }
    assert!(seen > 200, "{seen} imports read");
    assert!(upwards.is_empty(), "{upwards:#?}");
}
