//! The elements of a URDF: links and joints with their numbers, each flaw at its place in the text.

use super::axis_in_tree;
use crate::kinematics::pose::Pose;
use crate::kinematics::serial::JointAxis;
use core::f64::consts::TAU;
use core::ops::Range;
use glam::{DMat3, DVec3};
use roxmltree::{Document, Error, Node, ParsingOptions, TextPos};
use vcutc_diagnostics::document::flaw::Flaw;

/// Largest file, in bytes. Descriptions of robots with all their shapes have a tenth of it.
const LARGEST: usize = 1 << 20;
/// Longest tag, in bytes. The XML reader compares every attribute of a tag with every other.
const LONGEST_TAG: usize = 1 << 15;
/// Most declarations of namespaces. The XML reader hands them down from element to element.
const MOST_NAMESPACES: usize = 64;
/// Most nodes (elements, comments and stretches of text).
const MOST_NODES: u32 = 100_000;
const MOST_JOINTS: usize = 1000;
/// How far joints may lie from one another, in m along each axis.
const FARTHEST: f64 = 100.0;
/// By how much the length of an axis may differ from 1: rounding of three decimals.
const UNIT: f64 = 1e-3;
/// The widest range, in rad: two turns, as for robots of the catalogue, and rounding.
const WIDEST: f64 = 2.0 * TAU + 1e-3;
/// Millimetres in a metre.
const MM: f64 = 1000.0;

/// Kinds of joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Revolute,
    Continuous,
    Fixed,
    Prismatic,
    Planar,
    Floating,
}

const KINDS: [(&str, Kind); 6] = [
    ("revolute", Kind::Revolute),
    ("continuous", Kind::Continuous),
    ("fixed", Kind::Fixed),
    ("prismatic", Kind::Prismatic),
    ("planar", Kind::Planar),
    ("floating", Kind::Floating),
];

/// A name and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Named<'t> {
    pub(super) name: &'t str,
    pub(super) span: Range<usize>,
}

/// A joint as far as the tree needs it; its numbers are read when it turns out to be part of the chain.
#[derive(Debug)]
pub(super) struct Joint<'t> {
    pub(super) named: Named<'t>,
    pub(super) kind: Kind,
    pub(super) parent: Named<'t>,
    pub(super) child: Named<'t>,
    node: Node<'t, 't>,
}

/// A joint that turns, with its numbers.
#[derive(Clone, Debug)]
pub(super) struct MovingJoint {
    pub(super) name: String,
    /// Its axis in the tree, all joints at zero.
    pub(super) axis: JointAxis,
    pub(super) limits: Limits,
}

/// What a joint may do.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Least and largest angle, in rad.
    pub(super) range: (f64, f64),
    /// Highest rate, in rad/s.
    pub(super) rate: Option<f64>,
}

/// The XML of a URDF.
pub(super) fn document(text: &str) -> Result<Document<'_>, Flaw> {
    let whole = |message: String, label: &str| Flaw::new(0..0, message, label);
    if text.len() > LARGEST {
        let message = format!("the file has {} bytes, at most {LARGEST} are read", text.len());
        return Err(whole(message, "this file is too large")
            .help("leave out everything except links and joints, such as shapes"));
    }
    let mut start = 0;
    for tag in text.split('<') {
        if tag.len() > LONGEST_TAG {
            let message = format!("a tag has more than {LONGEST_TAG} bytes");
            return Err(Flaw::new(start..start, message, "it begins here"));
        }
        start += tag.len() + 1;
    }
    if text.matches("xmlns").count() > MOST_NAMESPACES {
        let message = format!("the file declares more than {MOST_NAMESPACES} namespaces");
        return Err(whole(message, "in this file"));
    }
    let options = ParsingOptions {
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options).map_err(|error| not_xml(text, &error))?;
    match unexpanded(&document) {
        Some(flaw) => Err(flaw),
        None => Ok(document),
    }
}

fn not_xml(text: &str, error: &Error) -> Flaw {
    if matches!(error, Error::DtdDetected) {
        let start = text.find("<!DOCTYPE").unwrap_or(0);
        return Flaw::new(
            start..start,
            "the file has a document type declaration",
            "not read",
        )
        .help("delete the declaration: a URDF needs none");
    }
    if matches!(error, Error::NodesLimitReached) {
        return Flaw::new(
            0..0,
            format!("the file has more than {MOST_NODES} elements and texts"),
            "this file is too large",
        );
    }
    let at = offset(text, error.pos());
    // The reader's words may quote names of any length.
    let words: String = error.to_string().chars().take(200).collect();
    let flaw = Flaw::new(
        at..at,
        format!("the file is not well-formed XML: {words}"),
        "here",
    );
    if text.contains("xacro:") {
        flaw.help(EXPAND)
    } else {
        flaw
    }
}

