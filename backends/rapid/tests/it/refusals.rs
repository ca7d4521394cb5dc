//! Programs that RAPID does not take, and why.

use crate::support::{cell, emit_with, issues, issues_with, numbered, one_cut, options, reachable};
use vcutc_backend_api::backend::{Backend, BackendIssue, MachineMismatch, OptionValue};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Load, Maker, Ready, Registered};
use vcutc_backend_api::motion::{Motion, ReachableProgram};
use vcutc_backend_api::profile::{LineNumbers, Profile};
use vcutc_backend_api::testkit::{CellRecipe, Recipe, blade_in_work};
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Mass, Speed};
use vcutc_backend_rapid::Rapid;

fn with_cell(cell: CellRecipe) -> Recipe {
    Recipe { cell, ..one_cut() }
}

fn what(issues: &[BackendIssue]) -> Vec<&'static str> {
    issues
        .iter()
        .map(|issue| match *issue {
            BackendIssue::WrongMachine { drives, .. } => drives,
            BackendIssue::MissingMachineField { field, .. } => field,
            BackendIssue::OptionConflict { key, .. } | BackendIssue::Profile { key, .. } => key,
            BackendIssue::Unsupported { what, .. } | BackendIssue::OutOfRange { what, .. } => what,
            BackendIssue::Failed(_) => "failed",
        })
        .collect()
}

#[test]
fn robots_of_other_makers() {
    for maker in [Maker::Kuka, Maker::Other] {
        let recipe = with_cell(CellRecipe { maker, ..cell() });
        let found = issues(recipe.program(), &[]);
        assert!(
            matches!(
                found.as_slice(),
                [BackendIssue::WrongMachine {
                    mismatch: MachineMismatch::Maker,
                    ..
                }]
            ),
            "{found:?}"
        );
    }
}

#[test]
fn a_tool_by_value_without_its_load() {
    let loads = [None, Some(Registered::Number(1))];
    for load in loads {
        let found = issues(with_cell(CellRecipe { load, ..cell() }).program(), &[]);
        assert_eq!(what(&found), ["load"]);
        let kept = CellRecipe {
            load,
            tool: numbered(3),
            ..cell()
        };
        assert_eq!(issues(with_cell(kept).program(), &[]), []);
    }
}

#[test]
fn loads_that_the_controller_refuses() {
    let load = |mass: f64, z: f64| {
        let load = Load {
            mass: Mass::kg(mass),
            centre: Point3::new(0.0, 0.0, z),
            inertia: None,
        };
        let load = Some(Registered::Value(load));
        what(&issues(with_cell(CellRecipe { load, ..cell() }).program(), &[]))
    };
    assert_eq!(load(0.0, 10.0), ["load mass"]);
    assert_eq!(load(5.0, 0.0), ["load centre of mass"]);
    assert_eq!(load(5.0, 10.0), [""; 0]);
}

#[test]
fn machines_without_home_or_generator() {
    let mut program = one_cut().program();
    let without = CellRecipe {
        ultrasonic: None,
        ..cell()
    };
    assert_eq!(what(&issues(with_cell(without).program(), &[])), ["ultrasonic"]);
    if let Some(cell) = &mut program.cell {
        cell.home = None;
    }
    program
        .ops
        .retain(|op| !matches!(op.action, vcutc_backend_api::ir::Action::Home));
    assert_eq!(what(&issues(program, &[])), ["home"]);
}

#[test]
fn numbers_beyond_what_is_taken() {
    let recipes = [
        (
            Recipe {
                cut_feed: Speed::mm_per_s(7001.0),
                ..one_cut()
            },
            "tip speed",
        ),
        (
            Recipe {
                rate: AngularSpeed::deg_per_s(501.0),
                ..one_cut()
            },
            "reorientation rate",
        ),
        (
            Recipe {
                clearance: Length::mm(10_000.0),
                ..one_cut()
            },
            "Y",
        ),
        (
            with_cell(CellRecipe {
                ready: Ready::After(Duration::s(90_000.0)),
                ..cell()
            }),
            "time until ready",
        ),
    ];
    for (recipe, wanted) in recipes {
        let found = issues(recipe.program(), &[]);
        assert!(what(&found).contains(&wanted), "{found:?}");
    }
}

#[test]
fn names_that_are_not_names() {
    for (key, name) in [
        ("ultrasonic_signal", "do 12"),
        ("tool_name", "tool0"),
        ("wobj_name", "größe"),
        ("tool_name", "vc_home"),
        ("wobj_name", "VC_TOOL"),
    ] {
        let found = issues(one_cut().program(), &[(key, OptionValue::Text(name.to_owned()))]);
        assert_eq!(what(&found), [key], "{name}");
    }
}

