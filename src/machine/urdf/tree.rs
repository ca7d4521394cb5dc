//! The tree of a URDF: which joint carries which link, where the robot begins and where it ends.

use super::Flange;
use super::elements::{self, Joint, Kind, Link, MovingJoint, Read, both, fault, refuse, shortened};
use crate::body::Body;
use crate::kinematics::pose::Pose;
use roxmltree::Document;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::source::{FileId, Span, Spanned};

/// Names that the flange goes by, the first one there counts (REP 199).
const FLANGES: [&str; 2] = ["tool0", "flange"];
/// The name of the frame from which the controller counts (REP 199).
const CONTROLLERS_ROOT: &str = "base";

/// Links and joints, known to be one tree.
pub(super) struct Tree<'t> {
    /// The start of the file, for faults of the file as a whole.
    start: Span,
    links: Vec<Link<'t>>,
    joints: Vec<Joint<'t>>,
    /// The joint that carries a link, by the link's name; a place in `joints`.
    carriers: BTreeMap<&'t str, usize>,
}

impl<'t> Tree<'t> {
    /// The tree of a document.
    ///
    /// # Errors
    /// Elements that cannot be read, names given twice or not at all, links on two joints, loops, more than one tree.
    pub(super) fn of(file: FileId, document: &'t Document<'t>) -> Read<Self> {
        let (links, joints) = both(elements::links(file, document), elements::joints(file, document))?;
        let faults = name_faults(&links, &joints);
        if !faults.is_empty() {
            return Err(faults);
        }
        let carriers = (0..)
            .zip(&joints)
            .map(|(place, joint)| (joint.child.node, place))
            .collect();
        let tree = Self {
            start: Span::of_bytes(file, 0..0),
            links,
            joints,
            carriers,
        };
        match tree.looped().or_else(|| tree.second_root()) {
            Some(fault) => refuse(fault),
            None => Ok(tree),
        }
    }

