//! Targets that are programs of their own: good ones, and every way not to be one.

use super::jobs::RIB;
use super::{Run, folder, json_lines, names, vcutc};
use crate::repository::{read, root};
use std::fs::{self, Permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::time::{Duration, Instant};
use tempfile::TempDir;
use vcutc_backend_api::ir::Program;

/// A description that is as it should be, of a program `odd`.
const DESCRIPTION: &str = r#"{"protocol":2,"id":"odd","summary":"oddities","capabilities":["linear_move","joint_move","still_tip_turn","output","await_input","dwell"],"options":[{"key":"size","kind":"integer","min":1,"max":9,"default":2,"help":"A size."},{"key":"style","kind":"choice","of":["plain","fancy"],"help":"A style."}],"machines":[{"kind":"robot","makers":["kuka"]}],"drives":"KUKA robots"}"#;

/// A folder with a job and a program `vcutc-backend-odd`.
fn with_program(script: &str) -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    install(folder.path(), script);
    folder
}

fn install(folder: &Path, script: &str) {
    let path = folder.join("vcutc-backend-odd");
    fs::write(&path, script).unwrap();
    fs::set_permissions(&path, Permissions::from_mode(0o755)).unwrap();
}

/// A program that describes itself well and answers this when it is to write.
fn answering(reply: &str) -> String {
    format!(
        "#!/bin/sh\ncase \"$(cat)\" in\n*'\"ask\":\"describe\"'*) cat <<'END'\n{DESCRIPTION}\nEND\n;;\n*) cat <<'END'\n{reply}\nEND\n;;\nesac\n"
    )
}

fn compiled(folder: &Path) -> Run {
    let args = [
        "rib.vcut",
        "--target",
        "odd",
        "--backend-path",
        ".",
        "-o",
        "out",
        "-q",
        "--backend-timeout",
        "20",
    ];
    vcutc(folder, &args)
}

/// How many ops the program of the job has.
fn ops() -> usize {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    let run = vcutc(folder.path(), &["rib.vcut", "--emit", "ir", "-q"]);
    let program: Program = serde_json::from_str(&run.stdout).unwrap();
    program.ops.len()
}

