//! Draft of a card for a robot of which only a URDF exists. Facts of the URDF are taken over, the rest is
//! guessed, and every guess is marked in a comment.

use std::fmt::Write;

use indexmap::IndexMap;
use motet_stdlib::lang::primitives;
use smol_str::SmolStr;

use super::draft_parts::{DraftHand, RobotParts};
use crate::srdf::Srdf;
use crate::urdf::{Urdf, UrdfShape};

/// Inputs of a draft beside the URDF.
#[derive(Clone, Default, Debug)]
pub struct DraftInputs<'a> {
    /// SRDF, and its path relative to the folder of the card.
    pub srdf: Option<(&'a Srdf, &'a str)>,
    /// Folders that hold ROS packages, as seen from the card's.
    pub packages: &'a [String],
    /// Link of the tip of the hand, where it is not to be searched.
    pub tip: Option<&'a str>,
    /// Stance of the robot, as far as it was computed.
    pub stance: Option<DraftStance>,
}

/// Stance of a robot: height of its base and posture of its arm.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct DraftStance {
    /// Height of the link of the base above the floor, in m.
    pub height_m: f64,
    /// Joint positions of the arm by name, in rad or m.
    pub joints: IndexMap<SmolStr, f64>,
    /// Two links or obstacles that touch in it, if every tried posture has a contact.
    pub touch: Option<[SmolStr; 2]>,
}

/// Writes the text of a card for the robot of a URDF. `file` is the path of the URDF relative to the folder
/// of the card.
///
/// [`super::read`] accepts the card, and it fits the URDF. O(links × joints).
///
/// ```
/// use motet_robots::{builtin, card};
/// use motet_syntax::{FileId, Source};
///
/// let urdf = builtin::robot("panda").unwrap().urdf;
/// let text = card::draft(&urdf, "robot.urdf", &card::DraftInputs::default());
/// let (robot, _) = card::read(&Source::new("robot.toml", text), FileId(0), None);
/// assert_eq!(robot.unwrap().name, "panda");
/// ```
#[must_use]
pub fn draft(urdf: &Urdf, file: &str, beside: &DraftInputs<'_>) -> String {
    let parts = RobotParts::find(urdf, beside.srdf.map(|(srdf, _)| srdf), beside.tip);
    let mut card = String::new();
    // Writing to a string does not fail.
    let _ = write_card(&mut card, urdf, file, beside, &parts);
    card
}

