//! Diagnostics of unknown names (M02xx), of values of the wrong type (M03xx), and of cards that do not fit
//! the declarations (M04xx).

use motet_syntax::ast::Name;
use motet_syntax::{About, Edit, Fix, Related, Span};
use smol_str::SmolStr;

use super::name::{article, list, near};
use super::unbound::Unbound;
use super::words;
use crate::ir::MotionKind;

pub(crate) fn replace(span: Span, text: &str) -> Option<Fix> {
    Some(Fix { title: format!("write `{text}`"), edits: vec![Edit { span, text: text.to_owned() }] })
}

pub(crate) fn did_you_mean(near: Option<&SmolStr>) -> Option<String> {
    near.map(|near| format!("did you mean `{near}`?"))
}

/// Place of a number of a pose, in messages.
pub(crate) const POSE_NUMBER: &str = "a number of a pose";

/// A text of the JSON syntax in a place without a type.
fn literal(name: &str) -> String {
    format!("{{\"literal\": \"{name}\"}}")
}

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// Unknown binding, parameter, entity, case or resource.
    UnknownName("M0202", Error) {
        name: SmolStr, near: Option<SmolStr>, wanted: String, known: String, scene: bool,
        about: Option<About>,
        call: Option<String>,
        is_quoted: bool,
    }
    message(m) {
        if m.wanted.is_empty() {
            format!("unknown name `{}`", m.name)
        } else {
            format!("there is no {} `{}`", m.wanted, m.name)
        }
    }
    help(m) {
        let is_itself = m.near.as_ref().and_then(|near| near.strip_prefix('$')) == Some(m.name.as_str());
        if is_itself {
            return Some(format!("`{0}` is a binding: write `${0}`", m.name));
        }
        if let Some(call) = &m.call {
            return Some(format!("write `{call}`"));
        }
        let text = format!("write `{}` for a text", literal(&m.name));
        if m.is_quoted && m.scene && m.near.is_none() {
            return Some(text);
        }
        did_you_mean(m.near.as_ref()).or_else(|| {
            if !m.scene {
                let from = "entities come from `--scene`, or from `entity` in a domain";
                let text = if m.is_quoted { format!("; {text}") } else { String::new() };
                Some(format!("there is no scene: {from}{text}"))
            } else {
                (!m.known.is_empty()).then(|| format!("there is {}", m.known))
            }
        })
    }
    fix(m) {
        if m.is_quoted && m.scene && m.near.is_none() {
            let edits = vec![Edit { span: m.span, text: literal(&m.name) }];
            return Some(Fix { title: "write a text".to_owned(), edits });
        }
        m.near.as_ref().filter(|_| m.call.is_none()).and_then(|near| replace(m.span, near))
    }
    about(m) { m.about.clone() }

    /// Part of the document in another notation than the language's, where the declarations show one reading.
    ReadNotation("M0226", Note) { written: String, read: String, fix: Fix }
    message(m) { format!("{} is read as {}", m.written, m.read) }
    help(_m) { Some("`motet check --fix` writes it so".to_owned()) }
    fix(m) { Some(m.fix.clone()) }

    /// Use of a name that is not bound.
    UnknownBinding("M0203", Error) { name: SmolStr, near: Option<SmolStr>, is_text: bool }
    message(m) { format!("nothing is bound to `{}` here", m.name) }
    help(m) {
        Some(match &m.near {
            Some(near) if *near == m.name => format!("`{}` is an entity: write it without `$`", m.name),
            Some(near) => format!("did you mean `${near}`?"),
            None if m.is_text => format!("to start a text with `$`, write two: `$${}`", m.name),
            None => "a binding is visible behind its step, where every path leads through it".to_owned(),
        })
    }
    fix(m) {
        let near = m.near.as_ref()?;
        let sigil = if *near == m.name { "" } else { "$" };
        let edit = Edit { span: m.span, text: near.to_string() };
        Some(Fix { title: format!("write `{sigil}{near}`"), edits: vec![edit] })
    }

    /// Argument for an unknown parameter.
    UnknownParameter("M0204", Error) { name: SmolStr, callee: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("`{}` has no parameter `{}`", m.callee, m.name) }
    help(m) {
        did_you_mean(m.near.as_ref()).or_else(|| {
            Some(if m.known.is_empty() {
                format!("`{}` takes no arguments", m.callee)
            } else {
                format!("it takes {}", m.known)
            })
        })
    }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// Two declarations of one file with the same name.
    Duplicate("M0205", Error) { name: SmolStr, what: &'static str, first: Span }
    message(m) { format!("the {} `{}` is declared twice", m.what, m.name) }
    help(m) { Some(format!("give one of them another name than `{}`", m.name)) }
    related(m) { vec![Related::new("first declared here", m.first)] }

    /// Unknown fluent in a condition.
    UnknownFluent("M0208", Error) {
        name: SmolStr, near: Option<SmolStr>, wanted: &'static str, known: String,
    }
    message(m) { format!("there is no {} `{}`", m.wanted, m.name) }
    help(m) {
        if let Some(fluent) = words::opposite_of(&m.name) {
            return Some(format!("write `not {fluent}(…)`"));
        }
        did_you_mean(m.near.as_ref()).or_else(|| Some(format!("the known names are {}", m.known)))
    }
    fix(m) {
        let near = m.near.as_ref().filter(|_| words::opposite_of(&m.name).is_none());
        near.and_then(|near| replace(m.span, near))
    }

    /// The name of a type is unknown.
    UnknownType("M0209", Error) { name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("there is no type `{}`", m.name) }
    help(m) { did_you_mean(m.near.as_ref()) }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// Failure that is not declared.
    UnknownFailure("M0210", Error) { name: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("there is no failure `{}`", m.name) }
    help(m) { did_you_mean(m.near.as_ref()).or_else(|| Some(format!("the failures are {}", m.known))) }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// Unknown field of an entity's kind.
    UnknownField("M0211", Error) {
        name: SmolStr, of: String, near: Option<SmolStr>, known: String, owners: String,
    }
    message(m) { format!("{} has no field `{}`", m.of, m.name) }
    help(m) {
        did_you_mean(m.near.as_ref()).or_else(|| {
            let fields = || format!("its fields are {}", m.known);
            let own = if m.known.is_empty() { format!("{} has none", m.of) } else { fields() };
            Some(if m.owners.is_empty() { own } else { format!("{} has it; {own}", m.owners) })
        })
    }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// Parameter whose name is a key of the JSON syntax.
    ReservedName("M0213", Error) { name: SmolStr }
    message(m) { format!("`{}` is a key of the JSON syntax, so no parameter can have this name", m.name) }
    help(_m) { Some("choose another name".to_owned()) }

    /// Unknown motion query.
    UnknownMotion("M0214", Error) { name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("there is no motion `{}`", m.name) }
    help(m) {
        did_you_mean(m.near.as_ref()).or_else(|| {
            let names = MotionKind::ALL.iter().map(|kind| SmolStr::new_static(kind.name()));
            Some(format!("the motions are {}", list(names)))
        })
    }

    /// Unknown resource in `uses` or `lasts`.
    UnknownResource("M0215", Error) { name: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("there is no resource `{}`", m.name) }
    help(m) { did_you_mean(m.near.as_ref()).or_else(|| Some(format!("the robot has {}", m.known))) }

    /// Use of a name that not every path to the use has bound.
    PartlyBound("M0216", Error) { name: SmolStr, bound: Span, reason: Unbound }
    message(m) {
        let name = &m.name;
        match &m.reason {
            Unbound::Path { name: path, .. } => format!("`{name}` is not bound on the path through {path}"),
            Unbound::NoElse(_) => {
                format!("`{name}` is bound only if the condition of an `if` without `else` holds")
            }
            Unbound::Handler => format!("`{name}` is bound in the `try`, which may have failed before"),
            Unbound::OtherPath => format!("`{name}` is bound on another path, which does not lead here"),
            Unbound::Cleanup => {
                format!("`{name}` is bound in the step before the `finally`, which may have ended early")
            }
            Unbound::Loop => format!("`{name}` is bound in an `each`, which may have no round"),
            Unbound::Reaction => format!("`{name}` is bound in a reaction, which may never run"),
            Unbound::Caught => format!("`{name}` is the failure of a `catch`, and known in its steps only"),
            Unbound::Beside => format!("`{name}` is bound in another branch, which runs at the same time"),
            Unbound::TwoBranches { .. } => {
                format!("`{name}` is bound in two branches, which run at the same time")
            }
        }
    }
    help(m) {
        let (name, endings) = (&m.name, "`done`, `replan`, `cannot` or `fail`");
        Some(match &m.reason {
            Unbound::Path { .. } => format!("bind `{name}` there too, or end that path with {endings}"),
            Unbound::NoElse(_) => {
                format!("use `{name}` inside the `if`, or add an `else` that binds it or ends with {endings}")
            }
            Unbound::Handler => format!("bind `{name}` before the `try`, or by a step of the handler"),
            Unbound::OtherPath => format!("bind `{name}` on this path too, or before the paths part"),
            Unbound::Cleanup => format!("bind `{name}` before that step, or by a step of the `finally`"),
            Unbound::Loop => format!("use `{name}` inside the loop"),
            Unbound::Reaction => format!("bind `{name}` before the monitor, or in its body"),
            Unbound::Caught => format!("use `{name}` in the steps of the `catch`"),
            Unbound::Beside => format!("use `{name}` behind the `parallel`, or bind it before"),
            Unbound::TwoBranches { .. } => format!("give one of them another name than `{name}`"),
        })
    }
    related(m) {
        let other = match &m.reason {
            Unbound::Path { end, .. } => Some(Related::new("this path goes on without it", *end)),
            Unbound::NoElse(condition) => Some(Related::new("this may not hold", *condition)),
            Unbound::TwoBranches { second } => Some(Related::new("and here", *second)),
            Unbound::Handler
            | Unbound::OtherPath
            | Unbound::Cleanup
            | Unbound::Loop
            | Unbound::Reaction
            | Unbound::Caught
            | Unbound::Beside => None,
        };
        std::iter::once(Related::new("bound here", m.bound)).chain(other).collect()
    }

    /// Use of a name that two paths bind to values of different types.
    TwoTypes("M0217", Error) { name: SmolStr, types: [SmolStr; 2], first: Span, second: Span }
    message(m) {
        let [one, other] = &m.types;
        format!("`{}` is {} on one path and {} on another", m.name, article(one), article(other))
    }
    help(m) { Some(format!("give one of them another name than `{}`", m.name)) }
    related(m) { vec![Related::new("bound here", m.first), Related::new("and here", m.second)] }

    /// Value of the wrong type.
    WrongType("M0301", Error) {
        expected: String, actual: String, place: String, example: Option<String>, instead: Option<String>,
    }
    message(m) { format!("{} takes {}, not {}", m.place, m.expected, m.actual) }
    help(m) {
        if let Some(instead) = &m.instead {
            return Some(format!("write {instead}"));
        }
        let such = m.example.as_ref().map(|example| format!(", such as {example}")).unwrap_or_default();
        Some(format!("write {} here{such}", m.expected))
    }

    /// Quantity without a unit, in text.
    MissingUnit("M0302", Error) {
        written: String, value: String, unit: &'static str, ty: String, others: String,
    }
    message(m) { format!("`{}` needs a unit: {} is expected", m.written, article(&m.ty)) }
    help(m) { Some(format!("write `{} {}`; the units are {}", m.value, m.unit, m.others)) }
    fix(m) { replace(m.span, &format!("{} {}", m.value, m.unit)) }

    /// Parameter without default or argument.
    MissingArgument("M0303", Error) { callee: SmolStr, param: SmolStr, ty: String }
    message(m) { format!("`{}` needs an argument for `{}`", m.callee, m.param) }
    help(m) { Some(format!("add `{}`: {}", m.param, m.ty)) }

    /// More arguments than parameters, or two for one parameter.
    TooManyArguments("M0304", Error) { callee: SmolStr, most: usize, twice: Option<SmolStr> }
    message(m) {
        match &m.twice {
            Some(param) => format!("`{}` of `{}` has two arguments", param, m.callee),
            None if m.most == 1 => format!("`{}` takes at most 1 argument", m.callee),
            None => format!("`{}` takes at most {} arguments", m.callee, m.most),
        }
    }
    help(_m) { Some("remove this argument".to_owned()) }

    /// Operands of different dimensions.
    WrongDimension("M0306", Error) { left: String, right: String, operator: &'static str }
    message(m) { format!("`{}` does not apply to {} and {}", m.operator, m.left, m.right) }
    help(m) {
        let is_text = m.operator == "+" && (m.left == "Text" || m.right == "Text");
        Some(if is_text {
            "write values in the braces of one text: `\"I see {count(cans)} cans\"`".to_owned()
        } else {
            "use the same dimension on both sides".to_owned()
        })
    }

    /// Unknown case of an enumeration.
    UnknownCase("M0307", Error) { name: SmolStr, of: String, near: Option<SmolStr>, known: String }
    message(m) { format!("{} has no case `{}`", m.of, m.name) }
    help(m) { did_you_mean(m.near.as_ref()).or_else(|| Some(format!("its cases are {}", m.known))) }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// Value in place of a condition, or the reverse.
    NotACondition("M0308", Error) { found: &'static str, wanted: &'static str }
    message(m) { format!("expected {}, found {}", m.wanted, m.found) }
    help(m) { Some(if m.wanted == "a condition" {
        let comparison = "a comparison such as `distance(user) < 0.5 m`";
        format!("a condition is a fluent such as `holding(mug)`, or {comparison}")
    } else {
        "a value is a literal, a name, a measure or a field".to_owned()
    }) }

    /// Deadline or count that is not constant.
    NotConstant("M0309", Error) { place: &'static str }
    message(m) { format!("{} must be a constant", m.place) }
    help(m) {
        let of_pose = m.place == POSE_NUMBER;
        let bounds = "so that the longest duration of the policy is known";
        let why = if of_pose { "with its unit" } else { bounds };
        Some(format!("write a number, {why}"))
    }

    /// Number outside of its valid range.
    OutOfRange("M0310", Error) {
        place: String, least: String, greatest: String, actual: String, meant: Option<(String, String)>,
    }
    message(m) { format!("{} is {}, but must be from {} to {}", m.place, m.actual, m.least, m.greatest) }
    help(m) {
        Some(match &m.meant {
            None => format!("write a number from {} to {}", m.least, m.greatest),
            Some((write, meant)) => format!("did you mean `{meant}`? write `{write}`"),
        })
    }
    fix(m) { m.meant.as_ref().and_then(|(write, _)| replace(m.span, write)) }

    /// `any` in place of one value.
    MisplacedAny("M0311", Error) { }
    message(_m) { "`any` is not allowed here".to_owned() }
    help(_m) {
        let place = "in the arguments of a fluent, where it stands for every entity";
        Some(format!("`any` is only allowed {place}"))
    }

    /// Parameter of a fluent that is neither an entity nor a case.
    FluentParameter("M0312", Error) { name: SmolStr, ty: String }
    message(m) { format!("a parameter of a fluent is an entity or a case, but `{}` is {}", m.name, m.ty) }
    help(_m) { Some("declare a `measure` for numbers".to_owned()) }

    /// Declaration that contradicts itself.
    BadDeclaration("M0313", Error) { what: String, remedy: String }
    message(m) { m.what.clone() }
    help(m) { Some(m.remedy.clone()) }

    /// Calculation with numbers that are written out, and without a finite result.
    ResultWithoutValue("M0321", Error) { is_division_by_zero: bool }
    message(m) {
        let says =
            if m.is_division_by_zero { "a division by zero has no value" } else { "the result is too large" };
        says.to_owned()
    }
    help(m) {
        let says = if m.is_division_by_zero { "divide by another number" } else { "use smaller numbers" };
        Some(says.to_owned())
    }

    /// Limit of the library that is exceeded, such as the parameters of a fluent.
    LimitExceeded("M0314", Error) { what: &'static str, limit: usize }
    message(m) { format!("more than {} {}", m.limit, m.what) }
    help(m) { Some(format!("at most {} {} are allowed", m.limit, m.what)) }

    /// Unknown fluent or measure under `observes`.
    UnknownObserved("M0406", Error) { name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("there is no fluent or measure `{}` to observe", m.name) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{near}`?"),
            None => {
                let decl = format!("fluent {}(what: Entity)", m.name);
                format!("declare it in primitives.motet, such as `{decl}`, or remove it")
            }
        })
    }

    /// Unknown primitive in a card.
    UnknownProvided("M0407", Error) { name: SmolStr, near: Option<SmolStr>, is_policy: bool }
    message(m) {
        if m.is_policy {
            format!("`{}` is a policy, not a primitive", m.name)
        } else {
            format!("no primitive `{}` is declared", m.name)
        }
    }
    help(m) {
        Some(match &m.near {
            _ if m.is_policy => "remove it: a robot has every policy whose primitives it provides".to_owned(),
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("declare it in primitives.motet, `action {}()`, or remove it", m.name),
        })
    }

    /// Bounds of an unknown parameter in a card.
    UnknownBound("M0408", Error) { primitive: SmolStr, param: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("`{}` has no parameter `{}`", m.primitive, m.param) }
    help(m) {
        Some(match &m.near {
            Some(near) => format!("did you mean `{near}`?"),
            None if m.known.is_empty() => format!("it has no parameters: write `{} = {{}}`", m.primitive),
            None => format!("its parameters are {}", m.known),
        })
    }

    /// Bounds of a parameter in the wrong unit, or of one that is no number. `unit` is the SI symbol of the
    /// parameter's quantity, empty for plain numbers; `None` if the parameter is no number.
    WrongBound("M0409", Error) { primitive: SmolStr, param: SmolStr, ty: String, unit: Option<&'static str> }
    message(m) {
        let typed = format!("`{}` of `{}` has the type {}", m.param, m.primitive, m.ty);
        match m.unit {
            Some(_) => format!("{typed}, but its bounds have another unit"),
            None => format!("{typed}, but only numbers have bounds"),
        }
    }
    help(m) {
        Some(match m.unit {
            None => format!("write `{} = {{}}`", m.primitive),
            Some("") => "write both bounds without a unit".to_owned(),
            Some(unit) => {
                let bounds = format!("{{ least = \"0 {unit}\", greatest = \"1 {unit}\" }}");
                format!("write both bounds in {unit}, such as `{bounds}`")
            }
        })
    }

    /// Provided primitive whose declaration needs something that the robot lacks.
    UnfitPrimitive("M0410", Error) { name: SmolStr, why: String, at: Span }
    message(m) { format!("this robot cannot provide `{}` as declared: {}", m.name, m.why) }
    help(m) {
        let redeclare = format!("declare `{}` again in primitives.motet", m.name);
        Some(format!("add the missing part to the card, {redeclare}, or remove `{}`", m.name))
    }
    related(m) { vec![Related::new("declared here", m.at)] }

    /// Entry under `initially` of a card that is no fact.
    NotAtFirst("M0446", Error) { text: String, why: String, remedy: Option<String> }
    message(m) { format!("`{}` is not a fact: {}", m.text, m.why) }
    help(m) {
        let such = "such as \"not standing(robot)\"";
        let usual = || format!("write a fluent with its arguments, perhaps under one `not`, {such}");
        Some(m.remedy.clone().unwrap_or_else(usual))
    }
}

impl UnknownFluent {
    /// Diagnostic for a name that is none of the known ones; `wanted` says what they are.
    pub(crate) fn new<'n>(
        name: &Name,
        wanted: &'static str,
        known: impl Iterator<Item = &'n SmolStr> + Clone,
    ) -> Self {
        let near = near(&name.text, known.clone().map(SmolStr::as_str));
        Self { span: name.span, name: name.text.clone(), near, wanted, known: list(known.cloned()) }
    }
}
