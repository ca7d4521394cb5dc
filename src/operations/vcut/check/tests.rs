//! Tests of the checks as a whole: expressions against an independent evaluator, and jobs that try to be a burden.

use crate::{RoughVcut, Vcut};
use proptest::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::{Entry, LoadError, Loader, SourceMap, entries_among};
use vcutc_diagnostics::{Code, Diagnostic, fix};
use vcutc_job::search::SearchEffort;
use vcutc_job::sema::kind::Operations;
use vcutc_job::sema::{Choices, Typed, check};
use vcutc_job::{Auto, CheckedJob, Part, Sourced};

mod part;

const VCUT: Operations = Operations(&[&Vcut]);

/// Files in memory.
#[derive(Clone, Default)]
struct Files(BTreeMap<String, Vec<u8>>);

impl Files {
    fn with(mut self, path: &str, text: impl Into<Vec<u8>>) -> Self {
        self.0.insert(path.to_owned(), text.into());
        self
    }

    fn check(&self, overrides: &[&str]) -> (Vec<Diagnostic>, Option<CheckedJob>) {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        self.check_with(Choices {
            overrides: &overrides,
            machine: None,
            options: Typed::default(),
            effort: SearchEffort::Normal,
            operations: VCUT,
            surfaces: None,
        })
    }

    fn check_on(&self, machine: &str) -> (Vec<Diagnostic>, Option<CheckedJob>) {
        self.check_with(Choices {
            overrides: &[],
            machine: Some(machine),
            options: Typed::default(),
            effort: SearchEffort::Normal,
            operations: VCUT,
            surfaces: None,
        })
    }

    fn check_with(&self, choices: Choices<'_>) -> (Vec<Diagnostic>, Option<CheckedJob>) {
        let mut diagnostics = Vec::new();
        let (_, job) = check(
            "job.vcut",
            self,
            choices,
            &mut SourceMap::default(),
            &mut diagnostics,
        )
        .unwrap();
        (diagnostics, job)
    }
}

impl Loader for Files {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        self.0.get(path).cloned().ok_or(LoadError::NotFound)
    }

    fn list(&self, folder: &str) -> Vec<Entry> {
        entries_among(self.0.keys().map(AsRef::as_ref), folder)
    }
}

fn codes(diagnostics: &[Diagnostic]) -> Vec<Code> {
    diagnostics.iter().map(|diagnostic| diagnostic.code).collect()
}

/// A whole job around some lines; `layer` is what they are about.
fn job(lines: &str, layer: &str) -> String {
    format!(
        "job \"test\"\n{lines}\nstock {{ size = (85 mm, 50 mm, 50 mm) }}\n\
         profile {{ start (0 mm, 18 mm) line to (85 mm, 14 mm) }}\n\
         blade knife {{ cutting_length = 10 mm half_apex = 7 deg thickness = 1 mm edges = double }}\n\
         rough vcut {{ blade = knife lattice = orthogonal rake = 60 deg layer = {layer}\n\
         feed {{ cut = 200 mm/s travel = 200 mm/s reorient = 90 deg/s }} clearance = 10 mm }}\n"
    )
}

fn layer_of(job: &CheckedJob) -> Sourced<Auto<Length>> {
    let operation = RoughVcut::of(&*job.operations[0]).unwrap();
    operation.layer
}

fn value_of(lines: &str, layer: &str) -> Result<f64, Vec<Code>> {
    let (diagnostics, job) = Files::default().with("job.vcut", job(lines, layer)).check(&[]);
    match job.map(|job| layer_of(&job).value) {
        Some(Auto::Given(length)) => Ok(length.to_mm()),
        Some(Auto::Auto) | None => Err(codes(&diagnostics)),
    }
}

#[test]
fn a_missing_root_is_the_callers_affair() {
    let outcome = check(
        "job.vcut",
        &Files::default(),
        Choices {
            operations: VCUT,
            ..Choices::default()
        },
        &mut SourceMap::default(),
        &mut Vec::new(),
    );
    assert_eq!(outcome.unwrap_err(), LoadError::NotFound);
}

#[test]
fn a_file_that_is_not_text_is_shown_where_it_stops_being_text() {
    let files = Files::default()
        .with("job.vcut", job("use \"shop.vcut\"", "4 mm"))
        .with("shop.vcut", b"// caf\xe9\n".to_vec());
    let (diagnostics, job) = files.check(&[]);
    assert_eq!(codes(&diagnostics), [Code::NotUtf8]);
    assert_eq!(diagnostics[0].primary.span.start, 6);
    assert!(job.is_none());
}

