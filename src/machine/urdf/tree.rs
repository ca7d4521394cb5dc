//! The tree of a URDF: which joint carries which link, where the robot begins and where it ends.

use super::Flange;
use super::elements::{self, Joint, Kind, MovingJoint, Named, shortened};
use crate::kinematics::pose::Pose;
use roxmltree::Document;
use std::collections::{BTreeMap, BTreeSet};
use vcutc_diagnostics::document::flaw::Flaw;

/// Names that the flange goes by, the first one there counts (REP 199).
const FLANGES: [&str; 2] = ["tool0", "flange"];
/// The name of the frame from which the controller counts (REP 199).
const CONTROLLERS_ROOT: &str = "base";

/// Links and joints, known to be one tree.
pub(super) struct Tree<'t> {
    links: Vec<Named<'t>>,
    joints: Vec<Joint<'t>>,
    /// The joint that carries a link, by the link's name; a place in `joints`.
    carriers: BTreeMap<&'t str, usize>,
}

impl<'t> Tree<'t> {
    /// The tree of a document.
    ///
    /// # Errors
    /// Elements that cannot be read, names given twice or not at all, links on two joints, loops, more than one tree.
    pub(super) fn of(document: &'t Document<'t>) -> Result<Self, Vec<Flaw>> {
        let (links, joints) = match (elements::links(document), elements::joints(document)) {
            (Ok(links), Ok(joints)) => (links, joints),
            (links, joints) => {
                return Err([links.err(), joints.err()]
                    .into_iter()
                    .flatten()
                    .flatten()
                    .collect());
            }
        };
        let flaws = name_flaws(&links, &joints);
        if !flaws.is_empty() {
            return Err(flaws);
        }
        let carriers = (0..)
            .zip(&joints)
            .map(|(place, joint)| (joint.child.name, place))
            .collect();
        let tree = Self {
            links,
            joints,
            carriers,
        };
        match tree.looped().or_else(|| tree.second_root()) {
            Some(flaw) => Err(vec![flaw]),
            None => Ok(tree),
        }
    }

