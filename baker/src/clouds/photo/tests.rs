//! Pictures that are hardly pictures: grey, of one tint, of two values, nearly constant.

use super::cloudiness::{DARK, colourfulness};
use super::part::cut;
use super::*;
use crate::stream::Stream;

const SIZE: u32 = 64;

fn settings() -> PhotoSettings {
    PhotoSettings {
        size: SIZE,
        mean: Some(0.16),
        ..PhotoSettings::default()
    }
}

/// A picture from a function that gives red, green and blue at a texel, as bytes would hold them.
fn picture(side: u32, colour: impl Fn(u32, u32) -> [f32; 3]) -> Image {
    let mut image = Image::new(side, side, 3);
    for y in 0..side {
        for x in 0..side {
            let bytes = colour(x, y).map(|v| libm::roundf(v.clamp(0.0, 1.0) * 255.0) / 255.0);
            image.texel_mut(x, y).copy_from_slice(&bytes);
        }
    }
    image
}

/// Clouds of a few sizes, 0..1.
fn clouds(x: u32, y: u32) -> f32 {
    let wave = |a: f32, b: f32, phase: f32| libm::sinf(a * x as f32 + b * y as f32 + phase);
    0.5 + 0.2 * wave(0.11, 0.03, 0.3) * wave(-0.02, 0.13, 1.0)
        + 0.12 * wave(0.31, 0.23, 2.0)
        + 0.06 * wave(-0.5, 0.77, 0.7)
}

/// Every value a millionth off, here up and there down: a tenth of what a byte rounds to is a thousand times more.
fn nudged(picture: &Image) -> Image {
    let mut stream = Stream::new(5, "nudge");
    let mut nudged = picture.clone();
    for value in &mut nudged.texels {
        *value *= 1.0 + 1e-6 * (stream.unit() as f32 - 0.5);
    }
    nudged
}

fn made(picture: &Image) -> Result<Image, BakeError> {
    made_with(picture, &settings())
}

fn made_with(picture: &Image, settings: &PhotoSettings) -> Result<Image, BakeError> {
    let photograph = Photograph {
        colours: picture.clone(),
        cover: None,
    };
    tile(photograph, "p.png", settings).map(|tile| tile.channel)
}

/// Correlation of two images of one channel.
fn correlation(a: &Image, b: &Image) -> f64 {
    let mean = |image: &Image| image.mean_and_spread(0);
    let ((a_mean, a_spread), (b_mean, b_spread)) = (mean(a), mean(b));
    let products = a.texels.iter().zip(&b.texels);
    let sum: f64 = products
        .map(|(x, y)| f64::from((x - a_mean) * (y - b_mean)))
        .sum();
    sum / a.texels.len() as f64 / f64::from(a_spread * b_spread)
}

fn worst(a: &Image, b: &Image) -> f32 {
    let pairs = a.texels.iter().zip(&b.texels);
    pairs.map(|(x, y)| (x - y).abs()).fold(0.0, f32::max)
}

type Colour = Box<dyn Fn(u32, u32) -> [f32; 3]>;

/// Pictures without colours, without contrast, with hardly any of either.
fn hard_pictures() -> Vec<(String, Colour)> {
    let mut all: Vec<(String, Colour)> = Vec::new();
    for tint in [
        [1.0, 1.0, 1.0],
        [1.0, 0.8, 0.6],
        [0.6, 0.8, 1.0],
        [1.0, 0.5, 0.0],
        [0.0, 0.5, 1.0],
        [0.0, 1.0, 0.0],
    ] {
        for contrast in [1.0, 0.2, 0.02, 0.004, 0.0] {
            let name = format!("tint {tint:?} of contrast {contrast}");
            let colour = move |x, y| tint.map(|t| t * (0.5 + contrast * (clouds(x, y) - 0.5)));
            all.push((name, Box::new(colour)));
        }
    }
    for [low, high] in [
        [0.0, 1.0],
        [0.0, 1.0 / 255.0],
        [0.5, 0.5 + 2.0 / 255.0],
        [254.0 / 255.0, 1.0],
    ] {
        let two = move |is_high: bool| [if is_high { high } else { low }; 3];
        let name = |what: &str| format!("{what} of {low} and {high}");
        all.push((name("halves"), Box::new(move |x, _| two(x < 60))));
        all.push((name("checks"), Box::new(move |x, y| two((x + y) % 2 == 0))));
        all.push((
            name("tiles"),
            Box::new(move |x, y| two((x / 8 + y / 8) % 2 == 0)),
        ));
        all.push((
            name("clouds"),
            Box::new(move |x, y| two(clouds(x, y) > 0.5)),
        ));
        all.push((
            name("a spot"),
            Box::new(move |x, y| two(x / 4 == 9 && y / 4 == 9)),
        ));
        all.push((
            name("a hole"),
            Box::new(move |x, y| two(x / 4 != 9 || y / 4 != 9)),
        ));
    }
    let slope = |x: u32, y: u32| [x as f32 / 119.0, (x + y) as f32 / 238.0, y as f32 / 119.0];
    all.push(("a slope".to_string(), Box::new(slope)));
    all.push((
        "a grey slope".to_string(),
        Box::new(|x, _| [x as f32 / 119.0; 3]),
    ));
    all
}

