//! The pages of docs/ as a reader takes them: what they say to type runs, their files are what they
//! say, and their links lead somewhere.
//!
//! A block that begins with a kind and a name (`toml arm.toml`) is a file of that name. The lines
//! of a block `sh` are commands, which run in a folder with the page's files; those of `sh yours`
//! name files of the reader's own, and fail for want of them only.

use std::fs;
use std::path::{Path, PathBuf};

use crate::sim;

/// Commands that other tests run, or that need what no test has. Those with a blank at the end are
/// beginnings of commands.
const ELSEWHERE: [(&str, &str); 15] = [
    ("cargo install --path host-sim", "builds what is tested here"),
    ("cargo build ", "the image and the program are built for the other tests"),
    ("cargo run --release", "the study, in tests/study.rs"),
    ("cargo run --release -- talk ", "its transcripts are compared in the target's tests"),
    ("cargo run -p stillbeam --example ", "core/tests/examples.rs"),
    ("cargo lab ", "tested in the lab; its pages by `cargo lab docs --check`"),
    ("sh tests/all", "the tests themselves"),
    ("pip install ", "the package is loaded from cargo's build in tests/python"),
    ("rustup target add ", "the set-up"),
    ("bindings/c/build ", "tests/target/c.rs builds the same archive"),
    ("arm-none-eabi-gcc ", "tests/target/c.rs links an example"),
    ("probe-rs run ", "needs a board"),
    ("stillbeam-sim drive d-tip30-quick", "`cargo lab docs --check`"),
    ("stillbeam-sim drive d-tip30-quick --machine cia402-tuned", "`cargo lab docs --check`"),
    (
        "stillbeam-sim drive d-tip30-quick --machine odrive-tuned --out drive",
        "`cargo lab docs --check`",
    ),
];

fn runs_elsewhere(line: &str) -> bool {
    ELSEWHERE.iter().any(|(known, _)| match known.strip_suffix(' ') {
        Some(begin) => line.starts_with(begin),
        None => line == *known,
    })
}

/// A fenced block: its first line behind the fence, and its text.
struct Block<'a> {
    info: &'a str,
    text: String,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The chapters of the book, in their order.
fn chapters() -> Vec<String> {
    let summary = read(&root().join("docs/SUMMARY.md"));
    let links = summary.split("](").skip(1);
    links.map(|rest| rest.split(')').next().expect("an end").to_owned()).collect()
}

/// The blocks of a page, with the indent of a list taken off, and the text around them.
fn parts(page: &str) -> (Vec<Block<'_>>, String) {
    let (mut blocks, mut prose) = (Vec::new(), String::new());
    let mut open: Option<(Block<'_>, usize)> = None;
    for line in page.lines() {
        let bare = line.trim_start();
        open = match (open.take(), bare.strip_prefix("```")) {
            (None, Some(info)) => {
                Some((Block { info, text: String::new() }, line.len() - bare.len()))
            }
            (None, None) => {
                prose += line;
                prose.push('\n');
                None
            }
            (Some((block, _)), Some(_)) => {
                blocks.push(block);
                None
            }
            (Some((mut block, indent)), None) => {
                block.text += line.get(indent..).unwrap_or("");
                block.text.push('\n');
                Some((block, indent))
            }
        };
    }
    assert!(open.is_none(), "a block has no end");
    (blocks, prose)
}

/// Words of a command, without its remark. A line that ends in `\` goes on.
fn commands(text: &str) -> Vec<String> {
    let lines = text.replace("\\\n", " ");
    let bare = lines.lines().map(|line| line.split(" #").next().unwrap_or("").trim().to_owned());
    bare.filter(|line| !line.is_empty() && !line.starts_with('#')).collect()
}

/// Runs the commands of a page. Returns how many there were.
fn run_page(name: &str, page: &str) -> usize {
    let folder = tempfile::tempdir().expect("a folder");
    let (blocks, _) = parts(page);
    for block in &blocks {
        if let Some((kind, file)) = block.info.split_once(' ').filter(|(kind, _)| *kind != "sh") {
            assert!(["toml", "csv", "json"].contains(&kind), "{name}: {}", block.info);
            fs::write(folder.path().join(file), &block.text).expect("a file");
        }
    }
    let mut count = 0;
    for block in &blocks {
        let yours = match block.info {
            "sh" => false,
            "sh yours" => true,
            _ => continue,
        };
        for line in commands(&block.text) {
            if runs_elsewhere(&line) {
                continue;
            }
            let words: Vec<&str> = line.split_whitespace().collect();
            assert_eq!(words[0], "stillbeam-sim", "{name}: {line}: no test runs it");
            let output = sim().current_dir(folder.path()).args(&words[1..]).output();
            let output = output.expect("the program");
            let error = String::from_utf8_lossy(&output.stderr);
            match output.status.code() {
                Some(0) if !yours => count += 1,
                Some(2) if yours && error.to_lowercase().contains("no such file") => count += 1,
                code => panic!("{name}: {line}: exit code {code:?}: {error}"),
            }
        }
    }
    count
}

fn run_chapters(half: usize) -> usize {
    let pages = chapters().into_iter().enumerate().filter(|(index, _)| index % 2 == half);
    pages.map(|(_, name)| run_page(&name, &read(&root().join("docs").join(&name)))).sum()
}

#[test]
fn commands_of_the_odd_chapters_run() {
    assert!(run_chapters(0) >= 10);
}

#[test]
fn commands_of_the_even_chapters_run() {
    assert!(run_chapters(1) >= 8);
}

#[test]
fn commands_of_readme_run() {
    let page = read(&root().join("README.md"));
    assert!(run_page("README.md", &page) >= 4);
}

/// The anchor that a heading gets: lower case, spaces as hyphens, without punctuation.
fn anchor(heading: &str) -> String {
    let kept = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = kept.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Every chapter exists, every page of docs/ is a chapter, and every link leads to a file and a
/// heading that are there.
#[test]
fn links_lead_somewhere() {
    let chapters = chapters();
    let docs = root().join("docs");
    for entry in fs::read_dir(&docs).expect("docs") {
        let name = entry.expect("an entry").file_name().into_string().expect("a name");
        if name.ends_with(".md") && name != "SUMMARY.md" {
            assert!(chapters.contains(&name), "docs/{name} is no chapter of SUMMARY.md");
        }
    }
    let top = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md"];
    let pages = chapters.iter().map(|name| docs.join(name));
    let mut seen = 0;
    for path in pages.chain(top.map(|name| root().join(name))) {
        let page = read(&path);
        let (_, prose) = parts(&page);
        for link in prose.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if link.starts_with("http") {
                continue;
            }
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let target = match file {
                "" => path.clone(),
                file => path.parent().expect("a folder").join(file),
            };
            assert!(target.exists(), "{}: {link} leads nowhere", path.display());
            if !heading.is_empty() {
                let text = read(&target);
                let found = text.lines().filter(|line| line.starts_with('#'));
                let found = found.map(anchor).any(|anchor| anchor == heading);
                assert!(found, "{}: {link}: no such heading", path.display());
            }
            seen += 1;
        }
    }
    assert!(seen > 40, "{seen} links");
}