/// The byte at a line and column, both counted from 1 and in characters.
fn offset(text: &str, position: TextPos) -> usize {
    let line = usize::try_from(position.row).unwrap_or(1).saturating_sub(1);
    let column = usize::try_from(position.col).unwrap_or(1).saturating_sub(1);
    let start: usize = text.split_inclusive('\n').take(line).map(str::len).sum();
    let rest = text.get(start..).unwrap_or_default();
    start + rest.chars().take(column).map(char::len_utf8).sum::<usize>()
}

const EXPAND: &str =
    "expand the file first, `xacro robot.urdf.xacro > robot.urdf`, and name the result in the job";

/// Xacro is a language of macros that writes URDF; a file in it is none yet.
fn unexpanded(document: &Document<'_>) -> Option<Flaw> {
    let is_macro = |node: &Node<'_, '_>| {
        let namespace = node.tag_name().namespace().unwrap_or_default();
        node.is_element() && namespace.contains("xacro")
    };
    let found = document.descendants().find(is_macro)?;
    Some(
        Flaw::new(
            tag(&found),
            "the file is xacro, not URDF",
            "a macro that is not expanded",
        )
        .help(EXPAND),
    )
}

/// The opening of a tag: where an element as a whole is complained of.
fn tag(node: &Node<'_, '_>) -> Range<usize> {
    let start = node.range().start;
    let text = node.document().input_text().get(start..).unwrap_or_default();
    let is_end = |c: char| c.is_whitespace() || matches!(c, '>' | '/');
    start..start + text.find(is_end).unwrap_or(text.len())
}

/// The links of a URDF, by the names that they declare.
pub(super) fn links<'t>(document: &'t Document<'t>) -> Result<Vec<Named<'t>>, Vec<Flaw>> {
    let robot = robot(document)?;
    gathered(children(&robot, "link").map(|link| required(&link, "name")))
}

/// The joints of a URDF.
pub(super) fn joints<'t>(document: &'t Document<'t>) -> Result<Vec<Joint<'t>>, Vec<Flaw>> {
    let robot = robot(document)?;
    if let Some(one_more) = children(&robot, "joint").nth(MOST_JOINTS) {
        let message = format!("the robot has more than {MOST_JOINTS} joints");
        return Err(vec![Flaw::new(tag(&one_more), message, "one too many")]);
    }
    gathered(children(&robot, "joint").map(Joint::read))
}

fn robot<'t>(document: &'t Document<'t>) -> Result<Node<'t, 't>, Vec<Flaw>> {
    let root = document.root_element();
    if root.has_tag_name("robot") {
        Ok(root)
    } else {
        let label = format!("`{}` instead of `robot`", shortened(root.tag_name().name()));
        Err(vec![Flaw::new(tag(&root), "the file is not a URDF", label)])
    }
}

/// All values, or all flaws.
fn gathered<T>(results: impl Iterator<Item = Result<T, Flaw>>) -> Result<Vec<T>, Vec<Flaw>> {
    let (mut values, mut flaws) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(flaw) => flaws.push(flaw),
        }
    }
    if flaws.is_empty() { Ok(values) } else { Err(flaws) }
}

fn children<'t>(node: &Node<'t, 't>, name: &'static str) -> impl Iterator<Item = Node<'t, 't>> {
    node.children().filter(move |child| child.has_tag_name(name))
}

fn child<'t>(node: &Node<'t, 't>, name: &'static str) -> Option<Node<'t, 't>> {
    children(node, name).next()
}

/// An attribute that must be there.
fn required<'t>(node: &Node<'t, 't>, name: &'static str) -> Result<Named<'t>, Flaw> {
    optional(node, name).ok_or_else(|| {
        let message = format!("`{}` has no `{name}`", node.tag_name().name());
        Flaw::new(tag(node), message, format!("`{name}` is missing"))
    })
}

fn optional<'t>(node: &Node<'t, 't>, name: &'static str) -> Option<Named<'t>> {
    let attribute = node.attribute_node(name)?;
    Some(Named {
        name: node.attribute(name)?,
        span: attribute.range_value(),
    })
}

