//! Ops and what differs from them, in words with numbers.

use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{Action, Cell, CutKind, Flank, OpId, Program, Site, Switch};
use vcutc_backend_api::readback::{
    Command, Configuration, DivergenceKind, Effect, FrameRole, Mismatch, Pace,
};
use vcutc_backend_api::units::AngularSpeed;
use vcutc_diagnostics::number::show;
use vcutc_motion::describe::{site_words, value_words};

/// An op in the words of the job: `the left flank of layer 1, cut 2`.
pub(super) fn op_words(program: &Program, op: OpId) -> String {
    let Some(op) = program.op(op) else {
        return "the program".to_owned();
    };
    let site = site_words(program, op.site);
    let in_cut = matches!(op.site, Site::Cut { .. });
    match op.action {
        Action::Home => "the move home".to_owned(),
        Action::Travel { .. } | Action::AxisTravel { .. } | Action::Approach { .. } => {
            format!("the way to {site}")
        }
        Action::Retract { .. } => format!("the way up from {site}"),
        Action::Cut { flank, .. } if in_cut => match (program.cut_kind_at(op.site), flank) {
            (CutKind::Slit, _) => site,
            (_, Flank::Left) => format!("the left flank of {site}"),
            (_, Flank::Right) => format!("the right flank of {site}"),
        },
        Action::Cut { .. } => format!("a cut of {site}"),
        Action::Follow { .. } => format!("a piece of the path of {site}"),
        Action::Turn { .. } => format!("the turn at {site}"),
        Action::Ultrasonic { state: Switch::On } => format!("switching the generator on for {site}"),
        Action::Ultrasonic { state: Switch::Off } => format!("switching the generator off after {site}"),
        Action::Spin { state: Switch::On } => format!("starting the spindle for {site}"),
        Action::Spin { state: Switch::Off } => format!("stopping the spindle after {site}"),
        Action::AwaitReady => format!("waiting for the generator before {site}"),
        Action::Dwell { .. } => format!("a wait in {site}"),
        Action::ChangePlace => "the move to where the blade is changed".to_owned(),
        Action::ToolChange { tool } => match program.blade(tool) {
            Some(blade) => format!("the change to blade `{}`", blade.name),
            None => "the change of the blade".to_owned(),
        },
    }
}

/// An op that goes through the material, of an operation with a disc: `the pass of layer 2, strip 3`, or as [`op_words`].
pub(super) fn cut_words(program: &Program, id: OpId) -> String {
    let op = program.op(id);
    match op.filter(|op| matches!(op.action, Action::Follow { .. })) {
        Some(op) => format!("the pass of {}", site_words(program, op.site)),
        None => op_words(program, id),
    }
}

/// What a command does, in a few words.
pub(super) fn command_words(command: &Command) -> String {
    match command {
        Command::Axes(_) => "an axis move".to_owned(),
        Command::AxesToPose(target) => {
            format!("an axis move that brings the tip to {}", point(target.tip))
        }
        Command::Straight { to, .. } => format!("a straight move of the tip to {}", point(to.tip)),
        Command::Round { to, .. } => format!("a circular move of the tip to {}", point(to.tip)),
        Command::Switch { output, state } => format!("output {output} is switched {}", switch(*state)),
        Command::Spin(speed) => format!("the spindle {}", turns(*speed)),
        Command::AwaitInput(input) => format!("the program waits for input {input}"),
        Command::Wait(time) => format!("the program waits for {} s", show(time.to_s())),
        Command::ChangeTool(Some(place)) => format!("the blade of place {place} is put in"),
        Command::ChangeTool(None) => "the program stops for a blade to be put in by hand".to_owned(),
    }
}

/// What a statement is, where it is not a command.
pub(super) const fn kind_words(effect: &Effect) -> &'static str {
    match effect {
        Effect::Command(_) => "a motion, a switch, a wait or a change of the blade",
        Effect::Frame(FrameRole::Tool, _) => "the tool frame",
        Effect::Frame(FrameRole::Base, _) => "the base frame",
        Effect::Setting => "a setting",
        Effect::PartBegins => "the beginning of a part",
        Effect::Unknown | Effect::Unreadable { .. } => "an unknown statement",
    }
}

