//! What stands at the head of a program for people: what it was made from, for which blade and stock, and how long it takes.
//!
//! Each line is short enough for every control whose comments this workspace writes, and says nothing that a reader of programs
//! has to follow. The compiler's version is not among them: a version that writes the same motions would
//! change every program that a shop has under version control.

use crate::ir::{
    Action, Crusher, CutKind, Disc, Flank, Head, Op, Program, Purpose, Shape, Site, Straight, ToolId,
};
use crate::units::{AngularSpeed, Duration, Length};
use crate::words::counted;
use std::collections::BTreeMap;

/// A comment: words of ours, and words that people wrote after them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HeadLine<'p> {
    /// Ours: ASCII, at most 60 characters.
    pub ours: String,
    /// Theirs.
    pub theirs: &'p str,
}

/// The most letters of ours in a line.
const LONGEST: usize = 60;

/// How many digits of the job's hash are shown: by chance two jobs of a million have the same with odds of one to ten million.
const SHOWN_DIGITS: usize = 16;

/// Which axis of the blade frame is what, as `docs/language.md` draws it.
const AXES: [&str; 3] = [
    "tool z: from the shank out through the tip",
    "tool x: to the edge that leads on a feed along +y",
    "tool y: normal of the flat",
];

/// The comments at the head of a program, in order.
#[must_use]
pub fn head_lines<'p>(program: &'p Program, machine: &'p str) -> Vec<HeadLine<'p>> {
    let ours = |ours: String| HeadLine { ours, theirs: "" };
    let with = |ours: &str, theirs| HeadLine {
        ours: ours.to_owned(),
        theirs,
    };
    let mut lines = Vec::new();
    if let Purpose::AirCut { lift } = program.purpose {
        lines.push(ours(format!(
            "AIR CUT: lifted by {} mm, generator off",
            number(lift)
        )));
    }
    lines.push(with("job ", &program.name));
    lines.extend(
        program
            .head
            .iter()
            .map(|head| ours(format!("job hash {}", shown(head)))),
    );
    lines.push(with("machine ", machine));
    lines.extend(program.blades.iter().map(|blade| HeadLine {
        ours: measures(&blade.shape),
        theirs: &blade.name,
    }));
    if let [first, _, ..] = program.blades.as_slice() {
        lines.push(with("begins with blade ", &first.name));
    }
    lines.extend(AXES.map(|axis| ours(axis.to_owned())));
    let stock = program.stock;
    let [width, depth, height] = [stock.width, stock.depth, stock.height].map(number);
    lines.push(ours(format!("stock {width} x {depth} x {height} mm")));
    let counts = cuts(program);
    let time = program.head.as_ref();
    let time = time.map(|head| format!("{} as planned", duration_words(head.time)));
    // Three kinds of cuts may need a line of their own.
    lines.extend(match time {
        Some(time) if counts.len() + time.len() + 2 <= LONGEST => vec![ours(format!("{counts}, {time}"))],
        Some(time) => vec![ours(counts), ours(time)],
        None => vec![ours(counts)],
    });
    lines.extend(
        (1_u32..)
            .zip(&program.operations)
            .filter_map(|(number, operation)| {
                // Upward, but for rounding.
                let by = (operation.compensation?.to_mm() * 1000.0 - 1e-6).ceil().max(0.0) / 1000.0;
                Some(ours(format!(
                    "operation {number}: tips offset for forces, at most {} mm",
                    decimals(by)
                )))
            }),
    );
    lines
}

/// What a blade measures, before its name.
fn measures(shape: &Shape) -> String {
    match *shape {
        Shape::Straight(Straight {
            cutting_length,
            thickness,
            ..
        }) => format!(
            "blade {} mm long, {} mm thick: ",
            number(cutting_length),
            number(thickness)
        ),
        Shape::Disc(Disc { radius, spin, .. }) => round("disc", radius, spin),
        Shape::Crusher(Crusher { radius, spin, .. }) => round("crusher", radius, spin),
    }
}

/// A blade that spins, `disc of radius 25 mm, 3000 rev/min: `.
fn round(kind: &str, radius: Length, spin: AngularSpeed) -> String {
    format!(
        "{kind} of radius {} mm, {} rev/min: ",
        number(radius),
        decimals(spin.to_rev_per_min())
    )
}

fn shown(head: &Head) -> &str {
    head.job.get(..SHOWN_DIGITS).unwrap_or(&head.job)
}

/// How many cuts, slits, strips and tracks there are, of those that there are.
fn cuts(program: &Program) -> String {
    let mut counts = Counts::default();
    let mut at_hand = ToolId::FIRST;
    for op in &program.ops {
        if let Action::ToolChange { tool } = op.action {
            at_hand = tool;
        }
        counts.add(program, op, at_hand);
    }
    let had = counts.of.into_iter();
    let words: Vec<String> = had.map(|(kind, count)| counted(count, kind.noun())).collect();
    if words.is_empty() {
        return counted(0, CutKind::Cut.noun());
    }
    words.join(", ")
}

