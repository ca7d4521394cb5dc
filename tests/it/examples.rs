//! The examples that people start from.

use crate::krl_text;
use crate::pipeline::{all_diagnostics, compile, compile_on, emit, emit_for, fixed, numbers, rendered};
#[cfg(feature = "gcode")]
use crate::shop::{DIALECTS, NOT_IN, compiled_for, has_words_for};
use crate::shop::{FAILING, NOT_ON, Pairing, compiled, compiling, folder, jobs};
use std::collections::BTreeSet;
use vcutc::registry;

#[test]
fn examples_say_what_they_are_and_what_they_show() {
    for (name, text) in jobs() {
        let mut lines = text.lines();
        let [first, second] = [lines.next(), lines.next()].map(Option::unwrap_or_default);
        assert!(first.starts_with("// ") && first.len() > 20, "{name}: {first}");
        assert!(second.starts_with("// Shows: "), "{name}: {second}");
    }
}

#[test]
fn examples_compile_and_say_what_was_planned() {
    for (name, _) in compiling() {
        let outcome = compile(&name, &folder());
        let messages = rendered(&all_diagnostics(&outcome), &outcome);
        assert_eq!(messages, "", "{name}");
        krl_text::check(&outcome, &emit(&outcome).unwrap());
    }
}

/// Every machine of the shop carries out every example that it is meant for, and the target that drives it writes it.
#[test]
fn examples_compile_for_every_machine_and_target() {
    let mut programs = 0;
    for (name, pairings) in compiling() {
        for Pairing { machine, target } in pairings {
            let outcome = compiled(machine, &name);
            assert_eq!(
                rendered(&outcome.diagnostics, outcome),
                "",
                "{name} on {machine:?}"
            );
            for backend in registry::backends() {
                let refused = emit_for(backend, outcome).err().unwrap_or_default();
                if backend.id() == target {
                    assert_eq!(rendered(&refused, outcome), "", "{name} on {machine:?}");
                    programs += 1;
                } else {
                    assert_eq!(
                        numbers(&refused),
                        ["VC0607"],
                        "{name} on {machine:?} for {}",
                        backend.id()
                    );
                }
            }
        }
    }
    let pairings = || compiling().into_iter().flat_map(|(_, pairings)| pairings);
    // Thirty-one jobs for KRL, twenty-seven of them for RAPID, and thirty-five pairings with gantries for G-code.
    assert_eq!(pairings().count(), 31 + 27 + 35);
    let is_built = |pairing: &Pairing| registry::backend(pairing.target).is_some();
    assert_eq!(programs, pairings().filter(is_built).count());
}

#[cfg(feature = "gcode")]
#[test]
fn examples_compile_for_every_dialect_of_g_code() {
    let mut programs = 0;
    for &(dialect, _) in DIALECTS {
        for (name, pairings) in compiling() {
            for Pairing { machine, .. } in pairings.iter().filter(|pairing| pairing.target == "gcode") {
                let outcome = compiled_for(dialect, *machine, &name);
                let target = registry::backend("gcode").unwrap();
                if !has_words_for(dialect, &name) {
                    let found = numbers(&outcome.diagnostics);
                    assert_eq!(found, ["VC0605"], "{name} for {dialect}");
                    continue;
                }
                let refused = emit_for(target, outcome).err().unwrap_or_default();
                assert_eq!(
                    rendered(&outcome.diagnostics, outcome),
                    "",
                    "{name} on {machine:?}"
                );
                assert_eq!(
                    rendered(&refused, outcome),
                    "",
                    "{name} on {machine:?} for {dialect}"
                );
                programs += 1;
            }
        }
    }
    assert_eq!(programs, DIALECTS.len() * 35 - NOT_IN.len());
}

#[test]
fn examples_are_refused_by_machines_that_cannot_hold_the_blade() {
    for &(name, machine) in NOT_ON {
        let outcome = compile_on(Some(machine), name, &folder());
        let follows = matches!(name, "crown.vcut" | "shell.vcut" | "twist.vcut");
        let code = if follows { "VC0248" } else { "VC0516" };
        assert_eq!(numbers(&outcome.diagnostics), [code], "{name} on {machine}");
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
        assert_eq!(rendered(&all_diagnostics(&after), &after), "", "{}", fix.title);
        krl_text::check(&after, &emit(&after).unwrap());
    }
}
