//! Tests over all words of the language, as the tables of the checks have them: each is explained, and the grammar and the
//! snippets of editors know it.

use super::analysis::Analysis;
use super::hover::hover;
use super::manual::{self, Table};
use std::collections::BTreeSet;
use vcutc_backend_api::backend::OptionKind;
use vcutc_diagnostics::source::{LoadError, Loader};
use vcutc_job::sema::kept_surfaces::Surfaces;
use vcutc_job::sema::study::Meaning;
use vcutc_job::sema::vocabulary::{self, BlockSpec, Dimension, FieldSpec, Leaving, Signature, Takes};
use vcutc_registry as registry;
use vcutc_registry::OPERATIONS;
use vcutc_syntax::ast::Row;

/// One text for every path that ends as jobs do, and no other files.
struct One(String);

impl Loader for One {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        if path.ends_with(".vcut") {
            Ok(self.0.clone().into_bytes())
        } else {
            Err(LoadError::NotFound)
        }
    }
}

/// A word in a text, at a byte.
#[derive(Debug)]
struct Spot {
    text: String,
    word: String,
    at: usize,
}

/// A word after a lead in a text.
fn spot(text: &str, lead: &str, word: &str) -> Spot {
    let mut leads = text.match_indices(lead).map(|(at, _)| at);
    // `cut` is not the end of `vcut`.
    let is_letter = |letter: char| letter.is_alphanumeric();
    let begins = |at: &usize| !(lead.starts_with(is_letter) && text[..*at].ends_with(is_letter));
    let start = leads.find(begins).unwrap_or_else(|| panic!("{lead} in {text}"));
    let rest = &text[start..];
    let at = rest.find(word).unwrap_or_else(|| panic!("{word} in {rest}"));
    Spot {
        text: text.to_owned(),
        word: word.to_owned(),
        at: start + at,
    }
}

const MACHINE: &str = "machine m = robot \"kuka/kr210_r3100_ultra\" ";

/// The blocks at the top, each with its whole head.
fn heads() -> Vec<(&'static str, &'static BlockSpec)> {
    [
        "stock ",
        "blade b ",
        "blade b = disc ",
        "blade b = crusher ",
        "rough vcut ",
        "rough rect ",
        "rough auto ",
        "finish disc ",
        "clear pocket ",
        "free pocket ",
        MACHINE,
        "cell ",
    ]
    .into_iter()
    .map(|head| {
        let words: Vec<&str> = head.split_whitespace().collect();
        (head, vocabulary::block(&words, OPERATIONS).unwrap())
    })
    .collect()
}

const FILES: [&str; 4] = ["points", "airfoil", "dxf", "svg"];
const SURFACE_FILES: [&str; 3] = ["mesh", "grid", "step"];

/// Everything that can be written of a field, each with the words in it that are to be explained.
fn of_field(field: &FieldSpec) -> Vec<(String, Vec<String>)> {
    let name = field.name;
    let mut all = vec![(field.sample(), vec![name.to_owned()])];
    if field.leaving == Leaving::Open {
        all.push((format!("{name} = auto"), vec!["auto".to_owned()]));
    }
    match field.takes {
        Takes::Words(words) => {
            all.extend(
                words()
                    .iter()
                    .map(|word| (format!("{name} = {word} "), vec![format!("= {word} ")])),
            );
        }
        Takes::Calls(calls) => {
            for (call, example) in calls {
                let (mut words, mut whole) = (vec![format!("= {call}(")], (*example).to_owned());
                for (label, typical) in vocabulary::labels(call) {
                    let lead = format!("{label} = ");
                    // What a call may leave out is not in its example.
                    if !whole.contains(&lead) {
                        whole = format!("{}, {lead}{typical})", whole.trim_end_matches(')'));
                    }
                    words.push(lead);
                }
                all.push((format!("{name} = {whole}"), words));
            }
        }
        Takes::Fields(inner) => {
            for field in inner.fields {
                for (text, words) in of_field(field) {
                    all.push((format!("{name} {{ {text} }}"), words));
                }
            }
        }
        Takes::Anything | Takes::Quantity(_) | Takes::Blade(_) | Takes::Region | Takes::Machine => {}
    }
    all
}