/// Why a fresh program was not read back as it should be, a line each.
pub(crate) fn divergence_words(what: &DivergenceKind, cell: Option<&Cell>) -> Vec<String> {
    let one = |text: &str| vec![text.to_owned()];
    match what {
        DivergenceKind::Differs(found) => found
            .iter()
            .map(|mismatch| mismatch_words(mismatch, cell))
            .collect(),
        DivergenceKind::Ends => one("the program ends here"),
        DivergenceKind::More => one("something is done after the last op"),
        DivergenceKind::Frame(FrameRole::Tool) => one("the tool frame has another value"),
        DivergenceKind::Frame(FrameRole::Base) => one("the base frame has another value"),
        DivergenceKind::NoFrame(FrameRole::Tool) => one("the tool frame is not set before the first motion"),
        DivergenceKind::NoFrame(FrameRole::Base) => one("the base frame is not set before the first motion"),
        DivergenceKind::NotUnderstood => one("the statement is unknown"),
    }
}

/// A mismatch as half a sentence: `the tip ends at x 3.2 mm, the job says x 3 mm`.
pub(super) fn mismatch_words(mismatch: &Mismatch, cell: Option<&Cell>) -> String {
    match *mismatch {
        Mismatch::Kind => "something else is done".to_owned(),
        Mismatch::Tip { is, should } => tip(is, should),
        Mismatch::Attitude { by } => format!(
            "the blade has another orientation, turned by {} deg",
            fine(by.to_deg())
        ),
        Mismatch::Configuration { is, should } => format!(
            "the arm configuration is different: {}, the job needs {}",
            configuration(is, should),
            configuration(should, is)
        ),
        Mismatch::Axis { axis, is, should } => match cell.and_then(|cell| cell.axes.get(axis)) {
            Some(axis) => {
                let (name, is, should) = (&axis.name, value_words(axis, is), value_words(axis, should));
                format!("{name} goes to {is}, the job says {should}")
            }
            None => "an axis goes elsewhere".to_owned(),
        },
        Mismatch::Feed { is, should } => format!(
            "the tip moves at {}, the job says {} mm/s",
            is.map_or("no stated speed".to_owned(), |is| format!(
                "{} mm/s",
                fine(is.to_mm_per_s())
            )),
            fine(should.to_mm_per_s())
        ),
        Mismatch::Rate { is, should } => {
            let words = |rate: f64| fine(rate.to_degrees());
            format!(
                "the blade turns at {}, the job says {} deg/s",
                is.map_or("no single rate".to_owned(), |is| format!(
                    "{} deg/s",
                    words(is.to_rad_per_s())
                )),
                words(should.to_rad_per_s())
            )
        }
        Mismatch::Time { is, should } => format!(
            "it takes {} s, the job says {} s",
            fine(is.to_s()),
            fine(should.to_s())
        ),
        Mismatch::NoStop => "the machine does not make the exact stop that the job needs".to_owned(),
        Mismatch::Stops => "the machine stops where the path goes on".to_owned(),
        Mismatch::Blend { is, should } => format!(
            "the tip may leave the path by {} mm where it goes on, the job says {} mm",
            fine(is.to_mm()),
            fine(should.to_mm())
        ),
        Mismatch::Arc { by } => format!("the tip moves on another arc, {} mm off", fine(by.to_mm())),
        Mismatch::Output { is, should } => {
            let wanted = should
                .0
                .map_or("no output".to_owned(), |number| format!("output {number}"));
            format!(
                "output {} is switched {}, the job says {wanted}, {}",
                is.0,
                switch(is.1),
                switch(should.1)
            )
        }
        Mismatch::Spin { is, should } => {
            format!(
                "the spindle {}, the job says that it {}",
                turns(is),
                turns(should)
            )
        }
        Mismatch::ToolPlace { is, should } => {
            format!(
                "the blade comes {}, the job says {}",
                from_place(is),
                from_place(should)
            )
        }
        Mismatch::Input { is, should } => {
            format!("the program waits for input {is}, the job says input {should}")
        }
    }
}

