//! YAML files of `load_yaml`, with the tags `!degrees` and `!radians` of ROS.

use yaml_rust2::Event;
use yaml_rust2::parser::{MarkedEventReceiver, Parser, Tag};
use yaml_rust2::scanner::{Marker, TScalarStyle};

use super::value::Value;

/// Greatest number of values of a file.
const MOST: usize = 100_000;

/// Reads the first document of a YAML file.
pub(super) fn read(text: &str) -> Result<Value, String> {
    let mut reader = Reader::default();
    let mut parser = Parser::new_from_str(text);
    parser.load(&mut reader, false).map_err(|error| error.to_string())?;
    match reader.wrong {
        Some(wrong) => Err(wrong),
        None => Ok(reader.done.unwrap_or(Value::None)),
    }
}

/// List or dictionary that is not closed.
enum Open {
    List(Vec<Value>),
    /// Entries, with the key whose value is due.
    Dict(Vec<(String, Value)>, Option<String>),
}

#[derive(Default)]
struct Reader {
    open: Vec<Open>,
    done: Option<Value>,
    wrong: Option<String>,
    count: usize,
}

impl Reader {
    fn add(&mut self, value: Value) {
        match self.open.last_mut() {
            None => self.done = Some(value),
            Some(Open::List(values)) => values.push(value),
            Some(Open::Dict(entries, key)) => match key.take() {
                None => *key = Some(value.text()),
                Some(key) => entries.push((key, value)),
            },
        }
    }
}

impl MarkedEventReceiver for Reader {
    fn on_event(&mut self, event: Event, mark: Marker) {
        self.count += 1;
        if self.count > MOST {
            self.wrong.get_or_insert_with(|| format!("it has more than {MOST} values"));
            return;
        }
        match event {
            Event::SequenceStart(..) => self.open.push(Open::List(Vec::new())),
            Event::MappingStart(..) => self.open.push(Open::Dict(Vec::new(), None)),
            Event::SequenceEnd | Event::MappingEnd => {
                let closed = match self.open.pop() {
                    Some(Open::List(values)) => Value::List(values),
                    Some(Open::Dict(entries, _)) => Value::Dict(entries),
                    None => return,
                };
                self.add(closed);
            }
            Event::Scalar(text, style, _, tag) => match scalar(&text, style, tag.as_ref()) {
                Ok(value) => self.add(value),
                Err(wrong) => {
                    self.wrong.get_or_insert_with(|| format!("line {}: {wrong}", mark.line()));
                }
            },
            // A file that names its own parts could grow without bound.
            Event::Alias(_) => {
                self.wrong.get_or_insert_with(|| format!("line {}: aliases are not read", mark.line()));
            }
            _ => {}
        }
    }
}

fn scalar(text: &str, style: TScalarStyle, tag: Option<&Tag>) -> Result<Value, String> {
    if let Some(tag) = tag.filter(|tag| tag.handle == "!") {
        let number = Value::of_literal(text).number().ok_or_else(|| format!("`{text}` is no number"))?;
        return match tag.suffix.as_str() {
            "degrees" => Ok(Value::Float(number.to_radians())),
            "radians" | "meters" => Ok(Value::Float(number)),
            other => Err(format!("the tag `!{other}` is not known")),
        };
    }
    if style != TScalarStyle::Plain {
        return Ok(Value::Text(text.to_owned()));
    }
    Ok(match text {
        "" | "~" | "null" => Value::None,
        "yes" | "on" => Value::Bool(true),
        "no" | "off" => Value::Bool(false),
        other => Value::of_literal(other),
    })
}
