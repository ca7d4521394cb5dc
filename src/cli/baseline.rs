//! The figures that a repository holds its programs to: the file that `vcut.toml` names, read before a build and held
//! against each program before it takes its place, or rewritten by `--accept`.

use super::Exit;
use super::args::BuildArgs;
use super::console::{Console, Failure};
use super::files::load_file;
use super::output::one_file;
use std::path::Path;
use vcutc_diagnostics::source::{FileId, LoadError, SourceMap, Span, Spanned, join_path, text_from_bytes};
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_driver::manifest::{Manifest, Tolerance};
use vcutc_driver::numbers::Numbers;
use vcutc_driver::numbers::baseline::{self, Name, Record, Worse, worse};

/// Keeps a baseline.
pub(super) struct Keeper {
    /// Its file, as people see it.
    path: String,
    /// Where the list names it.
    named_at: Span,
    /// By how much figures may become worse.
    tolerances: Vec<Tolerance>,
    /// What it has; none when its figures are about to be replaced.
    records: Option<Vec<Record>>,
}

impl Keeper {
    /// The keeper of the baseline that a list names, if it does.
    pub(super) fn new(
        manifest: &Manifest,
        list: &str,
        file: FileId,
        args: &BuildArgs,
        sources: &mut SourceMap,
    ) -> Result<Option<Self>, Vec<Diagnostic>> {
        let Some(baseline) = &manifest.baseline else {
            return if args.accept {
                Err(vec![nothing_to_accept(file)])
            } else {
                Ok(None)
            };
        };
        let path = join_path(list, &baseline.file.node);
        let named_at = baseline.file.span;
        let records = if args.accept {
            None
        } else {
            Some(records(&path, named_at, sources)?)
        };
        Ok(Some(Self {
            path,
            named_at,
            tolerances: baseline.tolerances.clone(),
            records,
        }))
    }

    /// What has become worse by more than it may.
    pub(super) fn judge(&self, name: &Name, numbers: &Numbers, asked_at: Option<Span>) -> Vec<Diagnostic> {
        let Some(records) = &self.records else {
            return Vec::new();
        };
        let Some(record) = records.iter().find(|record| record.name == *name) else {
            return vec![self.unknown(name, asked_at)];
        };
        self.tolerances
            .iter()
            .filter_map(|tolerance| {
                let percent = tolerance.percent;
                let found = worse(tolerance.figure, percent.node, &record.numbers, numbers)?;
                Some(self.complaint(name, found, percent))
            })
            .collect()
    }

    fn complaint(&self, name: &Name, found: Worse, percent: Spanned<f64>) -> Diagnostic {
        let (figure, job) = (found.figure, &name.job);
        let grown = match found.percent() {
            // Never rounded down to what is allowed.
            Some(grown) => format!("{:.2} % more", (grown * 100.0).ceil() / 100.0),
            None => "more".to_owned(),
        };
        Diagnostic::new(
            Code::WorseNumbers,
            format!(
                "{} of {job} for {} has grown from {} to {}",
                figure.words(),
                name.target,
                figure.show(found.was),
                figure.show(found.is)
            ),
            percent.span,
            format!("{grown}, {} % are allowed", percent.node),
        )
        .and(self.named_at, "the figures it is compared with")
        .help("undo what made it worse, or accept the new figures with `vcutc build --accept`")
    }

    fn unknown(&self, name: &Name, asked_at: Option<Span>) -> Diagnostic {
        let message = format!(
            "{} has no figures of {} for {} in \"{}\"",
            self.path, name.job, name.target, name.output
        );
        let diagnostic = match asked_at {
            Some(place) => Diagnostic::new(Code::NoBaseline, message, place, "asked for here")
                .and(self.named_at, "the figures that programs are compared with"),
            None => Diagnostic::new(
                Code::NoBaseline,
                message,
                self.named_at,
                "the figures that programs are compared with",
            ),
        };
        diagnostic.help("add them with `vcutc build --accept`")
    }

    /// Writes the figures of programs that were made; those of others that are still listed stay. A file that holds anything
    /// else is left as it is: it may be a job, or the list itself.
    pub(super) fn accept(&self, fresh: Vec<Record>, listed: &[Name], console: &Console) -> Exit {
        let earlier = match self.earlier() {
            Ok(earlier) => earlier,
            Err(reason) => {
                let help = "name another file in `[baseline]`, or remove this one if it is of no use";
                return console.failure(&Failure::new(reason).help(help));
            }
        };
        let is_fresh = |name: &Name| fresh.iter().any(|record| record.name == *name);
        let kept = earlier
            .into_iter()
            .filter(|record| listed.contains(&record.name) && !is_fresh(&record.name));
        let records: Vec<Record> = kept.chain(fresh.iter().cloned()).collect();
        match one_file(Path::new(&self.path), baseline::write(records).as_bytes()) {
            Ok(_) => Exit::Success,
            Err(reason) => console.failure(&Failure::new(reason)),
        }
    }

    /// What the file has so far; nothing when it is not there.
    fn earlier(&self) -> Result<Vec<Record>, String> {
        let bytes = match load_file(Path::new(&self.path)) {
            Ok(bytes) => bytes,
            Err(LoadError::NotFound) => return Ok(Vec::new()),
            Err(reason) => return Err(format!("cannot read {}: {reason}", self.path)),
        };
        let read = text_from_bytes(bytes)
            .ok()
            .map(|text| baseline::read(FileId::ALONE, &text));
        match read {
            Some(Ok(records)) => Ok(records),
            Some(Err(_)) | None => Err(format!(
                "{} does not contain figures of programs, so it is not overwritten",
                self.path
            )),
        }
    }
}

fn records(path: &str, named_at: Span, sources: &mut SourceMap) -> Result<Vec<Record>, Vec<Diagnostic>> {
    let unusable = |message: String, label: &str| {
        vec![
            Diagnostic::new(Code::BadBaseline, message, named_at, label)
                .help("write it with `vcutc build --accept`"),
        ]
    };
    let bytes = match load_file(Path::new(path)) {
        Ok(bytes) => bytes,
        Err(LoadError::NotFound) => return Err(unusable(format!("there is no file {path}"), "no such file")),
        Err(reason) => {
            return Err(unusable(
                format!("cannot read {path}: {reason}"),
                "cannot be read",
            ));
        }
    };
    let Ok(text) = text_from_bytes(bytes) else {
        return Err(unusable(format!("{path} is not UTF-8 text"), "no text"));
    };
    let file = sources.add(path.to_owned(), text.clone());
    baseline::read(file, &text).map_err(|fault| vec![fault.and(named_at, "named here")])
}

fn nothing_to_accept(file: FileId) -> Diagnostic {
    let message = "the list names no file for the figures of programs";
    Diagnostic::new(
        Code::BadBaseline,
        message,
        Span::of_bytes(file, 0..0),
        "no `[baseline]`",
    )
    .help("add `[baseline]` with `file = \"numbers.json\"` and `time = \"2 %\"`")
}
