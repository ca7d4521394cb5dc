//! Every fault of a URDF at its place, and hostile text.

use super::super::{FileId, Flange, parse};
use super::{KR210, text};
use proptest::prelude::*;

/// Edits of the KUKA's text, the message that follows, and the text that it points at.
const FAULTS: &[(&str, &str, &str, &str)] = &[
    (
        "</robot>",
        "",
        "the file is not well-formed XML: the root node was opened but never closed",
        "",
    ),
    (
        "<!-- written for tests -->",
        "<!DOCTYPE robot>",
        "the file has a document type declaration",
        "",
    ),
    (
        "<robot name=\"arm\">",
        "<robot xmlns:xacro=\"http://wiki.ros.org/xacro\"><xacro:arm/>",
        "the file is xacro, not URDF",
        "<xacro:arm",
    ),
    ("robot", "sdf", "the file is not a URDF", "<sdf"),
    ("name=\"joint_a1\" ", "", "`joint` has no `name`", "<joint"),
    (
        "\"joint_a1\" type=\"revolute\"",
        "\"joint_a1\" type=\"hinge\"",
        "`hinge` is not a kind of joint",
        "hinge",
    ),
    (
        "\"joint_a3\" type=\"revolute\"",
        "\"joint_a3\" type=\"prismatic\"",
        "joint `joint_a3` on the way to the flange is prismatic, not revolute",
        "prismatic",
    ),
    (
        "\"joint_a3\" type=\"revolute\"",
        "\"joint_a3\" type=\"fixed\"",
        "the way to the flange `tool0` has 5 rotary joints instead of six",
        "tool0",
    ),
    (
        "type=\"fixed\">\n    <origin xyz=\"0 0 0\" rpy=\"0 1.57",
        "type=\"continuous\">\n    <origin xyz=\"0 0 0\" rpy=\"0 1.57",
        "the way to the flange `tool0` has 7 rotary joints instead of six",
        "tool0",
    ),
    (
        "<parent link=\"link_1\"/>",
        "",
        "`joint` has no `parent`",
        "<joint",
    ),
    (
        "<child link=\"link_1\"/>",
        "<child/>",
        "`child` has no `link`",
        "<child",
    ),
    (
        "<parent link=\"link_1\"/>",
        "<parent link=\"link_9\"/>",
        "there is no link `link_9`",
        "link_9",
    ),
    (
        "<child link=\"link_2\"/>",
        "<child link=\"link_1\"/>",
        "link `link_1` is carried by two joints",
        "link_1",
    ),
    (
        "<link name=\"link_2\">",
        "<link name=\"link_1\">",
        "a second link is called `link_1`",
        "link_1",
    ),
    (
        "\"joint_a2\"",
        "\"joint_a1\"",
        "a second joint is called `joint_a1`",
        "joint_a1",
    ),
    (
        "<link name=\"link_2\">",
        "<link name=\"stray\"/><link name=\"link_2\">",
        "link `stray` is not joined to `base_link`",
        "stray",
    ),
    (
        "<parent link=\"base_link\"/>\n    <child link=\"link_1\"/>",
        "<parent link=\"link_6\"/>\n    <child link=\"link_1\"/>",
        "link `link_1` hangs on a loop of joints",
        "link_1",
    ),
    (
        "<link name=\"link_3\">",
        "<link name=\"link_3\"><inertial/>",
        "`inertial` has no `mass`",
        "<inertial",
    ),
    (
        "<link name=\"link_3\">",
        "<link name=\"link_3\"><inertial><mass value=\"-2\"/></inertial>",
        "`value` of `mass` is -2",
        "-2",
    ),
    (
        "<link name=\"link_3\">",
        "<link name=\"link_3\"><inertial><origin xyz=\"0 0 300\"/><mass value=\"2\"/></inertial>",
        "the centre of mass lies more than 100 m from its link",
        "0 0 300",
    ),
    (
        "<link name=\"link_3\">",
        "<link name=\"link_3\"><inertial><mass value=\"2\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\"/></inertial>",
        "`inertia` has no `iyz`",
        "<inertia",
    ),
    ("0 0 0.675", "0 0.675", "`xyz` is not three numbers", "0 0.675"),
    (
        "0 0 0.675",
        "0 0 ${height}",
        "`xyz` is not three numbers",
        "0 0 ${height}",
    ),
    ("0 0 0.675", "0 0 nan", "`xyz` is not three numbers", "0 0 nan"),
    (
        "0 0 0.675",
        "0 0 675",
        "the joint lies more than 100 m from the one before it",
        "0 0 675",
    ),
    (
        "rpy=\"0 0 0\"",
        "rpy=\"0 0 inf\"",
        "`rpy` is not three numbers",
        "0 0 inf",
    ),
    (
        "<axis xyz=\"0 0 -1\"/>",
        "<axis xyz=\"0 0 0\"/>",
        "the axis has no direction",
        "0 0 0",
    ),
    (
        "<axis xyz=\"0 0 -1\"/>",
        "<axis xyz=\"0 0 -2\"/>",
        "the axis has the length 2 instead of 1",
        "0 0 -2",
    ),
    (
        "<axis xyz=\"0 0 -1\"/>",
        "<axis xyz=\"0 0 -1\"/><mimic joint=\"joint_a2\"/>",
        "joint `joint_a1` follows another joint",
        "<mimic",
    ),
    (
        "<limit effort=\"0\" lower=\"-3.0\" upper=\"3.1\" velocity=\"2.0\"/>",
        "",
        "joint `joint_a1` has no limits",
        "<joint",
    ),
    ("lower=\"-3.0\"", "", "`limit` has no `lower`", "<limit"),
    ("lower=\"-3.0\"", "lower=\"low\"", "`low` is not a number", "low"),
    (
        "lower=\"-3.0\"",
        "lower=\"3.2\"",
        "the lower limit 3.2 rad is not below the upper limit 3.1 rad",
        "3.1",
    ),
    (
        "lower=\"-3.0\"",
        "lower=\"-185\"",
        "the range from -185 to 3.1 rad is wider than two turns",
        "3.1",
    ),
    (
        "velocity=\"2.0\"",
        "velocity=\"0\"",
        "the joint's highest rate is 0 rad/s",
        "0",
    ),
    (
        "velocity=\"2.0\"",
        "velocity=\"-1\"",
        "the joint's highest rate is -1 rad/s",
        "-1",
    ),
    (
        "velocity=\"2.0\"",
        "velocity=\"fast\"",
        "`fast` is not a number",
        "fast",
    ),
];