#[test]
fn profiles_that_ask_for_what_rapid_does_not_have() {
    let profiles = [
        (
            "line_numbers",
            Profile {
                line_numbers: Some(LineNumbers { start: 10, step: 10 }),
                ..Profile::default()
            },
        ),
        (
            "extension",
            Profile {
                extension: Some("prg".to_owned()),
                ..Profile::default()
            },
        ),
        (
            "header",
            Profile {
                header: vec!["! Grüße".to_owned()],
                ..Profile::default()
            },
        ),
        (
            "reserved",
            Profile {
                reserved: vec!["VC_Speed1".to_owned()],
                ..Profile::default()
            },
        ),
        (
            "reserved",
            Profile {
                reserved: vec!["sample_part002".to_owned()],
                ..Profile::default()
            },
        ),
    ];
    for (key, profile) in profiles {
        let options = options(&[("lines_per_part", OptionValue::Integer(1))]).with_profile(profile);
        assert_eq!(what(&issues_with(one_cut().program(), &options)), [key]);
    }
    let other = Profile {
        reserved: vec!["lamp".to_owned()],
        ..Profile::default()
    };
    let options = options(&[]).with_profile(other);
    assert!(
        !emit_with(&reachable(one_cut().program()), &options)
            .files()
            .is_empty()
    );
}

#[test]
fn far_turns_of_the_wrist_without_points_on_the_way() {
    let recipe = Recipe {
        swing: Angle::deg(60.0),
        rake: Angle::deg(89.0),
        ..one_cut()
    };
    let program = reachable(recipe.program());
    let motion = Motion {
        waypoints: Vec::new(),
        ..program.motion().clone()
    };
    let bare = ReachableProgram::assemble(program.verified().clone(), motion, &|_, axes| blade_in_work(axes))
        .unwrap();
    let options = options(&[]);
    let found = Rapid.check(&bare, &options).err().unwrap_or_default();
    assert!(
        matches!(found.as_slice(), [BackendIssue::Unsupported { .. }]),
        "{found:?}"
    );
}

#[test]
fn lines_that_change_the_program_are_refused() {
    let mut recipe = one_cut();
    recipe.cell.ready = Ready::Input(7);
    for line in [
        "MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;",
        "MoveC p1,p2,v100,fine,tool0;",
        "MoveAbsJ vc_home,vc_axes,fine,vc_tool;",
        "MoveAbsJ vc_home\\NoEOffs,vc_axes,fine,vc_tool\\WObj:=vc_wobj;MoveL 1;",
        "TriggL p1,v100,t1,fine,tool0;",
        "SearchL di1,p1,p2,v100,tool0;",
        "IndAMove ROB_1,1\\ToAbsNum:=90,20;",
        "PDispSet p;",
        "EOffsSet e;",
        "ConfL\\Off;",
        "SingArea\\Wrist;",
        "VelSet 50,100;",
        "SetDO do12,1;",
        "SetDO do30,1;",
        "Set do12;",
        "set DO12;",
        "Reset do12;",
        "PulseDO do12;",
        "PulseDO\\High,do12;",
        "Set di7;",
        "SetAO ao1,f(1);",
        "WaitTime 1;",
        "WaitDI di7,1;",
        "RETURN;",
        "FOR i FROM 1 TO 5 DO",
        "IF TRUE Set doLamp;",
        "GOTO here;",
        "here:",
        "vc_home:=[[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];",
        "VAR num i;",
        "other;",
        "TPWrite other();",
        "TPWrite \"a\"\\Num:=other();",
        "Set doLamp; MoveL 1;",
        "ENDPROC",
        "ENDMODULE",
        "Set doLamp",
        "Stop;",
        "EXIT;",
        "%\"Set\"% doLamp;",
    ] {
        for key in ["header", "footer"] {
            let lines = vec![line.to_owned()];
            let profile = match key {
                "header" => Profile {
                    header: lines,
                    ..Profile::default()
                },
                _ => Profile {
                    footer: lines,
                    ..Profile::default()
                },
            };
            let options = options(&[]).with_profile(profile);
            assert_eq!(what(&issues_with(recipe.program(), &options)), [key], "{line}");
        }
    }
}

/// What the program declares, and what every controller has, cannot be a signal or a frame.
#[test]
fn names_of_the_program_itself_and_of_the_controller() {
    for key in ["ultrasonic_signal", "ready_signal", "tool_name", "wobj_name"] {
        for name in ["vc_feed1", "VC_speed2", "vc_other", "reg1", "clock1", "errno"] {
            let options = options(&[(key, OptionValue::Text(name.to_owned()))]);
            let found = issues_with(one_cut().program(), &options);
            assert!(what(&found).contains(&key), "{key} {name}: {found:?}");
        }
    }
    let named = Recipe {
        name: "vc_feed1".to_owned(),
        ..one_cut()
    };
    let bundle = emit_with(&reachable(named.program()), &options(&[]));
    assert!(bundle.get("job_vc_feed1.mod").is_some());
}
