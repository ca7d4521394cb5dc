//! The page of `vcutc report` as people meet it.

use super::browser::{Browser, Tab};
use crate::cli::report::{STRIPS, hostile_rib};
use crate::cli::vcutc;
use crate::pipeline::{Files, compile_on};
use crate::rect::both_blades;
use crate::repository::root;
use serde_json::json;
use std::path::PathBuf;
use tempfile::TempDir;
use vcutc::process::verdict;
use vcutc::report::page::Further;

/// The report of an example, in a folder of its own.
pub(super) fn report(example: &str, more: &[&str]) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.html");
    let job = format!("examples/{example}.vcut");
    let arguments = [&["report", "-q", &job, "-o", file.to_str().unwrap()], more].concat();
    let run = vcutc(root(), &arguments);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    (folder, file)
}

pub(super) fn assert_is_calm(tab: &Tab<'_>) {
    let complaints = tab.complaints();
    assert!(complaints.is_empty(), "{complaints:#?}");
}

fn view_box(tab: &Tab<'_>) -> Vec<f64> {
    let text = tab.value("document.querySelector('[data-zoom] svg').getAttribute('viewBox')");
    let numbers = text.as_str().unwrap().split(' ');
    numbers.map(|number| number.parse().unwrap()).collect()
}

#[test]
fn a_page_loads_by_itself_and_shows_what_it_should() {
    let Some(browser) = Browser::start() else { return };
    for (example, more) in [
        ("spoiler_clarky", &[][..]),
        ("spoiler_clarky", &["--machine", "gantry"]),
        ("block_cui", &[]),
    ] {
        let (_folder, file) = report(example, more);
        let tab = browser.open(&file, 1280, 900);
        assert_eq!(
            tab.value("document.title"),
            json!(format!("{example} - vcutc report"))
        );
        for selector in [
            "header h1",
            ".verdict",
            ".key dd",
            "#cross-section svg",
            "#deviation svg",
            "#playback canvas",
            "#machine svg",
            "#machine table",
            "#time svg",
            "#time table",
            "#parameters td a",
            "#job li",
        ] {
            assert!(
                tab.holds(&format!("document.querySelector('{selector}') !== null")),
                "{example}: {selector}"
            );
        }
        // Every link leads to a place, no two places have one name.
        assert!(tab.holds(
            "[...document.querySelectorAll('a[href^=\"#\"]')].every((link) => document.getElementById(link.hash.slice(1)))"
        ));
        assert!(tab.holds(
            "(() => { const ids = [...document.querySelectorAll('[id]')].map((one) => one.id); \
             return new Set(ids).size === ids.length; })()"
        ));
        let colours = tab.colours(&tab.picture());
        assert!(colours > 20.0, "{colours} colours");
        assert_is_calm(&tab);
    }
}

#[test]
fn pictures_are_enlarged_by_keys_buttons_and_the_wheel() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("block_cui", &[]);
    let tab = browser.open(&file, 1280, 900);
    let whole = view_box(&tab);

    let middle = tab.middle("[data-zoom] .view");
    tab.mouse("mouseWheel", middle, &json!({ "deltaX": 0, "deltaY": -120 }));
    assert_eq!(
        view_box(&tab),
        whole,
        "the wheel scrolls the page until the picture was clicked"
    );
    let middle = tab.middle("[data-zoom] .view");
    tab.click(middle);
    tab.mouse("mouseWheel", middle, &json!({ "deltaX": 0, "deltaY": -120 }));
    tab.wait_until("document.querySelector('[data-zoom]').classList.contains('enlarged')");
    let enlarged = view_box(&tab);
    assert!(enlarged[2] < whole[2] && enlarged[3] < whole[3], "{enlarged:?}");

    for (kind, x) in [
        ("mousePressed", 0.0),
        ("mouseMoved", 40.0),
        ("mouseReleased", 40.0),
    ] {
        let at = [middle[0] + x, middle[1]];
        tab.mouse(
            kind,
            at,
            &json!({ "button": "left", "buttons": 1, "clickCount": 1 }),
        );
    }
    let moved = view_box(&tab);
    assert!(moved[0] < enlarged[0], "what is seen follows the hand: {moved:?}");
    tab.key("ArrowRight");
    assert!(view_box(&tab)[0] > moved[0]);
    tab.key("0");
    assert_eq!(view_box(&tab), whole);
    tab.key("+");
    assert!(view_box(&tab)[2] < whole[2]);

    tab.click(tab.middle("[data-do=all]"));
    assert_eq!(view_box(&tab), whole);
    tab.click(tab.middle("[data-do=in]"));
    assert!(view_box(&tab)[2] < whole[2]);
    tab.click(tab.middle("[data-do=out]"));
    assert_eq!(view_box(&tab)[2], whole[2]);
    assert_is_calm(&tab);
}