/// Every word that a field has, or takes.
fn spots_of_fields() -> Vec<Spot> {
    let mut spots = Vec::new();
    let mut add = |before: &str, spec: &BlockSpec, after: &str| {
        for field in spec.fields {
            for (entry, words) in of_field(field) {
                let text = format!("{before}{entry}{after}");
                for lead in words {
                    let word = lead.trim_matches(['=', ' ', '(']);
                    let mut found = spot(&text[before.len()..], &lead, word);
                    found.at += before.len();
                    found.text.clone_from(&text);
                    spots.push(found);
                }
            }
        }
    };
    for (head, spec) in heads() {
        add(&format!("{head}{{ "), spec, " }\n");
    }
    for file in FILES {
        let spec = vocabulary::data_file(file).unwrap();
        add(&format!("profile {{ {file} \"f\" {{ "), spec, " } }\n");
        add(&format!("profile = {file}(\"f\", "), spec, ")\n");
    }
    for file in SURFACE_FILES {
        let spec = vocabulary::surface_file(file).unwrap();
        add(&format!("surface {{ {file} \"f\" {{ "), spec, " } }\n");
    }
    add("surface { nurbs { ", vocabulary::nurbs(), " } }\n");
    spots
}

/// Every other word.
fn other_spots() -> Vec<Spot> {
    let mut spots = Vec::new();
    for (word, form) in vocabulary::CURVES {
        let text = format!("profile {{ {form} }}\n");
        spots.push(spot(&text, &format!("{{ {word}"), word));
    }
    for (word, form) in vocabulary::LOOPS {
        let text = format!("region seat {{ {form} }}\n");
        spots.push(spot(&text, &format!("{{ {word}"), word));
    }
    for (word, form) in vocabulary::SURFACES {
        let text = format!("surface {{ {form} }}\n");
        spots.push(spot(&text, &format!("{{ {word}"), word));
    }
    let (word, form) = vocabulary::STATION;
    let text = format!("surface {{ loft {{ {form} }} }}\n");
    spots.push(spot(&text, word, word));
    let (word, form) = vocabulary::CONTROL_ROW;
    let text = format!("surface {{ nurbs {{ {form} }} }}\n");
    spots.push(spot(&text, word, word));
    let text = "surface { z(x, y) = 3 mm + x }\n";
    spots.extend(["z", "x", "y"].map(|word| spot(text, word, word)));
    for word in vocabulary::JOINTS_OF_CURVES {
        let rest = match *word {
            "to" => String::new(),
            "radius" => " radius 20 mm".to_owned(),
            word => format!(" {word} (1 mm, 2 mm)"),
        };
        let text = format!("profile {{ arc to (1 mm, 2 mm){rest} }}\n");
        spots.push(spot(&text, word, word));
    }
    for (word, form) in vocabulary::short_forms() {
        let text = format!("profile = {form}\n");
        spots.push(spot(&text, "profile", "profile"));
        spots.push(spot(&text, &format!("= {word}"), word));
    }
    for (word, form) in vocabulary::items(OPERATIONS) {
        let text = form
            .replace("NAME", "n")
            .replace("VALUE", "3 mm")
            .replace("...", "");
        spots.push(spot(&text, word, word));
        for next in vocabulary::head_words(word, OPERATIONS) {
            let text = match word {
                "blade" => format!("blade n = {next} {{ }}"),
                "rough" => format!("rough {next} {{ }}"),
                _ => text.replace("robot", next),
            };
            spots.push(spot(&text, &format!(" {next} "), next));
        }
    }
    for (name, example) in vocabulary::functions() {
        let text = format!("let a = {example}\n");
        spots.push(spot(&text, &format!("= {name}"), name));
    }
    for (unit, _, _) in vocabulary::units() {
        let text = format!("let a = 1 {unit}\n");
        spots.push(spot(&text, &format!("1 {unit}"), unit));
    }
    spots.push(spot("let a = 2 * pi\n", "pi", "pi"));
    spots
}

