//! `follow = auto`: it compiles whatever one family compiles, leaves hardly more than the best, and takes no longer than what leaves as
//! little.

use crate::follow::{GIVEN, NONE, Part, REST, codes, compiled, rough};
use crate::pipeline::{Files, compile};
use proptest::prelude::*;
use vcutc::cancellation::Wanted;
use vcutc::diagnostics::{Code, has_errors};
use vcutc::driver::Outcome;
use vcutc::driver::families::FamilyCame;
use vcutc::driver::hints;
use vcutc::job::follow::Family;

/// What a job takes and leaves: its time in s, and the height of what stays at most and on average, in mm.
#[derive(Clone, Copy, Debug)]
struct Figures {
    time: f64,
    highest: f64,
    mean: f64,
}

fn figures(outcome: &Outcome) -> Option<Figures> {
    let compiled = outcome.compiled.as_ref()?;
    let left = compiled.left_over.unwrap().all;
    let stock = outcome.job.as_ref().unwrap().stock;
    Some(Figures {
        time: compiled.report.times.all.total().to_s(),
        highest: left.highest.height.to_mm(),
        mean: left.volume.to_mm3() / (stock.width.to_mm() * stock.depth.to_mm()),
    })
}

/// A part that twists, bends and rises, cut with that rake and with what else is asked.
fn cut(part: Part, rake: f64, more: &str, follow: &str) -> Outcome {
    let operation = rough(&format!("{GIVEN}\n  follow = {follow}\n  {more}"));
    let operation = operation.replace("rake      = 60 deg", &format!("rake      = {rake} deg"));
    let text = format!("{REST}surface {{ {} }}\n{operation}", part.surface());
    compile("job.vcut", &Files::default().with("job.vcut", text))
}

