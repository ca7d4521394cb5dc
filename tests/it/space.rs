//! The surface in space, read back from the page: heights are those of the job's formula, and each cell has the colour that it has in the
//! map from above.

use crate::pictures::BENT_HILL;
use crate::pipeline::compile;
use crate::playback::{list, numbers};
use crate::shop::folder;
use serde_json::Value;
use vcutc::driver::Outcome;
use vcutc::picture::Prefix;
use vcutc::report::page::{Further, page};
use vcutc::report::{Material, pictures};

/// The number of a place without a value.
const NONE: u16 = 65_535;

fn outcome(example: &str) -> Outcome {
    let files = folder().with("bent_hill.vcut", BENT_HILL);
    compile(&format!("{example}.vcut"), &files)
}

fn shown(example: &str) -> (Outcome, String) {
    let outcome = outcome(example);
    let page = page(&outcome, Further::NOTHING).unwrap();
    (outcome, page)
}

/// The figure with its style, data and script.
fn figure(page: &str) -> &str {
    let (before, _) = page.split_once("<figure class=\"vcut-space\"").unwrap();
    let start = before.rfind("<style>").unwrap();
    let length = page[start..].find("</figure>").unwrap();
    let script = page[start + length..].find("</script>").unwrap();
    &page[start..start + length + script]
}

fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("id=\"vcut-space-data\">").unwrap();
    let (text, _) = rest.split_once("</script>").unwrap();
    serde_json::from_str(text).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Columns and rows of cells, and how large a cell is.
fn laid_out(data: &Value) -> ([usize; 2], [f64; 2]) {
    let (size, cells) = (list(&data["size"]), list(&data["cells"]));
    let counts = [0, 1].map(|axis| cells[axis] as usize);
    (counts, [0, 1].map(|axis| size[axis] / cells[axis]))
}

/// The dome of the example.
fn dome([x, y]: [f64; 2]) -> f64 {
    40.0 - (x - 70.0).powi(2) / 900.0 - (y - 80.0).powi(2) / 20_000.0
}

#[test]
fn heights_are_those_of_the_formula() {
    let (_, page) = shown("finished_dome");
    let data = data(&page);
    assert_eq!(list(&data["size"]), [140.0, 160.0, 50.0]);
    let ([columns, rows], [wide, deep]) = laid_out(&data);
    let heights = &data["heights"];
    let (low, step) = (number(&heights["low"]), number(&heights["step"]));
    let heights = numbers(&heights["values"], u16::from_le_bytes);
    assert_eq!(heights.len(), (columns + 1) * (rows + 1));
    for (corner, &height) in heights.iter().enumerate() {
        let at = [
            (corner % (columns + 1)) as f64 * wide,
            (corner / (columns + 1)) as f64 * deep,
        ];
        let height = low + step * f64::from(height);
        // Triangles stand for the formula, within the accuracy of the surface.
        assert!(
            (height - dome(at)).abs() < 0.011,
            "{at:?}: {height}, not {}",
            dome(at)
        );
    }
}

#[test]
fn a_cell_has_the_highest_place_in_it() {
    let (_, page) = shown("finished_dome");
    let data = data(&page);
    let ([columns, _], [wide, deep]) = laid_out(&data);
    let map = &data["maps"][0];
    let (from, step, parts) = (number(&map["from"]), number(&map["step"]), number(&data["parts"]));
    let values = numbers(&map["values"], u16::from_le_bytes);
    for (cell, &value) in values.iter().enumerate() {
        let [x, y] = [(cell % columns) as f64 * wide, (cell / columns) as f64 * deep];
        // A dome is highest where a cell is nearest to its top.
        let highest = dome([70.0_f64.clamp(x, x + wide), 80.0_f64.clamp(y, y + deep)]);
        let value = from + step * f64::from(value) / parts;
        assert!((value - highest).abs() < 0.011, "{x} {y}: {value}, not {highest}");
    }
}

/// A rectangle of a picture with its colour: left, top, width, height.
type Tile<'a> = ([f64; 4], &'a str);

