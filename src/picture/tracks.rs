//! The tracks of a disc over the plan of the stock, with their directions and the ways between them.

use super::Point;
use super::chart::{Chart, Plot, Series, Shape};
use super::palette::{BLUE, INK};
use super::sheet::Room;
use super::svg::{Along, Mark};
use super::thin::Thinned;
use super::tiles::{self, Tiles};

pub use super::sheet::Heading;

/// What the picture shows; lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracks<'a> {
    /// What it is about.
    pub heading: Heading<'a>,
    /// The stock along x and y.
    pub size: [f64; 2],
    /// Tracks in the order in which they are cut, each from its first place to its last one, along y or against it throughout.
    pub tracks: &'a [Vec<Point>],
    /// Ways from track to track.
    pub links: &'a [Vec<Point>],
}

/// In how many columns all tracks together are looked at: a picture of many tracks stays small.
const COLUMNS: usize = 8000;
/// The fewest of one track.
const FEWEST: usize = 4;
/// Room around all ways, as a share of the longer side.
const AROUND: f64 = 0.03;
/// How far heads of arrows are apart at least, in places of the picture.
const APART: f64 = 14.0;
/// The colour of ways through the air.
const AIR: &str = "#57606a";

/// Writes the picture as SVG.
#[must_use]
pub fn draw(tracks: &Tracks<'_>) -> String {
    let [columns, rows] = extent(tracks);
    let tiles = Tiles {
        columns: &columns,
        rows: &rows,
    };
    let [front, back] = rows;
    let plot = tiles.plot(Room::of(tracks.heading.ids).beside(front).beside(back));
    Chart {
        heading: tracks.heading,
        description: description(tracks),
        series: series(tracks, &plot),
        plot,
        labels: ["x across the tracks, mm", "y along the tracks, mm"],
        along: Some(Along::Width),
    }
    .draw()
}

/// From where to where the picture goes along x and y: over the stock and all ways.
fn extent(tracks: &Tracks<'_>) -> [[f64; 2]; 2] {
    let ways = tracks.tracks.iter().chain(tracks.links).flatten();
    let span = |axis: usize| {
        let start = [0.0, tracks.size[axis]];
        ways.clone().fold(start, |[from, to], place| {
            [from.min(place[axis]), to.max(place[axis])]
        })
    };
    let spans = [span(0), span(1)];
    let around = spans.map(|[from, to]| to - from).into_iter().fold(0.0, f64::max) * AROUND;
    spans.map(|[from, to]| [from - around, to + around])
}

fn series(tracks: &Tracks<'_>, plot: &Plot) -> Vec<Series> {
    let line =
        |colour: &str, width: f64| format!("fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\"");
    let mut series =
        vec![Series::new(Shape::Polygon(tiles::outline(tracks.size)), line(INK, 2.0)).named("stock")];
    if !tracks.links.is_empty() {
        let paint = format!("{} stroke-dasharray=\"5 4\"", line(AIR, 1.0));
        series.push(
            Series::new(Shape::Ways(tracks.links.to_vec()), paint).named("through the air between tracks"),
        );
    }
    let columns = (COLUMNS / tracks.tracks.len().max(1)).max(FEWEST);
    let ways = tracks.tracks.iter().map(|track| thinned(track, columns));
    series.push(Series::new(Shape::Ways(ways.collect()), line(BLUE, 1.5)).named("tracks"));
    let every = every(tracks, plot);
    let ends = tracks.tracks.iter().step_by(every);
    let ends: Vec<[Point; 2]> = ends
        .filter_map(|track| Some([*track.first()?, *track.last()?]))
        .collect();
    let words = match every {
        1 => "where a track ends".to_owned(),
        every => format!("where one track in {every} ends"),
    };
    series.push(Series::new(Shape::Heads(ends), format!("fill=\"{BLUE}\"")).named(words));
    let begins = tracks.tracks.first().and_then(|track| track.first());
    let ends = tracks.tracks.last().and_then(|track| track.last());
    let mark = |mark, at: Option<&Point>, words| Some(Series::mark(mark, *at?, None).named(words));
    series.extend(mark(Mark::RING, begins, "the first track begins"));
    series.extend(mark(Mark::CROSS, ends, "the last track ends"));
    series
}

/// One track in so many has the head of an arrow, so that heads do not cover each other. It is an odd number: tracks that are cut to and
/// fro show both directions.
fn every(tracks: &Tracks<'_>, plot: &Plot) -> usize {
    let wide = tracks.size[0] * plot.x.per_unit();
    let apart = wide / tracks.tracks.len().max(1) as f64;
    // Casting is to the nearest number there is.
    let every = (APART / apart).ceil().max(1.0) as usize;
    every | 1
}

