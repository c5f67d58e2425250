//! Layouts of messages, services and actions in the notation of ROS 2, read at run time.
//!
//! CDR bytes do not describe themselves, and some layouts differ between distributions. So they are data: the
//! common ones, and for each distribution those that differ there.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;

/// Layouts that most distributions share.
const COMMON: &str = include_str!("../layouts/common.layouts");
/// Greatest size of a file of layouts in bytes.
const MAX_BYTES: u64 = 4 * 1024 * 1024;
/// Greatest number of types, so that a folder of layouts cannot fill the memory.
const MAX_TYPES: usize = 10_000;

/// Distribution of ROS 2.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Distribution {
    /// The one of May 2022.
    Humble,
    /// The one of May 2023.
    Iron,
    /// The one of May 2024.
    #[default]
    Jazzy,
    /// The one of May 2025.
    Kilted,
    /// The one of May 2026.
    Lyrical,
}

impl Distribution {
    /// All distributions with layouts, the oldest first.
    pub(crate) const ALL: [Self; 5] = [Self::Humble, Self::Iron, Self::Jazzy, Self::Kilted, Self::Lyrical];

    const fn own_layouts(self) -> &'static str {
        match self {
            Self::Humble => include_str!("../layouts/humble.layouts"),
            Self::Iron => include_str!("../layouts/iron.layouts"),
            Self::Jazzy => include_str!("../layouts/jazzy.layouts"),
            Self::Kilted => include_str!("../layouts/kilted.layouts"),
            Self::Lyrical => include_str!("../layouts/lyrical.layouts"),
        }
    }
}

impl fmt::Display for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Humble => "humble",
            Self::Iron => "iron",
            Self::Jazzy => "jazzy",
            Self::Kilted => "kilted",
            Self::Lyrical => "lyrical",
        })
    }
}

impl FromStr for Distribution {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::ALL.into_iter().find(|one| one.to_string() == text);
        found.ok_or_else(|| format!("`{text}` is none of humble, iron, jazzy, kilted and lyrical"))
    }
}

/// Type of one value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Primitive {
    /// One byte, 0 or 1.
    Bool,
    /// Signed integer of so many bytes.
    Int(usize),
    /// Unsigned integer of so many bytes.
    Uint(usize),
    /// Number of 4 or 8 bytes.
    Float(usize),
    /// Text in UTF-8.
    Text,
}

/// Type of an element of a field.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum Element {
    /// A single value.
    Primitive(Primitive),
    /// A message, by its full name, such as `geometry_msgs/Pose`.
    Message(Arc<str>),
}

/// Number of elements of a field.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Count {
    /// A single one.
    One,
    /// As many as stated.
    Exactly(usize),
    /// Any number up to a bound.
    AtMost(usize),
}

/// Field of a message.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Field {
    /// Name as the layout writes it.
    pub(crate) name: Arc<str>,
    /// Type of its elements.
    pub(crate) element: Element,
    /// Number of its elements.
    pub(crate) count: Count,
}

/// Layout of a message: its fields in order.
pub(crate) type Layout = Arc<[Field]>;

/// Layouts of one distribution, by full name. Parts of services and actions have names such as
/// `nav2_msgs/NavigateToPose_Goal`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Layouts {
    messages: BTreeMap<Arc<str>, Layout>,
    kinds: BTreeMap<Arc<str>, Kind>,
}

/// Kind of an interface.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Kind {
    /// Data of a topic.
    Message,
    /// Request and response.
    Service,
    /// Goal, result and feedback.
    Action,
}

impl Layouts {
    /// Reads the layouts of a distribution, then those of every file of a folder, which replace or add some.
    ///
    /// # Errors
    ///
    /// The place that is wrong, or a type that no layout has.
    pub(crate) fn of(distribution: Distribution, folder: Option<&Path>) -> Result<Self, String> {
        let mut layouts = Self::default();
        layouts.read(COMMON, "common.layouts")?;
        layouts.read(distribution.own_layouts(), &format!("{distribution}.layouts"))?;
        folder.map_or(Ok(()), |folder| layouts.add(folder))?;
        layouts.check()?;
        Ok(layouts)
    }

    /// Adds those of every file of a folder, which replace or add some.
    ///
    /// # Errors
    ///
    /// The place that is wrong, or a type that no layout has.
    pub(crate) fn add(&mut self, folder: &Path) -> Result<(), String> {
        let entries = std::fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let mut files: Vec<_> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        files.retain(|path| path.extension().is_some_and(|end| end == "layouts"));
        files.sort();
        for file in files {
            let name = file.display().to_string();
            let wrong = |error: std::io::Error| format!("{name}: {error}");
            if std::fs::metadata(&file).map_err(wrong)?.len() > MAX_BYTES {
                return Err(format!("{name}: has more than {MAX_BYTES} bytes"));
            }
            self.read(&std::fs::read_to_string(&file).map_err(wrong)?, &name)?;
        }
        self.check()
    }

