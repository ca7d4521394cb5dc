//! The part of a sheet that describes the masses of an arm's links, and the torques that its drives give.
//!
//! ```toml
//! [dynamics]
//! confidence = "measured"
//! complete = ["links", "balance"]
//! source = "our own weighing, protocol 17"
//! [[dynamics.link]]
//! name = "link_1"
//! mass_kg = 395.7
//! com_mm = [76.2, 10.2, 127.5]
//! inertia_kg_m2 = { xx = 20.0, yy = 25.0, zz = 20.0, xy = 0.0, xz = 0.0, yz = 0.0 }
//!
//! [torque]
//! limits_nm = [9600.0, 9600.0, 6600.0, 2170.0, 2170.0, 1270.0]
//! ```
//!
//! Centres lie in the root with all axes at zero, and inertias are about them, along the axes of the root. Nothing is assumed: a link
//! that is not there leaves the torques of the arm unknown.

use super::body::{Body, MILLIMETRES};
use super::ranges::{INERTIA, LENGTH, MASS, TORQUE};
use glam::{DMat3, DVec3};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::document::table::Table;
use vcutc_diagnostics::schema::field::{FieldSpec, optional, value};

/// The heading of the masses.
pub(super) const KEY: &str = "dynamics";

/// The heading of the torques.
pub(super) const TORQUE_KEY: &str = "torque";

/// Masses of the links of an arm.
#[derive(Clone, Debug, PartialEq)]
pub struct Masses {
    pub kind: Kind,
    pub backing: Backing,
    /// What the numbers cover in addition to the links.
    pub covered: Vec<Covered>,
    /// How far they can be used.
    pub note: Option<String>,
    pub sources: Vec<String>,
    /// All links together, in kg, when stated.
    pub total_mass: Option<f64>,
    /// Links from the base on.
    pub links: Vec<Link>,
}

/// What the numbers of a link stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Each link is a body.
    Bodies,
    /// They give the torques of the axes, but not a body for each link.
    Lumped,
}

/// How far masses and torques are backed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backing {
    /// On the machine itself.
    Measured,
    /// By its maker.
    Maker,
    /// By others, such as descriptions for simulation.
    Published,
    /// Made up for an example.
    Example,
}

impl Backing {
    const WORDS: &[(&str, Self)] = &[
        ("measured", Self::Measured),
        ("maker", Self::Maker),
        ("published", Self::Published),
        ("example", Self::Example),
    ];

    /// As sheets write it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Maker => "maker",
            Self::Published => "published",
            Self::Example => "example",
        }
    }
}

/// What adds to the torques of an arm in addition to its links.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Covered {
    /// The links themselves.
    Links,
    /// Crank and rod of a parallelogram.
    Rods,
    /// What the motors turn with.
    Motors,
    /// The balance of axis 2.
    Balance,
    Friction,
}

impl Covered {
    const WORDS: &[(&str, Self)] = &[
        ("links", Self::Links),
        ("rods", Self::Rods),
        ("motors", Self::Motors),
        ("balance", Self::Balance),
        ("friction", Self::Friction),
    ];

    /// As sheets write it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Links => "links",
            Self::Rods => "rods",
            Self::Motors => "motors",
            Self::Balance => "balance",
            Self::Friction => "friction",
        }
    }
}

/// A link with its mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Link {
    pub name: String,
    /// Its mass in kg.
    pub mass: f64,
    /// Its centre of mass in the root with all axes at 0, in mm.
    pub centre_mm: DVec3,
    /// Its inertia about that centre, along the axes of the root, in kg m2; zero where the sheet has none.
    pub inertia: DMat3,
}

impl From<&Link> for Body {
    fn from(link: &Link) -> Self {
        Self {
            mass: link.mass,
            centre: link.centre_mm / MILLIMETRES,
            inertia: link.inertia,
        }
    }
}

/// The torques that the drives of the axes give.
#[derive(Clone, Debug, PartialEq)]
pub struct Torques {
    /// At the controller's axes, in Nm.
    pub limits: [f64; 6],
    pub backing: Backing,
    pub sources: Vec<String>,
}

