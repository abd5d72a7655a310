//! The sheet of paper: sections of labelled pictures, put on shelves from left to right.

use super::font;

/// A picture on the sheet, in sRGB.
#[derive(Clone, Debug)]
pub struct Panel {
    /// Large label under it.
    pub title: String,
    /// Small label under that.
    pub note: String,
    /// Pixels a row, [`PANEL`] at most.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` pixels, row by row.
    pub pixels: Vec<[u8; 3]>,
}

/// Panels that belong together, side by side under a heading.
#[derive(Clone, Debug)]
pub struct Section {
    /// First line of the heading.
    pub title: String,
    /// Second line.
    pub note: String,
    /// At least one, [`COLUMNS`] at most.
    pub panels: Vec<Panel>,
}

/// A finished sheet.
#[derive(Clone, Debug)]
pub struct Sheet {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Red, green, blue of every pixel, in sRGB.
    pub rgb: Vec<u8>,
}

/// Largest side of a panel in pixels.
pub const PANEL: u32 = 192;

/// Most panels side by side.
pub const COLUMNS: usize = 6;

const MARGIN: u32 = 20;
const GAP: u32 = 12;
const HEADING_HEIGHT: u32 = 34;
const CAPTION_HEIGHT: u32 = 44;
const LARGE: u32 = 2;
const SMALL: u32 = 1;
const PAPER: [u8; 3] = [24, 26, 30];
const INK: [u8; 3] = [236, 238, 242];
const FAINT_INK: [u8; 3] = [158, 164, 174];
const FRAME: [u8; 3] = [70, 75, 84];

/// Lays out a heading and sections. A section goes on the first shelf that has room for it.
pub fn lay_out(title: &str, note: &str, sections: Vec<Section>) -> Sheet {
    let shelves = shelve(sections);
    let column = PANEL + GAP;
    let width = 2 * MARGIN + COLUMNS as u32 * column - GAP;
    let heights: Vec<u32> = shelves.iter().map(|shelf| shelf_height(shelf)).collect();
    let top = MARGIN + HEADING_HEIGHT + GAP;
    let mut sheet = Sheet::blank(width, top + heights.iter().sum::<u32>() + MARGIN);
    sheet.text(MARGIN, MARGIN, LARGE, INK, title);
    sheet.text(MARGIN, MARGIN + 20, SMALL, FAINT_INK, note);
    let mut y = top;
    for (shelf, height) in shelves.iter().zip(heights) {
        let mut x = MARGIN;
        for section in shelf {
            sheet.section(x, y, section);
            x += section.panels.len() as u32 * column;
        }
        y += height;
    }
    sheet
}

fn shelve(sections: Vec<Section>) -> Vec<Vec<Section>> {
    let mut shelves: Vec<Vec<Section>> = Vec::new();
    for section in sections {
        let used = |shelf: &[Section]| shelf.iter().map(|s| s.panels.len()).sum::<usize>();
        match shelves
            .iter_mut()
            .find(|shelf| used(shelf) + section.panels.len() <= COLUMNS)
        {
            Some(shelf) => shelf.push(section),
            None => shelves.push(vec![section]),
        }
    }
    shelves
}

fn shelf_height(shelf: &[Section]) -> u32 {
    let panels = shelf.iter().flat_map(|section| &section.panels);
    HEADING_HEIGHT + panels.map(|panel| panel.height).max().unwrap_or(0) + CAPTION_HEIGHT
}

impl Sheet {
    fn blank(width: u32, height: u32) -> Sheet {
        Sheet {
            width,
            height,
            rgb: PAPER.repeat(width as usize * height as usize),
        }
    }

    fn section(&mut self, x: u32, y: u32, section: &Section) {
        self.text(x, y, LARGE, INK, &section.title);
        self.text(x, y + 20, SMALL, FAINT_INK, &section.note);
        for (i, panel) in section.panels.iter().enumerate() {
            self.panel(x + i as u32 * (PANEL + GAP), y + HEADING_HEIGHT, panel);
        }
    }

    fn panel(&mut self, x: u32, y: u32, panel: &Panel) {
        self.fill([x - 1, y - 1], [panel.width + 2, panel.height + 2], FRAME);
        for (i, &pixel) in panel.pixels.iter().enumerate() {
            let i = i as u32;
            self.fill([x + i % panel.width, y + i / panel.width], [1, 1], pixel);
        }
        self.text(x, y + panel.height + 5, LARGE, INK, &panel.title);
        self.text(x, y + panel.height + 22, SMALL, FAINT_INK, &panel.note);
    }

    fn text(&mut self, x: u32, y: u32, scale: u32, ink: [u8; 3], text: &str) {
        for (i, letter) in text.chars().enumerate() {
            let left = x + i as u32 * (font::WIDTH + 1) * scale;
            for (row, bits) in font::rows(letter).into_iter().enumerate() {
                for column in (0..font::WIDTH).filter(|c| bits >> (font::WIDTH - 1 - c) & 1 == 1) {
                    self.fill(
                        [left + column * scale, y + row as u32 * scale],
                        [scale, scale],
                        ink,
                    );
                }
            }
        }
    }

    /// Fills a rectangle; what lies outside the sheet is cut off.
    fn fill(&mut self, [x, y]: [u32; 2], [width, height]: [u32; 2], colour: [u8; 3]) {
        for row in y..(y + height).min(self.height) {
            for column in x..(x + width).min(self.width) {
                let at = (row as usize * self.width as usize + column as usize) * 3;
                self.rgb[at..at + 3].copy_from_slice(&colour);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(panels: usize) -> Section {
        let panel = Panel {
            title: "T".into(),
            note: "N".into(),
            width: 2,
            height: 1,
            pixels: vec![[255, 0, 0], [0, 255, 0]],
        };
        Section {
            title: "S".into(),
            note: String::new(),
            panels: vec![panel; panels],
        }
    }

    #[test]
    fn sections_fill_the_shelves_and_are_never_parted() {
        let shelves = shelve([4, 4, 1, 5, 2].map(section).to_vec());
        let counts: Vec<Vec<usize>> = shelves
            .iter()
            .map(|s| s.iter().map(|s| s.panels.len()).collect())
            .collect();
        assert_eq!(counts, [vec![4, 1], vec![4, 2], vec![5]]);
    }

    #[test]
    fn a_panel_keeps_its_pixels() {
        let sheet = lay_out("", "", vec![section(1)]);
        let at = |x: u32, y: u32| &sheet.rgb[((y * sheet.width + x) * 3) as usize..][..3];
        let y = MARGIN + HEADING_HEIGHT + GAP + HEADING_HEIGHT;
        assert_eq!(
            [at(MARGIN, y), at(MARGIN + 1, y)],
            [[255, 0, 0], [0, 255, 0]]
        );
    }

    #[test]
    fn text_that_is_too_long_is_cut_off_at_the_edge() {
        let long = "W".repeat(1000);
        assert_eq!(
            lay_out(&long, &long, vec![section(5)]).width,
            lay_out("", "", vec![section(5)]).width
        );
    }
}
