//! Diagnostics of a URDF (M0451 to M0470, M0473 to M0476).

use motet_syntax::suggest::one_of;
use motet_syntax::{Related, Span};

use super::model::UrdfShape;

/// Format of an XML document.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum XmlDialect {
    /// A robot's links and joints.
    Urdf,
    /// Semantic description beside a URDF.
    Srdf,
    /// World or model of a simulator.
    Sdf,
}

/// Kind of a missing part.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum XmlPart {
    Attribute,
    Element,
}

motet_syntax::mistakes! {
    pub const CODES;

    /// The text is not XML.
    NotXml("M0451", Error) { problem: String, dialect: XmlDialect }
    message(m) { format!("this is not XML: {}", m.problem) }
    help(m) {
        let what = match m.dialect {
            XmlDialect::Urdf => "a URDF",
            XmlDialect::Srdf => "an SRDF",
            XmlDialect::Sdf => "an SDF",
        };
        let root = if m.dialect == XmlDialect::Sdf { "sdf" } else { "robot" };
        Some(format!("{what} is an XML document whose root element is `<{root}>`"))
    }

    /// More elements, or more levels of them, than a description may have.
    TooMuch("M0452", Error) { what: &'static str, limit: usize }
    message(m) { format!("the description has more than {} {}", m.limit, m.what) }
    help(_m) {
        Some("a robot needs five levels and some thousand elements: is this the right file?".to_owned())
    }

    /// XML, but of something else.
    NotUrdf("M0453", Error) { found: String }
    message(m) { format!("the root element is `<{}>`, a URDF starts with `<robot>`", m.found) }

    /// A macro that was not expanded.
    LeftoverXacro("M0454", Error) { text: String }
    message(m) { format!("`{}` belongs to xacro: this file has not been expanded", m.text) }
    help(_m) { Some("run `xacro robot.urdf.xacro > robot.urdf` and pass the result".to_owned()) }

    /// An element without something that it needs.
    MissingPart("M0455", Error) { element: String, name: String, part: &'static str, kind: XmlPart }
    message(m) {
        let element = if m.name.is_empty() {
            format!("`<{}>`", m.element)
        } else {
            format!("{} `{}`", m.element, m.name.escape_debug())
        };
        match m.kind {
            XmlPart::Attribute => format!("{element} has no `{}`", m.part),
            XmlPart::Element => format!("{element} has no `<{}>`", m.part),
        }
    }
    help(m) {
        Some(match m.kind {
            XmlPart::Attribute => format!("add `{}=\"…\"`", m.part),
            XmlPart::Element => format!("add `<{} …/>`", m.part),
        })
    }

    /// A value that is not the number, or not the three numbers, that it has to be.
    BadNumber("M0456", Error) { key: &'static str, text: String, wanted: &'static str }
    message(m) { format!("`{}` is `{}`, but must be {}", m.key, m.text.escape_debug(), m.wanted) }
    help(_m) { Some("write decimal numbers with a point, with spaces between them".to_owned()) }

    /// A number that no robot can have.
    ImpossibleNumber("M0457", Error) { key: &'static str, actual: f64, wanted: &'static str }
    message(m) { format!("`{}` is {}, but must be {}", m.key, m.actual, m.wanted) }

    /// Two links, or two joints, of one name.
    TakenName("M0458", Error) { what: &'static str, name: String, first: Span }
    message(m) { format!("there are two {}s `{}`", m.what, m.name.escape_debug()) }
    help(m) { Some(format!("give each {} a name of its own", m.what)) }
    related(m) { vec![Related::new("the first is here", m.first)] }

    /// A joint between links that are not there.
    UnknownLink("M0459", Error) { link: String, near: Option<String> }
    message(m) { format!("there is no link `{}`", m.link.escape_debug()) }
    help(m) {
        Some(near_or(m.near.as_deref(), || format!("add `<link name=\"{}\"/>`", m.link.escape_debug())))
    }

    /// A link that two joints move.
    TwoParents("M0460", Error) { link: String, joint: String, other: String, first: Span }
    message(m) {
        format!(
            "link `{}` is the child of joint `{}` and of joint `{}`",
            m.link.escape_debug(),
            m.other.escape_debug(),
            m.joint.escape_debug()
        )
    }
    help(_m) {
        Some("a URDF is a tree: remove one of the joints, or give it a child link of its own".to_owned())
    }
    related(m) { vec![Related::new(format!("joint `{}` is here", m.other.escape_debug()), m.first)] }

    /// Links that form a cycle.
    LinkCycle("M0461", Error) { chain: Vec<String> }
    message(m) {
        let chain: Vec<String> = m.chain.iter().map(|name| format!("`{}`", name.escape_debug())).collect();
        format!("links form a cycle: {}", chain.join(", "))
    }
    help(_m) { Some("a URDF is a tree: remove one of the joints".to_owned()) }

    /// Links that nothing joins.
    SeveralRoots("M0462", Error) { link: String, first: String, place: Span }
    message(m) {
        format!("no joint connects link `{}` to link `{}`", m.link.escape_debug(), m.first.escape_debug())
    }
    help(m) { Some(format!("add a joint whose child is `{}`, or remove the link", m.link.escape_debug())) }
    related(m) { vec![Related::new(format!("`{}` is here", m.first.escape_debug()), m.place)] }

    /// A kind of joint that URDF does not have.
    UnknownJointType("M0463", Error) { word: String, near: Option<String>, known: Vec<&'static str> }
    message(m) { format!("there is no joint type `{}`", m.word.escape_debug()) }
    help(m) {
        Some(near_or(m.near.as_deref(), || format!("possible here: {}", one_of(m.known.iter().copied()))))
    }

    /// An axis without a direction.
    ZeroAxis("M0464", Error) { joint: String }
    message(m) {
        format!("the axis of joint `{}` has length 0, so it has no direction", m.joint.escape_debug())
    }
    help(_m) { Some("write a direction such as `0 0 1`".to_owned()) }

    /// Limits that leave no position.
    EmptyLimits("M0465", Error) { joint: String, lower: f64, upper: f64, is_followed: bool }
    message(m) {
        if m.is_followed {
            format!(
                "the limits of joint `{}` and of the joints that mimic it exclude each other: it must be at \
                    least {} and at most {}",
                m.joint.escape_debug(),
                m.lower,
                m.upper
            )
        } else {
            format!(
                "the lower limit of joint `{}` is {}, above the upper, {}",
                m.joint.escape_debug(),
                m.lower,
                m.upper
            )
        }
    }
    help(m) {
        let help = if m.is_followed {
            "widen the limits of the joints that mimic it, or correct their `<mimic>`"
        } else {
            "swap them"
        };
        Some(help.to_owned())
    }

    /// A joint that follows one that is not there, or that has no single position.
    UnknownMimic("M0466", Error) { joint: String, leader: String, near: Option<String>, is_joint: bool }
    message(m) {
        if m.is_joint {
            format!(
                "joint `{}` mimics `{}`, which has no single position",
                m.joint.escape_debug(),
                m.leader.escape_debug()
            )
        } else {
            format!(
                "joint `{}` mimics `{}`, which is not a joint",
                m.joint.escape_debug(),
                m.leader.escape_debug()
            )
        }
    }
    help(m) {
        Some(near_or(m.near.as_deref(), || "name a revolute, continuous or prismatic joint".to_owned()))
    }

    /// Joints that mimic each other in a cycle.
    MimicCycle("M0467", Error) { chain: Vec<String> }
    message(m) {
        match m.chain.as_slice() {
            [alone] => format!("joint `{}` mimics itself", alone.escape_debug()),
            chain => {
                let chain: Vec<String> =
                    chain.iter().map(|name| format!("`{}`", name.escape_debug())).collect();
                format!("joints mimic each other in a cycle: {}", chain.join(", "))
            }
        }
    }
    help(_m) { Some("remove the `<mimic>` of one of them".to_owned()) }

    /// A joint that is not moved.
    HeldJoint("M0468", Warning) { joint: String }
    message(m) { format!("joint `{}` is floating; it stays at its origin", m.joint.escape_debug()) }
    help(_m) { Some("the robot's card says how its base drives".to_owned()) }

    /// A shape that URDF does not have, or none, or several at once.
    BadShape("M0469", Error) { found: String, near: Option<String> }
    message(m) {
        if m.found.is_empty() {
            "the geometry has no shape".to_owned()
        } else {
            format!("there is no shape `{}`", m.found.escape_debug())
        }
    }
    help(m) { Some(near_or(m.near.as_deref(), || format!("possible here: {}", one_of(UrdfShape::ELEMENTS)))) }

    /// A description without a body.
    NoLink("M0470", Error) {}
    message(_m) { "the robot has no link".to_owned() }
    help(_m) { Some("add `<link name=\"base_link\"/>`".to_owned()) }

    /// Two of what there may be one of.
    Repeated("M0473", Error) { element: String, name: String, part: String, first: Span }
    message(m) {
        let name = if m.name.is_empty() { String::new() } else { format!(" `{}`", m.name.escape_debug()) };
        format!("{}{name} has two {}", m.element, m.part)
    }
    help(m) {
        Some(if m.element == "geometry" {
            "remove one, or give each a `<collision>` of its own".to_owned()
        } else {
            "remove one".to_owned()
        })
    }
    related(m) { vec![Related::new("the first is here", m.first)] }

    /// An element that nothing reads.
    UnknownElement("M0474", Warning) { name: String, near: Option<String> }
    message(m) { format!("unknown element `<{}>` is ignored", m.name.escape_debug()) }
    help(m) { m.near.as_ref().map(|near| format!("did you mean `<{near}>`?")) }

    /// An attribute that nothing reads.
    UnknownAttribute("M0475", Warning) {
        element: &'static str, name: String, near: Option<String>, known: &'static [&'static str]
    }
    message(m) { format!("unknown attribute `{}` of `<{}>` is ignored", m.name.escape_debug(), m.element) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{}`?", near.escape_debug()),
            None if m.known.is_empty() => "remove it".to_owned(),
            None => format!("possible here: {}", one_of(m.known.iter().copied())),
        })
    }

    /// A joint that follows another, and cannot.
    IdleMimic("M0476", Warning) { joint: String, kind: &'static str }
    message(m) {
        format!(
            "joint `{}` is {} and cannot mimic another: its `<mimic>` is ignored",
            m.joint.escape_debug(),
            m.kind
        )
    }
    help(_m) { Some("remove the `<mimic>`, or make the joint revolute, continuous or prismatic".to_owned()) }
}

fn near_or(near: Option<&str>, otherwise: impl FnOnce() -> String) -> String {
    near.map_or_else(otherwise, |near| format!("did you mean `{}`?", near.escape_debug()))
}
