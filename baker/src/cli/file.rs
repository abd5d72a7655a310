//! One picture as a file: where it may be, and how it is written.

use std::path::Path;

use anyhow::{Result, bail};
use welkin_pack::place::verify_apart;
use welkin_pack::whole::{sweep_beside, write_file};

use super::{interrupt, output};

/// Before anything slow begins: that the name says the format, and that nothing that is read is written over.
pub fn verify_png(file: &Path, input: &Path) -> Result<()> {
    verify_png_name(file)?;
    Ok(verify_apart(&[input], &[file])?)
}

/// That the name says the format.
pub fn verify_png_name(file: &Path) -> Result<()> {
    let ending = file.extension().and_then(|e| e.to_str());
    if !ending.is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        bail!(
            "{}: would be a PNG file; choose a name that ends in .png",
            file.display()
        );
    }
    Ok(())
}

/// Writes the file.
pub fn write(file: &Path, bytes: &[u8]) -> Result<()> {
    let leftovers = sweep_beside(file);
    write_file(file, bytes, &interrupt::requested)?;
    output::leftovers(leftovers);
    Ok(())
}
