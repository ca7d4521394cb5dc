//! What time is spent on: a bar for each kind of motion, and one for each layer, divided by kind.

use super::Setting;
use super::palette::{BLUE, GREEN, INK, ORANGE, PURPLE, SKY};
use super::scale::Scale;
use super::section::most_ticks;
use super::sheet::{self, Entry, Room};
use super::svg::{Anchor, Svg, number};

pub use super::sheet::Heading;

/// What a picture of times shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Times<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// The kinds. Those that take no time are not shown.
    pub kinds: &'a [Kind],
    /// The rows from the top, such as layers.
    pub rows: &'a [Row],
}

/// A kind of motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    /// What it is called.
    pub name: &'static str,
    /// Its time, in s.
    pub seconds: f64,
    /// The same for people.
    pub words: String,
}

/// A row: what one layer takes.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What it is called.
    pub name: String,
    /// Its time by kind, in s, in step with the kinds.
    pub seconds: Vec<f64>,
}

/// Colours of kinds in their order.
pub(super) const KINDS: [&str; 5] = [BLUE, ORANGE, SKY, PURPLE, GREEN];
/// Most rows: more layers are put together.
const MOST_ROWS: usize = 30;
/// Room for names of rows.
const NAMES: f64 = 118.0;
/// Room for the words behind a bar.
const WORDS: f64 = 170.0;
const BAR: f64 = 18.0;
const ROW: f64 = 25.0;

/// Writes the picture as SVG.
#[must_use]
pub fn draw(times: &Times<'_>) -> String {
    let total: f64 = times.kinds.iter().map(|kind| kind.seconds).sum();
    let rows = gathered(times.rows);
    let room = Room::of(times.heading.ids);
    let edge = match times.heading.ids.setting {
        Setting::Alone | Setting::Page => 24.0,
        Setting::Phone => 8.0,
    };
    let left = edge + NAMES - 24.0;
    let by_kind = room.top + 22.0;
    let shown = shown(times);
    let by_row = by_kind + shown.len() as f64 * ROW + 40.0;
    let bottom = by_row + rows.len() as f64 * ROW + 6.0;
    let longest = rows
        .iter()
        .map(|(row, _)| row.seconds.iter().sum())
        .fold(0.0, f64::max);
    let mut svg = sheet::sheet(
        times.heading,
        room,
        &description(times, total),
        bottom + 62.0,
        &legend(times),
    );
    svg.text(
        (edge, room.top + 6.0),
        Anchor::Start,
        "font-weight=\"bold\"",
        "by kind of motion",
    );
    let scale = Scale::new([0.0, longest_kind(times)], [left, room.right - WORDS]);
    for (number, (kind, colour)) in (0_u32..).zip(shown) {
        let y = by_kind + f64::from(number) * ROW;
        svg.text((left - 10.0, y + 14.0), Anchor::End, "", kind.name);
        bar(&mut svg, &scale, [0.0, kind.seconds], y, colour);
        let share = if total > 0.0 {
            kind.seconds / total * 100.0
        } else {
            0.0
        };
        let words = format!("{}, {share:.1} %", kind.words);
        svg.text(
            (scale.at(kind.seconds) + 9.0, y + 14.0),
            Anchor::Start,
            "",
            &words,
        );
    }
    svg.text(
        (edge, by_row - 16.0),
        Anchor::Start,
        "font-weight=\"bold\"",
        "by layer",
    );
    let scale = Scale::new([0.0, longest], [left, room.right - 20.0]);
    axis(&mut svg, &scale, [by_row - 6.0, bottom]);
    for (number, (row, names)) in (0_u32..).zip(&rows) {
        let y = by_row + f64::from(number) * ROW;
        svg.text((left - 10.0, y + 14.0), Anchor::End, "", &row.name);
        let mut from = 0.0;
        for (seconds, colour) in row.seconds.iter().zip(KINDS) {
            bar(&mut svg, &scale, [from, from + seconds], y, colour);
            from += seconds;
        }
        let area = [left, y - 2.0, room.right - 20.0 - left, BAR + 4.0];
        svg.row_of_layers(area, names);
    }
    svg.finish()
}

