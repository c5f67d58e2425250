//! `motet dialog`: texts in InteLiPlan's dialect as policies, and back.

use crate::support::Place;

const TEXT: &str = "<history> The user asked for the coke. <user> Yes, bring it to me, please. <vision> \
    coke: seen \
                    <feasibility> coke: feasible <robot> go to counter, pick up coke, go to user, hand over \
                      coke to user\n\
                    <user> Put the red mug in the sink.\n<robot> 1. go to table\n2. pick the red mug\n3. go \
                      to sink\n4. place it on sink\n";
const WORLD: &str = "--robot hsr --scene kitchen --no-geometry";

#[test]
fn plans_of_a_dialogue_become_policies_with_warnings() {
    let place = Place::new("dialog").file("talk.txt", TEXT);
    let ran = place.run(&format!("dialog talk.txt {WORLD}"));
    ran.check(
        0,
        &[
            "out:policy exchange_1 for hsr {",
            "out:    pick(coke)",
            "out:    handover(coke, user)",
            "out:policy exchange_2 for hsr {",
            "out:    pick(mug_1)",
            "out:    place(mug_1, sink)",
            "err:warning: exchange 1, action 2: read `pick up` as `pick`",
            "err:warning: exchange 2, action 1: took `table` to be `kitchen_table`",
        ],
    );
    // What is printed is a document like any other.
    let policies = place.file("policies.motet", &ran.stdout);
    policies.run(&format!("check policies.motet {WORLD}")).check(0, &["err:no errors"]);
}

#[test]
fn bare_list_becomes_a_policy_in_either_form() {
    let place = Place::new("dialog_list").file("list.txt", "1) go to counter 2) pick coke");
    place.run(&format!("dialog list.txt {WORLD}")).check(0, &["out:policy plan for hsr {", "out:pick(coke)"]);
    let json = place.run(&format!("dialog list.txt {WORLD} --to json"));
    json.check(0, &["out:\"do\": \"pick\""]);
    place
        .file("list.json", &json.stdout)
        .run(&format!("check list.json {WORLD}"))
        .check(0, &["err:no errors"]);
}

#[test]
fn plans_of_the_paper_are_completed_and_run() {
    for (name, list) in [
        ("pick", "pick coke"),
        ("go", "go to sink"),
        ("fetch", "pick coke, go back, place coke"),
        ("away", "Pick sponge. Go to counter. Place sponge."),
        ("drawer", "open drawer, pick sponge, place in drawer, close drawer"),
    ] {
        println!("{name}: {list}");
        let list = Place::new(&format!("dialog_fix_{name}")).file("list.txt", list);
        let ran = list.run(&format!("dialog list.txt --fix {WORLD}"));
        ran.check(0, &["out:policy plan for hsr {"]);
        let policy = list.file("plan.motet", &ran.stdout);
        policy.run(&format!("run plan.motet {WORLD} --profile ideal --speed max")).check(0, &["out:done"]);
    }
}

#[test]
fn dialog_reports_errors_with_their_place() {
    let place = Place::new("dialog_wrong")
        .file("juggle.txt", "<user> Entertain me.\n<robot> go to counter, juggle coke\n")
        .file("double.txt", "<user> Bring the coke.\n<robot> go to counter, pick coke, pick bottle\n")
        .file(
            "question.txt",
            "<user> Bring the mug.\n<robot> Which mug do you mean, the red or the blue one?\n",
        )
        .file("untagged.txt", "hello\n<user> hi\n")
        .file("many.txt", format!("<user> a\n<robot> {}\n", "go to counter, ".repeat(5_001)))
        .file("long.txt", format!("<user> a\n<robot> go to {}counter\n", "the ".repeat(30)))
        .file("empty.txt", " \n");
    for (line, code, texts) in [
        ("dialog juggle.txt", 1, &["err:exchange 1: action 2, `juggle coke`: no action is called so"][..]),
        ("dialog double.txt", 1, &["err:M0501", "out:pick(coke)"]),
        ("dialog question.txt", 1, &["err:exchange 1: the robot asks: Which mug do you mean"]),
        ("dialog untagged.txt", 1, &["err:line 1: `hello` stands before the first tag"]),
        (
            "dialog many.txt",
            1,
            &["err:exchange 1: action 5001, `go to counter`: a list has at most 5000 actions"],
        ),
        ("dialog long.txt", 1, &["err:a name has at most 100 bytes"]),
        ("dialog empty.txt", 1, &["err:there is no action in it"]),
        ("dialog gone.txt", 2, &["err:cannot read `gone.txt`"]),
        ("dialog", 2, &["err:<FILE>"]),
    ] {
        println!("motet {line}");
        place.run(&format!("{line} {WORLD}")).check(code, texts);
    }
}

#[test]
fn exchange_of_a_request_is_written_and_read_again() {
    let place = Place::new("dialog_write");
    let write = |request: &str| {
        let mut args: Vec<String> = ["dialog", "--write", request].map(str::to_owned).into();
        args.extend(WORLD.split(' ').map(str::to_owned));
        place.run_args(&args)
    };
    let ran = write("bring me the coke");
    ran.check(
        0,
        &[
            "out:<user> bring me the coke",
            "out:<vision> coke: not seen",
            "out:<feasibility> coke: feasible",
            "out:<robot> go to counter, pick coke, go to user, ",
            "out:hand over coke to user",
            "err:the list leaves out a monitor",
        ],
    );
    write("bring me the mug")
        .check(1, &["out:<robot> I know two things that could be the mug", "out:Which one?"]);
    let place = place.file("again.txt", &ran.stdout);
    place.run(&format!("dialog again.txt {WORLD}")).check(0, &["out:handover(coke, user)"]);
}

#[test]
fn refusals_escape_control_characters() {
    let place = Place::new("dialog_steering")
        .file("bad.txt", "<user> a\n<robot> fly\u{1b}[2J to \u{9b}moon\u{202e}\n");
    for line in [
        format!("dialog bad.txt {WORLD}"),
        format!("plan --goal on(mug_1\u{1b}[2J\u{9b}\u{202e},counter) {WORLD}"),
    ] {
        let ran = place.run(&line);
        assert_ne!(ran.code, Some(0), "{ran:#?}");
        for text in [&ran.stdout, &ran.stderr] {
            assert!(!text.contains(['\u{1b}', '\u{9b}', '\u{202e}']), "{line:?}: {text:?}");
        }
        assert!(ran.stderr.contains("\\u{1b}"), "{ran:#?}");
    }
}
