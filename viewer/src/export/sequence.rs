//! Sequences of frames: which moments they are, what they are called, and how they are cut into parts.
//!
//! Frame k is the sky at `start + k / fps` seconds, whoever draws it and whatever was drawn before. So the parts of a sequence may be drawn by
//! several programs, on several machines, into one folder, and are together what one program draws. That holds for a loop too ([`looped`](super::looped)), whose frames are
//! of two moments.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use welkin_pack::WriteError;
use welkin_pack::whole::others_in;

use super::looped::{CHANGE_S, Change};

/// Frames that a sequence may have: as many as six digits count.
pub const MOST_FRAMES: u32 = 1_000_000;

/// Frames a second that a sequence may have.
pub const FPS: [f64; 2] = [0.001, 1000.0];

/// One of several parts of a sequence: of `count` parts, number `index` from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Its number, 1 to `count`.
    pub index: u32,
    /// How many parts there are.
    pub count: u32,
}

impl Shard {
    /// All of a sequence.
    pub const WHOLE: Shard = Shard { index: 1, count: 1 };
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let numbers = text.split_once('/');
        let numbers = numbers.and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((index, count)) if (1..=count).contains(&index) && count <= MOST_FRAMES => {
                Ok(Shard { index, count })
            }
            _ => Err(format!(
                "expected PART/PARTS, two whole numbers, the first from 1 to the second and that at most {MOST_FRAMES}, such as 2/4"
            )),
        }
    }
}

/// A sequence, or a part of one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sequence {
    /// Frames of the whole.
    pub frames: u32,
    /// Frames a second.
    pub fps: f64,
    /// The moment of frame 0, in seconds.
    pub start_s: f64,
    /// Whether the frame after the last one is frame 0.
    pub looped: bool,
    /// Which part.
    pub shard: Shard,
}

impl Sequence {
    /// Numbers of the frames of the part: every n-th, so that parts take about as long.
    pub fn numbers(&self) -> impl ExactSizeIterator<Item = u32> + use<> {
        (self.shard.index - 1..self.frames).step_by(self.shard.count as usize)
    }

    /// The moment of a frame, in seconds.
    pub fn seconds(&self, number: u32) -> f64 {
        self.start_s + f64::from(number) / self.fps
    }

    /// What a frame of a loop shows of the sky that goes before frame 0, if it may show any.
    pub fn change(&self, number: u32) -> Option<Change> {
        if !self.looped {
            return None;
        }
        let left = f64::from(self.frames) - f64::from(number);
        let frames = f64::from(self.frames).min(CHANGE_S * self.fps);
        Some(Change {
            earlier_s: self.start_s - left / self.fps,
            progress: (1.0 - left / frames) as f32,
        })
        .filter(|change| change.progress > 0.0)
    }
}

/// The name of a frame's file.
pub fn file_name(number: u32, extension: &str) -> String {
    format!("frame-{number:06}.{extension}")
}

/// What the names of frames may end in, without the dot.
const EXTENSIONS: [&str; 4] = ["png", "exr", "hdr", "ktx2"];

/// Whether a file has a name that [`file_name`] gives.
pub fn is_frame(name: &str) -> bool {
    let number = name
        .strip_prefix("frame-")
        .and_then(|rest| rest.split_once('.'))
        .filter(|(digits, _)| digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_digit()));
    number.is_some_and(|(_, extension)| EXTENSIONS.contains(&extension))
}

/// The folder of a sequence, made if it is not there. Others may be writing frames into it.
///
/// # Errors
/// [`WriteError::NotAFolder`], [`WriteError::NotOurs`] if there is a folder with anything but frames in it, [`WriteError::Failed`].
pub fn open_folder(place: &Path) -> Result<(), WriteError> {
    let file = || place.display().to_string();
    match fs::create_dir(place) {
        Ok(()) => return Ok(()),
        // Here before, or made by another part just now.
        Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
        Err(reason) => {
            let file = file();
            return Err(WriteError::Failed { file, reason });
        }
    }
    let others = others_in(place, is_frame)?;
    match others.first() {
        None => Ok(()),
        Some(found) => Err(WriteError::NotOurs {
            file: file(),
            found: found.clone(),
        }),
    }
}

