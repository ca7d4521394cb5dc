//! Programs that people have edited: what means the same is accepted, and what does not is reported.

use crate::round_trip::replayed;
use crate::support::{cell, emit_with, one_cut, options, reachable};
use vcutc_backend_api::backend::{OptionValue, Options};
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Inertia, Load, Registered};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::readback::{Divergence, DivergenceKind, Place, ProgramFile, program_files};
use vcutc_backend_api::testkit::{CellRecipe, Recipe};
use vcutc_backend_api::units::{Length, Mass};

fn program() -> ReachableProgram {
    reachable(one_cut().program())
}

fn files(options: &Options) -> Vec<ProgramFile> {
    program_files(&emit_with(&program(), options))
}

/// The program with one text in the place of another in its main module, which must have it.
fn edited(from: &str, to: &str) -> Result<Vec<Place>, Divergence> {
    let options = options(&[]);
    let mut files = files(&options);
    assert!(files[0].text.contains(from), "{from}");
    files[0].text = files[0].text.replacen(from, to, 1);
    replayed(&program(), &options, &files)
}

const MOVE: &str = "MoveL [[2.985,-16.036,";
const SPEED: &str = "vc_speed1,fine";
const POINT: &str = "[[2.985,-16.036,60.000],[0.37554642,0.70664089,0.59913678,0.02566435],[0,0,1,0],\
                     [9E9,9E9,9E9,9E9,9E9,9E9]]";

#[test]
fn layout_case_and_names_make_no_difference() {
    for (from, to) in [
        (MOVE, "movel\n  [ [ 2.985 , -16.0360,\t! a comment; with ends\r\n"),
        ("SingArea\\Off;", "  SINGAREA \\ off ;"),
        (
            "ConfL\\On;",
            "ConfL\\On; AccSet 100, 100; VelSet 100,5000; TPErase; TPWrite \"go; now\";",
        ),
        ("CONST num", "LOCAL CONST num"),
        ("vc_feed2:=500.0", "vc_feed2:=5E2"),
        (
            "MODULE sample",
            "%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\nMODULE sample(NOSTEPIN)",
        ),
        ("SetDO do12,1;", "SetDO DO12,high;"),
        (SPEED, "vc_speed2\\V:=500,fine"),
        (
            "CONST num",
            "CONST robtarget unused:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nCONST num",
        ),
        (
            "PERS tooldata",
            "PERS tooldata tUnused:=[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];PERS tooldata",
        ),
        (
            "ENDMODULE",
            "  PROC extra(num x)\n MoveL nowhere; ENDPROC FUNC num f() RETURN 1; ENDFUNC ENDMODULE",
        ),
    ] {
        let found = edited(from, to);
        assert!(found.is_ok(), "{to}: {found:?}");
    }
}

#[test]
fn a_named_target_is_that_target() {
    let options = options(&[]);
    let mut files = files(&options);
    let declared = format!("  VAR robtarget pStart:={POINT};\n  CONST num");
    assert!(files[0].text.contains(POINT));
    files[0].text = files[0]
        .text
        .replace(POINT, "pStart")
        .replacen("  CONST num", &declared, 1);
    assert!(replayed(&program(), &options, &files).is_ok());
}

#[test]
fn what_is_changed_differs() {
    for (from, to) in [
        (MOVE, "MoveL [[2.986,-16.036,"),
        ("[0,0,1,0]", "[0,0,1,1]"),
        ("vc_feed1:=200.0", "vc_feed1:=201.0"),
        ("vc_rate1:=90.0", "vc_rate1:=80.0"),
        ("SetDO do12,1;", "SetDO do12,0;"),
        ("SetDO do12,1;", "SetDO do13,1;"),
        ("WaitTime 0.5;", "WaitTime 0.4;"),
        ("WaitTime 0.5;", ""),
        ("[[0.0000,-90.0000", "[[0.0010,-90.0000"),
        (SPEED, "vc_speed1\\T:=3,fine"),
        (SPEED, "v100,fine"),
    ] {
        match edited(from, to) {
            Err(Divergence {
                what: DivergenceKind::Differs(found),
                place: Some(_),
                op: Some(_),
            }) => assert!(!found.is_empty(), "{to}"),
            other => panic!("{to}: {other:?}"),
        }
    }
}

#[test]
fn another_frame_is_another_program() {
    for (from, to) in [
        ("[[0.000,0.000,310.000]", "[[0.000,0.000,311.000]"),
        ("[[1800.000", "[[1801.000"),
    ] {
        let found = edited(from, to).unwrap_err();
        assert!(matches!(found.what, DivergenceKind::Frame(_)), "{to}: {found:?}");
    }
}

