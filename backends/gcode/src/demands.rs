//! Options and profiles that a dialect cannot take, or that it lacks.

use crate::codes::Role;
use crate::controller::{AxisPace, TcpCodes};
use crate::given;
use crate::options::{DEFAULT_HOME_SPEED, HOME_SPEED, PERCENT, Settings};
use crate::profile::objection;
use crate::statement::Style;
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::ir::{Cell, Ready, Spindle, Switch};
use vcutc_backend_api::script::{APPROXIMATION, DECIMALS};

/// Everything that is wrong with the options of a job on a machine.
pub(crate) fn check(cell: &Cell, settings: &Settings<'_>) -> Vec<BackendIssue> {
    let mut issues = Vec::new();
    form(settings, &mut issues);
    tcp(settings, &mut issues);
    generator(cell, settings, &mut issues);
    blocks(settings, &mut issues);
    given::check(cell, settings, &mut issues);
    profile(settings, &mut issues);
    issues
}

fn conflict(key: &'static str, why: String) -> BackendIssue {
    BackendIssue::OptionConflict { key, why }
}

fn form(settings: &Settings<'_>, issues: &mut Vec<BackendIssue>) {
    let controller = settings.controller;
    let (decimals, most) = (
        settings.common.lengths.decimals(),
        controller.facts().most_decimals,
    );
    if decimals > most {
        let why = format!(
            "{} reads up to {most} decimals, not {decimals}",
            controller.facts().name
        );
        issues.push(conflict(DECIMALS, why));
    }
    if let Some(approximation) = settings.common.approximation
        && controller.rounded(approximation).is_none()
    {
        let why = format!(
            "{} has no word for rounding some corners so far and stopping at others; take `approximation` out",
            controller.facts().name
        );
        issues.push(conflict(APPROXIMATION, why));
    }
    let is_default = settings.home_speed == f64::from(DEFAULT_HOME_SPEED) / PERCENT;
    match controller.facts().axis_pace {
        AxisPace::Rapid if !is_default => {
            let why = format!(
                "on {} moves of all axes are rapid, and their speed is the override's; take `home_speed` out",
                controller.facts().name
            );
            issues.push(conflict(HOME_SPEED, why));
        }
        AxisPace::Rapid | AxisPace::InverseTime | AxisPace::Path => {}
    }
}

fn tcp(settings: &Settings<'_>, issues: &mut Vec<BackendIssue>) {
    let name = settings.facts().name;
    let of_kinematics = |(role, _): &(Role, &[String])| role.is_of_kinematics();
    for (role, given) in settings.codes.all().into_iter().filter(of_kinematics) {
        let (key, example) = (role.key(), role.example(settings.facts()));
        match (settings.facts().tcp_codes, given) {
            (TcpCodes::Given, []) => issues.push(conflict(
                key,
                format!(
                    "{name} switches tool-centre-point control by M codes of its configuration, which the job has to give, \
                     such as `{key} = \"{example}\"`"
                ),
            )),
            (TcpCodes::Own, [_, ..]) => issues.push(conflict(
                key,
                format!("{name} has a word of its own for this; take `{key}` out"),
            )),
            (TcpCodes::Given, [_, ..]) | (TcpCodes::Own, []) => {}
        }
    }
}

/// Whether a block starts or stops the spindle.
fn turns_spindle(block: &str) -> bool {
    let words = block.split(|c: char| !c.is_ascii_alphanumeric());
    words.into_iter().any(|word| {
        let code = word.trim_start_matches(['M', 'm']);
        code.len() < word.len() && code.parse().is_ok_and(|code: u32| (3..=5).contains(&code))
    })
}

