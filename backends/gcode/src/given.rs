//! Blocks that a job gives because only the builder of the machine knows them: what may stand in one.
//!
//! They are copied into the program and taken at their word when it is read back, so they must not be able to do what the
//! program itself is about: move, change modes, stop, end, call. One M code can do so as well, if the builder wants it to; but
//! not by a slip.

use crate::codes::Role;
use crate::controller::Controller;
use crate::options::Settings;
use vcutc_backend_api::backend::BackendIssue;
use vcutc_backend_api::ir::{Cell, Ready, Switch};
use vcutc_backend_api::readback::normalized;

/// The blocks of an option.
type Given<'p> = (Role, &'p [String]);

/// What is wrong with the blocks of a job, each by itself and beside the others and what the program writes. Options of which
/// a problem is already reported are left out: what is not a line at all is reported as that.
pub(crate) fn check(cell: &Cell, settings: &Settings<'_>, issues: &mut Vec<BackendIssue>) {
    let own = own_blocks(cell, settings);
    let all = settings.codes.all();
    for (place, &(role, lines)) in all.iter().enumerate() {
        let is_reported = |role: Role| issues.iter().any(|issue| is_about(issue, role.key()));
        if is_reported(role) {
            continue;
        }
        let unlike = |other: &&Given<'_>| !is_distinguished((role, lines), **other);
        let fault = lines
            .iter()
            .find_map(|line| unfit(line, role, settings.controller))
            .or_else(|| {
                let line = lines.iter().find(|line| own.contains(&normalized(line)))?;
                Some(format!(
                    "`{line}` is what the program writes for an output or input of the machine; give another code"
                ))
            })
            .or_else(|| {
                let mut others = all.iter().take(place).filter(|(other, _)| !is_reported(*other));
                let (other, _) = others.find(unlike)?;
                Some(format!(
                    "it is `{}` as well, and the two have to differ; give another code",
                    other.key()
                ))
            });
        if let Some(why) = fault {
            let key = role.key();
            issues.push(BackendIssue::OptionConflict { key, why });
        }
    }
}

fn is_about(issue: &BackendIssue, option: &str) -> bool {
    matches!(issue, BackendIssue::OptionConflict { key, .. } if *key == option)
}

/// The blocks that the program writes for outputs and inputs, without layout.
fn own_blocks(cell: &Cell, settings: &Settings<'_>) -> Vec<String> {
    let (controller, codes) = (settings.controller, settings.codes);
    let mut own = Vec::new();
    for (given, state) in [(codes.on, Switch::On), (codes.off, Switch::Off)] {
        if given.is_empty() {
            own.extend(
                cell.ultrasonic
                    .and_then(|output| controller.switch(output, state)),
            );
        }
    }
    match cell.ready {
        Ready::Input(input) if codes.ready.is_empty() => own.extend(controller.await_input(input, 1)),
        Ready::Input(_) | Ready::After(_) => {}
    }
    own.iter().flatten().map(|line| normalized(line)).collect()
}

/// Why a line is not a block of a machine builder.
fn unfit(line: &str, role: Role, controller: &dyn Controller) -> Option<String> {
    let example = role.example(controller.facts());
    let beside = controller.facts().beside_m;
    let Some(code) = m_code(line, beside) else {
        let words: Vec<String> = beside.chars().map(String::from).collect();
        let words = match words.as_slice() {
            [] => "without other words".to_owned(),
            words => format!("with no other words than {}", words.join(", ")),
        };
        return Some(format!(
            "`{line}` is not one M code of the machine's builder, such as `{example}`, {words}"
        ));
    };
    let does = controller.does_by_m(code).or_else(|| {
        (!role.is_of_kinematics() && is_for_signals(code, controller))
            .then_some("is a word of its own for outputs and inputs, which the machine's block gives")
    });
    does.map(|does| {
        format!(
            "M{code} {does} on {}; give a code of the machine's builder, such as `{example}`",
            controller.facts().name
        )
    })
}

/// Whether an M code is the dialect's own for an output or input.
fn is_for_signals(code: u32, controller: &dyn Controller) -> bool {
    let signal = *controller.facts().signals.start();
    let own = [
        controller.switch(signal, Switch::On),
        controller.switch(signal, Switch::Off),
        controller.await_input(signal, 1),
    ];
    let mut lines = own.iter().flatten().flatten();
    lines.any(|line| line.split(' ').next() == Some(format!("M{code}").as_str()))
}

/// The number of the only M code of a line that otherwise has only words of some letters, each once.
fn m_code(line: &str, beside: &str) -> Option<u32> {
    let mut rest = line.trim_ascii();
    let mut seen = String::new();
    let mut code = None;
    while let Some(letter) = rest.chars().next() {
        let letter = letter.to_ascii_uppercase();
        let after = rest.get(1..)?.trim_ascii_start();
        let is_of_number = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'+' | b'-');
        let length = after.bytes().take_while(is_of_number).count();
        let (number, next) = after.split_at_checked(length)?;
        if seen.contains(letter) {
            return None;
        }
        if letter == 'M' {
            let is_plain = (1..=5).contains(&length) && number.bytes().all(|byte| byte.is_ascii_digit());
            code = number.parse().ok().filter(|_| is_plain);
            code?;
        } else if !beside.contains(letter) || number.parse::<f64>().is_err() {
            return None;
        }
        seen.push(letter);
        rest = next.trim_ascii_start();
    }
    code
}

/// Whether a reader of the program can distinguish two options. The two switches of the kinematics may share
/// lines.
fn is_distinguished((one, one_lines): Given<'_>, (other, other_lines): Given<'_>) -> bool {
    let plain = |lines: &[String]| -> Vec<String> { lines.iter().map(|line| normalized(line)).collect() };
    let (one_lines, other_lines) = (plain(one_lines), plain(other_lines));
    if one_lines.is_empty() || other_lines.is_empty() {
        return true;
    }
    if one.is_of_kinematics() && other.is_of_kinematics() {
        !holds(&one_lines, &other_lines) && !holds(&other_lines, &one_lines)
    } else {
        !one_lines.iter().any(|line| other_lines.contains(line))
    }
}

fn holds(lines: &[String], part: &[String]) -> bool {
    lines.windows(part.len()).any(|window| window == part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_m_code_with_its_words() {
        for (line, code) in [
            ("M50", Some(50)),
            (" m 050 ", Some(50)),
            ("M101 P1 Q-2.5", Some(101)),
            ("P1M101", Some(101)),
            ("", None),
            ("P1", None),
            ("M", None),
            ("M-1", None),
            ("M5.1", None),
            ("M50 M51", None),
            ("M50 P1 P2", None),
            ("M50 P", None),
            ("M50 P1-2", None),
            ("M50 X1", None),
            ("M50 (on)", None),
            ("M50;", None),
            ("/M50", None),
            ("M1=50", None),
            ("M\u{fc}", None),
            ("\u{fc}", None),
        ] {
            assert_eq!(m_code(line, "PQ"), code, "{line}");
        }
    }
}
