//! What is offered at each place of a text: the words and units that fit there, and no others.

use super::process::Process;
use serde_json::{Value, json};

const NAME: &str = "rib.vcut";

/// A job with values of several dimensions; what is tried out stands after them.
const VALUES: &str = "job \"rib\"\nlet long = 30 mm\nlet wide = 20 deg\nlet share = 0.5\n";

const ROBOT: &str = "machine m = robot \"kuka/kr210_r3100_ultra\"";
const GANTRY: &str = "machine m = five_axis \"generic/head_head_ac\"";

struct Tried {
    process: Process,
}

impl Tried {
    fn start() -> Self {
        let mut process = Process::start();
        let snippets = json!({ "completionItem": { "snippetSupport": true } });
        process.introduce(&json!({ "textDocument": { "completion": snippets } }));
        Self { process }
    }

    /// What is offered at the bar of a text, in the order in which editors show it.
    fn items(&mut self, piece: &str) -> Vec<Value> {
        let text = format!("{VALUES}{piece}\n");
        let at = text.find('|').unwrap();
        let text = text.replace('|', "");
        self.process.show(NAME, &text);
        let items = self.process.about("completion", NAME, &text, at);
        let mut items = items.as_array().unwrap().clone();
        items.sort_by_key(|item| item["sortText"].as_str().unwrap().to_owned());
        items
    }

    fn labels(&mut self, piece: &str) -> Vec<String> {
        let items = self.items(piece);
        let label = |item: &Value| item["label"].as_str().unwrap().to_owned();
        items.iter().map(label).collect()
    }

    fn offers(&mut self, piece: &str, expected: &[&str]) {
        assert_eq!(self.labels(piece), expected, "{piece}");
    }
}

const LENGTHS: [&str; 6] = ["cm", "ft", "in", "m", "mm", "um"];
const ANGLES: [&str; 3] = ["deg", "rad", "rev"];
const TIMES: [&str; 4] = ["h", "min", "ms", "s"];
const SPEEDS: [&str; 6] = ["in/min", "in/s", "m/min", "m/s", "mm/min", "mm/s"];

#[test]
fn a_surface_is_known_at_every_place() {
    let mut tried = Tried::start();
    tried.offers(
        "surface { | }",
        &["grid", "loft", "mesh", "nurbs", "step", "z(x, y)"],
    );
    tried.offers("surface { mesh | }", &["\"...\""]);
    tried.offers("surface { mesh \"a.stl\" { | } }", &["unit", "place"]);
    tried.offers(
        "surface { mesh \"a.stl\" { unit = | } }",
        &["cm", "ft", "in", "m", "mm"],
    );
    tried.offers("surface { grid \"a.csv\" { unit = | } }", &["in", "m", "mm"]);
    tried.offers("surface { grid \"a.csv\" { place = | } }", &["frame"]);
    tried.offers("surface { step | }", &["\"...\""]);
    tried.offers("surface { step \"a.stp\" { | } }", &["place", "unit"]);
    tried.offers(
        "surface { step \"a.stp\" { unit = | } }",
        &["cm", "ft", "in", "m", "mm"],
    );
    tried.offers(
        "surface { nurbs { | } }",
        &["degree", "row", "u_knots", "v_knots"],
    );
    tried.offers(
        "surface { nurbs { degree = (1, 1) | } }",
        &["row", "u_knots", "v_knots"],
    );
    tried.offers("surface { nurbs { row | } }", &["(x, y, z)"]);
    tried.offers("surface { nurbs { row (3 |) } }", &LENGTHS);
    tried.offers("surface { loft { | } }", &["at"]);
    let pieces = tried.labels("profile { | }");
    tried.offers(
        "surface { loft { at 0 mm { | } } }",
        &pieces.iter().map(String::as_str).collect::<Vec<_>>(),
    );
    tried.offers(
        "surface { loft { at 0 mm { points \"a.csv\" { | } } } }",
        &["scale", "unit", "x", "z"],
    );
    // A part has one description.
    let items = tried.labels("surface { }\n|");
    assert!(
        !items.iter().any(|item| item == "profile" || item == "surface"),
        "{items:?}"
    );
}

