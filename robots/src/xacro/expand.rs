//! Expansion of the elements of a xacro.

use std::collections::HashMap;
use std::rc::Rc;

use motet_syntax::xml::{CrowdedElement, crowded};
use roxmltree::{Document, Node, ParsingOptions};

use super::XacroFiles;
use super::expression::{Names, evaluate};
use super::parameter::{Parameter, ParameterKind, parameters};
use super::value::Value;
use super::yaml;

/// Limits of a description.
const MAX_NODES: u32 = 200_000;
const MAX_BYTES: usize = 16 << 20;
const MAX_DEPTH: usize = 100;
const MAX_INCLUDES: usize = 500;
/// Expressions that are evaluated in all.
const MAX_STEPS: usize = 500_000;

/// Expands a xacro to a URDF. `name` is the path of the file, `arguments` its arguments by name.
///
/// # Errors
///
/// The file with the line of the first mistake, or what cannot be expanded.
///
/// ```
/// use motet_robots::xacro::{XacroFiles, expand};
///
/// struct NoFiles;
/// impl XacroFiles for NoFiles {
///     fn read(&mut self, path: &str) -> Result<String, String> {
///         Err(format!("no {path}"))
///     }
///     fn package(&mut self, _: &str) -> Option<String> {
///         None
///     }
/// }
/// let text = r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">
///     <xacro:property name="side" value="left"/><link name="${side}_arm"/></robot>"#;
/// let urdf = expand("r.xacro", text, &[], &mut NoFiles)?;
/// assert!(urdf.contains(r#"<link name="left_arm"/>"#));
/// # Ok::<(), String>(())
/// ```
pub fn expand(
    name: &str,
    text: &str,
    arguments: &[(String, String)],
    files: &mut dyn XacroFiles,
) -> Result<String, String> {
    let mut expander = Expander {
        files,
        arguments: arguments.iter().cloned().collect(),
        scopes: vec![Scope::default()],
        macros: HashMap::new(),
        out: String::from("<?xml version=\"1.0\"?>\n"),
        file: name.to_owned(),
        depth: 0,
        includes: 0,
        steps: 0,
        yamls: HashMap::new(),
    };
    let document = parse(name, text)?;
    let root = document.root_element();
    expander.element(root)?;
    Ok(expander.out)
}

fn parse<'t>(name: &str, text: &'t str) -> Result<Document<'t>, String> {
    if text.len() > MAX_BYTES {
        return Err(format!("{name}: it is larger than {} MiB", MAX_BYTES >> 20));
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, entity_resolver: None };
    if let Some(CrowdedElement { at, what, limit }) = crowded(text) {
        let line = text.get(..at).unwrap_or_default().lines().count().max(1);
        return Err(format!("{name}: line {line} has more than {limit} {what}"));
    }
    Document::parse_with_options(text.trim_start_matches('\u{feff}').trim_start(), options)
        .map_err(|error| format!("{name}: {error}"))
}

/// Property as it was written.
#[derive(Clone)]
enum Property {
    Value(Value),
    /// Text whose names are not all known yet.
    Later(String),
    /// Elements that `xacro:insert_block` inserts, expanded.
    Block(Rc<str>),
}

#[derive(Default)]
struct Scope {
    properties: HashMap<String, Property>,
}

struct Macro {
    parameters: Vec<Parameter>,
    /// Text of the file with the macro, and the place of its element.
    text: Rc<str>,
    file: String,
    at: usize,
}

struct Expander<'a> {
    files: &'a mut dyn XacroFiles,
    arguments: HashMap<String, String>,
    scopes: Vec<Scope>,
    macros: HashMap<String, Rc<Macro>>,
    out: String,
    /// File whose elements are expanded.
    file: String,
    depth: usize,
    includes: usize,
    steps: usize,
    yamls: HashMap<String, Value>,
}