#[test]
fn a_telephone_does_not_scroll_sideways() {
    let Some(browser) = Browser::start() else { return };
    for example in ["spoiler_clarky", "block_cui", "wavy_panel"] {
        let (_folder, file) = report(example, &[]);
        let tab = browser.open(&file, 360, 740);
        let (width, screen) = (
            tab.number("document.documentElement.scrollWidth"),
            tab.number("innerWidth"),
        );
        assert!(width <= screen, "{example}: {width} of {screen}");
        assert_is_calm(&tab);
    }
}

/// A picture is shown as wide as the screen, with letters that can be read, and follows a dark page.
#[test]
fn pictures_fit_their_screen_and_follow_a_dark_page() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("spoiler_clarky", &[]);
    for (width, least) in [(420, 13.0), (1400, 14.0)] {
        let tab = browser.open(&file, width, 900);
        tab.value("window.seen = () => [...document.querySelectorAll('.view svg')].filter((svg) => svg.clientWidth > 0)");
        assert!(tab.number("seen().length") >= 4.0, "{width}");
        assert!(
            tab.holds("[...document.querySelectorAll('.view')].every((view) => view.scrollWidth <= view.clientWidth)"),
            "{width}"
        );
        let letters =
            tab.number("Math.min(...seen().map((svg) => 15 * svg.clientWidth / svg.viewBox.baseVal.width))");
        assert!(letters >= least, "{width}: letters of {letters}");
        let ground = "getComputedStyle(seen()[0].querySelector('rect')).fill";
        let light = tab.value(ground);
        tab.darken();
        assert_ne!(tab.value(ground), light, "{width}");
        assert_is_calm(&tab);
    }
}

/// The camera begins at the work, in front of which the machine is faint, goes to where one asks, and follows the tip.
#[test]
fn the_camera_is_at_the_work_and_follows_the_tip() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("spoiler_clarky", &[]);
    let tab = browser.open(&file, 1280, 900);
    assert!(tab.number("vcutPlayback.machineOpacity()") < 0.2);
    tab.value("document.getElementById('vcut-playback-whole').click()");
    assert_eq!(tab.number("vcutPlayback.machineOpacity()"), 1.0);
    tab.value("document.getElementById('vcut-playback-top').click()");
    assert!(tab.number("vcutPlayback.machineOpacity()") < 0.2);

    tab.value("vcutPlayback.goToLayer(2)");
    let layer = tab.number("vcutPlayback.time()");
    assert!(layer > 0.0);
    tab.value("vcutPlayback.stepCut(1)");
    let cut = tab.number("vcutPlayback.time()");
    assert!(cut > layer);
    tab.value("vcutPlayback.stepCut(1), vcutPlayback.stepCut(-1)");
    assert_eq!(tab.number("vcutPlayback.time()"), cut);

    tab.value("document.getElementById('vcut-playback-follow').click()");
    let looks = "vcutPlayback.looksAt().join()";
    let before = tab.value(looks);
    tab.value("vcutPlayback.stepCut(1)");
    tab.wait_until(&format!("{looks} !== {before}"));

    // The wheel is the picture's at once.
    let middle = tab.middle("#vcut-playback-canvas");
    tab.value("new Promise((done) => setTimeout(done, 400))");
    let scrolled = tab.number("scrollY");
    tab.mouse("mouseWheel", middle, &json!({ "deltaX": 0, "deltaY": 120 }));
    tab.value("new Promise((done) => setTimeout(done, 200))");
    assert_eq!(tab.number("scrollY"), scrolled);
    assert_is_calm(&tab);
}

