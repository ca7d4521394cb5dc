//! The examples that people start from.

use crate::krl_text;
use crate::pipeline::{Files, all_diagnostics, compile, compile_on, emit, emit_for, fixed, numbers, told};
use crate::repository::{files, root};
use std::collections::BTreeSet;
use vcutc::registry;

/// The examples that are meant to fail, with the codes they show.
const FAILING: &[(&str, &[&str])] = &[
    ("broken.vcut", &["VC0102", "VC0201", "VC0203", "VC0205", "VC0209"]),
    ("out_of_reach.vcut", &["VC0510"]),
    ("too_deep.vcut", &["VC0401"]),
];

/// The jobs among the examples: what lies in their folder itself, without the files they use.
fn jobs() -> Vec<(String, String)> {
    let jobs = files("examples", ".vcut").into_iter().filter_map(|file| {
        let name = file.path.strip_prefix("examples/")?.to_owned();
        (!name.contains('/')).then_some((name, file.text))
    });
    jobs.collect()
}

fn folder() -> Files {
    Files::of(root().join("examples"))
}

#[test]
fn examples_say_what_they_are_and_what_they_show() {
    for (name, text) in jobs() {
        let mut lines = text.lines();
        let [first, second] = [lines.next(), lines.next()].map(Option::unwrap_or_default);
        assert!(first.starts_with("// ") && first.len() > 20, "{name}: {first}");
        assert!(second.starts_with("// Shows: "), "{name}: {second}");
    }
}

/// The machines of the shop, with the target that drives each.
const CELLS: &[(&str, &str)] = &[
    ("large_cell", "krl"),
    ("abb_cell", "rapid"),
    ("gantry", "gcode"),
    ("knife_gantry", "gcode"),
];

/// What a machine of the shop cannot hold the blade for: half a turn of a single edge about itself.
const NOT_ON: &[(&str, &str)] = &[("spoiler_rae2822.vcut", "gantry")];

/// The examples that compile, each with the machines it can be cut on. A job with a machine of its own has no other.
fn compiling() -> Vec<(String, Vec<(Option<&'static str>, &'static str)>)> {
    let compiling = jobs()
        .into_iter()
        .filter(|(name, _)| FAILING.iter().all(|(failing, _)| failing != name));
    let with_machines = compiling.map(|(name, text)| {
        if !text.contains("shop/cells.vcut") {
            return (name, vec![(None, "krl")]);
        }
        let allowed = CELLS
            .iter()
            .filter(|(machine, _)| !NOT_ON.contains(&(&*name, machine)));
        let machines = allowed
            .map(|&(machine, target)| (Some(machine), target))
            .collect();
        (name, machines)
    });
    with_machines.collect()
}

#[test]
fn examples_compile_and_say_what_was_planned() {
    for (name, _) in compiling() {
        let outcome = compile(&name, &folder());
        let messages = told(&all_diagnostics(&outcome), &outcome);
        assert_eq!(messages, "", "{name}");
        krl_text::check(&outcome, &emit(&outcome).unwrap());
    }
}

/// Every machine of the shop carries out every example that it is meant for, and the targets that drive it write it.
#[test]
fn examples_compile_for_every_machine_and_target() {
    let mut programs = 0;
    for (name, machines) in compiling() {
        for (machine, its_target) in machines {
            let outcome = compile_on(machine, &name, &folder());
            assert_eq!(told(&outcome.diagnostics, &outcome), "", "{name} on {machine:?}");
            for target in registry::backends() {
                let refused = emit_for(target, &outcome).err().unwrap_or_default();
                if target.id() == its_target {
                    assert_eq!(told(&refused, &outcome), "", "{name} on {machine:?}");
                    programs += 1;
                } else {
                    assert_eq!(
                        numbers(&refused),
                        ["VC0607"],
                        "{name} on {machine:?} for {}",
                        target.id()
                    );
                }
            }
        }
    }
    assert!(programs >= 8, "{programs} programs");
}

#[test]
fn examples_are_refused_by_machines_that_cannot_hold_the_blade() {
    for &(name, machine) in NOT_ON {
        let outcome = compile_on(Some(machine), name, &folder());
        assert_eq!(numbers(&outcome.diagnostics), ["VC0516"], "{name} on {machine}");
    }
}

#[test]
fn examples_of_errors_fail_as_they_are_meant_to() {
    for &(name, codes) in FAILING {
        let outcome = compile(name, &folder());
        let found: BTreeSet<_> = numbers(&outcome.diagnostics).into_iter().collect();
        assert_eq!(found.into_iter().collect::<Vec<_>>(), codes, "{name}");
        assert!(outcome.compiled.is_none());
    }
}

#[test]
fn each_fix_of_the_example_out_of_reach_makes_it_compile() {
    let outcome = compile("out_of_reach.vcut", &folder());
    let fixes: Vec<_> = outcome
        .diagnostics
        .iter()
        .flat_map(|found| &found.fixes)
        .collect();
    assert!(fixes.len() >= 2, "{fixes:?}");
    for fix in fixes {
        let mended = fixed(&folder(), &outcome, fix);
        let after = compile("out_of_reach.vcut", &mended);
        assert_eq!(told(&all_diagnostics(&after), &after), "", "{}", fix.title);
        krl_text::check(&after, &emit(&after).unwrap());
    }
}