/// Every word of the options of targets.
fn spots_of_targets() -> Vec<Spot> {
    let mut spots = Vec::new();
    for target in registry::backends() {
        let id = target.id();
        for option in target.options() {
            let key = option.key;
            let mut values = vec!["default"];
            if let OptionKind::Choice { of } = option.kind {
                values.extend(of);
            }
            for value in values {
                let text = format!("{MACHINE}{{ {id} {{ {key} = {value} }} }}\n");
                spots.push(spot(&text, &format!("{{ {id} "), id));
                spots.push(spot(&text, &format!("{{ {key} "), key));
                spots.push(spot(&text, &format!("= {value} }}"), value));
            }
        }
    }
    spots
}

/// What is shown over a word; none if that is nothing, or about something else.
fn explained(spot: &Spot) -> Option<String> {
    let path = "/job.vcut";
    let known = Analysis::of(
        path,
        1,
        &One(spot.text.clone()),
        (OPERATIONS, &Surfaces::default()),
    )?;
    let reported = hover(&known, path, spot.at, &registry::backends())?;
    (spot.text.get(reported.span.bytes()) == Some(spot.word.as_str())).then_some(reported.text)
}

#[test]
fn every_word_is_explained() {
    let spots: Vec<Spot> = spots_of_fields()
        .into_iter()
        .chain(other_spots())
        .chain(spots_of_targets())
        .collect();
    assert!(spots.len() > 250, "{}", spots.len());
    let mut poor = Vec::new();
    for spot in &spots {
        let text = explained(spot).unwrap_or_default();
        let is_short = vocabulary::unit_in_words(&spot.word).is_some() || spot.word == "pi";
        let elsewhere = ["see below", "see above", "as for", "](", "described below"];
        if text.len() < if is_short { 12 } else { 20 } || elsewhere.iter().any(|words| text.contains(words)) {
            poor.push((spot, text));
        }
    }
    assert!(poor.is_empty(), "{poor:#?}");
}

/// Fields whose values enter a formula show it.
#[test]
fn words_that_enter_formulas_show_them() {
    let mut shown = 0;
    for spot in spots_of_fields() {
        let is_operations = spot.text.starts_with("rough vcut") || spot.text.starts_with("blade b {");
        // How forces were measured enters no formula.
        if spot.text.contains("measured {") {
            continue;
        }
        let row = manual::row(Table::Formulas, &spot.word);
        if let (Some(row), true) = (row, is_operations && spot.text[spot.at..].contains(['='])) {
            let text = explained(&spot).unwrap_or_default();
            let formula = format!("Enters {}", row.text());
            assert!(text.contains(&formula) || is_choice(&spot), "{spot:?}: {text}");
            shown += usize::from(text.contains(&formula));
        }
    }
    assert!(shown > 20, "{shown}");
}

/// `order = layer`: a word that a field takes, spelt like a field.
fn is_choice(spot: &Spot) -> bool {
    spot.text[..spot.at].ends_with("= ")
}

/// What is left open says how it is chosen.
#[test]
fn what_can_be_left_open_says_how_it_is_chosen() {
    for (head, spec) in heads() {
        for field in spec.fields.iter().filter(|field| field.leaving == Leaving::Open) {
            let row = manual::row(Table::Auto(head.trim()), field.name);
            assert!(row.is_some(), "{}", field.name);
        }
    }
}

const GRAMMAR: &str = include_str!("../../editors/vscode/syntaxes/vcut.tmLanguage.json");
const SNIPPETS: &str = include_str!("../../editors/vscode/snippets/vcut.json");

/// The words that the patterns of a rule name.
fn named_by(rule: &str, number: Option<usize>) -> BTreeSet<String> {
    let grammar: serde_json::Value = serde_json::from_str(GRAMMAR).unwrap();
    let rule = &grammar["repository"][rule];
    let pattern = match number {
        Some(number) => &rule["patterns"][number]["match"],
        None => &rule["match"],
    };
    let mut pattern = pattern.as_str().unwrap().chars().peekable();
    let mut plain = String::new();
    while let Some(letter) = pattern.next() {
        match letter {
            '\\' => {
                // `\p{L}`, `\b`, `\(`
                if pattern.next() == Some('p') {
                    pattern.by_ref().find(|letter| *letter == '}');
                }
                plain.push(' ');
            }
            '[' => {
                pattern.by_ref().find(|letter| *letter == ']');
                plain.push(' ');
            }
            letter if letter == '_' || letter.is_alphanumeric() => plain.push(letter),
            _ => plain.push(' '),
        }
    }
    plain.split_whitespace().map(str::to_owned).collect()
}

