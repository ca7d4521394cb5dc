//! The pages of the diagnostic codes: what they show as wrong is wrong, what they show as fixed compiles.
//!
//! Only complete jobs are tried (blocks with a `job` line and a stock); pieces of jobs are for reading. Files that a page uses are
//! those of `examples`.

use crate::repository::root;
use std::collections::BTreeSet;
use std::fs;
use vcutc::diagnostics::source::{LoadError, Loader};
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::{EmitFailure, Request, SearchEffort, Typed, compile, emit};
use vcutc_backend_api::bundle::Bundle;

const JOB: &str = "page.vcut";

struct Page<'p>(&'p str);

impl Loader for Page<'_> {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        if path == JOB {
            return Ok(self.0.as_bytes().to_vec());
        }
        fs::read(root().join("examples").join(path)).map_err(|_| LoadError::NotFound)
    }
}

/// The codes that a job gives, with all targets of this build.
fn codes(job: &str) -> BTreeSet<Code> {
    let request = Request {
        path: JOB,
        loader: &Page(job),
        overrides: &[],
        machine: None,
        options: Typed::default(),
        effort: SearchEffort::Normal,
        operations: vcutc::registry::OPERATIONS,
        targets: &vcutc::registry::backends(),
    };
    let outcome = compile(request, &mut |_| {}).expect("the page itself can be read");
    let mut diagnostics = outcome.diagnostics.clone();
    if !has_errors(&diagnostics) {
        for backend in vcutc::registry::backends() {
            match emit(&outcome, backend, &mut Bundle::default()) {
                Ok(()) => {}
                Err(EmitFailure::Diagnostics(more)) => diagnostics.extend(more),
                Err(EmitFailure::Sink(reason)) => panic!("{reason}"),
            }
        }
    }
    diagnostics.iter().map(|diagnostic| diagnostic.code).collect()
}

/// The complete jobs of a part of a page.
fn jobs(part: &str) -> impl Iterator<Item = &str> {
    part.split("```vcut\n")
        .skip(1)
        .filter_map(|rest| rest.split("\n```").next())
        .filter(|block| {
            ["job \"", "stock "]
                .iter()
                .all(|word| block.lines().any(|line| line.starts_with(word)))
        })
}

#[test]
fn examples_of_pages_have_the_error_and_mended_ones_do_not() {
    let mut breaches = Vec::new();
    // No job is known that shows a fault of the compiler; it would be fixed.
    for code in Code::ALL.iter().filter(|&&code| code != Code::Internal) {
        let page = code.page();
        let (example, remedy) = page.split_once("\n## What to do\n").unwrap_or((page, ""));
        for job in jobs(example) {
            let found = codes(job);
            if !found.contains(code) {
                breaches.push(format!("{}: the example gives {found:?}", code.number()));
            }
        }
        for job in jobs(remedy) {
            let found = codes(job);
            if found.contains(code) {
                breaches.push(format!("{}: the mended job gives it still", code.number()));
            }
        }
    }
    assert!(breaches.is_empty(), "\n{}\n", breaches.join("\n"));
}