#[test]
fn what_is_not_known_is_not_taken_for_a_move() {
    for (from, to) in [
        ("ConfL\\On;", "ConfL\\Off;"),
        ("ConfL\\On;", ""),
        ("ConfJ\\On;", ""),
        ("SingArea\\Off;", "SingArea\\Wrist;"),
        ("SingArea\\Off;", "SingArea\\Off; VelSet 50,5000;"),
        ("SingArea\\Off;", "SingArea\\Off; vc_home.robax.rax_1:=5;"),
        ("SingArea\\Off;", "SingArea\\Off; IF di1=1 THEN Stop; ENDIF"),
        ("SingArea\\Off;", "SingArea\\Off; main;"),
        ("SingArea\\Off;", "SingArea\\Off; PDispOn p1,t;"),
        ("\\WObj:=vc_wobj", ""),
        (",vc_tool\\WObj", ",tool0\\WObj"),
        (",vc_tool\\WObj", ",tSecond\\WObj"),
        ("\\NoEOffs", ""),
        (SPEED, "vc_speed1,z10"),
        (SPEED, "vc_speed1\\V:=10\\T:=2,fine"),
        (POINT, "Offs(p1,0,0,10)"),
        (
            "9E9,9E9,9E9,9E9,9E9,9E9]],vc_speed1",
            "0,9E9,9E9,9E9,9E9,9E9]],vc_speed1",
        ),
        ("[0.37554642", "[0.47554642"),
        ("[12.5,[", "[11.5,["),
        ("[TRUE,[[", "[FALSE,[["),
        ("[250,", "[260,"),
        (",5000,1000]", ",5000,1001]"),
        ("MODULE sample", "MODULE simple"),
        ("PROC main()", "PROC main(num x)"),
        (
            "CONST num vc_feed1:=200.0;",
            "CONST num vc_feed1:=200.0; CONST num vc_feed1:=200.0;",
        ),
        ("PROC main()", "PROC main() CONST num vc_feed1:=7;"),
        ("SetDO do12,1;", "SetDO\\SDelay:=1,do12,1;"),
        ("SetDO do12,1;", "SetDO do12,1"),
        (";\r\n    WaitTime 0.5;", "\r\n    WaitTime 0.5;"),
        ("  ENDPROC", ""),
        ("ENDMODULE", ""),
    ] {
        let found = edited(from, to).expect_err(to);
        let is_reported = matches!(found.what, DivergenceKind::NotUnderstood | DivergenceKind::Ends);
        assert!(is_reported, "{to}: {found:?}");
    }
}

#[test]
fn the_list_says_what_is_loaded() {
    let options = options(&[("lines_per_part", OptionValue::Integer(1))]);
    let program = program();
    let all = files(&options);
    assert!(replayed(&program, &options, &all).is_ok());
    let list = all.len() - 1;
    // Without a list everything is loaded.
    assert!(replayed(&program, &options, &all[..list]).is_ok());
    // A module that is not there, not in the list, or called twice.
    let mut missing = all.clone();
    missing.remove(1);
    assert!(replayed(&program, &options, &missing).is_err());
    let mut unlisted = all.clone();
    unlisted[list].text = unlisted[list]
        .text
        .replacen("  <Module>sample_m001.mod</Module>\r\n", "", 1);
    assert!(replayed(&program, &options, &unlisted).is_err());
    let mut twice = all.clone();
    twice[0].text = twice[0]
        .text
        .replacen("sample_part001;", "sample_part001; sample_part001;", 1);
    assert!(replayed(&program, &options, &twice).is_err());
    // One of an older program beside it does no harm.
    let mut older = all;
    older.push(ProgramFile {
        name: "sample_m099.mod".to_owned(),
        text: "MODULE sample_m099 PROC sample_part001() ENDPROC ENDMODULE".to_owned(),
    });
    assert!(replayed(&program, &options, &older).is_ok());
}

#[test]
fn lines_of_the_profile_are_known() {
    let profile = Profile {
        header: vec![
            "    Set doLamp;".to_owned(),
            "PulseDO\\PLength:=0.2, doHorn; TPWrite \"cell 2\";".to_owned(),
        ],
        footer: vec!["    Reset doLamp; ! off".to_owned()],
        extension: Some("modx".to_owned()),
        ..Profile::default()
    };
    let options = options(&[]).with_profile(profile);
    let files = files(&options);
    assert_eq!(files[0].name, "sample.modx");
    assert!(files[0].text.contains("PulseDO\\PLength:=0.2, doHorn;"));
    assert!(replayed(&program(), &options, &files).is_ok());
}

/// A corner may be rounded as the job says, and by no more.
#[test]
fn zones_are_those_of_the_job() {
    let options = options(&[("approximation", OptionValue::Length(Length::mm(2.5)))]);
    let program = program();
    let mut files = files(&options);
    assert!(files[0].text.contains("[FALSE,2.5,2.5,2.5,0.25,2.5,0.25]"));
    assert!(replayed(&program, &options, &files).is_ok());
    files[0].text = files[0].text.replacen("[FALSE,2.5,", "[FALSE,3.5,", 1);
    assert!(replayed(&program, &options, &files).is_err());
}

#[test]
fn a_load_is_read_with_its_moments_of_inertia() {
    let load = Load {
        mass: Mass::kg(14.5),
        centre: Point3::new(0.0, 0.0, 140.0),
        inertia: Some(Inertia {
            x: 0.3,
            y: 0.25,
            z: 0.05,
        }),
    };
    let recipe = Recipe {
        cell: CellRecipe {
            load: Some(Registered::Value(load)),
            ..cell()
        },
        ..one_cut()
    };
    let program = reachable(recipe.program());
    let options = options(&[]);
    let mut files = program_files(&emit_with(&program, &options));
    assert!(replayed(&program, &options, &files).is_ok());
    let moments = "[1,0,0,0],0.3,0.25,0.05]";
    assert!(files[0].text.contains(moments));
    for other in [
        "[1,0,0,0],0.3,0.25,0.06]",
        "[1,0,0,0],0,0,0]",
        "[0,1,0,0],0.3,0.25,0.05]",
    ] {
        let before = files[0].text.clone();
        files[0].text = before.replacen(moments, other, 1);
        assert!(replayed(&program, &options, &files).is_err(), "{other}");
        files[0].text = before;
    }
}