/// Pointing at a moment in one picture marks it in the others, a click brings the playback there, and the mark goes with the playback.
#[test]
fn one_cursor_goes_through_all_pictures() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("spoiler_clarky", &[]);
    let tab = browser.open(&file, 1280, 900);
    // What a mark stands for, by the ends of what its picture shows.
    tab.value(
        "window.marked = (name) => { const rect = document.querySelector(`.for-page [data-cursor=${name}]`); \
         const at = Number(rect.ownerSVGElement.querySelector('.cursor').getAttribute('d').slice(1).split(' ')[0]); \
         const [left, width] = ['x', 'width'].map((side) => Number(rect.getAttribute(side))); \
         const [from, to] = [rect.dataset.from, rect.dataset.to].map(Number); \
         return from + (at - left) / width * (to - from); }",
    );
    tab.value("vcutPlayback.seek(30)");
    tab.wait_until("Math.abs(marked('time') - 30) < 0.1");

    let axes = tab.middle("#machine .for-page svg");
    tab.mouse("mouseMoved", axes, &json!({}));
    tab.wait_until("Math.abs(marked('time') - 30) > 1");
    let (time, duration) = (
        tab.number("marked('time')"),
        tab.number("vcutPlayback.duration()"),
    );
    assert!(
        (time - duration / 2.0).abs() < 0.05 * duration,
        "{time} of {duration}"
    );
    let x = tab.number("marked('x')");
    tab.click(axes);
    tab.wait_until(&format!("Math.abs(vcutPlayback.time() - {time}) < 0.1"));
    let tip = tab.number("vcutPlayback.tip()[0]");
    assert!((tip - x).abs() < 0.1, "the tip is at {tip}, marked is {x}");

    // A place in the deviation is the cut next to it, as the table has it.
    let place = tab.middle("#deviation .for-page svg");
    tab.click(place);
    let (pointed, started) = (
        tab.number(&format!(
            "(() => {{ const rect = document.querySelector('#deviation .for-page [data-cursor=x]'); \
             const point = new DOMPoint({}, 0).matrixTransform(rect.ownerSVGElement.getScreenCTM().inverse()); \
             return (point.x - rect.getAttribute('x')) / rect.getAttribute('width') * rect.dataset.to; }})()",
            place[0]
        )),
        tab.number("vcutPlayback.time()"),
    );
    let listed = tab.value(
        "[...document.querySelectorAll('.cuts tbody tr')].map((row) => \
         [Number(row.cells[1].textContent), Number(row.querySelector('[data-seek]').dataset.seek)])",
    );
    let listed: Vec<[f64; 2]> = listed
        .as_array()
        .unwrap()
        .iter()
        .map(|row| [0, 1].map(|cell| row[cell].as_f64().unwrap()))
        .collect();
    let away = |row: &[f64; 2]| (row[0] - pointed).abs();
    let nearest = listed.iter().map(away).fold(f64::INFINITY, f64::min);
    let shown = listed
        .iter()
        .filter(|row| row[1] <= started + 1e-3)
        .max_by(|one, other| one[1].total_cmp(&other[1]));
    let away_from_shown = shown.map_or(f64::INFINITY, away);
    assert!(
        away_from_shown < nearest + 0.02,
        "{pointed} at {started}: {away_from_shown}, not {nearest}"
    );

    // A start in the table leads there.
    tab.value("document.querySelectorAll('[data-seek]')[3].click()");
    assert_eq!(
        tab.number("Number(vcutPlayback.time().toFixed(3))"),
        tab.number("Number(document.querySelectorAll('[data-seek]')[3].dataset.seek)")
    );
    assert_is_calm(&tab);
}

/// The ground that a crusher clears: whole at first, at the floors in the end, and whole again when the time goes back.
#[test]
fn pockets_are_cleared_as_time_goes_on() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("seat", &[]);
    let tab = browser.open(&file, 1280, 900);
    let height = |[x, y]: [f64; 2]| tab.number(&format!("vcutPlayback.heightAt({x}, {y})"));
    // In the seat, on its boss, beside both pockets, and in the bay, which is open at x = 180.
    let places = [[30.0, 30.0], [60.0, 38.0], [80.0, 70.0], [179.0, 100.0]];
    let at = |share: f64| {
        tab.value(&format!("vcutPlayback.seek({share} * vcutPlayback.duration())"));
        places.map(height)
    };
    assert_eq!(at(0.0), [40.0; 4]);
    assert_eq!(at(1.0), [10.0, 40.0, 40.0, 22.0]);
    let [seat, boss, beside, bay] = at(0.5);
    assert!(seat <= 40.0 && [boss, beside, bay] == [40.0; 3], "{seat} {bay}");
    assert_eq!(at(0.0), [40.0; 4]);
    // Just within the walls: the tool is upright and as wide as its edge.
    at(1.0);
    assert_eq!([15.8, 14.2].map(|y| height([75.0, y])), [10.0, 40.0]);
    tab.value("document.getElementById('vcut-playback-top').click()");
    assert_is_calm(&tab);
}