    /// Layout of a message, by its full name.
    #[must_use]
    pub(crate) fn message(&self, name: &str) -> Option<&Layout> {
        self.messages.get(name)
    }

    /// Kind of an interface, by its full name.
    #[must_use]
    pub(crate) fn kind(&self, name: &str) -> Option<Kind> {
        self.kinds.get(name).copied()
    }

    /// Names of all interfaces with their kinds, in order.
    pub(crate) fn interfaces(&self) -> impl Iterator<Item = (&str, Kind)> {
        self.kinds.iter().map(|(name, kind)| (&**name, *kind))
    }

    pub(crate) fn read(&mut self, text: &str, file: &str) -> Result<(), String> {
        let mut open: Option<(Kind, String, Vec<Vec<Field>>)> = None;
        for (number, line) in text.lines().enumerate() {
            let wrong = |what: String| format!("{file}, line {}: {what}", number + 1);
            let line = line.split('#').next().unwrap_or_default().trim();
            let kind = match line.split_once(' ').map(|(word, name)| (word, name.trim())) {
                Some(("MSG", name)) => Some((Kind::Message, name)),
                Some(("SRV", name)) => Some((Kind::Service, name)),
                Some(("ACTION", name)) => Some((Kind::Action, name)),
                _ => None,
            };
            if let Some((kind, name)) = kind {
                if name.split('/').count() != 2 || !name.split('/').all(is_name) {
                    return Err(wrong(format!("`{name}` is no `package/Name`")));
                }
                self.close(open.take()).map_err(wrong)?;
                open = Some((kind, name.to_owned(), vec![Vec::new()]));
            } else if let Some((_, name, parts)) = &mut open {
                let package = name.split('/').next().unwrap_or_default();
                match line {
                    "" => {}
                    "---" => parts.push(Vec::new()),
                    // A constant has no bytes.
                    _ if line.contains('=') && !line.contains("<=") => {}
                    _ => {
                        let field = field(line, package).map_err(wrong)?;
                        parts.last_mut().into_iter().for_each(|part| part.push(field.clone()));
                    }
                }
            } else if !line.is_empty() {
                return Err(wrong("a field stands before the first MSG, SRV or ACTION".to_owned()));
            }
        }
        self.close(open).map_err(|what| format!("{file}: {what}"))
    }

    /// Enters the parts of an interface.
    fn close(&mut self, open: Option<(Kind, String, Vec<Vec<Field>>)>) -> Result<(), String> {
        let Some((kind, name, parts)) = open else { return Ok(()) };
        let ends: &[&str] = match kind {
            Kind::Message => &[""],
            Kind::Service => &["_Request", "_Response"],
            Kind::Action => &["_Goal", "_Result", "_Feedback"],
        };
        if parts.len() != ends.len() {
            return Err(format!("`{name}` has {} parts instead of {}", parts.len(), ends.len()));
        }
        for (end, fields) in ends.iter().zip(parts) {
            self.messages.insert(format!("{name}{end}").into(), fields.into());
        }
        if kind == Kind::Action {
            let uuid = || part("goal_id", "unique_identifier_msgs/UUID");
            let own = |end: &str| format!("{name}{end}");
            let stamp = part("stamp", "builtin_interfaces/Time");
            for (end, fields) in [
                ("_SendGoal_Request", vec![uuid(), part("goal", &own("_Goal"))]),
                ("_SendGoal_Response", vec![single("accepted", Primitive::Bool), stamp]),
                ("_GetResult_Request", vec![uuid()]),
                (
                    "_GetResult_Response",
                    vec![single("status", Primitive::Int(1)), part("result", &own("_Result"))],
                ),
                ("_FeedbackMessage", vec![uuid(), part("feedback", &own("_Feedback"))]),
            ] {
                self.messages.insert(own(end).into(), fields.into());
            }
        }
        self.kinds.insert(name.into(), kind);
        if self.messages.len() > MAX_TYPES { Err(format!("more than {MAX_TYPES} types")) } else { Ok(()) }
    }

    /// Refuses types that are nowhere, and messages that contain themselves.
    pub(crate) fn check(&self) -> Result<(), String> {
        for (name, fields) in &self.messages {
            self.check_below(name, fields, &mut Vec::new())?;
        }
        Ok(())
    }

