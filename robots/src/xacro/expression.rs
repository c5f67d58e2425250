//! Expressions: the part of Python that descriptions use.

use super::value::{MOST, Value};

/// Greatest depth of an expression.
const MAX_DEPTH: usize = 64;

/// What an expression may ask for.
pub(super) trait Names {
    /// Value of a property; `None` if nobody has defined it.
    fn name(&mut self, name: &str) -> Result<Option<Value>, String>;
    /// Content of a YAML file.
    fn load_yaml(&mut self, path: &str) -> Result<Value, String>;
}

/// Value of an expression.
pub(super) fn evaluate(text: &str, names: &mut dyn Names) -> Result<Value, String> {
    let tokens = tokens(text)?;
    let mut parser = Evaluator { tokens: &tokens, at: 0, names, is_dead: 0, depth: 0 };
    let value = parser.choice()?;
    match parser.peek() {
        None => Ok(value),
        Some(token) => Err(format!("`{}` is not expected", token.text())),
    }
}

#[derive(Clone, PartialEq, Debug)]
enum Token {
    Value(Value),
    Name(String),
    Sign(&'static str),
}

impl Token {
    fn text(&self) -> String {
        match self {
            Self::Value(value) => value.text(),
            Self::Name(name) => name.clone(),
            Self::Sign(sign) => (*sign).to_owned(),
        }
    }
}

/// Signs, the longer ones first.
const SIGNS: [&str; 23] = [
    "**", "//", "==", "!=", "<=", ">=", "<", ">", "+", "-", "*", "/", "%", "(", ")", "[", "]", "{", "}", ",",
    ":", ".", "=",
];

fn tokens(text: &str) -> Result<Vec<Token>, String> {
    let (mut tokens, mut rest) = (Vec::new(), text.trim_start());
    while let Some(first) = rest.chars().next() {
        let (token, length) = if first == '\'' || first == '"' {
            let inner = rest.get(1..).unwrap_or_default();
            let end = inner.find(first).ok_or("a text has no end")?;
            (Token::Value(Value::Text(inner.get(..end).unwrap_or_default().to_owned())), end + 2)
        } else if first.is_ascii_digit()
            || rest.starts_with('.') && rest.chars().nth(1).is_some_and(|next| next.is_ascii_digit())
        {
            let length = number_length(rest);
            let word = rest.get(..length).unwrap_or_default();
            let int = word.parse().map(Value::Int);
            let value = int.or_else(|_| word.parse().map(Value::Float));
            (Token::Value(value.map_err(|_| format!("`{word}` is no number"))?), length)
        } else if first.is_alphabetic() || first == '_' {
            let is_word = |letter: char| letter.is_alphanumeric() || letter == '_';
            let length = rest.find(|letter| !is_word(letter)).unwrap_or(rest.len());
            (Token::Name(rest.get(..length).unwrap_or_default().to_owned()), length)
        } else {
            let sign = SIGNS.into_iter().find(|sign| rest.starts_with(sign));
            let sign = sign.ok_or_else(|| format!("`{first}` has no meaning here"))?;
            (Token::Sign(sign), sign.len())
        };
        tokens.push(token);
        rest = rest.get(length..).unwrap_or_default().trim_start();
    }
    Ok(tokens)
}

/// Bytes of the number that a text begins with.
fn number_length(text: &str) -> usize {
    let mut before = ' ';
    let end = text.find(|letter: char| {
        let is_sign = (letter == '-' || letter == '+') && matches!(before, 'e' | 'E');
        let is_part = letter.is_ascii_digit() || letter == '.' || matches!(letter, 'e' | 'E') || is_sign;
        before = letter;
        !is_part
    });
    end.unwrap_or(text.len())
}

struct Evaluator<'a> {
    tokens: &'a [Token],
    at: usize,
    names: &'a mut dyn Names,
    /// Above 0 in parts whose value nobody needs: names may be missing there.
    is_dead: usize,
    depth: usize,
}

