//! Memory that an image takes on the target.

use std::fs;
use std::path::Path;

use object::elf::{SHF_ALLOC, SHF_WRITE};
use object::read::elf::ElfFile32;
use object::{Object, ObjectSection, ObjectSymbol, SectionFlags, SectionKind, SymbolKind};

/// Bytes of flash and RAM.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Footprint {
    /// Every loaded byte: vectors, code, constants, initial values of statics.
    pub flash: u64,
    /// Statics, stack left out.
    pub ram: u64,
}

/// Reads the sections of an ELF image.
///
/// # Errors
/// An error is returned if the file is missing or not an image for the target.
pub fn footprint(image: &Path) -> Result<Footprint, String> {
    let bytes = read(image)?;
    let mut footprint = Footprint { flash: 0, ram: 0 };
    for section in parse(image, &bytes)?.sections() {
        let SectionFlags::Elf { sh_flags, .. } = section.flags() else { continue };
        if sh_flags.0 & SHF_ALLOC.0 == 0 {
            continue;
        }
        if section.kind() != SectionKind::UninitializedData {
            footprint.flash += section.size();
        }
        if sh_flags.0 & SHF_WRITE.0 != 0 {
            footprint.ram += section.size();
        }
    }
    Ok(footprint)
}

/// Returns the names of the functions in an image, mangled.
///
/// # Errors
/// Errors are those of [`footprint`].
pub fn functions(image: &Path) -> Result<Vec<String>, String> {
    let bytes = read(image)?;
    let elf = parse(image, &bytes)?;
    let functions = elf.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text);
    Ok(functions.filter_map(|symbol| symbol.name().ok().map(str::to_owned)).collect())
}

fn read(image: &Path) -> Result<Vec<u8>, String> {
    fs::read(image).map_err(|error| format!("{}: {error}", image.display()))
}

fn parse<'a>(image: &Path, bytes: &'a [u8]) -> Result<ElfFile32<'a>, String> {
    ElfFile32::parse(bytes).map_err(|error| format!("{}: {error}", image.display()))
}
