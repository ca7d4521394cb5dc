//! Masses of URDF, against point masses: each link is drawn as a handful of them, and what an axis carries is counted point by
//! point.

use super::super::{FileId, Flange, parse};
use super::{IRB6640, KR210, NONE, Row, UR10E, text};
use crate::Model;
use crate::masses::{Kind, Link};
use nalgebra::{Isometry3, Matrix3, Point3, Translation3, UnitQuaternion, UnitVector3, Vector3};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// A mass in kg and its place in the frame of its link, in m.
type Mass = (f64, Point3<f64>);

/// Some that hang on the arm beside the way to its flange, and beyond the flange.
const BESIDE: &[Row] = &[
    (
        "dress",
        "fixed",
        "link_3",
        "dress",
        [0.1, -0.2, 0.3],
        [0.4, -0.5, 0.6],
        NONE,
    ),
    (
        "lamp",
        "fixed",
        "dress",
        "lamp",
        [0.0, 0.1, 0.0],
        [0.0, 1.2, 0.0],
        NONE,
    ),
    (
        "gripper",
        "fixed",
        "tool0",
        "gripper",
        [0.0, 0.0, 0.1],
        NONE,
        NONE,
    ),
    (
        "finger",
        "continuous",
        "gripper",
        "finger",
        NONE,
        NONE,
        [0.0, 0.0, 1.0],
    ),
];

fn isometry([x, y, z]: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Isometry3<f64> {
    Translation3::new(x, y, z) * UnitQuaternion::from_euler_angles(roll, pitch, yaw)
}

/// The frame of every link in the tree, all joints at zero, in m; rows are from the root outwards.
fn frames(rows: &[Row]) -> BTreeMap<&'static str, Isometry3<f64>> {
    let mut frames = BTreeMap::from([(rows[0].2, Isometry3::identity())]);
    for (_, _, parent, child, xyz, rpy, _) in rows {
        let frame = frames[parent] * isometry(*xyz, *rpy);
        frames.insert(child, frame);
    }
    frames
}

/// By which axis a link is carried: that of the last moving joint before it. Axes are counted from 1; 0 is the base.
fn axes(rows: &[Row]) -> BTreeMap<&'static str, usize> {
    let mut axes = BTreeMap::from([(rows[0].2, 0)]);
    let mut moving = 0;
    for (_, kind, parent, child, ..) in rows {
        moving += usize::from(*kind != "fixed");
        let axis = if *kind == "fixed" { axes[parent] } else { moving };
        axes.insert(child, axis);
    }
    axes
}

/// The sum of masses, their centre, and their inertia about that.
fn counted(masses: &[Mass]) -> (f64, Point3<f64>, Matrix3<f64>) {
    let mass: f64 = masses.iter().map(|(mass, _)| mass).sum();
    let moment: Vector3<f64> = masses.iter().map(|(mass, place)| place.coords * *mass).sum();
    let centre = Point3::from(moment / mass);
    let about = masses.iter().map(|(mass, place)| {
        let off = place - centre;
        (Matrix3::identity() * off.norm_squared() - off * off.transpose()) * *mass
    });
    (mass, centre, about.sum())
}

/// The `<inertial>` of point masses, in a frame that is turned so.
fn inertial(masses: &[Mass], rpy: [f64; 3]) -> String {
    let (mass, centre, inertia) = counted(masses);
    let turn = isometry(NONE, rpy).rotation.to_rotation_matrix();
    let seen = turn.transpose() * inertia * turn.matrix();
    let [roll, pitch, yaw] = rpy;
    let mut text = format!(
        "<inertial><origin xyz=\"{} {} {}\" rpy=\"{roll} {pitch} {yaw}\"/><mass value=\"{mass}\"/><inertia",
        centre.x, centre.y, centre.z
    );
    for (name, row, column) in [
        ("ixx", 0, 0),
        ("ixy", 0, 1),
        ("ixz", 0, 2),
        ("iyy", 1, 1),
        ("iyz", 1, 2),
        ("izz", 2, 2),
    ] {
        write!(text, " {name}=\"{}\"", seen[(row, column)]).expect("a string takes it");
    }
    text + "/></inertial>"
}

/// The text with an `<inertial>` in a link.
fn with(text: &str, link: &str, inertial: &str) -> String {
    let head = format!("<link name=\"{link}\">");
    assert!(text.contains(&head), "{link}");
    text.replace(&head, &format!("{head}{inertial}"))
}

fn read(text: &str) -> Model {
    parse("arm", FileId::ALONE, text, Flange::ByConvention).expect("a good URDF")
}

const BODY: &str = "<inertial><mass value=\"2\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>";

/// The KUKA with the same body in every link that moves, and the rows of more links.
fn kuka(more: &[Row]) -> String {
    let links = ["link_1", "link_2", "link_3", "link_4", "link_5", "link_6"];
    let text = text(&[KR210, more].concat());
    links.iter().fold(text, |text, link| with(&text, link, BODY))
}

