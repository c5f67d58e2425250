//! Pages of `motet explain`: examples under "Wrong" raise the code of the page; those under "Right" and "Near
//! miss" raise neither that code nor any error; every code has a page, and every page a code. Guards all
//! `diagnostics.rs`.

use std::collections::BTreeSet;

use motet_compiler::{CheckOptions, Geometry, InitialState, Session, explain_pages};
use motet_robots::scene::StateEntry;
use motet_robots::{builtin, card, import, mesh, scene, srdf, urdf};
use motet_syntax::json::{self, Spanned};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Sources};

/// The sections of a page that hold examples, in order.
const SECTIONS: [&str; 3] = ["Wrong", "Right", "Near miss"];

/// One fenced example: the words after the fence, and its text.
#[derive(Debug)]
struct Fence<'a> {
    info: Vec<&'a str>,
    text: String,
}

/// The examples under a heading.
fn fences<'a>(page: &'a str, section: &str) -> Vec<Fence<'a>> {
    let mut heading = "";
    // The back-quotes that opened the fence; a longer fence may hold a shorter one.
    let mut open: Option<&str> = None;
    let mut found: Vec<Fence<'a>> = Vec::new();
    for line in page.lines() {
        let info = line.trim_start_matches('`');
        let quotes = line.strip_suffix(info).unwrap_or_default();
        match open {
            Some(opened) if opened == line => open = None,
            Some(_) if heading == section => {
                if let Some(fence) = found.last_mut() {
                    fence.text.push_str(line);
                    fence.text.push('\n');
                }
            }
            Some(_) => {}
            None if quotes.len() >= 3 => {
                open = Some(quotes);
                if heading == section {
                    found.push(Fence { info: info.split_whitespace().collect(), text: String::new() });
                }
            }
            None => heading = line.strip_prefix("## ").unwrap_or(heading),
        }
    }
    found
}

