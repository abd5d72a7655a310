//! Random recipes: every key over its whole range, its ends often, textures small for the most part.

use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A recipe as lines of TOML, each of which may be left out.
pub struct Draw {
    stream: Xoshiro256PlusPlus,
    lines: Vec<String>,
}

const KINDS: [&str; 7] = [
    "cumulus",
    "congestus",
    "cumulonimbus",
    "stratus",
    "stratocumulus",
    "altocumulus",
    "cirrus",
];

/// How often a key is given.
const GIVEN: f64 = 0.5;

impl Draw {
    /// Recipe number `number`.
    pub fn recipe(number: u64) -> Vec<String> {
        let mut draw = Draw {
            stream: Xoshiro256PlusPlus::seed_from_u64(number),
            lines: Vec::new(),
        };
        draw.line(format!("seed = {}", draw_seed(number)));
        draw.clouds();
        draw.night();
        draw.day();
        draw.methods();
        draw.layers();
        draw.sprites();
        draw.field();
        draw.lines
    }

    fn clouds(&mut self) {
        let size = self.size("clouds.size", 64, 4096);
        let format = self.one_of(&["rgba8unorm", "rgba16float"]);
        self.maybe("clouds.format", |_| format!("\"{format}\""));
        // The built-in photograph takes longer to read than all else takes to bake.
        if self.chance(0.9) {
            let file = self.one_of(&super::pictures::PHOTOS);
            self.line(format!("clouds.photo.file = \"{file}\""));
        }
        // Some are beyond what is legal, and so are some that are legal alone but not with the other.
        let [thinnest, thickest] = if self.chance(0.05) {
            [0.0, 1.0]
        } else {
            [0.05, 0.68]
        };
        self.real("clouds.photo.mean", thinnest, thickest);
        for table in ["clouds.noise", "clouds.detail"] {
            self.integer(&format!("{table}.cells"), 1, size / 8);
            self.integer(&format!("{table}.octaves"), 1, 10);
            self.real(&format!("{table}.gain"), 0.0, 1.0);
            if table == "clouds.noise" {
                self.real("clouds.noise.mean", thinnest, thickest);
            } else {
                self.real("clouds.detail.mean", 0.02, 0.8);
            }
        }
        self.real("clouds.gradient.power", 1.0, 2.0);
    }

    fn night(&mut self) {
        let size = self.size("stars.size", 64, 1024);
        let count = self.integer_of(1, size * size / 32);
        self.line(format!("stars.count = {count}"));
        self.real("stars.magnitudes", 0.5, 5.0);
        self.real("stars.brightest", 0.8, 1.0);
        self.size("galaxy.size", 32, 1024);
        self.real("galaxy.tilt_deg", 0.0, 90.0);
        self.real("galaxy.azimuth_deg", 0.0, 360.0);
        self.real("galaxy.dust", 0.0, 1.0);
    }

    fn day(&mut self) {
        self.size("sky.width", 16, 64);
        self.size("sky.height", 32, 64);
        self.integer("sky.suns", 16, 64);
        let haze = self.number(0.0, 10.0);
        self.line(format!("sky.haze = {haze}"));
        // Now and then no more than the haze, which is refused.
        let least = if self.chance(0.1) { 0.1 } else { haze.max(0.1) };
        self.real("sky.most_haze", least, 40.0);
        self.size("sun.size", 16, 1024);
        self.real("sun.noon_elevation_deg", 5.0, 90.0);
    }

    fn methods(&mut self) {
        let size = self.size("fbm.size", 64, 1024);
        let cells = 4 << self.integer_of(0, (size / 2 / 4).ilog2());
        let most = ((size / 2) / cells).ilog2() + 1;
        self.line(format!("fbm.cells = {cells}"));
        self.integer("fbm.octaves", 1, most.min(8));
        self.size("flares.size", 64, 1024);
    }

    fn layers(&mut self) {
        let size = self.size("layers.size", 64, 1024);
        for (kind, least_cell) in [("stratocumulus", 8), ("cumulus", 16), ("cirrus", 24)] {
            let key = |name: &str| format!("layers.{kind}.{name}");
            self.integer(&key("cells"), 2, size / least_cell);
            self.integer(&key("octaves"), 1, 8);
            self.real(&key("gain"), 0.0, 1.0);
            self.real(&key("relief"), 0.1, 2.0);
        }
    }

    fn sprites(&mut self) {
        self.size("sprites.size", 128, 2048);
        self.real("sprites.contrast", 0.0, 2.0);
        if self.chance(0.75) {
            self.line(format!("sprites.file = \"{}\"", super::pictures::SHEET));
            return;
        }
        self.real("sprites.detail", 0.0, 1.5);
        self.real("sprites.softness", 0.5, 3.0);
    }

    fn field(&mut self) {
        let sections = self.integer_of(0, 2);
        self.line(format!("field.sections = {sections}"));
        self.maybe("field.most_sprites", |_| "65536".to_string());
        if self.chance(0.6) {
            let layers = self.integer_of(1, 3);
            let layers: Vec<String> = (0..layers).map(|_| self.cloud_layer()).collect();
            self.line(format!("field.clouds = [{}]", layers.join(", ")));
        }
        if self.chance(0.3) {
            let models = self.integer_of(1, 2);
            let models: Vec<String> = (0..models).map(|_| self.model()).collect();
            self.line(format!("field.models = [{}]", models.join(", ")));
        }
        if self.chance(0.3) {
            let mut times: Vec<f64> = (0..self.integer_of(1, 12))
                .map(|_| self.number(0.0, 0.999_99))
                .collect();
            times.sort_by(f64::total_cmp);
            times.dedup();
            let hours: Vec<String> = times.into_iter().map(|time| self.hour(time)).collect();
            self.line(format!("field.hours = [{}]", hours.join(", ")));
        }
    }

