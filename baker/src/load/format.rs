//! What a file is, by its first bytes, and what is said of those that are not read.

use image::ImageFormat;

use super::hdr;
use crate::error::{BakeError, unfit};

/// How a photograph may be stored, for messages.
pub(crate) const PHOTOGRAPHS: &str = "a PNG, JPEG, TIFF, WebP, Radiance HDR or OpenEXR file";

/// A format of photographs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Format {
    /// Read by the crate `image`: values as they are stored.
    Stored(ImageFormat),
    /// Radiance HDR: light.
    Hdr,
    /// OpenEXR: light.
    Exr,
}

/// Formats that are known by name and not read: where their mark is in the file, the mark, the name, and what to do.
/// RFC and ISO numbers of the marks: AVIF 1.1, section 6; ISO/IEC 23008-12, annex B; ISO/IEC 18181-2; ISO/IEC 15444-1, annex I.
const OTHERS: [(usize, &[u8], &str); 22] = [
    (4, b"ftypavi", "AVIF"),
    (4, b"ftyphei", "HEIC"),
    (4, b"ftyphev", "HEIC"),
    (4, b"ftypmif1", "HEIC"),
    (4, b"ftypmsf1", "HEIC"),
    (4, b"ftypcrx", "a camera's raw file"),
    (0, b"II*\0\x10\0\0\0CR", "a camera's raw file"),
    (0, b"IIU\0", "a camera's raw file"),
    (0, b"IIRO", "a camera's raw file"),
    (0, b"FUJIFILMCCD-RAW", "a camera's raw file"),
    (4, b"ftyp", "a film"),
    (0, b"\x1a\x45\xdf\xa3", "a film"),
    (0, b"\xff\x0a", "JPEG XL"),
    (0, b"\0\0\0\x0cJXL ", "JPEG XL"),
    (0, b"\0\0\0\x0cjP  ", "JPEG 2000"),
    (0, b"GIF8", "GIF"),
    (0, b"BM", "BMP"),
    (0, b"8BPS", "Photoshop"),
    (0, b"gimp xcf", "GIMP"),
    (0, b"DDS ", "DDS"),
    (0, b"\xabKTX ", "KTX"),
    (0, b"%PDF", "PDF"),
];

/// The format of a photograph; an error names what else it is.
pub(super) fn of_photograph(bytes: &[u8], file: &str) -> Result<Format, BakeError> {
    if bytes.is_empty() {
        return Err(unfit(file, "length", "0 bytes", PHOTOGRAPHS));
    }
    if let Some(name) = other(bytes) {
        let expected = format!("{PHOTOGRAPHS}; convert it, best to PNG");
        return Err(unfit(file, "format", name, expected));
    }
    match image::guess_format(bytes) {
        Ok(format @ (ImageFormat::Png | ImageFormat::Jpeg)) => Ok(Format::Stored(format)),
        Ok(format @ (ImageFormat::Tiff | ImageFormat::WebP)) if cfg!(feature = "formats") => {
            Ok(Format::Stored(format))
        }
        Ok(format @ (ImageFormat::Tiff | ImageFormat::WebP)) => {
            let found = format!("{format:?}, which this program was built without");
            let expected = "a PNG, JPEG, Radiance HDR or OpenEXR file; convert it, best to PNG";
            Err(unfit(file, "format", found, expected))
        }
        Ok(ImageFormat::OpenExr) => Ok(Format::Exr),
        _ if hdr::is_hdr(bytes) => Ok(Format::Hdr),
        _ => {
            let expected = format!("{PHOTOGRAPHS}; convert it, best to PNG");
            Err(unfit(file, "format", "unknown", expected))
        }
    }
}

fn other(bytes: &[u8]) -> Option<&'static str> {
    let is = |at: usize, mark: &[u8]| bytes.get(at..).is_some_and(|rest| rest.starts_with(mark));
    let found = OTHERS.iter().find(|(at, mark, _)| is(*at, mark));
    found.map(|(_, _, name)| *name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_read_is_told_by_its_name() {
        let cases: [(&[u8], &str); 9] = [
            (b"\0\0\0\x1cftypavif\0\0\0\0avifmif1", "AVIF"),
            (b"\0\0\0\x18ftypheic\0\0\0\0mif1heic", "HEIC"),
            (b"\0\0\0\x18ftypmif1\0\0\0\0mif1heic", "HEIC"),
            (b"\0\0\0\x18ftypisom", "a film"),
            (b"GIF89a\x01\0\x01\0", "GIF"),
            (b"BM\x36\0\0\0", "BMP"),
            (b"\xff\x0a\xfa\x1f", "JPEG XL"),
            (b"II*\0\x10\0\0\0CR\x02\0", "a camera's raw file"),
            (b"these are not pixels", "unknown"),
        ];
        for (bytes, name) in cases {
            let error = of_photograph(bytes, "a.jpg").unwrap_err().to_string();
            let begin = format!("a.jpg: format is {name}, expected a PNG, JPEG");
            assert!(error.starts_with(&begin), "{error}");
            assert!(error.contains("convert it"), "{error}");
        }
    }
}
