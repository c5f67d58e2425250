//! The border between C and Rust: pointers become references, errors become texts, panics stay here.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

thread_local! {
    static LAST: RefCell<Option<CString>> = const { RefCell::new(None) };
}

/// Returns the reason why the last function that this thread called failed; null if it did not fail. Valid
/// until the thread calls the next function of this library.
#[unsafe(no_mangle)]
pub extern "C" fn motet_last_error() -> *const c_char {
    LAST.with_borrow(|last| last.as_ref().map_or(std::ptr::null(), |last| last.as_ptr()))
}

/// Frees a string that a function of this library returned; null does nothing.
///
/// # Safety
///
/// `string` is null, or came from this library and was not freed yet.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn motet_string_free(string: *mut c_char) {
    if !string.is_null() {
        // SAFETY: it came from `CString::into_raw` in `string_out`, says the caller.
        drop(unsafe { CString::from_raw(string) });
    }
}

/// Runs the body of a function: its result, or `failed` after an error, whose text is kept.
pub(crate) fn guarded<T>(failed: T, run: impl FnOnce() -> Result<T, String>) -> T {
    let ran = catch_unwind(AssertUnwindSafe(run));
    let ran = ran.unwrap_or_else(|_| {
        Err("a fault in the library itself: do not use the arguments of the call again".to_owned())
    });
    match ran {
        Ok(value) => {
            LAST.set(None);
            value
        }
        Err(why) => {
            LAST.set(Some(c_string(why)));
            failed
        }
    }
}

/// Moves a value behind a handle.
pub(crate) fn handle<T>(value: T) -> *mut T {
    Box::into_raw(Box::new(value))
}

/// Frees a handle; null does nothing.
///
/// # Safety
///
/// It is null, or came from [`handle`] and was not freed yet.
pub(crate) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: it came from `Box::into_raw`, says the caller.
        let value = unsafe { Box::from_raw(handle) };
        guarded((), || {
            drop(value);
            Ok(())
        });
    }
}

/// The value behind a handle.
///
/// # Safety
///
/// It is null or a live handle that nobody changes meanwhile.
pub(crate) unsafe fn shared<'h, T>(handle: *const T, what: &str) -> Result<&'h T, String> {
    // SAFETY: it is null or live, says the caller.
    unsafe { handle.as_ref() }.ok_or_else(|| format!("the {what} is null"))
}

/// The value behind a handle, to change it.
///
/// # Safety
///
/// It is null or a live handle that nobody else uses meanwhile.
pub(crate) unsafe fn exclusive<'h, T>(handle: *mut T, what: &str) -> Result<&'h mut T, String> {
    // SAFETY: it is null or live, and nobody else's, says the caller.
    unsafe { handle.as_mut() }.ok_or_else(|| format!("the {what} is null"))
}

/// A string that may be missing.
///
/// # Safety
///
/// It is null or ends with a null byte, and does not change meanwhile.
pub(crate) unsafe fn string<'s>(string: *const c_char, what: &str) -> Result<Option<&'s str>, String> {
    if string.is_null() {
        return Ok(None);
    }
    // SAFETY: it ends with a null byte, says the caller.
    let text = unsafe { CStr::from_ptr(string) };
    text.to_str().map(Some).map_err(|_| format!("the {what} is no UTF-8"))
}

/// `count` values from an address, which may be null if there are none.
///
/// # Safety
///
/// The address is null, or `count` values stand there, and do not change meanwhile.
pub(crate) unsafe fn slice<'s, T>(first: *const T, count: usize, what: &str) -> Result<&'s [T], String> {
    if count == 0 {
        return Ok(&[]);
    }
    room(first, count, what)?;
    // SAFETY: it is aligned and no larger than memory can be; so many values stand there, says the caller.
    Ok(unsafe { std::slice::from_raw_parts(first, count) })
}

/// Room for `count` values, to be written.
///
/// # Safety
///
/// The address is null, or has room for `count` values, which nobody else uses meanwhile.
pub(crate) unsafe fn slice_mut<'s, T>(
    first: *mut T,
    count: usize,
    what: &str,
) -> Result<&'s mut [T], String> {
    if count == 0 {
        return Ok(&mut []);
    }
    room(first, count, what)?;
    // SAFETY: as above, and nobody else's, says the caller.
    Ok(unsafe { std::slice::from_raw_parts_mut(first, count) })
}

fn room<T>(first: *const T, count: usize, what: &str) -> Result<(), String> {
    if first.is_null() || !first.is_aligned() {
        return Err(format!("there is no address of the {what}"));
    }
    let bytes = count.checked_mul(size_of::<T>()).filter(|bytes| isize::try_from(*bytes).is_ok());
    bytes.map(|_| ()).ok_or_else(|| format!("the {what} has more bytes than there can be"))
}

/// A string that the caller frees.
pub(crate) fn string_out(text: impl Into<Vec<u8>>) -> *mut c_char {
    c_string(text).into_raw()
}

/// A string without its null bytes.
fn c_string(text: impl Into<Vec<u8>>) -> CString {
    let mut bytes = text.into();
    bytes.retain(|byte| *byte != 0);
    CString::new(bytes).unwrap_or_default()
}
