//! Diagnostics of a robot card (M0411 to M0430, M0450, M0479, M0480).

use motet_syntax::suggest::one_of;
use motet_syntax::{Related, Span};

motet_syntax::mistakes! {
    pub const CODES;

    /// The text is not TOML.
    NotToml("M0411", Error) { problem: String }
    message(m) { format!("this is not TOML: {}", m.problem) }
    help(_m) { Some("a card is a TOML document: `key = value` lines under `[section]` headers".to_owned()) }

    /// A key that a card does not have.
    UnknownKey("M0412", Error) { key: String, near: Option<String>, known: Vec<String> }
    message(m) { format!("unknown key `{}`", m.key) }
    help(m) { Some(known_or_near(m.near.as_deref(), &m.known)) }

    /// A key that a card must have.
    MissingKey("M0413", Error) { key: String, section: String }
    message(m) {
        if m.section.is_empty() {
            format!("the card has no `{}`", m.key)
        } else {
            format!("`{}` has no `{}`", m.section, m.key)
        }
    }
    help(m) {
        let at = if m.section.is_empty() {
            "at the top of the card".to_owned()
        } else {
            format!("under `[{}]`", m.section)
        };
        Some(format!("add `{} = …` {at}", m.key))
    }

    /// A value of the wrong type.
    WrongType("M0414", Error) { key: String, found: String, wanted: String }
    message(m) { format!("`{}` is {}, but must be {}", m.key, m.found, m.wanted) }

    /// A word that is none of the possible ones.
    UnknownWord("M0415", Error) { word: String, near: Option<String>, known: Vec<String> }
    message(m) { format!("unknown word `{}`", m.word) }
    help(m) { Some(known_or_near(m.near.as_deref(), &m.known)) }

    /// A number that no such robot can have.
    OutOfRange("M0416", Error) { key: String, actual: String, wanted: &'static str }
    message(m) { format!("`{}` is {}, but must be {}", m.key, m.actual, m.wanted) }

    /// A quantity that cannot be read.
    BadQuantity("M0417", Error) { key: String, text: String, units: Vec<&'static str> }
    message(m) { format!("`{}` is `{}`, which is not a number with a unit", m.key, m.text) }
    help(m) {
        let first = m.units.first().copied().unwrap_or("m");
        Some(format!("write a number and one of {}, such as \"2 {first}\"", one_of(m.units.iter().copied())))
    }

    /// A quantity of another dimension.
    WrongDimension("M0418", Error) { key: String, unit: &'static str, units: Vec<&'static str> }
    message(m) { format!("`{}` is not measured in `{}`", m.key, m.unit) }
    help(m) {
        Some(if m.units.is_empty() {
            "write a number without a unit".to_owned()
        } else {
            format!("write it in {}", one_of(m.units.iter().copied()))
        })
    }

    /// A resource that another contains, but that is not declared.
    UnknownResource("M0419", Error) { resource: String, near: Option<String> }
    message(m) { format!("there is no resource `{}`", m.resource) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("add `{} = []` under `[resources]`", m.resource),
        })
    }

    /// Resources that contain each other.
    ResourceCycle("M0420", Error) { chain: Vec<String> }
    message(m) {
        let chain: Vec<String> = m.chain.iter().map(|name| format!("`{name}`")).collect();
        format!("a resource contains itself: {}", chain.join(" contains "))
    }
    help(_m) { Some("let the larger part contain the smaller, and not the other way round".to_owned()) }

    /// A hand or a camera that is no resource.
    NotAResource("M0421", Error) { what: &'static str, name: String }
    message(m) { format!("the {} `{}` is not listed as a resource", m.what, m.name) }
    help(m) { Some(format!("add `{} = []` under `[resources]`", m.name)) }

    /// An interval whose least end is above its greatest.
    EmptyRange("M0422", Error) { key: String, least: f64, greatest: f64, other: Span }
    message(m) {
        format!("the lower bound of `{}` is {}, above the upper bound, {}", m.key, m.least, m.greatest)
    }
    related(m) { vec![Related::new("the upper bound is here", m.other)] }

    /// A name that cannot be written in a policy.
    BadName("M0423", Error) { name: String }
    message(m) { format!("`{}` is not a valid name", m.name.escape_debug()) }
    help(_m) { Some("a name is a letter or `_`, then letters, digits or `_`".to_owned()) }

    /// A number that the card gives elsewhere.
    TakenNumber("M0424", Error) { name: String, place: &'static str }
    message(m) { format!("`robot.{}` is already given by `{}`", m.name, m.place) }
    help(_m) { Some("give this number another name".to_owned()) }

    /// Something that is listed twice.
    ListedTwice("M0425", Warning) { name: String, first: Span }
    message(m) { format!("`{}` is listed twice", m.name) }
    help(_m) { Some("remove one".to_owned()) }
    related(m) { vec![Related::new("first listed here", m.first)] }

    /// A name that is used for two things of one name space.
    TakenName("M0426", Error) { name: String }
    message(m) { format!("`{}` is both a hand and a camera", m.name) }
    help(_m) { Some("name one of them differently: both are resources".to_owned()) }

    /// A link or a joint that the robot's URDF does not have.
    NotInUrdf("M0427", Error) { what: &'static str, name: String, near: Option<String> }
    message(m) { format!("the URDF has no {} `{}`", m.what, m.name.escape_debug()) }
    help(m) { m.near.as_ref().map(|near| format!("did you mean `{near}`?")) }

    /// A position that a joint cannot take.
    BeyondLimit("M0428", Error) { joint: String, value: f64, least: f64, greatest: f64 }
    message(m) {
        format!("joint `{}` is at {}, outside its limits of {} to {}", m.joint, m.value, m.least, m.greatest)
    }

    /// Fingers that close in the direction in which they point.
    SameAxis("M0429", Error) { hand: String }
    message(m) { format!("the fingers of `{}` point and close along the same axis", m.hand) }
    help(_m) {
        Some("fingers close across the direction in which they point: give `points` and `closes`".to_owned())
    }

    /// A hand or a camera of which the card does not say where it is.
    NoPlace("M0430", Warning) { what: &'static str, name: String, key: &'static str }
    message(m) {
        format!(
            "the card gives no link for the {} `{}`, so motions that need it cannot be computed",
            m.what, m.name
        )
    }
    help(m) { Some(format!("add `{} = \"…\"`", m.key)) }

    /// A file that the card names, and that is not there.
    NoFile("M0450", Error) { key: &'static str, file: String }
    message(m) { format!("`{}` is `{}`, but there is no such file", m.key, m.file.escape_debug()) }
    help(_m) { Some("paths are relative to the folder of the card".to_owned()) }

    /// A tip that no arm moves.
    NoArm("M0479", Warning) { hand: String, tip: String, base: String, is_carried: bool }
    message(m) {
        let (tip, base) = (m.tip.escape_debug(), m.base.escape_debug());
        if m.is_carried {
            format!(
                "no joint moves `{tip}`, the tip of the hand `{}`, relative to the base link `{base}`",
                m.hand
            )
        } else {
            format!("the base link `{base}` does not carry `{tip}`, the tip of the hand `{}`", m.hand)
        }
    }
    help(_m) {
        Some("set `tip` to the link of the hand at the end of the arm, and `base` to the foot of the arm or \
            a link before it".to_owned())
    }

    /// A folder with packages that is not there.
    NoFolder("M0480", Warning) { folder: String }
    message(m) { format!("`packages` names `{}`, but there is no such folder", m.folder.escape_debug()) }
    help(_m) {
        Some("paths are relative to the folder of the card; give the folder that contains the package's \
            folder".to_owned())
    }
}

fn known_or_near(near: Option<&str>, known: &[String]) -> String {
    match near {
        Some(near) => format!("did you mean `{near}`?"),
        None if known.is_empty() => "remove it".to_owned(),
        None => format!("possible here: {}", one_of(known.iter().map(String::as_str))),
    }
}
