//! The example in C compiles against the header and the library, and what it writes at random checks.

use std::path::Path;
use std::process::Command;

use motet_decode::Environment;
use motet_syntax::{FileId, Severity, Source};

#[test]
fn example_writes_policies_that_check() {
    if !Command::new("cc").arg("--version").output().is_ok_and(|ran| ran.status.success()) {
        println!("skipped: there is no compiler `cc`");
        return;
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    // The library lies where this test does.
    let library = std::env::current_exe().unwrap().parent().unwrap().to_owned();
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("random");
    let compiled = Command::new("cc")
        .args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-pedantic", "-D_XOPEN_SOURCE=700"])
        .arg(folder.join("examples/random.c"))
        .arg("-I")
        .arg(folder.join("include"))
        .arg("-L")
        .arg(&library)
        .args(["-lmotetdecode", "-lm", "-o"])
        .arg(&program)
        .output()
        .unwrap();
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let ran = Command::new(&program)
        .arg("10")
        .env("LD_LIBRARY_PATH", &library)
        .env("DYLD_LIBRARY_PATH", &library)
        .output()
        .unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let text = String::from_utf8(ran.stdout).unwrap();
    assert_eq!(text.lines().count(), 10);
    let session = Environment { robot: Some("hsr"), scene: Some("kitchen"), ..Environment::default() }
        .session()
        .unwrap();
    for policy in text.lines() {
        let said = session.check(&motet_syntax::read(&Source::new("policy.json", policy), FileId(0)));
        let wrong: Vec<_> = said.iter().filter(|said| said.severity == Severity::Error).collect();
        assert!(wrong.is_empty(), "{policy}: {wrong:?}");
    }
}