    fn cloud_layer(&mut self) -> String {
        let kind = self.one_of(&KINDS);
        let cover = self.number(0.0, 1.0);
        let mut keys = format!("kind = \"{kind}\", cover = {cover}");
        if self.chance(GIVEN) {
            let base = self.number(0.0, 20_000.0);
            let top = self.number((base + 50.01).min(20_050.0), 20_050.0);
            keys += &format!(", base_m = {base}, top_m = {top}");
        }
        keys += &self.some("density", 0.25, 4.0);
        keys += &self.some("cull", 0.05, 1.0);
        if self.chance(0.3) {
            keys += &format!(", levels = {}", self.levels());
        }
        format!("{{ {keys} }}")
    }

    fn model(&mut self) -> String {
        let kind = self.one_of(&KINDS);
        let boxes = self.integer_of(1, 5);
        let boxes: Vec<String> = (0..boxes).map(|_| self.cloud_box()).collect();
        let mut keys = format!("kind = \"{kind}\", boxes = [{}]", boxes.join(", "));
        keys += &format!(", copies = {}", self.integer_of(1, 8));
        keys += &self.some("base_m", 0.0, 20_000.0);
        keys += &self.some("rank", 0.0, 1.0);
        format!("{{ {keys} }}")
    }

    fn cloud_box(&mut self) -> String {
        let lists = |draw: &mut Draw, least, most| {
            [(); 3]
                .map(|()| draw.number(least, most).to_string())
                .join(", ")
        };
        let place = lists(self, -20_000.0, 20_000.0);
        let size = lists(self, 1.0, 20_000.0);
        let mut keys = format!("centre_m = [{place}], size_m = [{size}]");
        keys += &format!(", sprites = {}", self.integer_of(1, 100));
        for (key, least, most) in [
            ("width_m", 1.0, 10_000.0),
            ("height_m", 1.0, 10_000.0),
            ("rotation_deg", -180.0, 180.0),
        ] {
            if self.chance(GIVEN) {
                let first = self.number(least, most);
                let second = self.number(first, most);
                keys += &format!(", {key} = [{first}, {second}]");
            }
        }
        keys += &self.some("cull", 0.0, 1.0);
        keys += &format!(", group = {}", self.integer_of(0, 9999));
        let category = self.one_of(&["stratus", "cumulus", "wispy"]);
        keys += &format!(
            ", category = \"{category}\", flat_bottom = {}",
            self.chance(0.5)
        );
        format!("{{ {keys} }}")
    }

    fn hour(&mut self, time: f64) -> String {
        let colour = [(); 3].map(|()| self.number(0.0, 16.0).to_string());
        let mut keys = format!("time = {time}, colour = [{}]", colour.join(", "));
        keys += &self.some("ambient", 0.0, 1.0);
        let least = self.number(0.0, 1.0);
        keys += &format!(", least = {least}, most = {}", self.number(least, 1.0));
        format!("{{ {keys} }}")
    }

    fn levels(&mut self) -> String {
        let mut heights = [(); 5].map(|()| self.number(0.0, 1.0));
        heights.sort_by(f64::total_cmp);
        let levels = heights.map(|height| {
            let colour = [(); 3].map(|()| self.number(0.0, 16.0).to_string());
            format!(
                "[{height}, {}, {}]",
                colour.join(", "),
                self.number(0.0, 1.0)
            )
        });
        format!("[{}]", levels.join(", "))
    }

    /// A power of two, each half as likely a quarter as often as the one below: sizes cost by their square.
    fn size(&mut self, key: &str, least: u32, most: u32) -> u32 {
        let mut size = least;
        while size < most && self.chance(0.25) {
            size *= 2;
        }
        self.line(format!("{key} = {size}"));
        size
    }

    fn integer(&mut self, key: &str, least: u32, most: u32) {
        self.maybe(key, |draw| draw.integer_of(least, most).to_string());
    }

    fn real(&mut self, key: &str, least: f64, most: f64) {
        self.maybe(key, |draw| draw.number(least, most).to_string());
    }

    /// `, key = number` or nothing.
    fn some(&mut self, key: &str, least: f64, most: f64) -> String {
        if self.chance(GIVEN) {
            format!(", {key} = {}", self.number(least, most))
        } else {
            String::new()
        }
    }

    fn maybe(&mut self, key: &str, value: impl FnOnce(&mut Draw) -> String) {
        if self.chance(GIVEN) {
            let value = value(self);
            self.line(format!("{key} = {value}"));
        }
    }

    fn line(&mut self, line: String) {
        self.lines.push(line);
    }

    /// Even over the range; one in eight is its least, one in eight its greatest, and of what has many powers of two,
    /// one in four is even over those.
    fn number(&mut self, least: f64, most: f64) -> f64 {
        match self.stream.next_u64() % 8 {
            0 => least,
            1 => most,
            2 | 3 if least > 0.0 => {
                let power = self.unit();
                (least * libm::pow(most / least, power)).clamp(least, most)
            }
            _ => least + (most - least) * self.unit(),
        }
    }

    fn integer_of(&mut self, least: u32, most: u32) -> u32 {
        let number = self.number(f64::from(least), f64::from(most) + 0.999);
        (number as u32).clamp(least, most)
    }

    fn one_of<'a>(&mut self, names: &[&'a str]) -> &'a str {
        names[(self.stream.next_u64() % names.len() as u64) as usize]
    }

    fn chance(&mut self, share: f64) -> bool {
        self.unit() < share
    }

    fn unit(&mut self) -> f64 {
        (self.stream.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// A seed that a recipe can name, other than the number that its keys are drawn from.
fn draw_seed(number: u64) -> u64 {
    number.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 1
}
