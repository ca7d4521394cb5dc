//! Time against the scallop of an operation without formulas: the job compiled with other limits in its text.

use super::against;
use super::table::{seconds, table};
use super::values::Subject;
use vcutc_backend_api::units::{Duration, Length};
use vcutc_diagnostics::number::show;
use vcutc_geometry::grid;
use vcutc_job::Sourced;

/// The times of a job under other limits on the scallop of an operation.
#[derive(Clone, Debug, PartialEq)]
pub struct ScallopTradeOff {
    /// The job's own limit, and its time.
    pub now: (Length, Duration),
    /// Other limits, by growing limit, and the time of the job; none where it does not compile.
    pub points: Vec<(Length, Option<Duration>)>,
}

impl ScallopTradeOff {
    pub(super) fn of(limit: Sourced<Length>, points: u32, subject: Subject<'_>) -> Option<Self> {
        let (own, span) = (limit.value, limit.span?);
        let others = against::about(own.to_mm(), points).map(|other| Length::mm(grid::nearest(other)));
        let mut others: Vec<Length> = others
            .filter(|other| *other > Length::ZERO && *other != own)
            .collect();
        others.dedup();
        others.truncate(subject.room());
        let time = |limit: Length| subject.time_with(span, &format!("{} mm", show(limit.to_mm())));
        Some(Self {
            now: (own, subject.time()),
            points: others.into_iter().map(|limit| (limit, time(limit))).collect(),
        })
    }

    /// Limits and times, of which none is both faster and within a tighter limit than another: in mm and s.
    #[must_use]
    pub fn front(&self) -> Vec<[f64; 2]> {
        let mut front: Vec<[f64; 2]> = Vec::new();
        for (limit, time) in self.by_limit() {
            let Some(time) = time else { continue };
            if front.last().is_none_or(|last| time.to_s() < last[1]) {
                front.push([limit.to_mm(), time.to_s()]);
            }
        }
        front
    }

    /// All limits with their times, the job's own among them, by growing limit.
    pub(super) fn by_limit(&self) -> Vec<(Length, Option<Duration>)> {
        let (own, now) = self.now;
        let mut all = self.points.clone();
        all.push((own, Some(now)));
        all.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        all
    }

    /// For people.
    pub(super) fn text(&self) -> String {
        let row = |(limit, time): (Length, Option<Duration>)| {
            let mark = if limit == self.now.0 { "*" } else { "" };
            let time = time.map_or_else(|| "does not compile".to_owned(), seconds);
            vec![mark.to_owned(), format!("{} mm", show(limit.to_mm())), time]
        };
        let rows: Vec<Vec<String>> = self.by_limit().into_iter().map(row).collect();
        format!(
            "\n  Other limits on scallop, and the time of the job with each:\n\n{}",
            table(&["", "limit", "time"], &rows)
        )
    }
}
