//! Completion: of what could stand at a place, that which passes the check there. The state of the check
//! before the step decides, as it does for the masks of constrained decoding.

use motet_compiler::Session;
use motet_compiler::incremental::{ArgumentValue, IncrementalChecker};
use motet_compiler::signature::{Callable, ParamSignature, Signatures, Type};
use motet_syntax::Source;
use motet_syntax::ast::ExprKind;
use motet_syntax::print::identifier;
use smol_str::SmolStr;

use super::context::{ArgumentPlace, WritingContext, WritingPlace, context};
use super::point::PointState;

/// Greatest number of calls that are tried for one primitive.
const MAX_TRIES: usize = 400;

/// Words with which a step begins.
const STEPS: [(&str, &str); 18] = [
    ("let", "let ${1:name} = $0"),
    ("sequence", "sequence ${1:name} {\n    $0\n}"),
    ("if", "if ${1:condition} {\n    $0\n}"),
    ("wait until", "wait until ${1:condition} within ${2:60 s}"),
    ("wait", "wait ${1:5 s}"),
    ("monitor", "monitor {\n    when ${1:condition} then ${2:pause}\n} during {\n    $0\n}"),
    ("try", "try {\n    $0\n} catch ${1:any} {\n}"),
    ("repeat", "repeat ${1:3} {\n    $0\n}"),
    ("each", "each ${1:item} in ${2:list} at most ${3:5} {\n    $0\n}"),
    ("parallel", "parallel {\n    { $1 }\n    { $2 }\n}"),
    ("within", "within ${1:30 s} {\n    $0\n}"),
    ("keep out of", "keep out of ${1:zone} {\n    $0\n}"),
    ("keep distance", "keep distance(${1:user}) >= ${2:1 m} {\n    $0\n}"),
    ("finally", "finally {\n    $0\n}"),
    ("done", "done"),
    ("fail", "fail \"$1\""),
    ("cannot", "cannot \"$1\""),
    ("replan", "replan \"$1\""),
];

/// Words with which a declaration, or a part of the head of a policy, begins.
const DECLARATIONS: [(&str, &str); 13] = [
    ("policy", "policy ${1:name} {\n    $0\n}"),
    ("achieves", "achieves $0"),
    ("for", "for $0"),
    ("keep out of", "keep out of $0"),
    ("action", "action ${1:name}($2)\n    $0"),
    ("perception", "perception ${1:name}($2) -> ${3:Type}\n    $0"),
    ("kind", "kind ${1:Name}: ${2:Object}"),
    ("fluent", "fluent ${1:name}($2)"),
    ("measure", "measure ${1:name}($2) -> ${3:Length}"),
    ("failure", "failure ${1:name}"),
    ("enum", "enum ${1:Name} { $2 }"),
    ("entity", "entity ${1:name}: ${2:Object}"),
    ("initially", "initially $0"),
];

/// Reactions of a monitor.
const REACTIONS: [(&str, &str); 7] = [
    ("pause", "pause"),
    ("restart", "restart at most ${1:3}"),
    ("resume", "resume at most ${1:3} {\n    $0\n}"),
    ("done", "done"),
    ("fail", "fail \"$1\""),
    ("cannot", "cannot \"$1\""),
    ("replan", "replan \"$1\""),
];

/// Something to write.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Suggestion {
    pub(crate) label: String,
    pub(crate) kind: SuggestionKind,
    pub(crate) detail: String,
    /// Text to insert; with places for the cursor where `is_snippet`.
    pub(crate) insert: String,
    pub(crate) is_snippet: bool,
}

/// Kind of a suggestion.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum SuggestionKind {
    Binding,
    Entity,
    Case,
    Callable,
    Relation,
    Label,
    Type,
    Failure,
    Robot,
    Keyword,
}

/// Suggestions for a place, the likeliest kind first, with the range that they replace.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct Completion {
    pub(crate) word: (usize, usize),
    pub(crate) suggestions: Vec<Suggestion>,
}

