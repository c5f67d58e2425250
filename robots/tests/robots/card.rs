//! Robot cards: the built-in ones are right, every mistake is told at its place, and no text makes the
//! reader panic.

use motet_robots::builtin::{BuiltinRobot, ROBOTS};
use motet_robots::card::{self, Robot};
use motet_syntax::{Diagnostic, FileId, Source};
use proptest::prelude::*;

/// A card without a mistake.
const GOOD: &str = r#"
name = "cart"
title = "Cart"
observe_within = 0.2
observes = ["holding"]

[base]
drive = "differential"
speed = "0.5 m/s"
turn = 1.0
radius = "30 cm"

[hands.hand]
payload = "500 g"
opening = 0.08
reach = "60 cm"
heights = { least = "0 m", greatest = "1 m" }

[cameras.eye]
range = 3
view = "90 deg"

[resources]
base = []
arm = ["hand", "eye"]
hand = []
eye = []

[numbers]
tray = "2 kg"

[primitives]
go = {}
lift.by = { least = 0, greatest = "40 cm" }
"#;

fn read(text: &str) -> (Option<Robot>, Vec<Diagnostic>, Source) {
    let source = Source::new("robot.toml", text);
    let (robot, found) = card::read(&source, FileId(0), None);
    (robot, found, source)
}

/// `GOOD` with `from` replaced by `to` says exactly this: lines of `CODE [text under the span] message /
/// help`.
fn check(from: &str, to: &str, expected: &[&str]) {
    assert_eq!(GOOD.matches(from).count(), 1, "`{from}` must stand once in the card");
    let (robot, found, source) = read(&GOOD.replacen(from, to, 1));
    let told: Vec<String> = found.iter().map(|found| told(found, &source)).collect();
    assert_eq!(told, expected);
    assert_eq!(robot.is_some(), !told.iter().any(|line| !line.starts_with("M0425")));
}

fn told(found: &Diagnostic, source: &Source) -> String {
    let under = source.slice(found.span);
    let help = found.help.as_ref().map(|help| format!(" / {help}")).unwrap_or_default();
    format!("{} [{under}] {}{help}", found.code, found.message)
}

/// The clearance that a card gives, or that follows from the errors of localisation and tracking.
#[test]
fn clearance_follows_from_the_errors_of_a_card() {
    let clearance = |sections: &str| {
        let (robot, found, _) = read(&GOOD.replacen("[hands.hand]", &format!("{sections}\n[hands.hand]"), 1));
        assert_eq!(found, []);
        let card::Robot { clearance, .. } = robot.unwrap();
        (clearance.base_m, clearance.arm_m)
    };
    assert_eq!(clearance(""), (0.0, 0.0));
    assert_eq!(clearance("[errors]\nlocalisation = \"3 cm\"\ntracking = 0.01"), (0.04, 0.01));
    assert_eq!(clearance("[errors]\ntracking = \"5 mm\""), (0.005, 0.005));
    assert_eq!(clearance("[errors]\ntracking = 0.01\n[clearance]\nbase = \"8 cm\""), (0.08, 0.01));
    assert_eq!(clearance("[clearance]\nbase = 0.5\narm = 0"), (0.5, 0.0));
    let section = |text: &str| format!("{text}\n\n[hands.hand]");
    let expected = ["M0416 [\"1 m\"] `clearance.base` is 1 m, but must be at most 0.5 m"];
    check("[hands.hand]", &section("[clearance]\nbase = \"1 m\""), &expected);
    let expected = ["M0416 [0.3] `errors.localisation` is 0.3 m, but must be at most 0.25 m"];
    check("[hands.hand]", &section("[errors]\nlocalisation = 0.3"), &expected);
    let expected = ["M0416 [-0.1] `clearance.arm` is -0.1, but must be zero or more"];
    check("[hands.hand]", &section("[clearance]\narm = -0.1"), &expected);
}