/// A profile that is one file, written short.
#[test]
fn the_short_form_of_a_profile_is_known_at_every_place() {
    let mut tried = Tried::start();
    tried.offers("profile = |", &["airfoil", "dxf", "points", "svg"]);
    tried.offers("profile = d|", &["airfoil", "dxf", "points", "svg"]);
    tried.offers("profile = dxf(|", &["\"...\""]);
    let all = ["layer", "scale", "side", "tolerance", "unit", "x", "z"];
    tried.offers("profile = dxf(\"f.dxf\", |)", &all);
    tried.offers("profile = dxf(\"f.dxf\", |", &all);
    tried.offers("profile = dxf(\"f.dxf\", layer = \"A\", s|)", &all[1..]);
    tried.offers(
        "profile = svg(\"f.svg\",\n  side = upper,\n  |\n)",
        &["layer", "scale", "tolerance", "unit", "x", "z"],
    );
    tried.offers("profile = dxf(\"f.dxf\", side = |)", &["lower", "upper"]);
    tried.offers("profile = dxf(\"f.dxf\", side = up|", &["lower", "upper"]);
    tried.offers(
        "profile = dxf(\"f.dxf\", unit = |)",
        &["cm", "ft", "in", "m", "mm"],
    );
    tried.offers(
        "profile = svg(\"f.svg\", unit = |)",
        &["cm", "in", "m", "mm", "pt", "px"],
    );
    tried.offers("profile = airfoil(\"f.dat\", flip = |)", &["none", "x"]);
    tried.offers("profile = dxf(\"f.dxf\", tolerance = 0.1 |)", &LENGTHS);
    let needed = [
        "all fields that airfoil still needs",
        "chord",
        "side",
        "flip",
        "x",
        "z",
    ];
    tried.offers("profile = airfoil(\"f.dat\", |)", &needed);
    tried.offers("profile = points(\"f.csv\", |)", &["scale", "unit", "x", "z"]);
    // As in braces.
    tried.offers("profile { dxf \"f.dxf\" { side = | } }", &["lower", "upper"]);
    tried.offers("profile { svg \"f.svg\" { x = 3 | } }", &LENGTHS);
    let x = tried.labels("profile = dxf(\"f.dxf\", x = |)");
    assert_eq!(&x[..2], ["0 mm", "long"]);
    assert!(!x.contains(&"wide".to_owned()), "{x:?}");
    tried.process.end();
}

/// What a place writes is right as it is.
#[test]
fn what_the_short_form_offers_can_be_read() {
    let mut tried = Tried::start();
    for item in tried.items("profile = |") {
        let form = item["textEdit"]["newText"].as_str().unwrap().to_owned();
        let text = format!("{VALUES}stock {{ size = (9 mm, 9 mm, 9 mm) }}\nprofile = {form}\n");
        tried.process.show(NAME, &text);
        let diagnostics = tried.process.diagnostics(NAME);
        let codes: Vec<&str> = diagnostics
            .iter()
            .map(|diagnostic| diagnostic["code"].as_str().unwrap())
            .collect();
        // There is no operation, and the file is not there.
        assert_eq!(codes, ["VC0208", "VC0212"], "{form}: {diagnostics:#?}");
    }
    tried.process.end();
}

#[test]
fn pieces_of_a_profile_go_on_as_they_must() {
    let mut tried = Tried::start();
    tried.offers("profile { start (0 mm, 1 mm) line | }", &["to"]);
    tried.offers("profile { start (0 mm, 1 mm) line to | }", &["(x, z)"]);
    tried.offers("profile { start | }", &["(x, z)"]);
    tried.offers("profile { arc | }", &["to"]);
    let joints = ["center", "radius", "through"];
    tried.offers("profile { arc to (1 mm, 2 mm) | }", &joints);
    tried.offers("profile { arc to (1 mm, 2 mm)\n    r| }", &joints);
    tried.offers("profile { bezier (1 mm, 2 mm) | }", &["(x, z)", "to"]);
    tried.offers("profile { dxf | }", &["\"...\""]);
    tried.offers("profile { line to (1 |", &LENGTHS);
    tried.offers("profile { line to (1 mm, 2 | mm) }", &LENGTHS);
    tried.offers("profile { arc to (1 mm, 2 mm) radius 4 |", &LENGTHS);
    tried.offers("rough vcut { rake = 60 deg tips | }", &["(x, z)"]);
    tried.offers("rough vcut { rake = 60 deg tips (3 mm, 4 |", &LENGTHS);
    let after = tried.labels("profile { start (0 mm, 1 mm) line to (2 mm, 3 mm)\n  |\n}");
    assert!(
        after.contains(&"spline".to_owned()) && after.contains(&"z(x)".to_owned()),
        "{after:?}"
    );
    let formula = tried.labels("profile { z(u) = 3 mm + | }");
    assert_eq!(&formula[..2], ["long", "u"]);
    tried.process.end();
}

