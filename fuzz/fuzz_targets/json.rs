//! The JSON syntax: whatever is read without an error prints, and what was printed reads as the same tree.
#![no_main]

use libfuzzer_sys::fuzz_target;
use motet_syntax::ast::Item;
use motet_syntax::{FileId, Severity, Source, Syntax, print, read};

fuzz_target!(|text: &str| {
    let parsed = read(&Source::new("fuzz", text), FileId(0));
    let is_broken = parsed.diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error);
    if is_broken || parsed.syntax == Syntax::Text {
        return;
    }
    for item in &parsed.file.items {
        let Item::Policy(policy) = item else { continue };
        let printed = print::policy_json(policy);
        let formatted = motet_syntax::format(&Source::new("printed", printed.as_str())).unwrap_or_default();
        assert_eq!(printed, formatted);
    }
});