fn generator(cell: &Cell, settings: &Settings<'_>, issues: &mut Vec<BackendIssue>) {
    let (controller, codes) = (settings.controller, settings.codes);
    let name = controller.facts().name;
    let sides = [
        (Role::On, codes.on, Switch::On, "on"),
        (Role::Off, codes.off, Switch::Off, "off"),
    ];
    // One code alone would switch by two different ways.
    let any_given = !(codes.on.is_empty() && codes.off.is_empty());
    for (role, given, state, side) in sides {
        let (key, example) = (role.key(), role.example(settings.facts()));
        // A machine without an output is refused as such.
        let Some(output) = cell.ultrasonic else { break };
        if cell.spindle == Some(Spindle::Own) && given.iter().any(|line| turns_spindle(line)) {
            let why = format!(
                "M3, M4 and M5 turn the blade; switch the generator by another code, such as `{key} = \"{example}\"`"
            );
            issues.push(conflict(key, why));
        }
        if !given.is_empty() {
            continue;
        }
        if any_given {
            let why = format!(
                "the other code of the generator is given; add `{key} = \"{example}\"`, or take both out"
            );
            issues.push(conflict(key, why));
        } else if controller.switch(output, state).is_none() {
            let why = format!(
                "{name} has no word of its own for outputs; name the block that switches output {output} {side}, such as \
                 `{key} = \"{example}\"`"
            );
            issues.push(conflict(key, why));
        }
    }
    let key = Role::Ready.key();
    let ready = Role::Ready.example(settings.facts());
    match cell.ready {
        Ready::Input(input) => {
            if codes.ready.is_empty() && controller.await_input(input, 1).is_none() {
                let why = format!(
                    "{name} has no word that waits for input {input}; say which code does, such as `{key} = \"{ready}\"`"
                );
                issues.push(conflict(key, why));
            }
        }
        Ready::After(_) => {
            if !codes.ready.is_empty() {
                let why = "this machine is ready after a time, not when an input says so; take the code out, or give the \
                           machine `ready = input(...)`";
                issues.push(conflict(key, why.to_owned()));
            }
        }
    }
}

/// Blocks that are copied into the program.
fn blocks(settings: &Settings<'_>, issues: &mut Vec<BackendIssue>) {
    for (role, lines) in settings.codes.all() {
        let key = role.key();
        if let Some(why) = lines.iter().find_map(|line| unfit(line, settings)) {
            issues.push(conflict(key, why));
        } else if lines.len() > 1 && !role.is_of_kinematics() {
            let why = format!("one block, not {}", lines.len());
            issues.push(conflict(key, why));
        }
    }
}

fn profile(settings: &Settings<'_>, issues: &mut Vec<BackendIssue>) {
    let profile = settings.common.profile;
    let mut refuse = |key, why| issues.push(BackendIssue::Profile { key, why });
    let why_not = |line: &String| unfit(line, settings).or_else(|| objection(line, settings));
    for (key, lines) in [("header", &profile.header), ("footer", &profile.footer)] {
        if let Some(why) = lines.iter().find_map(why_not) {
            refuse(key, why);
        }
    }
    if let Some(extension) = &profile.extension {
        let is_plain =
            (1..=8).contains(&extension.len()) && extension.bytes().all(|byte| byte.is_ascii_alphanumeric());
        if !is_plain {
            refuse(
                "extension",
                format!("`{extension}` is not 1 to 8 letters and digits"),
            );
        }
    }
    match (profile.line_numbers, settings.facts().style) {
        (Some(_), Style::Numbered) => refuse(
            "line_numbers",
            format!("{} numbers every line from 0 by 1", settings.facts().name),
        ),
        (Some(of), Style::Brackets | Style::Blocks | Style::Semicolon)
            if of.step == 0 || of.start > 99_999 =>
        {
            refuse(
                "line_numbers",
                "numbers start at 0 to 99999, and a step is 1 or more".to_owned(),
            )
        }
        (Some(_) | None, Style::Brackets | Style::Blocks | Style::Semicolon) | (None, Style::Numbered) => {}
    }
}

/// Why a line cannot stand in a program as it is.
fn unfit(line: &str, settings: &Settings<'_>) -> Option<String> {
    let longest = settings.facts().longest_line.saturating_sub(ROOM_FOR_NUMBER);
    let is_printable = line.bytes().all(|byte| matches!(byte, b' '..=b'~'));
    if !is_printable {
        Some(format!("`{}` is not plain text on one line", line.escape_debug()))
    } else if line.trim().is_empty() {
        Some("there is an empty line".to_owned())
    } else if line.len() > longest {
        Some(format!("a line has {} characters, {longest} fit", line.len()))
    } else {
        None
    }
}

/// What a block's number takes.
const ROOM_FOR_NUMBER: usize = 11;