impl Evaluator<'_> {
    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    fn takes(&mut self, sign: &str) -> bool {
        let is_it = matches!(self.peek(), Some(Token::Sign(own)) if *own == sign);
        self.at += usize::from(is_it);
        is_it
    }

    fn takes_word(&mut self, word: &str) -> bool {
        let is_it = matches!(self.peek(), Some(Token::Name(own)) if own == word);
        self.at += usize::from(is_it);
        is_it
    }

    fn needs(&mut self, sign: &str) -> Result<(), String> {
        if self.takes(sign) { Ok(()) } else { Err(format!("`{sign}` is missing")) }
    }

    /// `A if B else C`. The condition comes after the value that depends on it, so the value is read twice.
    fn choice(&mut self) -> Result<Value, String> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(format!("it is nested more than {MAX_DEPTH} deep"));
        }
        let begin = self.at;
        self.is_dead += 1;
        self.either()?;
        self.is_dead -= 1;
        let value = if self.takes_word("if") {
            let condition = self.either()?.is_true();
            if !self.takes_word("else") {
                return Err("`else` is missing".to_owned());
            }
            self.is_dead += usize::from(condition);
            let other = self.choice()?;
            self.is_dead -= usize::from(condition);
            let end = self.at;
            let value = if condition {
                self.at = begin;
                self.either()?
            } else {
                other
            };
            self.at = end;
            value
        } else {
            self.at = begin;
            self.either()?
        };
        self.depth -= 1;
        Ok(value)
    }

    fn either(&mut self) -> Result<Value, String> {
        let mut value = self.both()?;
        while self.takes_word("or") {
            let decides = value.is_true();
            self.is_dead += usize::from(decides);
            let other = self.both()?;
            self.is_dead -= usize::from(decides);
            value = if decides { value } else { other };
        }
        Ok(value)
    }

    fn both(&mut self) -> Result<Value, String> {
        let mut value = self.negation()?;
        while self.takes_word("and") {
            let decides = !value.is_true();
            self.is_dead += usize::from(decides);
            let other = self.negation()?;
            self.is_dead -= usize::from(decides);
            value = if decides { value } else { other };
        }
        Ok(value)
    }

    fn negation(&mut self) -> Result<Value, String> {
        let mut is_not = false;
        let mut is_any = false;
        while self.takes_word("not") {
            (is_not, is_any) = (!is_not, true);
        }
        let value = self.comparison()?;
        Ok(if is_any { Value::Bool(value.is_true() != is_not) } else { value })
    }

    fn comparison(&mut self) -> Result<Value, String> {
        let mut left = self.sum()?;
        let mut result = None;
        loop {
            let signs = ["==", "!=", "<=", ">=", "<", ">"];
            let sign = signs.into_iter().find(|sign| self.takes(sign));
            let (is_in, is_not) = match sign {
                Some(_) => (false, false),
                None if self.takes_word("in") => (true, false),
                None if matches!(self.tokens.get(self.at + 1), Some(Token::Name(word)) if word == "in")
                    && self.takes_word("not") =>
                {
                    self.at += 1;
                    (true, true)
                }
                None => return Ok(result.unwrap_or(left)),
            };
            let right = self.sum()?;
            let holds = if self.is_dead > 0 {
                false
            } else if is_in {
                right.contains(&left)? != is_not
            } else {
                match sign.unwrap_or_default() {
                    "==" => left.equals(&right),
                    "!=" => !left.equals(&right),
                    "<" => left.order(&right)?.is_lt(),
                    "<=" => left.order(&right)?.is_le(),
                    ">" => left.order(&right)?.is_gt(),
                    _ => left.order(&right)?.is_ge(),
                }
            };
            let before = result.as_ref().is_none_or(Value::is_true);
            result = Some(Value::Bool(before && holds));
            left = right;
        }
    }

    fn sum(&mut self) -> Result<Value, String> {
        self.row(&["+", "-"], Self::product)
    }

    fn product(&mut self) -> Result<Value, String> {
        self.row(&["*", "//", "/", "%"], Self::factor)
    }

    fn row(
        &mut self,
        signs: &[&'static str],
        part: impl Fn(&mut Self) -> Result<Value, String>,
    ) -> Result<Value, String> {
        let mut value = part(self)?;
        while let Some(sign) = signs.iter().find(|sign| self.takes(sign)) {
            let other = part(self)?;
            value = self.alive(|| value.combine(sign, &other))?;
        }
        Ok(value)
    }

    /// Result of a part, unless nobody needs it.
    fn alive(&self, result: impl FnOnce() -> Result<Value, String>) -> Result<Value, String> {
        if self.is_dead > 0 { Ok(Value::Int(1)) } else { result() }
    }

    fn factor(&mut self) -> Result<Value, String> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(format!("it is nested more than {MAX_DEPTH} deep"));
        }
        let value = if self.takes("-") {
            let value = self.factor()?;
            self.alive(|| Value::Int(0).combine("-", &value))
        } else if self.takes("+") {
            self.factor()
        } else {
            let value = self.part()?;
            if self.takes("**") {
                let power = self.factor()?;
                self.alive(|| value.combine("**", &power))
            } else {
                Ok(value)
            }
        };
        self.depth -= 1;
        value
    }

    /// An atom with its indices, fields and calls.
    fn part(&mut self) -> Result<Value, String> {
        let mut value = self.atom()?;
        loop {
            if self.takes("[") {
                let at = self.choice()?;
                self.needs("]")?;
                value = self.alive(|| value.index(&at))?;
            } else if self.takes(".") {
                let Some(Token::Name(name)) = self.peek().cloned() else {
                    return Err("a name is missing after `.`".to_owned());
                };
                self.at += 1;
                value = if self.takes("(") {
                    let given = self.arguments()?;
                    self.alive(|| method(&value, &name, &given))?
                } else {
                    self.alive(|| value.index(&Value::Text(name)))?
                };
            } else {
                return Ok(value);
            }
        }
    }

    fn arguments(&mut self) -> Result<Vec<Value>, String> {
        self.values(")")
    }

    fn values(&mut self, end: &str) -> Result<Vec<Value>, String> {
        let mut values = Vec::new();
        while !self.takes(end) {
            values.push(self.choice()?);
            if !self.takes(",") {
                self.needs(end)?;
                break;
            }
        }
        Ok(values)
    }

    fn atom(&mut self) -> Result<Value, String> {
        let Some(token) = self.peek().cloned() else { return Err("it ends early".to_owned()) };
        self.at += 1;
        match token {
            Token::Value(value) => Ok(value),
            Token::Sign("(") => {
                let value = self.choice()?;
                if self.takes(",") {
                    let mut values = vec![value];
                    values.extend(self.values(")")?);
                    return Ok(Value::List(values));
                }
                self.needs(")")?;
                Ok(value)
            }
            Token::Sign("[") => Ok(Value::List(self.values("]")?)),
            Token::Sign("{") => self.dictionary(),
            Token::Sign(sign) => Err(format!("`{sign}` is not expected")),
            Token::Name(name) => self.named(&name),
        }
    }

    fn dictionary(&mut self) -> Result<Value, String> {
        let mut entries = Vec::new();
        while !self.takes("}") {
            let key = self.choice()?.text();
            self.needs(":")?;
            entries.push((key, self.choice()?));
            if !self.takes(",") {
                self.needs("}")?;
                break;
            }
        }
        Ok(Value::Dict(entries))
    }

    fn named(&mut self, name: &str) -> Result<Value, String> {
        match name {
            "True" | "true" => return Ok(Value::Bool(true)),
            "False" | "false" => return Ok(Value::Bool(false)),
            "None" => return Ok(Value::None),
            // Functions of these modules have the same names without them.
            "xacro" | "math" | "python" if self.takes(".") => {
                let Some(Token::Name(inner)) = self.peek().cloned() else {
                    return Err(format!("a name is missing after `{name}.`"));
                };
                self.at += 1;
                return self.named(&inner);
            }
            _ => {}
        }
        if self.takes("(") {
            let given = self.arguments()?;
            if self.is_dead > 0 {
                return Ok(Value::Int(1));
            }
            if name == "load_yaml" {
                let path = given.first().map(Value::text).ok_or("`load_yaml` needs a file")?;
                return self.names.load_yaml(&path);
            }
            return call(name, &given);
        }
        if self.is_dead > 0 {
            return Ok(Value::Int(1));
        }
        match self.names.name(name)? {
            Some(value) => Ok(value),
            None => match name {
                "pi" => Ok(Value::Float(std::f64::consts::PI)),
                "e" => Ok(Value::Float(std::f64::consts::E)),
                "inf" => Ok(Value::Float(f64::INFINITY)),
                _ => Err(format!("the name `{name}` is not defined")),
            },
        }
    }
}

