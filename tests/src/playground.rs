//! The page of the playground: builds the core as WebAssembly, and joins it and the sources of
//! `playground/page/` into one file.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use data_encoding::BASE64;

use crate::firmware::{cargo, require_target, run};
use crate::root;

/// Target of a browser.
const TARGET: &str = "wasm32-unknown-unknown";

/// Command that writes the page anew.
pub const COMMAND: &str = "cargo run -p stillbeam-tests --bin playground";

/// Returns the path of the committed page.
pub fn page() -> PathBuf {
    root().join("host-sim/playground/index.html")
}

/// Builds the page from its sources. The same sources give the same bytes in any folder.
///
/// # Errors
/// An error is returned with cargo's messages, with the target to install, or with the source that
/// cannot be joined.
pub fn build() -> Result<String, String> {
    let module = fs::read(module()?).map_err(|error| format!("the module: {error}"))?;
    let mut page = source("index.html")?;
    while let Some((before, sheet, after)) = cut(&page, "<link rel=\"stylesheet\" href=\"", "\">") {
        let style = source(sheet)?;
        page = format!("{before}<style>\n{style}</style>{after}");
    }
    let (before, script, after) = cut(&page, "<script type=\"module\" src=\"", "\"></script>")
        .ok_or("index.html: must have one script")?;
    let mut joined = String::new();
    join(script, &mut BTreeSet::new(), &mut joined)?;
    page = format!("{before}<script type=\"module\">\n{joined}</script>{after}");
    let (before, kind, after) = cut(&page, "<script id=\"module\" ", "></script>")
        .ok_or("index.html: must have a place for the module")?;
    Ok(format!("{before}<script id=\"module\" {kind}>{}</script>{after}", BASE64.encode(&module)))
}

/// Builds the core for a browser. Returns the module's path.
fn module() -> Result<PathBuf, String> {
    require_target(TARGET)?;
    // A folder of its own: the cargo that runs the tests may hold the lock of the usual one.
    let folder = root().join("target/playground");
    run(cargo()
        .args(["build", "--quiet", "--package", "stillbeam-playground"])
        .args(["--profile", "playground", "--target", TARGET, "--target-dir"])
        .arg(&folder))?;
    Ok(folder.join(TARGET).join("playground/stillbeam_playground.wasm"))
}

fn source(name: &str) -> Result<String, String> {
    let path = Path::new("playground/page").join(name);
    fs::read_to_string(root().join(&path)).map_err(|error| format!("{}: {error}", path.display()))
}

/// Splits a text at the first place that begins with `open` and ends with `close`.
fn cut<'a>(text: &'a str, open: &str, close: &str) -> Option<(&'a str, &'a str, &'a str)> {
    let (before, rest) = text.split_once(open)?;
    let (inside, after) = rest.split_once(close)?;
    Some((before, inside, after))
}

/// Appends a script behind those that it imports, without the words `import` and `export`, which
/// one script has no use of.
fn join(name: &str, joined: &mut BTreeSet<String>, page: &mut String) -> Result<(), String> {
    if !joined.insert(name.to_owned()) {
        return Ok(());
    }
    let text = source(name)?;
    let mut own = String::new();
    for line in text.lines() {
        if line.starts_with("import ") {
            let (_, file, _) = cut(line, " from \"./", "\";").ok_or_else(|| {
                format!("{name}: `{line}`: must be one line, of a file beside it")
            })?;
            join(file, joined, page)?;
        } else {
            own.push_str(line.strip_prefix("export ").unwrap_or(line));
            own.push('\n');
        }
    }
    page.push_str(&own);
    Ok(())
}
