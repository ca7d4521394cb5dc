//! `vcutc fmt`: what is written, what is reported, and what stays as it was.

use super::{folder, json_lines, names, vcutc, vcutc_reading};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const LOOSE: &str = "let  a=1mm // one\r\n";
const TIDY: &str = "let a = 1 mm                                  // one\n";

/// A shop with a job that is in the layout, one that is not, and one with a mistake.
fn shop() -> TempDir {
    let folder = folder();
    let path = folder.path();
    for inside in ["jobs/more", ".hidden"] {
        fs::create_dir_all(path.join(inside)).unwrap();
    }
    fs::write(path.join("rib.vcut"), TIDY).unwrap();
    fs::write(path.join("jobs/more/loose.vcut"), LOOSE).unwrap();
    fs::write(path.join("jobs/broken.vcut"), "let a = \n").unwrap();
    fs::write(path.join(".hidden/loose.vcut"), LOOSE).unwrap();
    fs::write(path.join("jobs/notes.txt"), LOOSE).unwrap();
    folder
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).unwrap()
}

#[test]
fn a_folder_is_formatted_and_files_with_mistakes_are_left() {
    let shop = shop();
    let path = shop.path();
    let run = vcutc(path, &["fmt"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(run.stderr.contains("VC0101"), "{}", run.stderr);
    assert!(
        run.stderr
            .ends_with("1 file formatted, 1 already formatted, 1 skipped (syntax error)\n"),
        "{}",
        run.stderr
    );
    assert_eq!(read(path, "jobs/more/loose.vcut"), TIDY);
    assert_eq!(read(path, "jobs/broken.vcut"), "let a = \n");
    assert_eq!(read(path, ".hidden/loose.vcut"), LOOSE);
    assert_eq!(read(path, "jobs/notes.txt"), LOOSE);
    assert_eq!(read(path, "rib.vcut"), TIDY);
    assert_eq!(names(&path.join("jobs/more")), ["loose.vcut"]);

    fs::remove_file(path.join("jobs/broken.vcut")).unwrap();
    let run = vcutc(path, &["fmt", "rib.vcut", "jobs", "--message-format", "json"]);
    let [tally] = json_lines(&run.stderr).try_into().unwrap();
    assert_eq!((run.code, &tally["kind"]), (Some(0), &"formatted".into()));
    assert_eq!((&tally["unchanged"], &tally["refused"]), (&2.into(), &0.into()));
}

#[test]
fn check_shows_a_diff_and_writes_nothing() {
    let shop = shop();
    let path = shop.path();
    let run = vcutc(path, &["fmt", "--check", "jobs/more", "rib.vcut"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(
        run.stderr.contains("\n-let  a=1mm // one\n+let a = 1 mm  "),
        "{}",
        run.stderr
    );
    assert!(
        run.stderr
            .contains("+++ jobs/more/loose.vcut as vcutc fmt gives it"),
        "{}",
        run.stderr
    );
    assert_eq!(read(path, "jobs/more/loose.vcut"), LOOSE);
    let run = vcutc(path, &["fmt", "--check", "rib.vcut"]);
    assert_eq!(
        (run.code, run.stderr.as_str()),
        (Some(0), "1 file already formatted\n")
    );
}

#[test]
fn standard_input_goes_to_standard_output() {
    let folder = folder();
    let run = vcutc_reading(folder.path(), &["fmt", "-"], LOOSE);
    assert_eq!(
        (run.code, run.stdout.as_str(), run.stderr.as_str()),
        (Some(0), TIDY, "")
    );
    let run = vcutc_reading(folder.path(), &["fmt", "-"], "let a = ");
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(run.stderr.contains("<stdin>"), "{}", run.stderr);
    let run = vcutc_reading(folder.path(), &["fmt", "--check", "-"], LOOSE);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""));
    assert!(run.stderr.contains("+++ <stdin>"), "{}", run.stderr);
    let run = vcutc_reading(folder.path(), &["fmt", "--check", "-"], TIDY);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
}

#[test]
fn what_cannot_be_formatted_is_reported() {
    let shop = shop();
    let path = shop.path();
    fs::create_dir(path.join("empty")).unwrap();
    fs::write(path.join("bytes.vcut"), b"job \"\xff\"\n").unwrap();
    for (arguments, message, code) in [
        (["fmt", "none.vcut"], "cannot format none.vcut", 2),
        (["fmt", "empty"], "it contains no job files (.vcut)", 2),
        (["fmt", "bytes.vcut"], "VC0107", 1),
    ] {
        let run = vcutc(path, &arguments);
        assert_eq!(run.code, Some(code), "{}", run.stderr);
        assert!(run.stderr.contains(message), "{}", run.stderr);
    }
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_permissions_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let shop = shop();
    let path = shop.path();
    let real = path.join("jobs/more/loose.vcut");
    fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&real, path.join("link.vcut")).unwrap();
    let run = vcutc(path, &["fmt", "link.vcut"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert_eq!(read(path, "jobs/more/loose.vcut"), TIDY);
    assert!(path.join("link.vcut").is_symlink());
    assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);
    fs::write(&real, LOOSE).unwrap();
    fs::set_permissions(&real, fs::Permissions::from_mode(0o440)).unwrap();
    let run = vcutc(path, &["fmt", "link.vcut"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert_eq!(read(path, "link.vcut"), LOOSE);
}

/// One broken, one in foreign letters, one write-protected, one that is not a file: the others are formatted
/// all the same, whole, and the run ends with the worst that happened.
#[cfg(unix)]
#[test]
fn files_in_trouble_do_not_keep_others_from_being_formatted() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder();
    let path = folder.path();
    fs::write(path.join("a.vcut"), LOOSE).unwrap();
    fs::write(path.join("broken.vcut"), "let a = \n").unwrap();
    fs::write(path.join("bytes.vcut"), b"job \"\xff\"\n").unwrap();
    fs::write(path.join("locked.vcut"), LOOSE).unwrap();
    fs::set_permissions(path.join("locked.vcut"), fs::Permissions::from_mode(0o444)).unwrap();
    fs::write(path.join("mark.vcut"), "\u{feff}let a = 1 mm\r\n\r\nlet b=2\r\n").unwrap();
    symlink(path.join("nowhere"), path.join("dead.vcut")).unwrap();
    let before = names(path);
    let all = [
        "fmt",
        "a.vcut",
        "broken.vcut",
        "bytes.vcut",
        "locked.vcut",
        "dead.vcut",
        "mark.vcut",
    ];
    let run = vcutc(path, &all);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""), "{}", run.stderr);
    for message in [
        "VC0101",
        "VC0107",
        "cannot format locked.vcut: it is write-protected",
        "cannot format dead.vcut: there is no such file",
        "formatted a.vcut\nformatted mark.vcut\n2 files formatted, 4 skipped (see above)\n",
    ] {
        assert!(run.stderr.contains(message), "{message}: {}", run.stderr);
    }
    assert_eq!(read(path, "a.vcut"), TIDY);
    assert_eq!(read(path, "mark.vcut"), "let a = 1 mm\n\nlet b = 2\n");
    assert_eq!(
        (
            read(path, "locked.vcut").as_str(),
            read(path, "broken.vcut").as_str()
        ),
        (LOOSE, "let a = \n")
    );
    // Nothing is left behind; in a folder dead links are passed over, and files go by their names.
    assert_eq!(names(path), before);
    let run = vcutc(path, &["fmt", "--check", "."]);
    assert_eq!(run.code, Some(1), "{}", run.stderr);
    assert!(run.stderr.contains("--- locked.vcut\n"), "{}", run.stderr);
    assert!(
        run.stderr.ends_with(
            "1 file to format (run again without --check), 2 already formatted, 2 skipped (see above)\n"
        ),
        "{}",
        run.stderr
    );
}
