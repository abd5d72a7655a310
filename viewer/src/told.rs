//! What a person is told: errors as one line, what earlier runs have left, and what goes to standard output.

use std::borrow::Cow;
use std::io::{ErrorKind, Write};

use anyhow::anyhow;
use welkin_pack::shown;
use welkin_pack::whole::Leftover;

/// The error and its causes, each of them once: many a message has its cause in it already. Quoted as texts of files are.
pub fn told(error: &anyhow::Error) -> String {
    let mut text = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !text.contains(&cause) {
            text += ": ";
            text += &cause;
        }
    }
    match shown(&text) {
        Cow::Borrowed(_) => text,
        Cow::Owned(quoted) => quoted,
    }
}

/// Tells what earlier runs have left beside an output.
pub fn tell_leftovers(leftovers: &[Leftover]) {
    for leftover in leftovers {
        writeln!(std::io::stderr(), "{leftover}").ok();
    }
}

/// Writes text to standard output, at once.
pub fn print(text: &str) -> anyhow::Result<()> {
    let mut stdout = std::io::stdout().lock();
    let written = stdout.write_all(text.as_bytes());
    match written.and_then(|()| stdout.flush()) {
        // Whoever read the pipe has seen enough.
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written.map_err(|e| {
            anyhow!("standard output: cannot be written: {e}; make room where it goes")
        }),
    }
}

#[cfg(test)]
mod tests {
    use std::io;

    use anyhow::Context;
    use welkin_baker::BakeError;
    use welkin_pack::Pack;

    use super::*;

    #[test]
    fn a_cause_that_a_message_has_in_it_is_not_repeated() {
        let source = io::Error::new(io::ErrorKind::NotFound, "there is none");
        let (file, key) = ("sky".to_string(), "stars.file".to_string());
        let error = BakeError::Read { file, key, source };
        let text = error.to_string();
        assert!(text.contains("there is none"), "{text}");
        assert_eq!(told(&error.into()), text);
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("pack.json"), "{}").unwrap();
        let unreadable = Pack::open(folder.path()).unwrap_err();
        let text = unreadable.to_string();
        assert_eq!(told(&unreadable.into()), text);
    }

    #[test]
    fn a_cause_that_a_message_leaves_out_follows_it() {
        let error = Err::<(), _>(anyhow!("it is wet")).context("no fire");
        assert_eq!(told(&error.unwrap_err()), "no fire: it is wet");
    }

    #[test]
    fn the_words_of_a_file_stay_on_their_line() {
        assert_eq!(told(&anyhow!("a\u{1b}[2J\nb")), r"a\u{1b}[2J\nb");
    }
}
