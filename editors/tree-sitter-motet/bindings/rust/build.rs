//! Compiles the generated parser.

#![allow(clippy::print_stdout, reason = "cargo reads what a build script prints")]

fn main() {
    cc::Build::new()
        .std("c11")
        .include("src")
        .file("src/parser.c")
        .warnings(false)
        .compile("tree-sitter-motet");
    println!("cargo:rerun-if-changed=src/parser.c");
}
