//! Writes files whole or not at all. Files that belong together appear together.

use std::fs::OpenOptions;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::error::Error;

/// Writes one file. See [`Files`].
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    let mut files = Files::default();
    files.add(path, write)?;
    files.finish().map(drop)
}

/// Files that appear together, once all of them are complete.
///
/// Until then each file stands under a temporary name beside its place. If anything fails, it is
/// removed, with the folders that were made for it. A path that is not a file, such as
/// `/dev/stdout` or a pipe, is written into and not replaced. A link leads to the file that it
/// names.
#[derive(Default)]
pub struct Files {
    ready: Vec<(PathBuf, Ready)>,
    /// Folders that were created, outer ones first.
    folders: Vec<PathBuf>,
}

/// The complete content of a file.
enum Ready {
    /// A temporary file that takes the file's place.
    Beside(NamedTempFile),
    /// Bytes to be written into the existing path.
    Bytes(Vec<u8>),
}

impl Files {
    /// Prepares a file.
    pub fn add(
        &mut self,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Error> {
        let ready = match self.prepare(path, write) {
            Ok(ready) => ready,
            Err(Fault::Folder) => {
                return Err(Error::file(path, "is a folder; must be a file's path"));
            }
            Err(Fault::Io(cause)) => return Err(refusal(path, &cause)),
        };
        self.ready.push((path.to_owned(), ready));
        Ok(())
    }

    /// Gives every file its name and returns the names, in the order in which they were added.
    pub fn finish(mut self) -> Result<Vec<PathBuf>, Error> {
        let mut names = Vec::with_capacity(self.ready.len());
        for (path, ready) in self.ready.drain(..) {
            match ready {
                Ready::Beside(file) => place_of(&path)
                    .and_then(|place| file.persist(place).map(drop).map_err(|e| e.error)),
                Ready::Bytes(bytes) => {
                    OpenOptions::new().write(true).open(&path).and_then(|mut f| f.write_all(&bytes))
                }
            }
            .map_err(|cause| refusal(&path, &cause))?;
            names.push(path);
        }
        self.folders.clear();
        Ok(names)
    }

    fn prepare(
        &mut self,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<Ready, Fault> {
        if path.is_dir() || path.file_name().is_none() {
            return Err(Fault::Folder);
        }
        let there = std::fs::metadata(path).ok();
        if there.as_ref().is_some_and(|there| !there.is_file()) {
            let mut bytes = Vec::new();
            write(&mut bytes)?;
            return Ok(Ready::Bytes(bytes));
        }
        let place = place_of(path)?;
        if there.is_some() {
            // A file that must not be written must not be replaced either.
            OpenOptions::new().write(true).open(&place)?;
        }
        let folder = place.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        self.make(folder)?;
        let name = place.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let prefix = format!(".{name}.");
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(".part");
        readable(&mut builder);
        let mut buffered = BufWriter::new(builder.tempfile_in(folder)?);
        write(&mut buffered)?;
        let file = buffered.into_inner().map_err(|error| error.into_error())?;
        // Some file systems find out only now that they are full.
        file.as_file().sync_data()?;
        if let Some(there) = there {
            file.as_file().set_permissions(there.permissions())?;
        }
        Ok(Ready::Beside(file))
    }

    /// Creates a folder and those around it, and records the ones that were missing.
    fn make(&mut self, folder: &Path) -> io::Result<()> {
        let missing: Vec<&Path> = folder
            .ancestors()
            .filter(|path| !path.as_os_str().is_empty())
            .take_while(|path| !path.exists())
            .collect();
        for path in missing.into_iter().rev() {
            std::fs::create_dir(path)?;
            self.folders.push(path.to_owned());
        }
        // Says what is wrong where it is none.
        std::fs::create_dir_all(folder)
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        // What is in a folder goes before it.
        self.ready.clear();
        for folder in self.folders.iter().rev() {
            // Somebody may have put something there: then it stays.
            let _ = std::fs::remove_dir(folder);
        }
    }
}

enum Fault {
    Folder,
    Io(io::Error),
}

impl From<io::Error> for Fault {
    fn from(cause: io::Error) -> Self {
        Self::Io(cause)
    }
}

/// Returns the error of a path that cannot be written, in one line.
pub fn refusal(path: &Path, cause: &io::Error) -> Error {
    let wanted = match cause.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "a disk with room for it",
        _ => "a path that can be written",
    };
    Error::file(path, format_args!("{cause}; must be {wanted}"))
}

/// Returns the place of the file. A link is followed, because its own name must not be replaced.
fn place_of(path: &Path) -> io::Result<PathBuf> {
    match std::fs::symlink_metadata(path) {
        Ok(there) if there.is_symlink() => std::fs::canonicalize(path),
        _ => Ok(path.to_owned()),
    }
}

/// A temporary file is private; what takes its place should be readable as other files are.
#[cfg(unix)]
fn readable(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(std::fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn readable(_: &mut tempfile::Builder<'_, '_>) {}
