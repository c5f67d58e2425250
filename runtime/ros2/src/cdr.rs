//! Messages as CDR bytes (version 1, little-endian), by layouts that are known at run time only.

use crate::layout::{Count, Element, Field, Layout, Layouts, Primitive};
use serde::Serialize;
use serde::ser::{SerializeMap as _, Serializer};
use serde_json::Value;
use std::sync::Arc;

/// Greatest number of values in a message. Bytes of pictures count as one.
const MAX_VALUES: usize = 1_000_000;

/// A message, or a part of one.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Message {
    Bool(bool),
    Int(i64),
    Uint(u64),
    Float(f64),
    Text(String),
    /// Bytes of an array of `uint8`.
    Bytes(Vec<u8>),
    List(Vec<Message>),
    Record(Layout, Vec<Message>),
}

impl Message {
    /// Field of a record, or of records inside, by names with dots such as `pose.position.x`.
    #[must_use]
    pub(crate) fn get(&self, path: &str) -> Option<&Self> {
        path.split('.').try_fold(self, |message, name| {
            let Self::Record(layout, values) = message else { return None };
            values.get(layout.iter().position(|field| &*field.name == name)?)
        })
    }

    /// Number at a path; 0 where there is none.
    #[must_use]
    pub(crate) fn number(&self, path: &str) -> f64 {
        match self.get(path) {
            Some(Self::Float(number)) => *number,
            #[allow(clippy::cast_precision_loss, reason = "counts and codes are small")]
            Some(Self::Int(number)) => *number as f64,
            #[allow(clippy::cast_precision_loss, reason = "counts and codes are small")]
            Some(Self::Uint(number)) => *number as f64,
            _ => 0.0,
        }
    }

    /// Text at a path; empty where there is none.
    #[must_use]
    pub(crate) fn text(&self, path: &str) -> &str {
        match self.get(path) {
            Some(Self::Text(text)) => text,
            _ => "",
        }
    }

    /// List at a path; empty where there is none.
    #[must_use]
    pub(crate) fn list(&self, path: &str) -> &[Self] {
        match self.get(path) {
            Some(Self::List(values)) => values,
            _ => &[],
        }
    }

    /// True where the path has a true value.
    #[must_use]
    pub(crate) fn is_true(&self, path: &str) -> bool {
        self.get(path) == Some(&Self::Bool(true))
    }

    /// Numbers of a list.
    #[must_use]
    pub(crate) fn numbers(&self, path: &str) -> Vec<f64> {
        let number = |value: &Self| if let Self::Float(number) = value { *number } else { 0.0 };
        self.list(path).iter().map(number).collect()
    }

    /// Seconds of a time or a duration at a path.
    #[must_use]
    pub(crate) fn secs(&self, path: &str) -> f64 {
        self.number(&format!("{path}.sec")) + self.number(&format!("{path}.nanosec")) * 1e-9
    }
}

impl Serialize for Message {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Bool(value) => value.serialize(serializer),
            Self::Int(value) => value.serialize(serializer),
            Self::Uint(value) => value.serialize(serializer),
            Self::Float(value) => value.serialize(serializer),
            Self::Text(value) => value.serialize(serializer),
            Self::Bytes(value) => value.serialize(serializer),
            Self::List(values) => values.serialize(serializer),
            Self::Record(layout, values) => {
                let mut map = serializer.serialize_map(Some(values.len()))?;
                for (field, value) in layout.iter().zip(values) {
                    map.serialize_entry(&*field.name, value)?;
                }
                map.end()
            }
        }
    }
}

/// Writes a message. Fields that the value lacks are zero, empty or false.
///
/// # Errors
///
/// The field that the layout lacks, or whose value is of another type.
pub(crate) fn encode(layouts: &Layouts, name: &str, value: &Value) -> Result<Vec<u8>, String> {
    let mut writer = Writer { layouts, bytes: Vec::new() };
    writer.message(name, value, name)?;
    Ok(writer.bytes)
}

