//! Target of libFuzzer; `MOTET_FUZZ` names it.
#![no_main]

use std::sync::LazyLock;

static TARGET: LazyLock<fn(&[u8])> =
    LazyLock::new(|| motet_fuzz::target(&std::env::var("MOTET_FUZZ").unwrap_or_default()));

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| LazyLock::force(&TARGET)(bytes));