/// What is said at home is what home is, at the beginning and at the end.
#[test]
fn at_home_the_axes_are_exactly_there() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("spoiler_clarky", &["--machine", "gantry"]);
    let tab = browser.open(&file, 1280, 900);
    let home = tab.value("vcutPlayback.joints().map((value) => value.toFixed(2)).join()");
    tab.value("vcutPlayback.seek(vcutPlayback.duration())");
    assert_eq!(
        tab.value(
            "vcutPlayback.joints().map((value) => value.toFixed(2)).join().replaceAll('-0.00', '0.00')"
        ),
        home.as_str().unwrap().replace("-0.00", "0.00")
    );
}

#[test]
fn a_set_up_sheet_is_one_page_of_paper() {
    let Some(browser) = Browser::start() else { return };
    for (example, more) in [
        ("spoiler_clarky", &["--target", "krl"][..]),
        ("spoiler_clarky", &["--machine", "gantry"]),
        ("block_cui", &[]),
        ("wavy_panel", &[]),
    ] {
        let (_folder, file) = report(example, &[&["--sheet"], more].concat());
        let tab = browser.open(&file, 1280, 900);
        assert_eq!(tab.pages_on_paper(), 1.0, "{example} {more:?}");
        assert_is_calm(&tab);
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("strips.vcut"), STRIPS).unwrap();
    let run = vcutc(
        folder.path(),
        &["report", "-q", "--sheet", "strips.vcut", "-o", "strips.html"],
    );
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let tab = browser.open(&folder.path().join("strips.html"), 1280, 900);
    assert_eq!(tab.pages_on_paper(), 1.0, "strips");
    assert_is_calm(&tab);
}

#[test]
fn a_link_to_a_line_unfolds_its_text() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("spoiler_clarky", &[]);
    let tab = browser.open(&file, 1280, 900);
    assert!(tab.holds("!document.querySelector('#text-1-1').closest('details').open"));
    tab.value("location.hash = 'text-1-1'");
    tab.wait_until("document.querySelector('#text-1-1').closest('details').open");
    assert_is_calm(&tab);
}

#[test]
fn nothing_that_a_job_is_called_runs() {
    let Some(browser) = Browser::start() else { return };
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("rib.vcut"), hostile_rib()).unwrap();
    let run = vcutc(folder.path(), &["report", "-q", "rib.vcut", "-o", "rib.html"]);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    let tab = browser.open(&folder.path().join("rib.html"), 1280, 900);
    assert!(tab.holds("top.hacked === undefined && document.querySelector('img') === null"));
    assert!(tab.holds("document.querySelector('h1').textContent.includes('<script>top.hacked=1</script>')"));
    assert_is_calm(&tab);
    // The policy holds even for what would get past the escaping.
    tab.value(
        "(() => { const script = document.createElement('script'); script.textContent = 'top.hacked = 1'; \
         document.body.append(script); })()",
    );
    assert!(tab.holds("top.hacked === undefined"));
    assert_eq!(tab.complaints().len(), 1, "the browser tells of it");
}

/// A polyline as the page has it.
fn polyline(tab: &Tab<'_>, expression: &str) -> Vec<[f64; 2]> {
    let value = tab.value(expression);
    let points = value.as_array().unwrap().iter();
    points
        .map(|point| [0, 1].map(|at| point[at].as_f64().unwrap()))
        .collect()
}

/// The height of a polyline over x.
fn height(line: &[[f64; 2]], x: f64) -> f64 {
    let piece = line.windows(2).find(|pair| x <= pair[1][0]).unwrap();
    let ([x0, z0], [x1, z1]) = (piece[0], piece[1]);
    if x1 > x0 {
        z0 + (z1 - z0) * (x - x0) / (x1 - x0)
    } else {
        z1
    }
}

/// Slits, strips and the Vs below them: what the page shows is what is proven, between its walls.
#[test]
fn operations_that_change_the_blade_are_played_back() {
    let Some(browser) = Browser::start() else { return };
    let outcome = both_blades();
    let page = vcutc::report::page::page(&outcome, Further::NOTHING).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("strips.html");
    std::fs::write(&file, page).unwrap();
    let tab = browser.open(&file, 1280, 900);
    let (plan, compiled) = (outcome.plan.unwrap(), outcome.compiled.unwrap());
    let surface = verdict::replay(&plan, compiled.program.verified()).surface;
    let proven: Vec<[f64; 2]> = surface.corners().map(|corner| [corner.x, corner.z]).collect();
    for _ in 0..2 {
        tab.value("vcutPlayback.seek(vcutPlayback.duration())");
        let shown = polyline(&tab, "vcutPlayback.section()");
        for number in 0..2000 {
            let x = (f64::from(number) + 0.5) * 0.05;
            let (shown, proven) = (height(&shown, x), height(&proven, x));
            assert!((shown - proven).abs() < 1e-3, "x {x}: {shown}, not {proven}");
        }
        tab.value("vcutPlayback.seek(0)");
        let start = polyline(&tab, "vcutPlayback.section()");
        assert!(start.iter().all(|[_, z]| (z - 50.0).abs() < 1e-9), "{start:?}");
    }
    // Cut by cut: slits, passes and first flanks are stepped through.
    tab.value("vcutPlayback.stepCut(1)");
    assert!(tab.holds("vcutPlayback.momentAt(vcutPlayback.time() + 0.01).words.includes('cut')"));
    assert_is_calm(&tab);
}

