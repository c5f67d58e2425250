//! SRDF: groups of links and joints, end effectors, and pairs of links that may touch. It is read against the
//! URDF, so every name in it refers to a link or joint. Virtual and passive joints, spheres and states are
//! skipped.

mod diagnostics;

use indexmap::IndexMap;
use motet_syntax::{Diagnostic, FileId, Severity, Source, Span, suggest};
use roxmltree::Node;
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

pub use self::diagnostics::CODES;
use self::diagnostics::{GroupCycle, NotSrdf, TakenPart, UnknownPart};
use crate::urdf::{Urdf, XmlDialect, XmlDocument, XmlSpans, children, is_own, unknown};

/// SRDF after reading; links and joints are indices into the URDF.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Srdf {
    /// Groups by name.
    pub groups: IndexMap<SmolStr, JointGroup>,
    /// End effectors by name.
    pub end_effectors: IndexMap<SmolStr, EndEffector>,
    /// Pairs of links that may touch, the lower index first, sorted, each once.
    pub disabled: Vec<[usize; 2]>,
}

/// Links and joints that are planned together.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct JointGroup {
    pub links: Vec<usize>,
    pub joints: Vec<usize>,
    /// Chains, from base link to tip link.
    pub chains: Vec<[usize; 2]>,
    /// Other groups that belong to it.
    pub groups: Vec<SmolStr>,
}

/// End effector: a hand on an arm.
#[derive(Clone, PartialEq, Debug)]
pub struct EndEffector {
    /// Group of its own links and joints.
    pub group: SmolStr,
    /// Link on which it is mounted.
    pub parent: usize,
}

/// Reads the SRDF of a robot. `None` if there is an error. O(bytes + links + joints).
///
/// ```
/// use motet_robots::{builtin, srdf};
/// use motet_syntax::{FileId, Source};
///
/// let urdf = builtin::robot("panda").unwrap().urdf;
/// let chain = r#"<chain base_link="panda_link0" tip_link="panda_link7"/>"#;
/// let text = format!(r#"<robot name="panda"><group name="arm">{chain}</group></robot>"#);
/// let (srdf, diagnostics) = srdf::read(&Source::new("robot.srdf", text), FileId(0), &urdf);
/// assert!(diagnostics.is_empty());
/// assert_eq!(srdf.unwrap().groups["arm"].chains[0][1], urdf.link("panda_link7").unwrap());
/// ```
#[must_use]
pub fn read(source: &Source, file: FileId, urdf: &Urdf) -> (Option<Srdf>, Vec<Diagnostic>) {
    let document = match XmlDocument::parse(source, file, XmlDialect::Srdf) {
        Ok(document) => document,
        Err(problem) => return (None, vec![*problem]),
    };
    let (root, spans) = (document.root(), document.spans);
    if root.tag_name().name() != "robot" {
        let found = root.tag_name().name().to_owned();
        return (None, vec![NotSrdf { span: spans.tag(root), found }.into()]);
    }
    let index = |names: &mut dyn Iterator<Item = &SmolStr>| {
        names.zip(0..).map(|(name, at)| (name.clone(), at)).collect::<FxHashMap<_, _>>()
    };
    let mut reader = SrdfReader {
        spans,
        links: index(&mut urdf.links.iter().map(|link| &link.name)),
        joints: index(&mut urdf.joints.iter().map(|joint| &joint.name)),
        found: Vec::new(),
    };
    let srdf = reader.srdf(root);
    let mut found = reader.found;
    found.sort_by_key(|diagnostic| diagnostic.span);
    let wrong = found.iter().any(|said| said.severity == Severity::Error);
    ((!wrong).then_some(srdf), found)
}

/// Elements that are read.
const PARTS: [&str; 3] = ["group", "end_effector", "disable_collisions"];

/// Elements of other tools, which are skipped.
const PASSED_OVER: [&str; 9] = [
    "virtual_joint",
    "passive_joint",
    "group_state",
    "link_sphere_approximation",
    "disable_default_collisions",
    "enable_collisions",
    "joint_property",
    "collision_margins",
    "contact_managers_plugin_config",
];

struct SrdfReader {
    spans: XmlSpans,
    links: FxHashMap<SmolStr, usize>,
    joints: FxHashMap<SmolStr, usize>,
    found: Vec<Diagnostic>,
}