/// What a program cuts.
#[derive(Default)]
struct Counts {
    of: BTreeMap<CutKind, usize>,
    /// Of the latest chain. Its pieces are of one cut.
    chain: Option<Site>,
}

impl Counts {
    /// Every V has one left flank, and so has a slit. A chain is a cut.
    fn add(&mut self, program: &Program, op: &Op, tool: ToolId) {
        let begins = match op.action {
            Action::Cut { flank, .. } => flank == Flank::Left,
            Action::Follow { .. } => self.chain.replace(op.site) != Some(op.site),
            _ => false,
        };
        if begins && let Some(operation) = op.site.operation() {
            *self.of.entry(program.cut_kind(operation, tool)).or_default() += 1;
        }
    }
}

/// A length in mm with up to three decimals, and none that say nothing.
fn number(length: Length) -> String {
    decimals(length.to_mm())
}

fn decimals(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// `1 h 02 min 03 s`, `2 min 05.4 s`, `5.4 s`.
#[must_use]
pub fn duration_words(duration: Duration) -> String {
    // From an hour on, tenths of a second say nothing; rounding before dividing never gives 60 seconds.
    let whole = duration.to_s().round();
    if whole >= 3600.0 {
        let (hours, minutes, seconds) = (
            (whole / 3600.0).floor(),
            (whole / 60.0).floor() % 60.0,
            whole % 60.0,
        );
        return format!("{hours} h {minutes:02} min {seconds:02} s");
    }
    let tenths = (duration.to_s() * 10.0).round();
    let (minutes, seconds) = ((tenths / 600.0).floor(), (tenths % 600.0) / 10.0);
    if minutes > 0.0 {
        format!("{minutes} min {seconds:04.1} s")
    } else {
        format!("{seconds:.1} s")
    }
}

#[cfg(test)]
#[cfg(feature = "testkit")]
mod tests {
    use super::*;
    use crate::ir::{Changer, Spindle};
    use crate::testkit::{Recipe, with_disc};

    fn lines(program: &Program) -> Vec<String> {
        let lines = head_lines(program, "cell 4");
        lines
            .iter()
            .map(|line| format!("{}{}", line.ours, line.theirs))
            .collect()
    }

    #[test]
    fn a_head_says_what_the_program_was_made_from() {
        let mut program = Recipe::default().program();
        let cuts = program
            .ops
            .iter()
            .filter(|op| matches!(op.action, Action::Cut { .. }))
            .count()
            / 2;
        program.head = Some(Head {
            job: "0123456789abcdef0123".to_owned(),
            time: Duration::s(125.4),
        });
        let text = lines(&program).join("\n");
        assert!(text.contains("job hash 0123456789abcdef\n"), "{text}");
        assert!(
            text.ends_with(&format!("{cuts} cuts, 2 min 05.4 s as planned")),
            "{text}"
        );
        assert!(!text.contains("AIR"), "{text}");
    }

    #[test]
    fn the_pass_of_a_disc_beside_another_blade_is_a_strip() {
        let program = Recipe::default().program();
        let before = lines(&program).pop().unwrap();
        let program = with_disc(program, Changer::Hand, Spindle::Own);
        // What the straight blade cuts in the same operation is for the disc.
        let slits = before.replace("cuts", "slits");
        assert_eq!(lines(&program).pop().unwrap(), format!("{slits}, 1 strip"));
    }

    #[test]
    fn an_air_cut_says_so_first() {
        let mut program = Recipe::default().program();
        program.purpose = Purpose::AirCut {
            lift: Length::mm(100.0),
        };
        assert_eq!(lines(&program)[0], "AIR CUT: lifted by 100 mm, generator off");
    }

    #[test]
    fn lines_are_short_enough_for_every_control() {
        let mut program = Recipe::default().program();
        program.purpose = Purpose::AirCut {
            lift: Length::mm(9999.999),
        };
        program.head = Some(Head {
            job: "f".repeat(64),
            time: Duration::s(359_999.0),
        });
        let operation = program.operations[0].clone();
        program.operations = vec![operation; 20];
        program.operations[19].compensation = Some(Length::mm(9999.9985));
        let lines = head_lines(&program, "cell");
        assert_eq!(
            lines.last().unwrap().ours,
            "operation 20: tips offset for forces, at most 9999.999 mm"
        );
        for line in lines {
            assert!(line.ours.len() <= 60 && line.ours.is_ascii(), "{}", line.ours);
        }
    }
}