const FIELDS: &[FieldSpec] = &[
    optional("kind"),
    optional("confidence"),
    optional("complete"),
    optional("source"),
    optional("note"),
    optional("frame"),
    optional("total_mass_kg").within(MASS),
    optional("link"),
];

const LINK: &[FieldSpec] = &[
    value("name", "\"link_1\"").required(),
    value("mass_kg", "395.7").required().within(MASS),
    value("com_mm", "[76.2, 10.2, 127.5]").required().within(LENGTH),
    optional("inertia_kg_m2"),
];

const INERTIAS: &[FieldSpec] = &[
    value("xx", "20.0").required().within(INERTIA),
    value("yy", "25.0").required().within(INERTIA),
    value("zz", "20.0").required().within(INERTIA),
    optional("xy").within(INERTIA),
    optional("xz").within(INERTIA),
    optional("yz").within(INERTIA),
];

const TORQUES: &[FieldSpec] = &[
    value("limits_nm", "[9600.0, 9600.0, 6600.0, 2170.0, 2170.0, 1270.0]")
        .required()
        .within(TORQUE),
    optional("confidence"),
    optional("source"),
];

/// What a sheet's `kind` may be; `cad` is what models for design give.
const KINDS: &[(&str, Kind)] = &[
    ("full", Kind::Bodies),
    ("cad", Kind::Bodies),
    ("lumped", Kind::Lumped),
];

/// The farthest that a centre may lie from the root, in reaches of the arm.
const FARTHEST: f64 = 1.5;

/// What the link is called that an axis carries; axes are counted from 1.
pub(super) fn link_name(axis: usize) -> String {
    format!("link_{axis}")
}

