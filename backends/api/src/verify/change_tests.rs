//! Each rule about blades and their changes broken once, in a program that is right otherwise.

use super::{Capability, Rule, verify};
use crate::ir::{Action, Changer, OperationId, Program, Switch, ToolId};
use crate::testkit::{Recipe, two_blades};
use crate::units::Duration;
use proptest::prelude::*;

fn program() -> Program {
    let recipe = Recipe {
        operations: 2,
        ..Recipe::default()
    };
    two_blades(recipe.program(), Changer::Program)
}

fn rules(program: Program) -> Vec<Rule> {
    let faults = verify(program).err().unwrap_or_default();
    let mut rules: Vec<Rule> = faults.into_iter().map(|fault| fault.rule).collect();
    rules.dedup();
    rules
}

/// The place of the change in the list of ops.
fn change(program: &Program) -> usize {
    let is_change = |action: Action| matches!(action, Action::ToolChange { .. });
    program.ops.iter().position(|op| is_change(op.action)).unwrap()
}

/// The rules that a change of the program breaks.
fn broken(break_it: impl FnOnce(&mut Program)) -> Vec<Rule> {
    let mut program = program();
    break_it(&mut program);
    rules(program)
}

#[test]
fn the_program_is_right_and_needs_changes() {
    assert!(verify(program()).unwrap().needs().has(Capability::ToolChange));
    let plain = Recipe::default().program();
    assert!(!verify(plain).unwrap().needs().has(Capability::ToolChange));
}

#[test]
fn a_change_away_from_its_place_or_with_the_generator_on() {
    let away = broken(|program| {
        let change = change(program);
        program.ops.remove(change - 1);
    });
    // Nobody knows where the axes are then.
    assert_eq!(away, [Rule::ChangeAway, Rule::KnownStart]);
    let at_home = broken(|program| {
        let change = change(program);
        program.ops[change - 1].action = Action::Home;
    });
    assert_eq!(at_home, [Rule::ChangeAway]);
    let running = broken(|program| {
        let before = program.ops[..change(program)].iter();
        let off = before
            .rev()
            .position(|op| matches!(op.action, Action::Ultrasonic { state: Switch::Off }));
        let off = change(program) - 1 - off.unwrap();
        program.ops.remove(off);
    });
    assert!(running.contains(&Rule::ChangeAway), "{running:?}");
    let nowhere = broken(|program| program.cell.as_mut().unwrap().change = None);
    assert!(nowhere.contains(&Rule::ChangeAway), "{nowhere:?}");
}

#[test]
fn an_operation_with_the_blade_of_another() {
    let dropped = broken(|program| {
        let change = change(program);
        program.ops.remove(change);
    });
    assert_eq!(dropped, [Rule::OtherBlade]);
    let wrong = broken(|program| {
        let change = change(program);
        program.ops[change].action = Action::ToolChange { tool: ToolId::FIRST };
    });
    assert_eq!(wrong, [Rule::OtherBlade]);
    // A program begins with the first blade.
    let begins = broken(|program| program.operations[0].tools = vec![ToolId(1)]);
    assert_eq!(begins, [Rule::OtherBlade]);
}

#[test]
fn a_straight_move_behind_a_change() {
    let straight = broken(|program| {
        let (change, feed, rate) = (change(program), program.feeds.len() - 1, program.rates.len() - 1);
        let Action::AxisTravel { to, orientation } = program.ops[change + 1].action else {
            panic!("{:?}", program.ops[change + 1])
        };
        program.ops[change + 1].action = Action::Travel {
            to,
            orientation,
            feed: crate::ir::FeedId(u16::try_from(feed).unwrap()),
            rate: crate::ir::RateId(u16::try_from(rate).unwrap()),
        };
    });
    assert_eq!(straight, [Rule::KnownStart]);
}

#[test]
fn tools_that_are_not_those_of_the_blades() {
    let fewer = broken(|program| {
        let cell = program.cell.as_mut().unwrap();
        cell.tools = crate::ir::Tools::one(*cell.tools.first());
    });
    assert_eq!(fewer, [Rule::Tools]);
    let placed = |place: Option<u32>| {
        broken(|program| {
            let cell = program.cell.as_mut().unwrap();
            let mut second = *cell.tools.at(ToolId(1));
            second.place = place;
            cell.tools = crate::ir::Tools::one(*cell.tools.first()).and(second);
        })
    };
    assert_eq!(placed(Some(7)), []);
    for place in [Some(1), None] {
        assert_eq!(placed(place), [Rule::Tools], "{place:?}");
    }
    assert_eq!(placed(Some(0)), [Rule::Number]);
    let endless = broken(|program| {
        let change = program.cell.as_mut().unwrap().change.as_mut().unwrap();
        change.time = Duration::s(f64::INFINITY);
    });
    assert_eq!(endless, [Rule::Number]);
}

#[test]
fn numbers_of_no_blade() {
    let of_an_operation = broken(|program| program.operations[1].tools = vec![ToolId(2)]);
    assert!(
        of_an_operation.contains(&Rule::TableReference),
        "{of_an_operation:?}"
    );
    let of_a_change = broken(|program| {
        let change = change(program);
        program.ops[change].action = Action::ToolChange {
            tool: ToolId(u16::MAX),
        };
    });
    assert!(of_a_change.contains(&Rule::TableReference), "{of_a_change:?}");
}

proptest! {
    /// Whatever numbers stand in the tables, there is an answer.
    #[test]
    fn any_numbers_are_judged(
        of_operations in prop::collection::vec(0..5_u16, 2),
        of_change in 0..5_u16,
        at in any::<prop::sample::Index>(),
        site in 0..4_u16,
    ) {
        let mut program = program();
        for (operation, tool) in program.operations.iter_mut().zip(of_operations) {
            operation.tools = vec![ToolId(tool)];
        }
        let place = at.index(program.ops.len());
        program.ops[place].action = Action::ToolChange { tool: ToolId(of_change) };
        program.ops[place].site = crate::ir::Site::Operation(OperationId(site));
        let _ = rules(program);
    }
}