/// Each picture with each of the settings that take another way.
fn hard_cases() -> impl Iterator<Item = ((String, Colour), (&'static str, PhotoSettings))> {
    (0..ways().len()).flat_map(|way| {
        let pictures = hard_pictures().into_iter();
        pictures.map(move |picture| (picture, ways().swap_remove(way)))
    })
}

fn ways() -> Vec<(&'static str, PhotoSettings)> {
    vec![
        ("usual", settings()),
        (
            "as it is",
            PhotoSettings {
                as_is: true,
                mean: None,
                ..settings()
            },
        ),
        (
            "as it is, of a mean",
            PhotoSettings {
                as_is: true,
                ..settings()
            },
        ),
        (
            "inverted, not flattened",
            PhotoSettings {
                invert: true,
                flatten: 0.0,
                ..settings()
            },
        ),
        (
            "levels, half flattened, sharp",
            PhotoSettings {
                levels: [0.4, 0.6],
                flatten: 0.5,
                sharpness: 8.0,
                ..settings()
            },
        ),
        (
            "cut",
            PhotoSettings {
                seam: PhotoSeam::Cut,
                ..settings()
            },
        ),
        (
            "soft",
            PhotoSettings {
                sharpness: 0.25,
                ..settings()
            },
        ),
    ]
}

/// Rounding is a ten-millionth: where a millionth of every value changes the channel, it shows rounding.
#[test]
fn no_picture_becomes_a_pattern_of_its_rounding() {
    let mut refused = 0;
    for ((name, colour), (set, settings)) in hard_cases() {
        let name = format!("{name}, {set}");
        let picture = picture(120, colour);
        let made = |picture| made_with(picture, &settings);
        match (made(&picture), made(&nudged(&picture))) {
            (Ok(channel), Ok(nudged)) => {
                assert!(
                    channel.texels.iter().all(|v| (0.0..=1.0).contains(v)),
                    "{name}"
                );
                let worst = worst(&channel, &nudged);
                assert!(worst < 0.01, "{name}: {worst}");
            }
            (Err(error), Err(_)) => {
                let text = error.to_string();
                assert!(
                    text.contains("contrast") && text.contains("choose a picture"),
                    "{text}"
                );
                refused += 1;
            }
            (one, other) => panic!("{name}: {one:?} but {other:?}"),
        }
    }
    assert!(refused > 5, "{refused}");
}

#[test]
fn a_grey_picture_gives_the_clouds_of_its_luminance() {
    for tint in [
        [1.0, 1.0, 1.0],
        [1.0, 0.9, 0.75],
        [0.8, 0.9, 1.0],
        [0.5, 0.75, 1.0],
    ] {
        let of = |x: u32, y: u32| tint.map(|t| t * clouds(x, y));
        let channel = made(&picture(120, of)).unwrap();
        // The middle of the tile, where nothing is blended: the working image is a quarter larger.
        let expected = filter::plane(SIZE, SIZE, |x, y| {
            let [x, y] = [x, y].map(|i| (i as f32 + 0.5) * 120.0 / 80.0);
            clouds(x as u32, y as u32)
        });
        let inner = |image: &Image| filter::plane(40, 40, |x, y| image.texel(x + 20, y + 20)[0]);
        let alike = correlation(&inner(&channel), &inner(&expected));
        assert!(alike > 0.6, "{tint:?}: {alike}");
    }
}

/// In a sky of blue and white the ratio counts as it always did: grey clouds on blue are where red is.
#[test]
fn a_sky_of_colours_still_goes_by_its_ratio() {
    let sky = |x: u32, y: u32| {
        let cloud = clouds(x, y);
        [cloud, 0.5 + 0.5 * cloud, 1.0]
    };
    let picture = picture(120, sky);
    let [red, blue] = [0, 2].map(|c| cut(&picture, [0, 0, 120, 120], c));
    let ratio = filter::plane(120, 120, |x, y| {
        let i = red.index(x, y);
        (red.texels[i] + DARK) / (blue.texels[i] + DARK)
    });
    assert_eq!(colourfulness(&red, &blue, &ratio), 1.0);
}
