//! Elements, transformations and pages; files that are not SVG or cannot be understood.

use super::super::drawing::{Affine, OutlineError, Unit, Why, outline};
use super::*;
use crate::point::Point2;
use proptest::prelude::*;
use vcutc_backend_api::units::Length;

fn page(inside: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='50mm' viewBox='0 0 100 50'>{inside}</svg>"
    )
}

fn complaint(text: &str) -> (String, String) {
    let error = svg(text, None).unwrap_err();
    let place = text.get(error.start as usize..error.end as usize).unwrap();
    (place.to_owned(), error.message)
}

fn points(text: &str) -> Vec<Point2> {
    let drawing = svg(text, None).unwrap();
    let outline = outline(
        &drawing.strokes,
        Affine::IDENTITY,
        Length::mm(1e-3),
        Length::mm(1e-3),
    )
    .unwrap();
    outline.points
}

fn rounded(text: &str) -> Vec<(f64, f64)> {
    let round = |value: f64| (value * 1e6).round() / 1e6 + 0.0;
    points(text).iter().map(|p| (round(p.x), round(p.z))).collect()
}

#[test]
fn all_ways_to_draw_a_line_are_the_same() {
    for inside in [
        "<line x1='10' y1='40' x2='30' y2='20'/>",
        "<polyline points='10,40 30,20'/>",
        "<polyline points='10 40,30 20'/>",
        "<path d='M10,40 L30,20'/>",
        "<path d='m10 40 20-20'/>",
        "<path d='M10,40L30,40m0,0' visibility='hidden'/><path d='M1e1,4.0E1l2e1-20'/>",
        "<path d='M.1 40.m9.9 0 20,-20'/>",
        "<g transform='translate(10,40) scale(2 -2)'><path d='M0 0 10 10'/></g>",
        "<g transform='rotate(-90 10 40)'><path d='M10,40 l20,20'/></g>",
        "<g transform='matrix(0 1 1 0 0 0),skewX(0)'><path d='M40,10 H20 M20,10'/><path d='M20 10V30'/></g>",
        "<defs><line id='a' x1='0' y1='20' x2='20' y2='0'/></defs><use href='#a' x='10' y='20'/>",
        "<svg x='10' y='20' width='40' height='40' viewBox='0 0 20 20'><path d='M0 10 10 0'/></svg>",
        "<symbol id='s' viewBox='0 0 10 10'><path d='M0 10 10 0'/></symbol><use href='#s' x='10' y='20' width='20' \
         height='20'/>",
        "<line x1='10mm' y1='40' x2='30' y2='20' transform='scale(1)' style='display:none'/><path d='M10 40 30 20'/>",
    ] {
        let found = rounded(&page(inside));
        let ends = [found[0], found[found.len() - 1]];
        assert_eq!(ends, [(10.0, 10.0), (30.0, 30.0)], "{inside}");
    }
}

#[test]
fn pages_say_what_the_unit_is() {
    let unit = |head: &str| {
        svg(&format!("<svg xmlns='http://www.w3.org/2000/svg' {head}/>"), None)
            .unwrap()
            .unit
    };
    assert_eq!(unit("width='100mm' viewBox='0 0 200 100'"), Unit::Known(0.5));
    assert_eq!(unit("height='2cm' viewBox='0 0 100 80'"), Unit::Known(0.25));
    assert_eq!(unit("width='10cm' height='100mm'"), Unit::Known(25.4 / 96.0));
    for head in [
        "width='100' height='50'",
        "width='100px'",
        "width='100%' viewBox='0 0 9 9'",
        "",
    ] {
        assert!(matches!(unit(head), Unit::Unsaid(_)), "{head}");
    }
    // Stretched apart: z is in the unit of x.
    let text = "<svg width='10mm' height='30mm' viewBox='0 0 10 10' preserveAspectRatio='none'>\
                <path d='M0 0 10 10'/></svg>";
    assert_eq!(rounded(text), [(0.0, 30.0), (10.0, 0.0)]);
}

