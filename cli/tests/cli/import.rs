//! `motet import pddl` from outside.

use crate::support::Place;

const DOMAIN: &str = "(define (domain lamps) (:requirements :strips :typing) (:types lamp)
  (:predicates (lit ?l - lamp))
  (:action light-it :parameters (?l - lamp) :precondition (not (lit ?l)) :effect (lit ?l)))";
const PROBLEM: &str =
    "(define (problem one) (:domain lamps) (:objects a b - lamp) (:init (lit a)) (:goal (lit b)))";

#[test]
fn a_plan_is_decided_by_its_domain() {
    let place = Place::new("import")
        .file("d.pddl", DOMAIN)
        .file("p.pddl", PROBLEM)
        .file("good.plan", "(light-it b)\n")
        .file("bad.plan", "(light-it a)\n")
        .file("odd.pddl", DOMAIN.replace(":strips", ":adl"));
    place.run("import pddl d.pddl p.pddl -o lamps.motet").check(0, &[]);
    for (plan, code, texts) in [("good", 0, &[][..]), ("bad", 1, &["out:M0501", "out:M0503"])] {
        place.run(&format!("import pddl d.pddl p.pddl --plan {plan}.plan -o {plan}.motet")).check(0, &[]);
        place.run(&format!("check {plan}.motet --domain lamps.motet")).check(code, texts);
    }
    place.run("import pddl d.pddl p.pddl").check(0, &["out:action `light-it`(l: lamp)", "out:closed world"]);
    place.run("import pddl odd.pddl p.pddl").check(1, &["out:M0132", "out:`:adl`", "out:odd.pddl:1:"]);
    place.run("import pddl absent.pddl p.pddl").check(2, &["err:cannot read `absent.pddl`"]);
}
