//! A whole path at once: checked, or as segments.

use super::{Path, RowError, Waypoint};
use crate::motion::Segment;

impl Path {
    /// Checks rows without a generator: a path from here through all of them. Returns the path as
    /// it is at the end: its ticks and its peaks. It takes no more memory than the path itself.
    ///
    /// # Errors
    /// The first row that [`Self::offer`] or a limit refuses.
    pub fn survey(&self, rows: impl IntoIterator<Item = Waypoint>) -> Result<Self, RowError> {
        let mut path = self.clone();
        let mut rows = rows.into_iter();
        while !path.is_done() {
            path.fill(&mut rows)?;
            while let Some(next) = path.next_piece()? {
                path.take(&next);
            }
        }
        Ok(path)
    }

    /// Returns the segments of a whole path, first to last, in f64: one a row, of
    /// [count](Segment::count) 0 where no tick lies before the next row.
    ///
    /// `rows` is an iterator over all rows. An item is the error of a row that is refused; nothing
    /// follows it.
    pub fn segments(
        self,
        rows: impl IntoIterator<Item = Waypoint>,
    ) -> impl Iterator<Item = Result<Segment<f64>, RowError>> {
        Segments { path: self, rows: rows.into_iter(), failed: false }
    }
}

/// See [`Path::segments`].
struct Segments<I> {
    path: Path,
    rows: I,
    failed: bool,
}

impl<I: Iterator<Item = Waypoint>> Iterator for Segments<I> {
    type Item = Result<Segment<f64>, RowError>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.failed {
            let next = self.path.fill(&mut self.rows).and_then(|()| self.path.next_piece());
            match next {
                Ok(Some(next)) => {
                    let segment = next.segment;
                    self.path.take(&next);
                    if let Some(segment) = segment {
                        return Some(Ok(segment));
                    }
                }
                Ok(None) => return None,
                Err(error) => {
                    self.failed = true;
                    return Some(Err(error));
                }
            }
        }
        None
    }
}
