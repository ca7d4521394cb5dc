//! A heat map of places for the base: the plane of x and y from above, each cell in the colour of its margin.
//!
//! Colours are of the scale viridis, which grows in lightness all along: the order can be read without seeing colours. Cells
//! out of reach are hatched, not coloured.

use super::Prefix;
use super::marks::{cross, ring};
use super::svg::{Anchor, Svg, number};

/// What a heat map shows.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap<'a> {
    /// What it is about, in a line.
    pub title: &'a str,
    /// What holds for the whole map, such as the height.
    pub subtitle: &'a str,
    /// x of the middles of the cells, in mm, growing.
    pub xs: &'a [i32],
    /// y of the middles of the cells, in mm, growing.
    pub ys: &'a [i32],
    /// Margins from 0 to 1, row by row from the least y, each from the least x; none where something is out of reach.
    pub margins: &'a [Option<f64>],
    /// Where the base is now: x and y in mm.
    pub now: [f64; 2],
    /// Where it is best, when anywhere.
    pub best: Option<[f64; 2]>,
}

/// Viridis [Smith, van der Walt 2015], nine colours of it.
const COLOURS: [&str; 9] = [
    "#440154", "#472d7b", "#3b528b", "#2c728e", "#21918c", "#28ae80", "#5ec962", "#addc30", "#fde725",
];
const HATCHED: &str = "fill=\"url(#hatch)\"";
/// Widths of a class of margins, in percent.
const CLASSES: [u32; 5] = [1, 2, 5, 10, 20];
/// The plot's upper left corner.
const CORNER: (f64, f64) = (86.0, 74.0);
/// The plot's longest side.
const LONGEST: f64 = 480.0;
/// The plot's shortest side: a long and narrow map is not drawn to scale.
const SHORTEST: f64 = 160.0;
/// Room for the legend, beside the plot.
const LEGEND: f64 = 190.0;
/// Size of letters.
const FONT: u32 = 13;
/// Distance of lines in the legend.
const LINE: f64 = 22.0;

/// Writes the map as SVG.
#[must_use]
pub fn draw(map: &HeatMap<'_>) -> String {
    let plot = Plot::of(map.xs, map.ys);
    let scale = Scale::of(map.margins);
    let legend_lines = scale.classes + 4;
    let height = plot.height.max(f64::from(legend_lines) * LINE) + CORNER.1 + 60.0;
    let mut svg = Svg::new(
        [CORNER.0 + plot.width + LEGEND, height],
        FONT,
        Prefix::NONE,
        map.title,
        &description(map, scale),
    );
    svg.define_hatch();
    svg.text(
        (24.0, 32.0),
        Anchor::Start,
        "font-size=\"17\" font-weight=\"bold\"",
        map.title,
    );
    svg.text((24.0, 53.0), Anchor::Start, "", map.subtitle);
    cells(&mut svg, map, &plot, scale);
    ticks(&mut svg, &plot);
    marks(&mut svg, map, &plot);
    legend(&mut svg, map, &plot, scale);
    svg.finish()
}

fn description(map: &HeatMap<'_>, scale: Scale) -> String {
    let reached = map.margins.iter().flatten().count();
    let whole = map.margins.len();
    let best = map.best.map_or(String::new(), |[x, y]| {
        format!(" The best place is at x {} mm, y {} mm.", number(x), number(y))
    });
    format!(
        "{}: {reached} of {whole} places reach everything, with margins up to {} percent.{best}",
        map.subtitle,
        scale.classes * scale.class
    )
}

/// How mm in the root become places in the picture: x to the right, y upwards.
struct Plot {
    x: Side,
    y: Side,
    width: f64,
    height: f64,
}

/// One direction of the map: its cells' edges, in mm.
struct Side {
    edges: Vec<f64>,
}

impl Side {
    /// Half-way between the middles; the outer cells are as wide on either side.
    fn of(middles: &[i32]) -> Self {
        let middles: Vec<f64> = middles.iter().copied().map(f64::from).collect();
        let mut edges: Vec<f64> = middles
            .windows(2)
            .map(|pair| pair.iter().sum::<f64>() / 2.0)
            .collect();
        let (first, last) = (
            middles.first().copied().unwrap_or_default(),
            middles.last().copied().unwrap_or_default(),
        );
        let start = edges.first().map_or(first - 50.0, |&edge| 2.0 * first - edge);
        let end = edges.last().map_or(last + 50.0, |&edge| 2.0 * last - edge);
        edges.insert(0, start);
        edges.push(end);
        Self { edges }
    }

    fn start(&self) -> f64 {
        self.edges.first().copied().unwrap_or_default()
    }

    fn width(&self) -> f64 {
        (self.edges.last().copied().unwrap_or_default() - self.start()).max(1.0)
    }

    /// From 0 at the start to 1 at the end.
    fn share(&self, mm: f64) -> f64 {
        (mm - self.start()) / self.width()
    }

