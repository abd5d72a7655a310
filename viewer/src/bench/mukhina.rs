//! `--protocol mukhina`: the measurement of a paper, with its figures beside.
//!
//! # Theory
//! K. Mukhina, A. Bezgodov, "The Method for Real-time Cloud Rendering", Procedia Computer Science 66, 2015, section 5: the
//! mean over 500 frames at three sizes, on several devices; section 3 wants no more than 2 ms.
//!
//! # Changes versus the paper
//! Camera, cover and time of day are not told there. Here sky fills the frame and the light is that of noon, a low sun and
//! night. Medians and spreads stand beside the mean, and the reference passes beside the skies, since the paper's device is
//! not the one at hand.

use serde::Serialize;
use welkin_pack::Pack;
use welkin_viewer::gpu::{Gpu, GpuError};

use super::measure::{WARM_UP_FRAMES, clock, measure};
use super::report::{Row, clock_in_words, ms};
use super::scene::{CAMERA_ELEVATION_DEG, SHADOW_EXTENT_M, scenes_of_mukhina};

/// The sizes, and the paper's mean of each in milliseconds on a GeForce GTX 770 (section 5, figure 4): its best device.
const SIZES: [([u32; 2], f64); 3] = [
    ([800, 600], 0.65),
    ([1280, 720], 0.83),
    ([1920, 1080], 0.87),
];

/// What the paper allows, in milliseconds (sections 3 and 6).
const LIMIT_MS: f64 = 2.0;

/// Everything that `--json` prints. The keys are those of docs/json.md.
#[derive(Debug, Serialize)]
pub struct Report {
    pub adapter: String,
    pub clock: &'static str,
    pub protocol: &'static str,
    pub frames: u32,
    pub warm_up_frames: u32,
    pub limit_ms: f64,
    pub sizes: Vec<SizeReport>,
}

/// The rows of a size.
#[derive(Debug, Serialize)]
pub struct SizeReport {
    pub size: [u32; 2],
    pub paper_ms: f64,
    pub passes: Vec<Row>,
}

/// Measures all three sizes.
pub fn report(gpu: &Gpu, pack: &Pack, frames: u32) -> Result<Report, GpuError> {
    report_of(gpu, pack, &SIZES, frames)
}

/// Measures one size after another, each with its own reference passes.
fn report_of(
    gpu: &Gpu,
    pack: &Pack,
    sizes: &[([u32; 2], f64)],
    frames: u32,
) -> Result<Report, GpuError> {
    let of_size = |&(size, paper_ms): &([u32; 2], f64)| {
        let passes = measure(gpu, pack, scenes_of_mukhina(), size, frames)?;
        Ok(SizeReport {
            size,
            paper_ms,
            passes,
        })
    };
    Ok(Report {
        adapter: gpu.adapter.clone(),
        clock: clock(gpu),
        protocol: "mukhina",
        frames,
        warm_up_frames: WARM_UP_FRAMES,
        limit_ms: LIMIT_MS,
        sizes: sizes.iter().map(of_size).collect::<Result<_, GpuError>>()?,
    })
}

impl Report {
    /// The table, and what its columns are.
    pub fn table(&self) -> String {
        let mut text = format!(
            "{}\nprotocol of Mukhina and Bezgodov, 2015: mean of {} frames at each of three sizes, after {} to warm up\n\
             method lit, three layers, light scattered through them, shade on themselves and over {SHADOW_EXTENT_M} m of \
             ground, Perez sky, which fills the frame (looking up {CAMERA_ELEVATION_DEG} degrees)\n\
             {}, in milliseconds\n\
             mean, median, p10, p90: a whole frame; map: of it the passes off screen, dome: the pass on the screen (medians)\n\
             paper: its mean on a GeForce GTX 770; of limit: mean over the {LIMIT_MS} ms that it allows\n\n\
             {:<26}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>17}{:>9}{:>10}\n",
            self.adapter,
            self.frames,
            self.warm_up_frames,
            clock_in_words(self.clock),
            "row",
            "mean",
            "median",
            "p10",
            "p90",
            "map",
            "dome",
            "of four samples",
            "paper",
            "of limit",
        );
        for size in &self.sizes {
            for row in &size.passes {
                text += &size.line(row);
            }
        }
        text
    }
}