fn method(value: &Value, name: &str, given: &[Value]) -> Result<Value, String> {
    match (value, name, given) {
        (Value::Dict(entries), "keys", []) => {
            Ok(Value::List(entries.iter().map(|(key, _)| Value::Text(key.clone())).collect()))
        }
        (Value::Dict(_), "get", [key, rest @ ..]) => {
            Ok(value.index(key).unwrap_or_else(|_| rest.first().cloned().unwrap_or(Value::None)))
        }
        (Value::Text(text), "lower", []) => Ok(Value::Text(text.to_lowercase())),
        (Value::Text(text), "upper", []) => Ok(Value::Text(text.to_uppercase())),
        (Value::Text(text), "strip", []) => Ok(Value::Text(text.trim().to_owned())),
        (Value::Text(text), "startswith", [Value::Text(start)]) => {
            Ok(Value::Bool(text.starts_with(start.as_str())))
        }
        (Value::Text(text), "endswith", [Value::Text(end)]) => Ok(Value::Bool(text.ends_with(end.as_str()))),
        (Value::Text(text), "replace", [Value::Text(from), Value::Text(to)]) if !from.is_empty() => {
            Ok(Value::Text(text.replace(from.as_str(), to)))
        }
        (Value::Text(text), "split", []) => {
            Ok(Value::List(text.split_whitespace().map(|word| Value::Text(word.to_owned())).collect()))
        }
        (Value::Text(text), "split", [Value::Text(sign)]) if !sign.is_empty() => {
            Ok(Value::List(text.split(sign.as_str()).map(|word| Value::Text(word.to_owned())).collect()))
        }
        _ => Err(format!("there is no method `{name}` for this")),
    }
}