/// Reads a message. Bytes after it are ignored.
///
/// # Errors
///
/// The field at which the bytes end, or are not of the layout.
pub(crate) fn decode(layouts: &Layouts, name: &str, bytes: &[u8]) -> Result<Message, String> {
    let mut reader = Reader { layouts, bytes, at: 0, values: 0 };
    reader.message(name)
}

struct Writer<'a> {
    layouts: &'a Layouts,
    bytes: Vec<u8>,
}

impl Writer<'_> {
    fn message(&mut self, name: &str, value: &Value, place: &str) -> Result<(), String> {
        let fields = self.layouts.message(name).ok_or_else(|| format!("no layout of `{name}`"))?.clone();
        let nothing = serde_json::Map::new();
        let given = match value {
            Value::Object(given) => given,
            Value::Null => &nothing,
            _ => return Err(format!("`{place}` is a message `{name}`, not {value}")),
        };
        if let Some(unknown) =
            given.keys().find(|key| fields.iter().all(|field| &*field.name != key.as_str()))
        {
            let names: Vec<&str> = fields.iter().map(|field| &*field.name).collect();
            return Err(format!("`{name}` has no field `{unknown}`; it has {}", names.join(", ")));
        }
        if fields.is_empty() {
            // A structure without fields has one byte.
            self.bytes.push(0);
        }
        for field in fields.iter() {
            let value = given.get(&*field.name).unwrap_or(&Value::Null);
            self.field(field, value, &format!("{place}.{}", field.name))?;
        }
        Ok(())
    }

    fn field(&mut self, field: &Field, value: &Value, place: &str) -> Result<(), String> {
        let nothing = Vec::new();
        let elements = match (field.count, value) {
            (Count::One, _) => return self.element(&field.element, value, place),
            (_, Value::Array(elements)) => elements,
            (_, Value::Null) => &nothing,
            _ => return Err(format!("`{place}` is a list, not {value}")),
        };
        match field.count {
            Count::AtMost(most) if elements.len() > most => {
                return Err(format!("`{place}` has {} elements; at most {most}", elements.len()));
            }
            Count::Exactly(count) if !elements.is_empty() && elements.len() != count => {
                return Err(format!("`{place}` has {} elements instead of {count}", elements.len()));
            }
            Count::Exactly(count) if elements.is_empty() => {
                return (0..count).try_for_each(|_| self.element(&field.element, &Value::Null, place));
            }
            Count::AtMost(_) => self.length(elements.len(), place)?,
            _ => {}
        }
        elements.iter().try_for_each(|value| self.element(&field.element, value, place))
    }

    fn length(&mut self, length: usize, place: &str) -> Result<(), String> {
        let length = u32::try_from(length).map_err(|_| format!("`{place}` is too long"))?;
        self.aligned(&length.to_le_bytes());
        Ok(())
    }

    fn aligned(&mut self, bytes: &[u8]) {
        self.bytes.resize(self.bytes.len().next_multiple_of(bytes.len()), 0);
        self.bytes.extend(bytes);
    }

    fn element(&mut self, element: &Element, value: &Value, place: &str) -> Result<(), String> {
        let primitive = match element {
            Element::Message(name) => return self.message(name, value, place),
            Element::Primitive(primitive) => primitive,
        };
        let wrong = |what: &str| format!("`{place}` is {what}, not {value}");
        match primitive {
            Primitive::Bool => {
                let value = if value.is_null() { Some(false) } else { value.as_bool() };
                self.bytes.push(u8::from(value.ok_or_else(|| wrong("true or false"))?));
            }
            Primitive::Int(size) => {
                let value = if value.is_null() { Some(0) } else { whole(value) };
                let value = value.filter(|value| *size == 8 || value.unsigned_abs() <= 1 << (8 * size - 1));
                let value = value.ok_or_else(|| wrong("a whole number"))?;
                self.aligned(&value.to_le_bytes()[..*size]);
            }
            Primitive::Uint(size) => {
                let value = if value.is_null() {
                    Some(0)
                } else {
                    value.as_u64().or_else(|| u64::try_from(whole(value)?).ok())
                };
                let value = value.filter(|value| *size == 8 || *value < 1 << (8 * size));
                let value = value.ok_or_else(|| wrong("a whole number that is not negative"))?;
                self.aligned(&value.to_le_bytes()[..*size]);
            }
            Primitive::Float(size) => {
                let value = if value.is_null() { Some(0.0) } else { value.as_f64() };
                let value = value.ok_or_else(|| wrong("a number"))?;
                #[allow(clippy::cast_possible_truncation, reason = "the layout has 4 bytes")]
                if *size == 4 {
                    self.aligned(&(value as f32).to_le_bytes())
                } else {
                    self.aligned(&value.to_le_bytes())
                }
            }
            Primitive::Text => {
                let text = if value.is_null() { Some("") } else { value.as_str() };
                let text = text.filter(|text| !text.contains('\0')).ok_or_else(|| wrong("a text"))?;
                self.length(text.len() + 1, place)?;
                self.bytes.extend(text.as_bytes());
                self.bytes.push(0);
            }
        }
        Ok(())
    }
}

