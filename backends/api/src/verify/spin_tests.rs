//! The rules of discs and spindles, broken once each in a program that is right otherwise.

use super::{Rule, verify};
use crate::ir::{Action, Changer, Program, Shape, Spindle, Switch, ToolId};
use crate::testkit::{Recipe, with_disc};
use crate::units::{AngularSpeed, Length};

fn program() -> Program {
    with_disc(Recipe::default().program(), Changer::Program, Spindle::Output(13))
}

fn broken(change: impl FnOnce(&mut Program)) -> Vec<Rule> {
    let mut program = program();
    change(&mut program);
    let faults = verify(program).err().unwrap_or_default();
    faults.into_iter().map(|fault| fault.rule).collect()
}

fn place(program: &Program, is: impl Fn(&Action) -> bool) -> usize {
    program.ops.iter().position(|op| is(&op.action)).unwrap()
}

const fn spins(state: Switch) -> impl Fn(&Action) -> bool {
    move |action| *action == Action::Spin { state }
}

#[test]
fn a_disc_pass_is_verified() {
    assert_eq!(broken(|_| {}), []);
    // Without a machine it is not known what spins.
    assert_eq!(
        broken(|program| {
            program.cell = None;
            program.ops.retain(|op| {
                !matches!(
                    op.action,
                    Action::Spin { .. }
                        | Action::Ultrasonic { .. }
                        | Action::AwaitReady
                        | Action::Home
                        | Action::ChangePlace
                )
            });
        }),
        []
    );
}

#[test]
fn a_disc_that_stands_does_not_cut() {
    let still = broken(|program| {
        let on = place(program, spins(Switch::On));
        program.ops.remove(on);
    });
    assert_eq!(still, [Rule::StillCut]);
    let early = broken(|program| {
        let on = place(program, spins(Switch::On));
        let cut = place(program, |action| matches!(action, Action::Follow { .. }));
        let spin = program.ops.remove(on);
        program.ops.insert(cut - 1, spin);
    });
    assert_eq!(early, [Rule::ReadyNotAwaited]);
}

#[test]
fn a_spindle_stops_before_the_end_and_before_a_change() {
    let ends = broken(|program| {
        let off = place(program, spins(Switch::Off));
        program.ops.remove(off);
    });
    assert_eq!(ends, [Rule::Ending]);
    let changed = broken(|program| {
        let on = place(program, spins(Switch::On));
        let change = place(program, |action| matches!(action, Action::ToolChange { .. }));
        let spin = program.ops.remove(on);
        program.ops.insert(change, spin);
    });
    assert!(changed.contains(&Rule::IdleSpindle), "{changed:?}");
    assert!(changed.contains(&Rule::ChangeAway), "{changed:?}");
}

#[test]
fn a_spindle_is_there_where_a_blade_spins() {
    let none = broken(|program| program.cell.as_mut().unwrap().spindle = None);
    assert!(none.contains(&Rule::NoSpindle), "{none:?}");
    let shared = broken(|program| {
        let cell = program.cell.as_mut().unwrap();
        cell.spindle = cell.ultrasonic.map(Spindle::Output);
    });
    assert_eq!(shared, [Rule::Number]);
}

#[test]
fn a_disc_makes_no_flank_and_does_not_dig() {
    let flank = broken(|program| program.operations[0].tools.swap(0, 1));
    assert_eq!(flank, []);
    let other = broken(|program| program.blades.swap(0, 1));
    assert!(other.contains(&Rule::CutPosture), "{other:?}");
    // Turned about: the shank leans back from the way, so that the rim that follows lies lowest.
    let back = broken(|program| {
        let cut = place(program, |action| matches!(action, Action::Follow { .. }));
        let Action::AxisTravel { to: start, .. } = program.ops[cut - 2].action else {
            panic!()
        };
        for op in &mut program.ops[cut - 2..] {
            match &mut op.action {
                Action::AxisTravel { to, .. } | Action::Approach { to, .. } => {
                    to.y = program.stock.depth.to_mm() + 35.0;
                }
                Action::Follow { to, .. } | Action::Retract { to, .. } => to.y = start.y,
                _ => {}
            }
        }
    });
    assert_eq!(back, [Rule::ChainPosture]);
}

/// The circle of a disc counts where the tip of a straight blade does.
#[test]
fn a_disc_keeps_its_whole_circle_out_of_the_stock() {
    let near = |beside: f64| {
        broken(|program| {
            let down = place(program, |action| matches!(action, Action::Follow { .. })) - 1;
            for op in &mut program.ops[down - 1..=down] {
                if let Action::AxisTravel { to, .. } | Action::Approach { to, .. } = &mut op.action {
                    to.y = -beside;
                }
            }
        })
    };
    // 25 mm cos 3 deg, and 1.5 mm of thickness that lean along the feed.
    let reach = 24.9657 + 0.0785;
    assert_eq!(near(reach + 1e-3), []);
    assert_eq!(near(reach - 1e-3), [Rule::AirMoveThroughStock]);
}

#[test]
fn numbers_of_a_disc_are_sound() {
    let shape = |change: fn(&mut crate::ir::Disc)| {
        broken(|program| {
            if let Shape::Disc(disc) = &mut program.blades[usize::from(ToolId(1).0)].shape {
                change(disc);
            }
        })
    };
    assert_eq!(
        shape(|disc| disc.spin = AngularSpeed::rad_per_s(0.0)),
        [Rule::Number]
    );
    assert_eq!(shape(|disc| disc.thickness = Length::ZERO), [Rule::Number]);
    assert!(shape(|disc| disc.radius = Length::mm(f64::NAN)).contains(&Rule::Number));
}