proptest! {
    #[test]
    fn what_an_axis_carries_is_what_hangs_on_it(
        drawn in prop::collection::vec((0.1..40.0, prop::array::uniform3(-0.8..0.8)), 90),
        turns in prop::collection::vec(prop::array::uniform3(-3.0..3.0), 18),
    ) {
        let kuka = [KR210, BESIDE].concat();
        // The controller of the last one counts from a frame that is turned half round.
        let half_turn = isometry(NONE, [0.0, 0.0, core::f64::consts::PI]);
        let arms = [(kuka.as_slice(), Isometry3::identity()), (IRB6640, Isometry3::identity()), (UR10E, half_turn)];
        for (rows, tree_in_root) in arms {
            let (frames, axes) = (frames(rows), axes(rows));
            let mut urdf = text(rows);
            let mut carried: Vec<Vec<Mass>> = vec![Vec::new(); 8];
            for (number, (link, frame)) in frames.iter().enumerate() {
                let masses: Vec<Mass> = drawn.iter().skip(5 * number).take(5).map(|(mass, place)| (*mass, Point3::from(*place))).collect();
                urdf = with(&urdf, link, &inertial(&masses, turns[number]));
                if !["gripper", "finger"].contains(link) {
                    let placed = masses.iter().map(|(mass, place)| (*mass, tree_in_root * frame * place));
                    carried[axes[link]].extend(placed);
                }
            }
            let model = read(&urdf);
            let masses = model.masses.expect("every link has a mass");
            prop_assert_eq!(masses.kind, Kind::Bodies);
            for (number, link) in masses.carried().expect("all links").into_iter().enumerate() {
                same(link, &carried[number + 1])?;
            }
        }
    }
}

fn same(link: &Link, masses: &[Mass]) -> Result<(), TestCaseError> {
    let (mass, centre, inertia) = counted(masses);
    prop_assert!((link.mass - mass).abs() < 1e-9 * mass);
    let off = Vector3::from(link.centre_mm.to_array()) / 1000.0 - centre.coords;
    prop_assert!(off.norm() < 1e-9, "{}: {off}", link.name);
    let found = Matrix3::from(link.inertia.to_cols_array_2d());
    prop_assert!(
        (found - inertia).norm() < 1e-8 * inertia.norm(),
        "{}: {found} {inertia}",
        link.name
    );
    Ok(())
}

#[test]
fn nothing_is_assumed() {
    assert!(read(&text(KR210)).masses.is_none());
    assert!(read(&kuka(&[])).masses.is_some());
    // One link is not described.
    let without = kuka(&[]).replacen(BODY, "", 1);
    assert!(read(&without).masses.is_none());
    // What is fixed to a link does not stand for it.
    let cable: &[Row] = &[("cable", "fixed", "link_1", "cable", NONE, NONE, NONE)];
    let light = kuka(cable).replacen(BODY, "", 1);
    assert!(read(&with(&light, "cable", BODY)).masses.is_none());
    assert!(read(&with(&kuka(cable), "cable", BODY)).masses.is_some());
    // A mass of zero is stated.
    let weightless = kuka(&[]).replacen("mass value=\"2\"", "mass value=\"0\"", 1);
    assert!(read(&weightless).masses.is_some());
    // Frames without mass are not looked at.
    let camera: &[Row] = &[(
        "camera",
        "fixed",
        "link_1",
        "camera",
        [500.0, 0.0, 0.0],
        NONE,
        NONE,
    )];
    assert!(read(&kuka(camera)).masses.is_some());
    // A rod that turns by itself, with a mass and without.
    let rod: &[Row] = &[(
        "rod",
        "continuous",
        "link_2",
        "rod_link",
        NONE,
        NONE,
        [0.0, 1.0, 0.0],
    )];
    assert!(read(&kuka(rod)).masses.is_some());
    assert!(read(&with(&kuka(rod), "rod_link", BODY)).masses.is_none());
}

#[test]
fn an_arm_that_leans_has_no_known_weight() {
    let standing = kuka(&[]);
    let foot = "<parent link=\"base_link\"/>\n    <child link=\"base\"/>";
    let at = standing.find(foot).expect("the frame of the controller");
    let (before, after) = standing.split_at(at);
    let origin = before.rfind("rpy=\"0 0 0\"").expect("its origin");
    let turned = |rpy: &str| {
        let (head, tail) = before.split_at(origin);
        format!("{head}{}{after}", tail.replacen("0 0 0", rpy, 1))
    };
    assert!(read(&turned("0 0 1")).masses.is_some());
    assert!(read(&turned("0.5 0 0")).masses.is_none());
}

#[test]
fn numbers_that_belong_to_no_body_still_give_torques() {
    let lumped = kuka(&[]).replacen("izz=\"1\"", "izz=\"9\"", 1);
    assert_eq!(read(&lumped).masses.expect("masses").kind, Kind::Lumped);
}

#[test]
fn drives_give_what_all_of_them_state() {
    let text = text(KR210);
    assert!(read(&text).torques.is_none());
    let stated = text.replace("effort=\"0\"", "effort=\"1750\"");
    let torques = read(&stated).torques.expect("all state it");
    assert!(torques.limits.iter().all(|limit| *limit == 1750.0));
    for unknown in ["0", "-1750", "", "much", "inf", "nan", "1e30"] {
        assert!(
            read(&stated.replacen("1750", unknown, 1)).torques.is_none(),
            "{unknown}"
        );
    }
}

/// The joints of a UR10e turn about axes that lie everywhere: a check that frames of rows are those of the tree.
#[test]
fn frames_are_those_of_the_chain() {
    let frames = frames(UR10E);
    let chain = super::chain(&super::way(UR10E), &[0.0; 6]);
    let off = frames["tool0"].translation.vector * 1000.0 - chain.translation.vector;
    assert!(off.norm() < 1e-9, "{off}");
    let axis = UnitVector3::new_normalize(Vector3::z());
    assert!((frames["tool0"].rotation * axis).angle(&(chain.rotation * axis)) < 1e-9);
}

#[test]
fn all_faults_of_masses_are_reported() {
    let wrong = kuka(&[]).replace("mass value=\"2\"", "mass value=\"-2\"");
    let faults = parse("arm", FileId::ALONE, &wrong, Flange::ByConvention).expect_err("masses below zero");
    assert_eq!(faults.len(), 6);
}
