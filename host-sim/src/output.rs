//! Files are written whole or not at all.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use crate::error::Error;

/// Writes `path` through a temporary file beside it, which takes its name once it is complete.
/// Missing folders are made.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    let refuse = |cause: io::Error| {
        Error::file(path, format_args!("{cause}; accepted is a path that can be written"))
    };
    if path.is_dir() || path.file_name().is_none() {
        return Err(Error::file(path, "is a folder; accepted is a file's path"));
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(refuse)?;
    let mut builder = tempfile::Builder::new();
    readable(&mut builder);
    let file = builder.tempfile_in(folder).map_err(refuse)?;
    let mut buffered = BufWriter::new(file);
    write(&mut buffered).map_err(refuse)?;
    let file = buffered.into_inner().map_err(|error| refuse(error.into_error()))?;
    file.persist(path).map_err(|error| refuse(error.error))?;
    Ok(())
}

/// A temporary file is private; what takes its place should be readable as other files are.
#[cfg(unix)]
fn readable(builder: &mut tempfile::Builder<'_, '_>) {
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(std::fs::Permissions::from_mode(0o666));
}

#[cfg(not(unix))]
fn readable(_: &mut tempfile::Builder<'_, '_>) {}
