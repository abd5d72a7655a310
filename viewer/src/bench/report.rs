//! What a benchmark prints: a table, or JSON.

use serde::Serialize;
use welkin_viewer::spread::Spread;

use super::scene::CAMERA_ELEVATION_DEG;

/// The pass that ratios are told of.
pub const FOUR_SAMPLES: &str = "four samples";

/// Everything that `--json` prints. The keys are those of docs/json.md.
#[derive(Debug, Serialize)]
pub struct Report {
    pub adapter: String,
    pub clock: &'static str,
    pub size: [u32; 2],
    pub frames: u32,
    pub warm_up_frames: u32,
    pub passes: Vec<Row>,
}

/// A row of the table. What a reference pass has not is `None`.
#[derive(Debug, PartialEq, Serialize)]
pub struct Row {
    pub name: String,
    pub method: Option<&'static str>,
    pub prepare_ms: Option<f64>,
    pub map_ms: Option<f64>,
    pub dome_ms: f64,
    pub mean_ms: f64,
    pub median_ms: f64,
    pub p10_ms: f64,
    pub p90_ms: f64,
    pub ratio: f64,
    pub memory_bytes: Option<u64>,
    pub sprites: Option<[u64; 2]>,
}

/// The times of a row's frames, in milliseconds.
#[derive(Clone, Debug, Default)]
pub struct Times {
    prepare: Vec<f64>,
    map: Vec<f64>,
    dome: Vec<f64>,
}

impl Times {
    /// Adds a frame: its preparation on the CPU, its passes off screen, its pass on the screen.
    pub fn push(&mut self, [prepare_ms, map_ms, dome_ms]: [f64; 3]) {
        self.prepare.push(prepare_ms);
        self.map.push(map_ms);
        self.dome.push(dome_ms);
    }

    /// Of the passes off screen and on it together, frame by frame.
    fn sum(&self) -> Spread {
        let sums: Vec<f64> = self
            .map
            .iter()
            .zip(&self.dome)
            .map(|(m, d)| m + d)
            .collect();
        Spread::of(&sums)
    }
}

impl Row {
    /// The row of a sky: a whole frame.
    pub fn of_sky(name: String, method: &'static str, memory_bytes: u64, times: &Times) -> Row {
        Row {
            method: Some(method),
            prepare_ms: Some(Spread::of(&times.prepare).median),
            map_ms: Some(Spread::of(&times.map).median),
            memory_bytes: Some(memory_bytes),
            ..Row::new(name, times.sum(), &times.dome)
        }
    }

    /// The row of a pass that has nothing off screen.
    pub fn of_reference(name: String, times: &Times) -> Row {
        Row::new(name, Spread::of(&times.dome), &times.dome)
    }

    fn new(name: String, frame: Spread, dome: &[f64]) -> Row {
        Row {
            name,
            method: None,
            prepare_ms: None,
            map_ms: None,
            dome_ms: Spread::of(dome).median,
            mean_ms: frame.mean,
            median_ms: frame.median,
            p10_ms: frame.p10,
            p90_ms: frame.p90,
            ratio: f64::NAN,
            memory_bytes: None,
            sprites: None,
        }
    }

    /// With the sprites of its last frame, on the screen and into the ring, if there are any.
    pub fn with_sprites(self, drawn: [u64; 2]) -> Row {
        Row {
            sprites: (drawn != [0, 0]).then_some(drawn),
            ..self
        }
    }
}

/// The rows with their ratios to the pass of four samples.
pub fn with_ratios(mut rows: Vec<Row>) -> Vec<Row> {
    let yardstick = rows.iter().find(|row| row.name == FOUR_SAMPLES);
    let yardstick_ms = yardstick.map_or(f64::NAN, |row| row.median_ms);
    for row in &mut rows {
        row.ratio = row.median_ms / yardstick_ms;
    }
    rows
}

impl Report {
    /// The table, and what its columns are.
    pub fn table(&self) -> String {
        let [width, height] = self.size;
        let clock = clock_in_words(self.clock);
        let mut text = format!(
            "{}\n{width}x{height} pixels, sky fills the frame (looking up {CAMERA_ELEVATION_DEG} degrees), \
             {} frames after {} to warm up\n{clock}, in milliseconds, medians but for p10 and p90\n\
             map: passes off screen; dome: the pass on the screen; frame: both; cpu: work before them; \
             MB: textures of the method alone\n\
             alone: no sun, stars, flare, skybox or upper layer; sprites: level flight, ground in the lower half\n\n\
             {:<34}{:>8}{:>8}{:>9}{:>9}{:>9}{:>17}{:>8}{:>8}\n",
            self.adapter,
            self.frames,
            self.warm_up_frames,
            "row",
            "map",
            "dome",
            "frame",
            "p10",
            "p90",
            "of four samples",
            "cpu",
            "MB",
        );
        for row in &self.passes {
            text += &row.line();
        }
        for (row, [screen, ring]) in self.passes.iter().filter_map(|r| Some((r, r.sprites?))) {
            text += &format!(
                "{}: {screen} sprites on the screen, {ring} into the ring, in the last frame\n",
                row.name
            );
        }
        text
    }
}

