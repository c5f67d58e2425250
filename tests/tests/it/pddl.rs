//! Import of PDDL: domains with a plan that is valid and one that is not, what is refused, and hostile text.

use motet_compiler::Session;
use motet_pddl::{PddlSource, Translation, import};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Sources, read};
use proptest::prelude::*;

fn run(domain: &str, problem: &str, plan: Option<&str>) -> (Option<Translation>, Vec<Diagnostic>) {
    let sources = [domain, problem, plan.unwrap_or_default()].map(|text| Source::new("pddl", text));
    let [domain, problem, steps] = &sources;
    let input = |source, file| PddlSource { source, file: FileId(file) };
    import(input(domain, 0), input(problem, 1), plan.map(|_| input(steps, 2)))
}

/// The codes and paths of the errors that a plan has, by way of the text that `motet import` writes.
fn judge(name: &str, plan: &str) -> Vec<(String, String)> {
    let file = |file: &str| {
        let path = format!("{}/pddl/{name}/{file}", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
    };
    let (imported, said) = run(&file("domain.pddl"), &file("problem.pddl"), Some(&file(plan)));
    assert_eq!(said, [], "{name}");
    let imported = imported.unwrap();
    let mut sources = Sources::default();
    let declarations = Source::new("domain.motet", imported.declarations_text());
    let id = sources.add(declarations.clone());
    let domain = read(&declarations, id);
    assert_eq!(domain.diagnostics, [], "{name}");
    let policy = Source::new("plan.motet", imported.policy_text());
    let id = sources.add(policy.clone());
    let session = Session::builder().domains(&[domain.file]).build(&mut sources);
    let said = session.input_diagnostics().to_vec();
    assert_eq!(said, [], "{name}");
    let errors =
        session.check(&read(&policy, id)).into_iter().filter(|said| said.severity == Severity::Error);
    errors.map(|said| (said.code.to_string(), said.path)).collect()
}

#[test]
fn import_lets_the_compiler_decide_plans() {
    for (name, wrong) in [
        ("blocks", &[("M0503", "/achieves"), ("M0501", "/steps/0")][..]),
        ("gripper", &[("M0503", "/achieves"), ("M0501", "/steps/1")]),
        ("logistics", &[("M0501", "/steps/2")]),
        ("lights", &[("M0503", "/achieves"), ("M0501", "/steps/1")]),
    ] {
        assert_eq!(judge(name, "valid.plan"), [], "{name}");
        let found = judge(name, "invalid.plan");
        let found: Vec<_> = found
            .iter()
            .map(|(code, path)| (code.as_str(), if code == "M0503" { "/achieves" } else { path.as_str() }))
            .collect();
        assert_eq!(found, wrong, "{name}");
    }
}

const DOMAIN: &str = "(define (domain d) (:requirements :strips) (:types t) (:constants k - t)
  (:predicates (p ?x - t) (q))
  (:action a :parameters (?x - t) :precondition (p ?x) :effect (not (p ?x))))";
const PROBLEM: &str = "(define (problem one) (:domain d) (:objects o - t) (:init (p o)) (:goal (not (p o))))";