#[test]
fn cuts_are_played_back_up_to_the_machined_contour() {
    let Some(browser) = Browser::start() else { return };
    for (example, machine) in [("block_cui", None), ("spoiler_clarky", Some("gantry"))] {
        let more: Vec<&str> = machine.iter().flat_map(|name| ["--machine", *name]).collect();
        let (_folder, file) = report(example, &more);
        let tab = browser.open(&file, 1280, 900);

        tab.value("vcutPlayback.setSpeed(16), vcutPlayback.seek(10)");
        let before = tab.value("vcutPlayback.tip()");
        tab.value("vcutPlayback.play()");
        tab.wait_until(&format!(
            "vcutPlayback.time() > 10 && JSON.stringify(vcutPlayback.tip()) !== '{before}'"
        ));
        tab.value("vcutPlayback.pause()");
        let paused = tab.number("vcutPlayback.time()");
        tab.value("new Promise((done) => setTimeout(done, 100))");
        assert_eq!(tab.number("vcutPlayback.time()"), paused);

        let path = format!("examples/{example}.vcut");
        let outcome = compile_on(machine, &path, &Files::of(root()));
        let (plan, compiled) = (outcome.plan.unwrap(), outcome.compiled.unwrap());
        let surface = verdict::replay(&plan, compiled.program.verified()).surface;
        let proven: Vec<[f64; 2]> = surface.corners().map(|corner| [corner.x, corner.z]).collect();
        // To the end by the slider, back to the beginning and to the end again: what is shown does not depend on the way.
        for _ in 0..2 {
            tab.value(
                "(() => { const time = document.getElementById('vcut-playback-time'); time.value = time.max; \
                 time.dispatchEvent(new Event('input')); })()",
            );
            let shown = polyline(&tab, "vcutPlayback.section()");
            for [x, _] in proven.iter().chain(&shown) {
                let (shown, proven) = (height(&shown, *x), height(&proven, *x));
                assert!(
                    (shown - proven).abs() < 1e-3,
                    "{example}, x {x}: {shown}, not {proven}"
                );
            }
            tab.value("vcutPlayback.seek(0)");
            let start = polyline(&tab, "vcutPlayback.section()");
            let top = plan.stock.height.to_mm();
            assert!(start.iter().all(|[_, z]| (z - top).abs() < 1e-9), "{start:?}");
        }
        assert_is_calm(&tab);
    }
}

/// The slider shows one section of a part that changes along y, in every drawing of the picture: at its place, the part is as high as
/// its own formula says.
#[test]
fn a_slider_shows_the_section_at_its_place() {
    let Some(browser) = Browser::start() else { return };
    let (_folder, file) = report("dome", &[]);
    let tab = browser.open(&file, 1280, 900);
    let shown = "[...document.querySelectorAll('[data-slide]')].map((figure) => \
                 [...figure.querySelectorAll('[data-y]')].filter((part) => !part.hasAttribute('display')).map((part) => part.dataset.y))";
    let slide = |number: u32| {
        tab.value(&format!(
            "(() => {{ const input = document.querySelector('[data-slide] input'); input.value = {number}; \
             input.dispatchEvent(new Event('input')); return input.value; }})()"
        ));
    };
    let places = tab.value("[...document.querySelector('[data-slide]').querySelectorAll('[data-y]')].map((part) => part.dataset.y)");
    let places: Vec<String> = serde_json::from_value(places).unwrap();
    assert_eq!(tab.value(shown), json!([[places[20]], [places[20]]]));
    for number in [0_u32, 7, 40] {
        slide(number);
        let place = &places[number as usize];
        assert_eq!(tab.value(shown), json!([[place], [place]]));
        assert_eq!(
            tab.value("document.querySelector('[data-slide] output').textContent"),
            json!(place)
        );
    }
    assert_is_calm(&tab);
}
