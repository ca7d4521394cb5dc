//! Modules: the `.src` and `.dat` around a part, and the main program that calls the parts.

use crate::body::{self, Source};
use crate::keywords::{HOME, part_name};
use crate::options::PartNames;
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Load, PlacedFrame, Registered};
use vcutc_backend_api::number::NotFinite;
use vcutc_backend_api::script::{Part, Place, Text, Written, first_of, head_lines, push_trimmed};

/// Writes all modules of a program.
pub(crate) fn write(source: Source<'_>, name: &str, parts: &[Part], text: &mut Text<'_>) -> Written {
    match parts {
        [only] => whole(source, name, only, text)?,
        parts => split(source, name, parts, text)?,
    }
    Ok(text.flush()?)
}

/// A program in one module.
fn whole(source: Source<'_>, name: &str, part: &Part, text: &mut Text<'_>) -> Written {
    begin(source, name, text)?;
    header(source, text)?;
    initialise(source, text)?;
    body::write(source, part, text)?;
    footer(source, text)?;
    data(source, name, needs_home(source, part), text)
}

/// A program in parts: the main module first.
fn split(source: Source<'_>, main: &str, parts: &[Part], text: &mut Text<'_>) -> Written {
    let names: Vec<String> = (1..=parts.len()).map(|part| part_name(main, part)).collect();
    begin(source, main, text)?;
    if source.settings.part_names == PartNames::Declared {
        for name in &names {
            text.line(&format!("EXT {name}( )"))?;
        }
    }
    header(source, text)?;
    text.line(";FOLD INI")?;
    text.line("BAS (#INITMOV,0 )")?;
    text.line(";ENDFOLD (INI)")?;
    for (name, part) in names.iter().zip(parts) {
        if let Some(op) = source.program.ops.get(part.ops.start) {
            text.line(&format!("; {}", first_of(op)))?;
        }
        text.line(&format!("{name}( )"))?;
    }
    footer(source, text)?;
    data(source, main, Home::Unused, text)?;
    let mut before: Option<&str> = None;
    for (number, (name, part)) in (1..).zip(names.iter().zip(parts)) {
        begin(source, name, text)?;
        continuation(main, (number, parts.len()), before, text)?;
        initialise(source, text)?;
        body::write(source, part, text)?;
        text.line("END")?;
        data(source, name, needs_home(source, part), text)?;
        before = Some(name);
    }
    Ok(())
}

/// What someone who opens a part should know.
fn continuation(
    main: &str,
    (number, count): (usize, usize),
    before: Option<&str>,
    text: &mut Text<'_>,
) -> Written {
    text.line(&format!("; part {number} of {count}: start {main}, not this"))?;
    if let Some(before) = before {
        text.line(&format!("; goes on where {before} stopped"))?;
        text.line(
            "; if started alone: in T1, the blade clear of the work, watching the way to the first point",
        )?;
    }
    Ok(())
}

/// The head of a `.src`.
fn begin(source: Source<'_>, name: &str, text: &mut Text<'_>) -> Written {
    text.file(&format!("{name}.src"))?;
    marks(source, text)?;
    Ok(text.line(&format!("DEF {name}( )"))?)
}

/// The lines with `&` that the pendant's navigator shows; `.src` and `.dat` carry the same.
fn marks(source: Source<'_>, text: &mut Text<'_>) -> Written {
    text.line("&ACCESS RVP")?;
    text.line("&REL 1")?;
    Ok(text.comment("&COMMENT ", &source.program.name)?)
}

/// Comments at the head of the main module, and the lines that its machine wants there: in front of what resets all that
/// motions depend on.
fn header(source: Source<'_>, text: &mut Text<'_>) -> Written {
    for line in head_lines(source.program, &source.cell.name) {
        text.comment(&format!("; {}", line.ours), line.theirs)?;
    }
    for line in source.settings.common.header {
        text.comment("; ", line)?;
    }
    for line in &source.settings.common.profile.header {
        text.line(line)?;
    }
    Ok(())
}

/// The end of the main routine, with the lines that its machine wants there.
fn footer(source: Source<'_>, text: &mut Text<'_>) -> Written {
    for line in &source.settings.common.profile.footer {
        text.line(line)?;
    }
    Ok(text.line("END")?)
}

