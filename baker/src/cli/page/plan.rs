//! Clouds in space, as SVG: from above at three covers, and from the south.

use std::collections::BTreeMap;
use std::fmt::Write;

use welkin_pack::Field;
use welkin_pack::field::{Cloud, CloudKind, SECTION_SIDE_M};

/// Metres of a unit of a drawing: places are rounded to it.
const UNIT_M: f32 = 10.0;

/// Most sprites that are drawn one by one from the south, too.
const MOST_TWICE: usize = 20_000;

/// The highest place that is drawn: no cloud is as high, but a broken field may say anything.
const HIGHEST_M: f32 = 30_000.0;

/// Covers at which the field is shown from above.
const COVERS: [f32; 3] = [0.25, 0.5, 1.0];

/// The field from above and from the south, with a table of its kinds.
pub fn field(field: &Field) -> String {
    format!(
        "<div class=\"plans\">\n{}</div>\n<div class=\"field\">\n<div>{}</div>\n{}</div>\n",
        from_above(field),
        kinds(field),
        from_the_south(field)
    )
}

/// Which places of a sprite are across and down on a drawing.
type Project = fn(&[f32; 3]) -> [f32; 2];

/// A plan for each cover; clouds that are on several are in the page once.
fn from_above(field: &Field) -> String {
    let side = field.side_m() / UNIT_M;
    let mut grid = String::new();
    for section in 1..field.sections {
        let at = section as f32 * SECTION_SIDE_M / UNIT_M;
        let _ = write!(grid, "M{at} 0V{side}M0 {at}H{side}");
    }
    let project: Project = |at| [at[0] / UNIT_M, at[2] / UNIT_M];
    let mut html = String::new();
    let mut before = String::new();
    let mut least = f32::NEG_INFINITY;
    for (index, cover) in COVERS.into_iter().enumerate() {
        let is_new = |cloud: &&Cloud| cloud.rank > least && cloud.rank <= cover;
        let clouds = field.clouds.iter().filter(is_new);
        let new: String = clouds
            .map(|c| drawn(c, project, true) + &framed(c, project))
            .collect();
        let count = field.clouds.iter().filter(|c| c.rank <= cover).count();
        let _ = writeln!(
            html,
            "<figure><svg class=\"plan\" viewBox=\"0 0 {side} {side}\" role=\"img\" aria-label=\"plan at cover {cover}\">\
             <rect class=\"ground\" width=\"{side}\" height=\"{side}\"/><path class=\"grid\" d=\"{grid}\"/>{before}\
             <g id=\"ranks{index}\">{new}</g></svg><figcaption>cover {cover}: {count} clouds</figcaption></figure>"
        );
        let _ = write!(before, "<use href=\"#ranks{index}\"/>");
        least = cover;
    }
    let _ = write!(
        html,
        "<p>From above, north up: {:.0} km a side, a line every 4 km. Dots are sprites as wide as they are, frames the boxes \
         around clouds. A cloud is there from the cover of its rank.</p>",
        field.side_m() / 1000.0
    );
    html
}

fn from_the_south(field: &Field) -> String {
    let side = field.side_m() / UNIT_M;
    let tops = field
        .clouds
        .iter()
        .map(|c| c.centre_m[1] + 0.5 * c.size_m[1]);
    let top_m = tops.fold(1000.0, f32::max).min(HIGHEST_M);
    let height = libm::ceilf(top_m / 1000.0) * 1000.0 / UNIT_M;
    let project: Project = |at| [at[0] / UNIT_M, -at[1] / UNIT_M];
    let each = field.sprite_count() <= MOST_TWICE;
    let clouds: String = field
        .clouds
        .iter()
        .map(|c| drawn(c, project, each))
        .collect();
    let mut grid = String::new();
    let mut level = 1000.0 / UNIT_M;
    while level < height {
        let _ = write!(grid, "M0 {}H{side}", -level);
        level += 1000.0 / UNIT_M;
    }
    format!(
        "<figure><svg class=\"plan south\" viewBox=\"0 {} {side} {height}\" role=\"img\" aria-label=\"the field from the south\">\
         <rect class=\"ground\" y=\"{0}\" width=\"{side}\" height=\"{height}\"/><path class=\"grid\" d=\"{grid}\"/>{clouds}</svg>\
         <figcaption>from the south, west on the left: a line every 1000 m</figcaption></figure>\n",
        -height
    )
}

/// The sprites of a cloud as dots of their width, in steps of half an octave; or its box alone.
fn drawn(cloud: &Cloud, project: Project, each: bool) -> String {
    let class = class(cloud.kind);
    if !each {
        return framed(cloud, project);
    }
    let mut paths: BTreeMap<i32, String> = BTreeMap::new();
    for sprite in &cloud.sprites {
        let [x, y] = project(&sprite.centre_m);
        let half_octave = libm::roundf(2.0 * libm::log2f(sprite.size_m[0].max(1.0))) as i32;
        let _ = write!(paths.entry(half_octave).or_default(), "M{x:.0} {y:.0}h0");
    }
    let path = |(half_octave, path): (i32, String)| {
        let width = libm::exp2f(half_octave as f32 / 2.0) / UNIT_M;
        format!("<path class=\"{class}\" stroke-width=\"{width:.0}\" d=\"{path}\"/>")
    };
    paths.into_iter().map(path).collect()
}

/// The box around a cloud.
fn framed(cloud: &Cloud, project: Project) -> String {
    let [x, y] = project(&cloud.centre_m);
    let [width, height] = project(&cloud.size_m).map(f32::abs);
    format!(
        "<rect class=\"{}\" x=\"{:.0}\" y=\"{:.0}\" width=\"{width:.0}\" height=\"{height:.0}\"/>",
        class(cloud.kind),
        x - 0.5 * width,
        y - 0.5 * height
    )
}

fn class(kind: CloudKind) -> String {
    let number = CloudKind::ALL.iter().position(|k| *k == kind).unwrap_or(0);
    format!("kind{number}")
}

fn kinds(field: &Field) -> String {
    let mut html = "<table class=\"kinds\"><tr><th>kind</th><th>clouds</th><th>boxes</th><th>sprites</th><th>ranks</th><th>heights</th></tr>\n".to_string();
    for kind in CloudKind::ALL {
        let clouds: Vec<&Cloud> = field.clouds.iter().filter(|c| c.kind == kind).collect();
        let (Some(first), Some(last)) = (clouds.first(), clouds.last()) else {
            continue;
        };
        let sum = |count: fn(&Cloud) -> usize| clouds.iter().map(|c| count(c)).sum::<usize>();
        let edge = |side: f32| {
            clouds
                .iter()
                .map(move |c| c.centre_m[1] + side * c.size_m[1])
        };
        let (base, top) = (
            edge(-0.5).fold(f32::INFINITY, f32::min),
            edge(0.5).fold(f32::NEG_INFINITY, f32::max),
        );
        let _ = writeln!(
            html,
            "<tr><td><span class=\"key {}\"></span>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2} to {:.2}</td><td>{base:.0} to {top:.0} m</td></tr>",
            class(kind),
            kind.name(),
            clouds.len(),
            sum(|c| c.boxes.len()),
            sum(|c| c.sprites.len()),
            first.rank,
            last.rank,
        );
    }
    html + "</table>\n"
}