/// The circles of arcs by flags: four arcs lead from (0, 0) to (10, 0) on circles of radius 6.
#[test]
fn arcs_follow_their_flags() {
    for (flags, up, is_large) in [
        ("00", false, false),
        ("01", true, false),
        ("10", false, true),
        ("11", true, true),
    ] {
        let found = points(&page(&format!("<path d='M0 50a6 6 0 {flags}10 0'/>")));
        let depth = 11.0_f64.sqrt();
        let reach = if is_large { 6.0 + depth } else { 6.0 - depth };
        let (low, high) = found
            .iter()
            .fold((0.0_f64, 0.0_f64), |(l, h), p| (l.min(p.z), h.max(p.z)));
        let expected = if up { (0.0, reach) } else { (-reach, 0.0) };
        assert!(
            (low - expected.0).abs() < 2e-3 && (high - expected.1).abs() < 2e-3,
            "{flags}: {low} {high}"
        );
        let center = Point2::new(5.0, if up == is_large { depth } else { -depth });
        assert!(found.iter().all(|p| (p.distance(center) - 6.0).abs() < 1e-9));
    }
    // Radii that are too small grow to half the chord, and radii of 0 are lines.
    let grown = points(&page("<path d='M0 50 A1 1 0 0 1 10 50'/>"));
    assert!(
        grown
            .iter()
            .all(|p| (p.distance(Point2::new(5.0, 0.0)) - 5.0).abs() < 1e-9)
    );
    assert_eq!(
        rounded(&page("<path d='M0 50 A0 5 0 0 1 10 50'/>")),
        [(0.0, 0.0), (10.0, 0.0)]
    );
}