/// The kinds that take time, with their colours.
fn shown<'a>(times: &Times<'a>) -> Vec<(&'a Kind, &'static str)> {
    let kinds = times.kinds.iter().zip(KINDS);
    kinds.filter(|(kind, _)| kind.seconds > 0.0).collect()
}

fn longest_kind(times: &Times<'_>) -> f64 {
    times.kinds.iter().map(|kind| kind.seconds).fold(0.0, f64::max)
}

fn bar(svg: &mut Svg, scale: &Scale, [from, to]: [f64; 2], y: f64, colour: &str) {
    let (left, right) = (scale.at(from), scale.at(to));
    if right > left {
        svg.rect(
            [left, y, right - left, BAR],
            &format!("fill=\"{colour}\" stroke=\"#fbfaf7\" stroke-width=\"0.6\""),
        );
    }
}

fn axis(svg: &mut Svg, scale: &Scale, [top, bottom]: [f64; 2]) {
    let mut marks = String::new();
    let [left, right] = scale.places;
    let clock = scale.clock(most_ticks(right - left, 80.0));
    for (value, text) in clock.ticks {
        let at = scale.at(value);
        marks += &format!("M{} {}V{}", number(at), number(top), number(bottom + 6.0));
        svg.text((at, bottom + 23.0), Anchor::Middle, "", &text);
    }
    svg.path(&marks, "stroke=\"#dcd6c8\" fill=\"none\"");
    let ground = format!("M{} {}H{}", number(left), number(bottom), number(right));
    svg.path(&ground, &format!("stroke=\"{INK}\" fill=\"none\""));
    svg.text(
        (f64::midpoint(left, right), bottom + 46.0),
        Anchor::Middle,
        "",
        clock.label,
    );
}

fn description(times: &Times<'_>, total: f64) -> String {
    let kinds: Vec<String> = times
        .kinds
        .iter()
        .map(|kind| format!("{} {:.1} s", kind.name, kind.seconds))
        .collect();
    format!(
        "{}. Time of {total:.1} s by kind of motion: {}; and by layer.",
        times.heading.subtitle,
        kinds.join(", ")
    )
}

fn legend(times: &Times<'_>) -> Vec<Entry> {
    shown(times)
        .into_iter()
        .map(|(kind, colour)| Entry::area(format!("fill=\"{colour}\""), kind.name))
        .collect()
}

/// Rows, neighbours put together until they are few enough: named by the first and the last, and with the names of all.
fn gathered(rows: &[Row]) -> Vec<(Row, Vec<String>)> {
    let size = rows.len().div_ceil(MOST_ROWS).max(1);
    let together = |rows: &[Row]| {
        let names = [rows.first(), rows.last()].map(|row| row.map_or("", |row| row.name.as_str()));
        let kinds = rows.iter().map(|row| row.seconds.len()).max().unwrap_or_default();
        let sum = |kind: usize| rows.iter().filter_map(|row| row.seconds.get(kind)).sum();
        let row = Row {
            name: if names[0] == names[1] {
                names[0].to_owned()
            } else {
                format!("{} to {}", names[0], names[1])
            },
            seconds: (0..kinds).map(sum).collect(),
        };
        (row, rows.iter().map(|row| row.name.clone()).collect())
    };
    rows.chunks(size).map(together).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_layers_are_put_together_and_lose_no_time() {
        let rows: Vec<Row> = (1..=100)
            .map(|number| Row {
                name: number.to_string(),
                seconds: vec![f64::from(number), 1.0],
            })
            .collect();
        let gathered = gathered(&rows);
        assert_eq!(gathered.len(), 25);
        assert_eq!(
            (gathered[0].0.name.as_str(), gathered[24].0.name.as_str()),
            ("1 to 4", "97 to 100")
        );
        assert_eq!(gathered[24].1, ["97", "98", "99", "100"]);
        let total: f64 = gathered.iter().flat_map(|(row, _)| &row.seconds).sum();
        assert_eq!(total, 5050.0 + 100.0);
    }
}
