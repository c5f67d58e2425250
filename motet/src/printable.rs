//! Texts from elsewhere, as people see them.

use motet_syntax::render::is_steering;

/// Maximum length of a shown text from another process, in characters.
const MAX_SHOWN_CHARS: usize = 500;

/// Text from another process as one line for a terminal. Control and bidirectional characters are escaped
/// (`\u{1b}`), and a long text is cut.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut shown = String::new();
    for (index, letter) in text.chars().enumerate() {
        if index == MAX_SHOWN_CHARS {
            shown.push('…');
            break;
        }
        if is_steering(letter) { shown.extend(letter.escape_default()) } else { shown.push(letter) }
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::{MAX_SHOWN_CHARS, escape};

    #[test]
    fn escape_escapes_control_characters_and_cuts() {
        assert_eq!(escape("gripper 40 °C, ok"), "gripper 40 °C, ok");
        assert_eq!(escape("a\u{1b}[2Jb\u{9b}c\nd\u{202e}e"), r"a\u{1b}[2Jb\u{9b}c\nd\u{202e}e");
        assert_eq!(escape(&"x".repeat(900_000)).chars().count(), MAX_SHOWN_CHARS + 1);
    }
}
