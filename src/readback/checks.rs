//! What a program that is not the job's would do: the rules of the process, the contour, and the reach of the
//! machine, reported at the lines of the program.
//!
//! The same proofs as for a fresh program are run on the one that was rebuilt from the statements. Those of chips and reach
//! need a program that keeps the rules; that no cut enters the part is looked at in any case.

use super::comparison::Comparison;
use super::rebuild::{Obstacle, Rebuilt};
use super::wording::{cut_words, op_words};
use std::collections::BTreeMap;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Flank, OpId, Program, Purpose, Site, ToolId};
use vcutc_backend_api::readback::{Comparator, Mismatch, Moment, Reader};
use vcutc_backend_api::segments::{LinearSegment, Path};
use vcutc_backend_api::verify::{Fault, Rule, VerifiedProgram, verify};
use vcutc_diagnostics::number::show;
use vcutc_diagnostics::source::Span;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_job::PlannedJob;
use vcutc_machine::Model;
use vcutc_motion::describe::site_words;
use vcutc_motion::solve::{Changes, LEAST_CLEARANCE, Reached, Unreachable, Unreached, solve};
use vcutc_motion::verdict as reach_verdict;
use vcutc_process::verdict;
use vcutc_simulation::prove::{CutFault, Finding, Passes};
use vcutc_simulation::report::report;
use vcutc_simulation::slit::{Entry, deepest, edge};
use vcutc_simulation::timing::timing;

/// What is needed to prove a program that was read.
#[derive(Clone, Copy)]
pub(super) struct Checker<'b> {
    pub(super) comparison: &'b Comparison<'b>,
    pub(super) plan: &'b PlannedJob,
    pub(super) model: &'b Model,
    pub(super) reader: &'b dyn Reader,
}

impl Checker<'_> {
    /// Everything that is wrong with what the program would do.
    pub(super) fn findings(&self, rebuilt: Rebuilt) -> Vec<Diagnostic> {
        let comparison = self.comparison;
        if rebuilt.program == *comparison.program() {
            return self.configurations(&rebuilt, None);
        }
        let read = Read {
            checker: *self,
            proven: (comparison.program().segments())
                .map(|segment| segment.path())
                .collect(),
            rebuilt: &rebuilt,
        };
        let mut found: Vec<Diagnostic> = read.entries().into_iter().chain(read.halves()).collect();
        match verify(rebuilt.program.clone()) {
            Err(faults) => found.extend(read.rules(&faults)),
            Ok(verified) => {
                let is_reported = !found.is_empty();
                found.extend(match verified.program().purpose {
                    Purpose::Work => read.contour(&verified, is_reported),
                    // Its cuts free nothing, and the rules keep them above the stock.
                    Purpose::AirCut { .. } => Vec::new(),
                });
                found.extend(read.reach(verified));
            }
        }
        found
    }

    /// Ways to stand as the program says them that are not those that were proven.
    fn configurations(&self, rebuilt: &Rebuilt, reached: Option<&Reached>) -> Vec<Diagnostic> {
        let proven = reached.map_or_else(
            || self.comparison.comparator.reachable(),
            |reached| &reached.program,
        );
        let comparator = Comparator::new(proven, self.reader, self.comparison.resolution);
        let said = rebuilt.program.segments().zip(&rebuilt.origins);
        let other = said.filter_map(|(segment, &given)| {
            let op = segment.id;
            let command = self.comparison.given.effect(given)?.command()?;
            let before = segment.before;
            let mismatches = comparator.mismatches(Moment { op, before }, command);
            let stands =
                |found: &&Mismatch| matches!(found, Mismatch::Configuration { .. } | Mismatch::Axis { .. });
            mismatches.iter().find(stands).map(|_| (op, given))
        });
        let other: Vec<_> = other.collect();
        let Some(&(op, given)) = other.first() else {
            return Vec::new();
        };
        let diagnostic = Diagnostic::new(
            Code::ProgramReach,
            format!(
                "{}: the arm configuration that the program states is not the one that was proven",
                op_words(&rebuilt.program, op)
            ),
            self.span(given),
            "stated here",
        )
        .note("with the program's own configuration, the axes may leave their limits")
        .help("restore the line, or compile the job again");
        vec![and_more(diagnostic, other.len() - 1)]
    }

    fn span(&self, given: usize) -> Span {
        self.comparison.span(given)
    }
}

