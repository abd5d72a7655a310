//! The table of the clear sky as pictures: the sky at some hours, and every image of a channel on one sheet.

use welkin_pack::air::aureole_phase;
use welkin_pack::mapping::{
    SKY_HAZES, SKY_PARTS, SkyLayer, layer_to_sun, sky_to_texel, sun_to_layer,
};
use welkin_pack::{Image, Texture};

/// Elevations of the sun whose skies are shown, in degrees: noon, evening, the belt of Venus, nautical dusk.
const SHOWN_DEG: [f32; 4] = [60.0, 10.0, -3.0, -9.0];

/// Pixels a row: a turn, the sun in the middle. Rows: horizon to zenith.
const SIZE: [u32; 2] = [192, 48];

/// A sky as it looks, unrolled.
pub struct Look {
    /// Elevation of the sun, in degrees.
    pub sun_deg: f32,
    /// Radiance, the zenith on top and the sun's azimuth in the middle.
    pub image: Image,
}

impl Look {
    /// What the picture shows, in a line.
    pub fn caption(&self) -> String {
        format!(
            "sun at {:.0}\u{b0}, in the middle; zenith on top",
            self.sun_deg
        )
    }
}

/// The clear sky of the table's suns that are nearest to some.
pub fn looks(texture: &Texture) -> Vec<Look> {
    let suns = suns(texture);
    let layer = |degrees: f32| sun_to_layer(degrees.to_radians(), suns).round();
    SHOWN_DEG
        .map(|degrees| look(texture, layer(degrees), suns))
        .into()
}

fn look(texture: &Texture, sun: f32, suns: u32) -> Look {
    let sun_rad = layer_to_sun(sun, suns);
    let part = |part| {
        let layer = SkyLayer {
            haze: 0,
            sun: sun as u32,
            part,
        };
        texture.image(0, layer.index(suns))
    };
    let parts = [part(0), part(1)];
    let [width, height] = SIZE;
    let mut image = Image::new(width, height, 4);
    for y in 0..height {
        let elevation = std::f32::consts::FRAC_PI_2 * (1.0 - (y as f32 + 0.5) / height as f32);
        for x in 0..width {
            let azimuth = std::f32::consts::TAU * ((x as f32 + 0.5) / width as f32 - 0.5);
            let (sine, azimuth_cos) = (libm::sinf(elevation), libm::cosf(azimuth));
            let cosine = sine * libm::sinf(sun_rad)
                + libm::cosf(elevation) * libm::cosf(sun_rad) * azimuth_cos;
            let at = sky_to_texel(sine, azimuth_cos, [texture.width, texture.height]);
            let [rest, aureole] = [0, 1].map(|part: usize| between(&parts[part], at));
            let phase = aureole_phase(cosine.clamp(-1.0, 1.0));
            for (channel, value) in image.texel_mut(x, y).iter_mut().take(3).enumerate() {
                *value = rest[channel] + aureole[channel] * phase;
            }
        }
    }
    Look {
        sun_deg: sun_rad.to_degrees(),
        image,
    }
}

/// Bilinearly between texel centres.
fn between(image: &Image, [u, v]: [f32; 2]) -> [f32; 3] {
    let split = |at: f32, side: u32| {
        let low = (at as u32).min(side - 2);
        (low, at - low as f32)
    };
    let ((x, a), (y, b)) = (split(u, image.width), split(v, image.height));
    std::array::from_fn(|channel| {
        let row = |y| {
            let [left, right] = [x, x + 1].map(|x| image.texel(x, y)[channel]);
            left + (right - left) * a
        };
        row(y) + (row(y + 1) - row(y)) * b
    })
}

/// Every image of a channel: the suns from left to right, the zenith on top; below the first part the second, then those of the second haze.
pub fn sheet(texture: &Texture, channel: usize) -> Image {
    let (suns, width, height) = (suns(texture), texture.width, texture.height);
    let mut sheet = Image::new(width * suns, height * SKY_HAZES * SKY_PARTS, 1);
    let stacked = texture.stacked(0);
    for layer in 0..texture.layers {
        let (part, sun, haze) = (
            layer % SKY_PARTS,
            layer / SKY_PARTS % suns,
            layer / SKY_PARTS / suns,
        );
        let (left, top) = (sun * width, (haze * SKY_PARTS + part) * height);
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            let from = stacked.texel(x, layer * height + height - 1 - y);
            sheet.texel_mut(left + x, top + y)[0] = from[channel];
        }
    }
    sheet
}

fn suns(texture: &Texture) -> u32 {
    texture.layers / (SKY_HAZES * SKY_PARTS)
}

#[cfg(test)]
mod tests {
    use welkin_pack::{Format, Shape};

    use super::*;

    /// A table of 16 suns, each texel of which holds its layer, column and row.
    fn numbered() -> Texture {
        let (width, height, layers) = (8, 16, 64);
        let mut values = Vec::new();
        for layer in 0..layers {
            for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
                values.extend([layer as f32, x as f32, y as f32, 0.0]);
            }
        }
        Texture {
            format: Format::Rgba16Float,
            shape: Shape::Array,
            width,
            height,
            layers,
            levels: vec![welkin_pack::texture::encode(Format::Rgba16Float, &values)],
        }
    }

    #[test]
    fn a_sheet_has_every_image_once() {
        let [layers, rows] = [0, 2].map(|channel| sheet(&numbered(), channel));
        assert_eq!([layers.width, layers.height], [8 * 16, 16 * 4]);
        for haze in 0..2 {
            for (sun, part) in (0..16).flat_map(|sun| (0..2).map(move |part| (sun, part))) {
                let (x, y) = (sun * 8 + 3, (haze * 2 + part) * 16);
                let layer = SkyLayer { haze, sun, part }.index(16);
                assert_eq!(layers.texel(x, y), [layer as f32]);
                assert_eq!([rows.texel(x, y)[0], rows.texel(x, y + 15)[0]], [15.0, 0.0]);
            }
        }
    }

    #[test]
    fn a_look_has_the_zenith_on_top_and_the_sun_in_the_middle() {
        let looks = looks(&numbered());
        assert_eq!(looks.len(), SHOWN_DEG.len());
        for (look, wanted) in looks.iter().zip(SHOWN_DEG) {
            // Half of the 16 degrees between two suns of so few at noon.
            assert!((look.sun_deg - wanted).abs() < 14.0, "{}", look.sun_deg);
            let image = &look.image;
            // Columns grow from the sun's azimuth both ways, rows upwards; both parts add to them.
            let at = |x: u32, y: u32, channel: usize| image.texel(x, y)[channel];
            let [width, height] = SIZE;
            assert!(at(0, height - 1, 1) > 3.0 * at(width / 2, height - 1, 1));
            assert_eq!(at(10, 20, 1), at(width - 11, 20, 1));
            assert!(at(0, 0, 2) > 5.0 * at(0, height - 1, 2));
        }
    }
}
