//! Line that a person types at a terminal while a robot moves. The letters are read as they are typed, so
//! that a view that redraws the screen can show them below itself. A thread reads; the terminal is as it was
//! before once the reading has ended.

use std::io::{self, IsTerminal, Read};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::Sender;
use std::sync::{Mutex, PoisonError};

use crate::output::prompt;

/// The line so far.
static LINE: Mutex<String> = Mutex::new(String::new());
/// True while letters are read as they are typed.
static IS_READ: AtomicBool = AtomicBool::new(false);
/// True while a view draws the line.
static IS_DRAWN: AtomicBool = AtomicBool::new(false);
/// The most bytes of a line.
const MOST_BYTES: usize = 4096;

/// The line so far, for a view that draws it; `None` if no letters are read.
pub(crate) fn current() -> Option<String> {
    IS_READ.load(Ordering::SeqCst).then(|| LINE.lock().unwrap_or_else(PoisonError::into_inner).clone())
}

/// Tells if a view draws the line. If none does, it is shown as it is typed.
pub(crate) fn set_drawn(is_drawn: bool) {
    IS_DRAWN.store(is_drawn, Ordering::SeqCst);
}

/// Shows the line at the place of the cursor.
pub(crate) fn show() {
    if let Some(line) = current() {
        prompt(&format!("\r\u{1b}[K> {line}"));
    }
}

/// Reader of a terminal's letters. Dropped, it leaves the terminal as it was.
pub(crate) struct LetterReader;

impl Drop for LetterReader {
    fn drop(&mut self) {
        restore();
    }
}

/// Reads the letters of a terminal, and sends each line to its end. `None` if stdin is no terminal, or if its
/// letters cannot be read one by one.
pub(crate) fn read(lines: &Sender<String>) -> Option<LetterReader> {
    if !io::stdin().is_terminal() || !mode::begin() {
        return None;
    }
    IS_READ.store(true, Ordering::SeqCst);
    let lines = lines.clone();
    std::thread::spawn(move || {
        let mut stdin = io::stdin().lock();
        let (mut byte, mut letters) = ([0], Vec::new());
        while let Ok(1) = stdin.read(&mut byte) {
            letters.extend(byte);
            // A letter may have several bytes.
            let letter = match std::str::from_utf8(&letters) {
                Ok(text) => text.chars().next(),
                Err(error) if error.error_len().is_none() => continue,
                Err(_) => None,
            };
            letters.clear();
            let Some(letter) = letter else { continue };
            if !take(letter, &lines) {
                return;
            }
        }
    });
    Some(LetterReader)
}

/// Takes a letter. False once nobody reads on, or at the end of the input.
fn take(letter: char, lines: &Sender<String>) -> bool {
    let mut line = LINE.lock().unwrap_or_else(PoisonError::into_inner);
    match letter {
        '\n' | '\r' => {
            let line = std::mem::take(&mut *line);
            if !IS_DRAWN.load(Ordering::SeqCst) {
                prompt("\n");
            }
            return lines.send(line).is_ok();
        }
        // Ctrl-D at the beginning of a line ends the input.
        '\u{4}' if line.is_empty() => return false,
        '\u{7f}' | '\u{8}' => {
            line.pop();
        }
        // Ctrl-U
        '\u{15}' => line.clear(),
        letter if letter.is_control() || line.len() >= MOST_BYTES => {}
        letter => line.push(letter),
    }
    drop(line);
    if !IS_DRAWN.load(Ordering::SeqCst) {
        show();
    }
    true
}

/// Leaves the terminal as it was before.
pub(crate) fn restore() {
    if IS_READ.swap(false, Ordering::SeqCst) {
        mode::end();
    }
}

#[cfg(unix)]
mod mode {
    use std::sync::{Mutex, PoisonError};

    use rustix::stdio::stdin;
    use rustix::termios::{LocalModes, OptionalActions, Termios, tcgetattr, tcsetattr};

    /// Mode of the terminal before.
    static BEFORE: Mutex<Option<Termios>> = Mutex::new(None);

    /// Lets letters be read one by one, without an echo. False if the terminal cannot do that.
    pub(super) fn begin() -> bool {
        let Ok(before) = tcgetattr(stdin()) else { return false };
        let mut mode = before.clone();
        mode.local_modes.remove(LocalModes::ICANON | LocalModes::ECHO);
        let is_set = tcsetattr(stdin(), OptionalActions::Now, &mode).is_ok();
        if is_set {
            *BEFORE.lock().unwrap_or_else(PoisonError::into_inner) = Some(before);
        }
        is_set
    }

    pub(super) fn end() {
        if let Some(before) = BEFORE.lock().unwrap_or_else(PoisonError::into_inner).take() {
            // Nothing can be done about a terminal that is gone.
            let _ = tcsetattr(stdin(), OptionalActions::Now, &before);
        }
    }
}

#[cfg(not(unix))]
mod mode {
    pub(super) const fn begin() -> bool {
        false
    }

    pub(super) const fn end() {}
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc::channel;

    #[test]
    fn typed_line_is_edited_and_ends() {
        let (lines, typed) = channel();
        super::set_drawn(true);
        for letter in "sty\u{7f}op\u{1b}\n".chars() {
            assert!(super::take(letter, &lines));
        }
        assert_eq!(typed.try_recv(), Ok("stop".to_owned()));
        for letter in "abc\u{15}ü\u{4}\r".chars() {
            assert!(super::take(letter, &lines));
        }
        assert_eq!(typed.try_recv(), Ok("ü".to_owned()));
        assert!(!super::take('\u{4}', &lines));
    }
}
