//! The JSON form of the model subset as a tree of shapes, of which the JSON Schema and the grammars are printed.

use smol_str::SmolStr;

use super::offer::{Atom, CallOffer, Offer, SECONDS, is_ordered};
use super::value_set::ValueSet;
use crate::subset::{
    MAX_CONDITION_DEPTH, MAX_COUNT, MAX_ITEMS, MAX_MEMBERS, MAX_RETRIES, MAX_STEPS, Modifiers, NumberRange,
    Relation,
};

/// What a JSON value may be.
#[derive(Clone, PartialEq, Debug)]
pub enum Shape {
    /// What a definition says.
    Ref(usize),
    /// An object with exactly these keys in this order.
    Object(Vec<(SmolStr, Shape)>),
    /// An array of so many.
    Array(Box<Shape>, usize, usize),
    /// One of several. Objects among them differ in their first key, or in the one word that it has.
    Choice(Vec<Shape>),
    /// What a JSON Schema can say of it, and what it is exactly.
    Loose(Box<Shape>, Box<Shape>),
    /// One of these strings.
    WordList(Vec<SmolStr>),
    /// A name that the policy gives.
    Name,
    /// A name that it uses, with its `$`.
    Binding,
    /// A text.
    Text,
    /// A number.
    Number(NumberRange),
    /// `true` or `false`
    Bool,
    /// `1`, the version of the format.
    Version,
    /// `null`
    Null,
}

/// Definitions, and the document, which is the last of them. A definition refers only to those before it.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Shapes {
    /// Names and shapes.
    pub defs: Vec<(String, Shape)>,
}

impl Shapes {
    /// The shapes of an offer.
    #[must_use]
    pub fn new(offer: &Offer) -> Self {
        let mut builder = Builder { offer, shapes: Self::default(), slots: Vec::new() };
        builder.document();
        builder.shapes
    }
}

struct Builder<'o> {
    offer: &'o Offer,
    shapes: Shapes,
    /// The definition of each place of a value.
    slots: Vec<Shape>,
}

fn word(text: &str) -> Shape {
    Shape::WordList(vec![text.into()])
}

fn object<const N: usize>(keys: [(&str, Shape); N]) -> Shape {
    Shape::Object(keys.into_iter().map(|(key, shape)| (key.into(), shape)).collect())
}

fn or_null(mut shapes: Vec<Shape>) -> Shape {
    shapes.push(Shape::Null);
    Shape::Choice(shapes)
}

fn one_of(mut shapes: Vec<Shape>) -> Shape {
    match (shapes.len(), shapes.pop()) {
        (1, Some(only)) => only,
        (_, last) => {
            shapes.extend(last);
            Shape::Choice(shapes)
        }
    }
}