fn set<'w>(words: impl IntoIterator<Item = &'w str>) -> BTreeSet<String> {
    words.into_iter().map(str::to_owned).collect()
}

/// All fields of all blocks.
fn fields() -> Vec<&'static FieldSpec> {
    let files = FILES.map(|file| vocabulary::data_file(file).unwrap());
    let surfaces = SURFACE_FILES.map(|file| vocabulary::surface_file(file).unwrap());
    let files = files.into_iter().chain(surfaces).chain([vocabulary::nurbs()]);
    let mut open: Vec<&BlockSpec> = heads().into_iter().map(|(_, spec)| spec).chain(files).collect();
    let mut all = Vec::new();
    while let Some(spec) = open.pop() {
        for field in spec.fields {
            if let Takes::Fields(inner) = field.takes {
                open.push(inner);
            }
            all.push(field);
        }
    }
    all
}

#[test]
fn the_grammar_of_editors_has_every_word_and_no_other() {
    let pieces = vocabulary::CURVES.iter().chain(vocabulary::SIDES);
    let curves = pieces.map(|(word, _)| *word);
    let joints = vocabulary::JOINTS_OF_CURVES.iter().copied();
    assert_eq!(
        named_by("curve", None),
        set(curves
            .chain(joints)
            .chain(Row::ALL.map(Row::word))
            .chain(SURFACE_FILES)
            .chain([vocabulary::STATION.0]))
    );
    let functions = vocabulary::functions().map(|(name, _)| name);
    assert_eq!(named_by("call", Some(0)), set(functions));
    let calls = fields().into_iter().flat_map(|field| match field.takes {
        Takes::Calls(calls) => calls.iter().map(|(name, _)| *name).collect(),
        _ => Vec::new(),
    });
    assert_eq!(named_by("call", Some(1)), set(calls.chain(["axes"])));
    let files = FILES.into_iter();
    assert_eq!(named_by("short", None), set(files.chain(["profile"])));
    let choices = fields().into_iter().flat_map(|field| match field.takes {
        Takes::Words(words) => words(),
        _ => Vec::new(),
    });
    // Most formulas call their variable x, so `flip = x` is not coloured; `auto` is a constant everywhere.
    let choices = choices.filter(|word| !["x", "auto"].contains(word));
    assert_eq!(named_by("choice", None), set(choices.chain(["default"])));
    let units = vocabulary::units().map(|(name, _, _)| name);
    assert_eq!(named_by("number", None), set(units.filter(|unit| *unit != "%")));
    assert_eq!(named_by("constant", None), set(["auto", "pi"]));
    let plain = ["job", "use", "let"];
    assert_eq!(named_by("item", Some(1)), set(plain));
    let blocks = vocabulary::items(OPERATIONS).map(|(word, _)| word);
    let blocks = blocks.filter(|word| !plain.contains(word));
    assert_eq!(named_by("head", Some(3)), set(blocks));
    let machines = vocabulary::head_words("machine", OPERATIONS);
    assert_eq!(
        named_by("head", Some(1)),
        set(machines.into_iter().chain(["machine"]))
    );
    let blades = vocabulary::head_words("blade", OPERATIONS);
    assert_eq!(
        named_by("head", Some(0)),
        set(blades.into_iter().chain(["blade"]))
    );
    let firsts = ["rough", "finish", "clear", "slit", "free"];
    let seconds = firsts
        .into_iter()
        .flat_map(|first| vocabulary::head_words(first, OPERATIONS));
    assert_eq!(named_by("head", Some(2)), set(seconds.chain(firsts)));
}

