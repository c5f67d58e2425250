//! The small commands from outside: `robots`, `explain`, `schema`, `completions`.

use crate::support::Place;
use serde_json::Value;

#[test]
fn answers() {
    let place = Place::new("commands");
    for (line, code, texts) in [
        ("robots", 0, &["out:hsr", "out:anymal_z1"][..]),
        ("robots list", 0, &["out:hsr"]),
        ("robots show hsr", 0, &["out:action pick(", "out:/// ", "out:perception detect("]),
        ("robots show anymal_z1", 0, &["out:wake_up", "out:contains camera"]),
        ("robots show hs", 2, &["err:did you mean `hsr`?"]),
        ("explain", 0, &["out:M0501"]),
        ("explain M0501", 0, &["out:M0501"]),
        ("explain m0501", 0, &["out:M0501"]),
        ("explain M9999", 2, &["err:no diagnostic code `M9999`"]),
        ("schema", 2, &["err:Usage"]),
        ("schema dog", 2, &["err:policy, scene, robot, diagnostic"]),
        ("completions bash", 0, &["out:_motet"]),
        ("completions zsh", 0, &["out:#compdef motet"]),
        ("completions fish", 0, &["out:complete -c motet"]),
        ("completions cmd", 2, &["err:possible values"]),
    ] {
        println!("motet {line}");
        place.run(line).check(code, texts);
    }
}

#[test]
fn describes_the_formats() {
    let place = Place::new("schemas");
    for (of, key) in [("policy", "steps"), ("scene", "entities"), ("robot", "name"), ("diagnostic", "code")] {
        let schema: Value =
            serde_json::from_str(&place.run(&format!("schema {of}")).check(0, &[]).stdout).unwrap();
        assert!(schema["$schema"].is_string(), "{of}");
        assert!(schema["properties"][key].is_object(), "{of} has {key}");
    }
}