#[test]
fn a_hundred_thousand_lets_may_need_each_other() {
    let mut lines = String::new();
    for i in 0..100_000 {
        let _ = writeln!(lines, "let a{i} = a{} + 1 um", i + 1);
    }
    lines.push_str("let a100000 = 1 mm");
    let value = value_of(&lines, "a0").unwrap();
    assert!((value - 101.0).abs() < 1e-6, "{value}");
}

#[test]
fn a_circle_of_a_hundred_thousand_lets_is_one_fault() {
    let mut lines = String::new();
    for i in 0..100_000 {
        let _ = writeln!(lines, "let a{i} = a{}", (i + 1) % 100_000);
    }
    assert_eq!(value_of(&lines, "a7").unwrap_err(), [Code::LetCycle]);
}

#[test]
fn circles_that_share_names_leave_none_unknown() {
    let lines = "let a = b\nlet b = c + d\nlet c = b + a\nlet d = c + e\nlet e = a";
    assert_eq!(value_of(lines, "e").unwrap_err(), [Code::LetCycle]);
}

#[test]
fn deep_expressions_are_refused_and_long_ones_are_not() {
    let long = vec!["1 mm"; 200].join(" + ");
    assert_eq!(value_of("", &long), Ok(200.0));
    let deep = format!("1 mm * {}1", "1 ^ ".repeat(240));
    assert!(value_of("", &deep).unwrap_err().contains(&Code::NestedTooDeeply));
}

#[test]
fn files_are_loaded_once_however_often_they_are_used() {
    let files = Files::default()
        .with(
            "job.vcut",
            job(
                "use \"a/left.vcut\" use \"a/right.vcut\" use \"./a/../a/left.vcut\"",
                "h",
            ),
        )
        .with("a/left.vcut", "use \"../base.vcut\"")
        .with("a/right.vcut", "use \"../base.vcut\"")
        .with("base.vcut", "let h = 4 mm");
    let (diagnostics, job) = files.check(&[]);
    assert_eq!(codes(&diagnostics), []);
    assert_eq!(layer_of(&job.unwrap()).value, Auto::Given(Length::mm(4.0)));
}

#[test]
fn a_chain_of_files_without_end_is_refused() {
    struct Endless;
    impl Loader for Endless {
        fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
            let number: u32 = path.trim_end_matches(".vcut").parse().unwrap();
            Ok(format!("use \"{}.vcut\"", number + 1).into_bytes())
        }
    }
    let mut diagnostics = Vec::new();
    check(
        "1.vcut",
        &Endless,
        Choices {
            operations: VCUT,
            ..Choices::default()
        },
        &mut SourceMap::default(),
        &mut diagnostics,
    )
    .unwrap();
    assert!(codes(&diagnostics).contains(&Code::FileNotFound));
}

#[test]
fn the_command_line_replaces_a_let_wherever_it_is() {
    let files = Files::default()
        .with("job.vcut", job("use \"base.vcut\"", "h"))
        .with("base.vcut", "let h = 2 * g\nlet g = 2 mm");
    let (diagnostics, job) = files.check(&["g = 1.5 mm + 1 mm"]);
    assert_eq!(codes(&diagnostics), []);
    assert_eq!(layer_of(&job.unwrap()).value, Auto::Given(Length::mm(5.0)));
    assert_eq!(codes(&files.check(&["g=2 deg"]).0), [Code::WrongDimension]);
    assert_eq!(codes(&files.check(&["b=2 mm"]).0), [Code::BadOverride]);
    assert_eq!(codes(&files.check(&["=2 mm"]).0), [Code::BadOverride]);
}

/// A cell of that name.
fn cell_named(name: &str) -> String {
    let frame = "frame(x = 0 mm, y = 0 mm, z = 310 mm, a = 0 deg, b = 0 deg, c = 0 deg)";
    format!("machine {name} = robot \"kuka/kr210_r3100_ultra\" {{ tool = {frame} base = {frame} }}\n")
}