/// Everything that motions depend on. `BAS (#INITMOV,0 )` resets all of it, so it comes first [K-QG].
fn initialise(source: Source<'_>, text: &mut Text<'_>) -> Written {
    let (cell, settings) = (source.cell, source.settings);
    text.line(";FOLD INI")?;
    text.line("BAS (#INITMOV,0 )")?;
    text.line(";ENDFOLD (INI)")?;
    text.line(";FOLD SETUP")?;
    frame(source, "TOOL", cell.tool, text)?;
    frame(source, "BASE", cell.base, text)?;
    match cell.load {
        Some(Registered::Value(load)) => load_data(source, load, text)?,
        Some(Registered::Number(number)) => text.line(&format!("$LOAD=LOAD_DATA[{number}]"))?,
        None => text.line("; load as the controller has it: the job states none")?,
    }
    text.line("$IPO_MODE=#BASE")?;
    text.line("$ORI_TYPE=#VAR")?;
    text.line("$ADVANCE=3")?;
    if let Some(distance) = settings.common.approximation {
        text.put(b"$APO.CDIS=");
        text.trimmed(distance.to_mm())?;
        text.end_line()?;
    }
    text.line(&format!("BAS (#VEL_PTP,{} )", settings.home_speed))?;
    Ok(text.line(";ENDFOLD (SETUP)")?)
}

/// Sets `$TOOL` or `$BASE`.
fn frame(source: Source<'_>, which: &str, placed: PlacedFrame, text: &mut Text<'_>) -> Written {
    match placed.number {
        None => {
            let frame = placed.frame;
            let mut literal = Vec::new();
            point(&mut literal, source, frame.origin)?;
            crate::attitude::push_angles(&mut literal, frame.orientation, source.settings.angles)?;
            text.put(b"$");
            text.put(which.as_bytes());
            text.put(b"={");
            text.put(&literal);
            Ok(text.line("}")?)
        }
        Some(number) => Ok(text.line(&format!("BAS (#{which},{number} )"))?),
    }
}

/// `X ..,Y ..,Z ..` in mm.
fn point(out: &mut Vec<u8>, source: Source<'_>, point: Point3) -> Result<(), NotFinite> {
    let lengths = source.settings.common.lengths;
    for (name, value) in [("X ", point.x), (",Y ", point.y), (",Z ", point.z)] {
        out.extend_from_slice(name.as_bytes());
        lengths.push(out, value)?;
    }
    Ok(())
}

/// Sets `$LOAD`. The job knows no inertia about the centre of mass, so that of a point mass stands.
fn load_data(source: Source<'_>, load: Load, text: &mut Text<'_>) -> Written {
    let mut literal = b"$LOAD={M ".to_vec();
    push_trimmed(&mut literal, load.mass.to_kg())?;
    literal.extend_from_slice(b",CM {");
    point(&mut literal, source, load.centre)?;
    text.put(&literal);
    Ok(text.line(",A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}")?)
}

/// Whether a module moves to home.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Home {
    Used,
    Unused,
}

fn needs_home(source: Source<'_>, part: &Part) -> Home {
    let ops = source.program.ops.get(part.ops.clone()).unwrap_or_default();
    let moves_there = ops.iter().any(|op| matches!(op.action, Action::Home));
    let starts_there = part.start.place == Place::Home;
    if moves_there || starts_there {
        Home::Used
    } else {
        Home::Unused
    }
}

/// The `.dat` of a module. Declarations live here only: one behind an instruction of a `.src` does not compile [K-QG].
fn data(source: Source<'_>, name: &str, home: Home, text: &mut Text<'_>) -> Written {
    text.file(&format!("{name}.dat"))?;
    marks(source, text)?;
    text.line(&format!("DEFDAT {name}"))?;
    text.line("EXT BAS (BAS_COMMAND :IN,REAL :IN )")?;
    match home {
        Home::Used => home_angles(source, text)?,
        Home::Unused => {}
    }
    Ok(text.line("ENDDAT")?)
}

/// The home angles. External axes are left out: what is left out stays where it is [K-SI], and the job says nothing of
/// them.
fn home_angles(source: Source<'_>, text: &mut Text<'_>) -> Written {
    let angles = source
        .cell
        .home
        .ok_or(EmitError::Internal("the machine has no home angles"))?;
    text.put(b"DECL E6AXIS ");
    text.put(HOME.as_bytes());
    let starts = ["={A1 ", ",A2 ", ",A3 ", ",A4 ", ",A5 ", ",A6 "];
    for (start, angle) in starts.into_iter().zip(angles.0) {
        text.put(start.as_bytes());
        text.fixed(source.settings.angles, angle.to_degrees())?;
    }
    Ok(text.line("}")?)
}