fn write_card(
    card: &mut String,
    urdf: &Urdf,
    file: &str,
    beside: &DraftInputs<'_>,
    parts: &RobotParts,
) -> std::fmt::Result {
    let name = identifier(&urdf.name);
    let (drive, why) = parts.drive;
    let speed = if drive == "fixed" { ("0", "0") } else { ("\"0.3 m/s\"", "0.5") };
    writeln!(
        card,
        "# Written from the URDF. A line with `guessed` is to be looked at: nothing in the URDF says so."
    )?;
    writeln!(card, "name = {}", quoted(&name))?;
    writeln!(card, "title = {}", quoted(if urdf.name.is_empty() { &name } else { &urdf.name }))?;
    writeln!(card, "observe_within = \"500 ms\"  # guessed")?;
    writeln!(card, "# Facts that the robot observes by itself: guessed.")?;
    writeln!(
        card,
        "observes = [\n    \"holding\", \"free\", \"visible\", \"located\", \"reachable\", \"at\", \"near\", \
            \"on\", \"in\","
    )?;
    writeln!(card, "    \"open\", \"locked\", \"clear\", \"lifted\", \"visited\", \"distance\",\n]")?;
    writeln!(card, "\n[base]\ndrive = \"{drive}\"  # guessed: {why}")?;
    writeln!(card, "speed = {}  # guessed\nturn = {}  # guessed", speed.0, speed.1)?;
    writeln!(
        card,
        "radius = {:.2}  # guessed: around the shapes of `{}`",
        radius(urdf, parts.base),
        link(urdf, parts.base).escape_debug()
    )?;
    writeln!(
        card,
        "\n# How far it may be from where it ought to be; motions keep this distance from obstacles."
    )?;
    writeln!(card, "[errors]")?;
    if drive != "fixed" {
        writeln!(card, "localisation = \"2 cm\"  # guessed")?;
    }
    writeln!(card, "tracking = \"{}\"  # guessed", if drive == "fixed" { "5 mm" } else { "1 cm" })?;
    if let Some(hand) = &parts.hand {
        write_hand(card, urdf, hand)?;
    }
    if let Some((camera, why)) = parts.camera {
        writeln!(card, "\n[cameras.camera]\nrange = \"3 m\"  # guessed\nview = \"60 deg\"  # guessed")?;
        writeln!(card, "frame = {}  # guessed: {why}", quoted(link(urdf, camera)))?;
    }
    write_model(card, urdf, file, beside, parts)?;
    write_postures(card, beside, parts)?;
    writeln!(card, "[resources]\nbase = []")?;
    let carried = parts.camera.filter(|_| parts.camera_is_on_arm);
    writeln!(card, "arm = [{}]", if carried.is_some() { "\"camera\"" } else { "" })?;
    let owned = [("hand", parts.hand.is_some()), ("camera", parts.camera.is_some())];
    for (resource, _) in owned.iter().filter(|(_, is_there)| *is_there) {
        writeln!(card, "{resource} = []")?;
    }
    writeln!(card, "voice = []\n\n# Primitives that its driver carries out: guessed.\n[primitives]")?;
    let driving: &[&str] = if drive == "fixed" { &[] } else { &[primitives::GO] };
    let handling: &[&str] = if parts.hand.is_some() {
        &[primitives::HOME, primitives::START_POSE, primitives::PICK, primitives::PLACE, primitives::HANDOVER]
    } else {
        &[]
    };
    let seeing: &[&str] = if parts.camera.is_some() {
        &[primitives::DETECT, primitives::DETECT_ALL, primitives::LOCATE]
    } else {
        &[]
    };
    for primitive in driving.iter().chain(handling).chain(seeing).chain(&[primitives::SAY, primitives::ASK]) {
        writeln!(card, "{primitive} = {{}}")?;
    }
    Ok(())
}

fn write_model(
    card: &mut String,
    urdf: &Urdf,
    file: &str,
    beside: &DraftInputs<'_>,
    parts: &RobotParts,
) -> std::fmt::Result {
    writeln!(card, "\n[model]\nurdf = {}", quoted(file))?;
    if let Some((_, srdf)) = beside.srdf {
        writeln!(card, "srdf = {}", quoted(srdf))?;
    }
    if !beside.packages.is_empty() {
        let folders: Vec<String> = beside.packages.iter().map(|folder| quoted(folder)).collect();
        writeln!(card, "packages = [{}]", folders.join(", "))?;
    }
    writeln!(card, "base = {}  # guessed: {}", quoted(link(urdf, parts.base)), parts.base_why)?;
    let height = beside.stance.as_ref().map_or(0.0, |stance| stance.height_m);
    let why = if height > 0.0 {
        "how high the base's link is where the lowest shape is on the floor"
    } else {
        "how high above the floor the base's link is"
    };
    writeln!(card, "height = \"{height} m\"  # guessed: {why}")
}