impl SrdfReader {
    fn srdf(&mut self, root: Node<'_, '_>) -> Srdf {
        let mut srdf = Srdf::default();
        self.elements(root, &PARTS, &PASSED_OVER);
        let mut taken = FxHashMap::default();
        for node in children(root, "group") {
            self.elements(node, &["link", "joint", "chain", "group"], &["passive_joint"]);
            if let Some(name) = self.spans.required(node, "name", &mut self.found) {
                let group = self.group(node);
                if self.is_new("group", name, &mut taken) {
                    srdf.groups.insert(name.0.into(), group);
                }
            }
        }
        let is_group = |name: &str| srdf.groups.contains_key(name);
        let inner =
            children(root, "group").flat_map(|group| children(group, "group").map(|inner| (inner, "name")));
        let named = inner.chain(children(root, "end_effector").map(|hand| (hand, "group")));
        for (node, key) in named {
            let Some((name, span)) = self.spans.required(node, key, &mut self.found) else { continue };
            if !is_group(name) {
                let near = suggest::closest(name, srdf.groups.keys().map(SmolStr::as_str)).map(str::to_owned);
                self.found.push(UnknownPart { span, what: "group", name: name.to_owned(), near }.into());
            }
        }
        self.found.extend(ring(&srdf.groups).map(|chain| {
            let first = chain.first().and_then(|name| taken.get(name.as_str())).copied();
            let chain = chain.iter().map(ToString::to_string).collect();
            GroupCycle { span: first.unwrap_or_default(), chain }.into()
        }));
        let mut taken = FxHashMap::default();
        for node in children(root, "end_effector") {
            let name = self.spans.required(node, "name", &mut self.found);
            let group = self.spans.attribute(node, "group");
            let parent = self.link(node, "parent_link");
            if let (Some(name), Some((group, _)), Some(parent)) = (name, group, parent)
                && self.is_new("end effector", name, &mut taken)
            {
                let (name, _) = name;
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

    /// Reports elements that are neither read nor known from other tools.
    fn elements(&mut self, node: Node<'_, '_>, known: &[&'static str], passed_over: &[&'static str]) {
        for child in node.children().filter(|child| is_own(node, child)) {
            let name = child.tag_name().name();
            if !known.contains(&name) && !passed_over.contains(&name) {
                let names = known.iter().chain(passed_over).copied();
                self.found.push(unknown(child, names, self.spans));
            }
        }
    }

    fn is_new<'a>(
        &mut self,
        what: &'static str,
        (name, span): (&'a str, Span),
        taken: &mut FxHashMap<&'a str, Span>,
    ) -> bool {
        let first = *taken.entry(name).or_insert(span);
        if first != span {
            self.found.push(TakenPart { span, what, name: name.to_owned(), first }.into());
        }
        first == span
    }

    fn group(&mut self, node: Node<'_, '_>) -> JointGroup {
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
        JointGroup { links, joints, chains, groups: groups.collect() }
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
        let (name, span) = self.spans.required(node, key, &mut self.found)?;
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

/// Finds a group that contains itself, with those in between and the first at both ends. O(groups and their
/// names).
fn ring(groups: &IndexMap<SmolStr, JointGroup>) -> Option<Vec<SmolStr>> {
    let mut seen = vec![false; groups.len()];
    let mut is_open = vec![false; groups.len()];
    for start in 0..groups.len() {
        // Open groups, each with the number of its subgroups visited.
        let mut path = vec![(start, 0)];
        while let Some((at, next)) = path.last_mut() {
            let at = *at;
            if *next == 0 && std::mem::replace(seen.get_mut(at)?, true) {
                path.pop();
                continue;
            }
            let inner = groups.get_index(at).and_then(|(_, group)| group.groups.get(*next));
            *next += 1;
            *is_open.get_mut(at)? = inner.is_some();
            let Some(inner) = inner else {
                path.pop();
                continue;
            };
            let Some(inner) = groups.get_index_of(inner) else { continue };
            if is_open.get(inner) == Some(&true) {
                let from = path.iter().position(|(known, _)| *known == inner)?;
                let names = path.iter().skip(from).map(|(at, _)| *at).chain([inner]);
                return names.map(|at| groups.get_index(at).map(|(name, _)| name.clone())).collect();
            }
            path.push((inner, 0));
        }
    }
    None
}