#[test]
fn the_command_line_chooses_among_all_machines_of_the_job() {
    let machine_of = |job: Option<CheckedJob>| job.unwrap().machine.unwrap().name;
    let shop = cell_named("left") + &cell_named("right");
    let own = job(&("use \"shop.vcut\"\n".to_owned() + &cell_named("own")), "4 mm");
    let files = Files::default()
        .with("job.vcut", own.clone())
        .with("shop.vcut", shop);
    assert_eq!(machine_of(files.check(&[]).1), "own");
    for name in ["own", "left", "right"] {
        let (diagnostics, job) = files.check_on(name);
        assert_eq!(codes(&diagnostics), []);
        assert_eq!(machine_of(job), name);
    }
    let with_cell = files.clone().with("job.vcut", own + "\ncell { machine = left }");
    assert_eq!(machine_of(with_cell.check(&[]).1), "left");
    assert_eq!(machine_of(with_cell.check_on("right").1), "right");
}

#[test]
fn an_unknown_machine_of_the_command_line_is_reported() {
    let files = Files::default().with("job.vcut", job(&cell_named("left"), "4 mm"));
    let (diagnostics, checked) = files.check_on("lefd");
    assert!(checked.is_none());
    assert_eq!(codes(&diagnostics), [Code::UnknownName]);
    // Only the user can change what was typed.
    assert!(diagnostics[0].fixes.is_empty());
    assert_eq!(diagnostics[0].help, ["did you mean `left`?"]);
    assert_eq!(codes(&files.check_on("knife").0), [Code::WrongKind]);
    assert_eq!(codes(&files.check_on("").0), [Code::UnknownName]);

    let none = Files::default().with("job.vcut", job("", "4 mm"));
    assert_eq!(codes(&none.check_on("left").0), [Code::UnknownName]);
    let unread = Files::default().with("job.vcut", job("use \"shop.vcut\"", "4 mm"));
    assert_eq!(codes(&unread.check_on("left").0), [Code::FileNotFound]);
}

#[test]
fn a_wrong_cell_block_is_wrong_on_every_machine() {
    let text = job(&(cell_named("left") + "cell { machine = wright }"), "4 mm");
    let files = Files::default().with("job.vcut", text);
    assert_eq!(codes(&files.check_on("left").0), [Code::UnknownName]);
    let twice = files.check_on("wright").0;
    assert_eq!(codes(&twice), [Code::UnknownName, Code::UnknownName]);
}

#[test]
fn values_know_where_they_stand() {
    let text = job("let h = 4 mm", "2 * h");
    let (_, job) = Files::default().with("job.vcut", text.as_str()).check(&[]);
    let span = layer_of(&job.unwrap()).span.unwrap();
    assert_eq!(&text[span.start as usize..span.end as usize], "2 * h");
}

#[test]
fn a_missing_field_is_added_in_the_manner_of_its_block() {
    let fixed = |stock: &str| {
        let text = job("", "4 mm").replace("stock { size = (85 mm, 50 mm, 50 mm) }", stock);
        let (diagnostics, _) = Files::default().with("job.vcut", text.as_str()).check(&[]);
        let edits = &diagnostics[0].fixes[0].edits;
        let fixed = fix::apply(&text, edits[0].span.file, edits).unwrap();
        let start = fixed.find("stock").unwrap();
        fixed[start..=start + fixed[start..].find('}').unwrap()].to_owned()
    };
    let field = "size = (85 mm, 50 mm, 50 mm)";
    assert_eq!(fixed("stock { }"), format!("stock {{ {field} }}"));
    assert_eq!(fixed("stock {}"), format!("stock {{ {field} }}"));
    assert_eq!(fixed("stock {\n}"), format!("stock {{\n  {field}\n}}"));
    assert_eq!(
        fixed("stock {\n  // none\n}"),
        format!("stock {{\n  // none\n  {field}\n}}")
    );
}

#[test]
fn a_misspelt_field_is_not_missing_as_well() {
    let text = job("", "4 mm").replacen("rake", "raek", 1);
    let (diagnostics, _) = Files::default().with("job.vcut", text.as_str()).check(&[]);
    assert_eq!(codes(&diagnostics), [Code::UnknownField]);
    let edits = &diagnostics[0].fixes[0].edits;
    let fixed = fix::apply(&text, edits[0].span.file, edits).unwrap();
    assert_eq!(fixed, job("", "4 mm"));
}

#[test]
fn no_fix_changes_the_command_line() {
    let files = Files::default().with("job.vcut", job("let h = 5 mm", "h"));
    let (diagnostics, _) = files.check(&["h=4 mm + 4"]);
    assert!(diagnostics[0].fixes.is_empty());
    assert_eq!(diagnostics[0].help, ["write `4 mm`"]);
}