/// What is said of `ops` ops that all stand in the first line of the first file.
fn said(ops: impl Iterator<Item = usize>) -> String {
    let said: Vec<String> = ops
        .map(|op| format!(r#"{{"op":{op},"file":0,"line":1}}"#))
        .collect();
    said.join(",")
}

#[test]
fn a_program_that_cannot_describe_itself_is_refused_before_the_job_is_read() {
    let wrong_id = format!(
        "#!/bin/sh\ncat <<'END'\n{}\nEND\n",
        DESCRIPTION.replace("\"odd\"", "\"even\"")
    );
    let profile = format!(
        "#!/bin/sh\ncat <<'END'\n{}\nEND\n",
        DESCRIPTION.replace("\"size\"", "\"profile\"")
    );
    let default = format!(
        "#!/bin/sh\ncat <<'END'\n{}\nEND\n",
        DESCRIPTION.replace("\"default\":2", "\"default\":20")
    );
    let word = format!(
        "#!/bin/sh\ncat <<'END'\n{}\nEND\n",
        DESCRIPTION.replace("\"fancy\"", "\"default\"")
    );
    for (script, says) in [
        (
            "#!/bin/sh\necho first >&2\necho oh no >&2\nexit 3\n",
            "ended with exit status 3\n  help: it says: first\n  help: it says: oh no",
        ),
        ("#!/bin/sh\nkill -TERM $$\n", "was stopped (signal: 15"),
        (
            "#!/bin/sh\necho hello\n",
            "answers something other than the protocol requires: expected value at line 1 column 1\n  help: it says: hello ...",
        ),
        (
            "#!/bin/sh\ntrue\n",
            "answers something other than the protocol requires: EOF",
        ),
        ("#!/bin/sh\necho '{}'\n", "missing field `protocol`"),
        ("#!/bin/sh\necho '{\"protocol\":2}'\n", "missing field `id`"),
        (
            "#!/bin/sh\necho '{\"protocol\":3}'\n",
            "speaks version 3 of the protocol, this compiler version 2",
        ),
        ("#!/bin/sh\nyes\n", "answers more than 1048576 bytes"),
        ("#!/nowhere/at/all\n", "cannot be started"),
        (
            &wrong_id,
            "says that its id is `even`, but its file is named for `odd`",
        ),
        (
            &profile,
            "has an option `profile` which is the key under which jobs name a profile",
        ),
        (&default, "has an option `size` whose default is not in its range"),
        (
            &word,
            "has an option `style` with the word `default`, by which jobs take an option back",
        ),
    ] {
        let folder = with_program(script);
        let run = compiled(folder.path());
        assert_eq!(run.code, Some(2), "{script}: {}", run.stderr);
        let head = "error: the program of target `odd` ";
        assert!(
            run.stderr.starts_with(head) && run.stderr.contains(says),
            "{script}: {}",
            run.stderr
        );
        assert_eq!(names(folder.path()), ["rib.vcut", "vcutc-backend-odd"]);
    }
}

#[test]
fn a_program_that_may_not_be_run_says_how_it_may() {
    let folder = with_program(&answering("{}"));
    let program = folder.path().join("vcutc-backend-odd");
    fs::set_permissions(program, Permissions::from_mode(0o644)).unwrap();
    let run = compiled(folder.path());
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("chmod +x ./vcutc-backend-odd"),
        "{}",
        run.stderr
    );
}

/// It is stopped together with what it has started, and the compiler does not wait for either.
#[test]
fn a_program_that_hangs_is_stopped_with_its_children() {
    let folder = with_program("#!/bin/sh\nsleep 1000 &\necho $! > child\nwait\n");
    let started = Instant::now();
    let run = vcutc(
        folder.path(),
        &[
            "rib.vcut",
            "--target",
            "odd",
            "--backend-path",
            ".",
            "--backend-timeout",
            "1",
        ],
    );
    assert!(
        started.elapsed() < Duration::from_secs(500),
        "the sleep is not waited for"
    );
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("did not finish within 1 s"), "{}", run.stderr);
    assert_child_is_stopped(folder.path());
}

/// The program ends at once and its child keeps the pipe open: it is not known whether all of the reply is
/// there.
#[test]
fn children_of_a_program_that_has_ended_are_stopped_with_the_time() {
    let folder = with_program("#!/bin/sh\nsleep 1000 &\necho $! > child\necho '{}'\nexit 0\n");
    let args = [
        "rib.vcut",
        "--target",
        "odd",
        "--backend-path",
        ".",
        "--backend-timeout",
        "1",
    ];
    let run = vcutc(folder.path(), &args);
    assert_eq!(run.code, Some(2));
    assert!(run.stderr.contains("did not finish within 1 s"), "{}", run.stderr);
    assert_child_is_stopped(folder.path());
}

/// Whether the reply is good makes no difference: nothing of a program is left behind.
#[test]
fn children_of_a_program_that_has_answered_are_stopped() {
    let all = said(0..ops());
    let reply = format!(r#"{{"protocol":2,"files":[{{"name":"rib.txt","text":"x"}}],"said":[{all}]}}"#);
    let script = answering(&reply).replacen(
        "#!/bin/sh\n",
        "#!/bin/sh\nsleep 1000 < /dev/null > /dev/null 2>&1 &\necho $! > child\n",
        1,
    );
    let folder = with_program(&script);
    let run = compiled(folder.path());
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_child_is_stopped(folder.path());
}

/// Waits for the end of the process whose number a program has written into `child`.
fn assert_child_is_stopped(folder: &Path) {
    let child = fs::read_to_string(folder.join("child")).unwrap();
    let runs = || {
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.trim()));
        stat.is_ok_and(|stat| !stat.contains(") Z"))
    };
    let mut looks = 0;
    while runs() && looks < 200 {
        looks += 1;
        std::thread::sleep(Duration::from_millis(10));
    }
    assert!(!runs(), "{child} still runs");
}

