//! Repeated checks of a job read a file of triangles once.

use crate::pipeline::Files;
use crate::surfaces::{VCUT, job, stl};
use vcutc::diagnostics::Diagnostic;
use vcutc::diagnostics::source::SourceMap;
use vcutc::job::CheckedJob;
use vcutc::job::sema::kept_surfaces::Surfaces;
use vcutc::job::sema::{self, Choices};
use vcutc::registry;

const PART: &str = "surface { mesh \"hill.stl\" { unit = mm } }";

/// The result of a job when the surfaces are known.
fn checked(
    text: &str,
    mesh: Vec<u8>,
    surfaces: Option<&Surfaces>,
) -> (Option<CheckedJob>, Vec<Diagnostic>, usize) {
    let files = Files::of("examples")
        .with("job.vcut", text)
        .with("hill.stl", mesh);
    let (mut sources, mut found) = (SourceMap::default(), Vec::new());
    let choices = Choices {
        operations: registry::OPERATIONS,
        surfaces,
        ..Choices::default()
    };
    let (_, job) = sema::check("job.vcut", &files, choices, &mut sources, &mut found).unwrap();
    (job, found, sources.iter().count())
}

/// Whether two jobs have one surface, and not only equal ones.
fn is_one(one: &CheckedJob, other: &CheckedJob) -> bool {
    let [one, other] = [one, other].map(|job| job.part.surface().unwrap());
    core::ptr::eq(one, other)
}

#[test]
fn a_file_is_read_once_while_nothing_about_it_changes() {
    let surfaces = Surfaces::default();
    let text = job(PART, VCUT);
    let mesh = stl(|_| 0.0);
    let of = |text: &str, mesh: &[u8]| checked(text, mesh.to_vec(), Some(&surfaces));
    let (first, found, sources) = of(&text, &mesh);
    let first = first.unwrap_or_else(|| panic!("{found:?}"));
    // A speed, a comment, a blade: none of it is of the surface.
    for (from, to) in [
        ("cut = 200 mm/s", "cut = 150 mm/s"),
        ("job \"fairing\"", "// new\njob \"fairing\""),
        ("25 mm", "24 mm"),
    ] {
        let changed = text.replace(from, to);
        assert_ne!(changed, text);
        let (job, found, same) = of(&changed, &mesh);
        assert!(is_one(&first, &job.unwrap()), "{from}");
        assert_eq!((found.len(), same), (0, sources), "{from}");
    }
    // What it is made from is.
    let place = "place = frame(x = 0 mm, y = 0 mm, z = 1 mm, a = 0 deg, b = 0 deg, c = 0 deg)";
    let others = [
        (
            text.replace("unit = mm", &format!("unit = mm, {place}")),
            mesh.clone(),
        ),
        (text.replace("80 mm, 60 mm)", "79 mm, 60 mm)"), mesh.clone()),
        (text.clone(), stl(|y| y * 0.01)),
    ];
    for (text, mesh) in others {
        let (job, _, _) = of(&text, &mesh);
        let (alone, _, _) = checked(&text, mesh, None);
        let (job, alone) = (job.unwrap(), alone.unwrap());
        assert!(!is_one(&first, &job));
        assert_eq!(job.part, alone.part);
        assert_ne!(job.part, first.part);
    }
    // And the first one is still there.
    assert!(is_one(&first, &of(&text, &mesh).0.unwrap()));
    // Without a memory it is read again.
    assert!(!is_one(&first, &checked(&text, mesh, None).0.unwrap()));
}

/// What is reported about a file is reported each time.
#[test]
fn a_file_with_faults_has_them_again() {
    let surfaces = Surfaces::default();
    let text = job(PART, VCUT);
    let mut short = stl(|_| 0.0);
    short.truncate(short.len() - 25);
    let outcomes = [0, 1].map(|_| checked(&text, short.clone(), Some(&surfaces)).1);
    assert!(!outcomes[0].is_empty());
    assert_eq!(outcomes[0], outcomes[1]);
    // A unit with which it does not lie on the stock.
    let inches = text.replace("unit = mm", "unit = in");
    let outcomes = [0, 1].map(|_| checked(&inches, stl(|_| 0.0), Some(&surfaces)).1);
    assert!(!outcomes[0].is_empty());
    assert_eq!(outcomes[0], outcomes[1]);
}
