//! Exclusive resources: every one that is named is declared, hands and cameras are among them, and none contains itself.

use indexmap::IndexMap;
use motet_syntax::{Span, suggest};
use smol_str::SmolStr;

use super::errors::{NotAResource, ResourceCycle, TakenName, UnknownResource};
use super::read::CardReader;
use super::wire;

impl CardReader {
    /// What the card says of resources, with what is wrong with it.
    pub(super) fn resources(&mut self, card: &wire::CardTable) -> IndexMap<SmolStr, Vec<SmolStr>> {
        let mut resources = IndexMap::new();
        for (name, contains) in &card.resources {
            self.name(name, self.numbers.span(contains));
            for inner in contains.get().iter().filter(|inner| !card.resources.contains_key(inner.get())) {
                let near = suggest::closest(inner.get(), card.resources.keys().map(String::as_str));
                let (span, near) = (self.numbers.span(inner), near.map(str::to_owned));
                self.numbers.found.push(UnknownResource { span, resource: inner.get().clone(), near }.into());
            }
            let contains = contains.get().iter().map(|inner| SmolStr::new(inner.get())).collect();
            resources.insert(SmolStr::new(name), contains);
        }
        for (name, span) in
            card.hands.iter().map(|(name, hand)| (name, self.numbers.span(hand))).collect::<Vec<_>>()
        {
            self.is_resource(card, "hand", name, span);
            if card.cameras.contains_key(name) {
                self.numbers.found.push(TakenName { span, name: name.clone() }.into());
            }
        }
        for (name, camera) in &card.cameras {
            self.is_resource(card, "camera", name, self.numbers.span(camera));
        }
        if let Some(chain) = cycle(&resources) {
            let first = chain.first().and_then(|name| card.resources.get(name.as_str()));
            let span = first.map(|contains| self.numbers.span(contains)).unwrap_or_default();
            let chain = chain.iter().map(ToString::to_string).collect();
            self.numbers.found.push(ResourceCycle { span, chain }.into());
        }
        resources
    }

    fn is_resource(&mut self, card: &wire::CardTable, what: &'static str, name: &str, span: Span) {
        if !card.resources.contains_key(name) {
            self.numbers.found.push(NotAResource { span, what, name: name.to_owned() }.into());
        }
    }
}

/// A chain of resources that ends where it begins. Takes away, again and again, what contains nothing that is left.
fn cycle(resources: &IndexMap<SmolStr, Vec<SmolStr>>) -> Option<Vec<SmolStr>> {
    let mut left = resources.clone();
    loop {
        let before = left.len();
        let names: Vec<SmolStr> = left.keys().cloned().collect();
        left.retain(|_, contains| contains.iter().any(|inner| names.contains(inner)));
        if left.len() == before {
            break;
        }
    }
    // From here every resource contains one that is left, so following the first such must come back.
    let mut chain = vec![left.keys().next()?.clone()];
    loop {
        let last = left.get(chain.last()?)?;
        let next = last.iter().find(|inner| left.contains_key(*inner))?.clone();
        if let Some(at) = chain.iter().position(|seen| *seen == next) {
            let mut chain = chain.split_off(at);
            chain.push(next);
            return Some(chain);
        }
        chain.push(next);
    }
}