/// Documents that are too large for a page.
fn generated(words: &[&str]) -> Option<Vec<u8>> {
    let count = |text: &&str| text.parse::<usize>().ok();
    match words {
        ["entities", n] => {
            let names: Vec<_> = (0..count(n)?).map(|index| format!("e{index}")).collect();
            Some(format!("entity {}: Object\npolicy nothing {{ done }}\n", names.join(", ")).into_bytes())
        }
        ["steps", n] => {
            let steps = "say(\"x\")\n".repeat(count(n)?);
            Some(format!("policy long {{\n{steps}}}\n").into_bytes())
        }
        ["mistakes", n] => {
            Some(format!("policy wrong {{ {} }}\n", "wavee()\n".repeat(count(n)?)).into_bytes())
        }
        ["warnings", n] => {
            let names: String = (0..count(n)?).map(|index| format!("let a{index} = 1\n")).collect();
            Some(format!("policy idle {{\n{names}say(\"x\") }}\n").into_bytes())
        }
        ["words", n] => {
            let list = "0,".repeat(count(n)? / 2);
            Some(format!("policy long {{ choose(\"x\", [{list}0]) }}\n").into_bytes())
        }
        ["spaces", n] => Some(format!("policy short {{ done }}\n{}", " ".repeat(count(n)?)).into_bytes()),
        ["nested", n] => {
            let n = count(n)?;
            Some(
                format!("policy deep {{ {} done {} }}\n", "sequence s {".repeat(n), "}".repeat(n))
                    .into_bytes(),
            )
        }
        ["elements", n] => {
            let n = count(n)?;
            Some(format!("<robot>{}{}</robot>", "<a>".repeat(n), "</a>".repeat(n)).into_bytes())
        }
        ["dots", n] => {
            let n = count(n)?;
            Some(format!("P2 {} 1 1{}", 2 * n, " 0 1".repeat(n)).into_bytes())
        }
        ["latin1"] => Some(b"policy cafe { go(caf\xe9) }\n".to_vec()),
        ["scene", n] => {
            let things: Vec<_> =
                (0..count(n)?).map(|n| format!(r#"{{"id":"s{n}","kind":"Object"}}"#)).collect();
            let things = things.join(",");
            Some(format!(r#"{{"motet_scene":1,"entities":[{things}]}}"#).into_bytes())
        }
        _ => None,
    }
}

/// Diagnostics of the examples of one section, which are one case together.
#[derive(Default)]
struct Case {
    sources: Sources,
    said: Vec<Diagnostic>,
    /// Notes on what is left to the run.
    left: Vec<Diagnostic>,
    robot: Option<card::Robot>,
    /// The text of its card, and which file that is.
    card: Option<(Source, FileId)>,
    urdf: Option<urdf::Urdf>,
    scene: Option<scene::Scene>,
    /// YAML of a map, to which an image comes.
    map: Option<import::MapFile>,
    state: Option<InitialState>,
    options: CheckOptions,
    /// Files of meshes, by name.
    meshes: Vec<(String, Vec<u8>)>,
    has_srdf: bool,
    /// A PDDL domain, a problem and a plan, in this order.
    pddl: Vec<(Source, FileId)>,
    /// Behaviour trees.
    trees: Vec<(Source, FileId)>,
}

impl Case {
    fn add(&mut self, text: &[u8]) -> Option<(Source, FileId)> {
        let file = FileId(u16::try_from(self.sources.len()).unwrap_or(u16::MAX));
        match motet_syntax::decode(text, file) {
            Ok(text) => {
                let source = Source::new("example", text);
                self.sources.add(source.clone());
                Some((source, file))
            }
            Err(mistake) => {
                self.said.push(*mistake);
                None
            }
        }
    }

    fn card(&mut self, toml: &str, declarations: Option<&str>) {
        if let Some((source, file)) = self.add(toml.as_bytes()) {
            let (robot, said) = card::read(&source, file, declarations);
            self.said.extend(said);
            self.robot = robot;
            self.card = Some((source, file));
        }
    }

    fn urdf(&mut self, text: &[u8]) {
        if let Some((source, file)) = self.add(text) {
            let (urdf, said) = urdf::read(&source, file);
            self.said.extend(said);
            let urdf = urdf.map(|urdf| {
                let find = |name: &str| match self.meshes.iter().find(|(known, _)| known == name) {
                    Some((_, bytes)) => mesh::MeshFile::Bytes(bytes.clone()),
                    None => mesh::MeshFile::Missing(mesh::locate(name, "", &[])),
                };
                let (urdf, said) = mesh::attach(&source, file, urdf, find);
                self.said.extend(said);
                urdf
            });
            if let (Some(urdf), Some((card, file))) = (&urdf, &self.card)
                && self.robot.as_ref().is_some_and(|robot| robot.model.is_some())
            {
                self.said.extend(card::fit(card, *file, urdf));
            }
            self.urdf = urdf;
        }
    }

    fn srdf(&mut self, text: &[u8]) {
        self.has_srdf = true;
        if let Some(((source, file), urdf)) = self.add(text).zip(self.urdf.as_ref()) {
            self.said.extend(srdf::read(&source, file, urdf).1);
        }
    }

    fn map(&mut self, text: &[u8]) {
        if let Some((source, file)) = self.add(text) {
            let (map, said) = import::read_map(&source, file);
            self.said.extend(said);
            self.map = map;
        }
    }

    fn map_image(&mut self, image: &[u8]) {
        let options = import::MapOptions::default();
        let scene = self.map.as_ref().map(|map| map.scene(image, &options));
        self.said.extend(scene.and_then(Result::err).map(|problem| *problem));
    }

    fn sdf(&mut self, text: &[u8]) {
        if let Some((source, file)) = self.add(text) {
            self.said.extend(import::read_sdf(&source, file).1);
        }
    }

    fn scene(&mut self, text: &[u8]) {
        if let Some((source, file)) = self.add(text) {
            let (scene, said) = scene::read(&source, file);
            self.said.extend(said);
            self.scene = scene;
        }
    }

    fn state(&mut self, text: &[u8]) {
        if let Some((source, file)) = self.add(text) {
            let (facts, said) = json::read::<indexmap::IndexMap<Spanned<String>, StateEntry>>(&source, file);
            self.said.extend(said);
            self.state = Some(facts.unwrap_or_default().into_iter().collect());
        }
    }

    /// Runs the examples through every stage.
    fn run(mut self, fences: &[Fence<'_>]) -> Result<(Vec<Diagnostic>, Vec<Diagnostic>), String> {
        let (mut domains, mut policies) = (Vec::new(), Vec::new());
        for Fence { info, text } in fences {
            let mut words = info.iter().copied().skip(1);
            let mut bytes = text.clone().into_bytes();
            let mut role = "policy";
            while let Some(word) = words.next() {
                match word.split_once('=') {
                    Some(("robot", name)) => {
                        let texts = builtin::robot_texts(name).ok_or_else(|| format!("no robot `{name}`"))?;
                        self.card(texts.card, texts.declarations);
                    }
                    Some(("scene", name)) => {
                        let texts = builtin::scene_text(name).ok_or_else(|| format!("no scene `{name}`"))?;
                        self.scene(texts.json.as_bytes());
                    }
                    Some(("mesh", name)) => {
                        self.meshes.push((name.to_owned(), bytes.clone()));
                        role = "mesh";
                    }
                    Some(("max", secs)) => self.options.max_duration_secs = secs.parse().ok(),
                    None if word == "generated" => {
                        let rest: Vec<_> = words.by_ref().collect();
                        bytes = generated(&rest).ok_or_else(|| format!("cannot generate {rest:?}"))?;
                    }
                    None if [
                        "card", "urdf", "srdf", "scene", "state", "domain", "pddl", "map", "image", "sdf",
                        "btcpp",
                    ]
                    .contains(&word) =>
                    {
                        role = word
                    }
                    Some(_) | None => return Err(format!("what is `{word}`?")),
                }
            }
            match role {
                "card" => self.card(text, None),
                "urdf" => self.urdf(&bytes),
                "srdf" => self.srdf(&bytes),
                "mesh" => {}
                "scene" => self.scene(&bytes),
                "map" => self.map(&bytes),
                "image" => self.map_image(&bytes),
                "sdf" => self.sdf(&bytes),
                "state" => self.state(&bytes),
                "btcpp" => {
                    let added = self.add(&bytes);
                    self.trees.extend(added);
                }
                "pddl" => {
                    let added = self.add(&bytes);
                    self.pddl.extend(added);
                }
                _ => {
                    let Some((source, file)) = self.add(&bytes) else { continue };
                    let parsed = motet_syntax::read(&source, file);
                    if role == "domain" {
                        self.said.extend(parsed.diagnostics);
                        domains.push(parsed.file);
                    } else {
                        policies.push(parsed);
                    }
                }
            }
        }
        if let [domain, problem, plan @ ..] = self.pddl.as_slice() {
            let input = |of: &(Source, FileId)| (of.0.clone(), of.1);
            let ((domain, first), (problem, second)) = (input(domain), input(problem));
            let plan = plan.first().map(input);
            let plan = plan.as_ref().map(|(source, file)| motet_pddl::PddlSource { source, file: *file });
            let domain = motet_pddl::PddlSource { source: &domain, file: first };
            let problem = motet_pddl::PddlSource { source: &problem, file: second };
            self.said.extend(motet_pddl::import(domain, problem, plan).1);
        }
        if let Some((source, file)) = self.card.as_ref().filter(|_| !self.has_srdf) {
            self.said.extend(card::missing(source, *file, card::ModelFile::Srdf));
        }
        // Where there is a mesh, there is the folder in which it is.
        if let Some((source, file)) = self.card.as_ref().filter(|_| self.meshes.is_empty()) {
            self.said.extend(card::missing(source, *file, card::ModelFile::Package(0)));
        }
        let (robot, scene, state) = (self.robot.as_ref(), self.scene.as_ref(), self.state.as_ref());
        let session = Session::builder()
            .robot(robot)
            .domains(&domains)
            .scene(scene)
            .state(state)
            .options(self.options)
            .build(&mut self.sources);
        let said = session.input_diagnostics().to_vec();
        self.said.extend(said);
        let body = robot.and_then(|robot| builtin::robot_texts(&robot.name).map(|texts| texts.urdf));
        let session = match (robot, body, scene) {
            (Some(robot), Some(text), Some(scene)) => {
                let urdf =
                    urdf::read(&Source::new("robot.urdf", text), FileId(0)).0.ok_or("a broken URDF")?;
                let budget = motet_geometry::planning::SearchBudget::default();
                let geometry = Geometry::new(robot, &urdf, scene, state, budget);
                self.said.extend(geometry.contradicted_sight());
                session.with_geometry(geometry.into())
            }
            _ => session,
        };
        for (source, file) in &self.trees {
            self.said.extend(motet_btcpp::import(source, *file, &session.signatures().leaves()).1);
        }
        for parsed in &policies {
            self.said.extend(session.check(parsed));
            self.left.extend(session.check_document(parsed).deferred_notes);
            // A file whose policies all have parameters is there to be called.
            self.said.extend(session.compile(parsed, None).diagnostics);
        }
        Ok((self.said, self.left))
    }
}

/// Faults of a page.
fn faults(page: &explain_pages::CodePage) -> Vec<String> {
    let mut faults = Vec::new();
    if !page.text.starts_with(&format!("# {}: ", page.code)) {
        faults.push("does not begin with its code and title".to_owned());
    }
    for section in SECTIONS {
        let fences = fences(page.text, section);
        if fences.is_empty() {
            faults.push(format!("has nothing under `{section}`"));
            continue;
        }
        let said = match Case::default().run(&fences) {
            // Every other page is about what a check says before any of that.
            Ok((said, left)) if page.code == "M0505" => [said, left].concat(),
            Ok((said, _)) => said,
            Err(problem) => {
                faults.push(format!("`{section}`: {problem}"));
                continue;
            }
        };
        let raised: BTreeSet<_> = said.iter().map(|said| said.code.0).collect();
        let wrong = section == "Wrong";
        if raised.contains(page.code) != wrong {
            faults.push(format!("`{section}` raises {raised:?}"));
        }
        let allowed = |said: &&Diagnostic| {
            // Policies beside declarations are not chosen to run, and too many mistakes are of another code.
            let is_its = page.code == said.code.0 || page.code == "M0124";
            said.severity == Severity::Error && (wrong && is_its || said.code.0 == "M0405")
        };
        for said in said.iter().filter(|said| said.severity == Severity::Error && !allowed(said)) {
            faults.push(format!("`{section}` raises {}: {}", said.code, said.message));
        }
    }
    faults
}

#[test]
fn examples_raise_what_their_page_says() {
    let faults: Vec<_> = explain_pages::PAGES
        .iter()
        .flat_map(|page| faults(page).into_iter().map(|fault| format!("{}: {fault}", page.code)))
        .collect();
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn every_code_has_a_page_and_every_page_a_code() {
    let codes: Vec<_> = explain_pages::all().into_iter().map(|code| code.0).collect();
    let pages: Vec<_> = explain_pages::PAGES.iter().map(|page| page.code).collect();
    assert_eq!(codes, pages);
}

#[test]
fn page_is_found_in_any_case() {
    let page = explain_pages::page("m0501").map(|page| page.code);
    assert_eq!(page, Some("M0501"));
}