/// An expression of a test, over lengths (in mm) and pure numbers.
#[derive(Clone, Debug)]
enum Tree {
    Pure(i32),
    Length(i32),
    Angle(i32),
    Negate(Box<Self>),
    Binary(char, Box<Self>, Box<Self>),
    Call(&'static str, Vec<Self>),
}

/// A value with its exponents of length and angle; the oracle's own arithmetic.
type Oracle = Option<(f64, i32, i32)>;

impl Tree {
    fn text(&self) -> String {
        match self {
            Self::Pure(n) => n.to_string(),
            Self::Length(n) => format!("{n} mm"),
            Self::Angle(n) => format!("{n} deg"),
            Self::Negate(a) => format!("-({})", a.text()),
            Self::Binary(operator, a, b) => format!("({}) {operator} ({})", a.text(), b.text()),
            Self::Call(name, values) => {
                let values: Vec<String> = values.iter().map(Self::text).collect();
                format!("{name}({})", values.join(", "))
            }
        }
    }

    /// The value by the rules of the reference manual, written down once more and differently.
    #[expect(
        clippy::disallowed_methods,
        reason = "independent of libm, which is what is tested"
    )]
    fn oracle(&self) -> Oracle {
        match self {
            Self::Pure(n) => Some((f64::from(*n), 0, 0)),
            Self::Length(n) => Some((f64::from(*n), 1, 0)),
            Self::Angle(n) => Some((f64::from(*n).to_radians(), 0, 1)),
            Self::Negate(a) => a.oracle().map(|(v, l, g)| (-v, l, g)),
            Self::Binary(operator, a, b) => {
                let ((v, l, g), (w, m, h)) = (a.oracle()?, b.oracle()?);
                match operator {
                    '+' => ((l, g) == (m, h)).then_some((v + w, l, g)),
                    '-' => ((l, g) == (m, h)).then_some((v - w, l, g)),
                    '*' => Some((v * w, l + m, g + h)),
                    _ => (w != 0.0).then(|| (v / w, l - m, g - h)),
                }
            }
            Self::Call(name, values) => {
                let values: Vec<(f64, i32, i32)> = values.iter().map(Self::oracle).collect::<Option<_>>()?;
                match (*name, values.as_slice()) {
                    ("abs", [(v, l, g)]) => Some((v.abs(), *l, *g)),
                    ("sqrt", [(v, l, g)]) => {
                        (*v >= 0.0 && l % 2 == 0 && g % 2 == 0).then(|| (v.powf(0.5), l / 2, g / 2))
                    }
                    ("cos", [(v, 0, 1)]) => Some((v.cos(), 0, 0)),
                    ("max", [(v, l, g), (w, m, h)]) => ((l, g) == (m, h)).then_some((v.max(*w), *l, *g)),
                    _ => None,
                }
            }
        }
    }
}

fn any_tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (0..20_i32).prop_map(Tree::Pure),
        (0..20_i32).prop_map(Tree::Length),
        (0..90_i32).prop_map(Tree::Angle),
    ];
    leaf.prop_recursive(4, 24, 2, |inner| {
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            inner.clone().prop_map(|a| Tree::Negate(Box::new(a))),
            (prop::sample::select(vec!['+', '-', '*', '/']), pair.clone())
                .prop_map(|(operator, (a, b))| Tree::Binary(operator, Box::new(a), Box::new(b))),
            (prop::sample::select(vec!["abs", "sqrt", "cos"]), inner)
                .prop_map(|(name, a)| Tree::Call(name, vec![a])),
            pair.prop_map(|(a, b)| Tree::Call("max", vec![a, b])),
        ]
    })
}