fn write_postures(card: &mut String, beside: &DraftInputs<'_>, parts: &RobotParts) -> std::fmt::Result {
    writeln!(card, "\n# Where every joint is in the posture in which the robot drives, and looks: guessed.")?;
    let stance = beside.stance.as_ref();
    if let Some([one, other]) = stance.and_then(|stance| stance.touch.as_ref()) {
        let (one, other) = (one.escape_debug(), other.escape_debug());
        writeln!(
            card,
            "# In it `{one}` touches `{other}`, and no posture was found in which nothing touches: no motion"
        )?;
        writeln!(card, "# starts from it. See `motet robots check`.")?;
    }
    for posture in ["home", "start"] {
        writeln!(card, "[postures.{posture}]")?;
        for (joint, position) in parts.hand.iter().flat_map(|hand| hand.arm.iter()) {
            let found = stance.and_then(|stance| stance.joints.get(joint.as_str())).copied();
            writeln!(card, "{} = {}", quoted(joint), found.unwrap_or(*position))?;
        }
        writeln!(card)?;
    }
    Ok(())
}

fn write_hand(card: &mut String, urdf: &Urdf, hand: &DraftHand) -> std::fmt::Result {
    writeln!(card, "\n[hands.hand]\npayload = \"0.5 kg\"  # guessed")?;
    match hand.opening {
        Some(opening) => writeln!(card, "opening = {opening:.3}  # guessed: the travel of the fingers")?,
        None => writeln!(card, "opening = \"8 cm\"  # guessed")?,
    }
    writeln!(card, "reach = {:.2}  # guessed: four fifths of the stretched arm", hand.reach * 0.8)?;
    let (least, greatest) = ((hand.shoulder - hand.reach * 0.8).max(0.0), hand.shoulder + hand.reach * 0.8);
    writeln!(
        card,
        "heights = {{ least = {least:.2}, greatest = {greatest:.2} }}  # guessed: as far above and below the \
            shoulder"
    )?;
    writeln!(card, "tip = {}  # {}", quoted(link(urdf, hand.tip)), hand.why)?;
    writeln!(card, "points = {:?}  # guessed: away from the arm", hand.points)?;
    writeln!(card, "closes = {:?}  # guessed", hand.closes)?;
    if !hand.open.is_empty() {
        let open: Vec<String> =
            hand.open.iter().map(|(joint, at)| format!("{} = {at:?}", quoted(joint))).collect();
        writeln!(card, "open = {{ {} }}  # guessed: the fingers at their farther limit", open.join(", "))?;
    }
    Ok(())
}

fn link(urdf: &Urdf, at: usize) -> &str {
    urdf.links.get(at).map_or("", |link| link.name.as_str())
}

/// Basic TOML string, also valid as a key; invisible characters are escaped by number.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' | '\\' => quoted.extend(['\\', letter]),
            '\'' => quoted.push(letter),
            // Rust has other escapes, but it knows which characters are invisible.
            _ if letter.escape_debug().len() > 1 => {
                // Writing to a string does not fail.
                let _ = write!(quoted, "\\U{:08X}", u32::from(letter));
            }
            _ => quoted.push(letter),
        }
    }
    quoted.push('"');
    quoted
}

/// Turns a name into an identifier.
fn identifier(name: &str) -> String {
    let mut word: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    if !word.starts_with(|c: char| c.is_ascii_alphabetic()) {
        word.insert_str(0, "robot_");
    }
    word.trim_end_matches('_').to_owned()
}

/// Radius of the disc around the shapes of a link; 0.3 m if the shapes give none.
fn radius(urdf: &Urdf, link: usize) -> f64 {
    let solids = urdf.links.get(link).map_or(&[][..], |link| link.collisions.as_slice());
    let reach = solids.iter().filter_map(|solid| {
        let size = match solid.shape {
            UrdfShape::Box([x, y, _]) => libm::hypot(x, y) / 2.0,
            UrdfShape::Cylinder { radius, .. } | UrdfShape::Sphere { radius } => radius,
            UrdfShape::Capsule { radius, length } => radius + length / 2.0,
            UrdfShape::Mesh { .. } => return None,
        };
        let [x, y, _] = solid.link_from_shape.xyz;
        Some(libm::hypot(x, y) + size)
    });
    let reach = reach.fold(0.0, f64::max);
    if reach > 0.01 { reach } else { 0.3 }
}
