//! First cards: what is told from a URDF and an SRDF, and that a card is TOML whatever things are called.

use motet_robots::card::{self, Drive};
use motet_robots::srdf;
use motet_robots::urdf::{self, Urdf};
use motet_syntax::{FileId, Source};

fn read(text: &str) -> Urdf {
    urdf::read(&Source::new("robot.urdf", text), FileId(0)).0.unwrap()
}

/// A robot of links and of joints `TYPE PARENT CHILD AXIS`, each a decimetre above the one before; joints are
/// called after their children. A link has a shape where its name is in capitals.
fn made(links: &[&str], joints: &[&str]) -> Urdf {
    let shape = "<collision><geometry><sphere radius='0.02'/></geometry></collision>";
    let links = links.iter().map(|name| {
        let shape = if name.starts_with(|c: char| c.is_uppercase()) { shape } else { "" };
        format!("<link name='{name}'>{shape}</link>")
    });
    let joints = joints.iter().map(|joint| {
        let words: Vec<&str> = joint.split(' ').collect();
        let (kind, parent, child, axis) = (words[0], words[1], words[2], &words[3..]);
        format!(
            "<joint name='{child}_joint' type='{kind}'><origin xyz='0 0 0.1'/><parent link='{parent}'/>
            <child link='{child}'/><axis xyz='{}'/><limit lower='-1' upper='1' effort='1' \
                velocity='1'/></joint>",
            if axis.is_empty() { "0 0 1".to_owned() } else { axis.join(" ") }
        )
    });
    let text =
        format!("<robot name='made'>{}{}</robot>", links.collect::<String>(), joints.collect::<String>());
    read(&text)
}

/// The base's link, its drive, the tip of the hand and the joints of the posture `home` of a first card.
fn guessed(urdf: &Urdf, beside: &card::DraftInputs<'_>) -> (String, Drive, Option<String>, Vec<String>) {
    let toml = Source::new("robot.toml", card::draft(urdf, "robot.urdf", beside));
    let (robot, found) = card::read(&toml, FileId(0), None);
    assert_eq!((found, card::fit(&toml, FileId(0), urdf)), (vec![], vec![]), "{}", toml.text);
    let robot = robot.unwrap();
    let tip = robot.hands.first().and_then(|(_, hand)| hand.tip.as_ref()).map(ToString::to_string);
    let arm = robot.postures["home"].keys().map(ToString::to_string).collect();
    (robot.model.unwrap().base.unwrap().to_string(), robot.base.drive, tip, arm)
}

#[test]
fn draft_distinguishes_the_base_from_its_carriers() {
    const ARM: [&str; 3] = ["revolute BODY A 0 0 1", "revolute A B 0 1 0", "revolute B TOOL 0 1 0"];
    const LINKS: [&str; 5] = ["BODY", "A", "B", "TOOL", "body_imu_frame"];
    let check = |links: &[&str], joints: &[&str], base: &str, drive: Drive| {
        let urdf = made(&[&LINKS, links].concat(), &[joints, &["fixed TOOL body_imu_frame"], &ARM].concat());
        let (found, found_drive, tip, arm) = guessed(&urdf, &card::DraftInputs::default());
        assert_eq!((found.as_str(), found_drive), (base, drive), "{joints:?}");
        assert_eq!(tip.as_deref(), Some("TOOL"), "{joints:?}");
        let own = if base == "world" { 1 } else { 0 };
        assert_eq!(arm.len(), 3 + own, "{arm:?}");
    };
    let (x, y, turn) = ("prismatic odom x 1 0 0", "prismatic x y 0 1 0", "continuous y BODY 0 0 1");
    check(&["odom", "x", "y"], &[x, y, turn], "BODY", Drive::Omnidirectional);
    check(&["odom", "x"], &[x, "prismatic x BODY 0 -1 0"], "BODY", Drive::Omnidirectional);
    check(
        &["world", "odom"],
        &["fixed world odom", "planar odom BODY 0 0 1"],
        "BODY",
        Drive::Omnidirectional,
    );
    check(&["world"], &["fixed world BODY"], "BODY", Drive::Fixed);
    check(&["stand"], &["fixed stand BODY"], "stand", Drive::Fixed);
    // A joint that turns on the root is one of the arm's.
    check(&["world"], &["revolute world BODY 0 0 1"], "world", Drive::Fixed);
    // Beams make a machine of it.
    let (beam, y, turn) = ("prismatic odom X 1 0 0", "prismatic X y 0 1 0", "continuous y BODY 0 0 1");
    let urdf = made(&[&LINKS[..4], &["odom", "X", "y"]].concat(), &[&[beam, y, turn], &ARM[..]].concat());
    assert_eq!(guessed(&urdf, &card::DraftInputs::default()).0, "odom");
    let floating =
        "<robot name='a'><link name='world'/><link name='base'/><joint name='free' type='floating'>
        <parent link='world'/><child link='base'/></joint></robot>";
    assert_eq!(guessed(&read(floating), &card::DraftInputs::default()).0, "base");
}