/// Words of which tests make jobs that no person would write.
const WORDS: &[&str] = &[
    "job",
    "use",
    "let",
    "stock",
    "profile",
    "blade",
    "rough",
    "vcut",
    "machine",
    "cell",
    "\"job.vcut\"",
    "\"a\"",
    "a",
    "b",
    "pi",
    "auto",
    "=",
    "<=",
    ">=",
    "{",
    "}",
    "(",
    ")",
    ",",
    "+",
    "-",
    "*",
    "/",
    "^",
    "1",
    "0",
    "4 mm",
    "3 deg",
    "1e300",
    "50 %",
    "2 mm/s",
    "start",
    "line",
    "to",
    "arc",
    "radius",
    "center",
    "through",
    "bezier",
    "spline",
    "polyline",
    "points",
    "airfoil",
    "dxf",
    "svg",
    "profile =",
    "z(x)",
    "x",
    "size",
    "rake",
    "limits",
    "swing",
    "feed",
    "cut",
    "frame",
    "number",
    "joints",
    "robot",
    "tool",
    "sin",
    "sqrt",
    "min",
    "atan2",
    "clamp",
    "krl",
    "(0 mm, 5 mm)",
    "(85 mm, 5 mm)",
];

/// Heights of a polyline in the order in which it is drawn; x in whole mm from -20 to 120.
fn any_polyline() -> impl Strategy<Value = Vec<(i32, i32)>> {
    let inner = prop::collection::btree_map(-19..=119_i32, 0..=50_i32, 1..12);
    (inner, 0..=50_i32, 0..=50_i32).prop_map(|(inner, first, last)| {
        let ends = ([(-20, first)], [(120, last)]);
        ends.0.into_iter().chain(inner).chain(ends.1).collect()
    })
}

fn profile_job(points: &[(i32, i32)]) -> String {
    let mut lines = String::new();
    for (index, (x, z)) in points.iter().enumerate() {
        let word = if index == 0 { "start" } else { "line to" };
        let _ = writeln!(lines, "{word} ({x} mm, {z} mm)");
    }
    job("", "4 mm").replace("start (0 mm, 18 mm) line to (85 mm, 14 mm)", &lines)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn a_profile_has_the_heights_of_its_drawing(points in any_polyline(), reversed in any::<bool>(), x in 0.0..85.0_f64) {
        let mut drawn = points.clone();
        if reversed {
            drawn.reverse();
        }
        let (diagnostics, job) = Files::default().with("job.vcut", profile_job(&drawn)).check(&[]);
        prop_assert_eq!(codes(&diagnostics), []);
        let after = points.iter().position(|&(px, _)| f64::from(px) > x).unwrap();
        let ((x0, z0), (x1, z1)) = (points[after - 1], points[after]);
        let [x0, z0, x1, z1] = [x0, z0, x1, z1].map(f64::from);
        let wanted = z0 + (z1 - z0) * (x - x0) / (x1 - x0);
        let part = job.unwrap().part.tessellated(Part::TOLERANCE).unwrap();
        prop_assert!((part.height(x) - wanted).abs() < 1e-6);
    }

    #[test]
    fn a_profile_that_turns_back_within_the_stock_is_refused(points in any_polyline(), at in 1..84_i32, width in 1..20_i32) {
        // An S about x = at: over to the right, back to the left, and on.
        let is_left = |point: &&(i32, i32)| point.0 < at - width;
        let is_right = |point: &&(i32, i32)| point.0 > at + width;
        let mut drawn: Vec<(i32, i32)> = points.iter().filter(is_left).copied().collect();
        drawn.extend([(at + width, 10), (at - width, 20)]);
        drawn.extend(points.iter().filter(is_right));
        let (diagnostics, _) = Files::default().with("job.vcut", profile_job(&drawn)).check(&[]);
        prop_assert_eq!(codes(&diagnostics), [Code::NotSingleValued]);
    }

    #[test]
    fn no_soup_of_words_is_too_much(words in prop::collection::vec(prop::sample::select(WORDS), 0..60)) {
        let (diagnostics, job) = Files::default().with("job.vcut", words.join(" ")).check(&["a=3 mm"]);
        prop_assert!(job.is_some() || !diagnostics.is_empty());
    }

    #[test]
    fn expressions_mean_what_an_independent_evaluator_says(tree in any_tree()) {
        // Added to something large, so that the range of the field hides nothing.
        let found = value_of("", &format!("50 m + ({})", tree.text()));
        let wanted = tree.oracle().filter(|(value, ..)| value.abs() < 1e4);
        match wanted {
            Some((value, 1, 0)) => {
                let found = found.map_err(|codes| TestCaseError::fail(format!("{codes:?}")))?;
                prop_assert!((found - 50_000.0 - value).abs() < 1e-6, "{found} for {value}");
            }
            Some(_) => prop_assert!(found.unwrap_err().contains(&Code::WrongDimension)),
            None => prop_assert!(tree.oracle().is_some() || found.is_err()),
        }
    }
}