    /// The joints from the root of the tree to a link.
    pub(super) fn chain(&self, link: &str) -> Vec<&Joint<'t>> {
        // The way to the root of a tree has no joint twice; that round a loop is cut off when it is longer.
        let up = core::iter::successors(self.carrier(link), |joint| self.carrier(joint.parent.name));
        let mut chain: Vec<_> = up.take(self.joints.len() + 1).collect();
        chain.reverse();
        chain
    }

    fn carrier(&self, link: &str) -> Option<&Joint<'t>> {
        self.joints.get(*self.carriers.get(link)?)
    }

    fn looped(&self) -> Option<Flaw> {
        let endless = |joint: &&Joint<'_>| self.chain(joint.child.name).len() > self.joints.len();
        let joint = self.joints.iter().find(endless)?;
        let message = format!("link `{}` hangs on a loop of joints", shortened(joint.child.name));
        Some(
            Flaw::new(joint.child.span.clone(), message, "its parents never end")
                .help("cut the loop at a joint that no motor drives"),
        )
    }

    fn second_root(&self) -> Option<Flaw> {
        let mut roots = self
            .links
            .iter()
            .filter(|link| !self.carriers.contains_key(link.name));
        let first = shortened(roots.next()?.name);
        let second = roots.next()?;
        let message = format!("link `{}` is not joined to `{first}`", shortened(second.name));
        Some(
            Flaw::new(second.span.clone(), message, "no joint carries it")
                .help("join all links to one tree, or leave out what is not the robot"),
        )
    }

    /// The link that is the flange.
    pub(super) fn flange(&self, wanted: Flange<'_>) -> Result<&'t str, Flaw> {
        let link = |name: &str| {
            self.links
                .iter()
                .find(|link| link.name == name)
                .map(|link| link.name)
        };
        match wanted {
            Flange::Link(name) => link(name).ok_or_else(|| {
                let message = format!("the file has no link `{}`", shortened(name));
                Flaw::new(0..0, message, "in this file")
            }),
            Flange::ByConvention => match FLANGES.into_iter().find_map(link) {
                Some(flange) => Ok(flange),
                None => self.moving_leaf(),
            },
        }
    }

    fn moving_leaf(&self) -> Result<&'t str, Flaw> {
        let parents: BTreeSet<&str> = self.joints.iter().map(|joint| joint.parent.name).collect();
        let moves = |link: &&Named<'_>| {
            self.chain(link.name)
                .iter()
                .any(|joint| joint.kind != Kind::Fixed)
        };
        let leaves = self.links.iter().filter(|link| !parents.contains(link.name));
        let mut ends = leaves.filter(moves);
        match (ends.next(), ends.next()) {
            (Some(flange), None) => Ok(flange.name),
            (Some(first), Some(second)) => {
                let [first_name, second_name] = [first, second].map(|link| shortened(link.name));
                let message = format!("the robot ends in `{first_name}` and in `{second_name}`");
                Err(Flaw::new(second.span.clone(), message, "the flange is ambiguous")
                    .help("add a link `tool0` by a fixed joint where the flange is"))
            }
            (None, _) => Err(Flaw::new(0..0, "the robot has no moving joint", "in this file")
                .help("describe six joints of type `revolute`")),
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

    /// The complaint that the way to the flange has not six rotary joints.
    pub(super) fn wrong_number(&self, flange: &str, joints: &[MovingJoint]) -> Flaw {
        let turning = match joints.len() {
            0 => "no rotary joint".to_owned(),
            1 => "one rotary joint".to_owned(),
            many => format!("{many} rotary joints"),
        };
        let message = format!(
            "the way to the flange `{}` has {turning} instead of six",
            shortened(flange)
        );
        Flaw::new(self.place(flange), message, "the flange")
            .help("describe an arm with six joints of type `revolute`; a link `tool0` marks its flange")
    }

    /// The complaint that the chain leads to numbers beyond all bounds.
    pub(super) fn too_far(&self, flange: &str) -> Flaw {
        let message = format!("the flange `{}` has no finite position", shortened(flange));
        Flaw::new(self.place(flange), message, "the flange").help("write origins in metres and radians")
    }

    fn place(&self, link: &str) -> core::ops::Range<usize> {
        let named = self.links.iter().find(|named| named.name == link);
        named.map_or(0..0, |named| named.span.clone())
    }
}

fn name_flaws(links: &[Named<'_>], joints: &[Joint<'_>]) -> Vec<Flaw> {
    let mut flaws = twice("link", links.iter());
    flaws.extend(twice("joint", joints.iter().map(|joint| &joint.named)));
    let declared: BTreeSet<&str> = links.iter().map(|link| link.name).collect();
    for end in joints.iter().flat_map(|joint| [&joint.parent, &joint.child]) {
        if !declared.contains(end.name) {
            let message = format!("there is no link `{}`", shortened(end.name));
            flaws.push(Flaw::new(end.span.clone(), message, "unknown link"));
        }
    }
    let mut carried = BTreeSet::new();
    for joint in joints {
        if !carried.insert(joint.child.name) {
            let message = format!("link `{}` is carried by two joints", shortened(joint.child.name));
            flaws.push(Flaw::new(joint.child.span.clone(), message, "the second of them"));
        }
    }
    flaws
}

fn twice<'n>(what: &str, all: impl Iterator<Item = &'n Named<'n>>) -> Vec<Flaw> {
    let mut seen = BTreeSet::new();
    all.filter(|named| !seen.insert(named.name))
        .map(|named| {
            let message = format!("a second {what} is called `{}`", shortened(named.name));
            Flaw::new(named.span.clone(), message, "the name is taken")
        })
        .collect()
}