impl SizeReport {
    fn line(&self, row: &Row) -> String {
        let [width, height] = self.size;
        // What is no sky has no figure in the paper.
        let of_sky = |text: String| row.method.map_or("-".to_string(), |_| text);
        format!(
            "{:<26}{:>9.3}{:>9.3}{:>9.3}{:>9.3}{:>9}{:>9.3}{:>16.2}x{:>9}{:>10}\n",
            format!("{width}x{height} {}", row.name),
            row.mean_ms,
            row.median_ms,
            row.p10_ms,
            row.p90_ms,
            ms(row.map_ms),
            row.dome_ms,
            row.ratio,
            of_sky(format!("{:.2}", self.paper_ms)),
            of_sky(format!("{:.2}x", row.mean_ms / LIMIT_MS)),
        )
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use super::super::report::{FOUR_SAMPLES, Times, with_ratios};
    use super::*;

    /// On small frames: software takes minutes for the paper's sizes.
    #[test]
    fn every_size_has_its_skies_and_its_reference_passes() {
        let recipe = "[clouds]\nsize = 64\n[stars]\nsize = 64\ncount = 50\n[galaxy]\nsize = 32\n[fbm]\nsize = 128\n\
                      [flares]\nsize = 64\n[layers]\nsize = 64\n";
        let resolved = welkin_baker::Recipe::parse("small", recipe)
            .and_then(|r| r.resolve(None))
            .unwrap();
        let pack = welkin_baker::bake(&resolved, None, &|_| ControlFlow::Continue(())).unwrap();
        let gpu = Gpu::open(None).unwrap();
        let sizes = [([16, 8], 0.5), ([8, 16], 0.75)];
        let report = report_of(&gpu, &pack, &sizes, 2).unwrap();
        let json = serde_json::to_value(&report).unwrap();
        assert_eq!(json["protocol"], "mukhina");
        assert_eq!(
            (&json["frames"], &json["limit_ms"]),
            (&2.into(), &2.0.into())
        );
        let expected = [
            "lit, noon",
            "lit, low sun",
            "lit, night",
            "one sample",
            FOUR_SAMPLES,
        ];
        for (json, (size, paper_ms)) in json["sizes"].as_array().unwrap().iter().zip(sizes) {
            assert_eq!(json["size"], serde_json::json!(size));
            assert_eq!(json["paper_ms"], paper_ms);
            let passes = json["passes"].as_array().unwrap();
            let names: Vec<&str> = passes.iter().map(|p| p["name"].as_str().unwrap()).collect();
            assert_eq!(names, expected);
            for pass in passes {
                let [mean, p10] = ["mean_ms", "p10_ms"].map(|key| pass[key].as_f64().unwrap());
                // From the less to the more of two times, p10 goes a tenth of the way and the mean half.
                assert!(0.0 < p10 && mean > p10 * (1.0 - 1e-9), "{pass}");
            }
        }
        assert_eq!(report.sizes.len(), 2);
    }

    #[test]
    fn the_table_tells_the_mean_beside_the_paper_s() {
        let mut times = Times::default();
        // Frames of 1, 1 and 4 ms: the mean is 2, the median 1.
        for [map, dome] in [[0.25, 0.75], [0.5, 0.5], [1.0, 3.0]] {
            times.push([0.1, map, dome]);
        }
        let mut four = Times::default();
        four.push([0.0, 0.0, 0.5]);
        let passes = with_ratios(vec![
            Row::of_sky("lit, low sun".to_string(), "lit", 1, &times),
            Row::of_reference(FOUR_SAMPLES.to_string(), &four),
        ]);
        let [(size, paper_ms), ..] = SIZES;
        let report = Report {
            adapter: "Abacus".to_string(),
            clock: "cpu",
            protocol: "mukhina",
            frames: 3,
            warm_up_frames: 10,
            limit_ms: LIMIT_MS,
            sizes: vec![SizeReport {
                size,
                paper_ms,
                passes,
            }],
        };
        let table = report.table();
        let lines: Vec<&str> = table.lines().collect();
        let [.., head, sky, four] = &lines[..] else {
            panic!("{table}")
        };
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(
            words(sky),
            "800x600 lit, low sun 2.000 1.000 1.000 3.400 0.500 0.750 2.00x 0.65 1.00x"
        );
        assert_eq!(
            words(four),
            "800x600 four samples 0.500 0.500 0.500 0.500 - 0.500 1.00x - -"
        );
        assert!(
            sky.len() == head.len() && four.len() == head.len(),
            "{table}"
        );
        assert!(
            table.contains("mean of 3 frames") && table.contains("CPU wall time"),
            "{table}"
        );
    }
}