#[test]
fn card_reader_reads_a_complete_card() {
    let (robot, found, _) = read(GOOD);
    assert_eq!(found, []);
    let robot = robot.unwrap();
    let hand = &robot.hands["hand"];
    assert_eq!((hand.payload_kg, hand.opening_m, hand.reach_m), (0.5, 0.08, 0.6));
    assert_eq!(robot.cameras["eye"].view_rad, std::f64::consts::FRAC_PI_2);
    assert_eq!(robot.primitives["lift"]["by"].greatest, 0.4);
    assert_eq!(robot.numbers["tray"], (2.0, "Mass".into()));
    assert_eq!(robot.numbers["payload"], (0.5, "Mass".into()));
    assert_eq!(robot.resources["arm"], ["hand", "eye"]);
    assert_eq!(robot.manners, card::Manners::default());
}

#[test]
fn card_reader_reads_manners() {
    let table = "[manners]\nslowly = { speed = \"40 %\", acceleration = 0.2 }\n\n[numbers]";
    let (robot, found, _) = read(&GOOD.replacen("[numbers]", table, 1));
    assert_eq!(found, []);
    let manners = robot.unwrap().manners;
    assert_eq!(manners.slowly, card::MannerSpec { speed: 0.4, acceleration: 0.2 });
    assert_eq!(manners.gently, card::Manners::default().gently);
    let wrong = "[manners]\ngently = { speed = 1.5, acceleration = 0 }\n\n[numbers]";
    let told = [
        "M0416 [1.5] `manners.gently.speed` is 1.5, but must be at most 1",
        "M0416 [0] `manners.gently.acceleration` is 0, but must be above zero",
    ];
    check("[numbers]", wrong, &told);
}

#[test]
fn builtin_cards_have_no_diagnostics() {
    for BuiltinRobot { name, card: toml, declarations, .. } in ROBOTS {
        let (robot, found) = card::read(&Source::new(name, toml), FileId(0), declarations);
        assert_eq!(found, [], "{name}");
        assert_eq!(robot.unwrap().name, name);
    }
}

#[test]
fn builtin_declarations_have_no_diagnostics() {
    for BuiltinRobot { name, card: toml, declarations, .. } in ROBOTS {
        let (robot, _) = card::read(&Source::new(name, toml), FileId(0), declarations);
        let robot = robot.unwrap();
        // An empty document is a mistake of its own; a card without declarations has an empty text.
        if !robot.declarations.is_empty() {
            let file = motet_syntax::read(&Source::new(name, robot.declarations), FileId(0));
            assert_eq!(file.diagnostics, [], "{name}");
        }
        for fact in &robot.initially {
            assert!(motet_syntax::text::parse_condition(fact).is_ok(), "{name}: {fact}");
        }
    }
}

#[test]
fn card_reader_reports_other_text() {
    check(
        "turn = 1.0",
        "turn = = 1.0",
        &["M0411 [=] this is not TOML: extra `=`, expected nothing / a card is a TOML document: `key = \
                value` lines under `[section]` headers"],
    );
    check(
        "turn = 1.0",
        "turn = 1.0\nturn = 2.0",
        &["M0411 [turn] this is not TOML: duplicate key / a card is a TOML document: `key = value` lines \
                under `[section]` headers"],
    );
}

#[test]
fn card_reader_reports_all_wrong_keys_at_once() {
    check(
        "turn = 1.0",
        "trun = 1.0",
        &[
            "M0413 [[base]] `base` has no `turn` / add `turn = …` under `[base]`",
            "M0412 [trun] unknown key `trun` / did you mean `turn`?",
        ],
    );
    check(
        "title = \"Cart\"",
        "colour = 3",
        &[
            "M0413 [] the card has no `title` / add `title = …` at the top of the card",
            "M0412 [colour] unknown key `colour` / possible here: `title`, `manners`, `clearance`, `errors`, \
             `initially`, `model` or `postures`",
        ],
    );
}

#[test]
fn card_reader_reports_wrong_types() {
    check("turn = 1.0", "turn = \"fast\"", &["M0414 [\"fast\"] `base.turn` is a text, but must be a number"]);
    check(
        "arm = [\"hand\", \"eye\"]",
        "arm = \"hand\"",
        &["M0414 [\"hand\"] `resources.arm` is a text, but must be a list"],
    );
    check("[\"holding\"]", "[7]", &["M0414 [7] `observes` is a whole number, but must be a text"]);
    check(
        "\"differential\"",
        "\"diferential\"",
        &["M0415 [\"diferential\"] unknown word `diferential` / did you mean `differential`?"],
    );
}