/// An element of its own that must be there, such as the parent of a joint.
fn required_child<'t>(node: &Node<'t, 't>, name: &'static str) -> Result<Node<'t, 't>, Flaw> {
    child(node, name).ok_or_else(|| {
        let message = format!("`{}` has no `{name}`", node.tag_name().name());
        Flaw::new(tag(node), message, format!("`<{name} .../>` is missing"))
    })
}

/// Words of the file as they may be quoted: not more than a line of them.
pub(super) fn shortened(words: &str) -> String {
    const MOST: usize = 60;
    let mut short: String = words.chars().take(MOST).collect();
    if short.len() < words.len() {
        short.push_str("...");
    }
    short
}

/// A finite number.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// One number of an attribute.
fn one(written: &Named<'_>) -> Result<f64, Flaw> {
    number(written.name.trim()).ok_or_else(|| {
        let message = format!("`{}` is not a number", shortened(written.name));
        Flaw::new(written.span.clone(), message, "a finite number is expected")
    })
}

/// Three numbers of an attribute, or the default where it is left out.
fn three(node: &Node<'_, '_>, name: &'static str, default: DVec3) -> Result<DVec3, Flaw> {
    let Some(attribute) = node.attribute_node(name) else {
        return Ok(default);
    };
    let mut numbers = attribute.value().split_ascii_whitespace().map(number);
    match (numbers.next(), numbers.next(), numbers.next(), numbers.next()) {
        (Some(Some(x)), Some(Some(y)), Some(Some(z)), None) => Ok(DVec3::new(x, y, z)),
        _ => {
            let message = format!("`{name}` is not three numbers");
            let flaw = Flaw::new(
                attribute.range_value(),
                message,
                "three finite numbers are expected",
            );
            Err(if attribute.value().contains("${") {
                flaw.help(EXPAND)
            } else {
                flaw.help("write them with spaces between, such as `0 0 0.675`")
            })
        }
    }
}

impl<'t> Joint<'t> {
    fn read(node: Node<'t, 't>) -> Result<Self, Flaw> {
        let named = required(&node, "name")?;
        let kind = required(&node, "type")?;
        let Some((_, kind)) = KINDS.iter().find(|(word, _)| *word == kind.name) else {
            let message = format!("`{}` is not a kind of joint", shortened(kind.name));
            return Err(Flaw::new(kind.span, message, "unknown kind")
                .help("write `revolute`, or `fixed` for a joint that never moves"));
        };
        Ok(Self {
            named,
            kind: *kind,
            parent: required(&required_child(&node, "parent")?, "link")?,
            child: required(&required_child(&node, "child")?, "link")?,
            node,
        })
    }

    /// The joint's frame in that of its parent link, at zero.
    pub(super) fn origin(&self) -> Result<Pose, Vec<Flaw>> {
        let Some(origin) = child(&self.node, "origin") else {
            return Ok(Pose::IDENTITY);
        };
        let position = three(&origin, "xyz", DVec3::ZERO);
        let angles = three(&origin, "rpy", DVec3::ZERO);
        let (position, angles) = match (position, angles) {
            (Ok(position), Ok(angles)) => (position, angles),
            (position, angles) => return Err(position.err().into_iter().chain(angles.err()).collect()),
        };
        if position.abs().max_element() > FARTHEST {
            let message = format!("the joint lies more than {FARTHEST} m from the one before it");
            let place = origin
                .attribute_node("xyz")
                .map_or(tag(&origin), |xyz| xyz.range_value());
            return Err(vec![
                Flaw::new(place, message, "too far").help("write lengths in metres"),
            ]);
        }
        let [roll, pitch, yaw] = angles.to_array();
        Ok(Pose {
            rotation: DMat3::from_rotation_z(yaw)
                * DMat3::from_rotation_y(pitch)
                * DMat3::from_rotation_x(roll),
            position: position * MM,
        })
    }

    /// Its numbers as a joint that turns. `joint_in_tree` is its frame.
    pub(super) fn moving(&self, joint_in_tree: &Pose) -> Result<MovingJoint, Vec<Flaw>> {
        let mut flaws = Vec::new();
        if let Some(mimic) = child(&self.node, "mimic") {
            let message = format!("joint `{}` follows another joint", shortened(self.named.name));
            flaws.push(Flaw::new(tag(&mimic), message, "a coupled joint").help(
                "describe the robot by a sheet, which has the coupling of a parallelogram, or delete `mimic` if the \
                 controller turns this joint by itself",
            ));
        }
        let direction = self.direction().map_err(|flaw| flaws.push(flaw));
        let limits = self.limits().map_err(|found| flaws.extend(found));
        match (direction, limits) {
            (Ok(direction), Ok(limits)) if flaws.is_empty() => Ok(MovingJoint {
                name: self.named.name.to_owned(),
                axis: axis_in_tree(joint_in_tree, direction),
                limits,
            }),
            _ => Err(flaws),
        }
    }