/// A track in so many columns along y, with all of its bends across.
fn thinned(track: &[Point], columns: usize) -> Vec<Point> {
    let (Some(first), Some(last)) = (track.first(), track.last()) else {
        return Vec::new();
    };
    let feed = if last[1] < first[1] { -1.0 } else { 1.0 };
    let along: Vec<Point> = track.iter().map(|[x, y]| [feed * y, *x]).collect();
    let columns = u32::try_from(columns).unwrap_or(u32::MAX);
    let kept = Thinned::of(&along, columns);
    kept.into_iter().map(|[along, x]| [x, feed * along]).collect()
}

/// The picture in words.
fn description(tracks: &Tracks<'_>) -> String {
    let [width, depth] = tracks.size;
    let at = |[x, y]: Point| format!("x {x:.1} mm, y {y:.1} mm");
    let begins = tracks.tracks.first().and_then(|track| track.first());
    let ends = tracks.tracks.last().and_then(|track| track.last());
    let order = match (begins, ends) {
        (Some(begins), Some(ends)) => format!(
            " The first begins at {}; the last ends at {}.",
            at(*begins),
            at(*ends)
        ),
        _ => String::new(),
    };
    format!(
        "The tracks of a disc from above, over a stock {width:.1} mm wide and {depth:.1} mm deep: {}.{order}",
        tracks.heading.subtitle
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prefix;

    fn drawn(size: [f64; 2], tracks: &[Vec<Point>], links: &[Vec<Point>]) -> String {
        draw(&Tracks {
            heading: Heading {
                ids: Prefix::NONE,
                title: "<rib>: tracks of the disc",
                subtitle: "some tracks",
            },
            size,
            tracks,
            links,
        })
    }

    /// So many tracks to and fro over a stock of 100 mm by 60 mm.
    fn to_and_fro(count: u32) -> Vec<Vec<Point>> {
        let track = |number: u32| {
            let x = 100.0 * (f64::from(number) + 0.5) / f64::from(count);
            let way = vec![[x, -30.0], [x + 0.5, 30.0], [x, 90.0]];
            match number % 2 {
                0 => way,
                _ => way.into_iter().rev().collect(),
            }
        };
        (0..count).map(track).collect()
    }

    #[test]
    fn tracks_look_as_they_were_reviewed() {
        let tracks = to_and_fro(5);
        let links: Vec<Vec<Point>> = tracks
            .windows(2)
            .map(|pair| vec![pair[0][2], pair[1][0]])
            .collect();
        insta::assert_snapshot!(drawn([100.0, 60.0], &tracks, &links));
    }

    #[test]
    fn any_tracks_are_drawn_within_their_picture() {
        for tracks in [
            vec![],
            vec![vec![]],
            vec![vec![[1.0, 1.0]]],
            vec![vec![[0.0, 5.0], [0.0, 5.0]]],
            vec![vec![[-1e9, -1e9], [1e9, 1e9]]],
        ] {
            for size in [[0.0, 0.0], [100.0, 60.0]] {
                let svg = drawn(size, &tracks, &[]);
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
                assert!(svg.ends_with("</svg>\n"));
            }
        }
    }

    #[test]
    fn a_thinned_track_keeps_its_ends_and_its_order() {
        for track in to_and_fro(2) {
            assert_eq!(thinned(&track, 100), track);
        }
        let bent: Vec<Point> = (0..=1000)
            .map(|k| {
                let y = f64::from(k) / 10.0;
                [5.0 + libm::sin(y), -y]
            })
            .collect();
        let kept = thinned(&bent, 10);
        assert!(kept.len() <= 44, "{}", kept.len());
        assert_eq!((kept[0], kept[kept.len() - 1]), (bent[0], bent[1000]));
        assert!(kept.windows(2).all(|pair| pair[0][1] > pair[1][1]));
    }

    /// Heads stay apart, and those of tracks to and fro point both ways.
    #[test]
    fn of_many_tracks_some_have_heads() {
        for (count, shown) in [(20, 20), (200, 29)] {
            let svg = drawn([100.0, 60.0], &to_and_fro(count), &[]);
            let heads = svg.lines().filter(|line| line.contains("fill=\"#0072b2\""));
            // The legend has one more.
            let found = heads.map(|line| line.matches('z').count()).max();
            assert_eq!(found, Some(shown), "{count}");
        }
    }

    #[test]
    fn the_largest_picture_stays_small() {
        let track = |number: u32| -> Vec<Point> {
            let way = (0..2000).map(|k| {
                let bend = f64::from((k * 7919 + number) % 100) / 100.0;
                [f64::from(number) + bend, f64::from(k)]
            });
            way.collect()
        };
        let tracks: Vec<Vec<Point>> = (0..2000).map(track).collect();
        let length = drawn([2000.0, 2000.0], &tracks, &[]).len();
        assert!(length < 500_000, "{length}");
    }
}
