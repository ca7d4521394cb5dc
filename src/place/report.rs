//! The result of placing, for people and for programs.

use crate::room::percent;
use crate::search::Bounds;
use crate::spot::Spot;
use crate::{Best, Deviation, Objective, Placement, Room, Standing};
use serde::Serialize;
use std::fmt::Write;
use vcutc_backend_api::ir::PlacedFrame;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;
use vcutc_dynamics::deviation::figures::millimetres;
use vcutc_remedy::wording::frame_text;

/// Most places without room that the report lists.
const MOST_REFUSED: usize = 3;

/// A few lines, ending in the frame to paste.
#[must_use]
pub fn text(placement: &Placement) -> String {
    let Placement {
        job,
        machine,
        model,
        bounds,
        now,
        best,
        refused,
        ..
    } = placement;
    let mut text = format!("{job}: the base of {machine} ({model})\n");
    let mut row = |name: &str, words: &str| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:<9} {words}");
    };
    row("searched", &range(bounds));
    row("now", &standing(now));
    if let Ok(room) = &now.room
        && room.deviation.is_some()
        && !room.has_enough()
    {
        row(
            "",
            "with less than the 10 % that a place must have to be chosen for its deviation",
        );
    }
    match best {
        Some(best) if !is_better(best, now) => {
            row(
                "best",
                match placement.map.objective {
                    Objective::Margin => "where it is now: no place within these bounds has a larger margin",
                    Objective::Deviation => {
                        "where it is now: no place within these bounds was found with a smaller deviation"
                    }
                },
            );
        }
        Some(best) => {
            row("best", &room(&best.room));
            row("moved", &moved(best, &now.base));
            if bounds.touch(best.spot) {
                row(
                    "note",
                    "it lies at the edge of what was searched: wider bounds may have better places",
                );
            }
            let _ = write!(text, "\n  base = {}\n", frame_text(&best.base));
        }
        None => {
            row("best", none_found(now, placement.map.objective));
            for reason in refused.iter().take(MOST_REFUSED) {
                row("", reason);
            }
        }
    }
    text
}

fn none_found(now: &Standing, objective: Objective) -> &'static str {
    match (objective, &now.room) {
        (Objective::Deviation, _) => {
            "no place within these bounds carries out the whole program with a margin of at least 10 %"
        }
        (Objective::Margin, Ok(_)) => "no other place within these bounds carries out the whole program",
        (Objective::Margin, Err(_)) => {
            "no place within these bounds carries out the whole program; widen them, or change the job"
        }
    }
}

/// Whether a place leaves more room than there is now.
fn is_better(best: &Best, now: &Standing) -> bool {
    now.room
        .as_ref()
        .map_or(true, |room| best.room.is_better_than(room))
}

fn standing(now: &Standing) -> String {
    match &now.room {
        Ok(left) => room(left),
        Err(reason) => reason.clone(),
    }
}

fn room(room: &Room) -> String {
    let margin = format!("margin {}, least {}", percent(room.margin), room.least);
    match &room.deviation {
        Some(Deviation { most, at, axis }) => format!(
            "deviation {}, most of it by {axis}, {at}; {margin}",
            millimetres(most.to_mm())
        ),
        None => margin,
    }
}

/// `x 1820 mm, y -40 mm, z 700 mm, turned by 12.5 deg`.
#[must_use]
pub fn spot(spot: Spot) -> String {
    let Spot { x, y, z, .. } = spot;
    let turn = show(spot.turn().to_deg());
    format!("x {x} mm, y {y} mm, z {z} mm, turned by {turn} deg")
}

fn moved(best: &Best, now: &PlacedFrame) -> String {
    let (from, to) = (now.frame.origin, best.base.frame.origin);
    let by = |axis: &str, from: f64, to: f64| {
        let way = (to - from).round();
        (way != 0.0).then(|| format!("{axis} {way:+} mm"))
    };
    let turn = best.spot.turn().to_deg();
    let turned = (best.spot.yaw != 0).then(|| format!("turned by {} deg", show(turn)));
    let parts: Vec<String> = [
        by("x", from.x, to.x),
        by("y", from.y, to.y),
        by("z", from.z, to.z),
        turned,
    ]
    .into_iter()
    .flatten()
    .collect();
    let whole = show(from.distance(to).to_mm().round());
    format!("by {whole} mm: {}", parts.join(", "))
}

fn range(bounds: &Bounds) -> String {
    let Bounds { least, most } = bounds;
    let deg = |spot: &Spot| show(spot.turn().to_deg());
    format!(
        "x {}..{} mm, y {}..{} mm, z {}..{} mm, turned by {}..{} deg",
        least.x,
        most.x,
        least.y,
        most.y,
        least.z,
        most.z,
        deg(least),
        deg(most)
    )
}

/// The same for programs.
#[derive(Debug, Serialize)]
pub struct PlacementBody<'a> {
    job: &'a str,
    machine: &'a str,
    model: &'a str,
    now: BaseBody<'a>,
    best: Option<BaseBody<'a>>,
    refused: &'a [String],
    map: MapBody<'a>,
}

#[derive(Debug, Serialize)]
struct BaseBody<'a> {
    base: String,
    /// In mm.
    origin: [f64; 3],
    /// Turn about z against now, in deg.
    turn: f64,
    margin: Option<f64>,
    least: Option<&'a str>,
    /// Of the cuts, in mm; only where places are compared by it.
    #[serde(skip_serializing_if = "Option::is_none")]
    deviation: Option<f64>,
    trouble: Option<&'a str>,
}

#[derive(Debug, Serialize)]
struct MapBody<'a> {
    x: &'a [i32],
    y: &'a [i32],
    z: i32,
    turn: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    margins: Option<Vec<&'a [Option<f64>]>>,
    /// In mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    deviations: Option<Vec<&'a [Option<f64>]>>,
}

/// The result of placing, for programs.
#[must_use]
pub fn body(placement: &Placement) -> PlacementBody<'_> {
    let map = &placement.map;
    let rows = |objective| {
        let rows = map.values.chunks(map.xs.len().max(1));
        (map.objective == objective).then(|| rows.collect())
    };
    PlacementBody {
        job: &placement.job,
        machine: &placement.machine,
        model: &placement.model,
        now: base_body(
            &placement.now.base,
            0.0,
            placement.now.room.as_ref().map_err(String::as_str),
        ),
        best: placement
            .best
            .as_ref()
            .map(|best| base_body(&best.base, best.spot.turn().to_deg(), Ok(&best.room))),
        refused: &placement.refused,
        map: MapBody {
            x: &map.xs,
            y: &map.ys,
            z: map.at.z,
            turn: map.at.turn().to_deg(),
            margins: rows(Objective::Margin),
            deviations: rows(Objective::Deviation),
        },
    }
}

fn base_body<'a>(base: &PlacedFrame, turn: f64, room: Result<&'a Room, &'a str>) -> BaseBody<'a> {
    let origin = base.frame.origin;
    BaseBody {
        base: frame_text(base),
        origin: [origin.x, origin.y, origin.z],
        turn,
        margin: room.ok().map(|room| room.margin),
        least: room.ok().map(|room| room.least.as_str()),
        deviation: room
            .ok()
            .and_then(|room| Some(room.deviation.as_ref()?.most))
            .map(Length::to_mm),
        trouble: room.err(),
    }
}
