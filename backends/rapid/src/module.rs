//! Modules: the main one with the data and the entry of the task, those of the parts that it calls, and the list of them.

use crate::body::{self, NO_EXTERNAL_AXES, Source, joints};
use crate::keywords::{AXES_SPEED, FEED, HOME, MAIN, RATE, SPEED, ZONE, part_module, part_routine};
use crate::options::zone_members;
use crate::orient::Quaternion;
use crate::read::TRIMMED_DECIMALS;
use crate::speeds::{EXTERNAL, RATE_OF_NOTHING};
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::{Frame, Point3};
use vcutc_backend_api::ir::{Action, Load, RateId, Registered};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::script::{Part, Text, Written, feed, first_of, head_lines, rate};
use vcutc_backend_api::units::Length;

/// The modes that moves depend on. A task that is started anew has them, one that is started at a part may not.
const MODES: [&str; 3] = ["    ConfJ\\On;", "    ConfL\\On;", "    SingArea\\Off;"];

/// Writes all files of a program.
pub(crate) fn write(source: Source<'_>, main: &str, parts: &[Part], text: &mut Text<'_>) -> Written {
    let extension = source.settings.extension();
    let mut modules = vec![format!("{main}.{extension}")];
    text.file(&format!("{main}.{extension}"))?;
    text.line(&format!("MODULE {main}"))?;
    header(source, text)?;
    data(source, text)?;
    text.line("")?;
    text.line(&format!("  PROC {MAIN}()"))?;
    match parts {
        [only] => {
            modes(text)?;
            verbatim(&source.settings.common.profile.header, text)?;
            body::write(source, only, text)?;
        }
        parts => {
            verbatim(&source.settings.common.profile.header, text)?;
            calls(source, main, parts, text)?;
        }
    }
    verbatim(&source.settings.common.profile.footer, text)?;
    text.line("  ENDPROC")?;
    text.line("ENDMODULE")?;
    if parts.len() > 1 {
        for (number, part) in (1..).zip(parts) {
            let file = format!("{}.{extension}", part_module(main, number));
            text.file(&file)?;
            module_of_part(source, main, (number, parts.len()), part, text)?;
            modules.push(file);
        }
    }
    list(main, &modules, text)?;
    Ok(text.flush()?)
}

/// Lines of the machine's profile, as they are.
fn verbatim(lines: &[String], text: &mut Text<'_>) -> Written {
    for line in lines {
        text.line(line)?;
    }
    Ok(())
}

fn modes(text: &mut Text<'_>) -> Written {
    for line in MODES {
        text.line(line)?;
    }
    Ok(())
}

/// The calls of all parts.
fn calls(source: Source<'_>, main: &str, parts: &[Part], text: &mut Text<'_>) -> Written {
    for (number, part) in (1..).zip(parts) {
        if let Some(op) = source.program.ops.get(part.ops.start) {
            text.line(&format!("    ! {}", first_of(op)))?;
        }
        text.line(&format!("    {};", part_routine(main, number)))?;
    }
    Ok(())
}

/// The module of a part.
fn module_of_part(
    source: Source<'_>,
    main: &str,
    (number, count): (usize, usize),
    part: &Part,
    text: &mut Text<'_>,
) -> Written {
    text.line(&format!("MODULE {}", part_module(main, number)))?;
    text.line(&format!("  ! part {number} of {count}: start {main}, not this"))?;
    if let Some(before) = number.checked_sub(1).filter(|before| *before > 0) {
        text.line(&format!(
            "  ! goes on where {} stopped",
            part_routine(main, before)
        ))?;
        text.line("  ! if started alone: in manual mode, the blade clear of the work, watching the way to the first point")?;
    }
    text.line(&format!("  PROC {}()", part_routine(main, number)))?;
    modes(text)?;
    body::write(source, part, text)?;
    text.line("  ENDPROC")?;
    Ok(text.line("ENDMODULE")?)
}

/// The list of modules, which the controller loads as one program [A-OV].
fn list(main: &str, modules: &[String], text: &mut Text<'_>) -> Written {
    text.file(&format!("{main}.pgf"))?;
    text.line("<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>")?;
    text.line("<Program>")?;
    for module in modules {
        text.line(&format!("  <Module>{module}</Module>"))?;
    }
    Ok(text.line("</Program>")?)
}

/// Comments at the head of the main module.
fn header(source: Source<'_>, text: &mut Text<'_>) -> Written {
    for line in head_lines(source.program, &source.cell.name) {
        text.comment(&format!("  ! {}", line.ours), line.theirs)?;
    }
    for line in source.settings.common.header {
        text.comment("  ! ", line)?;
    }
    Ok(())
}

/// The data that moves refer to, each of which some move does refer to.
fn data(source: Source<'_>, text: &mut Text<'_>) -> Written {
    let moves = |action: &Action| match action {
        Action::Home
        | Action::Travel { .. }
        | Action::AxisTravel { .. }
        | Action::Approach { .. }
        | Action::Retract { .. }
        | Action::Cut { .. }
        | Action::Turn { .. } => true,
        Action::Ultrasonic { .. } | Action::AwaitReady | Action::Dwell { .. } | Action::ToolChange { .. } => {
            false
        }
    };
    if !source.program.ops.iter().any(|op| moves(&op.action)) {
        return Ok(());
    }
    tool(source, text)?;
    work_object(source, text)?;
    home(source, text)?;
    speeds(source, text)?;
    match source.settings.common.approximation {
        Some(distance) => zone(distance, text),
        None => Ok(()),
    }
}

