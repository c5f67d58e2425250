//! Language items: the names of the standard library that Rust code may know.
//!
//! Every other name is data. The compiler looks these up once, and a test of it checks that `motet/*.motet`
//! declares each of them.

/// Words of the language that are never a bare name in the text syntax: the rule `reserved` of its grammar.
pub const RESERVED: [&str; 26] = [
    "let", "sequence", "if", "else", "wait", "until", "monitor", "when", "then", "during", "try", "catch",
    "finally", "repeat", "each", "parallel", "done", "fail", "cannot", "replan", "and", "or", "not", "true",
    "false", "any",
];

/// Checks if a text can stand in the text syntax as a name without back-quotes: a letter or `_`, then
/// letters, digits and `_` of ASCII, and no word of [`RESERVED`].
///
/// ```
/// use motet_stdlib::lang::is_bare_name;
///
/// assert!(is_bare_name("mug_1"));
/// assert!(!is_bare_name("7up") && !is_bare_name("wait"));
/// ```
#[must_use]
pub fn is_bare_name(text: &str) -> bool {
    let mut letters = text.chars();
    letters.next().is_some_and(|first| first == '_' || first.is_ascii_alphabetic())
        && letters.all(|letter| letter == '_' || letter.is_ascii_alphanumeric())
        && !RESERVED.contains(&text)
}

/// Documentation of the failure `timeout`, which has no declaration.
pub const TIMEOUT_DOC: &str = "It took too long.";

/// Fluents that say where a thing is.
pub const PLACING: [&str; 3] = [fluents::ON, fluents::IN, fluents::AT];

/// Primitives that wait for an answer of a person.
pub const ASKING: [&str; 2] = [primitives::ASK, primitives::CHOOSE];

/// Parameter of a primitive that offers a list of things, one of which is the result.
pub const AMONG: &str = "among";

/// Beginning of the names of the motions that grasp a thing.
pub const REACH: &str = "reach";

/// Field of a held thing that every driver may report: its pose in the frame of the hand's tip.
pub const GRIP: &str = "grip";

macro_rules! names {
    ($($(#[$doc:meta])* $module:ident { $($constant:ident = $name:literal)* })*) => {$(
        $(#[$doc])*
        pub mod $module {
            $(
                #[doc = concat!("The name `", $name, "`.")]
                pub const $constant: &str = $name;
            )*
            /// All names of this sort.
            pub const ALL: &[&str] = &[$($name),*];
        }
    )*};
}

names! {
    /// Kinds of entities; `Entity` is the root.
    kinds {
        ENTITY = "Entity"
        PLACE = "Place"
        SURFACE = "Surface"
        CONTAINER = "Container"
        OBJECT = "Object"
        PERSON = "Person"
        ZONE = "Zone"
    }
    /// Enumerations of the standard library.
    enums {
        APPROACH = "Approach"
    }
    /// Enumerations whose cases come from the robot's card.
    card_enums {
        HAND = "Hand"
        CAMERA = "Camera"
        RESOURCE = "Resource"
    }
    /// Cases of [`enums::APPROACH`] that restrict the side of a grasp.
    approaches {
        TOP = "top"
        SIDE = "side"
        FRONT = "front"
    }
    /// Entities that every environment has.
    entities {
        ROBOT = "robot"
        USER = "user"
        START = "start"
    }
    /// Fields of objects that a scene gives.
    fields {
        MASS = "mass"
        WIDTH = "width"
    }
    /// Fluents with a meaning for scenes, geometry, lints, guards or drivers.
    fluents {
        AT = "at"
        CLEAR = "clear"
        FREE = "free"
        HOLDING = "holding"
        IN = "in"
        LIFTED = "lifted"
        LOCATED = "located"
        LOCKED = "locked"
        NEAR = "near"
        ON = "on"
        OPEN = "open"
        REACHABLE = "reachable"
        STANDING = "standing"
        VISIBLE = "visible"
        VISITED = "visited"
    }
    /// Primitives with a meaning for dialogue, prompts, drivers and the list form of plans.
    primitives {
        ASK = "ask"
        CHOOSE = "choose"
        CLOSE = "close"
        DETECT = "detect"
        DETECT_ALL = "detect_all"
        GO = "go"
        GO_TO_POSE = "go_to_pose"
        GRASP = "grasp"
        GROUND = "ground"
        HANDOVER = "handover"
        HOME = "home"
        INSPECT = "inspect"
        LIFT = "lift"
        LOCATE = "locate"
        OPEN = "open"
        PICK = "pick"
        PLACE = "place"
        PLACE_AT = "place_at"
        PUSH = "push"
        SAY = "say"
        SEARCH = "search"
        START_POSE = "start_pose"
        TURN = "turn"
        WAKE_UP = "wake_up"
    }
    /// Measures with a meaning for lints or drivers.
    measures {
        BATTERY = "battery"
        DISTANCE = "distance"
        FORCE = "force"
    }
    /// Failures that the compiler derives from guards, geometry and control flow, and those that a dialogue
    /// asks about.
    failures {
        AMBIGUOUS = "ambiguous"
        BLOCKED = "blocked"
        EXHAUSTED = "exhausted"
        FAILED = "failed"
        NOT_FOUND = "not_found"
        REFUSED = "refused"
        SLIPPED = "slipped"
        TOO_HEAVY = "too_heavy"
        UNREACHABLE = "unreachable"
        UNSAFE = "unsafe"
    }
    /// Failures that exist without a declaration.
    builtin_failures {
        TIMEOUT = "timeout"
    }
}