/// Completes the word at an offset of a document in the text syntax. Without a policy around it, or where the
/// text before it cannot be read, nothing is held back.
pub(crate) fn complete(session: &Session, source: &Source, offset: usize) -> Completion {
    let WritingContext { word, place, step } = context(&source.text, offset);
    let state = step.and_then(|(start, end)| PointState::at(session, source, start, end));
    let signatures = state.as_ref().map_or_else(|| session.signatures(), |state| state.session.signatures());
    let mut completer = Completer { session, signatures: &signatures, state, found: Vec::new() };
    match &place {
        WritingPlace::Nothing => {}
        WritingPlace::Declaration => completer.words(&DECLARATIONS),
        WritingPlace::Robot => completer.robots(),
        WritingPlace::Type => completer.types(),
        WritingPlace::Failure => completer.failures(),
        WritingPlace::Step => {
            completer.callables(|_| true);
            completer.words(&STEPS);
        }
        WritingPlace::Bound => {
            completer.callables(|callable| callable.result.is_some());
            completer.values(None, &mut |_, _| true);
        }
        WritingPlace::Reaction => completer.words(&REACTIONS),
        WritingPlace::Condition => {
            completer.relations();
            completer.values(None, &mut |_, _| true);
        }
        WritingPlace::Argument(argument) => completer.argument(argument),
    }
    Completion { word, suggestions: completer.found }
}

/// Collector of suggestions for one place.
pub(crate) struct Completer<'a> {
    pub(crate) session: &'a Session,
    pub(crate) signatures: &'a Signatures,
    /// State of the check there, if it is known.
    pub(crate) state: Option<PointState>,
    pub(crate) found: Vec<Suggestion>,
}

