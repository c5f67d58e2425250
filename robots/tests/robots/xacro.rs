//! Expansion of xacros: what it means, and what it refuses.

use motet_robots::xacro::{XacroFiles, expand};

/// Files by name.
struct Files(Vec<(&'static str, &'static str)>);

impl XacroFiles for Files {
    fn read(&mut self, path: &str) -> Result<String, String> {
        let found = self.0.iter().find(|(name, _)| *name == path);
        found.map(|(_, text)| (*text).to_owned()).ok_or_else(|| format!("there is no `{path}`"))
    }

    fn package(&mut self, name: &str) -> Option<String> {
        (name == "arms").then(|| "/ros/arms".to_owned())
    }
}

fn files() -> Files {
    Files(vec![
        (
            "/ros/arms/link.xacro",
            r#"<robot xmlns:xacro="http://ros.org/wiki/xacro">
            <xacro:macro name="part" params="name side:=left mass:=^|2 *origin **more">
              <link name="${name}_${side}"><xacro:insert_block name="origin"/><mass value="${mass / 2}"/>
              <xacro:insert_block name="more"/></link></xacro:macro></robot>"#,
        ),
        ("/ros/arms/limits.yaml", "lift: {upper: !degrees 90, names: [a, b]}\n"),
    ])
}

/// Expansion of what stands in a robot, without line breaks.
fn of(inside: &str) -> Result<String, String> {
    let text = format!(r#"<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="r">{inside}</robot>"#);
    let urdf = expand("/ros/r.xacro", &text, &[("kind".to_owned(), "b".to_owned())], &mut files())?;
    let start = r#"<?xml version="1.0"?><robot name="r">"#;
    let flat = urdf.replace('\n', "");
    Ok(flat.strip_prefix(start).and_then(|rest| rest.strip_suffix("</robot>")).unwrap_or(&flat).to_owned())
}

#[test]
fn macros_take_values_defaults_and_blocks() {
    let call = r#"<xacro:include filename="$(find arms)/link.xacro"/><xacro:property name="mass" value="6"/>
        <xacro:part name="upper"><origin xyz="0 0 ${mass}"/><box><a/><b/></box></xacro:part>"#;
    let expected = r#"<link name="upper_left"><origin xyz="0 0 6"/><mass value="3.0"/><a/><b/></link>"#;
    assert_eq!(of(call).unwrap(), expected);
}

#[test]
fn arguments_conditions_files_and_texts() {
    let text = r#"<xacro:arg name="kind" default="a"/><xacro:arg name="size" default="0.5"/>
        <xacro:property name="limits" value="${load_yaml('$(find arms)/limits.yaml')}"/>
        <xacro:if value="${'$(arg kind)' == 'b'}">
        <limit upper="${limits['lift']['upper']}" n="${limits.lift.names[1]}"/></xacro:if>
        <xacro:unless value="$(arg size)"><never/></xacro:unless>
        <note text="$${x} &lt; ${1 + 2 * $(arg size)}"/>"#;
    let expected = r#"<limit upper="1.5707963267948966" n="b"/><note text="${x} &lt; 2.0"/>"#;
    assert_eq!(of(text).unwrap(), expected);
}

#[test]
fn properties_have_scopes() {
    let text = r#"<xacro:property name="later" value="${base * 2}"/><xacro:property name="base" value="4"/>
        <xacro:macro name="m" params=""><xacro:property name="base" value="1"/><in v="${base}"/>
        <xacro:property name="out" value="${base + 1}" scope="parent"/></xacro:macro>
        <xacro:m/><after v="${base} ${out} ${later}"/>"#;
    assert_eq!(of(text).unwrap(), r#"<in v="1"/><after v="4 2 8"/>"#);
}

#[test]
fn mistakes_have_their_file_and_line() {
    let why = |inside: &str| of(inside).unwrap_err();
    assert_eq!(
        why("\n<a b=\"${missing}\"/>"),
        "/ros/r.xacro, line 2: `${missing}`: the name `missing` is not defined"
    );
    assert_eq!(why("<xacro:arm/>"), "/ros/r.xacro, line 1: there is no macro `arm`");
    assert_eq!(
        why(r#"<xacro:include filename="$(find legs)/a.xacro"/>"#),
        "/ros/r.xacro, line 1: the package `legs` is nowhere; give `--packages FOLDER`"
    );
    assert_eq!(
        why(r#"<xacro:include filename="a.xacro"/>"#),
        "/ros/r.xacro, line 1: there is no `/ros/a.xacro`"
    );
    let part = r#"<xacro:include filename="$(find arms)/link.xacro"/><xacro:part size="1"/>"#;
    assert_eq!(why(part), "/ros/r.xacro, line 1: the macro `part` has no parameter `size`");
    let part = r#"<xacro:include filename="$(find arms)/link.xacro"/><xacro:part name="x"><a/></xacro:part>"#;
    assert_eq!(why(part), "/ros/r.xacro, line 1: the block `more` is missing");
    assert!(why(r#"<a b="$(arg other)"/>"#).contains("`--arg other:=VALUE`"));
    assert!(why(r#"<a b="$(env HOME)"/>"#).contains("is not expanded"));
    assert!(why(r#"<xacro:if value="maybe"/>"#).contains("`maybe` is no truth"));
}

#[test]
fn descriptions_without_an_end_are_refused() {
    let again = r#"<xacro:macro name="m" params=""><xacro:m/></xacro:macro><xacro:m/>"#;
    assert!(of(again).unwrap_err().contains("nested more than 100 deep"));
    let circle =
        r#"<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/><x v="${a}"/>"#;
    assert!(of(circle).is_err());
    // Each macro calls the one before it ten times.
    let mut wide = r#"<xacro:macro name="m0" params=""><a/></xacro:macro>"#.to_owned();
    for level in 1..9 {
        let calls = format!("<xacro:m{}/>", level - 1).repeat(10);
        wide.push_str(&format!(r#"<xacro:macro name="m{level}" params="">{calls}</xacro:macro>"#));
    }
    wide.push_str("<xacro:m8/>");
    assert!(of(&wide).unwrap_err().contains("grows beyond all bounds"));
}
