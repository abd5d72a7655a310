//! Text of a file as a message may quote it.

use std::borrow::Cow;

/// The text with every character escaped that a terminal obeys instead of showing it: control characters, line ends
/// among them, and those that change the direction of the text around them. They become `\n` or `\u{1b}`, as Rust
/// writes them; a backslash stays one, so escaping twice does no harm.
///
/// What a pack, a recipe, a model or the name of a file says is quoted through this wherever a person reads it: else a
/// name could clear the screen, pass for another line of the output, or read from right to left.
///
/// ```
/// assert_eq!(welkin_pack::shown("red \u{1b}[31m\nsky"), r"red \u{1b}[31m\nsky");
/// ```
pub fn shown(text: &str) -> Cow<'_, str> {
    if !text.contains(is_obeyed) {
        return Cow::Borrowed(text);
    }
    let mut escaped = String::with_capacity(text.len() + 16);
    for letter in text.chars() {
        if is_obeyed(letter) {
            escaped.extend(letter.escape_default());
        } else {
            escaped.push(letter);
        }
    }
    Cow::Owned(escaped)
}

/// The Unicode Standard, version 16: general category Cc; the separators of lines and paragraphs; the property
/// `Bidi_Control`.
fn is_obeyed(letter: char) -> bool {
    letter.is_control()
        || matches!(
            letter,
            '\u{2028}' | '\u{2029}' | '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'
                ..='\u{202e}' | '\u{2066}'..='\u{2069}'
        )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_can_be_shown_stays_as_it_is() {
        for text in [
            "",
            "clouds.size",
            "Wölkchen 雲 ☁️ \u{301}",
            r"C:\sky\n.toml",
        ] {
            assert!(matches!(shown(text), Cow::Borrowed(same) if same == text));
        }
    }

    #[test]
    fn nothing_is_left_that_a_terminal_obeys() {
        let obeyed = (0..0x20).chain(0x7f..0xa0).chain([0x202e, 0x2066, 0x2029]);
        for code in obeyed {
            let letter = char::from_u32(code).unwrap();
            let text = format!("a{letter}b");
            let quoted = shown(&text);
            assert!(!quoted.contains(letter), "{code:x}");
            assert!(quoted.starts_with("a\\") && quoted.ends_with('b'));
            assert_eq!(shown(&quoted), quoted);
        }
    }
}
