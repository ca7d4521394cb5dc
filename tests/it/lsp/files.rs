//! Jobs that name drawings, and jobs beside a job: what is wrong there is reported where it can be fixed.

use super::editor::{BLADES, RIB, position};
use super::process::Process;
use serde_json::{Value, json};

const NAME: &str = "rib.vcut";

fn with_profile(profile: &str) -> String {
    let start = RIB.find("profile {").unwrap();
    let end = RIB.find("rough vcut").unwrap();
    format!("{}{profile}\n{}", &RIB[..start], &RIB[end..])
}

/// The text that a range marks.
fn marked<'t>(text: &'t str, range: &Value) -> &'t str {
    let at = |place: &Value| super::editor::offset(text, place);
    &text[at(&range["start"])..at(&range["end"])]
}

#[test]
fn a_broken_file_is_marked_where_the_job_names_it() {
    let mut process = Process::start();
    process.introduce(&json!({}));
    process.write(
        "broken.dxf",
        "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\nfar away\n0\nENDSEC\n0\nEOF\n",
    );
    process.write("broken.svg", "<svg>\n<path d='M 0 0\n</svg>\n");
    process.write("broken.csv", "x,z\n0,1\n1,no number\n2,3\n");
    process.write("broken.dat", "AIRFOIL\n 1.0 0.0\n zero 0.1\n 1.0 0.0\n");
    for (profile, file) in [
        ("profile = dxf(\"broken.dxf\")", "broken.dxf"),
        ("profile { dxf \"broken.dxf\" }", "broken.dxf"),
        ("profile = svg(\"broken.svg\")", "broken.svg"),
        ("profile = points(\"broken.csv\")", "broken.csv"),
        (
            "profile = airfoil(\"broken.dat\", side = upper, chord = 60 mm)",
            "broken.dat",
        ),
    ] {
        let text = with_profile(profile);
        process.show(NAME, &text);
        let diagnostics = process.diagnostics(NAME);
        let of_file: Vec<&Value> = diagnostics
            .iter()
            .filter(|diagnostic| diagnostic["code"] == "VC0224")
            .collect();
        assert_eq!(of_file.len(), 1, "{profile}: {diagnostics:#?}");
        assert_eq!(
            marked(&text, &of_file[0]["range"]),
            format!("\"{file}\""),
            "{profile}"
        );
        let beside = &of_file[0]["relatedInformation"][0]["location"];
        assert_eq!(beside["uri"], process.uri(file), "{profile}");
        let line = beside["range"]["start"]["line"].as_u64().unwrap() + 1;
        let place = format!("/{file}:{line}:");
        let message = of_file[0]["message"].as_str().unwrap();
        assert!(line > 1 && message.contains(&place), "{profile}: {message}");
    }
    for profile in [
        "profile = dxf(\"nowhere.dxf\")",
        "profile = svg(\"nowhere.svg\")",
        "profile { airfoil \"nowhere.dat\" { side = upper, chord = 60 mm } }",
    ] {
        let text = with_profile(profile);
        process.show(NAME, &text);
        let diagnostics = process.diagnostics(NAME);
        assert_eq!(diagnostics[0]["code"], "VC0212", "{profile}: {diagnostics:#?}");
        assert!(
            marked(&text, &diagnostics[0]["range"]).starts_with("\"nowhere."),
            "{profile}"
        );
    }
    process.end();
}

fn rename(process: &mut Process, id: i64, text: &str, piece: &str, new: &str) -> Value {
    let at = text.find(piece).unwrap() + 1;
    let params = json!({
        "textDocument": { "uri": process.uri(NAME) }, "position": position(text, at), "newName": new,
    });
    process.ask(id, "textDocument/rename", &params)
}

/// Jobs that are wrong do not prevent renaming, wherever the mistake is: unless the name stands in what
/// cannot be read.
#[test]
fn jobs_with_mistakes_do_not_keep_a_name() {
    let mut process = Process::start();
    process.introduce(&json!({}));
    process.show(NAME, RIB);
    process.write(
        "aside.vcut",
        "job \"aside\"\nlet dagger_count = }\nblade = dagger +\n",
    );
    let other = RIB.replace("\"rib\"", "\"other\"");
    let (mut made, mut refused) = (0, 0);
    let wrong = [
        "",
        "}",
        "let = 3",
        "nonsense",
        "rake = 60",
        "blade = nobody",
        "use \"nowhere.vcut\"",
        "slow =",
    ];
    let lines: Vec<&str> = other.lines().collect();
    for (number, line) in (0..lines.len()).flat_map(|number| wrong.iter().map(move |line| (number, line))) {
        let mut changed = lines.clone();
        changed[number] = line;
        process.write("other.vcut", &changed.join("\n"));
        process.notify("workspace/didChangeWatchedFiles", &json!({ "changes": [] }));
        let id = i64::from(2000 + made + refused);
        let answer = rename(&mut process, id, RIB, "dagger", "long_dagger");
        if let Some(error) = answer.get("error") {
            let message = error["message"].as_str().unwrap();
            assert!(message.contains("/other.vcut:"), "{number} {line}: {message}");
            assert!(message.contains("cannot be read"), "{number} {line}: {message}");
            refused += 1;
        } else {
            let files: Vec<&String> = answer["result"]["changes"].as_object().unwrap().keys().collect();
            assert!(files.contains(&&process.uri("blades.vcut")), "{files:?}");
            made += 1;
        }
    }
    assert!(made > 100 && refused < made / 4, "{made} made, {refused} refused");
    process.end();
}

#[test]
fn a_refused_name_names_the_file_and_the_reason() {
    let mut process = Process::start();
    process.introduce(&json!({}));
    process.show(NAME, RIB);
    let other = RIB.replace("\"rib\"", "\"other\"");
    for (other, new, parts) in [
        (
            other.replace("let half", "let long_dagger = 3 mm\nlet half"),
            "long_dagger",
            ["/other.vcut", "is a value already"],
        ),
        (
            other.replace("blade = dagger", "blade = = dagger"),
            "long_dagger",
            ["/other.vcut:9", "in a part that cannot be read"],
        ),
        (
            other.replace("layer = 5 mm", "layer = long_dagger"),
            "long_dagger",
            ["/other.vcut", "would get another meaning"],
        ),
    ] {
        process.write("other.vcut", &other);
        process.notify("workspace/didChangeWatchedFiles", &json!({ "changes": [] }));
        let answer = rename(&mut process, 70, RIB, "dagger", new);
        let message = answer["error"]["message"].as_str().unwrap_or_default();
        for part in parts {
            assert!(message.contains(part), "{answer}");
        }
    }
    // A job that does not use the file may have what it likes.
    process.write(
        "other.vcut",
        &format!("job \"alone\"\n{BLADES}let long_dagger = 3 mm\n"),
    );
    process.notify("workspace/didChangeWatchedFiles", &json!({ "changes": [] }));
    let answer = rename(&mut process, 71, RIB, "dagger", "long_dagger");
    assert!(answer.get("error").is_none(), "{answer}");
    process.end();
}