/// The unit after a number fits the key.
#[test]
fn units_fit_the_dimension_of_their_place() {
    let mut tried = Tried::start();
    for (piece, units) in [
        ("rough vcut { swing = 4 | }", &ANGLES[..]),
        ("rough vcut { swing = 4| }", &ANGLES),
        ("rough vcut { swing = 4 d| }", &ANGLES),
        ("rough vcut { layer = 4 | }", &LENGTHS),
        ("rough vcut { overlap = 4 | }", &["%"]),
        ("rough vcut { feed { cut = 12 | } }", &SPEEDS),
        (
            "rough vcut { feed { reorient = 12 | } }",
            &["deg/s", "rad/s", "rev/min", "rev/s"],
        ),
        ("rough vcut { limits { swing <= 4 | } }", &ANGLES),
        ("rough vcut { limits { layer >= 4 | } }", &LENGTHS),
        ("rough vcut { limits { time <= 4 | } }", &TIMES),
        ("stock { size = (85 mm, 50 | ", &LENGTHS),
        // Sums have the dimension of the whole, functions their own.
        ("rough vcut { layer = 2 mm + 3 | }", &LENGTHS),
        ("rough vcut { layer = max(2 mm, 3 |", &LENGTHS),
        ("rough vcut { layer = (2 mm + 3 |", &LENGTHS),
        ("rough vcut { layer = 3 mm * sin(30 |", &ANGLES),
        ("rough vcut { swing = atan(3 |", &["%"]),
        ("let angle = cos(30 |", &ANGLES),
        (&format!("{ROBOT} {{ tool = frame(x = 3 |"), &LENGTHS),
        (&format!("{ROBOT} {{ tool = frame(x = 3 mm, a = 3 |"), &ANGLES),
        (&format!("{ROBOT} {{ base = number(1, frame(x = 3 |"), &LENGTHS),
        (&format!("{ROBOT} {{ load = load(mass = 3 |"), &["g", "kg"]),
        (&format!("{ROBOT} {{ home = joints(0 deg, -90 |"), &ANGLES),
        (&format!("{ROBOT} {{ ready = after(3 |"), &TIMES),
        (&format!("{GANTRY} {{ home = axes(x = 3 |"), &LENGTHS),
        (&format!("{GANTRY} {{ home = axes(x = 3 mm, a = 3 |"), &ANGLES),
        (&format!("{ROBOT} {{ krl {{ decimals = 3 | }} }}"), &[]),
    ] {
        tried.offers(piece, units);
    }
    // Of a factor nothing can be said.
    for piece in [
        "rough vcut { layer = 2 * 3 | }",
        "rough vcut { layer = 2 | * long }",
        "rough vcut { layer = (2 |) / 3 }",
        "let any = 3 |",
    ] {
        assert_eq!(tried.labels(piece).len(), 21, "{piece}");
    }
    tried.process.end();
}

#[test]
fn values_fit_the_dimension_of_their_place() {
    let mut tried = Tried::start();
    let swing = tried.labels("rough vcut { swing = | }");
    assert_eq!(&swing[..2], ["auto", "wide"]);
    let rest = [
        "0 deg", "0 rad", "0 rev", "abs", "acos", "asin", "atan", "atan2", "clamp", "max", "min", "share",
        "sqrt",
    ];
    assert_eq!(&swing[2..], rest);
    let layer = tried.labels("rough vcut { layer = | }");
    assert_eq!(&layer[..2], ["auto", "long"]);
    assert!(
        !layer.contains(&"wide".to_owned()) && !layer.contains(&"sin".to_owned()),
        "{layer:?}"
    );
    for piece in [
        "rough vcut { layer = 2 * | }",
        "rough vcut { layer = w| / 2 }",
        "let a = |",
    ] {
        let all = tried.labels(piece);
        for name in ["long", "wide", "share", "sin"] {
            assert!(all.contains(&name.to_owned()), "{piece}: {all:?}");
        }
        assert!(!all.contains(&"auto".to_owned()), "{piece}: {all:?}");
    }
    let within = tried.labels("rough vcut { layer = max(|, 3 mm) }");
    assert_eq!(within[0], "long");
    assert!(!within.contains(&"auto".to_owned()), "{within:?}");
    tried.process.end();
}

#[test]
fn calls_of_machines_are_known_inside() {
    let mut tried = Tried::start();
    let frame = |rest: &str| format!("{ROBOT} {{ tool = frame({rest}");
    tried.offers(&frame("|"), &["a", "b", "c", "q", "x", "y", "z"]);
    tried.offers(&frame("x = 0 mm, a = 0 deg, |)"), &["b", "c", "y", "z"]);
    tried.offers(&frame("q = (1, 0, 0, 0), |)"), &["x", "y", "z"]);
    tried.offers(
        &format!("{ROBOT} {{ load = load(|"),
        &["ix", "iy", "iz", "mass", "x", "y", "z"],
    );
    tried.offers(&format!("{ROBOT} {{ base = number(1, |"), &["frame"]);
    tried.offers(
        &format!("{ROBOT} {{ base = number(1, frame(|"),
        &["a", "b", "c", "q", "x", "y", "z"],
    );
    tried.offers(&format!("{ROBOT} {{ home = | }}"), &["joints"]);
    tried.offers(&format!("{ROBOT} {{ ready = | }}"), &["after", "input"]);
    tried.offers(&format!("{GANTRY} {{ home = | }}"), &["axes"]);
    tried.offers(&format!("{GANTRY} {{ home = axes(|"), &["a", "c", "x", "y", "z"]);
    let angle = tried.labels(&frame("a = |"));
    assert!(
        angle.contains(&"wide".to_owned()) && !angle.contains(&"long".to_owned()),
        "{angle:?}"
    );
    tried.process.end();
}
