//! The elements of a URDF: links and joints with their numbers, each fault at its place in the text.

use crate::kinematics::joint_axis::JointAxis;
use crate::kinematics::pose::Pose;
use crate::ranges::TORQUE;
use core::f64::consts::TAU;
use glam::{DMat3, DVec3};
use roxmltree::{Document, Error, Node, ParsingOptions, TextPos};
use vcutc_diagnostics::source::{FileId, Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};

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

/// What is read of a file, or all that is wrong with it.
pub(super) type Read<T> = Result<T, Vec<Diagnostic>>;

pub(super) fn fault(span: Span, message: impl Into<String>, label: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Code::BadMachineFile, message, span, label)
}

pub(super) fn refuse<T>(fault: Diagnostic) -> Read<T> {
    Err(vec![fault])
}

/// Both values, or the faults of both.
pub(super) fn both<A, B>(first: Read<A>, second: Read<B>) -> Read<(A, B)> {
    match (first, second) {
        (Ok(first), Ok(second)) => Ok((first, second)),
        (first, second) => Err(first.err().into_iter().chain(second.err()).flatten().collect()),
    }
}

/// All values, or all faults.
pub(super) fn all<T>(results: impl Iterator<Item = Read<T>>) -> Read<Vec<T>> {
    let (mut values, mut faults) = (Vec::new(), Vec::new());
    for result in results {
        match result {
            Ok(value) => values.push(value),
            Err(found) => faults.extend(found),
        }
    }
    if faults.is_empty() {
        Ok(values)
    } else {
        Err(faults)
    }
}

/// An element of a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Element<'t> {
    node: Node<'t, 't>,
    file: FileId,
}

/// A joint as far as the tree needs it; its numbers are read when it turns out to be part of the chain.
#[derive(Debug)]
pub(super) struct Joint<'t> {
    pub(super) name: Spanned<&'t str>,
    pub(super) kind: Kind,
    pub(super) parent: Spanned<&'t str>,
    pub(super) child: Spanned<&'t str>,
    element: Element<'t>,
}

/// A joint that turns, with its numbers.
#[derive(Clone, Debug)]
pub(super) struct MovingJoint {
    pub(super) name: String,
    /// Its axis in the tree, all joints at zero.
    pub(super) axis: JointAxis,
    pub(super) limits: Limits,
}

/// A link; what it weighs is read when it turns out to be part of the arm.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link<'t> {
    pub(super) name: Spanned<&'t str>,
    pub(super) element: Element<'t>,
}

/// What a joint may do.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Least and largest angle, in rad.
    pub(super) range: (f64, f64),
    /// Highest rate, in rad/s.
    pub(super) rate: Option<f64>,
    /// What its drive gives, in Nm.
    pub(super) torque: Option<f64>,
}

/// The XML of a URDF.
pub(super) fn document(file: FileId, text: &str) -> Read<Document<'_>> {
    let at = |byte: usize| Span::of_bytes(file, byte..byte);
    if text.len() > LARGEST {
        let message = format!("the file has {} bytes, at most {LARGEST} are read", text.len());
        let fault = fault(at(0), message, "this file is too large");
        return refuse(fault.help("leave out everything except links and joints, such as shapes"));
    }
    let mut start = 0;
    for tag in text.split('<') {
        if tag.len() > LONGEST_TAG {
            let message = format!("a tag has more than {LONGEST_TAG} bytes");
            return refuse(fault(at(start), message, "it begins here"));
        }
        start += tag.len() + 1;
    }
    if text.matches("xmlns").count() > MOST_NAMESPACES {
        let message = format!("the file declares more than {MOST_NAMESPACES} namespaces");
        return refuse(fault(at(0), message, "in this file"));
    }
    let options = ParsingOptions {
        nodes_limit: MOST_NODES,
        ..ParsingOptions::default()
    };
    let document = Document::parse_with_options(text, options);
    let document = document.map_err(|error| vec![not_xml(text, &error, at)])?;
    match unexpanded(&document, file) {
        Some(fault) => refuse(fault),
        None => Ok(document),
    }
}

