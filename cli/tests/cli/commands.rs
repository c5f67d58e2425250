//! The small commands from outside: `robots`, `explain`, `schema`, `completions`.

use std::collections::BTreeSet;

use crate::support::Place;
use serde_json::Value;

#[test]
fn answers() {
    let place = Place::new("commands");
    for (line, code, texts) in [
        ("robots", 0, &["out:hsr", "out:anymal_z1"][..]),
        ("robots list", 0, &["out:hsr"]),
        ("robots show hsr", 0, &["out:action pick(", "out:/// ", "out:perception detect("]),
        ("robots show anymal_z1", 0, &["out:wake_up", "out:contains camera"]),
        ("robots check hsr", 0, &["out:no errors", "out:closed form: a lift"]),
        ("robots check hsr", 0, &["out:home      touches neither itself nor the floor"]),
        ("robots check anymal_z1", 0, &["out:closed form: six joints"]),
        (
            "feasible --robot hsr --scene kitchen --for reach(mug_1)",
            0,
            &["out:reach(mug_1): feasible, base at"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for put(mug_1,kitchen_table) --state \
             {\"holding(mug_1)\":true}",
            0,
            &["out:put(mug_1, kitchen_table): feasible, base at"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for put(mug_1,kitchen_table) --state \
             {\"holding(mug_1)\":true,\"grip(mug_1)\":{\"xyz\":[0,0,0.09],\"rpy\":[0,1.5708,0]}}",
            0,
            &["out:put(mug_1, kitchen_table): feasible, base at"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for put(mug_1,kitchen_table) --state \
             {\"holding(mug_1)\":true,\"grip(mug_1)\":{\"xyz\":[0,0,0.09],\"rpy\":[0.9,0.4,0]}}",
            1,
            &["out:put(mug_1, kitchen_table): "],
        ),
        (
            "robots mjcf --robot hsr --scene kitchen --state {\"on(mug_1,sink)\":true}",
            2,
            &["err:the state says `on(mug_1,sink)`, but the scene gives no pose for it"],
        ),
        (
            "robots mjcf --robot hsr --scene kitchen --state {\"holding(mug1)\":true}",
            2,
            &["out:`mug1`", "out:did you mean `mug_1`"],
        ),
        ("feasible --robot hsr --scene kitchen --for reach(plate)", 1, &["out:no_free_pose", "out:(proven)"]),
        (
            "feasible --robot hsr --scene kitchen --for push(drawer_1)",
            1,
            &["out:unknown", "out:is already closed"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for jump(mug_1)",
            2,
            &["err:no motion `jump(mug_1)`", "err:go_to(ENTITY)"],
        ),
        ("feasible --robot hsr --scene kitchen", 2, &["err:--for"]),
        (
            "feasible --robot hsr --scene kitchen --for reach(mug1)",
            2,
            &["err:there is no entity `mug1`", "err:did you mean `mug_1`?"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for posture(hom) --effort 2",
            2,
            &["err:there is no posture `hom`", "err:did you mean `home`?"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for offer(mug_1,kitchen_table)",
            2,
            &["out:M0301", "out:`to` of `handover` takes a `Person`, not", "out:--for:1:13"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for pull(kitchen_table) --for reach(user,top)",
            2,
            &["out:`what` of `open` takes a `Container`", "out:takes an `Object`"],
        ),
        (
            "feasible --robot hsr --scene kitchen --for look(user)",
            1,
            &["out:the robot itself (`head_tilt_link` and `arm_flex_link`)", "out:the posture `start` first"],
        ),
        ("feasible --help", 0, &["out:--effort", "out:put(OBJECT, ENTITY)"]),
        (
            "feasible --robot hsr --scene kitchen --for go_to(sink) --for reach(coke) --format json --svg \
                room.svg",
            0,
            &["out:{\"query\":\"go_to(sink)\",\"answer\":\"feasible\"", "out:\"margins\""],
        ),
        ("robots check panda", 0, &["out:7 joints: closed form: seven joints with shoulder"]),
        ("robots show hs", 2, &["err:did you mean `hsr`?"]),
        ("explain", 0, &["out:M0501"]),
        ("explain M0501", 0, &["out:M0501"]),
        ("explain m0501", 0, &["out:M0501"]),
        ("explain M9999", 2, &["err:no diagnostic code `M9999`"]),
        ("schema", 2, &["err:Usage"]),
        ("schema dog", 2, &["err:policy, scene, robot, diagnostic"]),
        ("completions bash", 0, &["out:_motet", "out:anymal_z1", "out:living_room", "out:M0501"]),
        ("completions zsh", 0, &["out:#compdef motet"]),
        ("completions fish", 0, &["out:complete -c motet"]),
        ("completions cmd", 2, &["err:possible values"]),
    ] {
        println!("motet {line}");
        place.run(line).check(code, texts);
    }
}

#[test]
fn room_without_things_has_nothing_to_suggest() {
    let place = Place::new("bare").file("bare.json", r#"{"motet_scene": 1, "entities": []}"#);
    let ran = place.run("feasible --robot hsr --scene bare.json --for reach(cup)");
    ran.check(2, &["err:there is no entity `cup`", "err:the robot or scene has no entity"]);
}

/// The value of an attribute in a line of a drawing.
fn attribute<'t>(line: &'t str, name: &str) -> &'t str {
    let start = format!(" {name}=\"");
    line.split(start.as_str()).nth(1).unwrap().split('"').next().unwrap()
}

#[test]
fn drawing_tells_its_answers_apart() {
    let place = Place::new("drawing");
    let ran = place.run("feasible --robot hsr --scene kitchen --all --svg room.svg");
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let drawn = place.read("room.svg");
    let feasible: Vec<&str> =
        ran.stdout.lines().filter_map(|line| line.split_once(": feasible")).map(|it| it.0).collect();
    let ways: Vec<&str> = drawn.lines().filter(|line| line.starts_with("<polyline")).collect();
    assert!(feasible.len() > 20 && ways.len() == feasible.len());
    let looks: BTreeSet<_> =
        ways.iter().map(|line| (attribute(line, "stroke"), attribute(line, "stroke-dasharray"))).collect();
    assert_eq!(looks.len(), ways.len());
    // Every answer is in the legend, also of what is not feasible.
    for query in &feasible {
        assert!(drawn.contains(&format!(">{query}: feasible</text>")), "{query}");
    }
    assert!(drawn.contains(">reach(plate): no_free_pose</text>"));
    // What has no shape is marked where it is, and what is opened is drawn so.
    assert_eq!(drawn.matches("<path class=\"mark\"").count(), 2);
    assert!(drawn.contains(">charging_dock</text>") && drawn.contains(">door</text>"));
    let opened = feasible.iter().filter(|query| query.starts_with("pull")).count();
    assert!(opened > 0 && drawn.matches("<polygon class=\"moved\"").count() >= opened);
}

#[test]
fn describes_the_formats() {
    let place = Place::new("schemas");
    for (of, key) in [
        ("policy", "steps"),
        ("scene", "entities"),
        ("faults", "calls"),
        ("robot", "name"),
        ("diagnostic", "code"),
    ] {
        let schema: Value =
            serde_json::from_str(&place.run(&format!("schema {of}")).check(0, &[]).stdout).unwrap();
        assert!(schema["$schema"].is_string(), "{of}");
        assert!(schema["properties"][key].is_object(), "{of} has {key}");
    }
}

#[test]
fn joints_of_a_scene_fit_the_robot() {
    let scene = |joints: &str| {
        format!(r#"{{"motet_scene": 1, "robot": {{"joints": {{{joints}}}}}, "entities": []}}"#)
    };
    let place = Place::new("scene_joints")
        .file("far.json", scene(r#""arm_lift_joint": 2"#))
        .file("strange.json", scene(r#""torso_lift_joint": 0.1"#))
        .file("right.json", scene(r#""head_pan_joint": 0.1"#))
        .file("wait.motet", "policy idle { home() }\n");
    for (room, code, text) in
        [("far.json", 2, "out:M0428"), ("strange.json", 2, "out:M0427"), ("right.json", 0, "out:")]
    {
        println!("{room}");
        place.run(&format!("feasible --robot hsr --scene {room} --for posture(start)")).check(code, &[text]);
        place.run(&format!("check wait.motet --robot hsr --scene {room}")).check(code, &[text]);
    }
    // Of another robot's joints it is said that this one has none.
    place.run("check wait.motet --robot panda --scene right.json").check(2, &["out:M0427"]);
    // Without geometry nothing rests on them.
    place.run("check wait.motet --robot hsr --scene far.json --no-geometry").check(0, &[]);
}

const URDF: &str = "<robot name='Crane'><link name='base'/><link name='boom'/>
  <joint name='turn' type='revolute'><parent link='base'/><child link='boom'/>
  <limit lower='-1' upper='1' velocity='1' effort='1'/></joint></robot>";

#[test]
fn writes_a_first_card_and_checks_it() {
    let place = Place::new("robots_add")
        .file("crane/crane.urdf", URDF)
        .file("broken/robot.urdf", URDF.replace("base'/><child", "boom'/><child"))
        .file("sloppy/robot.urdf", URDF);
    place.run("robots add crane/crane.urdf").check(0, &["out:guesses", "out:motet robots check crane"]);
    assert!(place.read("crane/robot.toml").contains("urdf = \"crane.urdf\""));
    place.run("robots check crane").check(0, &["out:Crane (crane): no errors", "out:2 links"]);
    place.run("robots add crane/crane.urdf").check(2, &["err:exists already"]);
    place.run("robots add crane/crane.urdf --to other").check(0, &[]);
    place.run("robots check other").check(0, &["out:2 links"]);
    // A card of somebody else shows no file outside its folder and its packages.
    let card = place.read("crane/robot.toml").replace("urdf = \"crane.urdf\"", "urdf = \"/etc/hostname\"");
    let place = place.file("spy/robot.toml", card);
    place
        .run("robots check spy")
        .check(2, &["err:is not in the robot's folder", "err:`packages` of the card"]);
    place.run("robots add broken/robot.urdf").check(1, &["out:M0461"]);
    place.run("robots add nothing.urdf").check(2, &["err:cannot read"]);
    let place = place.file("latin/robot.urdf", [URDF.as_bytes(), b"<!-- f\xfcr -->"].concat());
    place.run("robots add latin/robot.urdf").check(1, &["out:M0114"]);
    assert!(!place.path("latin/robot.toml").exists());
    place.run("robots add sloppy/robot.urdf").check(0, &[]);
    let card = place.read("sloppy/robot.toml").replace("base = \"base\"", "base = \"bass\"");
    let place = place.file("sloppy/robot.toml", card);
    place.run("robots check sloppy").check(1, &["out:M0427", "out:did you mean `base`?"]);
}

/// Two links that touch where the joints are at rest, which an SRDF may allow; one is a mesh.
const ELBOW: &str = "<robot name='elbow'>
  <link name='base'><collision><geometry><box size='0.2 0.2 0.2'/></geometry></collision></link>
  <link name='boom'/>
  <link name='tip'><collision><geometry><mesh filename='package://elbow/tip.obj'/></geometry></collision>\
    </link>
  <joint name='turn' type='revolute'><parent link='base'/><child link='boom'/>
  <limit lower='-1' upper='1' velocity='1' effort='1'/></joint>
  <joint name='bend' type='prismatic'><parent link='boom'/><child link='tip'/><axis xyz='1 0 0'/>
  <limit lower='0' upper='1' velocity='1' effort='1'/></joint></robot>";

const TIP: &str = "v 0 0 0.15\nv 0.1 0 0.15\nv 0 0.1 0.15\nv 0 0 0.05\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";

#[test]
fn reads_what_a_card_says_of_the_body() {
    let place = Place::new("robots_body").file("elbow/robot.urdf", ELBOW).file("secret.obj", TIP);
    place.run("robots add elbow/robot.urdf").check(0, &[]);
    let card = place.read("elbow/robot.toml").replace("height = \"0 m\"", "height = \"1 m\"");
    place.run("robots check elbow").check(0, &["out:M0448", "out:the mesh of `tip` was not read"]);
    let with = |line: &str| card.replace("[model]", &format!("[model]\n{line}"));
    let place = place.file("elbow/robot.toml", with("packages = [\"packages\"]"));
    place.run("robots check elbow").check(0, &["out:packages/elbow/tip.obj", "out:M0448"]);
    // What lies elsewhere is not read, nor what is broken.
    let (out, own) = ("'../secret.obj'", "'package://elbow/tip.obj'");
    let place = place.file("elbow/robot.urdf", ELBOW.replace(own, out));
    place.run("robots check elbow").check(1, &["out:M0449", "out:neither"]);
    let place = place.file("elbow/robot.urdf", ELBOW).file("elbow/packages/elbow/tip.obj", "f 1 2 3\n");
    place.run("robots check elbow").check(1, &["out:M0449", "out:names"]);
    let place = place.file("elbow/packages/elbow/tip.obj", TIP);
    let said =
        ["out:no errors, 2 warnings\n", "out:warning: `", "out:help: ", "out:<disable_collisions link1="];
    place.run("robots check elbow").check(0, &said);
    // A folder is no mesh, nor is there a folder where none is.
    let place = place.file("elbow/robot.urdf", ELBOW.replace("tip.obj", "folder.obj"));
    let place = place.file("elbow/packages/elbow/folder.obj/inside", "");
    place.run("robots check elbow").check(1, &["out:M0449", "out:it is a folder or a device"]);
    let place = place.file("elbow/robot.urdf", ELBOW);
    let place = place.file("elbow/robot.toml", with("packages = [\"packages\", \"no\\nmore\"]"));
    place.run("robots check elbow").check(0, &["out:M0480", "out:`packages` names `no\\nmore`"]);
    // The SRDF says that they may.
    let place = place.file("elbow/robot.toml", with("packages = [\"packages\"]\nsrdf = \"robot.srdf\""));
    place.run("robots check elbow").check(1, &["out:M0450", "out:`srdf` is `robot.srdf`"]);
    place.run("feasible --robot elbow --scene kitchen --all").check(2, &["out:M0450"]);
    let srdf = "<robot name='elbow'><disable_collisions link1='base' link2='TOP'/></robot>";
    let place = place.file("elbow/robot.srdf", srdf);
    place.run("robots check elbow").check(1, &["out:M0472", "out:`TOP`"]);
    place.run("feasible --robot elbow --scene kitchen --all").check(2, &["out:M0472"]);
    let place = place.file("elbow/robot.srdf", srdf.replace("TOP", "tip"));
    place
        .run("robots check elbow")
        .check(0, &["out:no errors\n", "out:touches neither itself nor the floor"]);
}

/// An arm of three joints, the last link of which is in the base where every joint is at 0, and something
/// else that moves.
const FOLDED: &str = "<robot name='folded'>
  <link name='base'><collision><origin xyz='0 0 0.5'/><geometry><box size='0.2 0.2 0.2'/></geometry>\
    </collision></link>
  <link name='one'/><link name='two'/>
  <link name='tool0'><collision><origin xyz='-0.3 0 0'/><geometry><box size='0.6 0.05 0.05'/></geometry>\
    </collision></link>
  <link name='neck'/>
  <link name='lid'><collision><geometry><box size='0.2 0.2 0.02'/></geometry></collision></link>
  <joint name='turn' type='revolute'><origin xyz='0 0 0.5'/><parent link='base'/><child link='one'/><axis \
    xyz='0 0 1'/>
  <limit lower='-3' upper='3' velocity='1' effort='1'/></joint>
  <joint name='lift' type='revolute'><parent link='one'/><child link='two'/><axis xyz='0 1 0'/>
  <limit lower='-1' upper='0' velocity='1' effort='1'/></joint>
  <joint name='bend' type='revolute'><origin xyz='0.5 0 0'/><parent link='two'/><child link='tool0'/><axis \
    xyz='0 1 0'/>
  <limit lower='0' upper='3' velocity='1' effort='1'/></joint>
  <joint name='nod' type='continuous'><origin xyz='0 0 0.7'/><parent link='base'/><child link='neck'/></joint>
  <joint name='open' type='prismatic'><parent link='neck'/><child link='lid'/><axis xyz='0 0 -1'/>
  <limit lower='-0.5' upper='0.5' velocity='1' effort='1'/></joint></robot>";

#[test]
fn first_card_has_a_posture_that_touches_nothing() {
    let place = Place::new("robots_posture").file("folded/robot.urdf", FOLDED);
    let ran = place.run("robots add folded/robot.urdf");
    ran.check(0, &["out:wrote folded/robot.toml"]);
    assert!(!ran.stdout.contains("warning"), "{ran:#?}");
    assert!(
        !place.read("folded/robot.toml").contains("\"bend\" = 0\n"),
        "{}",
        place.read("folded/robot.toml")
    );
    place
        .run("robots check folded")
        .check(0, &["out:no errors\n", "out:home      touches neither itself nor the floor"]);
    // What the arm does not move is in the way in every posture.
    let place = place.file("shut/robot.urdf", FOLDED.replace("xyz='0 0 0.7'", "xyz='0 0 0.5'"));
    place
        .run("robots add shut/robot.urdf")
        .check(0, &["out:warning: `", "out:no posture without contact was found"]);
    assert!(place.read("shut/robot.toml").contains("# In it `"));
    place.run("robots check shut").check(0, &["out:no errors, 2 warnings\n", "out:touches `"]);
    // A shape of the arm that is below the floor wherever its joints are raises the base.
    let low = "<link name='one'><collision><origin xyz='0 0 -0.59'/><geometry><sphere radius='0.02'/>\
        </geometry></collision></link>";
    let place = place.file("low/robot.urdf", FOLDED.replace("<link name='one'/>", low));
    place.run("robots add low/robot.urdf").check(0, &["out:wrote low/robot.toml"]);
    assert!(place.read("low/robot.toml").contains("height = \"0.11"), "{}", place.read("low/robot.toml"));
    place.run("robots check low").check(0, &["out:no errors\n", "out:home      touches neither"]);
}

#[test]
fn first_card_stands_on_its_wheels() {
    let urdf = "<robot name='cart'><link name='base'/><link name='wheel'><collision><geometry><sphere \
        radius='0.1'/></geometry>
      </collision></link><joint name='wheel_joint' type='continuous'><origin xyz='0 0 -0.05'/><parent \
        link='base'/>
      <child link='wheel'/><axis xyz='0 1 0'/></joint></robot>";
    let place = Place::new("robots_height").file("cart/robot.urdf", urdf);
    place.run("robots add cart/robot.urdf").check(0, &[]);
    let card = place.read("cart/robot.toml");
    assert!(card.contains("height = \"0.15 m\"  # guessed"), "{card}");
    place.run("robots check cart").check(0, &["out:no errors\n", "out:touches neither itself nor the floor"]);
    // So far it may be out by rounding, and no farther.
    let place = place.file("cart/robot.toml", card.replace("0.15 m", "0.145 m"));
    place.run("robots check cart").check(0, &["out:no errors\n", "out:touches neither itself nor the floor"]);
    let place = place.file("cart/robot.toml", card.replace("0.15 m", "0.03 m"));
    let said = [
        "out:no errors, 2 warnings\n",
        "out:`wheel` is 0.12 m below the floor",
        "out:0.150 m puts this part",
    ];
    place.run("robots check cart").check(0, &said);
}

#[test]
fn first_card_is_made_with_the_srdf_beside_the_urdf() {
    let srdf = "<robot name='folded'><group name='arm'><chain base_link='base' tip_link='two'/></group>
      <group name='hand'><link name='tool0'/></group><end_effector name='hand' group='hand' \
        parent_link='tool0'/>
      <disable_collisions link1='base' link2='tool0'/></robot>";
    let place = Place::new("robots_srdf").file("a/robot.urdf", FOLDED).file("a/moveit.srdf", srdf);
    place.run("robots add a/robot.urdf").check(0, &["out:used the SRDF moveit.srdf"]);
    let card = place.read("a/robot.toml");
    assert!(card.contains("\nsrdf = \"moveit.srdf\"\n"), "{card}");
    assert!(card.contains("\ntip = \"tool0\"  # from the SRDF: the end effector `hand`\n"), "{card}");
    // What may touch does so in the posture with every joint at 0.
    assert!(card.contains("\"bend\" = 0\n"), "{card}");
    place.run("robots check a").check(0, &["out:no errors\n"]);
    // Of several, that of the URDF's name; none where no other is told from the rest.
    let place = place.file("b/robot.urdf", FOLDED).file("b/x.srdf", srdf).file("b/y.srdf", srdf);
    place.run("robots add b/robot.urdf --to b1").check(0, &[]);
    assert!(!place.read("b1/robot.toml").contains("srdf ="));
    place.run("robots add b/robot.urdf --to b2 --srdf b/y.srdf").check(0, &["out:used the SRDF"]);
    place.run("robots check b2").check(0, &["out:no errors\n"]);
    let place = place.file("b/robot.srdf", srdf.replace("'two'", "'too'"));
    place.run("robots add b/robot.urdf --to b3").check(1, &["out:M0472", "out:did you mean `two`?"]);
    assert!(!place.path("b3").exists());
}

/// The HSR's card under another roof, with one line replaced, and whether its own declarations lie beside it.
fn own_card(name: &str, from: &str, to: &str, declarations: Option<&str>) -> Place {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../robots/models/hsr");
    let read = |file: &str| std::fs::read_to_string(format!("{folder}/{file}")).unwrap();
    let card = read("robot.toml");
    assert_eq!(card.matches(from).count(), 1, "`{from}` stands once in the card");
    let place = Place::new(name).file("rb/robot.toml", card.replacen(from, to, 1));
    let place = place.file("rb/robot.urdf", read("robot.urdf")).file("p.motet", "policy p { go(user) }\n");
    match declarations {
        Some(text) => place.file("rb/primitives.motet", text),
        None => place,
    }
}

#[test]
fn card_is_compared_with_what_is_declared() {
    for (index, (from, to, said)) in [
        ("\"holding\",", "\"holdin\",", "M0406|rb/robot.toml:|did you mean `holding`?"),
        ("pick = {}", "pik = {}", "M0407|rb/robot.toml:|did you mean `pick`?"),
        ("pick = {}", "fetch = {}", "M0407|rb/robot.toml:|`fetch` is a policy"),
        ("turn.by", "turn.angle", "M0408|rb/robot.toml:|its parameters are `by`"),
        (
            "{ least = \"-360 deg\", greatest = \"360 deg\" }",
            "{ least = \"-1 m\", greatest = \"1 m\" }",
            "M0409|rb/robot.toml:|write both bounds in rad",
        ),
        ("voice = []\n", "", "M0410|rb/robot.toml:|there is no resource `voice`"),
        (
            "initially = [\"standing(robot)\"]",
            "initially = [\"standing(robot\"]",
            "M0446|rb/robot.toml:|is not a fact",
        ),
        (
            "initially = [\"standing(robot)\"]",
            "initially = [\"standin(robot)\"]",
            "M0446|rb/robot.toml:|did you mean `standing`?",
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let place = own_card(&format!("own_card_{index}"), from, to, None);
        for line in ["robots check rb", "check p.motet --robot rb"] {
            let code = if line.starts_with("robots") { 1 } else { 2 };
            let ran = place.run(line);
            ran.check(code, &[]);
            for text in said.split('|') {
                assert!(ran.stdout.contains(text), "{line}: {text:?} of {said}: {ran:#?}");
            }
            assert!(!ran.stdout.contains(":1:1]"), "{ran:#?}");
        }
    }
}

#[test]
fn declarations_beside_a_card_are_read_with_it() {
    for (name, text, code) in
        [("own_broken", "action wave( {\n", "M01"), ("own_unknown", "action wave()\n    uses wing\n", "M02")]
    {
        let place = own_card(name, "say = {}", "say = {}\nwave = {}", Some(text));
        let ran = place.run("robots check rb");
        ran.check(1, &["out:rb/primitives.motet:", &format!("out:{code}")]);
    }
    let place =
        own_card("own_good", "say = {}", "say = {}\nwave = {}", Some("action wave()\n    uses arm\n"));
    place.run("robots check rb").check(0, &["out:no errors"]);
}

#[test]
fn scenes_are_listed_shown_checked_and_drawn() {
    let place = Place::new("scenes").file(
        "bad.json",
        "{\"motet_scene\": 1, \"entities\": [{\"id\": \"cup\", \"kind\": \"Object\", \"on\": \"table\"}]}",
    );
    place.run("scenes").check(0, &["out:kitchen ", "out:lab ", "out: Surface"]);
    place.run("scenes show kitchen").check(0, &["out:mug_1 ", "out:on kitchen_table", "out:\"red mug\""]);
    place.run("scenes check kitchen --robot hsr").check(0, &["out:no errors", "out:hsr can act in it"]);
    place.run("scenes check bad.json").check(2, &["out:M0", "out:table"]);
    place.run("scenes draw kitchen --robot hsr -o kitchen.svg").check(0, &[]);
    assert!(place.read("kitchen.svg").starts_with("<svg"));
    place.run("scenes draw kitchen").check(2, &["err:give --robot"]);
    place.run("scenes show").check(2, &["err:no scene is named"]);
    place.run("scenes show kitchn").check(2, &["err:did you mean `kitchen`?"]);
}

#[test]
fn new_makes_a_folder_whose_policy_runs() {
    let place = Place::new("new");
    place.run("new help").check(0, &["out:motet.toml", "out:hello.motet", "err:run it: motet run"]);
    place.run("check help").check(0, &["err:no errors"]);
    place.run("run help/policies/hello.motet --speed max").check(0, &[]);
    place.run("new help").check(2, &["err:exists and is not empty"]);
    place
        .run("new arm --robot panda --scene lab --card")
        .check(0, &["out:robot.urdf", "out:primitives.motet"]);
    place.run("run arm/policies/hello.motet --speed max").check(0, &[]);
    place.run("new other --robot pandda").check(2, &["err:did you mean `panda`?"]);
}
