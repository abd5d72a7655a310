//! Lines of a file or of a pipe, one after the other: bounded, numbered from 1, without what systems put around them.

use std::io::{self, BufRead, Read};

/// The longest line, in bytes: jobs have some hundreds.
const LONGEST: u64 = 1 << 20;

/// What a file may begin with to say that it is UTF-8.
const BYTE_ORDER_MARK: char = '\u{feff}';

/// Why a line cannot be taken.
#[derive(Debug, thiserror::Error)]
pub enum LineFault {
    /// It is longer than any job.
    #[error("is longer than {LONGEST} bytes; expected a job, which has some hundreds")]
    TooLong,
    /// It is no text.
    #[error("is not UTF-8; expected JSON, saved as UTF-8")]
    NotUtf8,
    /// The system's reason.
    #[error("cannot be read: {0}; see that it is there and may be read")]
    Read(#[from] io::Error),
}

/// Lines that hold anything.
pub struct Lines<R> {
    reader: R,
    number: u64,
}

impl<R: BufRead> Lines<R> {
    pub fn new(reader: R) -> Lines<R> {
        Lines { reader, number: 0 }
    }

    /// The number of the line that was read last, or that is wrong.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// The next line that is not empty, without its end.
    pub fn next(&mut self) -> Result<Option<String>, LineFault> {
        loop {
            self.number += 1;
            let mut bytes = Vec::new();
            let mut bounded = (&mut self.reader).take(LONGEST + 1);
            if bounded.read_until(b'\n', &mut bytes)? == 0 {
                return Ok(None);
            }
            if bytes.len() as u64 > LONGEST {
                return Err(LineFault::TooLong);
            }
            let text = std::str::from_utf8(&bytes).map_err(|_| LineFault::NotUtf8)?;
            let text = match self.number {
                1 => text.trim_start_matches(BYTE_ORDER_MARK),
                _ => text,
            };
            if !text.trim().is_empty() {
                return Ok(Some(text.trim().to_string()));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(text: &[u8]) -> Vec<(u64, String)> {
        let mut lines = Lines::new(text);
        let mut all = Vec::new();
        while let Some(line) = lines.next().unwrap() {
            all.push((lines.number(), line));
        }
        all
    }

    #[test]
    fn lines_have_their_numbers_whatever_ends_and_precedes_them() {
        let expected = vec![(1, "a".to_string()), (4, "b".into()), (5, "c".into())];
        assert_eq!(all(b"a\n\n  \nb\nc"), expected);
        assert_eq!(
            all("\u{feff}a\r\n\r\n\t\r\nb\r\nc\r\n".as_bytes()),
            expected
        );
        assert_eq!(all(b""), []);
        assert_eq!(all("\u{feff}\n".as_bytes()), []);
    }

    #[test]
    fn what_is_no_line_of_text_is_told_with_its_number() {
        let mut lines = Lines::new(&b"a\n\xff\n"[..]);
        lines.next().unwrap();
        assert!(matches!(lines.next(), Err(LineFault::NotUtf8)));
        assert_eq!(lines.number(), 2);
        // Endless, and not read to its end.
        let mut lines = Lines::new(io::BufReader::new(io::repeat(b'x')));
        assert!(matches!(lines.next(), Err(LineFault::TooLong)));
        let mut longest = vec![b'x'; LONGEST as usize - 1];
        longest.push(b'\n');
        assert_eq!(all(&longest)[0].1.len() as u64, LONGEST - 1);
    }
}