/// Where a frame goes.
pub fn path(folder: &Path, number: u32, extension: &str) -> PathBuf {
    folder.join(file_name(number, extension))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sequence(frames: u32, shard: &str) -> Sequence {
        Sequence {
            frames,
            fps: 24.0,
            start_s: 10.0,
            looped: false,
            shard: shard.parse().unwrap(),
        }
    }

    #[test]
    fn parts_have_every_frame_once() {
        for (frames, count) in [(1, 1), (10, 1), (10, 3), (10, 10), (3, 7), (1000, 64)] {
            let mut all: Vec<u32> = (1..=count)
                .flat_map(|i| sequence(frames, &format!("{i}/{count}")).numbers())
                .collect();
            all.sort_unstable();
            assert_eq!(all, (0..frames).collect::<Vec<_>>());
        }
        // No part has more than one frame more than another.
        let lengths = [1, 2, 3].map(|i| sequence(10, &format!("{i}/3")).numbers().len());
        assert_eq!(lengths, [4, 3, 3]);
    }

    #[test]
    fn a_frame_has_the_same_moment_in_every_part() {
        let whole = sequence(1_000_000, "1/1");
        assert_eq!(whole.seconds(0), 10.0);
        assert_eq!(whole.seconds(24), 11.0);
        // Not a sum of steps, which would drift.
        assert_eq!(whole.seconds(999_984), 10.0 + 41_666.0);
        for number in sequence(1_000_000, "5/7").numbers().take(5) {
            assert_eq!(sequence(9, "1/2").seconds(number), whole.seconds(number));
        }
    }

    #[test]
    fn the_frame_after_the_last_one_of_a_loop_is_frame_0() {
        for (frames, fps) in [(2, 1.0), (240, 24.0), (1439, 23.976), (30_000, 30.0)] {
            let looped = Sequence {
                fps,
                looped: true,
                ..sequence(frames, "1/1")
            };
            assert_eq!(looped.change(0), None);
            let begun = Change {
                earlier_s: looped.seconds(0),
                progress: 1.0,
            };
            assert_eq!(looped.change(frames), Some(begun));
            let changes = (1..frames).filter_map(|number| looped.change(number));
            let progress: Vec<f32> = changes.map(|change| change.progress).collect();
            // All of a short loop, the last minute of a long one.
            let expected = f64::from(frames).min(CHANGE_S * fps).ceil() as usize - 1;
            assert_eq!(progress.len(), expected);
            assert!(progress.is_sorted() && progress.iter().all(|p| (0.0..1.0).contains(p)));
        }
        assert_eq!(sequence(240, "1/1").change(239), None);
    }

    #[test]
    fn what_is_no_part_is_refused() {
        assert_eq!("2/4".parse(), Ok(Shard { index: 2, count: 4 }));
        for text in [
            "",
            "1",
            "0/4",
            "5/4",
            "1/0",
            "-1/4",
            "1/2/3",
            "a/b",
            "1/1000001",
            "1.5/2",
        ] {
            let error = text.parse::<Shard>().unwrap_err();
            assert!(error.contains("PART/PARTS"), "{text}");
        }
    }

    #[test]
    fn frames_are_known_by_their_names() {
        assert_eq!(file_name(7, "png"), "frame-000007.png");
        assert_eq!(file_name(MOST_FRAMES - 1, "exr"), "frame-999999.exr");
        for name in ["frame-000007.png", "frame-999999.exr"] {
            assert!(is_frame(name));
        }
        for name in [
            "frame-7.png",
            "frame-0000007.png",
            "frame-00000a.png",
            "frame-000007.gif",
            "frame-000007",
            "my-frame-000007.png",
            "frame-000007.png.txt",
        ] {
            assert!(!is_frame(name), "{name}");
        }
    }

    #[test]
    fn a_folder_with_something_else_in_it_is_refused() {
        let parent = tempfile::tempdir().unwrap();
        let place = parent.path().join("frames");
        open_folder(&place).unwrap();
        fs::write(place.join("frame-000003.png"), "").unwrap();
        for litter in [
            ".welkin-abc123.lock",
            ".DS_Store",
            "Thumbs.db",
            "._frame-000003.png",
        ] {
            fs::write(place.join(litter), "").unwrap();
        }
        open_folder(&place).unwrap();
        fs::write(place.join("notes.txt"), "").unwrap();
        let error = open_folder(&place).unwrap_err();
        assert!(error.to_string().contains("notes.txt"), "{error}");
        assert!(open_folder(&parent.path().join("none/frames")).is_err());
    }
}
