//! The surface in space as people meet it: drawn, turned, and coloured by the map that they choose.

use super::browser::{Browser, Tab};
use super::page::{assert_is_calm, report};
use serde_json::{Value, json};

/// Draws, and counts the picture's colours apart from the ground that shines through: of each its red, green and blue, and how many
/// pixels have it, the most frequent one first.
const COLOURS: &str = "(() => { const canvas = document.getElementById('vcut-space-canvas'); const gl = canvas.getContext('webgl2'); \
     vcutSpace.draw(); const pixels = new Uint8Array(4 * canvas.width * canvas.height); \
     gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels); const counts = new Map(); \
     for (let i = 0; i < pixels.length; i += 4) { if (pixels[i + 3] < 255) continue; \
     const colour = [...pixels.subarray(i, i + 3)].join(); counts.set(colour, (counts.get(colour) ?? 0) + 1); } \
     return [...counts].sort((a, b) => b[1] - a[1]).map(([colour, count]) => [...colour.split(',').map(Number), count]); })()";

fn choose(tab: &Tab<'_>, map: usize) {
    tab.value(&format!(
        "(() => {{ const select = document.getElementById('vcut-space-map'); select.selectedIndex = {map}; \
         select.dispatchEvent(new Event('change')); }})()"
    ));
}

fn numbers(value: &Value) -> Vec<f64> {
    let numbers = value.as_array().unwrap().iter();
    numbers.map(|number| number.as_f64().unwrap()).collect()
}

/// How many pixels have a colour of a class, darkened by the light or not: its parts in the same proportion.
fn pixels_of(drawn: &Value, [red, green, blue]: [f64; 3]) -> f64 {
    let is_alike = |pixel: &Vec<f64>| {
        let light = (pixel[0] + pixel[1] + pixel[2]) / (red + green + blue);
        let off = |(shown, part): (&f64, f64)| (shown - part * light).abs();
        pixel.iter().zip([red, green, blue]).map(off).all(|off| off < 2.5)
    };
    let pixels = drawn.as_array().unwrap().iter().map(numbers);
    pixels.filter(is_alike).map(|pixel| pixel[3]).sum()
}

fn text(tab: &Tab<'_>, id: &str) -> String {
    let text = tab.value(&format!("document.getElementById('vcut-space-{id}').textContent"));
    text.as_str().unwrap().to_owned()
}

/// The place of the surface, in mm, at a share of the picture's width and height.
fn pointed(tab: &Tab<'_>, [x, y]: [f64; 2]) -> Vec<f64> {
    numbers(&tab.value(&format!(
        "(() => {{ const canvas = document.getElementById('vcut-space-canvas'); \
         return vcutSpace.pointed({x} * canvas.clientWidth, {y} * canvas.clientHeight); }})()"
    )))
}

#[test]
fn another_map_gives_other_colours_and_another_legend() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("finished_dome", &[]);
    let tab = browser.open(&file, 1280, 900);
    assert!(tab.holds("!document.getElementById('vcut-space').hidden"));
    let names = "[...document.getElementById('vcut-space-map').options].map((option) => option.text)";
    assert_eq!(tab.value(names).as_array().unwrap().len(), 6);
    tab.middle("#vcut-space-canvas");
    // Yellow is the highest class; the dome has it at its top, what roughing leaves nearly nowhere.
    let yellow = [253.0, 231.0, 37.0];
    let height = tab.value(COLOURS);
    let area = tab.number("document.getElementById('vcut-space-canvas').width * document.getElementById('vcut-space-canvas').height");
    assert!(pixels_of(&height, yellow) > 0.05 * area, "{height}");
    assert!(text(&tab, "legend").starts_with("39 to 40 mm38 to 39 mm"));

    choose(&tab, 3);
    let left = tab.value(COLOURS);
    assert!(pixels_of(&left, yellow) < 0.5 * pixels_of(&height, yellow));
    assert!(!text(&tab, "legend").contains("39 to 40 mm"));
    assert!(text(&tab, "limit").contains("scallop limit, 3 mm"));
    choose(&tab, 5);
    assert_ne!(tab.value(COLOURS), left);
    assert!(text(&tab, "legend").contains(" deg"));
    choose(&tab, 0);
    assert_eq!(tab.value(COLOURS), height);
    assert_is_calm(&tab);
}

/// Curvature has a legend in steps, and classes have one of words; the place under the pointer has the word of its class.
#[test]
fn the_part_is_coloured_by_its_class() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("finished_dome", &[]);
    let tab = browser.open(&file, 1280, 900);
    let middle = tab.middle("#vcut-space-canvas");
    choose(&tab, 1);
    assert!(text(&tab, "legend").contains(" 1/m"));
    assert!(text(&tab, "limit").starts_with("curvature of the disc, "));
    assert!(text(&tab, "figures").contains("nowhere hollow"));

    choose(&tab, 2);
    assert_eq!(text(&tab, "legend"), "bowltroughsaddleflatridgedome");
    assert_eq!(text(&tab, "figures"), "The class of the part: dome everywhere.");
    let drawn = tab.value(COLOURS);
    assert!(pixels_of(&drawn, [213.0, 94.0, 0.0]) > 10_000.0, "{drawn}");
    tab.mouse("mouseMoved", middle, &json!({}));
    tab.wait_until(
        "document.getElementById('vcut-space-here').textContent.endsWith('class of the part dome')",
    );
    assert_is_calm(&tab);
}