/// The tiles of a map, as its SVG has them, and the rectangle of its plot.
fn tiles<'a>(document: &'a roxmltree::Document<'_>) -> (Vec<Tile<'a>>, [f64; 4]) {
    let nodes = || document.descendants();
    let plot = nodes().find(|node| node.has_tag_name("rect") && node.attribute("fill") == Some("#ffffff"));
    let plot =
        ["x", "y", "width", "height"].map(|name| plot.unwrap().attribute(name).unwrap().parse().unwrap());
    let of_class = |node: &roxmltree::Node<'_, '_>| {
        node.has_tag_name("path") && node.attribute("shape-rendering") == Some("crispEdges")
    };
    let mut tiles = Vec::new();
    for node in document.descendants().filter(of_class) {
        for tile in node
            .attribute("d")
            .unwrap()
            .split('z')
            .filter(|text| !text.is_empty())
        {
            let numbers = tile.split(['M', ' ', 'h', 'v']).filter(|text| !text.is_empty());
            let numbers: Vec<f64> = numbers.map(|text| text.parse().unwrap()).collect();
            tiles.push((
                [numbers[0], numbers[1], numbers[2], numbers[3]],
                node.attribute("fill").unwrap(),
            ));
        }
    }
    (tiles, plot)
}

/// Where the SVG of a map has a tile, the cell of the page has its colour; where it has none, the cell has no value. Legends agree.
fn assert_is_alike(data: &Value, map: &Value, svg: &str) {
    let document = roxmltree::Document::parse(svg).unwrap();
    let (tiles, [left, top, width, height]) = tiles(&document);
    let ([columns, rows], _) = laid_out(data);
    let classes: Vec<&str> = map["classes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|class| class[0].as_str().unwrap())
        .collect();
    for class in map["classes"].as_array().unwrap() {
        let words = format!(">{}</text>", class[1].as_str().unwrap());
        assert!(svg.contains(&words), "{words}");
    }
    let parts = data["parts"].as_u64().unwrap() as usize;
    let numbers = numbers(&map["values"], u16::from_le_bytes);
    assert_eq!(numbers.len(), columns * rows);
    for (cell, &number) in numbers.iter().enumerate() {
        let [x, y] = [cell % columns, cell / columns].map(|place| place as f64 + 0.5);
        let x = left + width * x / columns as f64;
        let y = top + height * (1.0 - y / rows as f64);
        let is_over = |([from, above, wide, deep], _): &&Tile<'_>| {
            *from < x && x < from + wide && *above < y && y < above + deep
        };
        let drawn = tiles.iter().find(is_over).map(|(_, colour)| *colour);
        let shown = (number != NONE).then(|| classes[usize::from(number) / parts]);
        assert_eq!(shown, drawn, "{}, cell {cell}", map["what"]);
    }
}

#[test]
fn cells_have_the_colours_of_the_maps_from_above() {
    for (example, wanted) in [("finished_dome", 6), ("bent_hill", 4), ("wing", 4)] {
        let (outcome, page) = shown(example);
        let material = Material::of(&outcome).unwrap();
        let data = data(&page);
        let maps = data["maps"].as_array().unwrap();
        let drawn = [
            pictures::surface(&material, Prefix::NONE),
            pictures::curvature(&material, Prefix::NONE),
            pictures::class(&material, Prefix::NONE),
            pictures::residual(&material, Prefix::NONE),
            pictures::finished(&material, Prefix::NONE),
            pictures::tilt(&material, Prefix::NONE),
        ];
        let drawn: Vec<String> = drawn.into_iter().flatten().collect();
        assert_eq!((maps.len(), drawn.len()), (wanted, wanted), "{example}");
        for (map, svg) in maps.iter().zip(&drawn) {
            assert_is_alike(&data, map, svg);
        }
    }
}

#[test]
fn the_figure_is_hidden_without_scripts_and_small() {
    for example in ["finished_dome", "saddle"] {
        let (_, page) = shown(example);
        assert!(page.contains("id=\"vcut-space\" hidden>"), "{example}");
        let length = figure(&page).len();
        assert!((50_000..320_000).contains(&length), "{example}: {length}");
    }
}

#[test]
fn a_profile_has_no_surface_in_space() {
    let (_, page) = shown("fairing");
    assert!(!page.contains("id=\"vcut-space\"") && !page.contains("vcut-space-data"));
}

#[test]
fn the_same_job_has_the_same_figure() {
    let [(_, first), (_, second)] = [shown("finished_dome"), shown("finished_dome")];
    assert_eq!(figure(&first), figure(&second));
}