/// What a snippet of an editor writes if nothing is typed: `${1:a}` and a later `$1` are `a`, `${2|a,b|}` is `a`.
fn written(body: &str) -> String {
    let mut known: Vec<(String, String)> = Vec::new();
    let mut text = String::new();
    let mut rest = body.replace("$TM_FILENAME_BASE", "rib");
    while let Some(at) = rest.find('$') {
        text.push_str(&rest[..at]);
        let tail = rest[at + 1..].to_owned();
        let (number, value, end) = match tail.strip_prefix('{') {
            Some(inner) => {
                let end = inner.find('}').unwrap();
                let (number, value) = inner[..end].split_once([':', '|']).unwrap();
                let value = value.split([',', '|']).next().unwrap();
                (number.to_owned(), value.to_owned(), end + 2)
            }
            None => {
                let end = tail.find(|c: char| !c.is_ascii_digit()).unwrap_or(tail.len());
                let number = tail[..end].to_owned();
                let value = known.iter().find(|(known, _)| *known == number);
                (
                    number,
                    value.map_or(String::new(), |(_, value)| value.clone()),
                    end,
                )
            }
        };
        text.push_str(&value);
        known.push((number, value));
        rest = tail[end..].to_owned();
    }
    text + &rest
}

/// The snippets write what the compiler takes.
#[test]
fn the_snippets_of_editors_are_right() {
    let all: serde_json::Value = serde_json::from_str(SNIPPETS).unwrap();
    let body = |name: &str| {
        let lines = all[name]["body"].as_array().unwrap().iter();
        let lines: Vec<&str> = lines.map(|line| line.as_str().unwrap()).collect();
        written(&lines.join("\n"))
    };
    let job = body("A whole job");
    let (job_without_operation, _) = job.split_once("rough vcut").unwrap();
    let profile = job.find("profile {").unwrap()..job.find("blade").unwrap();
    for (name, snippet) in all.as_object().unwrap() {
        let own = body(name);
        let text = match snippet["prefix"].as_str().unwrap() {
            "job" => own,
            "rough" => format!("{job_without_operation}{own}"),
            "blade" => format!("{job}{}", own.replace("dagger", "other")),
            "profile" => {
                let mut text = job.clone();
                text.replace_range(profile.clone(), &own);
                text
            }
            _ => format!("{job}{own}"),
        };
        let known = Analysis::of(
            "/job.vcut",
            1,
            &One(text.clone()),
            (OPERATIONS, &Surfaces::default()),
        )
        .unwrap();
        let codes = known.diagnostics.iter().map(|found| found.code.number());
        // The file that a drawing's snippet names is not there.
        let wrong: Vec<&str> = codes.filter(|code| *code != "VC0212").collect();
        assert!(wrong.is_empty(), "{name}: {wrong:?}\n{text}");
    }
}

/// What editors show of a function is what its example does.
#[test]
fn functions_take_and_give_what_their_signatures_say() {
    for (name, example) in vocabulary::functions() {
        let inside = &example[name.len() + 1..example.len() - 1];
        let argument = inside.split(',').next().unwrap();
        let text = format!("let given = {example}\nlet taken = {argument}\n");
        let known = Analysis::of("/job.vcut", 1, &One(text), (OPERATIONS, &Surfaces::default())).unwrap();
        let dimension = |name: &str| match known.study.definition(name).unwrap().meaning {
            Meaning::Value(Some(value)) => value.dimension(),
            Meaning::Value(None) | Meaning::Blade(_) | Meaning::Region | Meaning::Machine => {
                panic!("{example}")
            }
        };
        let (taken, given) = (dimension("taken"), dimension("given"));
        match vocabulary::signature(name).unwrap() {
            Signature::OfAngle => assert_eq!((taken, given), (Dimension::ANGLE, Dimension::PURE), "{name}"),
            Signature::ToAngle => assert_eq!((taken, given), (Dimension::PURE, Dimension::ANGLE), "{name}"),
            Signature::Bearing => assert_eq!((taken, given), (Dimension::LENGTH, Dimension::ANGLE), "{name}"),
            Signature::Root => assert_eq!(Some(given), taken.root(), "{name}"),
            Signature::Alike => assert_eq!(taken, given, "{name}"),
        }
    }
}