fn not_xml(text: &str, error: &Error, at: impl Fn(usize) -> Span) -> Diagnostic {
    if matches!(error, Error::DtdDetected) {
        let start = text.find("<!DOCTYPE").unwrap_or(0);
        let message = "the file has a document type declaration";
        return fault(at(start), message, "not read").help("delete the declaration: a URDF needs none");
    }
    if matches!(error, Error::NodesLimitReached) {
        let message = format!("the file has more than {MOST_NODES} elements and texts");
        return fault(at(0), message, "this file is too large");
    }
    // The reader's words may quote names of any length.
    let words: String = error.to_string().chars().take(200).collect();
    let message = format!("the file is not well-formed XML: {words}");
    let fault = fault(at(offset(text, error.pos())), message, "here");
    if text.contains("xacro:") {
        fault.help(EXPAND)
    } else {
        fault
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

/// Xacro is a language of macros that writes URDF; a file in it is not URDF yet.
fn unexpanded(document: &Document<'_>, file: FileId) -> Option<Diagnostic> {
    let is_macro = |node: &Node<'_, '_>| {
        let namespace = node.tag_name().namespace().unwrap_or_default();
        node.is_element() && namespace.contains("xacro")
    };
    let node = document.descendants().find(is_macro)?;
    let message = "the file is xacro, not URDF";
    let place = Element { node, file }.tag();
    Some(fault(place, message, "a macro that is not expanded").help(EXPAND))
}

/// The links of a URDF.
pub(super) fn links<'t>(file: FileId, document: &'t Document<'t>) -> Read<Vec<Link<'t>>> {
    let robot = robot(file, document)?;
    all(robot.children("link").map(|element| {
        let name = element.required("name")?;
        Ok(Link { name, element })
    }))
}

/// The joints of a URDF.
pub(super) fn joints<'t>(file: FileId, document: &'t Document<'t>) -> Read<Vec<Joint<'t>>> {
    let robot = robot(file, document)?;
    if let Some(one_more) = robot.children("joint").nth(MOST_JOINTS) {
        let message = format!("the robot has more than {MOST_JOINTS} joints");
        return refuse(fault(one_more.tag(), message, "one too many"));
    }
    all(robot.children("joint").map(Joint::read))
}

fn robot<'t>(file: FileId, document: &'t Document<'t>) -> Read<Element<'t>> {
    let node = document.root_element();
    let root = Element { node, file };
    if node.has_tag_name("robot") {
        return Ok(root);
    }
    let label = format!("`{}` instead of `robot`", shortened(node.tag_name().name()));
    refuse(fault(root.tag(), "the file is not a URDF", label))
}

impl<'t> Element<'t> {
    /// The opening of its tag: where a fault of the element as a whole is.
    fn tag(self) -> Span {
        let start = self.node.range().start;
        let text = self.node.document().input_text();
        let text = text.get(start..).unwrap_or_default();
        let is_end = |c: char| c.is_whitespace() || matches!(c, '>' | '/');
        Span::of_bytes(self.file, start..start + text.find(is_end).unwrap_or(text.len()))
    }

    fn children(self, name: &'static str) -> impl Iterator<Item = Self> {
        let children = self.node.children();
        let named = children.filter(move |child| child.has_tag_name(name));
        named.map(move |node| Self { node, ..self })
    }

    pub(super) fn child(self, name: &'static str) -> Option<Self> {
        self.children(name).next()
    }

    /// An element of its own that must be there, such as the parent of a joint.
    pub(super) fn required_child(self, name: &'static str) -> Read<Self> {
        let missing = || self.lacks(name, format!("`<{name} .../>` is missing"));
        self.child(name).ok_or_else(missing)
    }

    /// An attribute.
    fn optional(self, name: &'static str) -> Option<Spanned<&'t str>> {
        let attribute = self.node.attribute_node(name)?;
        let span = Span::of_bytes(self.file, attribute.range_value());
        Some(Spanned::new(self.node.attribute(name)?, span))
    }

    /// An attribute that must be there.
    pub(super) fn required(self, name: &'static str) -> Read<Spanned<&'t str>> {
        let missing = || self.lacks(name, format!("`{name}` is missing"));
        self.optional(name).ok_or_else(missing)
    }

    fn lacks(self, name: &str, label: String) -> Vec<Diagnostic> {
        let message = format!("`{}` has no `{name}`", self.node.tag_name().name());
        vec![fault(self.tag(), message, label)]
    }

    /// The place of an attribute, or of the element where it has none.
    fn place_of(self, name: &'static str) -> Span {
        self.optional(name).map_or(self.tag(), |attribute| attribute.span)
    }

    /// Three numbers of an attribute, or the default where it is left out.
    fn three(self, name: &'static str, default: DVec3) -> Read<DVec3> {
        let Some(attribute) = self.optional(name) else {
            return Ok(default);
        };
        let mut numbers = attribute.node.split_ascii_whitespace().map(number);
        match (numbers.next(), numbers.next(), numbers.next(), numbers.next()) {
            (Some(Some(x)), Some(Some(y)), Some(Some(z)), None) => Ok(DVec3::new(x, y, z)),
            _ => {
                let message = format!("`{name}` is not three numbers");
                let fault = fault(attribute.span, message, "three finite numbers are expected");
                refuse(if attribute.node.contains("${") {
                    fault.help(EXPAND)
                } else {
                    fault.help("write them with spaces between, such as `0 0 0.675`")
                })
            }
        }
    }
}

impl<'t> Element<'t> {
    /// The frame of `what` in that of `outer`, which is that frame itself where there is no `<origin>`.
    pub(super) fn origin(self, what: &str, outer: &str) -> Read<Pose> {
        let Some(origin) = self.child("origin") else {
            return Ok(Pose::IDENTITY);
        };
        let (position, angles) = both(origin.three("xyz", DVec3::ZERO), origin.three("rpy", DVec3::ZERO))?;
        if position.abs().max_element() > FARTHEST {
            let message = format!("{what} lies more than {FARTHEST} m from {outer}");
            let fault = fault(origin.place_of("xyz"), message, "too far");
            return refuse(fault.help("write lengths in metres"));
        }
        let [roll, pitch, yaw] = angles.to_array();
        Ok(Pose {
            rotation: DMat3::from_rotation_z(yaw)
                * DMat3::from_rotation_y(pitch)
                * DMat3::from_rotation_x(roll),
            position: position * MM,
        })
    }
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
pub(super) fn one(written: Spanned<&str>) -> Read<f64> {
    match number(written.node.trim()) {
        Some(number) => Ok(number),
        None => {
            let message = format!("`{}` is not a number", shortened(written.node));
            refuse(fault(written.span, message, "a finite number is expected"))
        }
    }
}

impl<'t> Joint<'t> {
    fn read(element: Element<'t>) -> Read<Self> {
        let name = element.required("name")?;
        let kind = element.required("type")?;
        let Some((_, known)) = KINDS.iter().find(|(word, _)| *word == kind.node) else {
            let message = format!("`{}` is not a kind of joint", shortened(kind.node));
            let fault = fault(kind.span, message, "unknown kind");
            return refuse(fault.help("write `revolute`, or `fixed` for a joint that never moves"));
        };
        Ok(Self {
            name,
            kind: *known,
            parent: element.required_child("parent")?.required("link")?,
            child: element.required_child("child")?.required("link")?,
            element,
        })
    }

    /// The joint's frame in that of its parent link, at zero.
    pub(super) fn origin(&self) -> Read<Pose> {
        self.element.origin("the joint", "the one before it")
    }

    /// Its numbers as a joint that turns. `joint_in_tree` is its frame.
    pub(super) fn moving(&self, joint_in_tree: &Pose) -> Read<MovingJoint> {
        let ((), (direction, limits)) = both(self.driven(), both(self.direction(), self.limits()))?;
        Ok(MovingJoint {
            name: self.name.node.to_owned(),
            axis: JointAxis {
                point: joint_in_tree.position,
                direction: joint_in_tree.rotation * direction,
            },
            limits,
        })
    }

    /// Refuses a joint that follows another.
    fn driven(&self) -> Read<()> {
        let Some(mimic) = self.element.child("mimic") else {
            return Ok(());
        };
        let message = format!("joint `{}` follows another joint", shortened(self.name.node));
        refuse(fault(mimic.tag(), message, "a coupled joint").help(
            "describe the robot by a sheet, which has the coupling of a parallelogram, or delete `mimic` if the controller \
             turns this joint by itself",
        ))
    }

    fn direction(&self) -> Read<DVec3> {
        let Some(axis) = self.element.child("axis") else {
            return Ok(DVec3::X);
        };
        let direction = axis.three("xyz", DVec3::X)?;
        let place = axis.place_of("xyz");
        let length = direction.length();
        if length == 0.0 {
            let fault = fault(place, "the axis has no direction", "zero");
            return refuse(fault.help("write the direction about which the joint turns, such as `0 0 1`"));
        }
        if (length - 1.0).abs() <= UNIT {
            return Ok(direction / length);
        }
        let message = format!("the axis has the length {length} instead of 1");
        let unit = direction / direction.abs().max_element();
        let unit = unit / unit.length();
        refuse(
            fault(place, message, "not of length 1")
                .help(format!("write `{:.6} {:.6} {:.6}`", unit.x, unit.y, unit.z)),
        )
    }

    /// Range and highest rate.
    fn limits(&self) -> Read<Limits> {
        let limit = self.element.child("limit");
        let range = match (limit, self.kind) {
            (_, Kind::Continuous) => Ok((-TAU, TAU)),
            (Some(limit), _) => range(limit),
            (None, _) => refuse(self.without_limits()),
        };
        let (range, rate) = both(range, limit.map_or(Ok(None), rate))?;
        let torque = limit.and_then(torque);
        Ok(Limits { range, rate, torque })
    }

    fn without_limits(&self) -> Diagnostic {
        let message = format!("joint `{}` has no limits", shortened(self.name.node));
        let example = "<limit lower=\"-3.14\" upper=\"3.14\" velocity=\"2\"/>";
        fault(self.element.tag(), message, "`<limit .../>` is missing")
            .help(format!("add them in rad and rad/s, such as `{example}`"))
    }

    /// The fault that a joint of the chain does not turn.
    pub(super) fn does_not_turn(&self) -> Diagnostic {
        let word = KINDS
            .iter()
            .find(|(_, kind)| *kind == self.kind)
            .map_or("", |(word, _)| word);
        let name = shortened(self.name.node);
        let message = format!("joint `{name}` on the way to the flange is {word}, not revolute");
        let place = self.element.place_of("type");
        fault(place, message, "only rotary joints are supported").help(
            "if it belongs to a gripper or a track, add a link `tool0` before it or leave it out; five-axis machines are \
             described by a sheet",
        )
    }
}

fn range(limit: Element<'_>) -> Read<(f64, f64)> {
    let end = |name| one(limit.required(name)?);
    let (lower, upper) = both(end("lower"), end("upper"))?;
    let place = limit.place_of("upper");
    if lower >= upper {
        let message = format!("the lower limit {lower} rad is not below the upper limit {upper} rad");
        return refuse(fault(place, message, "no angle lies between").help("swap the two"));
    }
    if upper - lower > WIDEST || lower.abs().max(upper.abs()) > WIDEST {
        let message = format!("the range from {lower} to {upper} rad is wider than two turns");
        return refuse(
            fault(place, message, "too wide")
                .help("write limits in radians, at most a turn either way: -6.283185 to 6.283185"),
        );
    }
    Ok((lower, upper))
}

fn rate(limit: Element<'_>) -> Read<Option<f64>> {
    let Some(written) = limit.optional("velocity") else {
        return Ok(None);
    };
    let rate = one(written)?;
    if rate > 0.0 {
        return Ok(Some(rate));
    }
    let message = format!("the joint's highest rate is {rate} rad/s");
    let fault = fault(written.span, message, "above zero is expected");
    refuse(fault.help("write the rate in rad/s, or delete `velocity` if it is not known"))
}

/// What a drive gives; none where that is not known, which many files write as 0.
fn torque(limit: Element<'_>) -> Option<f64> {
    let written = limit.optional("effort")?;
    number(written.node.trim()).filter(|torque| TORQUE.holds_number(*torque))
}