fn tool(source: Source<'_>, text: &mut Text<'_>) -> Written {
    let name = source.settings.tool(source.cell);
    if source.cell.tool.number.is_some() {
        return Ok(text.line(&format!("  ! tool and load as the controller has them in {name}"))?);
    }
    let Some(Registered::Value(load)) = source.cell.load else {
        return Err(EmitError::Internal("a tool without load was not refused"));
    };
    text.put(format!("  PERS tooldata {name}:=[TRUE,").as_bytes());
    frame(source, source.cell.tool.frame, text)?;
    text.put(b",");
    load_data(source, load, text)?;
    Ok(text.line("];")?)
}

/// The job knows no inertia about the centre of mass, so that of a point mass stands.
fn load_data(source: Source<'_>, load: Load, text: &mut Text<'_>) -> Written {
    text.put(b"[");
    text.trimmed(load.mass.to_kg())?;
    text.put(b",");
    point(source, load.centre, text)?;
    text.put(b",[1,0,0,0],0,0,0]");
    Ok(())
}

fn work_object(source: Source<'_>, text: &mut Text<'_>) -> Written {
    let name = source.settings.work_object(source.cell);
    if source.cell.base.number.is_some() {
        return Ok(text.line(&format!("  ! work object as the controller has it in {name}"))?);
    }
    text.put(format!("  PERS wobjdata {name}:=[FALSE,TRUE,\"\",").as_bytes());
    frame(source, source.cell.base.frame, text)?;
    Ok(text.line(",[[0,0,0],[1,0,0,0]]];")?)
}

/// `[[x,y,z],[q1,q2,q3,q4]]`.
fn frame(source: Source<'_>, frame: Frame, text: &mut Text<'_>) -> Written {
    text.put(b"[");
    point(source, frame.origin, text)?;
    text.put(b",");
    Quaternion::rounded(frame.orientation).push(text.buffer());
    text.put(b"]");
    Ok(())
}

/// `[x,y,z]` in mm.
fn point(source: Source<'_>, point: Point3, text: &mut Text<'_>) -> Written {
    for (start, value) in [(b"[", point.x), (b",", point.y), (b",", point.z)] {
        text.put(start);
        text.fixed(source.settings.common.lengths, value)?;
    }
    text.put(b"]");
    Ok(())
}

/// The axis values of home, where a move goes there.
fn home(source: Source<'_>, text: &mut Text<'_>) -> Written {
    let goes = source
        .program
        .ops
        .iter()
        .any(|op| matches!(op.action, Action::Home));
    let Some(axes) = source.cell.home.filter(|_| goes) else {
        return Ok(());
    };
    text.put(format!("  CONST jointtarget {HOME}:=[").as_bytes());
    joints(source, axes, text)?;
    text.put(b",");
    text.put(NO_EXTERNAL_AXES);
    Ok(text.line("];")?)
}

fn speeds(source: Source<'_>, text: &mut Text<'_>) -> Written {
    let program = source.program;
    for id in source.speeds.feeds() {
        number(FEED, u32::from(id.0) + 1, feed(program, id)?.to_mm_per_s(), text)?;
    }
    for id in source.speeds.rates() {
        // Never faster than proven.
        let turning = FixedDecimal::new(TRIMMED_DECIMALS).floored(rate(program, id)?.to_deg_per_s());
        number(RATE, u32::from(id.0) + 1, turning, text)?;
    }
    let rate = |id: Option<RateId>| {
        id.map_or_else(
            || RATE_OF_NOTHING.to_string(),
            |id| format!("{RATE}{}", u32::from(id.0) + 1),
        )
    };
    let home_speed = source.settings.home_speed;
    let [linear, rotary] = EXTERNAL;
    let slowest = rate(source.speeds.slowest_rate());
    text.line(&format!(
        "  CONST speeddata {AXES_SPEED}:=[{home_speed},{slowest},{linear},{rotary}];"
    ))?;
    for (number, (feed, turning)) in source.speeds.all() {
        let tip = feed.map_or_else(
            || home_speed.to_string(),
            |id| format!("{FEED}{}", u32::from(id.0) + 1),
        );
        let turning = rate(turning);
        text.line(&format!(
            "  CONST speeddata {SPEED}{number}:=[{tip},{turning},{linear},{rotary}];"
        ))?;
    }
    Ok(())
}

fn number(start: &str, number: u32, value: f64, text: &mut Text<'_>) -> Written {
    text.put(format!("  CONST num {start}{number}:=").as_bytes());
    text.trimmed(value)?;
    Ok(text.line(";")?)
}

/// All seven members.
fn zone(distance: Length, text: &mut Text<'_>) -> Written {
    text.put(format!("  CONST zonedata {ZONE}:=[FALSE").as_bytes());
    for member in zone_members(distance) {
        text.put(b",");
        text.trimmed(member)?;
    }
    Ok(text.line("];")?)
}