/// x is to the right, y leads into the picture, z up; the value under the pointer is the part's.
#[test]
fn the_part_stands_upright_and_says_how_high_it_is() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("finished_dome", &[]);
    let tab = browser.open(&file, 1280, 900);
    let middle = tab.middle("#vcut-space-canvas");
    tab.value("document.querySelector('[data-look=top]').click()");
    let top = pointed(&tab, [0.5, 0.5]);
    for (shown, wanted) in top.iter().zip([70.0, 80.0, 40.0]) {
        assert!((shown - wanted).abs() < 1.0, "{top:?}");
    }
    let (right, up) = (pointed(&tab, [0.55, 0.5]), pointed(&tab, [0.5, 0.4]));
    assert!(
        right[0] > top[0] + 5.0 && (right[1] - top[1]).abs() < 1.0,
        "{right:?}"
    );
    assert!(up[1] > top[1] + 5.0 && (up[0] - top[0]).abs() < 1.0, "{up:?}");
    tab.mouse("mouseMoved", middle, &json!({}));
    tab.wait_until(
        "document.getElementById('vcut-space-here').textContent.includes('height of the part 40.00 mm')",
    );

    tab.value("document.querySelector('[data-look=iso]').click()");
    let (near, far) = (pointed(&tab, [0.5, 0.6]), pointed(&tab, [0.5, 0.45]));
    assert!(far[1] > near[1] + 5.0, "{near:?} {far:?}");
    // Beside the part there is none.
    assert!(tab.holds("vcutSpace.pointed(2, 2) === null"));
    assert_is_calm(&tab);
}

#[test]
fn the_part_is_turned_and_zoomed_by_mouse_and_keys() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("finished_dome", &[]);
    let tab = browser.open(&file, 1280, 900);
    let looks = || numbers(&tab.value("vcutSpace.looks()"));
    let middle = tab.middle("#vcut-space-canvas");
    let start = looks();
    for (kind, x) in [
        ("mousePressed", 0.0),
        ("mouseMoved", 60.0),
        ("mouseReleased", 60.0),
    ] {
        let more = json!({ "button": "left", "buttons": 1, "clickCount": 1 });
        tab.mouse(kind, [middle[0] + x, middle[1]], &more);
    }
    let turned = looks();
    assert!(turned[0] < start[0] - 0.1, "{start:?} {turned:?}");
    tab.key("ArrowUp");
    assert!(looks()[1] > turned[1]);
    tab.key("+");
    let near = looks()[2];
    assert!(near < turned[2]);
    tab.value("new Promise((done) => setTimeout(done, 400))");
    tab.mouse("mouseWheel", middle, &json!({ "deltaX": 0, "deltaY": 120 }));
    tab.wait_until(&format!("vcutSpace.looks()[2] > {near} * 1.1"));
    tab.key("4");
    assert_eq!(looks(), start);
    assert_is_calm(&tab);
}

/// The page of the dome, with the first rows of corners and all cells of the first map without a value: as 16 bits that are all set.
fn with_holes(page: &str) -> String {
    let (before, rest) = page.split_once("id=\"vcut-space-data\">").unwrap();
    let (data, after) = rest.split_once("</script>").unwrap();
    let mut data: Value = serde_json::from_str(data).unwrap();
    let heights = data["heights"]["values"].as_str().unwrap();
    data["heights"]["values"] = json!("/".repeat(4000) + &heights[4000..]);
    let values = data["maps"][0]["values"].as_str().unwrap();
    data["maps"][0]["values"] = json!("/".repeat(values.len()));
    format!("{before}id=\"vcut-space-data\">{data}</script>{after}")
}

#[test]
fn what_has_no_value_is_grey() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("finished_dome", &[]);
    let page = std::fs::read_to_string(&file).unwrap();
    std::fs::write(&file, with_holes(&page)).unwrap();
    let tab = browser.open(&file, 1280, 900);
    assert!(text(&tab, "legend").ends_with("34 to 35 mmno value"));
    tab.value("document.querySelector('[data-look=top]').click()");
    let (grey, yellow) = ([163.0, 167.0, 173.0], [253.0, 231.0, 37.0]);
    let drawn = tab.value(COLOURS);
    assert_eq!(pixels_of(&drawn, yellow), 0.0);
    assert!(pixels_of(&drawn, grey) > 10_000.0, "{drawn}");
    // Another map has values where the first has none.
    choose(&tab, 3);
    let drawn_with = tab.value(COLOURS);
    assert!(pixels_of(&drawn_with, grey) < 0.5 * pixels_of(&drawn, grey));
    // In front, up to row 14, there are no heights, so there is nothing to point at.
    let least = tab.number(
        "(() => { const canvas = document.getElementById('vcut-space-canvas'); \
         const places = Array.from({ length: 200 }, (_, i) => vcutSpace.pointed(canvas.clientWidth / 2, canvas.clientHeight * i / 200)); \
         return Math.min(...places.filter((place) => place !== null).map(([, y]) => y)); })()",
    );
    assert!((18.6..22.0).contains(&least), "{least}");
    assert!(text(&tab, "legend").contains(" mm"));
    assert_is_calm(&tab);
}

#[test]
fn a_telephone_shows_the_part_and_its_legend() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("finished_dome", &[]);
    let tab = browser.open(&file, 360, 740);
    assert!(tab.number("document.documentElement.scrollWidth") <= tab.number("innerWidth"));
    let width = tab.number("document.getElementById('vcut-space-canvas').clientWidth");
    assert!(width > 300.0, "{width}");
    // Turned aside, it is drawn at its new width.
    tab.resize(740, 360);
    tab.wait_until(
        "(() => { const canvas = document.getElementById('vcut-space-canvas'); \
         return canvas.clientWidth > 400 && canvas.width === canvas.clientWidth; })()",
    );
    assert_is_calm(&tab);
}
