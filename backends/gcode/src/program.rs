//! Files: head and end around the ops, and the main program that calls its parts.

use crate::blocks::Blocks;
use crate::body::{self, Source};
use crate::dialect::{File, Unnumbered};
use crate::names::part_name;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::script::{Part, Written, first_of, head_lines, trimmed_text};

/// Writes all files of a program.
pub(crate) fn write(source: Source<'_>, name: &str, parts: &[Part], blocks: &mut Blocks<'_, '_>) -> Written {
    match parts {
        [only] => whole(source, name, only, blocks)?,
        parts => split(source, name, parts, blocks)?,
    }
    blocks.flush()
}

/// A program in one file.
fn whole(source: Source<'_>, name: &str, part: &Part, blocks: &mut Blocks<'_, '_>) -> Written {
    let file = file(source, name, 0);
    head(source, file, blocks)?;
    body::write(source, part, blocks)?;
    end(source, file, blocks)
}

/// A program in parts: the main program first.
fn split(source: Source<'_>, main: &str, parts: &[Part], blocks: &mut Blocks<'_, '_>) -> Written {
    let names: Vec<String> = (1..=parts.len())
        .map(|part| part_name(main, part, source.settings))
        .collect();
    let main_file = file(source, main, 0);
    head(source, main_file, blocks)?;
    for (place, (name, part)) in (1..).zip(names.iter().zip(parts)) {
        if let Some(op) = source.program().ops.get(part.ops.start) {
            blocks.comment(&first_of(op), "")?;
        }
        let call = source.settings.dialect.call(file(source, name, place));
        blocks.line(&call)?;
    }
    end(source, main_file, blocks)?;
    for (place, (name, part)) in (1..).zip(names.iter().zip(parts)) {
        let file = file(source, name, place);
        part_head(source, file, (main, parts.len()), blocks)?;
        body::write(source, part, blocks)?;
        closing(source, file, blocks)?;
    }
    Ok(())
}

fn file<'a>(source: Source<'_>, name: &'a str, place: usize) -> File<'a> {
    File {
        name,
        place,
        program_number: source.settings.program_number,
    }
}

/// The head of the main program.
fn head(source: Source<'_>, file: File<'_>, blocks: &mut Blocks<'_, '_>) -> Written {
    opening(source, file, blocks)?;
    for line in head_lines(source.program(), &source.cell.name) {
        blocks.comment(&line.ours, line.theirs)?;
    }
    for line in source.settings.common.header {
        // LinuxCNC carries out comments that begin with words such as MSG or LOGOPEN [L-OV].
        blocks.comment("note: ", line)?;
    }
    frames(source, blocks)?;
    setup(source, blocks)?;
    for line in &source.settings.common.profile.header {
        blocks.block(line)?;
    }
    Ok(())
}

/// What the operator has to see to: the values that the program was proven with.
fn frames(source: Source<'_>, blocks: &mut Blocks<'_, '_>) -> Written {
    let dialect = source.settings.dialect;
    let offset = dialect.work_offset_name(offset_number(source));
    let Point3 { x, y, z } = source.cell.base.frame.origin;
    let [x, y, z] = [x, y, z].map(trimmed_text);
    blocks.comment(
        &format!("{offset}: zero of the job, a corner of the stock, at"),
        "",
    )?;
    blocks.comment(&format!("X {x} Y {y} Z {z} mm from the mount"), "")?;
    let length = trimmed_text(source.cell.tool.frame.origin.z);
    let tool = dialect.tool_name(source.tool());
    blocks.comment(&format!("{tool}: length {length} mm"), "")?;
    match dialect.note_of_axis_moves() {
        Some(note) => blocks.comment(note, ""),
        None => Ok(()),
    }
}

/// Number of the work offset, counted from 1.
fn offset_number(source: Source<'_>) -> u32 {
    source.cell.base.number.unwrap_or(1)
}

/// The head of a part.
fn part_head(
    source: Source<'_>,
    file: File<'_>,
    (main, count): (&str, usize),
    blocks: &mut Blocks<'_, '_>,
) -> Written {
    opening(source, file, blocks)?;
    let place = file.place;
    blocks.comment(&format!("part {place} of {count}: start {main}, not this"), "")?;
    if place > 1 {
        blocks.comment("if started alone: the blade clear of the work,", "")?;
        blocks.comment("watching the way to the first point", "")?;
    }
    setup(source, blocks)
}

fn opening(source: Source<'_>, file: File<'_>, blocks: &mut Blocks<'_, '_>) -> Written {
    let [main, part] = source.settings.dialect.extensions();
    let extension = match (file.place, &source.settings.common.profile.extension) {
        (0, Some(extension)) => extension,
        (0, None) => main,
        (_, _) => part,
    };
    blocks.file(&format!("{}.{extension}", file.name), source.settings)?;
    for line in source.settings.dialect.opening(file) {
        blocks.line(&line)?;
    }
    Ok(())
}

/// Everything that motions depend on, tool-centre-point control off.
fn setup(source: Source<'_>, blocks: &mut Blocks<'_, '_>) -> Written {
    let (dialect, settings) = (source.settings.dialect, source.settings);
    let all = dialect.tcp_off(settings).into_iter();
    for block in all.chain(dialect.setup(settings, source.tool())) {
        blocks.block(&block)?;
    }
    work_offset(source, blocks)
}

/// The work offset, which is the operator's where the dialect leaves one without a number to him.
fn work_offset(source: Source<'_>, blocks: &mut Blocks<'_, '_>) -> Written {
    let dialect = source.settings.dialect;
    match (source.cell.base.number, dialect.unnumbered()) {
        (None, Unnumbered::Operators) => return Ok(()),
        (Some(_), Unnumbered::First | Unnumbered::Operators) | (None, Unnumbered::First) => {}
    }
    let number = offset_number(source);
    if let Some(block) = dialect.work_offset(number) {
        blocks.block(&block)?;
    }
    match dialect.rest_of_work_offset(number) {
        Some(line) => blocks.continuation(&line),
        None => Ok(()),
    }
}

/// The end of the main program.
fn end(source: Source<'_>, file: File<'_>, blocks: &mut Blocks<'_, '_>) -> Written {
    for line in &source.settings.common.profile.footer {
        blocks.block(line)?;
    }
    closing(source, file, blocks)
}

fn closing(source: Source<'_>, file: File<'_>, blocks: &mut Blocks<'_, '_>) -> Written {
    for line in source.settings.dialect.closing(file) {
        blocks.line(&line)?;
    }
    Ok(())
}