/// What a spindle does at a speed; none where it stops.
fn turns(speed: Option<AngularSpeed>) -> String {
    speed.map_or("stops".to_owned(), |speed| {
        format!("turns at {} rev/min", show(speed.to_rev_per_min()))
    })
}

fn from_place(place: Option<u32>) -> String {
    place.map_or("by hand".to_owned(), |place| format!("from place {place}"))
}

/// Only the coordinates that differ.
fn tip(is: Point3, should: Point3) -> String {
    let coordinates = [
        ("x", is.x, should.x),
        ("y", is.y, should.y),
        ("z", is.z, should.z),
    ];
    let differ: Vec<_> = coordinates
        .into_iter()
        .filter(|(_, is, should)| (is - should).abs() > SAME_COORDINATE)
        .collect();
    let words = |value: &dyn Fn(&(&str, f64, f64)) -> f64| {
        let each = differ
            .iter()
            .map(|all| format!("{} {} mm", all.0, fine(value(all))));
        each.collect::<Vec<_>>().join(", ")
    };
    format!(
        "the tip ends at {}, the job says {}",
        words(&|all| all.1),
        words(&|all| all.2)
    )
}

/// Coordinates nearer than this are not distinguished, in mm.
const SAME_COORDINATE: f64 = 1e-5;

/// A number with enough decimals to distinguish it from one that differs in the last place that dialects
/// print.
fn fine(value: f64) -> String {
    let text = format!("{value:.5}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text {
        "-0" => "0".to_owned(),
        text => text.to_owned(),
    }
}

fn point(tip: Point3) -> String {
    format!("x {} mm, y {} mm, z {} mm", show(tip.x), show(tip.y), show(tip.z))
}

/// The numbers of a configuration, as many as it or the other one uses.
fn configuration(configuration: Option<Configuration>, other: Option<Configuration>) -> String {
    let Some(Configuration(numbers)) = configuration else {
        return "no configuration".to_owned();
    };
    let used = |Configuration(numbers): Configuration| numbers.iter().rposition(|&number| number != 0);
    let last = configuration
        .and_then(used)
        .max(other.and_then(used))
        .unwrap_or_default();
    let numbers: Vec<_> = numbers.iter().take(last + 1).map(ToString::to_string).collect();
    format!("configuration {}", numbers.join(", "))
}

const fn switch(state: Switch) -> &'static str {
    match state {
        Switch::On => "on",
        Switch::Off => "off",
    }
}

/// The speed that a statement's command has, where commands of the same text may have another.
pub(super) fn pace_words(command: &Command) -> Option<String> {
    let (Command::Straight { pace, .. } | Command::Round { pace, .. }) = command else {
        return None;
    };
    match *pace {
        Pace::Speeds { tip, turn } => {
            let tip = tip.map(|tip| format!("{} mm/s", fine(tip.to_mm_per_s())));
            let turn = turn.map(|turn| format!("{} deg/s", fine(turn.to_rad_per_s().to_degrees())));
            Some(tip.into_iter().chain(turn).collect::<Vec<_>>().join(" and "))
        }
        Pace::Apart { tip, swivel, twist } => {
            let tip = tip.map(|tip| format!("{} mm/s", fine(tip.to_mm_per_s())));
            let turns = [swivel, twist].into_iter().flatten();
            let turns = turns.map(|rate| format!("{} deg/s", fine(rate.to_rad_per_s().to_degrees())));
            Some(tip.into_iter().chain(turns).collect::<Vec<_>>().join(" and "))
        }
        Pace::Tip(tip) => Some(format!("{} mm/s", fine(tip.to_mm_per_s()))),
        Pace::PerMinute(times) => Some(format!("{} per minute", fine(times))),
        Pace::Rotary(rate) => Some(format!("{} deg/s", fine(rate.to_rad_per_s().to_degrees()))),
    }
}