    /// The joints from the root of the tree to a link.
    pub(super) fn chain(&self, link: &str) -> Vec<&Joint<'t>> {
        // The way to the root of a tree has no joint twice; that round a loop is cut off when it is longer.
        let up = core::iter::successors(self.carrier(link), |joint| self.carrier(joint.parent.node));
        let mut chain: Vec<_> = up.take(self.joints.len() + 1).collect();
        chain.reverse();
        chain
    }

    fn link(&self, name: &str) -> Option<&Link<'t>> {
        self.links.iter().find(|link| link.name.node == name)
    }

    /// The joints whose parent a link is.
    pub(super) fn joints_on(&self, link: &str) -> impl Iterator<Item = &Joint<'t>> {
        self.joints.iter().filter(move |joint| joint.parent.node == link)
    }

    /// What a link weighs, in its frame; none where the file does not say.
    pub(super) fn body(&self, link: &str) -> Read<Option<Body>> {
        self.link(link).map_or(Ok(None), Link::body)
    }

    /// The links that have an `<inertial>`, and those that carry one that has.
    pub(super) fn with_mass(&self) -> BTreeSet<&'t str> {
        let mut found = BTreeSet::new();
        for link in self.links.iter().filter(|link| link.has_mass()) {
            let mut next = Some(link.name.node);
            // The carriers of a known link are known, too.
            while let Some(name) = next.filter(|name| found.insert(*name)) {
                next = self.carrier(name).map(|joint| joint.parent.node);
            }
        }
        found
    }

    fn carrier(&self, link: &str) -> Option<&Joint<'t>> {
        self.joints.get(*self.carriers.get(link)?)
    }

    fn looped(&self) -> Option<Diagnostic> {
        let endless = |joint: &&Joint<'_>| self.chain(joint.child.node).len() > self.joints.len();
        let joint = self.joints.iter().find(endless)?;
        let message = format!("link `{}` hangs on a loop of joints", shortened(joint.child.node));
        Some(
            fault(joint.child.span, message, "its parents never end")
                .help("cut the loop at a joint that no motor drives"),
        )
    }

    fn second_root(&self) -> Option<Diagnostic> {
        let mut roots = self
            .links
            .iter()
            .map(|link| link.name)
            .filter(|link| !self.carriers.contains_key(link.node));
        let first = shortened(roots.next()?.node);
        let second = roots.next()?;
        let message = format!("link `{}` is not joined to `{first}`", shortened(second.node));
        Some(
            fault(second.span, message, "no joint carries it")
                .help("join all links to one tree, or leave out what is not the robot"),
        )
    }

    /// The link that is the flange.
    pub(super) fn flange(&self, wanted: Flange<'_>) -> Read<&'t str> {
        let link = |name: &str| self.link(name).map(|link| link.name.node);
        match wanted {
            Flange::Link(name) => link(name).ok_or_else(|| {
                let message = format!("the file has no link `{}`", shortened(name));
                vec![fault(self.start, message, "in this file")]
            }),
            Flange::ByConvention => match FLANGES.into_iter().find_map(link) {
                Some(flange) => Ok(flange),
                None => self.moving_leaf(),
            },
        }
    }

    fn moving_leaf(&self) -> Read<&'t str> {
        let parents: BTreeSet<&str> = self.joints.iter().map(|joint| joint.parent.node).collect();
        let moves = |link: &Spanned<&str>| {
            self.chain(link.node)
                .iter()
                .any(|joint| joint.kind != Kind::Fixed)
        };
        let names = self.links.iter().map(|link| link.name);
        let leaves = names.filter(|link| !parents.contains(link.node));
        let mut ends = leaves.filter(moves);
        match (ends.next(), ends.next()) {
            (Some(flange), None) => Ok(flange.node),
            (Some(first), Some(second)) => {
                let [first_name, second_name] = [first, second].map(|link| shortened(link.node));
                let message = format!("the robot ends in `{first_name}` and in `{second_name}`");
                refuse(
                    fault(second.span, message, "the flange is ambiguous")
                        .help("add a link `tool0` by a fixed joint where the flange is"),
                )
            }
            (None, _) => refuse(
                fault(self.start, "the robot has no moving joint", "in this file")
                    .help("describe six joints of type `revolute`"),
            ),
        }
    }

    /// The frame from which the controller counts, in the root of the tree.
    pub(super) fn controllers_root(&self) -> Pose {
        let chain = self.chain(CONTROLLERS_ROOT);
        let mut origins = chain.iter().map(|joint| match joint.kind {
            Kind::Fixed => joint.origin().ok(),
            Kind::Revolute | Kind::Continuous | Kind::Prismatic | Kind::Planar | Kind::Floating => None,
        });
        let pose: Option<Pose> = origins.try_fold(Pose::IDENTITY, |sum, origin| Some(sum * origin?));
        pose.unwrap_or(Pose::IDENTITY)
    }

    /// The fault that the way to the flange has not six rotary joints.
    pub(super) fn wrong_number(&self, flange: &str, joints: &[MovingJoint]) -> Diagnostic {
        let turning = match joints.len() {
            0 => "no rotary joint".to_owned(),
            1 => "one rotary joint".to_owned(),
            many => format!("{many} rotary joints"),
        };
        let message = format!(
            "the way to the flange `{}` has {turning} instead of six",
            shortened(flange)
        );
        fault(self.place(flange), message, "the flange")
            .help("describe an arm with six joints of type `revolute`; a link `tool0` marks its flange")
    }

    /// The fault that the chain leads to numbers beyond all bounds.
    pub(super) fn too_far(&self, flange: &str) -> Diagnostic {
        let message = format!("the flange `{}` has no finite position", shortened(flange));
        fault(self.place(flange), message, "the flange").help("write origins in metres and radians")
    }

    fn place(&self, link: &str) -> Span {
        self.link(link).map_or(self.start, |named| named.name.span)
    }
}

fn name_faults(links: &[Link<'_>], joints: &[Joint<'_>]) -> Vec<Diagnostic> {
    let mut faults = twice("link", links.iter().map(|link| &link.name));
    faults.extend(twice("joint", joints.iter().map(|joint| &joint.name)));
    let declared: BTreeSet<&str> = links.iter().map(|link| link.name.node).collect();
    for end in joints.iter().flat_map(|joint| [&joint.parent, &joint.child]) {
        if !declared.contains(end.node) {
            let message = format!("there is no link `{}`", shortened(end.node));
            faults.push(fault(end.span, message, "unknown link"));
        }
    }
    let mut carried = BTreeSet::new();
    for joint in joints {
        if !carried.insert(joint.child.node) {
            let message = format!("link `{}` is carried by two joints", shortened(joint.child.node));
            faults.push(fault(joint.child.span, message, "the second of them"));
        }
    }
    faults
}

fn twice<'n>(what: &str, all: impl Iterator<Item = &'n Spanned<&'n str>>) -> Vec<Diagnostic> {
    let mut seen = BTreeSet::new();
    all.filter(|name| !seen.insert(name.node))
        .map(|name| {
            let message = format!("a second {what} is called `{}`", shortened(name.node));
            fault(name.span, message, "the name is taken")
        })
        .collect()
}