const fn frees_strips(passes: Option<Passes>) -> bool {
    matches!(passes, Some(Passes::Strips(_)))
}

/// Why nothing of this was looked at.
pub(super) fn left_out(comparison: &Comparison<'_>, obstacle: Obstacle) -> Diagnostic {
    let (given, why, label) = match obstacle {
        Obstacle::NotUnderstood(given) => (
            given,
            "the effect of this statement is unknown",
            "could do anything",
        ),
        Obstacle::Depends(given) => (
            given,
            "motions depend on this, and their effect is unknown because it differs from what the compiler writes",
            "motions depend on this",
        ),
        Obstacle::OtherFrame(given) => (
            given,
            "the program sets a frame that is not the job's, so the position of the work is unknown",
            "not the job's frame",
        ),
        Obstacle::TooManyKinds(given) => (
            given,
            "it has more speeds or postures than any program of this compiler",
            "one too many",
        ),
        Obstacle::SpeedUnknown(given) => (
            given,
            "the speed of this motion is not stated, or depends on the controller",
            "of unknown speed",
        ),
    };
    let span = comparison.span(given);
    Diagnostic::new(
        Code::ChecksLeftOut,
        "what the program does to the part, and whether the machine reaches it, was not checked",
        span,
        label,
    )
    .note(why)
    .help("fix this line first, then verify again")
}

fn and_more(diagnostic: Diagnostic, others: usize) -> Diagnostic {
    match others {
        0 => diagnostic,
        1 => diagnostic.note("the same applies to one more line"),
        _ => diagnostic.note(format!("the same applies to {others} more lines")),
    }
}

/// A program as it was read, on the bench.
struct Read<'r> {
    checker: Checker<'r>,
    rebuilt: &'r Rebuilt,
    /// What the ops of the fresh program move.
    proven: Vec<Path>,
}

/// A cut of a program: its op, and from where to where the blade goes.
#[derive(Clone, Copy)]
struct CutAt {
    op: OpId,
    site: Site,
    flank: Flank,
    /// The blade at hand.
    tool: ToolId,
    line: LinearSegment,
}