    /// The edges of a cell, as shares.
    fn cell(&self, index: usize) -> Option<(f64, f64)> {
        Some((
            self.share(*self.edges.get(index)?),
            self.share(*self.edges.get(index + 1)?),
        ))
    }

    /// Round values within, at most about six.
    fn ticks(&self) -> impl Iterator<Item = f64> {
        let steps = [
            1, 2, 5, 10, 20, 50, 100, 200, 250, 500, 1000, 2000, 5000, 10_000, 100_000,
        ];
        let step = steps
            .into_iter()
            .map(f64::from)
            .find(|step| self.width() / step <= 6.0)
            .unwrap_or(1e6);
        let (start, end) = (self.start(), self.start() + self.width());
        let first = (start / step).ceil();
        (0..8)
            .map(move |tick| (first + f64::from(tick)) * step)
            .take_while(move |&tick| tick <= end)
    }
}

impl Plot {
    fn of(xs: &[i32], ys: &[i32]) -> Self {
        let (x, y) = (Side::of(xs), Side::of(ys));
        let scale = LONGEST / x.width().max(y.width());
        Self {
            width: (x.width() * scale).max(SHORTEST),
            height: (y.width() * scale).max(SHORTEST),
            x,
            y,
        }
    }

    fn at(&self, [x, y]: [f64; 2]) -> (f64, f64) {
        (
            CORNER.0 + self.width * self.x.share(x),
            CORNER.1 + self.height * (1.0 - self.y.share(y)),
        )
    }

    fn shows(&self, [x, y]: [f64; 2]) -> bool {
        let within = |share: f64| (0.0..=1.0).contains(&share);
        within(self.x.share(x)) && within(self.y.share(y))
    }
}

/// Margins in classes of so many percent.
#[derive(Clone, Copy)]
struct Scale {
    class: u32,
    classes: u32,
}

impl Scale {
    fn of(margins: &[Option<f64>]) -> Self {
        let largest = margins.iter().flatten().copied().fold(0.0, f64::max).min(1.0);
        let percent = ((largest * 100.0).ceil() as u32).max(1);
        let class = CLASSES
            .into_iter()
            .find(|&class| percent.div_ceil(class) <= COLOURS.len() as u32)
            .unwrap_or(20);
        Self {
            class,
            classes: percent.div_ceil(class),
        }
    }

    fn class(self, margin: f64) -> u32 {
        ((margin * 100.0 / f64::from(self.class)) as u32).min(self.classes - 1)
    }

    /// Spread over the whole scale of colours, so that few classes differ well.
    fn paint(self, class: u32) -> String {
        let last = COLOURS.len() as u32 - 1;
        let index = (class * last).checked_div(self.classes - 1).unwrap_or(last);
        let colour = COLOURS.get(index as usize).copied().unwrap_or("#fde725");
        format!("fill=\"{colour}\"")
    }

    fn words(self, class: u32) -> String {
        format!("{} to {} %", class * self.class, (class + 1) * self.class)
    }
}

/// Cells of one class are one element; runs of them in a row are one rectangle.
fn cells(svg: &mut Svg, map: &HeatMap<'_>, plot: &Plot, scale: Scale) {
    let mut hatched = Vec::new();
    let mut coloured: Vec<Vec<[f64; 4]>> = vec![Vec::new(); scale.classes as usize];
    for (row, margins) in map.margins.chunks(map.xs.len().max(1)).enumerate() {
        let Some((bottom, top)) = plot.y.cell(row) else {
            continue;
        };
        let mut column = 0;
        for run in margins.chunk_by(|a, b| a.map(|m| scale.class(m)) == b.map(|m| scale.class(m))) {
            let edges = (plot.x.cell(column), plot.x.cell(column + run.len() - 1));
            column += run.len();
            let (Some((left, _)), Some((_, right))) = edges else {
                continue;
            };
            let rect = [
                CORNER.0 + plot.width * left,
                CORNER.1 + plot.height * (1.0 - top),
                plot.width * (right - left),
                plot.height * (top - bottom),
            ];
            let class = run.first().copied().flatten().map(|margin| scale.class(margin));
            match class.and_then(|class| coloured.get_mut(class as usize)) {
                Some(rects) => rects.push(rect),
                None => hatched.push(rect),
            }
        }
    }
    // Without smoothing, so that no seams show between cells.
    let paint = |fill: &str| format!("{fill} shape-rendering=\"crispEdges\"");
    if !hatched.is_empty() {
        svg.rects(&hatched, &paint(HATCHED));
    }
    for (class, rects) in (0..).zip(&coloured).filter(|(_, rects)| !rects.is_empty()) {
        svg.rects(rects, &paint(&scale.paint(class)));
    }
}

