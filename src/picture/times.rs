//! What time is spent on: a bar for each kind of motion, and one for each layer, divided by kind.

use super::chart::{self, FRAME};
use super::palette::{BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION};
use super::scale::Scale;
use super::sheet::{self, Entry, Room};
use super::svg::{Anchor, Svg};
use super::trace::Trace;

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
pub(super) const KINDS: [&str; 6] = [BLUE, ORANGE, SKY, PURPLE, GREEN, VERMILION];
/// Most rows: more layers are put together.
const MOST_ROWS: usize = 30;
/// Room for names of rows.
const NAMES: f64 = 94.0;
/// Room for the words behind a bar.
const WORDS: f64 = 170.0;
const BAR: f64 = 18.0;
const ROW: f64 = 25.0;

/// Writes the picture as SVG.
#[must_use]
pub fn draw(times: &Times<'_>) -> String {
    let rows = gathered(times.rows);
    let room = Room::of(times.heading.ids);
    let left = room.indent + NAMES;
    let kinds = times.kinds.iter().zip(KINDS);
    let shown: Vec<(&Kind, &str)> = kinds.filter(|(kind, _)| kind.seconds > 0.0).collect();
    let by_kind = room.top + 22.0;
    let by_row = by_kind + shown.len() as f64 * ROW + 40.0;
    let bottom = by_row + rows.len() as f64 * ROW + 6.0;
    let entry = |(kind, colour): &(&Kind, &str)| Entry::area(format!("fill=\"{colour}\""), kind.name);
    let legend: Vec<Entry> = shown.iter().map(entry).collect();
    let total: f64 = times.kinds.iter().map(|kind| kind.seconds).sum();
    let description = description(times, total);
    let mut svg = sheet::sheet(times.heading, room, &description, bottom + 62.0, &legend);
    let bold = "font-weight=\"bold\"";
    let heading = [room.indent, room.top + 6.0];
    svg.text(heading, Anchor::Start, bold, "by kind of motion");
    let longest = shown.iter().map(|(kind, _)| kind.seconds).fold(0.0, f64::max);
    let scale = Scale::clock([0.0, longest], [left, room.right - WORDS]);
    for (number, (kind, colour)) in shown.iter().enumerate() {
        let y = by_kind + number as f64 * ROW;
        bars(&mut svg, &scale, y, kind.name, [(kind.seconds, *colour)]);
        let share = kind.seconds / total * 100.0;
        let words = format!("{}, {share:.1} %", kind.words);
        let end = [scale.at(kind.seconds) + 9.0, y + 14.0];
        svg.text(end, Anchor::Start, "", &words);
    }
    svg.text([room.indent, by_row - 16.0], Anchor::Start, bold, "by layer");
    let sums = rows.iter().map(|(row, _)| row.seconds.iter().sum());
    let scale = Scale::clock([0.0, sums.fold(0.0, f64::max)], [left, room.right - 20.0]);
    axis(&mut svg, &scale, [by_row - 6.0, bottom]);
    for (number, (row, names)) in rows.iter().enumerate() {
        let y = by_row + number as f64 * ROW;
        let seconds = row.seconds.iter().copied();
        bars(&mut svg, &scale, y, &row.name, seconds.zip(KINDS));
        svg.row_of_layers([left, y - 2.0, scale.length(), BAR + 4.0], names);
    }
    svg.finish()
}

/// A row: its name, and its times one after the other.
fn bars<'a>(
    svg: &mut Svg,
    scale: &Scale,
    y: f64,
    name: &str,
    times: impl IntoIterator<Item = (f64, &'a str)>,
) {
    svg.text([scale.places[0] - 10.0, y + 14.0], Anchor::End, "", name);
    let mut from = 0.0;
    for (seconds, colour) in times {
        let [left, right] = [from, from + seconds].map(|time| scale.at(time));
        if right > left {
            let paint = format!("fill=\"{colour}\" stroke=\"#fbfaf7\" stroke-width=\"0.6\"");
            svg.rect([left, y, right - left, BAR], &paint);
        }
        from += seconds;
    }
}

fn axis(svg: &mut Svg, scale: &Scale, [top, bottom]: [f64; 2]) {
    let [left, right] = scale.places;
    let xs = scale.ticks(80.0).into_iter().map(|(value, _)| scale.at(value));
    let grid = Trace::pieces(xs.map(|x| [[x, top], [x, bottom]]));
    svg.path(grid.text(), "stroke=\"#dcd6c8\" fill=\"none\"");
    chart::ticks_below(svg, scale, bottom, 80.0);
    svg.open([[left, bottom], [right, bottom]], FRAME);
    let middle = [left.midpoint(right), bottom + 46.0];
    svg.text(middle, Anchor::Middle, "", scale.time_label());
}

fn description(times: &Times<'_>, total: f64) -> String {
    let kinds = times.kinds.iter();
    let kinds: Vec<String> = kinds
        .map(|kind| format!("{} {:.1} s", kind.name, kind.seconds))
        .collect();
    let (subtitle, kinds) = (times.heading.subtitle, kinds.join(", "));
    format!("{subtitle}. Time of {total:.1} s by kind of motion: {kinds}; and by layer.")
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
