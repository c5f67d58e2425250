//! URDFs: published ones and our own are read as another reader reads them, every mistake is told at its
//! place, and no text makes the reader panic.

use std::path::{Path, PathBuf};

use motet_robots::builtin;
use motet_robots::card::{self, Drive};
use motet_robots::mesh;
use motet_robots::srdf;
use motet_robots::urdf::{self, JointKind, Urdf, UrdfShape};
use motet_syntax::{Diagnostic, FileId, Source};
use proptest::prelude::*;

/// A URDF without a mistake.
const GOOD: &str = r#"<?xml version="1.0"?>
<robot name="arm">
  <link name="base"><collision><geometry><box size="1 2 3"/></geometry></collision></link>
  <link name="upper"/>
  <link name="tip"/>
  <joint name="lift" type="prismatic">
    <parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.5" rpy="0 0 1.57"/>
    <axis xyz="0 0 2"/>
    <limit lower="-0.1" upper="0.4" velocity="0.2" effort="1"/>
    <safety_controller soft_lower_limit="0" soft_upper_limit="0" k_velocity="0"/>
  </joint>
  <joint name="follow" type="revolute">
    <parent link="upper"/><child link="tip"/>
    <axis xyz="1 0 0"/>
    <limit lower="-1" upper="1" velocity="1" effort="1"/>
    <mimic joint="lift" multiplier="0.5" offset="0.1"/>
  </joint>
</robot>
"#;

fn read(text: &str) -> (Option<Urdf>, Vec<Diagnostic>, Source) {
    let source = Source::new("robot.urdf", text);
    let (robot, found) = urdf::read(&source, FileId(0));
    (robot, found, source)
}

/// `GOOD` with `from` replaced by `to` says exactly this: lines of `CODE [text under the span] message /
/// help`.
fn check(from: &str, to: &str, expected: &[&str]) {
    assert_eq!(GOOD.matches(from).count(), 1, "`{from}` must stand once in the URDF");
    told(&GOOD.replacen(from, to, 1), expected);
}

fn told(text: &str, expected: &[&str]) {
    let (robot, found, source) = read(text);
    let told: Vec<String> = found
        .iter()
        .map(|found| {
            let help = found.help.as_ref().map(|help| format!(" / {help}")).unwrap_or_default();
            format!("{} [{}] {}{help}", found.code, source.slice(found.span), found.message)
        })
        .collect();
    assert_eq!(told, expected);
    assert_eq!(robot.is_some(), !told.iter().any(|line| !line.starts_with("M0468")));
}

#[test]
fn urdf_reader_reads_a_complete_robot() {
    let (robot, found, _) = read(GOOD);
    assert_eq!(found, []);
    let robot = robot.unwrap();
    assert_eq!((robot.name.as_str(), robot.root), ("arm", 0));
    let [lift, follow] = robot.joints.as_slice() else { panic!("two joints") };
    assert_eq!((lift.kind, lift.axis), (JointKind::Prismatic, [0.0, 0.0, 1.0]));
    let limits = lift.limits.unwrap();
    assert_eq!((limits.lower, limits.upper), (-0.1, 0.4), "from `<limit>`, not from the safety controller");
    let mimic = follow.mimic.unwrap();
    assert_eq!((mimic.joint, mimic.multiplier, mimic.offset), (0, 0.5, 0.1));
    assert_eq!(robot.links[0].collisions[0].shape, UrdfShape::Box([1.0, 2.0, 3.0]));
}