#[test]
fn card_reader_reports_impossible_numbers() {
    check("turn = 1.0", "turn = nan", &["M0416 [nan] `base.turn` is NaN, but must be a finite number"]);
    check("range = 3", "range = 0", &["M0416 [0] `cameras.eye.range` is 0, but must be above zero"]);
    check(
        "\"500 g\"",
        "\"-1 kg\"",
        &["M0416 [\"-1 kg\"] `hands.hand.payload` is -1, but must be above zero"],
    );
    check(
        "\"60 cm\"",
        "1e9",
        &["M0416 [1e9] `hands.hand.reach` is 1000000000, but must be at most a million"],
    );
}

#[test]
fn card_reader_reports_wrong_units() {
    let help = "write a number and one of `m`, `cm`, `mm` or `km`, such as \"2 m\"";
    check(
        "\"60 cm\"",
        "\"2 feet\"",
        &[&format!(
            "M0417 [\"2 feet\"] `hands.hand.reach` is `2 feet`, which is not a number with a unit / {help}"
        )],
    );
    check(
        "\"60 cm\"",
        "\"60 kg\"",
        &["M0418 [\"60 kg\"] `hands.hand.reach` is not measured in `kg` / write it in `m`, `cm`, `mm` or \
                `km`"],
    );
    check(
        "least = 0,",
        "least = \"0 s\",",
        &["M0418 [\"40 cm\"] `lift.by.greatest` is not measured in `cm` / write it in `s`, `ms`, `min` or \
                `h`"],
    );
}

#[test]
fn card_reader_reports_wrong_resources() {
    check(
        "[\"hand\", \"eye\"]",
        "[\"hnad\"]",
        &["M0419 [\"hnad\"] there is no resource `hnad` / did you mean `hand`?"],
    );
    check(
        "hand = []",
        "hand = [\"arm\"]",
        &["M0420 [[\"hand\", \"eye\"]] a resource contains itself: `arm` contains `hand` contains `arm` / \
                let the larger part contain the smaller, and not the other way round"],
    );
    check(
        "[cameras.eye]",
        "[cameras.nose]",
        &["M0421 [[cameras.nose]] the camera `nose` is not listed as a resource / add `nose = []` under \
                `[resources]`"],
    );
}

#[test]
fn card_reader_reports_wrong_names_and_ranges() {
    check(
        "greatest = \"40 cm\"",
        "greatest = -1",
        &["M0422 [0] the lower bound of `lift.by` is 0, above the upper bound, -1"],
    );
    check(
        "\"cart\"",
        "\"my cart\"",
        &["M0423 [\"my cart\"] `my cart` is not a valid name / a name is a letter or `_`, then letters, \
                digits or `_`"],
    );
    check(
        "tray =",
        "payload =",
        &["M0424 [\"2 kg\"] `robot.payload` is already given by `hands` / give this number another name"],
    );
    check("[\"holding\"]", "[\"at\", \"at\"]", &["M0425 [\"at\"] `at` is listed twice / remove one"]);
    check(
        "[cameras.eye]",
        "[cameras.hand]",
        &["M0426 [[hands.hand]] `hand` is both a hand and a camera / name one of them differently: both \
                are resources"],
    );
}

proptest! {
    #[test]
    fn card_reader_never_panics(text in "\\PC*") {
        let _ = read(&text);
    }

    /// A card with a piece replaced by noise: most of it is still a card.
    #[test]
    fn card_reader_never_panics_on_damaged_cards(
        at in 0usize..900, length in 0usize..40, noise in "[\\[\\]{}=\"a-z0-9.\\- \n]{0,12}",
    ) {
        let start = at.min(GOOD.len());
        let end = (start + length).min(GOOD.len());
        let text = format!("{}{noise}{}", &GOOD[..start], &GOOD[end..]);
        let (robot, found, source) = read(&text);
        prop_assert!(robot.is_some() || !found.is_empty());
        for found in found {
            prop_assert!(found.span.end as usize <= source.text.len());
        }
    }
}

