//! XML of a MuJoCo model: elements, numbers and names.

use nalgebra::{Isometry3, Vector3};

/// Greatest depth of elements that MuJoCo's XML reader accepts, with some to spare.
pub(super) const DEEPEST: usize = 480;

/// Text of a document with its open elements.
#[derive(Debug, Default)]
pub(super) struct XmlText {
    text: String,
    open: Vec<&'static str>,
    /// Greatest number of open elements so far.
    pub(super) deepest: usize,
}

impl XmlText {
    /// Writes the start of an element; [`Self::close`] ends it.
    pub(super) fn open(&mut self, tag: &'static str, attributes: &[(&str, String)]) {
        self.start(tag, attributes);
        self.text.push_str(">\n");
        self.open.push(tag);
        self.deepest = self.deepest.max(self.open.len());
    }

    /// Writes an element without content.
    pub(super) fn leaf(&mut self, tag: &'static str, attributes: &[(&str, String)]) {
        self.start(tag, attributes);
        self.text.push_str("/>\n");
    }

    /// Ends the innermost open element.
    pub(super) fn close(&mut self) {
        if let Some(tag) = self.open.pop() {
            self.indent();
            self.text.push_str(&format!("</{tag}>\n"));
        }
    }

    /// Ends all open elements.
    pub(super) fn finish(mut self) -> String {
        while !self.open.is_empty() {
            self.close();
        }
        self.text
    }

    fn start(&mut self, tag: &str, attributes: &[(&str, String)]) {
        self.indent();
        self.text.push('<');
        self.text.push_str(tag);
        for (name, value) in attributes {
            self.text.push_str(&format!(" {name}=\"{}\"", escaped(value)));
        }
    }

    fn indent(&mut self) {
        self.text.extend(std::iter::repeat_n(' ', self.open.len() * 2));
    }
}

/// Value of an attribute with its special characters as entities. Of the control characters XML 1.0 has these
/// three only; names have none.
fn escaped(value: &str) -> String {
    let mut written = String::with_capacity(value.len());
    for letter in value.chars() {
        match letter {
            '&' => written.push_str("&amp;"),
            '<' => written.push_str("&lt;"),
            '>' => written.push_str("&gt;"),
            '"' => written.push_str("&quot;"),
            '\t' => written.push_str("&#9;"),
            '\n' => written.push_str("&#10;"),
            '\r' => written.push_str("&#13;"),
            _ => written.push(letter),
        }
    }
    written
}

/// Name within a model. A slash parts names of the model, and `world` is the name of the room, so both are
/// written as in a URL, and so are control characters.
pub(super) fn name(id: &str) -> String {
    let mut written = String::with_capacity(id.len());
    for letter in id.chars() {
        if letter == '/' || letter == '%' || letter.is_control() || (id == "world" && letter == 'w') {
            let mut bytes = [0; 4];
            for byte in letter.encode_utf8(&mut bytes).bytes() {
                written.push_str(&format!("%{byte:02X}"));
            }
        } else {
            written.push(letter);
        }
    }
    written
}

/// Number, rounded to a billionth: no reader needs more, and rounding errors do not show.
pub(super) fn number(value: f64) -> String {
    let rounded = libm::round(value * 1e9) / 1e9;
    // Huge numbers have no such digits; a negative zero is zero.
    let rounded = if rounded.is_finite() { rounded } else { value };
    format!("{}", rounded + 0.0)
}

/// Numbers with spaces between them.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(number).collect::<Vec<_>>().join(" ")
}

/// Attributes of a pose.
pub(super) fn pose(pose: &Isometry3<f64>) -> [(&'static str, String); 2] {
    [("pos", vector(&pose.translation.vector)), ("quat", quaternion(pose))]
}

/// Components of a vector.
pub(super) fn vector(vector: &Vector3<f64>) -> String {
    numbers(vector.iter().copied())
}

/// Rotation of a pose: w, x, y, z, of its two quaternions the one with a positive w.
fn quaternion(pose: &Isometry3<f64>) -> String {
    let [x, y, z, w]: [f64; 4] = pose.rotation.coords.into();
    let sign = if w < 0.0 { -1.0 } else { 1.0 };
    numbers([w, x, y, z].map(|part| part * sign))
}

#[cfg(test)]
mod tests {
    use super::{XmlText, name, number};

    #[test]
    fn names_and_numbers_are_written() {
        let check = |id: &str, written: &str| assert_eq!(name(id), written, "{id}");
        check("mug_1", "mug_1");
        check("a/b%c", "a%2Fb%25c");
        check("world", "%77orld");
        check("worldwide", "worldwide");
        check("tasse à café", "tasse à café");
        for (value, written) in [(-0.0, "0"), (0.1 + 0.2, "0.3"), (-2.2e-16, "0"), (1e300, "1e300")] {
            let shown = number(value);
            assert!(shown == written || shown.parse::<f64>() == written.parse::<f64>(), "{shown}");
        }
    }

    #[test]
    fn xml_escapes_values() {
        let mut xml = XmlText::default();
        xml.open("a", &[("x", "<\"&\n>".to_owned())]);
        xml.leaf("b", &[]);
        assert_eq!(xml.finish(), "<a x=\"&lt;&quot;&amp;&#10;&gt;\">\n  <b/>\n</a>\n");
    }
}