#[test]
fn urdf_limits_include_those_of_followers() {
    // The follower is at half of it and 0.1 more.
    let narrow = GOOD.replace(r#"lower="-1" upper="1""#, r#"lower="0" upper="0.2""#);
    let limits = read(&narrow).0.unwrap().joints[0].limits.unwrap();
    assert_eq!((limits.lower, limits.upper), (-0.1, 0.2));
    let against = narrow.replace(r#"multiplier="0.5""#, r#"multiplier="-0.5""#);
    let limits = read(&against).0.unwrap().joints[0].limits.unwrap();
    assert_eq!((limits.lower, limits.upper), (-0.1, 0.2));
    let nowhere = narrow.replace(r#"offset="0.1""#, r#"offset="0.5""#);
    told(
        &nowhere,
        &["M0465 [lift] the limits of joint `lift` and of the joints that mimic it exclude each other: it \
                must be at least -0.1 and at most -0.6 / widen the limits of the joints that mimic it, or \
                correct their `<mimic>`"],
    );
}

#[test]
fn urdf_reader_reports_wrong_numbers() {
    check(
        "0 0 0.5",
        "abc 1 2 3",
        &["M0456 [abc 1 2 3] `xyz` is `abc 1 2 3`, but must be three numbers / write decimal numbers with \
                a point, with spaces between them"],
    );
    check(
        "0 0 1.57",
        "0 0",
        &["M0456 [0 0] `rpy` is `0 0`, but must be three numbers / write decimal numbers with a point, \
                with spaces between them"],
    );
    check("0 0 1.57", "0 NaN 0", &["M0457 [0 NaN 0] `rpy` is NaN, but must be a finite number"]);
    check("0 0 0.5", "0 0 5e7", &["M0457 [0 0 5e7] `xyz` is 50000000, but must be at most a million"]);
    check(
        "0 0 2",
        "0 0 0",
        &["M0464 [0 0 0] the axis of joint `lift` has length 0, so it has no direction / write a direction \
                such as `0 0 1`"],
    );
    check("1 2 3", "1 -2 3", &["M0457 [1 -2 3] `size` is -2, but must be zero or more"]);
    check(
        r#"lower="-0.1""#,
        r#"lower="0.5""#,
        &["M0465 [0.5] the lower limit of joint `lift` is 0.5, above the upper, 0.4 / swap them"],
    );
    check(r#"lower="-0.1""#, r#"lower="inf""#, &["M0457 [inf] `lower` is inf, but must be a finite number"]);
}

#[test]
fn urdf_reader_reports_missing_parts() {
    check(
        r#"<box size="1 2 3"/>"#,
        "<sphere/>",
        &["M0455 [<sphere] `<sphere>` has no `radius` / add `radius=\"…\"`"],
    );
    check(
        r#"<box size="1 2 3"/>"#,
        "",
        &["M0469 [<geometry] the geometry has no shape / possible here: `box`, `cylinder`, `sphere`, \
                `capsule` or `mesh`"],
    );
    check(
        r#"<box size="1 2 3"/>"#,
        "<bok/>",
        &["M0469 [<bok] there is no shape `bok` / did you mean `box`?"],
    );
    check(
        r#"<parent link="base"/>"#,
        "",
        &["M0455 [<joint] joint `lift` has no `<parent>` / add `<parent …/>`"],
    );
    check(
        r#"type="prismatic""#,
        r#"type="prismtic""#,
        &["M0463 [prismtic] there is no joint type `prismtic` / did you mean `prismatic`?"],
    );
    check(
        "<limit lower=\"-0.1\" upper=\"0.4\" velocity=\"0.2\" effort=\"1\"/>",
        "",
        &["M0455 [<joint] joint `lift` has no `<limit>` / add `<limit …/>`"],
    );
    check(
        r#"<robot name="arm">"#,
        "<robot name=\"arm\"><link/>",
        &["M0455 [<link] `<link>` has no `name` / add `name=\"…\"`"],
    );
}

#[test]
fn urdf_reader_reports_links_that_form_no_tree() {
    check(
        r#"<child link="tip"/>"#,
        r#"<child link="tipp"/>"#,
        &["M0459 [tipp] there is no link `tipp` / did you mean `tip`?"],
    );
    check(
        r#"<child link="tip"/>"#,
        r#"<child link="upper"/>"#,
        &["M0460 [upper] link `upper` is the child of joint `lift` and of joint `follow` / a URDF is a \
                tree: remove one of the joints, or give it a child link of its own"],
    );
    check(
        r#"<parent link="base"/>"#,
        r#"<parent link="tip"/>"#,
        &["M0461 [upper] links form a cycle: `upper`, `tip` / a URDF is a tree: remove one of the joints"],
    );
    check(
        r#"<link name="tip"/>"#,
        r#"<link name="tip"/><link name="lost"/>"#,
        &["M0462 [lost] no joint connects link `lost` to link `base` / add a joint whose child is `lost`, \
                or remove the link"],
    );
    check(
        r#"<link name="tip"/>"#,
        r#"<link name="tip"/><link name="base"/>"#,
        &["M0458 [base] there are two links `base` / give each link a name of its own"],
    );
    check(
        r#"name="follow""#,
        r#"name="lift""#,
        &["M0458 [lift] there are two joints `lift` / give each joint a name of its own"],
    );
    told("<robot name='x'/>", &["M0470 [<robot] the robot has no link / add `<link name=\"base_link\"/>`"]);
}

#[test]
fn diagnostics_escape_line_breaks_in_names() {
    let (_, found, _) = read("<robot><link name='a&#10;b'/><link name='c&#10;d'/></robot>");
    assert_eq!(found[0].message, "no joint connects link `c\\nd` to link `a\\nb`");
    assert!(found.iter().all(|found| !found.help.as_ref().unwrap().contains('\n')));
}

#[test]
fn urdf_reader_reports_mimic_cycles() {
    check(
        r#"<mimic joint="lift""#,
        r#"<mimic joint="follow""#,
        &["M0467 [follow] joint `follow` mimics itself / remove the `<mimic>` of one of them"],
    );
    check(
        r#"<mimic joint="lift""#,
        r#"<mimic joint="lifts""#,
        &["M0466 [lifts] joint `follow` mimics `lifts`, which is not a joint / did you mean `lift`?"],
    );
    check(
        "<axis xyz=\"0 0 2\"/>",
        "<axis xyz=\"0 0 2\"/><mimic joint=\"follow\"/>",
        &["M0467 [follow] joints mimic each other in a cycle: `lift`, `follow` / remove the `<mimic>` of \
                one of them"],
    );
}

#[test]
fn urdf_reader_reports_other_documents() {
    told(
        "<robot>",
        &["M0451 [] this is not XML: the root node was opened but never closed / a URDF is an XML document \
                whose root element is `<robot>`"],
    );
    told("<sdf/>", &["M0453 [<sdf] the root element is `<sdf>`, a URDF starts with `<robot>`"]);
    let help = "run `xacro robot.urdf.xacro > robot.urdf` and pass the result";
    check(
        "0 0 0.5",
        "0 0 ${height}",
        &[&format!(
            "M0454 [0 0 ${{height}}] `0 0 ${{height}}` belongs to xacro: this file has not been expanded / \
                {help}"
        )],
    );
    let macros = "<robot name='a' xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:include \
        filename='x'/><link name='a'/></robot>";
    told(
        macros,
        &[&format!(
            "M0454 [<xacro:include] `xacro:include` belongs to xacro: this file has not been expanded / \
                {help}"
        )],
    );
    told(
        "<robot><xacro:arm/></robot>",
        &[&format!("M0454 [] `xacro:` belongs to xacro: this file has not been expanded / {help}")],
    );
    let entity = "<!DOCTYPE robot [<!ENTITY a 'b'>]><robot><link name='&a;'/></robot>";
    assert_eq!(read(entity).1[0].code.0, "M0451");
}

#[test]
fn floating_joint_is_held_with_a_warning() {
    let text = "<robot><link name='world'/><link name='base'/><joint name='free' type='floating'><parent \
        link='world'/><child link='base'/></joint></robot>";
    told(
        text,
        &["M0468 [free] joint `free` is floating; it stays at its origin / the robot's card says how its \
                base drives"],
    );
}

#[test]
fn urdf_reader_refuses_documents_beyond_limits() {
    let deep = |n: usize| format!("<robot>{}{}</robot>", "<a>".repeat(n), "</a>".repeat(n));
    assert_eq!(read(&deep(100_000)).1[0].code.0, "M0452");
    assert_eq!(read(&deep(63)).1[0].code.0, "M0470");
    assert_eq!(read(&deep(64)).1[0].code.0, "M0452");
    let wide = format!("<robot>{}</robot>", "<a/>".repeat(300_000));
    assert_eq!(read(&wide).1[0].code.0, "M0452");
    let crowded: String = (0..300).map(|n| format!(" a{n}=''")).collect();
    assert_eq!(read(&format!("<robot><link{crowded}/></robot>")).1[0].code.0, "M0452");
    // A chain of as many links as fit is no deeper than any other robot.
    let links: String = (0..9_000).map(|n| format!("<link name='l{n}'/>")).collect();
    let joints: String = (1..9_000)
        .map(|n| {
            format!("<joint name='j{n}' type='fixed'><parent link='l{}'/><child link='l{n}'/></joint>", n - 1)
        })
        .collect();
    let (robot, found, _) = read(&format!("<robot>{links}{joints}</robot>"));
    assert_eq!((found, robot.unwrap().joints.len()), (vec![], 8_999));
}

#[test]
fn locate_searches_packages_without_a_shell() {
    let search = ["/ros/share".to_owned(), "/my/arm_description/".to_owned()];
    let locate = |file: &str| mesh::locate(file, "/robots/arm", &search);
    assert_eq!(
        locate("package://arm_description/meshes/a.stl"),
        [
            "/my/arm_description/meshes/a.stl",
            "/ros/share/arm_description/meshes/a.stl",
            "/my/arm_description/arm_description/meshes/a.stl"
        ]
    );
    assert_eq!(locate("meshes/a.stl"), ["/robots/arm/meshes/a.stl"]);
    assert_eq!(locate("file:///tmp/a.stl"), ["/tmp/a.stl"]);
    assert_eq!(locate("/tmp/a.stl"), ["/tmp/a.stl"]);
    assert!(locate("package://arm/../../etc/passwd").is_empty());
    assert_eq!(locate("package://$(id)/a.stl")[0], "/ros/share/$(id)/a.stl");
}

fn draft(urdf: &Urdf, file: &str) -> String {
    card::draft(urdf, file, &card::DraftInputs::default())
}

/// URDFs in the folders of a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = |folder: &Path| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let folders = entries(folder).filter(|path| path.is_dir());
    let mut files: Vec<PathBuf> = folders.flat_map(|folder| entries(&folder).collect::<Vec<_>>()).collect();
    files.retain(|path| path.extension().is_some_and(|end| end == "urdf"));
    files.sort();
    assert!(files.len() >= 3, "{}", folder.display());
    files
}

fn agree_with_urdf_rs(folder: &Path) {
    for path in files(folder) {
        let text = std::fs::read_to_string(&path).unwrap();
        let (robot, found, _) = read(&text);
        assert!(found.is_empty(), "{}: {found:?}", path.display());
        same(&robot.unwrap(), &urdf_rs::read_from_string(&text).unwrap());
    }
}

#[test]
fn urdf_reader_agrees_with_urdf_rs_on_builtin_robots() {
    agree_with_urdf_rs(&models());
}

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn urdf_reader_agrees_with_urdf_rs_on_published_robots() {
    agree_with_urdf_rs(&published());
}

fn models() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("models")
}

fn published() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data/robots/urdf")
}

fn same(ours: &Urdf, theirs: &urdf_rs::Robot) {
    let names = |urdf: &Urdf| urdf.links.iter().map(|link| link.name.to_string()).collect::<Vec<_>>();
    assert_eq!(names(ours), theirs.links.iter().map(|link| link.name.clone()).collect::<Vec<_>>());
    assert_eq!(ours.joints.len(), theirs.joints.len());
    for (link, other) in ours.links.iter().zip(&theirs.links) {
        assert_eq!(link.collisions.len(), other.collision.len(), "{}", link.name);
        assert_eq!(link.visuals.len(), other.visual.len(), "{}", link.name);
    }
    for joint in &ours.joints {
        let other = theirs.joints.iter().find(|other| other.name == joint.name.as_str()).unwrap();
        assert_eq!(ours.links[joint.parent].name, other.parent.link);
        assert_eq!(ours.links[joint.child].name, other.child.link);
        assert_eq!(joint.parent_from_joint.xyz, other.origin.xyz.0);
        assert_eq!(format!("{:?}", joint.kind), format!("{:?}", other.joint_type));
        if let Some(limits) = joint.limits {
            let theirs = (other.limit.lower, other.limit.upper);
            let index = ours.joint(&joint.name);
            if ours.joints.iter().any(|follower| follower.mimic.map(|mimic| mimic.joint) == index) {
                assert!(theirs.0 <= limits.lower && limits.upper <= theirs.1, "{}", joint.name);
            } else {
                assert_eq!((limits.lower, limits.upper), theirs);
            }
        }
        if joint.kind != JointKind::Fixed {
            assert_eq!(joint.axis, other.axis.xyz.0, "{}", joint.name);
        }
        let mimic = joint
            .mimic
            .map(|mimic| (ours.joints[mimic.joint].name.to_string(), mimic.multiplier, mimic.offset));
        let other = other.mimic.as_ref().filter(|_| joint.kind != JointKind::Fixed);
        let other = other
            .map(|mimic| (mimic.joint.clone(), mimic.multiplier.unwrap_or(1.0), mimic.offset.unwrap_or(0.0)));
        assert_eq!(mimic, other);
    }
}

proptest! {
    /// Whatever is done to a good URDF, it is read or something is said, at a place within the text.
    #[test]
    fn urdf_reader_never_panics(at in 0..GOOD.len(), cut in 0..40_usize, put in "[<>/\"a-z0-9 &;.-]{0,8}") {
        let mut text = GOOD[..at].to_owned() + &put;
        text.push_str(GOOD.get(at + cut..).unwrap_or_default());
        let (robot, found, _) = read(&text);
        prop_assert!(robot.is_some() || !found.is_empty());
        for said in found {
            prop_assert!(said.span.end as usize <= text.len(), "{said:?}");
        }
    }
}

#[test]
fn draft_fits_urdfs_of_builtin_robots() {
    drafts_fit(&models());
}

#[test]
#[ignore = "needs the reference data in ../shared/data"]
fn draft_fits_published_urdfs() {
    drafts_fit(&published());
}

fn drafts_fit(folder: &Path) {
    for path in files(folder) {
        let text = std::fs::read_to_string(&path).unwrap();
        let urdf = read(&text).0.unwrap();
        let toml = Source::new("robot.toml", draft(&urdf, "robot.urdf"));
        let (robot, found) = card::read(&toml, FileId(0), None);
        assert_eq!(found, [], "{}\n{}", path.display(), toml.text);
        assert_eq!(card::fit(&toml, FileId(0), &urdf), [], "{}", path.display());
        let model = robot.unwrap().model.unwrap();
        assert_eq!(model.urdf, "robot.urdf");
    }
}

#[test]
fn draft_finds_base_hand_and_camera() {
    for (name, drive, tip, frame) in [
        ("hsr", Drive::Fixed, "hand_palm_link", Some("head_rgbd_sensor_link")),
        ("anymal_z1", Drive::Legged, "hand_tip", Some("wrist_camera")),
        ("panda", Drive::Fixed, "panda_hand_tcp", Some("wrist_camera")),
    ] {
        let urdf = builtin::robot(name).unwrap().urdf;
        let robot = card::read(&Source::new(name, draft(&urdf, "robot.urdf")), FileId(0), None).0.unwrap();
        let found = robot.hands.first().and_then(|(_, hand)| hand.tip.as_deref());
        assert_eq!((robot.base.drive, found), (drive, Some(tip)), "{name}");
        assert_eq!(robot.cameras.first().and_then(|(_, camera)| camera.frame.as_deref()), frame, "{name}");
    }
    let panda = draft(&builtin::robot("panda").unwrap().urdf, "robot.urdf");
    assert!(panda.contains("\nopen = { \"panda_finger_joint1\" = 0.04"), "{panda}");
    let block = read("<robot name='7 up!'><link name='base'/></robot>").0.unwrap();
    let card = draft(&block, "robot.urdf");
    let robot = card::read(&Source::new("card", card), FileId(0), None).0.unwrap();
    assert_eq!((robot.name.as_str(), robot.hands.len()), ("robot_7_up", 0));
}

#[test]
fn draft_is_linear_in_a_long_chain() {
    let links: String = (0..9_000).map(|n| format!("<link name='l{n}'/>")).collect();
    let joints: String = (1..9_000)
        .map(|n| {
            format!("<joint name='j{n}' type='fixed'><parent link='l{}'/><child link='l{n}'/></joint>", n - 1)
        })
        .collect();
    let urdf = read(&format!("<robot name='chain'>{links}{joints}</robot>")).0.unwrap();
    assert!(draft(&urdf, "robot.urdf").contains("name = \"chain\""));
}

#[test]
fn srdf_reader_resolves_names_in_the_urdf() {
    let (urdf, _, _) = read(GOOD);
    let urdf = urdf.unwrap();
    let srdf = |text: &str| {
        let source = Source::new("robot.srdf", text);
        let (srdf, found) = srdf::read(&source, FileId(0), &urdf);
        let told: Vec<String> = found
            .iter()
            .map(|found| format!("{} [{}] {}", found.code, source.slice(found.span), found.message))
            .collect();
        (srdf, told)
    };
    let text = "<robot name='arm'>
        <group name='arm'><chain base_link='base' tip_link='tip'/><joint name='lift'/></group>
        <group name='hand'><link name='tip'/></group><group name='all'><group name='arm'/></group>
        <end_effector name='gripper' group='hand' parent_link='upper'/>
        <disable_collisions link1='tip' link2='upper' reason='Adjacent'/>
        <disable_collisions link1='upper' link2='tip'/></robot>";
    let (found, told) = srdf(text);
    assert!(told.is_empty(), "{told:?}");
    let found = found.unwrap();
    assert_eq!((found.groups["arm"].chains[0], found.groups["arm"].joints[0]), ([0, 2], 0));
    assert_eq!(found.groups["all"].groups, ["arm"]);
    assert_eq!((found.end_effectors["gripper"].parent, found.disabled), (1, vec![[1, 2]]));
    let (_, told) = srdf(&text.replace("parent_link='upper'", "parent_link='uper'"));
    assert_eq!(told, ["M0472 [uper] there is no link `uper`"]);
    let (_, told) = srdf(&text.replace("group='hand'", "group='hands'"));
    assert_eq!(told, ["M0472 [hands] there is no group `hands`"]);
    let (_, told) = srdf(&text.replace("name='hand'>", "name='arm'>"));
    assert_eq!(told, ["M0477 [arm] there are two groups `arm`", "M0472 [hand] there is no group `hand`"]);
    let end = "<end_effector name='gripper' group='arm' parent_link='tip'/></robot>";
    let (_, told) = srdf(&text.replace("</robot>", end));
    assert_eq!(told, ["M0477 [gripper] there are two end effectors `gripper`"]);
    let (found, told) = srdf(
        "<robot><group name='a'><group name='b'/></group><group name='b'><group name='a'/></group></robot>",
    );
    assert_eq!(
        (found, told),
        (None, vec!["M0478 [a] a group contains itself: `a` contains `b` contains `a`".to_owned()])
    );
    let (_, told) = srdf("<robot><group name='a'><group name='a'/></group></robot>");
    assert_eq!(told, ["M0478 [a] a group contains itself: `a` contains `a`"]);
    // Two ways to one group are no ring.
    let two = "<robot><group name='c'/><group name='b'><group name='c'/></group><group name='a'><group \
        name='b'/><group name='c'/></group></robot>";
    assert!(srdf(two).1.is_empty());
    let (found, told) = srdf("<robot><disable_colisions link1='tip' link2='upper'/><virtual_joint/></robot>");
    assert_eq!(told, ["M0474 [<disable_colisions] unknown element `<disable_colisions>` is ignored"]);
    assert_eq!(found.unwrap().disabled, [[0; 2]; 0]);
    let empty = srdf::read(&Source::new("robot.srdf", ""), FileId(0), &urdf).1;
    assert_eq!(empty[0].help.as_deref(), Some("an SRDF is an XML document whose root element is `<robot>`"));
    assert_eq!(srdf("<sdf/>").1, ["M0471 [<sdf] the root element is `<sdf>`, an SRDF starts with `<robot>`"]);
}
