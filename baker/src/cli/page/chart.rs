//! Charts of a channel, as SVG.

use std::fmt::Write;

use welkin_pack::Format;

/// Size of a chart in pixels, without its axis.
const WIDTH: f64 = 232.0;
const HEIGHT: f64 = 72.0;

/// Bars of a histogram: four bytes each.
const BARS: usize = 64;

/// A share of all values in one bar from which the others would not be seen on a linear axis.
const MOST_LINEAR: f64 = 0.5;

/// Decades of energy on a spectrum at most.
const DECADES: f64 = 8.0;

fn chart(label: &str, inside: &str, left: &str, middle: &str, right: &str) -> String {
    format!(
        "<svg class=\"chart\" viewBox=\"0 0 {WIDTH} {}\" role=\"img\" aria-label=\"{label}\">\
         <path class=\"axis\" d=\"M0 {HEIGHT}H{WIDTH}\"/>{inside}\
         <text x=\"0\" y=\"{1}\">{left}</text><text x=\"{2}\" y=\"{1}\" text-anchor=\"middle\">{middle}</text>\
         <text x=\"{WIDTH}\" y=\"{1}\" text-anchor=\"end\">{right}</text></svg>",
        HEIGHT + 15.0,
        HEIGHT + 12.0,
        WIDTH / 2.0,
    )
}

/// How often which values are stored. `range` is what stored 0 and 1 mean; floats have their own least and most.
pub fn histogram(values: &[f32], format: Format, range: [f32; 2], unit: &str) -> String {
    let finite = || values.iter().copied().filter(|v| v.is_finite());
    let count = finite().count();
    let others = values.len() - count;
    let [least, most] = finite().fold([f32::INFINITY, f32::NEG_INFINITY], |[a, b], v| {
        [a.min(v), b.max(v)]
    });
    let is_float = format == Format::Rgba16Float;
    let axis = if is_float && count > 0 && (least < 0.0 || most > 1.0) {
        [least.min(0.0), most.max(1.0)]
    } else {
        [0.0, 1.0]
    };
    let mut bars = [0_usize; BARS];
    for value in finite() {
        let place =
            (value - axis[0]) / (axis[1] - axis[0]) * (BARS as f32 - f32::from(u8::from(is_float)));
        bars[(place as usize).min(BARS - 1)] += 1;
    }
    let tallest = bars.iter().max().copied().unwrap_or(0).max(1);
    let is_linear = (tallest as f64) < MOST_LINEAR * count as f64 || count == 0;
    let height = |n: usize| {
        let share = if is_linear {
            n as f64 / tallest as f64
        } else {
            libm::log(1.0 + n as f64) / libm::log(1.0 + tallest as f64)
        };
        HEIGHT * (1.0 - 0.96 * share)
    };
    let mut path = format!("M0 {HEIGHT}");
    for (i, &n) in bars.iter().enumerate() {
        let right = WIDTH * (i + 1) as f64 / BARS as f64;
        // Into a string, which takes everything.
        let _ = write!(path, "V{:.1}H{right:.1}", height(n));
    }
    let mut inside = format!("<path class=\"bars\" d=\"{path}V{HEIGHT}Z\"/>");
    let (mean, spread) = mean_and_spread(finite(), count);
    let at = WIDTH * (mean - f64::from(axis[0])) / f64::from(axis[1] - axis[0]);
    if count > 0 {
        let _ = write!(inside, "<path class=\"mean\" d=\"M{at:.1} 0V{HEIGHT}\"/>");
    }
    if others > 0 {
        let _ = write!(
            inside,
            "<text class=\"error\" x=\"0\" y=\"10\">{others} values are not finite</text>"
        );
    }
    let scale = if is_linear { "" } else { ", log" };
    let meaning = |stored: f32| {
        short(f64::from(range[0]) + f64::from(stored) * f64::from(range[1] - range[0]))
    };
    let unit = if unit == "1" || unit.len() > 6 {
        String::new()
    } else {
        format!(" {unit}")
    };
    let [left, right] = axis.map(|v| meaning(v) + &unit);
    let middle = format!("mean {mean:.3}, spread {spread:.3}{scale}");
    chart("histogram", &inside, &left, &middle, &right)
}

