//! Lists with one fault each, and lists meant to do harm.

use super::*;

fn parse(text: &str) -> Result<Manifest, Vec<Diagnostic>> {
    super::parse(FileId::ALONE, text)
}

const SMALL: &str = r#"
[[program]]
name = "large"
jobs = ["jobs/*.vcut", "rib.vcut"]
targets = ["krl", "rapid"]
output = "programs/{target}/{job}"
machine = "large_cell"
set = ["width=90mm"]
options = "lines_per_part=0"
"#;

fn faults(old: &str, new: &str) -> Vec<(String, String)> {
    assert!(SMALL.contains(old));
    let text = SMALL.replace(old, new);
    let place = |fault: &Diagnostic| text.get(fault.primary.span.bytes()).unwrap().to_owned();
    let found = parse(&text).unwrap_err();
    found
        .iter()
        .map(|fault| (place(fault), fault.message.clone()))
        .collect()
}

#[test]
fn a_section_says_all_there_is_to_say() {
    let manifest = parse(SMALL).unwrap();
    let [entry] = manifest.entries.as_slice() else {
        panic!("{manifest:?}")
    };
    let jobs: Vec<_> = entry.jobs.iter().map(|job| job.node.text()).collect();
    assert_eq!(jobs, ["jobs/*.vcut", "rib.vcut"]);
    assert_eq!(entry.targets.len(), 2);
    assert_eq!(entry.folder("rib", "krl"), "programs/krl/rib");
    assert_eq!(entry.folder("{target}", "krl"), "programs/krl/{target}");
    assert_eq!(
        (entry.name.as_deref(), entry.machine.as_deref()),
        (Some("large"), Some("large_cell"))
    );
    assert_eq!(
        (&*entry.set, &*entry.options),
        (
            &["width=90mm".to_owned()][..],
            &["lines_per_part=0".to_owned()][..]
        )
    );
}

#[test]
fn every_fault_is_reported_at_its_place() {
    let cases = [
        ("jobs = [", "job = [", "job"),
        ("[\"krl\", \"rapid\"]", "3", "3"),
        ("[\"krl\", \"rapid\"]", "[]", "[]"),
        (
            "targets = ",
            "target = \"krl\"\ntargets = ",
            "[\"krl\", \"rapid\"]",
        ),
        ("{job}", "{jbo}", "\"programs/{target}/{jbo}\""),
        ("\"rib.vcut\"", "\"/rib.vcut\"", "\"/rib.vcut\""),
        ("\"large_cell\"", "true", "true"),
        // The place is where the text should have ended.
        ("\"large_cell\"", "\"large_cell", ""),
    ];
    for (old, new, place) in cases {
        let found = faults(old, new);
        assert!(found.iter().any(|(at, _)| at == place), "{new}: {found:?}");
    }
    let found = faults("[[program]]", "[[programs]]");
    assert!(
        found.iter().any(|(_, message)| message.contains("`programs`")),
        "{found:?}"
    );
    assert!(parse("").unwrap_err()[0].message.contains("no programs"));
    let twice = format!("{SMALL}{SMALL}");
    assert!(
        parse(&twice).unwrap_err()[0]
            .message
            .contains("two programs are called `large`")
    );
}

#[test]
fn hostile_lists_end_in_faults() {
    let hostile = [
        "a.".repeat(100_000) + "a = 1",
        "[[program]]\n".repeat(10_000),
        format!("program = {}", "[".repeat(200_000)),
        "\u{feff}\0\u{1f980}".repeat(1000),
        "program = 3".to_owned(),
        "x".repeat(document::LARGEST + 1),
    ];
    for text in hostile {
        let found = parse(&text).unwrap_err();
        assert!((1..=document::MOST_FAULTS).contains(&found.len()));
        for fault in found {
            assert!(text.get(fault.primary.span.bytes()).is_some(), "{fault:?}");
        }
    }
}

#[test]
fn a_baseline_is_read_and_its_faults_are_reported() {
    let list = |section: &str| format!("{SMALL}\n[baseline]\n{section}");
    let baseline = parse(&list(
        "file = \"numbers.json\"\nscallop = \"0.5%\"\ntime = \"2 %\"",
    ))
    .unwrap()
    .baseline
    .unwrap();
    assert_eq!(baseline.file.node, "numbers.json");
    let tolerances: Vec<_> = baseline
        .tolerances
        .iter()
        .map(|tolerance| (tolerance.figure, tolerance.percent.node))
        .collect();
    assert_eq!(tolerances, [(Figure::Time, 2.0), (Figure::Scallop, 0.5)]);
    let cases = [
        ("time = \"2 %\"", "needs `file`"),
        ("file = \"a.json\"", "does not limit any figure"),
        ("file = \"a.json\"\ntime = \"2\"", "not `2`"),
        ("file = \"a.json\"\ntime = \"-1 %\"", "not `-1 %`"),
        ("file = \"a.json\"\ntime = \"nan %\"", "not `nan %`"),
        ("file = \"a.json\"\ntime = 2", "time"),
        ("file = \"a.json\"\ntimes = \"2 %\"", "has no field `times`"),
        ("file = \"\"\ntime = \"2 %\"", "`file` is empty"),
    ];
    for (section, message) in cases {
        let faults = parse(&list(section)).unwrap_err();
        assert!(
            faults.iter().any(|fault| fault.message.contains(message)),
            "{section}: {faults:?}"
        );
    }
}