    fn direction(&self) -> Result<DVec3, Flaw> {
        let Some(axis) = child(&self.node, "axis") else {
            return Ok(DVec3::X);
        };
        let direction = three(&axis, "xyz", DVec3::X)?;
        let place = axis
            .attribute_node("xyz")
            .map_or(tag(&axis), |xyz| xyz.range_value());
        let length = direction.length();
        if length == 0.0 {
            return Err(Flaw::new(place, "the axis has no direction", "zero")
                .help("write the direction about which the joint turns, such as `0 0 1`"));
        }
        if (length - 1.0).abs() <= UNIT {
            return Ok(direction / length);
        }
        let flaw = Flaw::new(
            place,
            format!("the axis has the length {length} instead of 1"),
            "not of length 1",
        );
        let unit = direction / direction.abs().max_element();
        let unit = unit / unit.length();
        Err(flaw.help(format!("write `{:.6} {:.6} {:.6}`", unit.x, unit.y, unit.z)))
    }

    /// Range and highest rate.
    fn limits(&self) -> Result<Limits, Vec<Flaw>> {
        let limit = child(&self.node, "limit");
        let range = match (&limit, self.kind) {
            (_, Kind::Continuous) => Ok((-TAU, TAU)),
            (Some(limit), _) => range(limit),
            (None, _) => Err(vec![self.without_limits()]),
        };
        let rate = limit.as_ref().map_or(Ok(None), rate);
        match (range, rate) {
            (Ok(range), Ok(rate)) => Ok(Limits { range, rate }),
            (range, rate) => Err(range.err().into_iter().flatten().chain(rate.err()).collect()),
        }
    }

    fn without_limits(&self) -> Flaw {
        let message = format!("joint `{}` has no limits", shortened(self.named.name));
        let example = "<limit lower=\"-3.14\" upper=\"3.14\" velocity=\"2\"/>";
        Flaw::new(tag(&self.node), message, "`<limit .../>` is missing")
            .help(format!("add them in rad and rad/s, such as `{example}`"))
    }

    /// The complaint that a joint of the chain does not turn.
    pub(super) fn does_not_turn(&self) -> Flaw {
        let word = KINDS
            .iter()
            .find(|(_, kind)| *kind == self.kind)
            .map_or("", |(word, _)| word);
        let name = shortened(self.named.name);
        let message = format!("joint `{name}` on the way to the flange is {word}, not revolute");
        let place = self
            .node
            .attribute_node("type")
            .map_or(tag(&self.node), |kind| kind.range_value());
        Flaw::new(place, message, "only rotary joints are supported").help(
            "if it belongs to a gripper or a track, add a link `tool0` before it or leave it out; five-axis machines are \
             described by a sheet",
        )
    }
}

fn range(limit: &Node<'_, '_>) -> Result<(f64, f64), Vec<Flaw>> {
    let end = |name| required(limit, name).and_then(|written| Ok((one(&written)?, written.span)));
    let ((lower, _), (upper, place)) = match (end("lower"), end("upper")) {
        (Ok(lower), Ok(upper)) => (lower, upper),
        (lower, upper) => return Err(lower.err().into_iter().chain(upper.err()).collect()),
    };
    if lower >= upper {
        let message = format!("the lower limit {lower} rad is not below the upper limit {upper} rad");
        return Err(vec![
            Flaw::new(place, message, "no angle lies between").help("swap the two"),
        ]);
    }
    if upper - lower > WIDEST || lower.abs().max(upper.abs()) > WIDEST {
        let message = format!("the range from {lower} to {upper} rad is wider than two turns");
        return Err(vec![Flaw::new(place, message, "too wide").help(
            "write limits in radians, at most a turn either way: -6.283185 to 6.283185",
        )]);
    }
    Ok((lower, upper))
}

fn rate(limit: &Node<'_, '_>) -> Result<Option<f64>, Flaw> {
    let Some(written) = optional(limit, "velocity") else {
        return Ok(None);
    };
    let rate = one(&written)?;
    if rate > 0.0 {
        Ok(Some(rate))
    } else {
        let message = format!("the joint's highest rate is {rate} rad/s");
        Err(Flaw::new(written.span, message, "above zero is expected")
            .help("write the rate in rad/s, or delete `velocity` if it is not known"))
    }
}
