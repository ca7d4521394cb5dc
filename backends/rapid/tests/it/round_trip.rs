//! Written, read again, and followed op by op.

use crate::support::{cell, emit_with, numbered, options, reachable, recipe};
use proptest::prelude::*;
use vcutc_backend_api::backend::{Backend, OptionValue, Options};
use vcutc_backend_api::bundle::Bundle;
use vcutc_backend_api::ir::{AxisValues, Edges, Ready};
use vcutc_backend_api::motion::ReachableProgram;
use vcutc_backend_api::readback::{
    Comparator, Divergence, Place, ProgramFile, Replay, Sources, program_files,
};
use vcutc_backend_api::testkit::{CellRecipe, Crossing, Passes, Recipe};
use vcutc_backend_api::units::{Angle, AngularSpeed, Duration, Length, Speed};
use vcutc_backend_rapid::Rapid;

pub(crate) fn replayed(
    program: &ReachableProgram,
    options: &Options,
    files: &[ProgramFile],
) -> Result<Vec<Place>, Divergence> {
    let reader = Rapid.reader().unwrap();
    let mut replay = Replay::new(
        Comparator::new(program, reader, reader.resolution(options)),
        reader.frames(),
    );
    let sources = Sources {
        files,
        cell: program.program().cell.as_ref().unwrap(),
        options,
    };
    reader.read(sources, &mut |statement| replay.take(&statement));
    replay.finish()
}

fn files(bundle: &Bundle) -> Vec<ProgramFile> {
    program_files(bundle)
}

proptest! {
    #[test]
    fn any_recipe_is_read_back(
        (operations, layers, cuts) in (0..3_u16, 0..4_u32, 0..4_u32),
        (swing, rake) in (5.0..60.0_f64, 45.0..90.0_f64),
        (layer_pass, single, by_axes, is_numbered) in any::<(bool, bool, bool, bool)>(),
        (cut, travel, rate) in (1.0..900.0_f64, 1.0..2000.0_f64, 1.0..400.0_f64),
        turned in prop::array::uniform2(-340.0..340.0_f64),
        lines in prop::sample::select(vec![0_u32, 1, 12, 60]),
        rounding in prop::sample::select(vec![0.0, 2.5, 10.0]),
        (decimals, ready) in (3..7_u32, any::<bool>()),
    ) {
        let frames = if is_numbered {
            CellRecipe { tool: numbered(3), base: numbered(2), load: None, ..cell() }
        } else {
            cell()
        };
        let recipe = Recipe {
            operations,
            layers,
            cuts,
            swing: Angle::deg(swing),
            rake: Angle::deg(rake),
            passes: if layer_pass { Passes::Layer } else { Passes::Point },
            edges: if single { Edges::Single } else { Edges::Double },
            cut_feed: Speed::mm_per_s(cut),
            travel_feed: Speed::mm_per_s(travel),
            rate: AngularSpeed::deg_per_s(rate),
            crossing: if by_axes { Crossing::ByAxes } else { Crossing::Straight },
            dwell: single.then_some(Duration::s(0.25)),
            cell: CellRecipe {
                home: AxisValues([0.0, -90.0, 90.0, turned[0], 45.0, turned[1]].map(f64::to_radians)),
                ready: if ready { Ready::Input(7) } else { Ready::After(Duration::s(0.5)) },
                ..frames
            },
            ..recipe()
        };
        let program = reachable(recipe.program());
        let options = options(&[
            ("lines_per_part", OptionValue::Integer(lines)),
            ("approximation", OptionValue::Length(Length::mm(rounding))),
            ("decimals", OptionValue::Integer(decimals)),
        ]);
        let files = files(&emit_with(&program, &options));
        let found = replayed(&program, &options, &files).map_err(|divergence| {
            let place = divergence.place.unwrap_or_else(|| panic!("{divergence:?}"));
            let text = &files[place.file as usize].text[place.start as usize..place.end as usize];
            TestCaseError::fail(format!("{divergence:?} at {text}"))
        })?;
        prop_assert_eq!(found.len(), program.program().ops.len());
    }

    /// Whatever happens to the text, it is read to its end, and every place lies in it.
    #[test]
    fn damaged_programs_are_read(
        damage in prop::collection::vec((any::<prop::sample::Index>(), "[ -~\n]{0,6}", 0..40_usize), 1..6),
    ) {
        let program = reachable(Recipe { layers: 1, cuts: 1, ..recipe() }.program());
        let options = options(&[("lines_per_part", OptionValue::Integer(1))]);
        let mut files = files(&emit_with(&program, &options));
        for (place, put, taken) in damage {
            let file = &mut files[place.index(3)];
            let start = place.index(file.text.len());
            let end = (start + taken).min(file.text.len());
            file.text.replace_range(start..end, &put);
        }
        assert_read_once(&files, &options);
    }

    #[test]
    fn any_text_is_read(texts in prop::collection::vec("(MODULE|PROC|main|\\(\\)|MoveL|ENDPROC|ENDMODULE|<Module>|[ -~\nä])*", 1..4)) {
        let files: Vec<ProgramFile> = texts
            .into_iter()
            .zip(["a.mod", "b.pgf", "c.mod"])
            .map(|(text, name)| ProgramFile { name: name.to_owned(), text })
            .collect();
        assert_read_once(&files, &options(&[]));
    }
}

/// Reads files. Every statement stands in its file, and none is reported twice.
fn assert_read_once(files: &[ProgramFile], options: &Options) {
    let reader = Rapid.reader().unwrap();
    let program = recipe().program();
    let sources = Sources {
        files,
        cell: program.cell.as_ref().unwrap(),
        options,
    };
    let mut places = std::collections::BTreeSet::new();
    reader.read(sources, &mut |statement| {
        let place = statement.place;
        let text = files[place.file as usize]
            .text
            .get(place.start as usize..place.end as usize);
        assert!(text.is_some_and(|text| !text.is_empty()), "{place:?}");
        assert!(places.insert(place), "{place:?} is reported twice");
    });
}
