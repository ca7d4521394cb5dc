//! Blocks that every job must have.

use super::cell::Anchor;
use super::files::File;
use super::gather::Definitions;
use super::kind::Operations;
use super::quantity::number;
use super::report::Reported;
use super::session::{Session, start_of};
use crate::BladeKind;
use vcutc_backend_api::ir::Stock;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::{Code, Diagnostic};

/// Where missing blocks are reported, and where they can be added.
pub(crate) struct Missing {
    anchor: Anchor,
    start: Span,
    /// Name of the root file without folder and ending.
    stem: String,
    /// An operation as an example, with a blade of the job.
    operation: String,
    /// Set when the block may be there but could not be read.
    quiet: Option<Reported>,
}

impl Missing {
    pub(crate) fn of(
        root: &File,
        all: &Definitions<'_>,
        operations: Operations,
        session: &Session<'_>,
    ) -> Self {
        let start = start_of(root.id);
        let text = session
            .sources
            .get(start.file)
            .map_or("", |file| file.text.as_str());
        let end = u32::try_from(text.trim_end().len()).unwrap_or(u32::MAX);
        let end = Span {
            start: end,
            end,
            ..start
        };
        let place = all.job.map_or(start, |name| name.span);
        let file = session
            .sources
            .name(start.file)
            .rsplit('/')
            .next()
            .unwrap_or_default();
        let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        let mut blades = all.blades.iter();
        let straight = blades.find(|(head, _)| head.kind == BladeKind::Straight);
        Self {
            anchor: Anchor { place, end },
            start,
            stem: stem
                .chars()
                .filter(|letter| !matches!(letter, '"' | '\\') && !letter.is_control())
                .collect(),
            operation: operations.0.first().map_or_else(String::new, |kind| {
                kind.example(straight.map_or("dagger", |(head, _)| head.name.node))
            }),
            quiet: session.damage_at(start).or(all.doubtful),
        }
    }

    /// Where to report what the job as a whole lacks.
    pub(crate) const fn anchor(&self) -> Anchor {
        self.anchor
    }

    /// The job has no name.
    pub(crate) fn job(&self, session: &mut Session<'_>) -> Reported {
        let stem = if self.stem.is_empty() { "job" } else { &self.stem };
        let line = format!("job \"{stem}\"");
        let diagnostic = Diagnostic::new(
            Code::MissingBlock,
            "the job has no name",
            self.start,
            "`job` is missing",
        );
        self.report(
            diagnostic.fix(format!("add `{line}`"), self.start, format!("{line}\n")),
            session,
        )
    }

    /// The job has no stock.
    pub(crate) fn stock(&self, session: &mut Session<'_>) -> Reported {
        self.block(
            "stock",
            "`stock` is missing",
            "stock { size = (85 mm, 50 mm, 50 mm) }",
            session,
        )
    }

    /// The job has no part. With a stock the example fits it.
    pub(crate) fn part(&self, stock: Option<Spanned<Stock>>, session: &mut Session<'_>) -> Reported {
        let (width, height) = match stock {
            Some(stock) => (stock.node.width.to_mm(), stock.node.height.to_mm()),
            None => (85.0, 50.0),
        };
        let (width, left, right) = (number(width), number(height * 0.5), number(height * 0.25));
        let example = format!("profile {{ start (0 mm, {left} mm) line to ({width} mm, {right} mm) }}");
        self.block(
            "profile and no surface",
            "`profile` or `surface` is missing",
            &example,
            session,
        )
    }

    /// The job has no operation.
    pub(crate) fn operation(&self, session: &mut Session<'_>) -> Reported {
        self.block(
            "operation",
            "nothing is done to the stock",
            &self.operation,
            session,
        )
    }

    fn block(&self, what: &str, label: &str, example: &str, session: &mut Session<'_>) -> Reported {
        let diagnostic = Diagnostic::new(
            Code::MissingBlock,
            format!("the job has no {what}"),
            self.anchor.place,
            label,
        );
        self.report(
            diagnostic.fix("add one like this", self.anchor.end, format!("\n\n{example}\n")),
            session,
        )
    }

    fn report(&self, diagnostic: Diagnostic, session: &mut Session<'_>) -> Reported {
        match self.quiet {
            Some(reported) => reported,
            None => session.reports.push(diagnostic),
        }
    }
}