/// Replaces one part of the domain, the problem or the plan, and expects an error whose message has the
/// words, at the part.
#[test]
fn import_names_unsupported_parts() {
    assert_eq!(run(DOMAIN, PROBLEM, Some("(a o)")).1, []);
    for (from, to, code, words, at) in [
        (":strips", ":strips :fluents", "M0132", "`:fluents`", ":fluents"),
        (":strips", ":durative-actions", "M0132", "`:durative-actions`", ":durative-actions"),
        (":strips", ":adl", "M0132", "`:adl`", ":adl"),
        ("(:types", "(:functions (cost)) (:types", "M0132", "numeric functions", "(:functions"),
        ("(:action a", "(:durative-action b) (:action a", "M0132", "durative action", "(:durative"),
        ("(:action a", "(:derived (q) (p k)) (:action a", "M0132", "derived", "(:derived"),
        ("n (p ?x)", "n (or (p ?x) (q))", "M0132", "`or` in a precondition", "(or"),
        ("n (p ?x)", "n (imply (p ?x) (q))", "M0132", "`imply`", "(imply"),
        ("n (p ?x)", "n (exists (?y - t) (p ?y))", "M0132", "`exists`", "(exists"),
        ("n (p ?x)", "n (forall (?y - t) (p ?y))", "M0132", "`forall` in a precondition", "(forall"),
        ("n (p ?x)", "n (not (and (p ?x) (q)))", "M0132", "`and` under `not`", "(and"),
        ("n (p ?x)", "n (> (cost) 1)", "M0132", "`>`", "(>"),
        ("n (p ?x)", "n (p ?y)", "M0133", "no variable `?y`", "?y"),
        ("n (p ?x)", "n (pp ?x)", "M0133", "no predicate `pp`", "(pp"),
        ("n (p ?x)", "n (p ?x ?x)", "M0133", "takes 1", "(p ?x ?x"),
        ("t (not (p ?x))", "t (increase (cost) 1)", "M0132", "`increase`", "(increase"),
        ("t (not (p ?x))", "t (forall (?y ?z - t) (p ?y))", "M0132", "one variable", "(forall"),
        ("?x - t) :pre", "?x - (either t k)) :pre", "M0132", "either", "(either"),
        ("?x - t) :pre", "?x - u) :pre", "M0133", "no type `u`", "?x - u"),
        ("(:types t)", "(:types t - u u - t)", "M0133", "below itself", "t - u"),
        ("(p ?x - t) (q)", "(p ?x - t) (q ?a ?b ?c ?d ?e)", "M0132", "more than 4", "(q"),
        ("(:init (p o))", "(:init (= (cost) 3))", "M0132", "numeric function", "(="),
        ("(:init (p o))", "(:init (at 5 (p o)))", "M0132", "timed", "(at"),
        ("(:init (p o))", "(:init (p oo))", "M0133", "no object `oo`", "oo"),
        ("(:goal (not (p o)))", "(:goal (q)) (:metric minimize (cost))", "M0132", "metric", "(:metric"),
        ("(:goal (not (p o)))", "", "M0131", "`(:goal …)`", "(define (problem"),
        ("(:domain d)", "(:domain e)", "M0133", "for the domain `e`", "(:domain e"),
        ("(a o)", "(b o)", "M0133", "no action `b`", "(b"),
        ("(a o)", "(a)", "M0133", "takes 1", "(a)"),
        ("(a o)", "(a o", "M0131", "never closed", "(a"),
        ("(a o)", "\"a\"", "M0131", "`\\\"`", "\"a\""),
    ] {
        let texts = [DOMAIN, PROBLEM, "(a o)"].map(|text| text.replacen(from, to, 1));
        let [domain, problem, plan] = &texts;
        let (imported, said) = run(domain, problem, Some(plan));
        assert!(imported.is_none(), "{to}");
        let first = said.first().unwrap();
        assert_eq!(first.code.0, code, "{to}: {first:?}");
        assert!(first.message.contains(words), "{to}: {}", first.message);
        let text = &texts[usize::from(first.span.file.0)];
        let here = &text[first.span.range().start..];
        assert!(here.starts_with(at) || at.starts_with(&text[first.span.range()]), "{to}: {here}");
    }
}

#[test]
fn import_of_a_plan_without_steps_is_done() {
    let imported = run(DOMAIN, PROBLEM, Some("; nothing")).0.unwrap();
    assert!(imported.policy_text().contains("{\n    done\n}"), "{}", imported.policy_text());
}

#[test]
fn import_limits_nesting() {
    let deep = "(".repeat(100_000);
    assert_eq!(run(&deep, PROBLEM, None).1.first().unwrap().code.0, "M0111");
}

proptest! {
    #[test]
    fn no_text_panics(cut in 0_usize..300, insert in "[() ?:a-z=;-]{0,12}", target in 0_usize..3) {
        let mut texts = [DOMAIN, PROBLEM, "0: (a o) [1]"].map(str::to_owned);
        let text = &mut texts[target];
        let at = cut.min(text.len());
        text.insert_str(at, &insert);
        let [domain, problem, plan] = &texts;
        if let (Some(imported), _) = run(domain, problem, Some(plan)) {
            // What is written can be read.
            for text in [imported.declarations_text(), imported.policy_text()] {
                let parsed = read(&Source::new("x", text.as_str()), FileId(0));
                prop_assert!(parsed.diagnostics.is_empty(), "{text}\n{:?}", parsed.diagnostics);
            }
        }
    }
}