/// A whole number, also one that is written with a fraction of zero.
fn whole(value: &Value) -> Option<i64> {
    #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
    let rounded = || {
        value.as_f64().filter(|value| value.fract() == 0.0 && value.abs() < 1e15).map(|value| value as i64)
    };
    value.as_i64().or_else(rounded)
}

struct Reader<'a> {
    layouts: &'a Layouts,
    bytes: &'a [u8],
    at: usize,
    values: usize,
}

impl Reader<'_> {
    fn message(&mut self, name: &str) -> Result<Message, String> {
        let fields = self.layouts.message(name).ok_or_else(|| format!("no layout of `{name}`"))?.clone();
        if fields.is_empty() {
            self.take(1, name)?;
        }
        let values: Result<_, String> = fields.iter().map(|field| self.field(field)).collect();
        Ok(Message::Record(Arc::clone(&fields), values?))
    }

    fn field(&mut self, field: &Field) -> Result<Message, String> {
        let count = match field.count {
            Count::One => return self.element(&field.element, &field.name),
            Count::Exactly(count) => count,
            Count::AtMost(most) => {
                let bytes = self.aligned::<4>(&field.name)?;
                let count = u32::from_le_bytes(bytes) as usize;
                // Every element has at least one byte.
                if count > most || count > self.bytes.len() - self.at {
                    return Err(format!(
                        "`{}` has {count} elements, more than the message can have",
                        field.name
                    ));
                }
                count
            }
        };
        if field.element == Element::Primitive(Primitive::Uint(1)) {
            return Ok(Message::Bytes(self.take(count, &field.name)?.to_vec()));
        }
        let values: Result<_, String> =
            (0..count).map(|_| self.element(&field.element, &field.name)).collect();
        Ok(Message::List(values?))
    }

    fn element(&mut self, element: &Element, name: &str) -> Result<Message, String> {
        self.values += 1;
        if self.values > MAX_VALUES {
            return Err(format!("it has more than {MAX_VALUES} values"));
        }
        let primitive = match element {
            Element::Message(inner) => return self.message(inner),
            Element::Primitive(primitive) => primitive,
        };
        Ok(match primitive {
            Primitive::Bool => Message::Bool(self.take(1, name)? != [0]),
            Primitive::Int(1) => Message::Int(i8::from_le_bytes(self.aligned(name)?).into()),
            Primitive::Int(2) => Message::Int(i16::from_le_bytes(self.aligned(name)?).into()),
            Primitive::Int(4) => Message::Int(i32::from_le_bytes(self.aligned(name)?).into()),
            Primitive::Int(_) => Message::Int(i64::from_le_bytes(self.aligned(name)?)),
            Primitive::Uint(1) => Message::Uint(u8::from_le_bytes(self.aligned(name)?).into()),
            Primitive::Uint(2) => Message::Uint(u16::from_le_bytes(self.aligned(name)?).into()),
            Primitive::Uint(4) => Message::Uint(u32::from_le_bytes(self.aligned(name)?).into()),
            Primitive::Uint(_) => Message::Uint(u64::from_le_bytes(self.aligned(name)?)),
            Primitive::Float(4) => Message::Float(f32::from_le_bytes(self.aligned(name)?).into()),
            Primitive::Float(_) => Message::Float(f64::from_le_bytes(self.aligned(name)?)),
            Primitive::Text => {
                let length = u32::from_le_bytes(self.aligned(name)?) as usize;
                let bytes = self.take(length, name)?;
                // A text ends at its first zero byte, as for readers in C.
                let text = bytes.split(|byte| *byte == 0).next().unwrap_or_default();
                Message::Text(String::from_utf8_lossy(text).into_owned())
            }
        })
    }

    fn aligned<const SIZE: usize>(&mut self, name: &str) -> Result<[u8; SIZE], String> {
        self.at = self.at.next_multiple_of(SIZE);
        let bytes = self.take(SIZE, name)?;
        bytes.try_into().map_err(|_| format!("it ends at `{name}`"))
    }

    fn take(&mut self, count: usize, name: &str) -> Result<&[u8], String> {
        let end = self.at.checked_add(count).filter(|end| *end <= self.bytes.len());
        let end = end.ok_or_else(|| format!("it ends at `{name}`"))?;
        let bytes = &self.bytes[self.at..end];
        self.at = end;
        Ok(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::Distribution;
    use serde_json::json;

    fn layouts() -> Layouts {
        Layouts::of(Distribution::Jazzy, None).unwrap()
    }

    #[test]
    fn message_comes_back() {
        let layouts = layouts();
        let value = json!({"header": {"frame_id": "map", "stamp": {"sec": -3, "nanosec": 5}},
            "name": ["a", "bcd"], "position": [0.1, -2.5], "velocity": [], "effort": [1e-9]});
        let bytes = encode(&layouts, "sensor_msgs/JointState", &value).unwrap();
        let message = decode(&layouts, "sensor_msgs/JointState", &bytes).unwrap();
        assert_eq!(serde_json::to_value(&message).unwrap(), value);
        assert_eq!(message.numbers("position"), [0.1, -2.5]);
    }

    #[test]
    fn bytes_are_aligned_as_cdr_has_it() {
        let bytes =
            encode(&layouts(), "std_srvs/SetBool_Response", &json!({"success": true, "message": "ab"}));
        assert_eq!(bytes.unwrap(), [1, 0, 0, 0, 3, 0, 0, 0, b'a', b'b', 0]);
        assert_eq!(encode(&layouts(), "std_msgs/Empty", &Value::Null).unwrap(), [0]);
    }

    #[test]
    fn every_layout_reads_its_own_zeros_and_no_less() {
        let layouts = layouts();
        for (name, _) in layouts.interfaces().filter(|(_, kind)| *kind == crate::layout::Kind::Message) {
            let bytes = encode(&layouts, name, &Value::Null).unwrap();
            decode(&layouts, name, &bytes).unwrap();
            assert!(decode(&layouts, name, &bytes[..bytes.len() - 1]).is_err(), "{name}");
        }
    }

    #[test]
    fn length_beyond_the_message_is_an_error() {
        let wrong = decode(&layouts(), "tf2_msgs/TFMessage", &[255, 255, 255, 255, 0]).unwrap_err();
        assert_eq!(wrong, "`transforms` has 4294967295 elements, more than the message can have");
    }

    #[test]
    fn wrong_values_name_their_field() {
        let wrong = |value| encode(&layouts(), "geometry_msgs/PoseStamped", &value).unwrap_err();
        assert!(wrong(json!({"pos": {}})).contains("has no field `pos`; it has header, pose"));
        let text = wrong(json!({"pose": {"position": {"x": "far"}}}));
        assert_eq!(text, "`geometry_msgs/PoseStamped.pose.position.x` is a number, not \"far\"");
    }
}