#[test]
fn draft_takes_the_hand_of_the_srdf() {
    // Two arms, of which the left one is longer, and each has a link that is called a tip.
    let links = ["base", "l1", "l2", "l3", "l4", "l_tool0", "r1", "r2", "r3", "r_mount", "r_tcp", "r_pad"];
    let arms = [
        ["base l1 0 0 1", "l1 l2 0 1 0", "l2 l3 0 1 0", "l3 l4 0 0 1", "l4 l_tool0 1 0 0"],
        ["base r1 0 0 1", "r1 r2 0 1 0", "r2 r3 0 1 0", "", ""],
    ];
    let turning: Vec<String> = arms
        .iter()
        .flatten()
        .filter(|ends| !ends.is_empty())
        .map(|ends| format!("revolute {ends}"))
        .collect();
    let other = ["fixed r3 r_mount", "fixed r_mount r_tcp", "prismatic r_mount r_pad 1 0 0"];
    let joints: Vec<&str> = turning.iter().map(String::as_str).chain(other).collect();
    let urdf = made(&links, &joints);
    let tip = |srdf: &str| {
        let source = Source::new("robot.srdf", format!("<robot name='made'>{srdf}</robot>"));
        let (srdf, found) = srdf::read(&source, FileId(0), &urdf);
        assert_eq!(found, []);
        let srdf = srdf.unwrap();
        let beside = card::DraftInputs {
            srdf: Some((&srdf, "robot.srdf")),
            stance: None,
            ..card::DraftInputs::default()
        };
        let text = card::draft(&urdf, "robot.urdf", &beside);
        assert!(text.contains("\nsrdf = \"robot.srdf\"\n"), "{text}");
        let open = text.contains("\nopen = { \"r_pad_joint\" = ");
        (guessed(&urdf, &beside).2.unwrap(), text.contains("# from the SRDF: the e"), open)
    };
    let hand = "<group name='hand'><joint name='r_pad_joint'/></group>
        <end_effector name='hand' group='hand' parent_link='r_mount'/>";
    assert_eq!(tip(hand), ("r_tcp".to_owned(), true, true));
    assert_eq!(tip(&hand.replace("r_mount", "r_tcp")), ("r_tcp".to_owned(), true, true));
    let arm = "<group name='arm'><chain base_link='base' tip_link='r_mount'/></group>";
    assert_eq!(tip(arm), ("r_mount".to_owned(), true, false));
    // Of a group that ends nowhere, and of an end effector on no arm, nothing is taken.
    assert_eq!(tip(""), ("l_tool0".to_owned(), false, false));
    let base = hand.replace("r_mount", "base");
    assert_eq!(tip(&base).0, "l_tool0");
}