#[test]
fn what_is_not_a_program_is_not_written() {
    let ops = ops();
    let all = said(0..ops);
    let file =
        |name: &str| format!(r#"{{"protocol":2,"files":[{{"name":"{name}","text":"x"}}],"said":[{all}]}}"#);
    let saying =
        |said: &str| format!(r#"{{"protocol":2,"files":[{{"name":"a.nc","text":"x"}}],"said":[{said}]}}"#);
    let skipped = said((0..ops).filter(|op| *op != 5));
    let twice = format!("{all},{}", said(3..4));
    let beyond = format!("{all},{}", said(ops..ops + 1));
    let elsewhere = format!("{},{{\"op\":0,\"file\":0,\"line\":2}}", said(1..ops));
    for (reply, says) in [
        (
            "nonsense".to_owned(),
            "answers something other than the protocol requires",
        ),
        (r#"{"protocol":2}"#.to_owned(), "answers without any file"),
        (file("../a.nc"), "calls a file `../a.nc`"),
        (file("a/b.nc"), "calls a file `a/b.nc`"),
        (file("/tmp/a.nc"), "calls a file `/tmp/a.nc`"),
        (file("con.nc"), "calls a file `con.nc`"),
        (file("LPT1"), "calls a file `LPT1`"),
        (file(".hidden"), "calls a file `.hidden`"),
        (file(""), "calls a file ``"),
        (
            file(r#"a.nc","text":"x"},{"name":"A.NC"#),
            "answers two files called `A.NC`",
        ),
        (saying(""), "does not say op 0, nor"),
        (saying(&skipped), "does not say op 5\n"),
        (saying(&twice), "says op 3 twice"),
        (saying(&beyond), "the program has"),
        (
            saying(&elsewhere),
            "says op 0 at line 2 of file 0, which is not there",
        ),
    ] {
        let folder = with_program(&answering(&reply));
        let run = compiled(folder.path());
        assert_eq!(run.code, Some(1), "{reply}: {}", run.stderr);
        assert!(
            run.stderr.contains("VC0609") && run.stderr.contains(says),
            "{reply}: {}",
            run.stderr
        );
        assert!(!folder.path().join("out").exists(), "{reply}");
    }
    let folder = with_program(&answering(&file("a.nc")));
    let run = compiled(folder.path());
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    assert_eq!(fs::read_to_string(folder.path().join("out/a.nc")).unwrap(), "x");
}

#[test]
fn problems_become_diagnostics_at_their_places() {
    let reply = r#"{"protocol":2,"problems":[
        {"problem":"unsupported","op":4,"what":"cuts on Sundays"},
        {"problem":"out_of_range","what":"output number","value":"12","allowed":"from 1 to 8"},
        {"problem":"option_conflict","key":"size","why":"too small for this part"},
        {"problem":"missing_machine_field","field":"ready","why":"to know when"},
        {"problem":"profile","key":"footer","why":"there is none"},
        {"problem":"wrong_machine","mismatch":"arm"}
    ]}"#;
    let folder = with_program(&answering(reply));
    let run = vcutc(
        folder.path(),
        &[
            "rib.vcut",
            "--target",
            "odd",
            "--backend-path",
            ".",
            "--message-format",
            "json",
        ],
    );
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    let codes: Vec<String> = json_lines(&run.stderr)
        .iter()
        .filter_map(|line| Some(line.get("code")?.as_str()?.to_owned()))
        .collect();
    assert_eq!(
        codes,
        ["VC0605", "VC0606", "VC0604", "VC0602", "VC0604", "VC0607"]
    );
}

#[test]
fn options_of_a_program_are_checked_like_all_others() {
    let job = RIB.replace(
        "output(12)\n",
        "output(12)\n  odd { size = 10, style = fancyy, colour = 3 }\n",
    );
    assert_ne!(job, RIB);
    let folder = with_program(&answering("{}"));
    fs::write(folder.path().join("rib.vcut"), &job).unwrap();
    let run = compiled(folder.path());
    assert_eq!(run.code, Some(1));
    for says in [
        "option `size` takes a whole number from 1 to 9",
        "one of plain, fancy",
        "has no option `colour`",
    ] {
        assert!(run.stderr.contains(says), "{}", run.stderr);
    }
    // Another target leaves the block alone, and does not run the program.
    install(folder.path(), "#!/bin/sh\nexit 3\n");
    let run = vcutc(
        folder.path(),
        &["rib.vcut", "--target", "krl", "--backend-path", ".", "-q"],
    );
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
}

#[test]
fn a_machine_that_a_program_does_not_drive_is_refused_without_asking_it() {
    let abb = DESCRIPTION
        .replace("kuka", "abb")
        .replace("KUKA robots", "ABB robots");
    let folder = with_program(&format!(
        "#!/bin/sh\ncase \"$(cat)\" in\n*describe*) echo '{abb}' ;;\n*) exit 9 ;;\nesac\n"
    ));
    let run = compiled(folder.path());
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr.contains("VC0607") && run.stderr.contains("`odd` drives ABB robots"),
        "{}",
        run.stderr
    );
}

#[test]
fn programs_are_listed_by_name_and_run_only_to_be_described() {
    let folder = with_program("#!/bin/sh\ntouch ran\nexit 3\n");
    for other in ["vcutc-backend-krl", "vcutc-backend-Two.words", "vcutc-backend-"] {
        fs::write(folder.path().join(other), "").unwrap();
    }
    let run = vcutc(folder.path(), &["targets", "--backend-path", "."]);
    assert_eq!(run.code, Some(0));
    let (_, outside) = run.stdout.split_once("Programs outside of the compiler").unwrap();
    assert!(outside.contains("  odd  ./vcutc-backend-odd\n"), "{outside}");
    assert!(
        outside.contains("krl  ./vcutc-backend-krl  (not used"),
        "{outside}"
    );
    assert!(!outside.contains("words"), "{outside}");
    assert!(!folder.path().join("ran").exists());

    install(folder.path(), &answering("{}"));
    let run = vcutc(folder.path(), &["targets", "odd", "--backend-path", "."]);
    assert_eq!(run.code, Some(0));
    insta::assert_snapshot!(run.stdout);
}

/// One job and several, written and compared; with a target that has a reader nothing is said.
#[test]
fn a_program_that_is_not_read_back_is_reported() {
    const NOTE: &str = "; not read back: target odd has no reader\n";
    let all = said(0..ops());
    let reply = format!(r#"{{"protocol":2,"files":[{{"name":"rib.txt","text":"x"}}],"said":[{all}]}}"#);
    let folder = with_program(&answering(&reply));
    let odd = ["rib.vcut", "--target", "odd", "--backend-path", "."];
    let list = "[[program]]\njobs = \"rib.vcut\"\ntarget = \"odd\"\noutput = \"out\"\n";
    fs::write(folder.path().join("vcut.toml"), list).unwrap();
    for args in [
        &odd[..],
        &[&odd[..], &["--check"]].concat(),
        &["build", "--backend-path", "."],
    ] {
        let run = vcutc(folder.path(), args);
        assert_eq!(run.code, Some(0), "{}", run.stderr);
        assert!(run.stderr.contains(NOTE), "{}", run.stderr);
    }
    let run = vcutc(folder.path(), &["rib.vcut", "--target", "krl"]);
    assert_eq!(run.code, Some(0));
    assert!(!run.stderr.contains("not read back"), "{}", run.stderr);
}

/// The example in Python, as its own first lines say to use it.
#[test]
fn the_example_in_python_writes_a_statement_for_every_op() {
    let folder = folder();
    fs::write(
        folder.path().join("rib.vcut"),
        RIB.replace("output(12)\n", "output(12)\n  apt { profile = \"shop.toml\" }\n"),
    )
    .unwrap();
    fs::write(
        folder.path().join("shop.toml"),
        "header = [\"PPRINT/SHOP 2\"]\ndecimals = 5\nextension = \"cl\"\n",
    )
    .unwrap();
    let examples = root().join("examples/backends");
    let run = vcutc(
        folder.path(),
        &[
            "rib.vcut",
            "--target",
            "apt",
            "--backend-path",
            examples.to_str().unwrap(),
            "-o",
            "out",
            "-q",
        ],
    );
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let text = fs::read_to_string(folder.path().join("out/rib.cl")).unwrap();
    assert!(
        text.starts_with("PARTNO/rib\nUNITS/MM\nPPRINT/SHOP 2\nGOHOME\n") && text.ends_with("GOHOME\nFINI\n")
    );
    assert_eq!(text.lines().count(), ops() + 4);
    let first = text
        .lines()
        .find_map(|line| line.strip_prefix("RAPID;GOTO/"))
        .unwrap();
    let x = first.split(',').next().unwrap();
    assert_eq!(x.split_once('.').unwrap().1.len(), 5, "{first}");
}

/// Blades that are changed, spindles and arcs: jobs of the examples, on their own machines.
#[test]
fn the_example_in_python_has_words_for_changes_spindles_and_chains() {
    let folder = folder();
    let out = folder.path().to_str().unwrap();
    let words = [
        ("two_blades", &["GOTO/CHANGE\nLOADTL/4 $$ dagger\n"][..]),
        ("hill_rect", &["\nSPINDL/3000.0,RPM\n", "\nSPINDL/OFF\n"]),
        ("tray", &["GOFWD/(CIRCLE/"]),
    ];
    for (name, words) in words {
        let job = format!("examples/{name}.vcut");
        let args = [
            &job,
            "--target",
            "apt",
            "--backend-path",
            "examples/backends",
            "-o",
            out,
            "-q",
        ];
        let run = vcutc(root(), &args);
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{name}");
        let text = fs::read_to_string(folder.path().join(format!("{name}.apt"))).unwrap();
        for word in words {
            assert!(text.contains(word), "{name}: {word}");
        }
    }
}

/// The program of `docs/backends.md`, installed as the page says.
fn with_the_program_of_the_page() -> TempDir {
    let folder = folder();
    fs::write(folder.path().join("rib.vcut"), RIB).unwrap();
    let page = read("docs/backends.md");
    let (_, program) = page.split_once("```python\n").unwrap();
    let (program, _) = program.split_once("```").unwrap();
    let path = folder.path().join("vcutc-backend-deeds");
    fs::write(&path, program).unwrap();
    fs::set_permissions(&path, Permissions::from_mode(0o755)).unwrap();
    folder
}

#[test]
fn what_an_outside_program_wrote_is_read_back_and_verified() {
    let folder = with_the_program_of_the_page();
    let vcutc = |args: &[&str]| vcutc(folder.path(), &[args, &["--backend-path", ".", "-q"]].concat());
    let run = vcutc(&["rib.vcut", "--target", "deeds"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let verify = ["verify", "rib.vcut", "job_rib.jsonl", "--target", "deeds"];
    let run = vcutc(&verify);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));

    let path = folder.path().join("job_rib.jsonl");
    let text = fs::read_to_string(&path).unwrap();
    let changed = text.replacen("\"tip\": 200.0", "\"tip\": 250.0", 1);
    assert_ne!(changed, text);
    fs::write(&path, changed).unwrap();
    let run = vcutc(&verify);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("job_rib.jsonl:"), "{}", run.stderr);
}

#[test]
fn a_program_that_writes_something_else_than_it_was_given_is_found_out() {
    let folder = with_the_program_of_the_page();
    let path = folder.path().join("vcutc-backend-deeds");
    let program = fs::read_to_string(&path).unwrap();
    for (right, wrong, says) in [
        (
            "\"tip\": feed",
            "\"tip\": feed and feed + 1.0",
            "the tip moves at 201 mm/s",
        ),
        (
            "\"end\": \"exact\"",
            "\"end\": \"rounded\"",
            "report this to the authors of `vcutc-backend-deeds`",
        ),
        (
            "yield {\"axes\": axes}",
            "yield {\"axes\": [axes[0] + 0.001] + axes[1:]}",
            "wrote something other than the program it was given",
        ),
        (
            "\"end\": start + length}",
            "\"end\": start + length + 10**6}",
            "which are not there",
        ),
        (
            "answer = {",
            "if request[\"ask\"] == \"read\": sys.exit(4)\nanswer = {",
            "ended with exit status 4",
        ),
    ] {
        assert!(program.contains(right), "{right}");
        fs::write(&path, program.replace(right, wrong)).unwrap();
        let run = vcutc(
            folder.path(),
            &["rib.vcut", "--target", "deeds", "--backend-path", ".", "-q"],
        );
        assert_eq!(run.code, Some(1), "{wrong}: {}", run.stderr);
        assert!(
            run.stderr.contains(says) && run.stderr.contains("VC0609"),
            "{wrong}: {}",
            run.stderr
        );
        assert!(!folder.path().join("job_rib.jsonl").exists(), "{wrong}");
    }
}

/// With a grain that wide every program would be every other.
#[test]
fn a_program_cannot_switch_the_comparison_off_by_its_grain() {
    let folder = with_the_program_of_the_page();
    let path = folder.path().join("vcutc-backend-deeds");
    let program = fs::read_to_string(&path).unwrap();
    let right = "dict.fromkeys(EXACT, 0.0)";
    assert!(program.contains(right));
    for (key, value, code) in [
        ("length", "0.01", 0),
        ("length", "1e9", 2),
        ("attitude", "0.002", 2),
        ("axis", "0.002", 2),
        ("speed", "1.1", 2),
        ("rate", "0.02", 2),
        ("per_minute", "2.0", 2),
        ("time", "0.1", 2),
        ("time", "-0.1", 2),
    ] {
        let wide = format!("dict(dict.fromkeys(EXACT, 0.0), {key}={value})");
        fs::write(&path, program.replace(right, &wide)).unwrap();
        let run = vcutc(
            folder.path(),
            &["rib.vcut", "--target", "deeds", "--backend-path", ".", "-q"],
        );
        assert_eq!(run.code, Some(code), "{key}: {}", run.stderr);
        let says = format!("prints too coarsely to compare anything: `{key}` is 0 to ");
        assert_eq!(run.stderr.contains(&says), code == 2, "{key}: {}", run.stderr);
    }
    // Half a unit of the last decimal, with as many decimals as the job asks for.
    let option = "\"options\": [{\"key\": \"decimals\", \"kind\": \"integer\", \"min\": 0, \"max\": 6, \"default\": 6, \"help\": \"x\"}]";
    let halves = program
        .replace("\"options\": []", option)
        .replace(right, "dict.fromkeys(EXACT, 0.5), \"decimals\": \"decimals\"");
    fs::write(&path, halves).unwrap();
    for (decimals, code) in [("6", 0), ("1", 1)] {
        let run = vcutc(
            folder.path(),
            &[
                "rib.vcut",
                "--target",
                "deeds",
                "--backend-path",
                ".",
                "-q",
                "--option",
                &format!("decimals={decimals}"),
            ],
        );
        assert_eq!(run.code, Some(code), "{decimals}: {}", run.stderr);
        assert_eq!(run.stderr.contains("VC0609"), code == 1, "{}", run.stderr);
    }
}