impl Completer<'_> {
    fn add(&mut self, kind: SuggestionKind, label: &str, detail: impl Into<String>) {
        let insert = identifier(label);
        self.found.push(Suggestion {
            label: label.to_owned(),
            kind,
            detail: detail.into(),
            insert,
            is_snippet: false,
        });
    }

    fn words(&mut self, words: &[(&str, &str)]) {
        let suggestions = words.iter().map(|(label, insert)| Suggestion {
            label: (*label).to_owned(),
            kind: SuggestionKind::Keyword,
            detail: String::new(),
            insert: (*insert).to_owned(),
            is_snippet: insert.contains('$'),
        });
        self.found.extend(suggestions);
    }

    pub(crate) fn robots(&mut self) {
        let own = &self.session.library().robot;
        let mut names: Vec<&str> = motet_project::robot_names().collect();
        if !own.is_empty() && !names.contains(&own.as_str()) {
            names.insert(0, own);
        }
        let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
        names.iter().for_each(|name| self.add(SuggestionKind::Robot, name, "robot"));
    }

    fn types(&mut self) {
        for name in
            ["Bool", "Int", "Number", "Text", "Pose", "Length", "Duration", "Mass", "Angle", "Failure"]
        {
            self.add(SuggestionKind::Type, name, "type");
        }
        let signatures = self.signatures;
        signatures.kinds.iter().for_each(|kind| self.add(SuggestionKind::Type, &kind.name, "kind"));
        signatures.enums.iter().for_each(|of| self.add(SuggestionKind::Type, &of.name, "enum"));
    }

    pub(crate) fn failures(&mut self) {
        let signatures = self.signatures;
        signatures.failures.iter().for_each(|name| self.add(SuggestionKind::Failure, name, "failure"));
        self.words(&[("any", "any")]);
    }

    pub(crate) fn relations(&mut self) {
        let signatures = self.signatures;
        let shown = |params: &[(SmolStr, Type)]| {
            let params = params.iter().map(|(name, ty)| format!("{name}: {}", signatures.type_name(ty)));
            params.collect::<Vec<_>>().join(", ")
        };
        let fluents = signatures.fluents.iter().filter(|fluent| fluent.is_observable);
        let fluents = fluents.map(|fluent| (&fluent.name, &fluent.params, "fluent".to_owned()));
        let measures = signatures.measures.iter().filter(|measure| measure.is_observable);
        let measures =
            measures.map(|measure| (&measure.name, &measure.params, signatures.type_name(&measure.result)));
        for (name, params, detail) in fluents.chain(measures) {
            self.found.push(Suggestion {
                label: name.to_string(),
                kind: SuggestionKind::Relation,
                detail: format!("({}) {detail}", shown(params)),
                insert: snippet(name, params.iter().map(|(name, _)| name)),
                is_snippet: true,
            });
        }
    }

    /// Callables of which some call passes here.
    pub(crate) fn callables(&mut self, is_wanted: impl Fn(&Callable) -> bool) {
        let signatures = self.signatures;
        for callable in signatures.callables.iter().filter(|callable| is_wanted(callable)) {
            if !self.some_call_passes(callable) {
                continue;
            }
            let params = callable.params.iter();
            let params = params.map(|param| format!("{}: {}", param.name, signatures.type_name(&param.ty)));
            let result = callable.result.as_ref().map(|ty| format!(" -> {}", signatures.type_name(ty)));
            let needed = callable.params.iter().filter(|param| param.default.is_none());
            self.found.push(Suggestion {
                label: callable.name.to_string(),
                kind: SuggestionKind::Callable,
                detail: format!("({}){}", params.collect::<Vec<_>>().join(", "), result.unwrap_or_default()),
                insert: snippet(&callable.name, needed.map(|param| &param.name)),
                is_snippet: true,
            });
        }
    }

    /// Returns false only if every choice of the arguments is refuted.
    fn some_call_passes(&mut self, callable: &Callable) -> bool {
        let choices: Vec<_> = callable.params.iter().map(|param| self.choices(param)).collect();
        let mut args = vec![None; callable.params.len()];
        self.permits(callable, &args)
            && self.some_choice_passes(callable, &choices, &mut args, &mut { MAX_TRIES })
    }

    /// Tries the choices for the first argument that is missing, each with those of the others. What is
    /// refuted with the others unknown is refuted with all of them. Returns true when it has tried enough.
    fn some_choice_passes(
        &mut self,
        callable: &Callable,
        choices: &[Vec<Option<ArgumentValue>>],
        args: &mut [Option<ArgumentValue>],
        tries: &mut usize,
    ) -> bool {
        let index = callable.params.len() - choices.len();
        let Some((first, rest)) = choices.split_first() else { return true };
        // Nothing to choose from is known here.
        if first.is_empty() {
            return true;
        }
        first.iter().any(|choice| {
            let Some(left) = tries.checked_sub(1) else { return true };
            *tries = left;
            if let Some(slot) = args.get_mut(index) {
                slot.clone_from(choice);
            }
            let passes = self.permits(callable, args) && self.some_choice_passes(callable, rest, args, tries);
            if let Some(slot) = args.get_mut(index) {
                *slot = None;
            }
            passes
        })
    }

    /// Values that a parameter can have here; one unknown value for a type without names.
    fn choices(&self, param: &ParamSignature) -> Vec<Option<ArgumentValue>> {
        if param.default.is_some() {
            return vec![self.default(param)];
        }
        let Type::Entity(kind) = param.ty else { return vec![None] };
        let mut choices: Vec<Option<ArgumentValue>> = Vec::new();
        for (index, (_, of)) in self.signatures.entities.iter().enumerate() {
            if self.signatures.is_kind(*of, kind) {
                choices.extend(u16::try_from(index).ok().map(|index| Some(ArgumentValue::entity(index))));
            }
        }
        let bound = self.state.iter().flat_map(|state| state.checker.visible());
        let fitting = bound.filter(|name| self.binding_fits(name, &param.ty));
        choices.extend(fitting.filter_map(|name| self.state.as_ref()?.checker.binding(name)).map(Some));
        choices
    }

    fn default(&self, param: &ParamSignature) -> Option<ArgumentValue> {
        match &param.default.as_ref()?.kind {
            ExprKind::Name(name) => self.value(name),
            ExprKind::Number(number) => Some(ArgumentValue::number(*number)),
            _ => Some(ArgumentValue::unknown()),
        }
    }

    /// Value of a name that is written as an argument.
    fn value(&self, written: &str) -> Option<ArgumentValue> {
        let name = written.trim_matches('`').trim_start_matches('$');
        if let Some(bound) = self.state.as_ref().and_then(|state| state.checker.binding(name)) {
            return Some(bound);
        }
        let entity = self.signatures.entities.iter().position(|(known, _)| known == name);
        if let Some(index) = entity.and_then(|index| u16::try_from(index).ok()) {
            return Some(ArgumentValue::entity(index));
        }
        self.signatures.enums.iter().zip(0_u16..).find_map(|(of, index)| {
            let case = of.cases.iter().position(|case| case == name)?;
            Some(ArgumentValue::case(index, u16::try_from(case).ok()?))
        })
    }

    /// Returns whether a call passes here, as far as its arguments are known.
    fn permits(&mut self, callable: &Callable, args: &[Option<ArgumentValue>]) -> bool {
        let Some(PointState { session, checker }) = &mut self.state else { return true };
        if callable.is_policy {
            return checker.permits_policy(session, (callable.name.as_str(), None), args);
        }
        let Some(primitive) = IncrementalChecker::primitive(session, &callable.name) else { return true };
        checker.permits_call(session, primitive, args)
    }

    pub(crate) fn argument(&mut self, place: &ArgumentPlace) {
        let signatures = self.signatures;
        if let Some(callable) = signatures.callable(&place.callee) {
            return self.argument_of(callable, place);
        }
        let fluent = signatures.fluent(&place.callee).map(|fluent| &fluent.params);
        let measure = || signatures.measure(&place.callee).map(|measure| &measure.params);
        let ty = fluent.or_else(measure).and_then(|params| params.get(place.index)).map(|(_, ty)| ty.clone());
        self.values(ty.as_ref(), &mut |_, _| true);
        self.words(&[("any", "any")]);
    }

    fn argument_of(&mut self, callable: &Callable, place: &ArgumentPlace) {
        let index = match &place.label {
            Some(label) => callable.params.iter().position(|param| param.name == *label),
            None => Some(place.index).filter(|index| *index < callable.params.len()),
        };
        let mut args: Vec<Option<ArgumentValue>> = vec![None; callable.params.len()];
        let mut position = 0;
        for (label, written) in &place.others {
            if position == place.index && place.label.is_none() {
                position += 1;
            }
            let at = match label {
                Some(label) => callable.params.iter().position(|param| param.name == *label),
                None => Some(position),
            };
            position += 1;
            if let Some(slot) = at.and_then(|at| args.get_mut(at)) {
                *slot = Some(self.value(written).unwrap_or_else(ArgumentValue::unknown));
            }
        }
        for (slot, param) in args.iter_mut().zip(&callable.params) {
            if slot.is_none() && param.default.is_some() {
                *slot = self.default(param);
            }
        }
        if let Some(index) = index
            && let Some(param) = callable.params.get(index)
        {
            // An earlier argument that is refuted is no fault of this one.
            let may_pass = self.permits(callable, &args);
            self.values(Some(&param.ty), &mut |completer, value| {
                if !may_pass {
                    return true;
                }
                let mut args = args.clone();
                if let Some(slot) = args.get_mut(index) {
                    *slot = Some(value);
                }
                completer.permits(callable, &args)
            });
        }
        if place.label.is_none() && place.index > 0 {
            let others = place.others.iter().filter_map(|(label, _)| label.as_ref());
            let others: Vec<&SmolStr> = others.collect();
            let rest =
                callable.params.iter().skip(place.index).filter(|param| !others.contains(&&param.name));
            for param in rest {
                let detail = self.signatures.type_name(&param.ty);
                self.found.push(Suggestion {
                    label: format!("{}:", param.name),
                    kind: SuggestionKind::Label,
                    detail,
                    insert: format!("{}: ", param.name),
                    is_snippet: false,
                });
            }
        }
    }

    /// Bindings, entities and cases of a type, or of any, that pass a test.
    pub(crate) fn values(
        &mut self,
        ty: Option<&Type>,
        passes: &mut dyn FnMut(&mut Self, ArgumentValue) -> bool,
    ) {
        let signatures = self.signatures;
        let bound: Vec<SmolStr> =
            self.state.iter().flat_map(|state| state.checker.visible()).cloned().collect();
        for name in bound {
            let fits = ty.is_none_or(|ty| self.binding_fits(&name, ty));
            let value = self.state.as_ref().and_then(|state| state.checker.binding(&name));
            if fits && value.is_none_or(|value| passes(self, value)) {
                self.add(SuggestionKind::Binding, &name, "binding");
            }
        }
        let kind = match ty {
            None => Some(0),
            Some(Type::Entity(kind)) => Some(*kind),
            Some(Type::List(inner)) => match **inner {
                Type::Entity(kind) => Some(kind),
                _ => None,
            },
            Some(_) => None,
        };
        for (index, (name, of)) in signatures.entities.iter().enumerate() {
            let fits = kind.is_some_and(|kind| signatures.is_kind(*of, kind));
            let Some(index) = u16::try_from(index).ok().filter(|_| fits) else { continue };
            if passes(self, ArgumentValue::entity(index)) {
                let detail = signatures.kinds.get(*of).map_or("", |kind| kind.name.as_str());
                self.add(SuggestionKind::Entity, name, detail);
            }
        }
        match ty {
            Some(Type::Enum(id)) => {
                let Some(of) = signatures.enums.get(*id) else { return };
                for (case, name) in (0_u16..).zip(&of.cases) {
                    let Ok(of_index) = u16::try_from(*id) else { continue };
                    if passes(self, ArgumentValue::case(of_index, case)) {
                        self.add(SuggestionKind::Case, name, of.name.as_str());
                    }
                }
            }
            Some(Type::Bool) => self.words(&[("true", "true"), ("false", "false")]),
            _ => {}
        }
    }

    fn binding_fits(&self, name: &str, ty: &Type) -> bool {
        let Some(state) = &self.state else { return true };
        match (ty, state.checker.binding_type(name)) {
            (_, None) => true,
            (wanted, Some(found)) => self.signatures.fits(wanted, &found),
        }
    }
}