/// That `auto` does as well as each family by itself.
fn is_as_good_as_each(part: Part, rake: f64, limit: Option<f64>) {
    let more = limit.map_or(String::new(), |limit| {
        format!("limits {{ scallop <= {limit} mm }}")
    });
    let auto = cut(part, rake, &more, "auto");
    let each = Family::WORDS.iter().filter_map(|(word, _)| {
        let figures = figures(&cut(part, rake, &more, word))?;
        Some((*word, figures))
    });
    let each: Vec<(&str, Figures)> = each.collect();
    let Some(taken) = figures(&auto) else {
        assert!(each.is_empty(), "{each:?} {:?}", auto.diagnostics);
        return;
    };
    let least = each
        .iter()
        .map(|(_, one)| one.highest)
        .fold(f64::INFINITY, f64::min);
    let hardly_more = |than: f64| (1.1 * than).max(than + 0.25) + 1e-6;
    // A part that is the same at every y leaves no choice.
    let said = auto.families.first().map(|one| match &one.came {
        FamilyCame::Compiled(figures) => figures.highest.to_mm(),
        other => panic!("{other:?}"),
    });
    let is_within = limit.is_some_and(|limit| said.is_none_or(|said| said <= hardly_more(limit)));
    assert!(
        is_within || taken.highest <= hardly_more(least),
        "{taken:?} {each:?}"
    );
    for (word, one) in &each {
        let keeps = |figures: &Figures| limit.is_some_and(|limit| figures.highest <= limit);
        let leaves_less = one.highest <= taken.highest && one.mean <= taken.mean;
        if keeps(one) || (limit.is_none() && leaves_less) {
            assert!(taken.time <= 1.005 * one.time, "{word}: {taken:?} {each:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn auto_is_as_good_as_each_family(
        across in prop_oneof![200.0..1000.0_f64, -1000.0..-400.0_f64],
        along in prop_oneof![Just(NONE), 800.0..40_000.0_f64, -4000.0..-800.0_f64],
        twist in prop_oneof![Just(NONE), 500.0..3000.0_f64, -3000.0..-500.0_f64],
        warp in prop_oneof![Just(NONE), 45_000.0..200_000.0_f64],
        slope in prop_oneof![Just(0.0), -0.2..0.2_f64],
        rake in prop_oneof![Just(60.0), 20.0..40.0_f64],
        limit in prop_oneof![Just(None), (6.0..14.0_f64).prop_map(Some)],
    ) {
        let part = Part { middle: 36.0, across, along, twist, slope, warp };
        is_as_good_as_each(part, rake, limit);
    }
}

/// A ramp on which the shank of a wide V lies down, unless its cuts are level.
const RAMP: Part = Part {
    middle: 42.0,
    slope: 0.3,
    ..Part::LEVEL
};

#[test]
fn what_level_cuts_compile_auto_compiles() {
    let pitched = cut(RAMP, 25.0, "", "pitched");
    assert_eq!(codes(&pitched), [Code::RakeTooFlat]);
    let [auto, straight] = ["auto", "straight"].map(|follow| cut(RAMP, 25.0, "", follow));
    assert!(!has_errors(&auto.diagnostics), "{:?}", auto.diagnostics);
    let [taken, level] = [&auto, &straight].map(|outcome| figures(outcome).unwrap());
    assert!((taken.time - level.time).abs() < 1e-9, "{taken:?} {level:?}");
    let family = &auto.families[0];
    assert_eq!(family.family, Family::Straight);
    assert!(matches!(&family.came, FamilyCame::Compiled(figures) if figures.time.to_s() == level.time));
    let refused =
        |one: &FamilyCame| matches!(one, FamilyCame::Refused(Some(why)) if why.code == Code::RakeTooFlat);
    assert!(
        auto.families[1..].iter().all(|one| refused(&one.came)),
        "{:?}",
        auto.families
    );
    let summary = auto.compiled.unwrap().summary.join("\n");
    assert!(summary.contains("families       straight: "), "{summary}");
    assert!(summary.contains(": no, with a rake of 25 deg"), "{summary}");
}

/// What only level cuts take leaves `auto` no other choice, and is not refused.
#[test]
fn fields_of_level_cuts_go_with_auto() {
    for field in ["avoid = swing", "swing = 4 deg", "compensate = forces"] {
        let of = |follow: &str| {
            let given = match field {
                "swing = 4 deg" => GIVEN.replace("swing = 40 deg", ""),
                _ => GIVEN.to_owned(),
            };
            codes(&compiled(
                &RAMP.surface(),
                &format!("{given}\n  follow = {follow}\n  {field}"),
            ))
        };
        assert!(of("spine").contains(&Code::CannotFollow), "{field}");
        assert_eq!(of("auto"), of("straight"), "{field}");
        assert!(!of("auto").contains(&Code::CannotFollow), "{field}");
    }
}

/// Tips are fitted to the part where cuts are level, also where `auto` chose that.
#[test]
fn auto_keeps_fitted_tips() {
    let text = |follow: &str| {
        format!(
            "job \"lid\"\nstock {{ size = (60 mm, 80 mm, 30 mm) }}\n\
             surface {{ z(x, y) = 16 mm - (x - 30 mm)^2 / 250 mm - (y - 40 mm)^2 / 20000 mm }}\n\
             blade knife {{ cutting_length = 25 mm, half_apex = 7.13 deg, thickness = 1.2 mm, edges = double }}\n\
             rough vcut {{ blade = knife, rake = 60 deg, swing = 40 deg, limits {{ scallop <= 3 mm }}, follow = {follow}\n  \
             feed {{ cut = 200 mm/s, travel = 200 mm/s, reorient = 90 deg/s }}, clearance = 10 mm }}\n"
        )
    };
    let [auto, straight] =
        ["auto", "straight"].map(|word| compile("job.vcut", &Files::default().with("job.vcut", text(word))));
    assert!(!has_errors(&auto.diagnostics), "{:?}", auto.diagnostics);
    assert_eq!(auto.families[0].family, Family::Straight);
    let [taken, level] = [&auto, &straight].map(|outcome| figures(outcome).unwrap().time);
    assert_eq!(taken, level);
    let summary = auto.compiled.unwrap().summary.join("\n");
    assert!(summary.contains("lattice = fitted"), "{summary}");
}

/// Where no family compiles, the message is about the one that was tried first, and names the others.
#[test]
fn where_no_family_compiles_the_first_is_explained() {
    let part = Part {
        along: 1500.0,
        ..Part::LEVEL
    };
    let outcome = cut(part, 60.0, "limits { time <= 1 s }", "auto");
    assert!(outcome.compiled.is_none());
    let first = outcome
        .diagnostics
        .iter()
        .find(|one| one.code == Code::LimitsConflict)
        .unwrap();
    let notes = first.notes.join("\n");
    assert!(notes.contains("`follow = auto` tried first"), "{notes}");
    assert!(notes.contains("straight"), "{notes}");
}

/// The hint of a job with level cuts states what the job leaves and takes with it.
#[test]
fn the_hint_to_follow_the_part_was_tried() {
    let dome = Part {
        across: 300.0,
        along: 1200.0,
        ..Part::LEVEL
    };
    let text = format!("{REST}surface {{ {} }}\n{}", dome.surface(), rough(GIVEN));
    let at = |text: String| compile("job.vcut", &Files::default().with("job.vcut", text));
    let outcome = at(text.clone());
    let (job, compiled) = (outcome.job.as_ref().unwrap(), outcome.compiled.as_ref().unwrap());
    let hint = hints::following(job, compiled, &Wanted::ALWAYS).unwrap();
    let mut changed = text;
    for edit in hint.fix.edits.iter().rev() {
        changed.replace_range(edit.span.bytes(), &edit.replacement);
    }
    let changed = at(changed);
    let [now, then] = [&outcome, &changed].map(|outcome| figures(outcome).unwrap());
    assert_eq!(then.time, hint.time.to_s());
    let words = format!("at most {:.2} mm instead of {:.2} mm", then.highest, now.highest);
    assert!(hint.fix.title.contains(&words), "{} {words}", hint.fix.title);
    assert!(then.highest < now.highest - 3.0, "{then:?} {now:?}");
    // Cuts that follow the part already get none.
    let (job, compiled) = (changed.job.as_ref().unwrap(), changed.compiled.as_ref().unwrap());
    assert!(hints::following(job, compiled, &Wanted::ALWAYS).is_none());
}