fn ticks(svg: &mut Svg, plot: &Plot) {
    let (left, top) = CORNER;
    let bottom = top + plot.height;
    let mut marks = String::new();
    for x in plot.x.ticks() {
        let at = left + plot.width * plot.x.share(x);
        marks += &format!("M{} {}v6", number(at), number(bottom));
        svg.text((at, bottom + 21.0), Anchor::Middle, "", &number(x));
    }
    for y in plot.y.ticks() {
        let at = top + plot.height * (1.0 - plot.y.share(y));
        marks += &format!("M{} {}h-6", number(left), number(at));
        svg.text((left - 10.0, at + 4.5), Anchor::End, "", &number(y));
    }
    svg.path(&marks, "stroke=\"#2b2a27\" fill=\"none\"");
    svg.rect(
        [left, top, plot.width, plot.height],
        "fill=\"none\" stroke=\"#2b2a27\"",
    );
    svg.text(
        (left + plot.width / 2.0, bottom + 43.0),
        Anchor::Middle,
        "",
        "x of the base in the machine's root, mm",
    );
    let middle = top + plot.height / 2.0;
    svg.text(
        (26.0, middle),
        Anchor::Middle,
        &format!("transform=\"rotate(-90 26 {})\"", number(middle)),
        "y, mm",
    );
}

/// A ring for now and a cross for the best place, light on dark on light: they stand out on every colour.
fn marks(svg: &mut Svg, map: &HeatMap<'_>, plot: &Plot) {
    if plot.shows(map.now) {
        ring(svg, plot.at(map.now));
    }
    if let Some(best) = map.best.filter(|&best| plot.shows(best)) {
        cross(svg, plot.at(best));
    }
}

fn legend(svg: &mut Svg, map: &HeatMap<'_>, plot: &Plot, scale: Scale) {
    let left = CORNER.0 + plot.width + 26.0;
    let mut y = CORNER.1 + 10.0;
    svg.text(
        (left, y),
        Anchor::Start,
        "font-weight=\"bold\"",
        "smallest margin",
    );
    y += LINE;
    let mut swatch = |svg: &mut Svg, paint: &str, words: &str| {
        svg.rect([left, y - 12.0, 22.0, 15.0], paint);
        svg.text((left + 32.0, y), Anchor::Start, "", words);
        y += LINE;
    };
    for class in (0..scale.classes).rev() {
        swatch(svg, &scale.paint(class), &scale.words(class));
    }
    swatch(svg, HATCHED, "out of reach");
    let words = if plot.shows(map.now) {
        "base now"
    } else {
        "base now: outside"
    };
    ring(svg, (left + 11.0, y - 4.5));
    svg.text((left + 32.0, y), Anchor::Start, "", words);
    if map.best.is_some() {
        y += LINE;
        cross(svg, (left + 11.0, y - 4.5));
        svg.text((left + 32.0, y), Anchor::Start, "", "best place");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(xs: &[i32], ys: &[i32]) -> Vec<Option<f64>> {
        let cells = ys.iter().flat_map(|&y| xs.iter().map(move |&x| (x, y)));
        cells
            .map(|(x, y)| Some(f64::from(x - 1000) / 4000.0 + f64::from(y) / 8000.0).filter(|m| *m > 0.05))
            .collect()
    }

    #[test]
    fn a_map_looks_as_it_was_reviewed() {
        let xs: Vec<i32> = (0..11).map(|i| 1000 + 100 * i).collect();
        let ys: Vec<i32> = (0..7).map(|i| -300 + 100 * i).collect();
        let margins = ramp(&xs, &ys);
        let svg = draw(&HeatMap {
            title: "Places for the base of <rib>",
            subtitle: "z 650 mm, turned by 15 deg",
            xs: &xs,
            ys: &ys,
            margins: &margins,
            now: [1100.5, -200.0],
            best: Some([1900.0, 250.0]),
        });
        insta::assert_snapshot!(svg);
    }

    #[test]
    fn any_map_is_drawn_within_its_picture() {
        let one = [Some(0.3)];
        for (xs, ys, margins) in [
            (&[5][..], &[7][..], &one[..]),
            (&[], &[], &[]),
            (&[i32::MIN, i32::MAX], &[0], &[None, Some(f64::MAX)]),
        ] {
            let svg = draw(&HeatMap {
                title: "",
                subtitle: "",
                xs,
                ys,
                margins,
                now: [1e9, f64::MIN],
                best: None,
            });
            assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            assert!(svg.ends_with("</svg>\n"));
        }
    }

    #[test]
    fn a_margin_falls_into_the_class_that_names_it() {
        let scale = Scale::of(&[Some(0.231), None, Some(0.1)]);
        assert_eq!((scale.class, scale.classes), (5, 5));
        assert_eq!(scale.words(scale.class(0.1)), "10 to 15 %");
        assert_eq!(scale.words(scale.class(0.0)), "0 to 5 %");
        assert_eq!(scale.words(scale.class(0.231)), "20 to 25 %");
    }
}
