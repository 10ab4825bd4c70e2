//! What an image takes of the target's memory.

use std::fs;
use std::path::Path;

use object::elf::{SHF_ALLOC, SHF_WRITE};
use object::read::elf::ElfFile32;
use object::{Object, ObjectSection, SectionFlags, SectionKind};

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
/// The file is missing or not an image for the target.
pub fn footprint(image: &Path) -> Result<Footprint, String> {
    let name = image.display();
    let bytes = fs::read(image).map_err(|error| format!("{name}: {error}"))?;
    let elf: ElfFile32<'_> =
        ElfFile32::parse(&*bytes).map_err(|error| format!("{name}: {error}"))?;
    let mut footprint = Footprint { flash: 0, ram: 0 };
    for section in elf.sections() {
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