impl Read<'_> {
    fn program(&self) -> &Program {
        &self.rebuilt.program
    }

    fn span(&self, op: OpId) -> Span {
        let given = self.rebuilt.origins.get(op.0 as usize).copied();
        self.checker.span(given.unwrap_or(usize::MAX))
    }

    /// A diagnostic at the line of an op, with the job's operation as the other party.
    fn at(&self, code: Code, message: String, op: OpId, label: impl Into<String>) -> Diagnostic {
        let asked = self.checker.comparison.asked(self.program(), Some(op));
        Diagnostic::new(code, message, self.span(op), label).and(asked, "part of this")
    }

    fn cuts(&self) -> impl Iterator<Item = CutAt> {
        self.program().segments().filter_map(|segment| {
            let Action::Cut { flank, .. } = segment.op.action else {
                return None;
            };
            Some(CutAt {
                op: segment.id,
                site: segment.op.site,
                flank,
                tool: segment.before.tool,
                line: segment.line()?,
            })
        })
    }

    /// Whether a cut is one of the job's, as it was proven.
    fn is_proven(&self, cut: &CutAt) -> bool {
        let partner = self.rebuilt.partners.get(cut.op.0 as usize).copied().flatten();
        let proven = partner.and_then(|id| self.proven.get(id.0 as usize)?.line());
        let fresh = self.checker.comparison.program();
        let ends = |program: &Program, line: &LinearSegment| {
            (
                line.from.tip,
                line.to.tip,
                program.orientation(line.to.orientation),
            )
        };
        proven.is_some_and(|proven| ends(fresh, proven) == ends(self.program(), &cut.line))
    }

    /// The cut that goes deepest into the part.
    fn entries(&self) -> Option<Diagnostic> {
        let bounds = verdict::bounds(self.checker.plan);
        let mut worst: Option<(CutAt, Entry)> = None;
        let mut count = 0_usize;
        for cut in self.cuts().filter(|cut| !self.is_proven(cut)) {
            let found = self.entry(&bounds, &cut);
            let Some(entry) = found else { continue };
            count += 1;
            if worst.is_none_or(|(_, worst)| entry.depth > worst.depth) {
                worst = Some((cut, entry));
            }
        }
        let (cut, entry) = worst?;
        let message = format!(
            "{} enters the part by {} mm",
            op_words(self.program(), cut.op),
            show(entry.depth.to_mm())
        );
        let label = format!("deepest at x {} mm, z {} mm", show(entry.at.x), show(entry.at.z));
        let diagnostic = self
            .at(Code::ProgramCuts, message, cut.op, label)
            .and(self.checker.comparison.job.profile_span, "the part")
            .help("restore the line: this would cut into the part");
        Some(and_more(diagnostic, count - 1))
    }

    fn entry(&self, bounds: &[vcutc_simulation::prove::Bound<'_>], cut: &CutAt) -> Option<Entry> {
        let program = self.program();
        // A cut that belongs to nothing is compared with the first operation's bound.
        let operation = cut
            .site
            .operation()
            .map_or(0, |operation| usize::from(operation.0));
        let bound = bounds.get(operation)?;
        let LinearSegment { from, to, .. } = cut.line;
        let held = program.orientation(to.orientation)?;
        let blade = program.blade(cut.tool)?.straight()?;
        deepest(bound, edge(blade, held), from.tip, to.tip)
    }

    /// A V whose flanks do not have the same tip.
    fn halves(&self) -> Option<Diagnostic> {
        let mut first: BTreeMap<(u16, u32, u32), (CutAt, Point3)> = BTreeMap::new();
        let mut worst: Option<(CutAt, f64)> = None;
        let mut count = 0_usize;
        for cut in self.cuts() {
            let Site::Cut {
                operation,
                layer,
                cut: number,
            } = cut.site
            else {
                continue;
            };
            let key = (operation.0, layer.get(), number.get());
            let there = cut.line.to.tip;
            let Some((other, tip)) = first.get(&key) else {
                first.insert(key, (cut, there));
                continue;
            };
            let apart = libm::hypot(tip.x - there.x, tip.z - there.z);
            if other.flank != cut.flank && apart > SAME_TIP {
                count += 1;
                let changed = if self.is_proven(&cut) { *other } else { cut };
                if worst.is_none_or(|(_, worst)| apart > worst) {
                    worst = Some((changed, apart));
                }
            }
        }
        let (cut, apart) = worst?;
        let message = format!(
            "{} and the other flank of its V do not meet: their tips are {} mm apart",
            op_words(self.program(), cut.op),
            show(apart)
        );
        let diagnostic = self
            .at(Code::ProgramCuts, message, cut.op, "its chip is not cut free")
            .help("let both flanks have the same x and z");
        Some(and_more(diagnostic, count - 1))
    }

    /// Each broken rule once, at its first place.
    fn rules(&self, faults: &[Fault]) -> Vec<Diagnostic> {
        let mut reported: Vec<(Rule, usize, Diagnostic)> = Vec::new();
        for fault in faults {
            if let Some((_, count, _)) = reported.iter_mut().find(|(rule, ..)| *rule == fault.rule) {
                *count += 1;
                continue;
            }
            let op = fault.op.unwrap_or(OpId(u32::MAX));
            let words = rule_words(fault.rule);
            let message = match fault.op {
                Some(op) => format!("{}: {words}", op_words(self.program(), op)),
                None => words.to_owned(),
            };
            reported.push((
                fault.rule,
                0,
                self.at(Code::ProgramRule, message, op, rule_label(fault.rule)),
            ));
        }
        let left_out =
            "because of this, whether chips come free and the machine reaches everything was not checked";
        let reported = reported.into_iter().enumerate();
        reported
            .map(|(index, (_, others, diagnostic))| {
                let diagnostic =
                    and_more(diagnostic, others).help("restore the line, or compile the job again");
                match index {
                    0 => diagnostic.note(left_out),
                    _ => diagnostic,
                }
            })
            .collect()
    }

    /// Chips that are not freed, and what stays on the part.
    fn contour(&self, verified: &VerifiedProgram, is_reported: bool) -> Vec<Diagnostic> {
        let plan = self.checker.plan;
        let replay = verdict::replay(plan, verified);
        let findings = replay.findings.clone();
        let mut found: Vec<Diagnostic> = findings
            .iter()
            .filter_map(|(count, finding)| self.finding(count, &finding, is_reported))
            .collect();
        found.extend(self.bodies(verified));
        if found.is_empty() && !is_reported {
            let report = report(replay, plan.stock, &plan.profile, timing(verified));
            let excess = verdict::scallop_excess(plan, &report);
            found.extend(excess.and_then(|(operation, limit)| {
                let head_span = plan.operation(operation)?.asked().setup().head_span;
                let height = show(report.scallop.height.to_mm());
                let message = format!(
                    "{height} mm of material remain on the part at x {} mm, the limit is {} mm",
                    show(report.scallop.peak.x),
                    show(limit.value.to_mm())
                );
                let diagnostic = Diagnostic::new(
                    Code::ProgramCuts,
                    message,
                    self.checker.span(usize::MAX),
                    "when the program ends",
                )
                .and(limit.span.unwrap_or(head_span), "the limit");
                Some(diagnostic.help("restore the changed cuts"))
            }));
        }
        found
    }

    /// The body of a blade that enters the stock.
    fn bodies(&self, verified: &VerifiedProgram) -> Option<Diagnostic> {
        let (count, contact) = verdict::bodies(self.checker.plan, verified).contact?;
        let passage = contact.passage;
        let blade = self.program().blade(passage.tool)?;
        let label = format!(
            "deepest at x {} mm, z {} mm",
            show(passage.at.x),
            show(passage.at.z)
        );
        let message = verdict::body_in_work(&blade.name, contact);
        let diagnostic = self
            .at(Code::ProgramCuts, message, passage.op, label)
            .help("restore the changed motions");
        Some(and_more(diagnostic, count - 1))
    }

    fn finding(&self, count: usize, finding: &Finding, is_reported: bool) -> Option<Diagnostic> {
        let site = Site::Cut {
            operation: finding.operation,
            layer: finding.layer,
            cut: finding.cut,
        };
        let op = self.last_in_material(site)?;
        let passes = self.passes(finding);
        let place = match passes {
            Some(_) => cut_words(self.program(), op),
            None => op_words(self.program(), op),
        };
        let (message, label) = match finding.fault {
            CutFault::NotFreed { needed, .. } if !needed.is_finite() && frees_strips(passes) => (
                format!(
                    "{} goes on below what its strips leave",
                    site_words(self.program(), site)
                ),
                "a strip beside it stays attached".to_owned(),
            ),
            CutFault::NotFreed { needed, .. } if !needed.is_finite() => (
                format!("{place} is the only flank of its cut, and its tip lies in the material"),
                "its chip is not cut free".to_owned(),
            ),
            CutFault::NotFreed { needed, available } => (
                format!(
                    "{place} needs {} mm of edge, {} mm may be used",
                    show(needed.to_mm()),
                    show(available.to_mm())
                ),
                "its chip is not cut free".to_owned(),
            ),
            CutFault::Blocked { at, by } => (
                format!(
                    "above {place}, {} mm of uncut material is in the way of the blade",
                    show(by.to_mm())
                ),
                format!("the blade meets it at x {} mm, z {} mm", show(at.x), show(at.z)),
            ),
            CutFault::Strip(fault) => {
                let (what, label) = verdict::words::strip_words(fault);
                (format!("at {place}, {what}"), label)
            }
            CutFault::Clearing(fault) => {
                let y = finding.y.unwrap_or_default();
                (
                    format!("at {place}, {}", verdict::words::clearing_words(fault)),
                    format!("at x {} mm, y {} mm", show(finding.tip.x), show(y)),
                )
            }
            CutFault::Slit(fault) => {
                let y = finding.y.unwrap_or_default();
                (
                    format!("at {place}, {}", verdict::words::slit_words(fault)),
                    format!("at x {} mm, y {} mm", show(finding.tip.x), show(y)),
                )
            }
            CutFault::Strays { y, by } => (
                format!(
                    "{place} leaves the way that it is to follow by {} mm",
                    show(by.to_mm())
                ),
                format!("at y {} mm", show(y.to_mm())),
            ),
            CutFault::Stays { at, height, limit } => {
                let (what, label) = verdict::words::stays_words(at, height, limit);
                (format!("beside {place}, {what}"), label)
            }
            // The slits of changed cuts have been reported already, and are the same.
            CutFault::Overcut { .. } if is_reported && self.cuts().any(|cut| cut.op == op) => return None,
            CutFault::Overcut { at, depth } => (
                format!("{place} enters the part by {} mm", show(depth.to_mm())),
                format!("deepest at x {} mm, z {} mm", show(at.x), show(at.z)),
            ),
        };
        let diagnostic = self
            .at(Code::ProgramCuts, message, op, label)
            .help("restore the changed lines before this one, or compile the job again");
        Some(and_more(diagnostic, count.saturating_sub(1)))
    }

    /// The last op of a cut that goes through the material.
    fn last_in_material(&self, site: Site) -> Option<OpId> {
        let ops = (0..).map(OpId).zip(&self.program().ops);
        let within = ops.filter(|(_, op)| {
            let cuts = matches!(op.action, Action::Cut { .. } | Action::Follow { .. });
            cuts && op.site == site
        });
        within.map(|(id, _)| id).last()
    }

    /// What the operation of a finding takes a disc for, if it has one.
    fn passes(&self, finding: &Finding) -> Option<Passes> {
        let bounds = verdict::bounds(self.checker.plan);
        bounds.get(usize::from(finding.operation.0))?.passes
    }

    fn reach(&self, verified: VerifiedProgram) -> Vec<Diagnostic> {
        match solve(verified, self.checker.model, &LEAST_CLEARANCE, Changes::InTheAir) {
            Ok(reached) => match reached.report.changes.first() {
                Some(&op) => vec![self.needs_change(op)],
                None => self.checker.configurations(self.rebuilt, Some(&reached)),
            },
            Err(Unreached::Unreachable(unreachable)) => self.unreachable(&unreachable).into_iter().collect(),
            Err(Unreached::Rules(_) | Unreached::Motion(_)) => vec![Diagnostic::new(
                Code::ProgramReach,
                "whether the machine reaches everything could not be proven",
                self.checker.span(usize::MAX),
                "of this program",
            )],
        }
    }

    fn needs_change(&self, op: OpId) -> Diagnostic {
        let message = format!(
            "{}: no single configuration works for the motions before and after it",
            op_words(self.program(), op)
        );
        self.at(
            Code::ProgramReach,
            message,
            op,
            "the arm would have to change its configuration on this straight motion",
        )
        .help("restore the changed lines, or compile the job again")
    }

    /// The words of the proof, at the line of the program.
    fn unreachable(&self, unreachable: &Unreachable) -> Option<Diagnostic> {
        let comparison = self.checker.comparison;
        let words = reach_verdict::explain(comparison.job, unreachable)?.diagnostic;
        let op = unreachable.trouble.op();
        let span = op.map_or_else(|| self.checker.span(usize::MAX), |op| self.span(op));
        let mut diagnostic = Diagnostic::new(Code::ProgramReach, words.message, span, "with this line");
        diagnostic.secondary.push(words.primary);
        diagnostic.secondary.extend(words.secondary);
        diagnostic.notes = words.notes;
        Some(diagnostic.help("restore the line, or change the job to match"))
    }
}

