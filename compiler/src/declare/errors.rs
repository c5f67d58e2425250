//! Names that mean nothing (M02xx) and values of the wrong type (M03xx).

use motet_syntax::ast::Name;
use motet_syntax::{About, Edit, Fix, Related, Span};
use smol_str::SmolStr;

use super::suggestion::{article, list, near};

pub(crate) fn replace(span: Span, text: &str) -> Option<Fix> {
    Some(Fix { title: format!("write `{text}`"), edits: vec![Edit { span, text: text.to_owned() }] })
}

pub(crate) fn did_you_mean(near: Option<&SmolStr>) -> Option<String> {
    near.map(|near| format!("did you mean `{near}`?"))
}

motet_syntax::mistakes! {
    pub(crate) const CODES;

    /// A name that is no binding, parameter, entity, case or resource.
    UnknownName("M0202", Error) {
        name: SmolStr, near: Option<SmolStr>, wanted: String, known: String, scene: bool, about: Option<About>,
        call: Option<String>,
    }
    message(m) {
        if m.wanted.is_empty() {
            format!("nothing here is called `{}`", m.name)
        } else {
            format!("there is no {} `{}`", m.wanted, m.name)
        }
    }
    help(m) {
        let is_itself = m.near.as_ref().and_then(|near| near.strip_prefix('$')) == Some(m.name.as_str());
        if is_itself {
            return Some(format!("`{0}` is bound before: write `${0}`", m.name));
        }
        if let Some(call) = &m.call {
            return Some(format!("write `{call}`"));
        }
        did_you_mean(m.near.as_ref()).or_else(|| {
            if !m.scene {
                Some("no scene is given: entities come from `--scene`, or from `entity` in a domain".to_owned())
            } else {
                (!m.known.is_empty()).then(|| format!("there is {}", m.known))
            }
        })
    }
    fix(m) { m.near.as_ref().filter(|_| m.call.is_none()).and_then(|near| replace(m.span, near)) }
    about(m) { m.about.clone() }

    /// `$x` where nothing of that name is bound.
    UnknownBinding("M0203", Error) { name: SmolStr, near: Option<SmolStr>, is_text: bool }
    message(m) { format!("nothing is bound to `{}` here", m.name) }
    help(m) {
        Some(match &m.near {
            Some(near) if *near == m.name => format!("`{}` is an entity: write it without `$`", m.name),
            Some(near) => format!("did you mean `${near}`?"),
            None if m.is_text => format!("a text that begins with `$` is written with two: `$${}`", m.name),
            None => "a binding is visible from its step to the end of the block it stands in".to_owned(),
        })
    }
    fix(m) {
        let near = m.near.as_ref()?;
        let sigil = if *near == m.name { "" } else { "$" };
        Some(Fix { title: format!("write `{sigil}{near}`"), edits: vec![Edit { span: m.span, text: near.to_string() }] })
    }

    /// An argument for a parameter that does not exist.
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

    /// Two declarations of one file bear the same name.
    Duplicate("M0205", Error) { name: SmolStr, what: &'static str, first: Span }
    message(m) { format!("the {} `{}` is declared twice", m.what, m.name) }
    help(m) { Some(format!("give one of them another name than `{}`", m.name)) }
    related(m) { vec![Related::new("first declared here", m.first)] }

    /// A condition names a fluent that does not exist.
    UnknownFluent("M0208", Error) { name: SmolStr, near: Option<SmolStr>, wanted: &'static str, known: String }
    message(m) { format!("there is no {} `{}`", m.wanted, m.name) }
    help(m) { did_you_mean(m.near.as_ref()).or_else(|| Some(format!("what is known here is {}", m.known))) }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// A type that does not exist.
    UnknownType("M0209", Error) { name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("there is no type `{}`", m.name) }
    help(m) { did_you_mean(m.near.as_ref()) }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// A failure kind that does not exist.
    UnknownFailure("M0210", Error) { name: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("there is no failure `{}`", m.name) }
    help(m) { did_you_mean(m.near.as_ref()).or_else(|| Some(format!("the failures are {}", m.known))) }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// A field that the entity's kind does not have.
    UnknownField("M0211", Error) { name: SmolStr, of: String, near: Option<SmolStr>, known: String, owners: String }
    message(m) { format!("{} has no field `{}`", m.of, m.name) }
    help(m) {
        did_you_mean(m.near.as_ref()).or_else(|| {
            let own = if m.known.is_empty() { format!("{} has none", m.of) } else { format!("its fields are {}", m.known) };
            Some(if m.owners.is_empty() { own } else { format!("it is a field of {}; {own}", m.owners) })
        })
    }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// A parameter with a name that the JSON form needs for itself.
    ReservedName("M0213", Error) { name: SmolStr }
    message(m) { format!("`{}` is a key of the JSON form and cannot name a parameter", m.name) }
    help(_m) { Some("choose another name".to_owned()) }

    /// A motion that is not one of the closed set.
    UnknownMotion("M0214", Error) { name: SmolStr, near: Option<SmolStr> }
    message(m) { format!("there is no motion `{}`", m.name) }
    help(m) {
        did_you_mean(m.near.as_ref()).or_else(|| {
            Some("the motions are `go_to`, `reach`, `put`, `pull`, `push`, `offer`, `look` and `posture`".to_owned())
        })
    }

    /// `uses` or `lasts` names what is no resource of the robot.
    UnknownResource("M0215", Error) { name: SmolStr, near: Option<SmolStr>, known: String }
    message(m) { format!("there is no resource `{}`", m.name) }
    help(m) { did_you_mean(m.near.as_ref()).or_else(|| Some(format!("the robot has {}", m.known))) }

    /// A value of one type where another is asked for.
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

    /// A quantity without a unit, in text.
    MissingUnit("M0302", Error) {
        written: String, value: String, unit: &'static str, ty: String, others: String,
    }
    message(m) { format!("`{}` needs a unit: {} is asked for", m.written, article(&m.ty)) }
    help(m) { Some(format!("write `{} {}`; the units are {}", m.value, m.unit, m.others)) }
    fix(m) { replace(m.span, &format!("{} {}", m.value, m.unit)) }

    /// A parameter without default gets no argument.
    MissingArgument("M0303", Error) { callee: SmolStr, param: SmolStr, ty: String }
    message(m) { format!("`{}` needs an argument for `{}`", m.callee, m.param) }
    help(m) { Some(format!("add `{}`: {}", m.param, m.ty)) }

    /// More arguments than parameters, or two for one parameter.
    TooManyArguments("M0304", Error) { callee: SmolStr, most: usize, twice: Option<SmolStr> }
    message(m) {
        match &m.twice {
            Some(param) => format!("`{}` is given twice to `{}`", param, m.callee),
            None => format!("`{}` takes at most {} argument{}", m.callee, m.most, if m.most == 1 { "" } else { "s" }),
        }
    }
    help(_m) { Some("leave this one out".to_owned()) }

    /// Two sides that cannot be compared or computed with.
    WrongDimension("M0306", Error) { left: String, right: String, operator: &'static str }
    message(m) { format!("`{}` cannot join {} and {}", m.operator, m.left, m.right) }
    help(_m) { Some("both sides need the same dimension".to_owned()) }

    /// A case that the enumeration does not have.
    UnknownCase("M0307", Error) { name: SmolStr, of: String, near: Option<SmolStr>, known: String }
    message(m) { format!("{} has no case `{}`", m.of, m.name) }
    help(m) { did_you_mean(m.near.as_ref()).or_else(|| Some(format!("its cases are {}", m.known))) }
    fix(m) { m.near.as_ref().and_then(|near| replace(m.span, near)) }

    /// A value where a condition is asked for, or the other way round.
    NotACondition("M0308", Error) { found: &'static str, wanted: &'static str }
    message(m) { format!("{} is asked for, and this is {}", m.wanted, m.found) }
    help(m) { Some(if m.wanted == "a condition" {
        "a condition is a fluent such as `holding(mug)`, or a comparison such as `distance(user) < 0.5 m`".to_owned()
    } else {
        "a value is a literal, a name, a measure or a field".to_owned()
    }) }

    /// A deadline or a count that is not known beforehand.
    NotConstant("M0309", Error) { place: &'static str }
    message(m) { format!("{} must be known beforehand", m.place) }
    help(_m) { Some("write a number here: only so the longest duration of the policy is known".to_owned()) }

    /// A number outside what makes sense.
    OutOfRange("M0310", Error) {
        place: String, least: String, greatest: String, actual: String, meant: Option<(String, String)>,
    }
    message(m) { format!("{} is {}, and must be from {} to {}", m.place, m.actual, m.least, m.greatest) }
    help(m) {
        Some(match &m.meant {
            None => format!("write a number from {} to {}", m.least, m.greatest),
            Some((write, meant)) => format!("did you mean `{meant}`? write `{write}`"),
        })
    }
    fix(m) { m.meant.as_ref().and_then(|(write, _)| replace(m.span, write)) }

    /// `any` where one value is asked for.
    MisplacedAny("M0311", Error) { }
    message(_m) { "`any` cannot stand here".to_owned() }
    help(_m) { Some("`any` stands for every entity in the arguments of a fluent only".to_owned()) }

    /// A fluent about something that is neither an entity nor a case.
    FluentParameter("M0312", Error) { name: SmolStr, ty: String }
    message(m) { format!("a fluent is about entities and cases, and `{}` is {}", m.name, m.ty) }
    help(_m) { Some("use a `measure` for numbers".to_owned()) }

    /// A declaration that is wrong in itself.
    BadDeclaration("M0313", Error) { what: String, remedy: String }
    message(m) { m.what.clone() }
    help(m) { Some(m.remedy.clone()) }

    /// A fluent with too many parameters, a library with too many resources: a named limit.
    LimitExceeded("M0314", Error) { what: &'static str, limit: usize }
    message(m) { format!("more than {} {}", m.limit, m.what) }
    help(m) { Some(format!("at most {} {} are taken", m.limit, m.what)) }
}

impl UnknownFluent {
    /// What `wanted` says is none of the known names.
    pub(crate) fn new<'n>(
        name: &Name,
        wanted: &'static str,
        known: impl Iterator<Item = &'n SmolStr> + Clone,
    ) -> Self {
        let near = near(&name.text, known.clone().map(SmolStr::as_str));
        Self { span: name.span, name: name.text.clone(), near, wanted, known: list(known.cloned()) }
    }
}
