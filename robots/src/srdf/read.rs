//! From the text of a SRDF to a [`Srdf`], or to what is wrong with it.

use motet_syntax::{Diagnostic, FileId, Source, suggest};
use roxmltree::Node;
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use super::errors::{NotSrdf, UnknownPart};
use super::{EndEffector, Group, Srdf};
use crate::urdf::{Document, Places, Urdf, children};

/// Reads a SRDF of a robot. There is none where there is an error. O(bytes + links + joints).
#[must_use]
pub fn read(source: &Source, file: FileId, urdf: &Urdf) -> (Option<Srdf>, Vec<Diagnostic>) {
    let document = match Document::parse(source, file) {
        Ok(document) => document,
        Err(problem) => return (None, vec![*problem]),
    };
    let (root, places) = (document.root(), document.places);
    if root.tag_name().name() != "robot" {
        let found = root.tag_name().name().to_owned();
        return (None, vec![NotSrdf { span: places.tag(root), found }.into()]);
    }
    let index = |names: &mut dyn Iterator<Item = &SmolStr>| {
        names.zip(0..).map(|(name, at)| (name.clone(), at)).collect::<FxHashMap<_, _>>()
    };
    let mut reader = Reader {
        places,
        links: index(&mut urdf.links.iter().map(|link| &link.name)),
        joints: index(&mut urdf.joints.iter().map(|joint| &joint.name)),
        found: Vec::new(),
    };
    let srdf = reader.srdf(root);
    let mut found = reader.found;
    found.sort_by_key(|diagnostic| diagnostic.span);
    (found.is_empty().then_some(srdf), found)
}

struct Reader {
    places: Places,
    links: FxHashMap<SmolStr, usize>,
    joints: FxHashMap<SmolStr, usize>,
    found: Vec<Diagnostic>,
}

impl Reader {
    fn srdf(&mut self, root: Node<'_, '_>) -> Srdf {
        let mut srdf = Srdf::default();
        for node in children(root, "group") {
            if let Some((name, _)) = self.places.required(node, "name", &mut self.found) {
                srdf.groups.insert(name.into(), self.group(node));
            }
        }
        let is_group = |name: &str| srdf.groups.contains_key(name);
        let inner =
            children(root, "group").flat_map(|group| children(group, "group").map(|inner| (inner, "name")));
        let named = inner.chain(children(root, "end_effector").map(|hand| (hand, "group")));
        for (node, key) in named {
            let Some((name, span)) = self.places.required(node, key, &mut self.found) else { continue };
            if !is_group(name) {
                let near = suggest::closest(name, srdf.groups.keys().map(SmolStr::as_str)).map(str::to_owned);
                self.found.push(UnknownPart { span, what: "group", name: name.to_owned(), near }.into());
            }
        }
        for node in children(root, "end_effector") {
            let name = self.places.required(node, "name", &mut self.found);
            let group = self.places.attribute(node, "group");
            let parent = self.link(node, "parent_link");
            if let (Some((name, _)), Some((group, _)), Some(parent)) = (name, group, parent) {
                srdf.end_effectors.insert(name.into(), EndEffector { group: group.into(), parent });
            }
        }
        for node in children(root, "disable_collisions") {
            let (one, other) = (self.link(node, "link1"), self.link(node, "link2"));
            srdf.disabled.extend(one.zip(other).map(|(one, other)| [one.min(other), one.max(other)]));
        }
        srdf.disabled.sort_unstable();
        srdf.disabled.dedup();
        srdf
    }

    fn group(&mut self, node: Node<'_, '_>) -> Group {
        let named = |found: &mut Self, what, table: fn(&Self) -> &FxHashMap<SmolStr, usize>| -> Vec<usize> {
            children(node, what).filter_map(|part| found.part(part, "name", what, table)).collect()
        };
        let links = named(self, "link", |reader| &reader.links);
        let joints = named(self, "joint", |reader| &reader.joints);
        let chains = children(node, "chain").filter_map(|chain| {
            let (base, tip) = (self.link(chain, "base_link"), self.link(chain, "tip_link"));
            Some([base?, tip?])
        });
        let chains = chains.collect();
        let groups = children(node, "group").filter_map(|inner| inner.attribute("name")).map(SmolStr::new);
        Group { links, joints, chains, groups: groups.collect() }
    }

    fn link(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<usize> {
        self.part(node, key, "link", |reader| &reader.links)
    }

    fn part(
        &mut self,
        node: Node<'_, '_>,
        key: &'static str,
        what: &'static str,
        table: fn(&Self) -> &FxHashMap<SmolStr, usize>,
    ) -> Option<usize> {
        let (name, span) = self.places.required(node, key, &mut self.found)?;
        let known = table(self).get(name).copied();
        if known.is_none() {
            let mut names: Vec<&str> = table(self).keys().map(SmolStr::as_str).collect();
            names.sort_unstable();
            let near = suggest::closest(name, names).map(str::to_owned);
            self.found.push(UnknownPart { span, what, name: name.to_owned(), near }.into());
        }
        known
    }
}