/// What [`Report::clock`] is.
pub fn clock_in_words(clock: &str) -> &'static str {
    match clock {
        "gpu" => "GPU time by timestamp queries",
        _ => "CPU wall time with the wait for the GPU, since it has no timestamp queries",
    }
}

/// A time in the table, or a dash where there is none.
pub fn ms(value: Option<f64>) -> String {
    value.map_or("-".to_string(), |v| format!("{v:.3}"))
}

impl Row {
    fn line(&self) -> String {
        let mb = |bytes: u64| format!("{:.2}", bytes as f64 / 1e6);
        format!(
            "{:<34}{:>8}{:>8.3}{:>9.3}{:>9.3}{:>9.3}{:>16.2}x{:>8}{:>8}\n",
            self.name,
            ms(self.map_ms),
            self.dome_ms,
            self.median_ms,
            self.p10_ms,
            self.p90_ms,
            self.ratio,
            ms(self.prepare_ms),
            self.memory_bytes.map_or("-".to_string(), mb),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(frames: &[[f64; 3]]) -> Times {
        let mut times = Times::default();
        for frame in frames {
            times.push(*frame);
        }
        times
    }

    fn sky(name: &str, frames: &[[f64; 3]]) -> Row {
        Row::of_sky(name.to_string(), "octaves", 1_500_000, &times(frames))
    }

    fn four_samples(dome_ms: f64) -> Row {
        Row::of_reference(FOUR_SAMPLES.to_string(), &times(&[[7.0, 7.0, dome_ms]]))
    }

    #[test]
    fn a_frame_is_what_it_draws_off_screen_and_on_it() {
        // Frame by frame 4, 5 and 9: not the sum of the medians, which is 2 + 5.
        let row = sky("", &[[9.0, 1.0, 3.0], [8.0, 2.0, 3.0], [7.0, 3.0, 6.0]]);
        assert_eq!((row.map_ms, row.dome_ms), (Some(2.0), 3.0));
        assert_eq!((row.median_ms, row.prepare_ms), (5.0, Some(8.0)));
        let row = sky("", &[[0.0, 1.0, 5.0], [0.0, 5.0, 2.0], [0.0, 2.0, 6.0]]);
        assert_eq!(
            (row.map_ms, row.dome_ms, row.median_ms),
            (Some(2.0), 5.0, 7.0)
        );
    }

    #[test]
    fn a_reference_pass_is_its_pass_alone() {
        let row = four_samples(2.0);
        assert_eq!(
            (row.map_ms, row.memory_bytes, row.median_ms),
            (None, None, 2.0)
        );
    }

    #[test]
    fn ratios_are_told_of_the_four_sample_pass() {
        let rows = with_ratios(vec![sky("noon", &[[0.0, 1.0, 2.0]]), four_samples(2.0)]);
        assert_eq!([rows[0].ratio, rows[1].ratio], [1.5, 1.0]);
    }

    #[test]
    fn the_table_keeps_its_columns() {
        let rows = with_ratios(vec![
            sky("octaves, alone, 8 octaves", &[[0.01, 0.25, 0.5]]),
            four_samples(0.5),
        ]);
        let report = Report {
            adapter: "Abacus".to_string(),
            clock: "gpu",
            size: [640, 480],
            frames: 1,
            warm_up_frames: 10,
            passes: rows,
        };
        let table = report.table();
        let lines: Vec<&str> = table.lines().collect();
        let words = |line: &str| {
            line.split("  ")
                .map(str::trim)
                .filter(|w| !w.is_empty())
                .map(str::to_string)
                .collect::<Vec<_>>()
        };
        let [.., head, sky, four] = &lines[..] else {
            panic!("{table}")
        };
        assert_eq!(words(head).len(), 9);
        let expected = "octaves, alone, 8 octaves|0.250|0.500|0.750|0.750|0.750|1.50x|0.010|1.50";
        assert_eq!(words(sky).join("|"), expected);
        assert_eq!(
            words(four).join("|"),
            "four samples|-|0.500|0.500|0.500|0.500|1.00x|-|-"
        );
        assert!(
            [head, sky, four]
                .iter()
                .all(|line| line.len() == head.len()),
            "{table}"
        );
    }
}