impl Masses {
    /// Reads the table, when the sheet has one.
    pub(super) fn read(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Self> {
        let table = root.table(KEY, FIELDS, faults)?;
        let kind = table.word("kind", KINDS, faults).unwrap_or(Kind::Bodies);
        let tables = table.tables("link", LINK, faults);
        let links: Option<Vec<Link>> = tables.iter().map(|link| Link::read(link, kind, faults)).collect();
        Some(Self {
            kind,
            backing: backing(&table, faults),
            covered: covered(&table, faults),
            note: table.text("note", faults).map(str::to_owned),
            sources: table.texts("source", faults),
            total_mass: table.number("total_mass_kg", faults),
            links: links?,
        })
    }

    /// The links that six axes carry, from axis 1 on; none where one is missing.
    #[must_use]
    pub fn carried(&self) -> Option<[&Link; 6]> {
        let named = |axis: usize| {
            let name = link_name(axis + 1);
            self.links.iter().find(|link| link.name == name)
        };
        let [a, b, c, d, e, f] = core::array::from_fn(named);
        Some([a?, b?, c?, d?, e?, f?])
    }

    /// Adds the faults of links that no arm of this reach has, in mm.
    pub(super) fn check(&self, root: &Table<'_>, reach: f64, faults: &mut Vec<Diagnostic>) {
        let Some(table) = root.loose_table(KEY, &mut Vec::new()) else {
            return;
        };
        let far = |link: &&Link| link.centre_mm.length() > FARTHEST * reach;
        for link in self.links.iter().filter(far) {
            let message = format!(
                "the centre of `{}` is {:.0} mm from the root, and the arm reaches {reach:.0} mm",
                link.name,
                link.centre_mm.length()
            );
            faults.push(
                table
                    .fault(table.span(), message, "too far away")
                    .help("state `com_mm` in mm, in the root, with all axes at 0"),
            );
        }
        let missing: Vec<String> = (1..=6)
            .map(link_name)
            .filter(|name| self.links.iter().all(|link| link.name != *name))
            .collect();
        if !self.links.is_empty() && !missing.is_empty() {
            let message = format!("`{}` has no mass", missing.join("`, `"));
            faults.push(
                table
                    .fault(table.span(), message, "a link is missing")
                    .help("state `link_1` to `link_6`: what axis 1 carries up to axis 2, and so on"),
            );
        }
    }
}

/// How far the numbers of a table are backed: by others, where it does not say.
pub(super) fn backing(table: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Backing {
    let word = table.word("confidence", Backing::WORDS, faults);
    word.unwrap_or(Backing::Published)
}

fn covered(table: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Vec<Covered> {
    let mut covered = Vec::new();
    for word in table.texts("complete", faults) {
        let known = Covered::WORDS.iter().find(|(known, _)| *known == word);
        match known {
            Some((_, part)) => covered.push(*part),
            None => {
                let words: Vec<String> = Covered::WORDS
                    .iter()
                    .map(|(word, _)| format!("`{word}`"))
                    .collect();
                let message = format!("`{word}` does not add to the torques of an arm");
                let fault = table.fault(table.span_of("complete"), message, "unknown");
                faults.push(fault.help(format!("use {}", words.join(", "))));
            }
        }
    }
    covered
}

impl Link {
    fn read(link: &Table<'_>, kind: Kind, faults: &mut Vec<Diagnostic>) -> Option<Self> {
        let name = link.text("name", faults).map(str::to_owned);
        let mass = link.number("mass_kg", faults);
        let centre: Option<[f64; 3]> = link.numbers("com_mm", faults);
        let inertia = inertia(link, faults);
        let read = Self {
            name: name?,
            mass: mass?,
            centre_mm: DVec3::from_array(centre?),
            inertia: inertia?,
        };
        let fault = read.fault(kind);
        if let Some((what, help)) = fault {
            let message = format!("the inertia of `{}` {what}", read.name);
            faults.push(
                link.fault(link.span_of("inertia_kg_m2"), message, "of no body")
                    .help(help),
            );
        }
        Some(read)
    }

    /// What keeps its inertia from being that of a body, and what to do about it.
    fn fault(&self, kind: Kind) -> Option<(&'static str, &'static str)> {
        let is_zero = self.inertia == DMat3::ZERO;
        if self.mass == 0.0 && !is_zero && kind == Kind::Bodies {
            return Some(("belongs to no mass", "state its mass, or leave out its inertia"));
        }
        (kind == Kind::Bodies && !Body::from(self).is_possible()).then_some((
            "is that of no body: each of its moments is at most the sum of the two others",
            "state it about the centre of mass, in kg m2; `kind = \"lumped\"` says that the numbers give torques only",
        ))
    }
}

fn inertia(link: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<DMat3> {
    if !link.has("inertia_kg_m2") {
        return Some(DMat3::ZERO);
    }
    let table = link.table("inertia_kg_m2", INERTIAS, faults)?;
    let [xx, yy, zz] = ["xx", "yy", "zz"].map(|key| table.number(key, faults));
    let [xy, xz, yz] = ["xy", "xz", "yz"].map(|key| table.number(key, faults).unwrap_or(0.0));
    Some(DMat3::from_cols(
        DVec3::new(xx?, xy, xz),
        DVec3::new(xy, yy?, yz),
        DVec3::new(xz, yz, zz?),
    ))
}

impl Torques {
    /// Reads the table `[torque]`, or what `[limits]` has instead, which others publish.
    pub(super) fn read(root: &Table<'_>, faults: &mut Vec<Diagnostic>) -> Option<Self> {
        if root.has(TORQUE_KEY) {
            let table = root.table(TORQUE_KEY, TORQUES, faults)?;
            return Some(Self {
                backing: backing(&table, faults),
                sources: table.texts("source", faults),
                limits: table.numbers("limits_nm", faults)?,
            });
        }
        let limits = root.loose_table("limits", &mut Vec::new())?;
        let has_some = limits.has("joint_effort_limit_nm");
        has_some.then(|| {
            Some(Self {
                limits: limits.numbers("joint_effort_limit_nm", faults)?,
                backing: Backing::Published,
                sources: limits.texts("joint_effort_source", faults),
            })
        })?
    }
}

#[cfg(test)]
mod tests;
