//! What is on the display, read from the server's own memory: a file in the format of xwd.

use std::path::Path;

use super::{PANEL_PX, SIZE_PX};

/// The pixels of the display: rows from the top, red, green, blue.
#[derive(Clone, PartialEq)]
pub struct Screen(Vec<[u8; 3]>);

/// X11's header of a dump, as 32-bit numbers with the largest byte first (XWDFile.h, version 7).
const HEADER_SIZE: usize = 0;
const HEIGHT: usize = 5;
const BYTES_PER_LINE: usize = 12;
const COLOURS: usize = 19;
const COLOUR_BYTES: usize = 12;

impl Screen {
    pub fn read(file: &Path) -> Screen {
        let bytes = std::fs::read(file).unwrap();
        let number = |index: usize| {
            let at = 4 * index;
            u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
        };
        assert_eq!(number(HEIGHT), SIZE_PX[1] as usize);
        let first = number(HEADER_SIZE) + COLOUR_BYTES * number(COLOURS);
        let lines = bytes[first..].chunks_exact(number(BYTES_PER_LINE));
        let rows = lines.take(SIZE_PX[1] as usize);
        let row = |line: &[u8]| -> Vec<[u8; 3]> {
            let pixels = line.chunks_exact(4).take(SIZE_PX[0] as usize);
            pixels.map(|p| [p[2], p[1], p[0]]).collect()
        };
        Screen(rows.flat_map(row).collect())
    }

    /// Places and colours right of the panel.
    pub fn sky_pixels(&self) -> impl Iterator<Item = ([u32; 2], [u8; 3])> {
        self.pixels(PANEL_PX + 4..SIZE_PX[0])
    }

    fn panel_pixels(&self) -> impl Iterator<Item = [u8; 3]> {
        self.pixels(0..PANEL_PX - 4).map(|(_, colour)| colour)
    }

    fn pixels(&self, columns: std::ops::Range<u32>) -> impl Iterator<Item = ([u32; 2], [u8; 3])> {
        (0..SIZE_PX[1]).flat_map(move |y| {
            columns.clone().map(move |x| {
                let colour = self.0[(y * SIZE_PX[0] + x) as usize];
                ([x, y], colour)
            })
        })
    }

    /// Mean colour of rows of the whole display.
    pub fn mean(&self, rows: std::ops::Range<u32>) -> [f64; 3] {
        let width = SIZE_PX[0] as usize;
        let pixels = &self.0[rows.start as usize * width..rows.end as usize * width];
        [0, 1, 2].map(|channel| {
            let sum: u64 = pixels.iter().map(|colour| u64::from(colour[channel])).sum();
            sum as f64 / pixels.len() as f64
        })
    }

    /// Whether there is a sky by day right of the panel: nothing there is black.
    pub fn is_sky(&self) -> bool {
        self.darkest().1.into_iter().max() > Some(40)
    }

    /// The darkest pixel right of the panel, and where it is.
    pub fn darkest(&self) -> ([u32; 2], [u8; 3]) {
        let brightest_channel = |(_, colour): &([u32; 2], [u8; 3])| colour.iter().max().copied();
        self.sky_pixels().min_by_key(brightest_channel).unwrap()
    }

    /// Whether the skies differ beyond a grain of dither: a pixel in a hundred, by more than four steps of 8 bits.
    pub fn sky_differs(&self, other: &Screen) -> bool {
        let far =
            |(a, b): (&[u8; 3], &[u8; 3])| std::iter::zip(a, b).any(|(a, b)| a.abs_diff(*b) > 4);
        let (mine, theirs): (Vec<_>, Vec<_>) =
            std::iter::zip(self.sky_pixels(), other.sky_pixels())
                .map(|((_, a), (_, b))| (a, b))
                .unzip();
        let count = std::iter::zip(&mine, &theirs)
            .filter(|pair| far(*pair))
            .count();
        count * 100 > mine.len()
    }

    /// Whether anything at all differs.
    pub fn differs(&self, other: &Screen) -> bool {
        self.sky_differs(other) || self.reddish_in_panel() != other.reddish_in_panel()
    }

    /// Whether the panel is there: it is darker than any sky by day.
    pub fn has_panel(&self) -> bool {
        let dark = self
            .panel_pixels()
            .filter(|[r, g, b]| r.max(g).max(b) < &60);
        dark.count() > 1000
    }

    /// Pixels of the panel in the colour of errors.
    pub fn reddish_in_panel(&self) -> usize {
        let reddish = |[r, g, b]: &[u8; 3]| *r > 120 && *g < *r / 2 && *b < *r / 2;
        self.panel_pixels().filter(reddish).count()
    }
}
