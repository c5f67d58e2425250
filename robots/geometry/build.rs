//! Tells the code of batches whether it is optimised.
//!
//! All of it is inlined into one function for each kind of processor. Without an optimiser that function
//! would keep every intermediate vector on the stack, 8 MB of them; then nothing is inlined.

#![allow(
    clippy::disallowed_methods,
    reason = "a build script reads what cargo tells it from the environment"
)]

fn main() {
    println!("cargo::rustc-check-cfg=cfg(optimised)");
    println!("cargo::rerun-if-changed=build.rs");
    if std::env::var("OPT_LEVEL").is_ok_and(|level| level != "0") {
        println!("cargo::rustc-cfg=optimised");
    }
}
