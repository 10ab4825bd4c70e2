//! The pages with blocks that take seconds. One command writes or checks them.

use std::cell::OnceCell;
use std::path::{Path, PathBuf};

use stillbeam_sim::error::Error;
use stillbeam_sim::output::Files;
use stillbeam_sim::println;

use crate::campaign::with_bar;
use crate::markers::{self, Block, Difference};
use crate::stability::{self, document::Findings, map};
use crate::sweep::row::Row;
use crate::sweep::tables;
use crate::{choice, figures, plant, still};

/// A page, by its path from the root of the repository, and its blocks that are written here.
/// Campaigns write the other blocks of the same page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Page {
    /// Path from the root.
    pub path: &'static str,
    /// Names of its blocks.
    pub blocks: &'static [&'static str],
    source: Source,
}

/// Results that are computed for a page.
struct Computed {
    blocks: Vec<Block>,
    /// Pictures that cost nothing beside the blocks: the name beside the page, and the SVG.
    pictures: Vec<(&'static str, String)>,
}

/// Picture beside `docs/still.md` that moves. README shows it.
const MOVING: &str = "still-moving.svg";

/// Computation of the blocks of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Source {
    Figures,
    Tables,
    Still,
    Stability,
    Auto,
    Drive,
}

/// Every page.
pub const PAGES: [Page; 6] = [
    Page { path: "README.md", blocks: &["figures"], source: Source::Figures },
    Page { path: "docs/accuracy.md", blocks: &["accuracy", "torque"], source: Source::Tables },
    Page {
        path: "docs/still.md",
        blocks: &["residual", "contest-1.5", "contest-2", "robust", "durations", "fastest-eased"],
        source: Source::Still,
    },
    Page {
        path: "docs/stability.md",
        blocks: &["ranges", "moves", "spins", "rules", "condition"],
        source: Source::Stability,
    },
    Page { path: "docs/auto.md", blocks: &["command", "arms"], source: Source::Auto },
    Page {
        path: "docs/drive.md",
        blocks: &["odrive", "odrive-tuned", "moteus-tuned", "cia402-tuned", "geared"],
        source: Source::Drive,
    },
];

/// Finds a page by its path.
///
/// # Errors
/// An error is returned if the path is not that of a page.
pub fn named(path: &str) -> Result<Page, Error> {
    PAGES.into_iter().find(|page| page.path == path).ok_or_else(|| {
        let known = PAGES.map(|page| page.path).join(", ");
        Error::new(format_args!("page = \"{path}\": must be {known}"))
    })
}

/// Reads a page.
///
/// # Errors
/// An error is returned if the file cannot be read.
pub(crate) fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|cause| {
        Error::file(path, format_args!("{cause}; must be a text file that can be read"))
    })
}

/// A page that a campaign fills.
#[derive(Clone, Debug)]
pub struct Target {
    path: PathBuf,
    text: String,
}

impl Target {
    /// Opens the page of a campaign, if it is to fill one. A page without a place for these blocks
    /// is refused before the campaign runs for them.
    ///
    /// # Errors
    /// An error is returned if the file cannot be read or the markers of a block are missing. It
    /// names the block.
    pub fn open<'a>(
        path: Option<PathBuf>,
        names: impl IntoIterator<Item = &'a str>,
    ) -> Result<Option<Self>, Error> {
        let Some(path) = path else { return Ok(None) };
        let text = read(&path)?;
        has_places(&path, &text, names)?;
        Ok(Some(Self { path, text }))
    }

    /// Writes the page with its blocks filled, and says so.
    ///
    /// # Errors
    /// An error is returned if the path cannot be written.
    pub fn fill(&self, blocks: &[Block]) -> Result<(), Error> {
        let filled = filled(&self.path, &self.text, blocks)?;
        stillbeam_sim::output::write_whole(&self.path, |f| f.write_all(filled.as_bytes()))?;
        println!("{}: filled", self.path.display());
        Ok(())
    }
}

/// Refuses a page without a place for these blocks.
fn has_places<'a>(
    path: &Path,
    text: &str,
    names: impl IntoIterator<Item = &'a str>,
) -> Result<(), Error> {
    names
        .into_iter()
        .try_for_each(|name| markers::block(text, name).map(drop))
        .map_err(|error| error.within(path.display()))
}

fn filled(path: &Path, text: &str, blocks: &[Block]) -> Result<String, Error> {
    markers::fill(text, blocks).map_err(|error| error.within(path.display()))
}