/// Tips of the two flanks of a V may be apart by this, in mm: what three decimals leave.
const SAME_TIP: f64 = 1.1e-3;

/// A broken rule in the words of the process.
const fn rule_words(rule: Rule) -> &'static str {
    match rule {
        Rule::Version | Rule::TableReference | Rule::HomeAngles | Rule::Axes => {
            "the program does something that this machine does not have"
        }
        Rule::Number => "a speed or a time of the program is zero or less",
        Rule::KnownStart => "a straight motion begins at an unknown position",
        Rule::AmbiguousTurn => "the blade turns by nearly half a revolution, and either way round would do",
        Rule::AirMoveThroughStock => "the blade enters the stock outside of a cut",
        Rule::TurnInStock => "the blade turns within the stock",
        Rule::CutAcrossStock => "the cut does not run along y through the whole stock",
        Rule::CutPosture => "the blade is held so that it does not make this flank",
        Rule::SilentCut => "the blade cuts without vibrating",
        Rule::StillCut => "the blade cuts while its spindle stands still",
        Rule::ReadyNotAwaited => "the blade cuts before generator and spindle are known to run",
        Rule::NoSpindle => "the machine has no spindle for a blade that spins",
        Rule::IdleSpindle => "the spindle starts with a blade that does not spin",
        Rule::Ending => "the program does not end at home with generator and spindle off",
        Rule::CutFlanks => "a cut has a flank twice",
        Rule::AirCut => "an air cut comes down to the stock, or starts generator or spindle",
        Rule::Tools => "the machine has not one tool and one place for each blade",
        Rule::ChangeAway => {
            "the blade is changed away from the change place, or while generator or spindle run"
        }
        Rule::OtherBlade => "the blade at hand is not that of the operation",
        Rule::Arc => "the three points of a circular motion do not make an arc",
        Rule::ChainJoint => "the path changes its direction without a stop, or does not end in one",
        Rule::ChainPosture => "the blade does not stand in the plane of its path",
        Rule::Order => "operations are out of order, or a layer's cuts are not all there",
    }
}

const fn rule_label(rule: Rule) -> &'static str {
    match rule {
        Rule::AirMoveThroughStock | Rule::TurnInStock => "through the stock",
        Rule::SilentCut | Rule::ReadyNotAwaited => "without vibration, or too early",
        Rule::StillCut => "with a blade that stands still",
        Rule::Ending => "the program ends here",
        Rule::ChangeAway => "changed here",
        Rule::Version
        | Rule::TableReference
        | Rule::Number
        | Rule::Axes
        | Rule::KnownStart
        | Rule::HomeAngles
        | Rule::AmbiguousTurn
        | Rule::CutAcrossStock
        | Rule::CutPosture
        | Rule::CutFlanks
        | Rule::AirCut
        | Rule::Tools
        | Rule::NoSpindle
        | Rule::IdleSpindle
        | Rule::OtherBlade
        | Rule::Arc
        | Rule::ChainJoint
        | Rule::ChainPosture
        | Rule::Order => "in this line",
    }
}