fn mean_and_spread(values: impl Iterator<Item = f32> + Clone, count: usize) -> (f64, f64) {
    let count = count.max(1) as f64;
    let mean = values.clone().map(f64::from).sum::<f64>() / count;
    let squares = values.map(|v| (f64::from(v) - mean) * (f64::from(v) - mean));
    (mean, libm::sqrt(squares.sum::<f64>() / count))
}

/// Energy over wave numbers from 1, both in logarithms; a grid line every two decades.
pub fn spectrum(energy: &[f64]) -> String {
    let most = energy.iter().copied().fold(0.0, f64::max);
    let waves = energy.len();
    let right = format!("{waves} waves");
    if most <= 0.0 || waves < 2 {
        return chart("spectrum", "", "1", "flat: no energy", &right);
    }
    let depth = |e: f64| libm::log10(most / e).min(DECADES);
    let deepest = energy.iter().map(|&e| depth(e)).fold(0.0, f64::max);
    let decades = (2.0 * libm::ceil(deepest / 2.0)).max(2.0);
    let mut inside = String::new();
    let mut line = 2.0;
    while line < decades {
        let _ = write!(
            inside,
            "<path class=\"grid\" d=\"M0 {:.1}H{WIDTH}\"/>",
            HEIGHT * line / decades
        );
        line += 2.0;
    }
    let place = |k: f64| WIDTH * libm::log10(k) / libm::log10(waves as f64);
    for k in [10.0, 100.0, 1000.0]
        .into_iter()
        .filter(|&k| k < waves as f64)
    {
        let _ = write!(
            inside,
            "<path class=\"grid\" d=\"M{0:.1} 0V{HEIGHT}\"/>",
            place(k)
        );
    }
    let mut path = String::new();
    for (i, &e) in energy.iter().enumerate() {
        let (letter, x) = (if i == 0 { 'M' } else { 'L' }, place((i + 1) as f64));
        let y = HEIGHT * depth(e) / decades;
        let _ = write!(path, "{letter}{x:.1} {:.1}", y.min(HEIGHT));
    }
    let _ = write!(inside, "<path class=\"line\" d=\"{path}\"/>");
    let middle = format!("energy, {decades} decades");
    chart("spectrum", &inside, "1", &middle, &right)
}

fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    text.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_histogram_says_what_it_counts() {
        let values: Vec<f32> = (0..=255_u8).map(|b| f32::from(b) / 255.0).collect();
        let even = histogram(&values, Format::R8Unorm, [-1.0, 1.0], "1");
        // Four bytes a bar: all are as high.
        let top = HEIGHT * 0.04;
        assert_eq!(even.matches(&format!("V{top:.1}H")).count(), BARS, "{even}");
        assert!(
            even.contains(">-1<") && even.contains(">1<") && even.contains("mean 0.500"),
            "{even}"
        );
        assert!(!even.contains(", log"));
        let lone = histogram(
            &[0.0, 0.0, 0.0, f32::NAN, 0.5],
            Format::Rgba16Float,
            [0.0, 1.0],
            "Hz",
        );
        assert!(
            lone.contains(", log")
                && lone.contains("1 values are not finite")
                && lone.contains(">1 Hz<"),
            "{lone}"
        );
        let none = histogram(&[f32::NAN], Format::Rgba16Float, [0.0, 1.0], "1");
        assert!(!none.contains("NaN") && !none.contains("inf"), "{none}");
    }

    #[test]
    fn a_spectrum_falls_by_its_decades() {
        let falling: Vec<f64> = (1..=100).map(|k| libm::pow(f64::from(k), -2.0)).collect();
        let chart = spectrum(&falling);
        // k^-2 is a straight line from corner to corner.
        assert!(
            chart.contains("energy, 4 decades") && chart.contains("M0.0 0.0L"),
            "{chart}"
        );
        assert!(
            chart.contains(&format!("L{WIDTH:.1} {HEIGHT:.1}\"")),
            "{chart}"
        );
        assert!(chart.contains(">100 waves<"));
        assert!(spectrum(&[0.0; 8]).contains("flat"));
    }
}
