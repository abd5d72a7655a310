//! The sky as a command line that draws it again without a window.

use std::path::Path;

use welkin_controls::Settings;

/// The words of `welkin-view render` that draw this moment in this size, for a POSIX shell.
pub fn render(pack: &Path, picture: &str, size_px: [u32; 2], settings: &Settings) -> String {
    let [width, height] = size_px;
    let mut words = ["welkin-view", "render"].map(String::from).to_vec();
    words.push(pack.display().to_string());
    words.extend(["-o", picture, "--size"].map(String::from));
    words.push(format!("{width}x{height}"));
    words.extend(settings.options());
    let quoted: Vec<String> = words.iter().map(|word| quoted(word)).collect();
    quoted.join(" ")
}

/// A word that a shell takes as it is.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_string();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_gets_every_word_whole() {
        let mut settings = Settings::default();
        settings.set("method", "lit").unwrap();
        settings.set("sun", "false").unwrap();
        let command = render(Path::new("my packs/it's"), "sky.png", [800, 600], &settings);
        assert_eq!(
            command,
            r"welkin-view render 'my packs/it'\''s' -o sky.png --size 800x600 --method lit --no-sun"
        );
    }
}