/// The pages below a root, with the data from which several of them are written.
pub struct Pages {
    root: PathBuf,
    rows: OnceCell<Vec<Row>>,
    findings: OnceCell<Findings>,
}

/// A page as it stands, as it is to be, and its pictures.
type Filled = (String, String, Vec<(PathBuf, String)>);

impl Pages {
    /// Creates the pages of the repository at `root`.
    pub fn at(root: &Path) -> Self {
        Self { root: root.to_owned(), rows: OnceCell::new(), findings: OnceCell::new() }
    }

    /// Compares a page, and its pictures that are drawn from the same data, with the same written
    /// now.
    ///
    /// # Errors
    /// An error is returned if the page cannot be read or has no place for a block, or if a
    /// computation fails.
    pub fn check(&self, page: &Page) -> Result<Option<Difference>, Error> {
        let (text, filled, pictures) = self.filled(page)?;
        let found = markers::difference(&text, &filled);
        if found.is_some() {
            return Ok(found);
        }
        for (path, now) in pictures {
            if read(&path)? != now {
                let (line, new) = (1, Some("drawn differently".to_owned()));
                return Ok(Some(Difference { line, old: Some(path.display().to_string()), new }));
            }
        }
        Ok(None)
    }

    /// Writes a page and its pictures, all or none. Returns the paths that were written.
    ///
    /// # Errors
    /// Errors are those of [`check`](Self::check), and that of a path that cannot be written.
    pub fn write(&self, page: &Page) -> Result<Vec<PathBuf>, Error> {
        let (_, filled, pictures) = self.filled(page)?;
        let path = self.root.join(page.path);
        let mut files = Files::default();
        files.add(&path, |file| file.write_all(filled.as_bytes()))?;
        for (path, svg) in &pictures {
            files.add(path, |file| file.write_all(svg.as_bytes()))?;
        }
        match page.source {
            Source::Still => {
                with_bar("pictures", still::document::PICTURE_STEPS as u64, |done| {
                    still::document::pictures(&mut files, &path, &|| done(1))
                })?;
            }
            Source::Stability => {
                let svg = stability::page::picture(self.findings()?)?;
                files.add(&path.with_extension("svg"), |file| file.write_all(svg.as_bytes()))?;
            }
            Source::Drive => {
                with_bar("pictures", 14, |done| {
                    plant::page::pictures(&mut files, &path, &|| done(1))
                })?;
            }
            Source::Figures | Source::Tables | Source::Auto => {}
        }
        files.finish()
    }

    /// Returns a page as it stands, with its blocks as they are now, and its pictures.
    fn filled(&self, page: &Page) -> Result<Filled, Error> {
        let path = self.root.join(page.path);
        let text = read(&path)?;
        has_places(&path, &text, page.blocks.iter().copied())?;
        let Computed { blocks, pictures } = self.compute(page, &text)?;
        let filled = filled(&path, &text, &blocks)?;
        let placed = pictures.into_iter().map(|(name, svg)| (path.with_file_name(name), svg));
        Ok((text, filled, placed.collect()))
    }

    fn compute(&self, page: &Page, text: &str) -> Result<Computed, Error> {
        let mut pictures = Vec::new();
        let all = match page.source {
            Source::Figures => figures::blocks(&self.root)?,
            Source::Tables => tables::blocks(self.rows()?),
            Source::Still => {
                let still::document::Document { blocks, moving } =
                    with_bar("reference rod", still::document::STEPS as u64, |done| {
                        still::document::compute(&|| done(1))
                    })?;
                pictures.push((MOVING, moving));
                blocks
            }
            Source::Stability => self.findings()?.blocks(),
            Source::Auto => choice::blocks(text)?,
            Source::Drive => with_bar("drives", plant::page::STEPS as u64, |done| {
                plant::page::blocks(&|| done(1))
            })?,
        };
        let known = |block: &Block| page.blocks.contains(&block.name.as_str());
        Ok(Computed { blocks: all.into_iter().filter(known).collect(), pictures })
    }

    fn rows(&self) -> Result<&[Row], Error> {
        match self.rows.get() {
            Some(rows) => Ok(rows),
            None => {
                let found = tables::rows()?;
                Ok(self.rows.get_or_init(|| found))
            }
        }
    }

    fn findings(&self) -> Result<&Findings, Error> {
        match self.findings.get() {
            Some(findings) => Ok(findings),
            None => {
                let found =
                    with_bar("maps", map::STEPS as u64, |done| Findings::compute(&|| done(1)))?;
                Ok(self.findings.get_or_init(|| found))
            }
        }
    }
}
