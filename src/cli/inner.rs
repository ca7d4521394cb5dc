//! `--emit`: the forms a job has between its text and the program.
//!
//! Only the intermediate program is an exchange format with a version; tree and plan are for reading.

use super::args::InnerForm;
use crate::driver::Outcome;
use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use vcutc_backend_api::bundle::{Sink, SinkError};

/// Writes a form of the job as one file. Returns whether the job got far enough to have it.
pub(super) fn write(
    form: InnerForm,
    outcome: &Outcome,
    job: &str,
    sink: &mut dyn Sink,
) -> Result<Progressed, SinkError> {
    let name = file_name(form, job);
    match form {
        InnerForm::Ast => match &outcome.ast {
            Some(ast) => text_file(sink, &name, &format!("{ast:#?}\n")),
            None => Ok(Progressed::NotSoFar),
        },
        InnerForm::Plan => match &outcome.compiled {
            Some(compiled) => text_file(sink, &name, &lines(&compiled.summary)),
            None => Ok(Progressed::NotSoFar),
        },
        InnerForm::Ir => match &outcome.compiled {
            Some(compiled) => {
                sink.file(&name)?;
                json(compiled.program.program(), sink)?;
                Ok(Progressed::Written)
            }
            None => Ok(Progressed::NotSoFar),
        },
    }
}

/// Whether a job got as far as a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Progressed {
    /// The form is written.
    Written,
    /// Errors kept the job from getting there.
    NotSoFar,
}

/// `jobs/rib.vcut` as a tree is `rib.ast.txt`.
fn file_name(form: InnerForm, job: &str) -> String {
    let file = job.rsplit('/').next().unwrap_or(job);
    let stem = file.strip_suffix(".vcut").unwrap_or(file);
    let stem = if stem.starts_with('<') { "stdin" } else { stem };
    let ending = match form {
        InnerForm::Ast => "ast.txt",
        InnerForm::Plan => "plan.txt",
        InnerForm::Ir => "ir.json",
    };
    format!("{stem}.{ending}")
}

fn text_file(sink: &mut dyn Sink, name: &str, text: &str) -> Result<Progressed, SinkError> {
    sink.file(name)?;
    sink.write(text.as_bytes())?;
    Ok(Progressed::Written)
}

fn lines(lines: &[String]) -> String {
    let mut text = String::new();
    for line in lines {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{line}");
    }
    text
}

/// Streams a value as indented JSON: a program of a million cuts is hundreds of megabytes of text.
fn json(value: &impl serde::Serialize, sink: &mut dyn Sink) -> Result<(), SinkError> {
    let mut writer = BufWriter::new(SinkWriter(sink));
    serde_json::to_writer_pretty(&mut writer, value).map_err(|error| SinkError(error.to_string()))?;
    writer
        .write_all(b"\n")
        .and_then(|()| writer.flush())
        .map_err(|error| SinkError(error.to_string()))
}

/// A sink as a writer.
struct SinkWriter<'s>(&'s mut dyn Sink);

impl Write for SinkWriter<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0
            .write(bytes)
            .map_err(|error| io::Error::other(error.to_string()))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use vcutc_backend_api::bundle::Bundle;

    #[test]
    fn files_are_named_after_the_job() {
        assert_eq!(file_name(InnerForm::Ir, "jobs/rib.vcut"), "rib.ir.json");
        assert_eq!(file_name(InnerForm::Ast, "rib"), "rib.ast.txt");
        assert_eq!(file_name(InnerForm::Plan, "<stdin>"), "stdin.plan.txt");
    }

    #[test]
    fn a_value_streams_into_the_file_whole() {
        let mut bundle = Bundle::default();
        bundle.file("a.json").unwrap();
        let value: Vec<u32> = (0..10_000).collect();
        json(&value, &mut bundle).unwrap();
        let bytes = bundle.get("a.json").unwrap();
        assert_eq!(serde_json::from_slice::<Vec<u32>>(bytes).unwrap(), value);
    }
}