#[test]
fn closed_shapes_are_rings() {
    for (inside, width, height) in [
        ("<rect x='10' y='10' width='30' height='20'/>", 30.0, 20.0),
        ("<rect x='10' y='10' width='30' height='20' rx='4'/>", 30.0, 20.0),
        ("<circle cx='20' cy='20' r='10'/>", 20.0, 20.0),
        (
            "<ellipse cx='20' cy='20' rx='10' ry='5' transform='rotate(90 20 20)'/>",
            10.0,
            20.0,
        ),
        ("<polygon points='10,10 40,10 40,30'/>", 30.0, 20.0),
        ("<path d='M10 10H40V30z'/>", 30.0, 20.0),
    ] {
        let found = points(&page(inside));
        let first = found[0];
        assert!(found[found.len() - 1].distance(first) < 1e-9, "{inside}");
        let extent = |part: fn(&Point2) -> f64| {
            let all = found.iter().map(part);
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        assert!((extent(|p| p.x) - width).abs() < 2e-3, "{inside}");
        assert!((extent(|p| p.z) - height).abs() < 2e-3, "{inside}");
    }
}

#[test]
fn faults_are_pointed_at() {
    let inside = |inside: &str| complaint(&page(inside));
    assert_eq!(inside("<path d='M0 0 L5 x'/>").0, "x");
    assert_eq!(inside("<path d='M0 0 L5'/>").0, "5");
    assert_eq!(
        inside("<path d='M0 0 B5 5'/>").1,
        "a command of a path before this is expected here, not `5`"
    );
    assert!(inside("<path d='L5 5'/>").1.contains("`M`"));
    assert_eq!(inside("<path d='M0 0 A5 5 0 2 1 5 5'/>").0, "2");
    assert_eq!(inside("<path d='M0 0 1e12 0'/>").0, "1e12");
    assert_eq!(inside("<g transform='shift(1)'/>").0, "shift(1)");
    assert_eq!(inside("<g transform='scale(0)'/>").0, "scale(0)");
    assert_eq!(inside("<line x1='1parsec'/>").0, "1parsec");
    assert!(inside("<line x1='10%'/>").1.contains("percentages"));
    assert_eq!(inside("<circle r='-1'/>").0, "<circle");
    assert!(
        inside("<use href='#nowhere'/>")
            .1
            .contains("no element with the id `nowhere`")
    );
    assert!(
        inside("<g style='transform: rotate(3deg)'/>")
            .1
            .contains("attribute `transform`")
    );
    assert!(complaint("<svg").1.contains("well-formed"));
    assert!(complaint("<html/>").1.contains("`svg`"));
    assert!(
        complaint("<!DOCTYPE svg [<!ENTITY a 'b'>]><svg/>")
            .1
            .contains("entities")
    );
}

#[test]
fn references_without_end_are_refused() {
    let own = page("<g id='a'><use href='#a'/></g>");
    assert!(complaint(&own).1.contains("deep") || complaint(&own).1.contains("itself"));
    let deep = page(&format!("{}{}", "<g>".repeat(100), "</g>".repeat(100)));
    assert!(complaint(&deep).1.contains("nested more than"));
    let bomb: String = (0..12)
        .map(|i| {
            format!(
                "<g id='g{i}'>{}</g>",
                format!("<use href='#g{}'/>", i + 1).repeat(10)
            )
        })
        .collect();
    let bomb = page(&format!("{bomb}<g id='g12'><path d='M0 0 1 1'/></g>"));
    assert!(svg(&bomb, None).unwrap_err().message.contains("more than"));
}

/// What a page has beyond its view box lies on both sides of it, unless the file says otherwise.
#[test]
fn a_view_box_of_another_shape_is_placed_on_its_page() {
    let ends = |size: &str, said: &str| {
        let found = rounded(&format!(
            "<svg xmlns='http://www.w3.org/2000/svg' {size} viewBox='0 0 10 10' {said}><path d='M0 10 10 0'/></svg>"
        ));
        [found[0], found[found.len() - 1]]
    };
    // In user units: the wide page has 10 of them to spare from left to right, the tall one from above to below.
    for (said, left, below) in [
        ("", 5.0, 5.0),
        ("preserveAspectRatio='xMidYMid meet'", 5.0, 5.0),
        ("preserveAspectRatio='xMinYMin'", 0.0, 10.0),
        ("preserveAspectRatio='xMaxYMax'", 10.0, 0.0),
    ] {
        let wide = [(left, 0.0), (left + 10.0, 10.0)];
        assert_eq!(ends("width='100mm' height='50mm'", said), wide, "{said}");
        let tall = [(0.0, below), (10.0, below + 10.0)];
        assert_eq!(ends("width='50mm' height='100mm'", said), tall, "{said}");
    }
    let cut = ends(
        "width='100mm' height='50mm'",
        "preserveAspectRatio='xMidYMid slice'",
    );
    assert_eq!(cut, [(0.0, -2.5), (10.0, 7.5)]);
    let stretched = ends("width='100mm' height='50mm'", "preserveAspectRatio='none'");
    assert_eq!(stretched, [(0.0, 0.0), (10.0, 5.0)]);
    let within = "<svg x='10' y='20' width='40' height='20' viewBox='0 0 20 20' preserveAspectRatio='xMaxYMin'>\
        <path d='M0 20 20 0'/></svg>";
    let found = rounded(&page(within));
    assert_eq!([found[0], found[found.len() - 1]], [(30.0, 10.0), (50.0, 30.0)]);
}

/// Clips and masks hide parts of what is read whole, and sheets of other files may hide anything: both are listed.
#[test]
fn what_is_not_applied_is_listed() {
    let listed = |text: &str| {
        let drawing = svg(text, None).unwrap();
        assert_eq!(drawing.strokes.len(), 1, "{text}");
        let kinds = drawing.unread.into_iter().map(|unread| (unread.kind, unread.why));
        kinds.collect::<Vec<_>>()
    };
    let drawn = "<path d='M0 0 9 9'/>";
    for (inside, kind, why) in [
        (
            format!("<g clip-path='url(#a)'>{drawn}</g>"),
            "clip-path",
            Why::NotApplied,
        ),
        (
            format!("<g style='mask:url(#a)'>{drawn}</g>"),
            "mask",
            Why::NotApplied,
        ),
        (
            format!("<style>.c{{clip-path:url(#a)}}</style><g class='c'>{drawn}</g>"),
            "clip-path",
            Why::NotApplied,
        ),
        (
            format!("<style>@import url('a.css'); .c{{fill:none}}</style>{drawn}"),
            "@import",
            Why::OtherFile,
        ),
        (
            format!("<link xmlns='http://www.w3.org/1999/xhtml' rel='stylesheet' href='a.css'/>{drawn}"),
            "link",
            Why::OtherFile,
        ),
    ] {
        assert_eq!(listed(&page(&inside)), [(kind.to_owned(), why)], "{inside}");
    }
    let processed = format!("<?xml-stylesheet href='a.css'?>{}", page(drawn));
    assert_eq!(
        listed(&processed),
        [("xml-stylesheet".to_owned(), Why::OtherFile)]
    );
    let none = format!("<g clip-path='none' style='mask:none'>{drawn}</g>");
    assert!(listed(&page(&none)).is_empty());
}

#[test]
fn layers_are_groups_with_names_and_the_rest_is_listed() {
    let text = page(
        "<g id='g1' xmlns:i='http://www.inkscape.org/namespaces/inkscape' i:label='Skin'><path d='M0 0 9 9'/>\
         <text>RIB</text><image/><g style='display:none'><path d='M0 0 1 1'/></g></g>\
         <g id='notes'><path d='M5 5 6 6'/><text>NOTE</text></g><metadata><path d='M0 0'/></metadata>",
    );
    for name in ["Skin", "g1"] {
        let drawing = svg(&text, Some(name)).unwrap();
        assert_eq!(drawing.strokes.len(), 1);
        let listed: Vec<(&str, Why)> = drawing.unread.iter().map(|u| (u.kind.as_str(), u.why)).collect();
        let expected = [("text", Why::Kind), ("image", Why::Kind), ("path", Why::Hidden)];
        assert_eq!(listed, expected);
    }
    let all = svg(&text, None).unwrap();
    assert_eq!(
        all.layers.iter().collect::<Vec<_>>(),
        [(&"Skin".to_owned(), &1), (&"notes".to_owned(), &1)]
    );
    assert!(svg(&text, Some("nothing")).unwrap().strokes.is_empty());
}

#[test]
fn what_styles_hide_is_left_out_unless_it_is_asked_for() {
    let shown = |text: &str, layer: Option<&str>| svg(text, layer).unwrap().strokes.len();
    let drawn = "<path d='M0 0 9 9'/>";
    for hidden in [
        format!("<g id='a' style='display:none'>{drawn}</g>"),
        format!("<g id='a' style='fill:none; DISPLAY : none !important;'>{drawn}</g>"),
        format!("<g id='a' display='none'>{drawn}</g>"),
        format!("<g id='a' visibility='hidden'>{drawn}</g>"),
        format!(
            "<style>.st0{{display:none;}} .st1{{fill:none}}</style><g id='a' class='st1 st0'>{drawn}</g>"
        ),
        format!(
            "<style>/* of layers */ .x,.y-1 {{fill:red;visibility:hidden}}</style><g id='a' class='y-1'>{drawn}</g>"
        ),
        format!("<style>.b{{display:inline}}.a{{display:none}}</style><g id='a' class='a b'>{drawn}</g>"),
    ] {
        assert_eq!(shown(&page(&hidden), None), 0, "{hidden}");
        assert_eq!(shown(&page(&hidden), Some("a")), 1, "{hidden}");
    }
    for visible in [
        format!("<style>.st0{{display:none}} .st0{{display:inline}}</style><g class='st0'>{drawn}</g>"),
        format!("<style>.st0{{display:none}}</style><g class='st0' style='display:inline'>{drawn}</g>"),
        format!(
            "<style>@import url(a.css); path{{fill:none}} @media print{{ .q{{fill:red}} }}</style>{drawn}"
        ),
        // What Inkscape writes for texts moves nothing.
        format!("<g style='text-transform:none;-inkscape-font-specification:Sans'>{drawn}</g>"),
        format!("<g style='transform:none'>{drawn}</g>"),
    ] {
        assert_eq!(shown(&page(&visible), None), 1, "{visible}");
    }
    for refused in [
        "<style>g path{display:none}</style>",
        "<style>@media print{ .q{display:none} }</style>",
        "<style>.q{transform:scale(2)}</style>",
        "<g style='fill:none;transform:scale(2)'/>",
        "<g style='rotate: 3deg'/>",
        "<style>.q{d:path('M0 0H9')}</style>",
        "<g style='transform-origin:3px 4px'/>",
        "<g transform='scale(2)' transform-origin='3 4'/>",
    ] {
        let (_, message) = complaint(&page(refused));
        assert!(message.contains("not supported"), "{refused}: {message}");
    }
}

#[test]
fn numbers_run_together_as_programs_write_them() {
    for (data, ends) in [
        // Flags without blanks, points without zeros, signs as separators, exponents.
        ("M0 50a1,1 0 01.5.5", (0.5, -0.5)),
        ("M0 50A5 5 0 1110-.5e1", (10.0, 55.0)),
        ("M0,50c0-1.5.5-2 1e1,0", (10.0, 0.0)),
        ("m0 50l5 5 5-5", (10.0, 0.0)),
        ("M0 50h5v-5H10V50", (10.0, 0.0)),
        ("M-0+50\n\tL+10\r\n50", (10.0, 0.0)),
    ] {
        let found = rounded(&page(&format!("<path d='{data}'/>")));
        assert_eq!((found[0], found[found.len() - 1]), ((0.0, 0.0), ends), "{data}");
    }
}

/// The page of CorelDRAW: mm, a view box of hundredths, a foreign document type; and one that begins elsewhere.
#[test]
fn pages_of_other_programs_are_scaled() {
    let corel = "\u{feff}<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \
                 \"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\n<svg xmlns=\"http://www.w3.org/2000/svg\" \
                 xml:space=\"preserve\" width=\"210mm\" height=\"297mm\" viewBox=\"0 0 21000 29700\">\n \
                 <g id=\"Layer_x0020_1\"><metadata id=\"CorelCorpID_0Corel-Layer\"/><polygon class=\"fil0\" \
                 points=\"100,29700 8600,29700 8600,27000 100,26000 \"/></g></svg>";
    let drawing = svg(corel, Some("Layer_x0020_1")).unwrap();
    assert_eq!(drawing.unit, Unit::Known(0.01));
    assert!(drawing.unread.is_empty());
    let text = "<svg xmlns='http://www.w3.org/2000/svg' width='4in' height='2in' viewBox='-10 -20 101.6 50.8'>\
                <g transform='translate(5 5) rotate(90) scale(2,-2)'><path d='M0 0 10 0'/></g></svg>";
    assert_eq!(svg(text, None).unwrap().unit, Unit::Known(1.0));
    let mut ends = rounded(text);
    ends.sort_by(|a, b| a.1.total_cmp(&b.1));
    assert_eq!(ends, [(15.0, 5.8), (15.0, 25.8)]);
}

proptest! {
    #[test]
    fn any_path_data_gives_a_drawing_or_a_place(data in "[MmLlHhVvCcSsQqTtAaZz0-9.,eE+ -]{0,60}") {
        let text = page(&format!("<path d='{data}'/>"));
        match svg(&text, None) {
            Err(error) => prop_assert!(text.get(error.start as usize..error.end as usize).is_some()),
            Ok(drawing) => {
                let map = Affine::stretch(1e-3, 1e-3);
                let joined = outline(&drawing.strokes, map, Length::mm(1e-3), Length::mm(1e-3));
                let is_spline = matches!(joined, Err(OutlineError::Nurbs { .. }));
                prop_assert!(!is_spline);
            }
        }
    }
}