#[test]
fn builtin_cards_fit_their_urdfs() {
    for BuiltinRobot { name, card: toml, urdf, .. } in ROBOTS {
        let (urdf, found) = motet_robots::urdf::read(&Source::new("robot.urdf", urdf), FileId(0));
        assert_eq!(found, [], "{name}");
        assert_eq!(card::fit(&Source::new(name, toml), FileId(0), &urdf.unwrap()), [], "{name}");
    }
}

const URDF: &str = "<robot name='cart'><link name='base'/><link name='palm'/><link name='eye_frame'/>
    <joint name='lift' type='prismatic'><parent link='base'/><child link='palm'/>
      <limit lower='0' upper='0.5' velocity='1' effort='1'/></joint>
    <joint name='look' type='fixed'><parent link='base'/><child link='eye_frame'/></joint></robot>";

/// `GOOD` with these lines added to the sections says exactly this of the URDF.
fn check_fit(hand: &str, camera: &str, rest: &str, expected: &[&str]) {
    let text = GOOD.replacen("[cameras.eye]", &format!("{hand}\n[cameras.eye]"), 1).replacen(
        "[resources]",
        &format!("{camera}\n{rest}\n[resources]"),
        1,
    );
    let (robot, found, source) = read(&text);
    assert_eq!(found, []);
    assert!(robot.is_some());
    let (urdf, _) = motet_robots::urdf::read(&Source::new("robot.urdf", URDF), FileId(0));
    let found = card::fit(&source, FileId(0), &urdf.unwrap());
    let told: Vec<String> = found.iter().map(|found| told(found, &source)).collect();
    assert_eq!(told, expected);
}

#[test]
fn card_fit_reports_differences_from_the_urdf() {
    let model = "[model]\nurdf = 'robot.urdf'\nbase = 'base'\n[postures.home]\nlift = '20 cm'";
    check_fit("tip = 'palm'", "frame = 'eye_frame'", model, &[]);
    check_fit(
        "tip = 'plam'",
        "frame = 'eye_frame'",
        model,
        &["M0427 ['plam'] the URDF has no link `plam` / did you mean `palm`?"],
    );
    check_fit(
        "tip = 'palm'",
        "frame = 'eye_frame'",
        &model.replace("20 cm", "60 cm"),
        &["M0428 ['60 cm'] joint `lift` is at 0.6, outside its limits of 0 to 0.5"],
    );
    check_fit(
        "tip = 'palm'",
        "frame = 'eye_frame'",
        &model.replace("lift", "look"),
        &["M0427 ['20 cm'] the URDF has no joint that moves by itself called `look`"],
    );
    check_fit(
        "tip = 'palm'",
        "frame = 'eye_frame'",
        &model.replace("20 cm", "30 deg"),
        &["M0418 ['30 deg'] `lift` is not measured in `deg` / write it in `m`, `cm`, `mm` or `km`"],
    );
    let help = "set `tip` to the link of the hand at the end of the arm, and `base` to the foot of the arm \
        or a link before it";
    check_fit(
        "tip = 'eye_frame'",
        "frame = 'eye_frame'",
        model,
        &[&format!(
            "M0479 ['eye_frame'] no joint moves `eye_frame`, the tip of the hand `hand`, relative to the \
                base link `base` / {help}"
        )],
    );
    check_fit(
        "tip = 'palm'",
        "frame = 'eye_frame'",
        &model.replace("'base'", "'eye_frame'"),
        &[&format!(
            "M0479 ['palm'] the base link `eye_frame` does not carry `palm`, the tip of the hand `hand` / \
                {help}"
        )],
    );
    let posture = "[postures.home]\nlift = inf\n[resources]";
    let (_, found, source) = read(&GOOD.replacen("[resources]", posture, 1));
    assert_eq!(
        told(&found[0], &source),
        "M0416 [inf] `postures.home.lift` is inf, but must be a finite number"
    );
    let (_, found, _) = read(&GOOD.replacen("[cameras.eye]", "points = 'y'\n[cameras.eye]", 1));
    assert_eq!(found[0].code.0, "M0429");
}