/// Call with places for its arguments.
fn snippet<'a>(name: &str, params: impl Iterator<Item = &'a SmolStr>) -> String {
    let params: Vec<String> =
        params.enumerate().map(|(index, param)| format!("${{{}:{param}}}", index + 1)).collect();
    format!("{}({})", identifier(name), params.join(", "))
}

#[cfg(test)]
mod tests {
    use motet_project::{Discard, Project, ProjectSession};
    use motet_syntax::Source;

    fn project() -> ProjectSession {
        let project = Project::builder().robot("hsr").scene("kitchen").without_motions();
        project.open().unwrap().into_session(&mut Discard).unwrap()
    }

    fn check(text: &str, has: &[&str], lacks: &[&str]) {
        let offset = text.find('|').unwrap();
        let text = text.replacen('|', "", 1);
        let found = super::complete(&project().session, &Source::new("p.motet", text.as_str()), offset);
        let labels: Vec<&str> = found.suggestions.iter().map(|one| one.label.as_str()).collect();
        for label in has {
            assert!(labels.contains(label), "{label} is not in {labels:?} of {text}");
        }
        for label in lacks {
            assert!(!labels.contains(label), "{label} is in {labels:?} of {text}");
        }
    }

    #[test]
    fn complete_offers_only_what_passes() {
        check("policy p for hsr {\n    |\n}", &["go", "detect", "if"], &["handover", "place"]);
        check(
            "policy p for hsr {\n    go(kitchen_table)\n    pick(mug_1)\n    |\n}",
            &["place"],
            &["pick", "handover"],
        );
        check(
            "policy p for hsr {\n    go(kitchen_table)\n    pick(|)\n}",
            &["mug_1"],
            &["mug_2", "user", "kitchen_table"],
        );
        check(
            "policy p for hsr {\n    go(kitchen_table)\n    let m = detect(\"red mug\")\n    pick(|)\n}",
            &["m", "mug_1"],
            &[],
        );
        check(
            "policy p for hsr {\n    go(kitchen_table)\n    pick(mug_1)\n    go(user)\n    \
             handover(mug_1, |)\n}",
            &["user"],
            &["mug_2"],
        );
    }

    #[test]
    fn complete_offers_names_of_their_kind() {
        check("policy p for |", &["hsr", "panda"], &["mug_1"]);
        check("policy p {\n    if |\n}", &["holding", "distance", "mug_1"], &["go"]);
        check("policy p {\n    try { go(user) } catch |\n}", &["timeout", "any"], &["go", "user"]);
        check("policy p {\n    let x = |\n}", &["detect", "ask"], &["say"]);
        check("policy p {\n    go(user)\n    pick(mug_1, |)\n}", &["from:"], &["object:"]);
        check("policy p {\n    pick(mug_1, from: |)\n}", &["top", "side"], &["mug_1"]);
        check("policy p(x: |) {}", &["Object", "Length"], &["mug_1"]);
        check("policy p { say(\"|\") }", &[], &["go", "mug_1"]);
    }
}
