//! The [`Workbench`] as a WebAssembly module without imports, for a page that needs no server.
//!
//! A page calls [`question`] with the length of a question in bytes, writes the question in JSON and UTF-8 to
//! the address that comes back, calls [`answer`], and reads as many bytes as that returns at the address of
//! [`answer_address`]. An instance that has panicked is of no further use; the page makes a new one.

use std::cell::RefCell;

use motet::workbench::Workbench;

thread_local! {
    static BENCH: RefCell<Bench> = RefCell::default();
}

/// Workbench with the texts that cross the border.
#[derive(Default)]
struct Bench {
    workbench: Workbench,
    question: Vec<u8>,
    answer: Vec<u8>,
}

/// Makes room for a question of so many bytes, and returns its address.
#[unsafe(no_mangle)]
pub extern "C" fn question(bytes: usize) -> *mut u8 {
    BENCH.with_borrow_mut(|bench| {
        bench.question = vec![0; bytes];
        bench.question.as_mut_ptr()
    })
}

/// Answers the question that was written. Returns the number of bytes of the answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer() -> usize {
    BENCH.with_borrow_mut(|bench| {
        let question = String::from_utf8_lossy(&bench.question);
        bench.answer = bench.workbench.answer(&question).into_bytes();
        bench.answer.len()
    })
}

/// Address of the last answer.
#[unsafe(no_mangle)]
pub extern "C" fn answer_address() -> *const u8 {
    BENCH.with_borrow(|bench| bench.answer.as_ptr())
}
