//! The header agrees with the functions; `MOTET_BLESS=1` writes it anew.

use std::path::Path;

#[test]
fn header_is_current() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for file in ["border", "environment", "vocabulary", "decoder"] {
        builder = builder.with_src(folder.join(format!("src/{file}.rs")));
    }
    let mut made = Vec::new();
    builder.generate().unwrap().write(&mut made);
    let path = folder.join("include/motet.h");
    if std::env::var_os("MOTET_BLESS").is_some() {
        std::fs::write(&path, &made).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == String::from_utf8(made).unwrap(),
        "include/motet.h is not current: MOTET_BLESS=1 cargo test -p motet-decode-c"
    );
}
