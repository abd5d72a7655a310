//! OpenEXR: the first part with channels R, G and B, and A if it has one.

use std::io::Cursor;

use exr::error::Error;
use exr::meta::MetaData;
use exr::meta::attribute::Chromaticities;
use exr::meta::header::Header;
use exr::prelude::{ReadChannels, ReadLayers, read};
use welkin_pack::Image;

use super::primaries;
use crate::error::{BakeError, unfit};

/// Red, green and blue times alpha, as the format stores them, and alpha.
pub(super) fn decode(
    bytes: &[u8],
    file: &str,
    fits: &dyn Fn(u32, u32) -> Result<(), BakeError>,
) -> Result<Image, BakeError> {
    let failed = |error| failed(file, error);
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(failed)?;
    let Some(header) = meta.headers.iter().find(|header| has_colours(header)) else {
        return Err(unfit(
            file,
            "channels",
            channel_names(&meta.headers),
            "R, G and B, and A if it has cover; save it as RGB",
        ));
    };
    verify(header, file)?;
    fits(header.layer_size.x() as u32, header.layer_size.y() as u32)?;
    let picture = read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| Image::new(size.x() as u32, size.y() as u32, 4),
            |image: &mut Image, place, (r, g, b, a): (f32, f32, f32, f32)| {
                let texel = image.texel_mut(place.x() as u32, place.y() as u32);
                texel.copy_from_slice(&[r, g, b, a]);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(failed)?;
    Ok(picture.layer_data.channel_data.pixels)
}

/// An error of the decoder.
pub(super) fn failed(file: &str, error: Error) -> BakeError {
    let found = match error {
        Error::NotSupported(what) => format!("not supported ({what})"),
        Error::Io(e) => format!("broken ({e})"),
        Error::Invalid(what) => format!("broken ({what})"),
        Error::Aborted => "broken".to_string(),
    };
    let expected = "a whole OpenEXR file, best with ZIP compression; save or copy it again";
    unfit(file, "content", found, expected)
}

fn has_colours(header: &Header) -> bool {
    let has = |name: &str| header.channels.list.iter().any(|c| c.name.eq(name));
    !header.deep && ["R", "G", "B"].into_iter().all(has)
}

pub(super) fn channel_names(headers: &[Header]) -> String {
    const MOST: usize = 8;
    let names = headers.iter().flat_map(|header| &header.channels.list);
    let mut names: Vec<String> = names.take(MOST + 1).map(|c| c.name.to_string()).collect();
    if names.len() > MOST {
        names[MOST] = "...".to_string();
    }
    names.join(", ")
}

/// Refuses what would come out wrong without a word: a part of a picture, and other primaries.
pub(super) fn verify(header: &Header, file: &str) -> Result<(), BakeError> {
    let shared = &header.shared_attributes;
    let window = shared.display_window;
    let (size, place) = (header.layer_size, header.own_attributes.layer_position);
    if (size, place) != (window.size, window.position) {
        return Err(unfit(
            file,
            "data window",
            format!("{}x{} at {}, {}", size.x(), size.y(), place.x(), place.y()),
            format!(
                "the whole display window, {}x{} at {}, {}; save it without cropping",
                window.size.x(),
                window.size.y(),
                window.position.x(),
                window.position.y()
            ),
        ));
    }
    match &shared.chromaticities {
        Some(found) => primaries::verify(&numbers(found), file, "chromaticities"),
        None => Ok(()),
    }
}

fn numbers(c: &Chromaticities) -> [[f32; 2]; 4] {
    [c.red, c.green, c.blue, c.white].map(|xy| [xy.x(), xy.y()])
}
