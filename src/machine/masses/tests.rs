//! Masses with one fault each, and the masses of the catalogue.

use super::*;
use crate::catalogue;
use crate::sheet::tests::SMALL;
use crate::sheet::{Sheet, parse};
use vcutc_diagnostics::source::FileId;

/// A small arm with these tables.
fn text(dynamics: &str) -> String {
    format!("{SMALL}{dynamics}\n")
}

fn links() -> String {
    let link = |number: u32| {
        format!(
            "[[dynamics.link]]\nname = \"link_{number}\"\nmass_kg = 12.5\ncom_mm = [300.0, 0.0, {number}00.0]\n\
             inertia_kg_m2 = {{ xx = 1.0, yy = 1.5, zz = 2.0, xz = 0.1 }}\n"
        )
    };
    (1..=6).map(link).collect()
}

fn sheet(dynamics: &str) -> Result<Sheet, Vec<Diagnostic>> {
    parse(FileId::ALONE, &text(dynamics))
}

/// The only fault of the masses after a change, with the text that it points at.
fn fault(from: &str, to: &str) -> (String, String) {
    let good = format!("[dynamics]\nsource = \"a scale\"\n{}", links());
    assert!(good.contains(from), "{from}");
    let text = text(&good.replacen(from, to, 1));
    let faults = parse(FileId::ALONE, &text).expect_err(to);
    let [fault] = faults.as_slice() else {
        panic!("{faults:#?}");
    };
    let place = text.get(fault.primary.span.bytes()).expect("a place in the text");
    (place.to_owned(), fault.message.clone())
}

#[test]
fn masses_and_torques_are_read() {
    let sheet = sheet(&format!(
        "[dynamics]\nconfidence = \"measured\"\ncomplete = [\"links\", \"balance\"]\n{}\n\
         [torque]\nlimits_nm = [900, 900.0, 600.0, 200.0, 200.0, 100.0]\nconfidence = \"maker\"\n",
        links()
    ))
    .unwrap();
    let masses = sheet.masses.unwrap();
    assert_eq!(masses.backing, Backing::Measured);
    assert_eq!(masses.covered, [Covered::Links, Covered::Balance]);
    let carried = masses.carried().unwrap();
    assert_eq!(carried[2].centre_mm, DVec3::new(300.0, 0.0, 300.0));
    assert_eq!(carried[5].inertia.x_axis, DVec3::new(1.0, 0.0, 0.1));
    assert_eq!(carried[5].inertia.z_axis, DVec3::new(0.1, 0.0, 2.0));
    let torques = sheet.torques.unwrap();
    assert_eq!((torques.limits[0], torques.backing), (900.0, Backing::Maker));
}

#[test]
fn what_no_arm_has_is_refused() {
    let (place, message) = fault("zz = 2.0", "zz = 4.0");
    assert!(place.contains("zz = 4.0"), "{place}");
    assert_eq!(
        message,
        "the inertia of `link_1` is that of no body: each of its moments is at most the sum of the two others"
    );
    let (_, message) = fault("xx = 1.0", "xx = -1.0");
    assert!(message.contains("is that of no body"), "{message}");
    let (_, message) = fault("xz = 0.1", "xz = 1.5");
    assert!(message.contains("is that of no body"), "{message}");
    let (_, message) = fault("mass_kg = 12.5", "mass_kg = 0.0");
    assert_eq!(message, "the inertia of `link_1` belongs to no mass");
    let (_, message) = fault("mass_kg = 12.5", "mass_kg = -1.0");
    assert!(message.contains("mass_kg"), "{message}");
    let (_, message) = fault("300.0, 0.0, 300.0", "300.0, 0.0, 30000.0");
    assert!(
        message.contains("mm from the root, and the arm reaches"),
        "{message}"
    );
    let (_, message) = fault("\"link_4\"", "\"forearm\"");
    assert_eq!(message, "`link_4` has no mass");
    let (_, message) = fault("source = \"a scale\"", "complete = [\"cables\"]");
    assert_eq!(message, "`cables` does not add to the torques of an arm");
    let (_, message) = fault("source = \"a scale\"", "confidence = \"good\"");
    assert!(message.contains("good"), "{message}");
    let (_, message) = fault("mass_kg = 12.5", "mass_kg = nan");
    assert!(message.contains("mass_kg"), "{message}");
    let (_, message) = fault("zz = 2.0", "zz = 1e300");
    assert!(message.contains("zz"), "{message}");
}

#[test]
fn numbers_that_are_lumped_are_not_bodies() {
    let lumped = links().replace("zz = 2.0", "zz = 4.0");
    assert!(sheet(&format!("[dynamics]\n{lumped}")).is_err());
    assert!(sheet(&format!("[dynamics]\nkind = \"lumped\"\n{lumped}")).is_ok());
}

/// What others publish must not become an error of a job, and nothing is made up.
#[test]
fn masses_of_the_catalogue_are_published() {
    let mut known = 0;
    for name in catalogue::names() {
        let model = catalogue::find(name).unwrap();
        if let Some(masses) = &model.masses {
            assert_eq!(masses.backing, Backing::Published, "{name}");
            assert!(!masses.sources.is_empty() && masses.carried().is_some(), "{name}");
            known += 1;
        }
        if let Some(torques) = &model.torques {
            assert_eq!(torques.backing, Backing::Published, "{name}");
            assert!(!torques.sources.is_empty(), "{name}");
        }
    }
    assert_eq!(known, 9);
}