impl Names for Expander<'_> {
    fn name(&mut self, name: &str) -> Result<Option<Value>, String> {
        let found = self.scopes.iter().rev().find_map(|scope| scope.properties.get(name).cloned());
        match found {
            None | Some(Property::Block(_)) => Ok(None),
            Some(Property::Value(value)) => Ok(Some(value)),
            Some(Property::Later(text)) => {
                self.enter()?;
                let value = self.text(&text);
                self.depth -= 1;
                value.map(|value| Some(literal(value)))
            }
        }
    }

    fn load_yaml(&mut self, path: &str) -> Result<Value, String> {
        if let Some(known) = self.yamls.get(path) {
            return Ok(known.clone());
        }
        let path = self.beside(path);
        let text = self.files.read(&path)?;
        let value = yaml::read(&text).map_err(|wrong| format!("{path}: {wrong}"))?;
        self.yamls.insert(path, value.clone());
        Ok(value)
    }
}

/// Value of a text that looks like one.
fn literal(value: Value) -> Value {
    if let Value::Text(text) = &value { Value::of_literal(text) } else { value }
}

impl Expander<'_> {
    fn enter(&mut self) -> Result<(), String> {
        self.depth += 1;
        self.steps += 1;
        if self.depth > MAX_DEPTH {
            return Err(format!("macros and includes are nested more than {MAX_DEPTH} deep"));
        }
        if self.steps > MAX_STEPS || self.out.len() > MAX_BYTES {
            return Err("the description grows beyond all bounds".to_owned());
        }
        Ok(())
    }

    /// Path of a file as seen from the one that is expanded.
    fn beside(&self, path: &str) -> String {
        match self.file.rsplit_once('/') {
            Some((folder, _)) if !path.starts_with('/') => format!("{folder}/{path}"),
            _ => path.to_owned(),
        }
    }

    fn wrong(&self, node: Node<'_, '_>, why: &str) -> String {
        // An error from within has its place already.
        if why.contains(", line ") {
            return why.to_owned();
        }
        let line = node.document().text_pos_at(node.range().start).row;
        format!("{}, line {line}: {why}", self.file)
    }

    // Texts.

    /// Value of a text with `${…}` and `$(…)` in it.
    fn text(&mut self, text: &str) -> Result<Value, String> {
        self.steps += 1;
        if self.steps > MAX_STEPS {
            return Err("the description grows beyond all bounds".to_owned());
        }
        let (mut parts, mut rest): (Vec<Value>, &str) = (Vec::new(), text);
        while let Some(at) = rest.find('$') {
            let (before, after) = rest.split_at(at);
            if !before.is_empty() {
                parts.push(Value::Text(before.to_owned()));
            }
            let after = after.get(1..).unwrap_or_default();
            let dollars = after.len() - after.trim_start_matches('$').len();
            let behind = after.get(dollars..).unwrap_or_default();
            if dollars > 0 && behind.starts_with(['{', '(']) {
                // `$${` is a dollar and a brace.
                parts.push(Value::Text("$".repeat(dollars)));
                parts.push(Value::Text(behind.get(..1).unwrap_or_default().to_owned()));
                rest = behind.get(1..).unwrap_or_default();
            } else if let Some(inner) = after.strip_prefix('{') {
                let end = closing(inner, '{', '}').ok_or("`${` has no end")?;
                let mut expression = inner.get(..end).unwrap_or_default().to_owned();
                if expression.contains("$(") {
                    expression = self.text(&expression)?.text();
                }
                let value = evaluate(&expression, self);
                parts.push(value.map_err(|wrong| format!("`${{{expression}}}`: {wrong}"))?);
                rest = inner.get(end + 1..).unwrap_or_default();
            } else if let Some(inner) = after.strip_prefix('(') {
                let end = closing(inner, '(', ')').ok_or("`$(` has no end")?;
                let command = inner.get(..end).unwrap_or_default();
                parts.push(Value::Text(self.command(command)?));
                rest = inner.get(end + 1..).unwrap_or_default();
            } else {
                parts.push(Value::Text("$".to_owned()));
                rest = after;
            }
        }
        if !rest.is_empty() {
            parts.push(Value::Text(rest.to_owned()));
        }
        match parts.len() {
            0 => Ok(Value::Text(String::new())),
            1 => Ok(parts.swap_remove(0)),
            _ => Ok(Value::Text(parts.iter().map(Value::text).collect())),
        }
    }

    /// Text of `$(find …)`, `$(arg …)` and the like.
    fn command(&mut self, command: &str) -> Result<String, String> {
        let command = self.text(command)?.text();
        let mut words = command.split_whitespace();
        match (words.next(), words.next()) {
            (Some("find"), Some(package)) => {
                let found = self.files.package(package);
                found.ok_or_else(|| format!("the package `{package}` is nowhere; give `--packages FOLDER`"))
            }
            (Some("arg"), Some(name)) => {
                let known = self.arguments.get(name).cloned();
                known.ok_or_else(|| format!("the argument `{name}` has no value; give `--arg {name}:=VALUE`"))
            }
            // The environment of this machine is no part of a robot.
            (Some("optenv"), Some(_)) => Ok(words.collect::<Vec<_>>().join(" ")),
            (Some("eval"), Some(_)) => {
                let expression = command.trim().strip_prefix("eval").unwrap_or_default().to_owned();
                Ok(evaluate(&expression, self)?.text())
            }
            _ => Err(format!("`$({command})` is not expanded")),
        }
    }

    fn attribute(&mut self, node: Node<'_, '_>, name: &str) -> Result<Option<Value>, String> {
        let Some(text) = node.attribute(name) else { return Ok(None) };
        let value = self.text(text).map_err(|wrong| self.wrong(node, &wrong))?;
        Ok(Some(value))
    }

    fn needed(&mut self, node: Node<'_, '_>, name: &str) -> Result<String, String> {
        let value = self.attribute(node, name)?;
        value.map(|value| value.text()).ok_or_else(|| self.wrong(node, &format!("`{name}` is missing")))
    }

    // Elements.

    fn children(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        for child in node.children() {
            if child.is_element() {
                self.element(child)?;
            } else if child.is_text() {
                let text = child.text().unwrap_or_default();
                if !text.trim().is_empty() {
                    let value = self.text(text).map_err(|wrong| self.wrong(node, &wrong))?;
                    escape(&mut self.out, &value.text());
                }
            }
        }
        Ok(())
    }

    fn element(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        self.enter().map_err(|wrong| self.wrong(node, &wrong))?;
        let done = match node.tag_name().namespace() {
            Some(space) if is_xacro(space) => self.xacro(node),
            // Extensions in namespaces of others mean nothing in a URDF.
            Some(_) => Ok(()),
            None => self.plain(node),
        };
        self.depth -= 1;
        done
    }

    fn plain(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        let name = node.tag_name().name();
        let attributes = node.attributes().filter(|attribute| attribute.namespace().is_none());
        let mut written = String::new();
        for attribute in attributes {
            let value = self.text(attribute.value()).map_err(|wrong| self.wrong(node, &wrong))?;
            written.push_str(&format!(" {}=\"", attribute.name()));
            escape(&mut written, &value.text());
            written.push('"');
        }
        let begin = self.out.len();
        self.out.push_str(&format!("<{name}{written}>"));
        let inside = self.out.len();
        self.children(node)?;
        if self.out.len() == inside {
            self.out.truncate(begin);
            self.out.push_str(&format!("<{name}{written}/>\n"));
        } else {
            self.out.push_str(&format!("</{name}>\n"));
        }
        Ok(())
    }

    fn xacro(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        match node.tag_name().name() {
            "property" => self.property(node),
            "arg" => {
                let name = self.needed(node, "name")?;
                if let Some(default) = self.attribute(node, "default")? {
                    self.arguments.entry(name).or_insert_with(|| default.text());
                }
                Ok(())
            }
            "macro" => self.define(node),
            "include" => self.include(node),
            tag @ ("if" | "unless") => {
                let value = self.attribute(node, "value")?;
                let value = value.ok_or_else(|| self.wrong(node, "`value` is missing"))?;
                let holds = value.condition();
                let holds =
                    holds.ok_or_else(|| self.wrong(node, &format!("`{}` is no truth", value.text())))?;
                if holds == (tag == "if") { self.children(node) } else { Ok(()) }
            }
            "insert_block" => {
                let name = self.needed(node, "name")?;
                let found = self.scopes.iter().rev().find_map(|scope| scope.properties.get(&name));
                match found {
                    Some(Property::Block(block)) => {
                        let block = Rc::clone(block);
                        self.out.push_str(&block);
                        Ok(())
                    }
                    _ => Err(self.wrong(node, &format!("there is no block `{name}`"))),
                }
            }
            "call" => {
                let name = self.needed(node, "macro")?;
                self.call(node, &name)
            }
            name => {
                let name = name.to_owned();
                self.call(node, &name)
            }
        }
    }

    fn property(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        let name = self.needed(node, "name")?;
        let is_known = self.scopes.iter().any(|scope| scope.properties.contains_key(&name));
        let given = match node.attribute("value") {
            Some(text) => Some(text),
            None => match node.attribute("default") {
                Some(_) if is_known => return Ok(()),
                other => other,
            },
        };
        let last = self.scopes.len().saturating_sub(1);
        let (at, is_due) = match node.attribute("scope") {
            Some("global") => (0, true),
            Some("parent") => (last.saturating_sub(1), true),
            _ => (last, false),
        };
        let property = match given {
            None => {
                let before = std::mem::take(&mut self.out);
                let done = self.children(node);
                let block = std::mem::replace(&mut self.out, before);
                done?;
                Property::Block(block.into())
            }
            Some(text) => match self.text(text) {
                Ok(value) => Property::Value(literal(value)),
                // Names that come later may make it whole.
                Err(wrong) if wrong.contains("is not defined") && !is_due => Property::Later(text.to_owned()),
                Err(wrong) => return Err(self.wrong(node, &wrong)),
            },
        };
        if let Some(scope) = self.scopes.get_mut(at) {
            scope.properties.insert(name, property);
        }
        Ok(())
    }

    fn define(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        let name = self.needed(node, "name")?;
        let name = name.trim_start_matches("xacro:").to_owned();
        let parameters = parameters(node.attribute("params").unwrap_or_default());
        let own = Macro {
            parameters: parameters.map_err(|wrong| self.wrong(node, &wrong))?,
            text: node.document().input_text().into(),
            file: self.file.clone(),
            at: node.range().start,
        };
        self.macros.insert(name, Rc::new(own));
        Ok(())
    }

    fn include(&mut self, node: Node<'_, '_>) -> Result<(), String> {
        let path = self.needed(node, "filename")?;
        self.includes += 1;
        if self.includes > MAX_INCLUDES {
            return Err(self.wrong(node, &format!("more than {MAX_INCLUDES} files are included")));
        }
        let path = self.beside(&path);
        let text = match self.files.read(&path) {
            Ok(text) => text,
            Err(_) if node.attribute("optional") == Some("true") => return Ok(()),
            Err(why) => return Err(self.wrong(node, &why)),
        };
        let document = parse(&path, &text)?;
        let before = std::mem::replace(&mut self.file, path);
        let done = self.children(document.root_element());
        self.file = before;
        done
    }

    fn call(&mut self, node: Node<'_, '_>, name: &str) -> Result<(), String> {
        let Some(own) = self.macros.get(name).cloned() else {
            return Err(self.wrong(node, &format!("there is no macro `{name}`")));
        };
        let scope = self.bind(node, name, &own)?;
        let document = parse(&own.file, &own.text)?;
        let body = document.descendants().find(|inner| inner.is_element() && inner.range().start == own.at);
        let Some(body) = body else { return Err(self.wrong(node, &format!("the macro `{name}` is lost"))) };
        self.scopes.push(scope);
        let before = std::mem::replace(&mut self.file, own.file.clone());
        let done = self.children(body);
        self.file = before;
        self.scopes.pop();
        done
    }

    /// Parameters of a call, evaluated where it stands.
    fn bind(&mut self, node: Node<'_, '_>, name: &str, own: &Macro) -> Result<Scope, String> {
        let mut scope = Scope::default();
        // Blocks are expanded where the call stands.
        let mut blocks = Vec::new();
        for child in node.children().filter(Node::is_element) {
            let before = std::mem::take(&mut self.out);
            let is_xacro = child.tag_name().namespace().is_some_and(is_xacro);
            let done = self.element(child);
            let whole = std::mem::take(&mut self.out);
            self.out = before;
            done?;
            let before = std::mem::take(&mut self.out);
            let done = if is_xacro { Ok(()) } else { self.children(child) };
            let inside = std::mem::replace(&mut self.out, before);
            done?;
            blocks.push((whole, inside));
        }
        let mut blocks = blocks.into_iter();
        for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
            let is_known = own.parameters.iter().any(|parameter| parameter.name == attribute.name());
            let names_macro = node.tag_name().name() == "call" && attribute.name() == "macro";
            if !is_known && !names_macro {
                let why = format!("the macro `{name}` has no parameter `{}`", attribute.name());
                return Err(self.wrong(node, &why));
            }
        }
        for parameter in &own.parameters {
            let given = self.attribute(node, &parameter.name)?;
            let property = match (&parameter.kind, given) {
                (ParameterKind::Block(is_inside), _) => {
                    let missing = || self.wrong(node, &format!("the block `{}` is missing", parameter.name));
                    let (whole, inside) = blocks.next().ok_or_else(missing)?;
                    Property::Block(if *is_inside { inside } else { whole }.into())
                }
                (_, Some(value)) => Property::Value(literal(value)),
                (ParameterKind::Needed, None) => {
                    return Err(self
                        .wrong(node, &format!("the parameter `{}` of `{name}` is missing", parameter.name)));
                }
                (ParameterKind::Default(default, is_passed), None) => {
                    let passed = if *is_passed { self.name(&parameter.name)? } else { None };
                    match (passed, default) {
                        (Some(value), _) => Property::Value(value),
                        (None, Some(text)) => {
                            let value =
                                self.default(&scope, text).map_err(|wrong| self.wrong(node, &wrong))?;
                            Property::Value(literal(value))
                        }
                        (None, None) => {
                            let why =
                                format!("nothing of the name `{}` is passed to `{name}`", parameter.name);
                            return Err(self.wrong(node, &why));
                        }
                    }
                }
            };
            scope.properties.insert(parameter.name.clone(), property);
        }
        Ok(scope)
    }

    /// Value of a default, which may name the parameters before it.
    fn default(&mut self, before: &Scope, text: &str) -> Result<Value, String> {
        self.scopes.push(Scope { properties: before.properties.clone() });
        let value = self.text(text);
        self.scopes.pop();
        value
    }
}

/// Place of the sign that closes what is open before a text.
fn closing(text: &str, opens: char, closes: char) -> Option<usize> {
    let (mut depth, mut quote) = (0_usize, None);
    for (at, letter) in text.char_indices() {
        match quote {
            Some(open) if letter == open => quote = None,
            Some(_) => {}
            None if letter == '\'' || letter == '"' => quote = Some(letter),
            None if letter == opens => depth += 1,
            None if letter == closes && depth == 0 => return Some(at),
            None if letter == closes => depth -= 1,
            None => {}
        }
    }
    // A lone quote is a letter like others.
    if quote.is_some() { text.find(closes) } else { None }
}

fn is_xacro(namespace: &str) -> bool {
    namespace.trim_end_matches('/').ends_with("xacro")
}

/// Writes a text of XML.
fn escape(out: &mut String, text: &str) {
    for letter in text.chars() {
        match letter {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            other => out.push(other),
        }
    }
}