#[test]
fn every_fault_is_reported_at_its_place() {
    for (from, to, message, place) in FAULTS {
        let good = text(KR210);
        let bad = if *from == "robot" {
            good.replace(from, to)
        } else {
            good.replacen(from, to, 1)
        };
        assert_ne!(good, bad, "{from}");
        let faults = parse("arm", FileId::ALONE, &bad, Flange::ByConvention).expect_err(message);
        let found = faults.iter().find(|fault| fault.message.starts_with(message));
        let found = found.unwrap_or_else(|| panic!("{message}\n{faults:#?}"));
        assert_eq!(&bad[found.primary.span.bytes()], *place, "{message}");
    }
}

#[test]
fn several_faults_come_in_the_order_of_the_text() {
    let bad = text(KR210)
        .replace("velocity=\"2.0\"", "velocity=\"0\"")
        .replace("0 0 -1", "0 0 0");
    let faults = parse("arm", FileId::ALONE, &bad, Flange::ByConvention).expect_err("seven");
    assert_eq!(faults.len(), 7);
    assert!(faults.is_sorted_by_key(|fault| fault.primary.span.start));
}

#[test]
fn two_ends_are_one_too_many() {
    let without_names = text(KR210).replace("\"tool0\"", "\"tip\"");
    assert!(parse("arm", FileId::ALONE, &without_names, Flange::ByConvention).is_ok());
    let second = "<link name=\"camera\"/><joint name=\"c\" type=\"fixed\"><parent link=\"link_5\"/><child link=\"camera\"/></joint></robot>";
    let two = without_names.replace("</robot>", second);
    let faults = parse("arm", FileId::ALONE, &two, Flange::ByConvention).expect_err("which one");
    assert_eq!(faults[0].message, "the robot ends in `tip` and in `camera`");
    assert!(
        parse(
            "arm",
            FileId::ALONE,
            &text(KR210).replace("</robot>", second),
            Flange::ByConvention
        )
        .is_ok()
    );
    let none = parse(
        "arm",
        FileId::ALONE,
        "<robot><link name=\"base\"/></robot>",
        Flange::ByConvention,
    )
    .expect_err("no joint");
    assert_eq!(none[0].message, "the robot has no moving joint");
}

#[test]
fn hostile_xml_is_refused_in_bounded_time() {
    let laughs =
        "<!DOCTYPE r [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]><robot>&b;</robot>";
    let namespaces: String = (0..60_000).map(|n| format!("<a xmlns:n{n}=\"u\">")).collect();
    let attributes: String = (0..100_000).map(|n| format!(" a{n}=\"\"")).collect();
    let links: String = (0..40_000).map(|n| format!("<link name=\"{n}\"/>")).collect();
    let joint = |n: usize| {
        let (parent, child) = (n, n + 1);
        format!(
            "<joint name=\"{n}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>"
        )
    };
    let joints: String = (0..8_000).map(joint).collect();
    let texts = [
        String::new(),
        "\0\u{feff}<".to_owned(),
        laughs.to_owned(),
        "<a>".repeat(300_000),
        "<robot>".to_owned() + &"<a>".repeat(90_000) + &"</a>".repeat(90_000) + "</robot>",
        "x".repeat(2_000_000),
        format!("<robot>{namespaces}"),
        format!("<robot{attributes}/>"),
        format!("<robot>{}</robot>", "<a/>".repeat(200_000)),
        format!("<robot>{links}{joints}</robot>"),
        format!("<robot>{}</robot>", "<é:joint/>".repeat(9)),
    ];
    for text in texts {
        let faults = parse("arm", FileId::ALONE, &text, Flange::ByConvention).expect_err("hostile");
        assert!(!faults.is_empty() && faults.len() <= 20);
        for fault in faults {
            assert!(text.get(fault.primary.span.bytes()).is_some(), "{fault:?}");
            assert!(fault.message.len() < 1000 && fault.primary.text.len() < 1000);
        }
    }
}

proptest! {
    /// Whatever is done to the text, the answer is a model of finite numbers or faults that point into the text.
    #[test]
    fn damaged_text_never_brings_the_reader_down(
        at in 0_usize..4000, length in 0_usize..40, put in "[<>/\"é&0-9a-z. ]{0,12}"
    ) {
        let good = text(KR210);
        let start = at.min(good.len());
        let end = (start + length).min(good.len());
        let bad = format!("{}{put}{}", &good[..start], &good[end..]);
        match parse("arm", FileId::ALONE, &bad, Flange::ByConvention) {
            Ok(model) => {
                let pose = model.mechanism.flange_in_root(&[0.3; 6]);
                prop_assert!(pose.position.is_finite() && pose.rotation.is_finite());
            }
            Err(faults) => {
                prop_assert!(!faults.is_empty());
                for fault in faults {
                    prop_assert!(bad.get(fault.primary.span.bytes()).is_some(), "{:?}", fault);
                }
            }
        }
    }
}
