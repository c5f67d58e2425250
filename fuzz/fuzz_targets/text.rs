//! The text syntax: whatever is read prints, and what was printed reads as the same tree and formats to
//! itself.
#![no_main]

use libfuzzer_sys::fuzz_target;
use motet_syntax::{FileId, Severity, Source, Syntax, print, read};

fuzz_target!(|text: &str| {
    let parsed = read(&Source::new("fuzz", text), FileId(0));
    let is_broken = parsed.diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error);
    if is_broken || parsed.syntax == Syntax::Json {
        return;
    }
    let printed = print::text(&parsed.file);
    let again = read(&Source::new("printed", printed.as_str()), FileId(0));
    assert!(again.diagnostics.is_empty(), "{printed}");
    assert!(parsed.file == again.file, "{printed}");
    let formatted = motet_syntax::format(&Source::new("fuzz", text)).unwrap_or_default();
    assert_eq!(motet_syntax::format(&Source::new("fuzz", formatted.as_str())).as_ref(), Ok(&formatted));
});