fn call(name: &str, given: &[Value]) -> Result<Value, String> {
    let wrong = || format!("`{name}` does not fit {}", Value::List(given.to_vec()).text());
    let float = |function: fn(f64) -> f64| {
        let number = given.first().and_then(Value::number).filter(|_| given.len() == 1);
        number.map(|number| Value::Float(function(number))).ok_or_else(wrong)
    };
    match (name, given) {
        ("sin", _) => float(libm::sin),
        ("cos", _) => float(libm::cos),
        ("tan", _) => float(libm::tan),
        ("asin", _) => float(libm::asin),
        ("acos", _) => float(libm::acos),
        ("atan", _) => float(libm::atan),
        ("sqrt", _) => float(f64::sqrt),
        ("exp", _) => float(libm::exp),
        ("log", _) => float(libm::log),
        ("radians", _) => float(f64::to_radians),
        ("degrees", _) => float(f64::to_degrees),
        ("float", [Value::Text(text)]) => text.trim().parse().map(Value::Float).map_err(|_| wrong()),
        ("float", _) => float(|number| number),
        ("fabs", _) => float(f64::abs),
        ("atan2" | "pow" | "hypot", [one, other]) => {
            let (one, other) = one.number().zip(other.number()).ok_or_else(wrong)?;
            Ok(Value::Float(match name {
                "atan2" => libm::atan2(one, other),
                "pow" => libm::pow(one, other),
                _ => libm::hypot(one, other),
            }))
        }
        ("abs", [Value::Int(value)]) => Ok(Value::Int(value.checked_abs().ok_or_else(wrong)?)),
        ("abs", _) => float(f64::abs),
        ("floor" | "ceil" | "int" | "round", [value]) => {
            let number = match value {
                Value::Text(text) => text.trim().parse().ok(),
                other => other.number(),
            };
            let number = number.filter(|number: &f64| number.abs() < 9e15).ok_or_else(wrong)?;
            #[allow(clippy::cast_possible_truncation, reason = "the range is checked")]
            Ok(Value::Int(match name {
                "floor" => number.floor() as i64,
                "ceil" => number.ceil() as i64,
                "round" => number.round_ties_even() as i64,
                _ => number as i64,
            }))
        }
        ("round", [value, digits]) => {
            let (number, digits) = value.number().zip(digits.int()).ok_or_else(wrong)?;
            let scale = libm::pow(10.0, f64::from(i32::try_from(digits.clamp(-15, 15)).unwrap_or(0)));
            Ok(Value::Float((number * scale).round_ties_even() / scale))
        }
        ("min" | "max", [Value::List(values)]) => call(name, values),
        ("min" | "max", [first, rest @ ..]) => {
            let mut best = first;
            for value in rest {
                let order = value.order(best)?;
                if (name == "min" && order.is_lt()) || (name == "max" && order.is_gt()) {
                    best = value;
                }
            }
            Ok(best.clone())
        }
        ("str", [value]) => Ok(Value::Text(value.text())),
        ("bool", [value]) => Ok(Value::Bool(value.is_true())),
        ("len", [Value::Text(text)]) => {
            Ok(Value::Int(i64::try_from(text.chars().count()).unwrap_or(i64::MAX)))
        }
        ("len", [Value::List(values)]) => Ok(Value::Int(i64::try_from(values.len()).unwrap_or(i64::MAX))),
        ("len", [Value::Dict(entries)]) => Ok(Value::Int(i64::try_from(entries.len()).unwrap_or(i64::MAX))),
        ("list", [Value::List(values)]) => Ok(Value::List(values.clone())),
        ("dict", []) => Ok(Value::Dict(Vec::new())),
        ("range", _) => {
            let numbers: Option<Vec<i64>> = given.iter().map(Value::int).collect();
            let (from, to, step) = match numbers.ok_or_else(wrong)?.as_slice() {
                [to] => (0, *to, 1),
                [from, to] => (*from, *to, 1),
                [from, to, step] if *step != 0 => (*from, *to, *step),
                _ => return Err(wrong()),
            };
            let (mut values, mut at) = (Vec::new(), from);
            while (step > 0 && at < to) || (step < 0 && at > to) {
                if values.len() >= MOST {
                    return Err(wrong());
                }
                values.push(Value::Int(at));
                at = at.saturating_add(step);
            }
            Ok(Value::List(values))
        }
        _ => Err(format!("there is no function `{name}`")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Known;

    impl Names for Known {
        fn name(&mut self, name: &str) -> Result<Option<Value>, String> {
            Ok(match name {
                "mass" => Some(Value::Float(2.0)),
                "side" => Some(Value::Text("left".to_owned())),
                "limits" => Some(Value::Dict(vec![(
                    "lift".to_owned(),
                    Value::List(vec![Value::Int(3), Value::Int(4)]),
                )])),
                _ => None,
            })
        }

        fn load_yaml(&mut self, path: &str) -> Result<Value, String> {
            super::super::yaml::read(path)
        }
    }

    fn of(text: &str) -> String {
        evaluate(text, &mut Known).map_or_else(|wrong| format!("! {wrong}"), |value| value.text())
    }

    #[test]
    fn expressions_mean_what_python_means() {
        for (text, expected) in [
            ("0.5 * mass * 3**2", "9.0"),
            ("-2**2", "-4"),
            ("7 // 2 + -7 % 3", "5"),
            ("1 if side == 'left' else -1", "1"),
            ("missing if side == 'right' else -1", "-1"),
            ("side == 'left' and not (mass > 3 or missing)", "! the name `missing` is not defined"),
            ("mass > 1 or missing", "True"),
            ("limits['lift'][-1] + limits.lift[0]", "7"),
            ("'le' in side and 'x' not in side", "True"),
            ("side + '_arm'", "left_arm"),
            ("max(1, 2.5, mass)", "2.5"),
            ("radians(180) == pi", "True"),
            ("len(range(4)) * int('3')", "12"),
            ("{'a': [1, 2]}['a'][1]", "2"),
            ("1 < mass < 3", "True"),
            ("xacro.load_yaml('a: !degrees 180').a", "3.141592653589793"),
            ("math.sqrt(16)", "4.0"),
            ("1 / 0", "! a division by zero"),
            ("(1", "! `)` is missing"),
            ("__import__('os')", "! there is no function `__import__`"),
            ("limits['knee']", "! it has no element 'knee'"),
        ] {
            assert_eq!(of(text), expected, "{text}");
        }
        assert!(of(&"(".repeat(5_000)).contains("nested"));
        assert!(of(&"-".repeat(5_000)).contains("nested"));
        assert!(of("9 ** 99999").contains("too large"));
    }
}