    fn check_below(&self, name: &Arc<str>, fields: &Layout, above: &mut Vec<Arc<str>>) -> Result<(), String> {
        if above.contains(name) {
            return Err(format!("`{name}` contains itself"));
        }
        above.push(name.clone());
        for field in fields.iter() {
            if let Element::Message(inner) = &field.element {
                let Some(layout) = self.messages.get(inner) else {
                    return Err(format!("no layout of `{inner}`, which `{name}` has as `{}`", field.name));
                };
                self.check_below(inner, layout, above)?;
            }
        }
        above.pop();
        Ok(())
    }
}

fn single(name: &str, primitive: Primitive) -> Field {
    Field { name: name.into(), element: Element::Primitive(primitive), count: Count::One }
}

fn part(name: &str, message: &str) -> Field {
    Field { name: name.into(), element: Element::Message(message.into()), count: Count::One }
}

fn is_name(text: &str) -> bool {
    let is_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    text.starts_with(|first: char| first.is_ascii_alphabetic()) && text.bytes().all(is_word)
}

/// Reads a field such as `float64[<=3] x`.
fn field(line: &str, package: &str) -> Result<Field, String> {
    let mut words = line.split_whitespace();
    let (Some(ty), Some(name)) = (words.next(), words.next()) else {
        return Err(format!("`{line}` is no field: it has a type and a name"));
    };
    if !is_name(name) {
        return Err(format!("`{name}` is no name of a field"));
    }
    let (ty, count) = match ty.split_once('[') {
        None => (ty, Count::One),
        Some((ty, "]")) => (ty, Count::AtMost(usize::MAX)),
        Some((ty, rest)) => {
            let number = rest.trim_end_matches(']');
            let bound = number.strip_prefix("<=");
            let count =
                bound.unwrap_or(number).parse().map_err(|_| format!("`{rest}` is no number of elements"))?;
            (ty, if bound.is_some() { Count::AtMost(count) } else { Count::Exactly(count) })
        }
    };
    // The bound of a text changes nothing in the bytes.
    let ty = ty.split("<=").next().unwrap_or(ty);
    let primitive = match ty {
        "bool" => Some(Primitive::Bool),
        "int8" => Some(Primitive::Int(1)),
        "int16" => Some(Primitive::Int(2)),
        "int32" => Some(Primitive::Int(4)),
        "int64" => Some(Primitive::Int(8)),
        "byte" | "char" | "uint8" => Some(Primitive::Uint(1)),
        "uint16" => Some(Primitive::Uint(2)),
        "uint32" => Some(Primitive::Uint(4)),
        "uint64" => Some(Primitive::Uint(8)),
        "float32" => Some(Primitive::Float(4)),
        "float64" => Some(Primitive::Float(8)),
        "string" => Some(Primitive::Text),
        "wstring" => return Err("fields of type wstring are not read".to_owned()),
        _ => None,
    };
    let element = match primitive {
        Some(primitive) => Element::Primitive(primitive),
        None if ty.contains('/') => Element::Message(ty.into()),
        None => Element::Message(format!("{package}/{ty}").into()),
    };
    Ok(Field { name: name.into(), element, count })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_distribution_has_whole_layouts() {
        for distribution in Distribution::ALL {
            let layouts = Layouts::of(distribution, None).unwrap();
            let result = layouts.message("nav2_msgs/NavigateToPose_Result").unwrap();
            let names: Vec<&str> = result.iter().map(|field| &*field.name).collect();
            let expected: &[&str] = match distribution {
                Distribution::Humble => &["result"],
                Distribution::Iron => &["error_code"],
                _ => &["error_code", "error_msg"],
            };
            assert_eq!(names, expected, "{distribution}");
        }
    }

    #[test]
    fn wrong_layouts_name_their_place() {
        let read = |text: &str| {
            let mut layouts = Layouts::default();
            layouts.read(text, "own").and_then(|()| layouts.check()).unwrap_err()
        };
        assert_eq!(read("float64 x"), "own, line 1: a field stands before the first MSG, SRV or ACTION");
        assert_eq!(read("MSG a/B\nfloat64"), "own, line 2: `float64` is no field: it has a type and a name");
        assert_eq!(read("MSG a/B\nC c"), "no layout of `a/C`, which `a/B` has as `c`");
        assert_eq!(read("MSG a/B\nC c\nMSG a/C\nB[] b"), "`a/B` contains itself");
        assert_eq!(read("SRV a/B\nbool c"), "own: `a/B` has 1 parts instead of 2");
    }
}