#[test]
fn other_arms_are_long_chains_and_short_ones_with_a_tool() {
    let links = [
        "base",
        "a1",
        "a2",
        "a3",
        "a_tool0",
        "a_finger",
        "b1",
        "b2",
        "b3",
        "b_end",
        "c1",
        "c_gripper",
        "c_gripper_finger",
        "d_neck",
        "d_camera",
        "e_suction_cup",
        "f_wheel",
        "f_tool",
        "door",
        "door_handle",
    ];
    let joints = [
        // The arm of the card, whose own fingers are no arm.
        "revolute base a1",
        "revolute a1 a2 0 1 0",
        "revolute a2 a3 0 1 0",
        "fixed a3 a_tool0",
        "prismatic a_tool0 a_finger 1 0 0",
        // A long one without a tool, and a gripper on two joints.
        "revolute base b1",
        "revolute b1 b2 0 1 0",
        "revolute b2 b3 0 1 0",
        "fixed b3 b_end",
        "revolute base c1",
        "revolute c1 c_gripper 0 1 0",
        "prismatic c_gripper c_gripper_finger 1 0 0",
        // Neither a neck nor a wheel nor a door is an arm; a suction cup on one joint is.
        "revolute base d_neck",
        "fixed d_neck d_camera",
        "prismatic base e_suction_cup",
        "continuous base f_wheel",
        "fixed f_wheel f_tool",
        "revolute base door",
        "fixed door door_handle",
    ];
    let urdf = made(&links, &joints);
    let arms = |tip: &str| -> Vec<(String, usize)> {
        card::other_arms(&urdf, tip).into_iter().map(|(tip, joints)| (tip.to_string(), joints)).collect()
    };
    let own = |tip: &str, joints: usize| (tip.to_owned(), joints);
    let short = [own("c_gripper", 2), own("e_suction_cup", 1)];
    assert_eq!(arms("a_tool0"), [&[own("b_end", 3)][..], &short].concat());
    assert_eq!(arms("c_gripper"), [own("b_end", 3), own("a_tool0", 3), own("e_suction_cup", 1)]);
    assert_eq!(arms(""), [&[own("b_end", 3), own("a_tool0", 3)][..], &short].concat());
}

#[test]
fn draft_is_valid_toml_for_any_names() {
    // What cannot be seen, turns the direction of writing, colours a terminal, combines, or ends a line.
    for odd in ["\u{200b}", "\u{202e}", "&#9;", "e\u{301}", "&quot;\\&apos;", "&#10;x", "\u{7f}", "\u{e0001}"]
    {
        let body: String = (0..4).map(|n| format!("<link name='gripper {odd}{n}'/>")).collect();
        let joint = |n: usize| {
            let ends = format!("<parent link='gripper {odd}{n}'/><child link='gripper {odd}{}'/>", n + 1);
            let limit = "<limit lower='0' upper='1' effort='1' velocity='1'/>";
            format!("<joint name='turn {odd}{n}' type='revolute'>{ends}{limit}</joint>")
        };
        let joints: String = (0..3).map(joint).collect();
        let urdf = read(&format!("<robot name='a{odd}'>{body}{joints}</robot>"));
        let toml = Source::new(
            "robot.toml",
            card::draft(&urdf, &format!("{}.urdf", urdf.name), &card::DraftInputs::default()),
        );
        let (robot, found) = card::read(&toml, FileId(0), None);
        assert_eq!(found, [], "{}", toml.text);
        assert_eq!(card::fit(&toml, FileId(0), &urdf), [], "{}", toml.text);
        let robot = robot.unwrap();
        assert_eq!((robot.title.as_str(), robot.postures["home"].len()), (urdf.name.as_str(), 3));
        assert_eq!(robot.hands[0].tip.as_deref(), Some(urdf.links[3].name.as_str()));
        let unseen = |c: char| c != '\n' && c.escape_debug().len() > 1 && !"\"\\'\u{301}".contains(c);
        assert!(!toml.text.contains(unseen), "{}", toml.text);
    }
}

#[test]
fn draft_takes_the_given_stance() {
    let urdf = made(
        &["BODY", "A", "B", "TOOL"],
        &["revolute BODY A", "revolute A B 0 1 0", "revolute B TOOL 0 1 0"],
    );
    let joints = [("A_joint".into(), 0.5), ("TOOL_joint".into(), -0.25), ("other".into(), 1.0)];
    let stance = card::DraftStance { height_m: 0.124, joints: joints.into_iter().collect(), touch: None };
    let read = |stance: card::DraftStance| {
        let text = card::draft(
            &urdf,
            "robot.urdf",
            &card::DraftInputs { srdf: None, stance: Some(stance), ..card::DraftInputs::default() },
        );
        (card::read(&Source::new("robot.toml", text.as_str()), FileId(0), None).0.unwrap(), text)
    };
    let (robot, text) = read(stance.clone());
    assert_eq!(robot.model.as_ref().unwrap().height_m, 0.124);
    let home: Vec<f64> = robot.postures["home"].values().copied().collect();
    assert_eq!((home, &robot.postures["start"]), (vec![0.5, 0.0, -0.25], &robot.postures["home"]));
    assert!(!text.contains("touches"), "{text}");
    let touch = Some(["A".into(), "one\nmore".into()]);
    let (_, text) = read(card::DraftStance { touch, ..stance });
    assert!(text.contains("# In it `A` touches `one\\nmore`"), "{text}");
}