impl Builder<'_> {
    fn define(&mut self, name: String, shape: Shape) -> Shape {
        self.shapes.defs.push((name, shape));
        Shape::Ref(self.shapes.defs.len() - 1)
    }

    /// The same, where what stands in several places has one definition: a schema is compiled faster by far, the less it
    /// repeats.
    fn share(&mut self, name: &str, shape: Shape) -> Shape {
        match self.shapes.defs.iter().position(|(_, known)| *known == shape) {
            Some(known) => Shape::Ref(known),
            None => self.define(name.to_owned(), shape),
        }
    }

    /// Seconds, or `null` for the default.
    fn seconds(&mut self) -> Shape {
        self.share("seconds", or_null(vec![Shape::Number(SECONDS)]))
    }

    fn document(&mut self) {
        let name = self.define("name".into(), Shape::Name);
        let binding = self.define("binding".into(), Shape::Binding);
        let text = self.define("text".into(), Shape::Text);
        for slot in &self.offer.slots {
            let shape = self.value(slot, &binding, &text);
            let shape = match shape {
                // What is short, or shared already, needs no definition of its own.
                Shape::Ref(_) | Shape::Number(_) | Shape::Bool => shape,
                shape => self.define(slot.name.clone(), shape),
            };
            self.slots.push(shape);
        }
        let offer = self.offer;
        let goals = self.conditions("goal", &offer.goals);
        let asked = self.conditions("condition", &offer.asked);
        let step = self.steps(&name, &binding, asked);
        let mut keys = vec![(SmolStr::new_static("motet"), Shape::Version), ("policy".into(), name)];
        keys.extend(self.offer.robot.as_ref().map(|robot| ("robot".into(), word(robot))));
        keys.push(("achieves".into(), goals.map_or(Shape::Null, |goals| or_null(vec![goals]))));
        keys.push(("steps".into(), Shape::Array(Box::new(step), 1, MAX_STEPS)));
        self.define("root".into(), Shape::Object(keys));
    }

    fn value(&self, slot: &ValueSet, binding: &Shape, text: &Shape) -> Shape {
        let mut words = slot.names.clone();
        words.extend(slot.any.then(|| SmolStr::new_static("any")));
        let mut shapes = Vec::new();
        if !words.is_empty() {
            shapes.push(Shape::WordList(words));
        }
        shapes.extend(slot.number.map(Shape::Number));
        shapes.extend(slot.bool.then_some(Shape::Bool));
        shapes.extend(slot.text.then(|| text.clone()));
        shapes.extend(slot.binding.then(|| binding.clone()));
        // The place of the items comes before that of the list.
        let items = slot.items.and_then(|items| self.slots.get(items).cloned());
        shapes.extend(items.map(|items| Shape::Array(Box::new(items), 1, MAX_ITEMS)));
        one_of(shapes)
    }

    fn slot(&self, id: usize) -> Shape {
        self.slots.get(id).cloned().unwrap_or(Shape::Null)
    }

    fn args(&self, args: &[(SmolStr, usize)]) -> impl Iterator<Item = (SmolStr, Shape)> {
        args.iter().map(|(name, slot)| (name.clone(), self.slot(*slot)))
    }

    /// Conditions that stand in one another as deep as the subset allows; none where there is nothing to ask for.
    fn conditions(&mut self, name: &str, atoms: &[Atom]) -> Option<Shape> {
        let mut shapes = Vec::new();
        for atom in atoms {
            let (atom_name, shape) = self.atom(atom);
            shapes.push(self.define(format!("{name}_{atom_name}"), shape));
        }
        if shapes.is_empty() {
            return None;
        }
        let mut level = self.define(format!("{name}_0"), Shape::Choice(shapes.clone()));
        for depth in 1..=MAX_CONDITION_DEPTH {
            let several = Shape::Array(Box::new(level.clone()), 2, MAX_MEMBERS);
            let several = self.share(&format!("{name}s_{depth}"), several);
            let groups =
                [object([("not", level)]), object([("all", several.clone())]), object([("any", several)])];
            let all = shapes.iter().cloned().chain(groups).collect();
            level = self.define(format!("{name}_{depth}"), Shape::Choice(all));
        }
        Some(level)
    }

    fn atom(&self, atom: &Atom) -> (String, Shape) {
        match atom {
            Atom::Fluent(name, args) => {
                let keys = std::iter::once(("is".into(), word(name))).chain(self.args(args));
                (format!("is_{name}"), Shape::Object(keys.collect()))
            }
            Atom::Measure(name, args, than) => {
                let keys = std::iter::once(("get".into(), word(name))).chain(self.args(args));
                (format!("get_{name}"), Shape::Object(keys.chain(self.compared(*than)).collect()))
            }
            Atom::Field(name, of, than) => {
                let keys = [("field".into(), word(name)), ("of".into(), self.slot(*of))].into_iter();
                (format!("field_{name}"), Shape::Object(keys.chain(self.compared(*than)).collect()))
            }
        }
    }

    fn compared(&self, than: usize) -> [(SmolStr, Shape); 2] {
        let relations: &[Relation] =
            if is_ordered(self.offer.slot(than)) { &Relation::ALL } else { &Relation::EQUALITY };
        let words = relations.iter().map(|relation| relation.word().into()).collect();
        [("is".into(), Shape::WordList(words)), ("than".into(), self.slot(than))]
    }

    /// Steps with blocks that stand in one another as deep as the subset allows.
    fn steps(&mut self, name: &Shape, binding: &Shape, asked: Option<Shape>) -> Shape {
        let written = self.offer.subset.modifiers == Modifiers::Written;
        let mut leaves = Vec::new();
        for call in &self.offer.calls {
            let shape = self.call(call, name);
            leaves.push(self.define(format!("do_{}", call.name), shape));
        }
        if let Some(asked) = &asked {
            let mut keys = vec![(SmolStr::new_static("wait"), asked.clone())];
            keys.extend(written.then(|| ("within".into(), self.seconds())));
            leaves.push(self.define("wait".into(), Shape::Object(keys)));
        }
        let ends = self.ends();
        leaves.extend(ends.clone());
        let kinds = self.kinds();
        let list = self.list(binding);
        let count = self.share("count", Shape::Number(NumberRange::whole(1, MAX_COUNT)));
        let mut reacts = vec![
            self.pause(written),
            self.define("restart".into(), object([("react", word("restart")), ("at_most", count)])),
        ];
        reacts.extend(ends);
        let mut step = self.define("step_0".into(), Shape::Choice(leaves.clone()));
        for depth in 1..=self.offer.subset.depth {
            let blocks = Blocks { step, name, kinds: &kinds, list: list.as_ref(), asked: asked.as_ref() };
            let mut all = leaves.clone();
            all.extend(self.composites(depth, &blocks, &reacts));
            step = self.define(format!("step_{depth}"), Shape::Choice(all));
        }
        step
    }

    fn call(&mut self, call: &CallOffer, name: &Shape) -> Shape {
        let mut keys = vec![(SmolStr::new_static("do"), word(&call.name))];
        keys.extend(self.args(&call.args));
        if call.modifiers {
            keys.push(("within".into(), self.seconds()));
            let retries = or_null(vec![Shape::Number(NumberRange::whole(0, MAX_RETRIES))]);
            keys.push(("retry".into(), self.share("retries", retries)));
        }
        keys.extend(call.binds.then(|| ("as".into(), name.clone())));
        Shape::Object(keys)
    }

    fn ends(&mut self) -> Vec<Shape> {
        let why = self.slot(self.offer.why);
        let ending = |kind: &str| object([("end", word(kind)), ("why", why.clone())]);
        let ends = [
            ("done", object([("end", word("done"))])),
            ("fail", ending("fail")),
            ("replan", ending("replan")),
        ];
        ends.into_iter().map(|(name, shape)| self.define(name.into(), shape)).collect()
    }

    /// The kinds of failure of a handler: `any` alone, or some. In a schema, whose alternatives would begin alike, `any` may
    /// have others beside it, which says the same.
    fn kinds(&mut self) -> Shape {
        let any = SmolStr::new_static("any");
        let several = |words: Vec<SmolStr>| Shape::Array(Box::new(Shape::WordList(words)), 1, MAX_MEMBERS);
        let failures = self.offer.failures.clone();
        let alone = Shape::Array(Box::new(Shape::WordList(vec![any.clone()])), 1, 1);
        let exact = Shape::Choice(vec![alone, several(failures.clone())]);
        let loose = several(failures.into_iter().chain([any]).collect());
        self.define("kinds".into(), Shape::Loose(Box::new(loose), Box::new(exact)))
    }

    fn list(&mut self, binding: &Shape) -> Option<Shape> {
        let mut lists: Vec<Shape> = self.offer.binds_lists.then(|| binding.clone()).into_iter().collect();
        for names in &self.offer.lists {
            let names: Vec<_> = names.iter().filter(|name| *name != "any").cloned().collect();
            lists.push(Shape::Array(Box::new(Shape::WordList(names)), 1, MAX_ITEMS));
        }
        if lists.is_empty() { None } else { Some(self.define("list".into(), one_of(lists))) }
    }

    fn pause(&mut self, written: bool) -> Shape {
        let mut keys = vec![(SmolStr::new_static("react"), word("pause"))];
        keys.extend(written.then(|| ("within".into(), self.seconds())));
        self.define("pause".into(), Shape::Object(keys))
    }

    fn composites(&mut self, depth: usize, parts: &Blocks<'_>, reacts: &[Shape]) -> Vec<Shape> {
        let of_level = |name: &str| format!("{name}_{depth}");
        let steps = |least: usize| Shape::Array(Box::new(parts.step.clone()), least, MAX_STEPS);
        let several = |shape: Shape, least: usize| Shape::Array(Box::new(shape), least, MAX_MEMBERS);
        let block = self.share(&of_level("block"), steps(1));
        let maybe = self.share(&of_level("maybe_block"), steps(0));
        let count = self.share("count", Shape::Number(NumberRange::whole(1, MAX_COUNT)));
        let handlers = object([("on", parts.kinds.clone()), ("steps", maybe.clone())]);
        let handlers = several(handlers, 1);
        let branches = several(block.clone(), 2);
        let mut until = Shape::Null;
        let mut found =
            vec![("sequence", object([("sequence", parts.name.clone()), ("steps", block.clone())]))];
        if let Some(asked) = parts.asked {
            until = self.share("until", or_null(vec![asked.clone()]));
            let keys = [("if", asked.clone()), ("then", block.clone()), ("else", maybe)];
            found.push(("if", object(keys)));
            let resume = [("react", word("resume")), ("at_most", count.clone()), ("steps", block.clone())];
            let reaction = Shape::Choice(reacts.iter().cloned().chain([object(resume)]).collect());
            let when = object([("when", asked.clone()), ("for", self.seconds()), ("then", reaction)]);
            found.push(("monitor", object([("monitor", several(when, 1)), ("during", block.clone())])));
        }
        found.push(("try", object([("try", block.clone()), ("catch", handlers)])));
        found.push((
            "repeat",
            object([("repeat", count.clone()), ("steps", block.clone()), ("until", until)]),
        ));
        if let Some(list) = parts.list {
            let keys =
                [("each", parts.name.clone()), ("in", list.clone()), ("at_most", count), ("steps", block)];
            found.push(("each", object(keys)));
        }
        found.push(("parallel", object([("parallel", branches)])));
        found.into_iter().map(|(name, shape)| self.define(of_level(name), shape)).collect()
    }
}

/// What the steps with steps are made of.
struct Blocks<'s> {
    /// A step of the blocks within.
    step: Shape,
    name: &'s Shape,
    kinds: &'s Shape,
    list: Option<&'s Shape>,
    asked: Option<&'s Shape>,
}
