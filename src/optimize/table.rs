//! Tables and times for people.

use vcutc_backend_api::units::Duration;

/// Cells in columns, those of numbers to the right. A row may be shorter than the head; its last cell then runs on.
pub(super) fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let whole = || rows.iter().filter(|row| row.len() == head.len());
    let columns: Vec<Column> = (0..head.len())
        .map(|column| {
            let cells = || whole().filter_map(|row| row.get(column));
            let any_cells = || rows.iter().filter_map(|row| row.get(column));
            let words = head.get(column).map_or(0, |word| word.len());
            Column {
                width: cells().map(String::len).fold(words, usize::max),
                // Every number has a unit or none, and may be a bound.
                side: if any_cells().any(|cell| cell.contains(|c: char| c.is_ascii_digit())) {
                    Side::Right
                } else {
                    Side::Left
                },
            }
        })
        .collect();
    let head: Vec<String> = head.iter().map(|&word| word.to_owned()).collect();
    let lines = [&head].into_iter().chain(rows);
    lines.map(|cells| line(cells, &columns, head.len())).collect()
}

struct Column {
    width: usize,
    side: Side,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

fn line(cells: &[String], columns: &[Column], whole: usize) -> String {
    let padded = cells
        .iter()
        .zip(columns)
        .enumerate()
        .map(|(index, (cell, column))| {
            let width = column.width;
            let runs_on = cells.len() < whole && index + 1 == cells.len();
            match column.side {
                Side::Right if !runs_on => format!("{cell:>width$}"),
                Side::Right | Side::Left => format!("{cell:<width$}"),
            }
        });
    let line = padded.collect::<Vec<_>>().join("  ");
    format!("  {}\n", line.trim_end())
}

/// As elsewhere: `2 min 05.4 s`; savings may be below zero.
pub(super) fn seconds(time: Duration) -> String {
    if time < Duration::s(-0.05) {
        format!("-{}", vcutc_driver::summary::time(Duration::ZERO - time))
    } else {
        vcutc_driver::summary::time(time.max(Duration::ZERO))
    }
}
