//! Files that are not DXF, or cannot be understood: each fault is shown at its place.

use super::super::drawing::{Affine, Drawing, Shape, Why, outline};
use super::*;
use crate::point::Point2;
use proptest::prelude::*;
use vcutc_backend_api::units::Length;

/// A file with these groups in its section ENTITIES, written `code value code value`.
fn entities(groups: &str) -> String {
    file(&format!("0 SECTION 2 ENTITIES {groups} 0 ENDSEC 0 EOF"))
}

fn file(groups: &str) -> String {
    groups.split(' ').map(|part| format!("{part}\n")).collect()
}

fn complaint(text: &str) -> (String, String) {
    let error = dxf(text, None).unwrap_err();
    let place = text.get(error.start as usize..error.end as usize).unwrap();
    (place.to_owned(), error.message)
}

const LINE: &str = "0 LINE 8 SKIN 10 0.0 20 0.0 30 0.0 11 10.0 21 5.0 31 0.0";

#[test]
fn what_is_not_dxf_is_reported() {
    assert!(complaint("").1.contains("empty"));
    assert!(complaint("x,z\n0,1\n").1.contains("begins with"));
    assert!(complaint("<svg/>\n<g/>\n").1.contains("begins with"));
    assert_eq!(
        dxf_text(b"AutoCAD Binary DXF\r\n\x1a\0".to_vec()),
        Err(NoText::Binary)
    );
    assert_eq!(dxf_text(b"AC1032\0\0".to_vec()), Err(NoText::Dwg));
    let page = |name: &str| {
        let head = file(&format!("0 SECTION 2 HEADER 9 $DWGCODEPAGE 3 {name} 8"));
        let mut bytes = head.into_bytes();
        bytes.extend([b'R', 0xfc, b'c', b'k', b'\n']);
        dxf_text(bytes)
    };
    assert!(page("ANSI_1252").unwrap().ends_with("Rück\n"));
    assert_eq!(page("ANSI_932"), Err(NoText::CodePage("ANSI_932".to_owned())));
}

/// Letters of names may be written by their numbers.
#[test]
fn codes_stand_for_letters() {
    let text = |bytes: &str| dxf_text(bytes.as_bytes().to_vec()).unwrap();
    assert_eq!(text(r"Au\U+00DFenh\u+00E4ut"), r"Außenh\u+00E4ut");
    assert_eq!(text(r"\U+00E4\U+20AC"), "ä€");
    assert_eq!(text("45%%d %%P2 %%c8 100%%%"), "45° ±2 ⌀8 100%");
    for plain in [
        r"\U+00E", r"\U+D800", r"\U+000A", r"\U+ 0E4", "%%x", "5 %", r"C:\", "%%",
    ] {
        assert_eq!(text(plain), plain);
    }
}

#[test]
fn files_that_were_cut_off_are_reported() {
    let text = entities(LINE);
    for (at, _) in text.match_indices('\n') {
        let cut = &text[..at];
        let Err(error) = dxf(cut, None) else {
            assert!(cut.ends_with("EOF"), "{cut:?}");
            continue;
        };
        assert!(
            error.message.contains("cut off") || cut.len() < 20,
            "{cut:?}: {}",
            error.message
        );
    }
}

#[test]
fn faults_of_entities_are_pointed_at() {
    let whole = |groups: &str| complaint(&entities(groups));
    assert_eq!(
        whole(&LINE.replace("5.0", "five")),
        ("five".into(), "`five` is not a number".into())
    );
    assert_eq!(whole(&LINE.replace("5.0", "nan")).0, "nan");
    assert_eq!(whole(&LINE.replace("5.0", "1e12")).0, "1e12");
    assert_eq!(whole(&LINE.replace(" 21 ", " 2l ")).0, "2l");
    assert_eq!(
        whole(&LINE.replace("21 5.0 ", "")),
        ("LINE".into(), "this LINE lacks its group 21".into())
    );
    assert!(whole("0 CIRCLE 10 0 20 0 40 -1").1.contains("radius"));
    assert!(
        whole("0 LWPOLYLINE 90 3 10 0 20 0 10 1 20 1")
            .1
            .contains("3 corners, and has 2")
    );
    assert!(
        whole("0 POLYLINE 66 1 0 VERTEX 10 0 20 0 0 LINE")
            .1
            .contains("SEQEND")
    );
    assert!(whole("0 INSERT 2 RIB 10 0 20 0").1.contains("no block `RIB`"));
    assert!(whole("0 INSERT 2 RIB 10 0 20 0 41 0").1.contains("to zero"));
    let spline = "0 SPLINE 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 10 1 20 1 10 2 20 0";
    assert!(dxf(&entities(spline), None).is_ok());
    assert!(
        whole(&spline.replace("40 1 40 1 40 1", "40 1 40 1"))
            .1
            .contains("take 6 knots")
    );
    assert!(
        whole(&spline.replace("71 2", "71 2 73 4"))
            .1
            .contains("4 control points, and has 3")
    );
    assert!(
        whole(&spline.replace("71 2", "71 2 41 1 41 1 41 -1"))
            .1
            .contains("weight number 3")
    );
    assert!(
        whole("0 SPLINE 71 3 11 0 21 0 11 5 21 5 12 1 22 0")
            .1
            .contains("directions at its ends")
    );
}

#[test]
fn what_is_not_read_is_listed_with_its_reason() {
    let groups = format!(
        "{LINE} 0 TEXT 8 SKIN 1 RIB 0 TEXT 8 SKIN 1 RIB 0 3DSOLID 8 SKIN 0 LINE 8 SKIN 67 1 10 0 20 0 11 1 21 1 \
         0 LINE 8 SKIN 10 0 20 0 30 0 11 1 21 1 31 4 0 ARC 8 SKIN 10 0 20 0 40 1 50 0 51 90 210 1 220 0 230 0 \
         0 LWPOLYLINE 8 SKIN 10 1 20 1 0 TEXT 8 OTHER"
    );
    let drawing = dxf(&entities(&groups), Some("skin")).unwrap();
    assert_eq!(drawing.strokes.len(), 1);
    let listed: Vec<(&str, Why, usize)> = drawing
        .unread
        .iter()
        .map(|unread| (unread.kind.as_str(), unread.why, unread.count))
        .collect();
    assert_eq!(
        listed,
        [
            ("TEXT", Why::Kind, 2),
            ("3DSOLID", Why::Kind, 1),
            ("LINE", Why::Paper, 1),
            ("LINE", Why::Tilted, 1),
            ("ARC", Why::Tilted, 1),
            ("LWPOLYLINE", Why::NoExtent, 1)
        ]
    );
    assert_eq!(drawing.layers.keys().collect::<Vec<_>>(), ["OTHER", "SKIN"]);
}

/// A file whose blocks are given, and one insertion of the block A.
fn with_blocks(blocks: &str) -> String {
    file(&format!(
        "0 SECTION 2 BLOCKS {blocks} 0 ENDSEC 0 SECTION 2 ENTITIES 0 INSERT 8 SKIN 2 A 10 0 20 0 0 ENDSEC 0 EOF"
    ))
}

#[test]
fn blocks_without_end_are_refused() {
    let own = with_blocks("0 BLOCK 2 A 0 INSERT 2 a 10 0 20 0 0 ENDBLK");
    assert!(complaint(&own).1.contains("into itself"));
    let circle = with_blocks(
        "0 BLOCK 2 A 0 INSERT 2 B 10 0 20 0 0 ENDBLK 0 BLOCK 2 B 0 INSERT 2 A 10 0 20 0 0 ENDBLK",
    );
    assert!(complaint(&circle).1.contains("into itself"));
    let deep: Vec<String> = (0..40)
        .map(|i| {
            format!(
                "0 BLOCK 2 {} 0 INSERT 2 B{} 10 0 20 0 0 ENDBLK",
                if i == 0 { "A".into() } else { format!("B{i}") },
                i + 1
            )
        })
        .collect();
    assert!(complaint(&with_blocks(&deep.join(" "))).1.contains("deep"));
    // Every block holds the next one ten times.
    let ten = |name: &str, next: &str| {
        let inserts = format!("0 INSERT 2 {next} 10 0 20 0 ").repeat(10);
        format!("0 BLOCK 2 {name} {inserts}0 ENDBLK ")
    };
    let bomb: String = (0..12)
        .map(|i| {
            ten(
                &if i == 0 { "A".into() } else { format!("B{i}") },
                &format!("B{}", i + 1),
            )
        })
        .collect();
    let bomb = with_blocks(&format!("{bomb}0 BLOCK 2 B12 {LINE} 0 ENDBLK"));
    assert!(dxf(&bomb, None).unwrap_err().message.contains("more than"));
    let array = with_blocks("0 BLOCK 2 A 0 ENDBLK").replace("\n2\nA\n10", "\n2\nA\n70\n99999\n71\n99999\n10");
    assert!(complaint(&array).1.contains("too often"));
    let other = with_blocks("0 BLOCK 2 A 70 4 0 ENDBLK");
    assert_eq!(dxf(&other, None).unwrap().unread[0].why, Why::OtherFile);
}

/// An insertion in columns and rows, turned by a right angle, of a block with a base point: worked by hand.
#[test]
fn insertions_put_blocks_where_they_belong() {
    let text = with_blocks("0 BLOCK 2 A 10 1 20 1 0 LINE 8 0 10 1 20 1 11 2 21 1 0 ENDBLK").replace(
        "\n2\nA\n10\n0\n20\n0\n0\nENDSEC",
        "\n2\nA\n10\n5\n20\n5\n50\n90\n41\n2\n70\n2\n44\n10\n71\n2\n45\n3\n0\nENDSEC",
    );
    let drawing = dxf(&text, Some("SKIN")).unwrap();
    let ends: Vec<Vec<(f64, f64)>> = drawing
        .strokes
        .iter()
        .map(|stroke| match &stroke.shapes[0] {
            Shape::Polyline(points) => points.iter().map(|p| (p.x, p.z)).collect(),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(
        ends,
        [
            [(5.0, 5.0), (5.0, 7.0)],
            [(5.0, 15.0), (5.0, 17.0)],
            [(2.0, 5.0), (2.0, 7.0)],
            [(2.0, 15.0), (2.0, 17.0)]
        ]
    );
}

#[test]
fn arcs_seen_from_below_are_mirrored() {
    let groups = "0 ARC 8 0 10 -5 20 1 40 2 50 0 51 90 210 0 220 0 230 -1";
    let drawing = dxf(&entities(groups), None).unwrap();
    let Shape::Arc { from, sweep, .. } = drawing.strokes[0].shapes[0] else {
        panic!("an arc stays an arc");
    };
    assert_eq!(from, Point2::new(3.0, 1.0));
    assert!(sweep < 0.0);
}

/// A file with a table of layers: name, flags and colour of each.
fn with_layers(layers: &str, rest: &str) -> String {
    let table: String = layers
        .split(", ")
        .map(|layer| {
            let [name, flags, color] = layer.split(' ').collect::<Vec<_>>()[..] else {
                panic!("{layer}");
            };
            format!("0 LAYER 2 {name} 70 {flags} 62 {color} ")
        })
        .collect();
    file(&format!(
        "0 SECTION 2 TABLES 0 TABLE 2 LAYER 70 9 {table}0 ENDTAB 0 ENDSEC {rest} 0 EOF"
    ))
}

/// What is left out: its kind, why, how often.
fn left_out(drawing: &Drawing) -> Vec<(&str, Why, usize)> {
    let listed = drawing.unread.iter();
    listed
        .map(|unread| (unread.kind.as_str(), unread.why, unread.count))
        .collect()
}

#[test]
fn what_is_not_seen_is_not_read_unless_its_layer_is_named() {
    let on = |layer: &str, more: &str| LINE.replace("8 SKIN", &format!("8 {layer}{more}"));
    let rest = format!(
        "0 SECTION 2 ENTITIES {} {} {} {} 0 TEXT 8 OFF 1 RIB 0 ENDSEC",
        on("SKIN", ""),
        on("OFF", ""),
        on("ICE", ""),
        on("SKIN", " 60 1"),
    );
    let text = with_layers("SKIN 0 7, OFF 0 -7, ICE 1 7", &rest);
    let whole = dxf(&text, None).unwrap();
    assert_eq!(whole.strokes.len(), 1);
    assert_eq!(
        left_out(&whole),
        [
            ("LINE", Why::Off, 1),
            ("LINE", Why::Frozen, 1),
            ("LINE", Why::Hidden, 1),
            ("TEXT", Why::Off, 1)
        ]
    );
    assert_eq!(whole.layers.values().sum::<usize>(), 3);
    for (layer, others) in [
        ("off", vec![("TEXT", Why::Kind, 1)]),
        ("ice", vec![]),
        ("skin", vec![("LINE", Why::Hidden, 1)]),
    ] {
        let drawing = dxf(&text, Some(layer)).unwrap();
        assert_eq!(drawing.strokes.len(), 1, "{layer}");
        assert_eq!(left_out(&drawing), others, "{layer}");
    }
}

/// A block with a line on its own layer and one on layer 0, inserted on a layer that is not seen.
#[test]
fn a_frozen_insertion_hides_all_and_one_that_is_off_what_is_on_its_layer() {
    let block = format!(
        "0 SECTION 2 BLOCKS 0 BLOCK 2 A {} {} 0 ENDBLK 0 ENDSEC",
        LINE,
        LINE.replace("SKIN", "0")
    );
    let inserted = |layer: &str, state: &str| {
        let rest = format!("{block} 0 SECTION 2 ENTITIES 0 INSERT 8 {layer} 2 A 10 0 20 0 0 ENDSEC");
        with_layers(&format!("SKIN 0 7, {layer} {state}"), &rest)
    };
    let off = dxf(&inserted("OFF", "0 -7"), None).unwrap();
    assert_eq!(off.strokes.len(), 1);
    assert_eq!(left_out(&off), [("LINE", Why::Off, 1)]);
    let frozen = inserted("ICE", "1 7");
    let all = dxf(&frozen, None).unwrap();
    assert_eq!(
        (all.strokes.len(), left_out(&all)),
        (0, vec![("LINE", Why::Frozen, 2)])
    );
    // Named, the frozen layer has what is on it; the other one stays hidden by the insertion.
    let ice = dxf(&frozen, Some("ICE")).unwrap();
    assert_eq!((ice.strokes.len(), ice.unread.len()), (1, 0));
    let skin = dxf(&frozen, Some("SKIN")).unwrap();
    assert_eq!(
        (skin.strokes.len(), left_out(&skin)),
        (0, vec![("LINE", Why::Frozen, 1)])
    );
}

/// The chain that entities make, rounded.
fn chain(groups: &str) -> Vec<(f64, f64)> {
    rounded(&entities(groups))
}

fn rounded(text: &str) -> Vec<(f64, f64)> {
    let drawing = dxf(text, None).unwrap();
    let length = Length::mm(1e-3);
    let outline = outline(&drawing.strokes, Affine::IDENTITY, length, length).unwrap();
    let round = |value: f64| (value * 1e6).round() / 1e6 + 0.0;
    outline.points.iter().map(|p| (round(p.x), round(p.z))).collect()
}

#[test]
fn polylines_of_all_programs_are_the_same_line() {
    let line = [(0.0, 0.0), (10.0, 5.0), (20.0, 0.0)];
    let heavy = |flags: &str, more: &str| {
        let corners: String = [(0, 0), (10, 5), (20, 0)]
            .map(|(x, y)| format!("0 VERTEX 8 0 10 {x} 20 {y} 30 3{more} "))
            .concat();
        format!("0 POLYLINE 8 0 66 1 10 0 20 0 30 3 70 {flags} {corners}0 SEQEND 8 0")
    };
    for groups in [
        // With widths, elevation, thickness, colours, and identifiers of corners.
        "0 LWPOLYLINE 5 2A 100 AcDbPolyline 90 3 70 128 43 0.5 38 7 39 1 10 0 20 0 40 1 41 2 91 7 10 10 20 5 42 0 10 20 20 0",
        // Seen from below.
        "0 LWPOLYLINE 90 3 70 0 10 0 20 0 10 -10 20 5 10 -20 20 0 210 0 220 0 230 -1",
        // A corner twice, and extended data after it.
        "0 LWPOLYLINE 90 4 70 0 10 0 20 0 10 10 20 5 10 10 20 5 10 20 20 0 1001 ACAD 1040 7.5 1010 99 1020 99",
        &heavy("0", ""),
        &heavy("8", " 70 32"),
        "0 LINE 10 20 20 0 11 10 21 5 0 LINE 10 0 20 0 11 10 21 5",
        // As coded by hand: whole numbers with a point, lines of blanks around values.
        "0 LINE 62 256.0 10 0. 20 .0 11 1.0E+1 21 +5 0 LINE 10 10 20 5 11 2.0e1 21 -0",
    ] {
        assert_eq!(chain(groups), line, "{groups}");
    }
}

/// A half circle by a bulge, as drawn, from below, and in blocks: mirrored twice, once.
#[test]
fn bulges_turn_the_right_way() {
    let top = |points: &[(f64, f64)]| {
        let z = points.iter().map(|point| point.1);
        (z.clone().fold(0.0, f64::min), z.fold(0.0, f64::max))
    };
    let half = |bulge: f64| format!("LWPOLYLINE 8 0 90 2 70 0 10 0 20 0 42 {bulge} 10 20 20 0");
    let near = |found: (f64, f64), low: f64, high: f64| {
        assert!(
            (found.0 - low).abs() < 2e-3 && (found.1 - high).abs() < 2e-3,
            "{found:?}"
        );
    };
    // To the left of the way from left to right is up, so the arc to the left bulges down.
    near(top(&chain(&format!("0 {}", half(1.0)))), -10.0, 0.0);
    near(
        top(&chain(&format!("0 {} 210 0 220 0 230 -1", half(1.0)))),
        -10.0,
        0.0,
    );
    near(
        top(&chain(
            "0 POLYLINE 66 1 70 0 0 VERTEX 10 0 20 0 42 -1 0 VERTEX 10 20 20 0 0 SEQEND",
        )),
        0.0,
        10.0,
    );
    let nested = |outer: &str, inner: &str| {
        let blocks = format!(
            "0 BLOCK 2 A 0 INSERT 2 B 10 0 20 0 {inner} 0 ENDBLK 0 BLOCK 2 B 0 {} 0 ENDBLK",
            half(1.0)
        );
        let text = with_blocks(&blocks).replace("\n2\nA\n10\n0\n20\n0\n0\nENDSEC", &{
            let more: String = outer.split(' ').map(|part| format!("{part}\n")).collect();
            format!("\n2\nA\n10\n0\n20\n0\n{more}0\nENDSEC")
        });
        top(&rounded(&text))
    };
    near(nested("41 1", "42 -1"), 0.0, 10.0);
    near(nested("42 -1", "42 -1"), -10.0, 0.0);
    near(nested("41 -1 42 2", "42 -1"), 0.0, 20.0);
    near(nested("50 180", "41 1"), 0.0, 10.0);
}

/// A closed cubic with knots that are not repeated at its ends: it begins at (P0 + 4 P1 + P2) / 6 and ends there.
#[test]
fn periodic_splines_are_rings() {
    let corners = [(0, 0), (60, 0), (60, 30), (0, 30)];
    let control: String = (0..7)
        .map(|i| corners[i % 4])
        .map(|(x, y)| format!(" 10 {x} 20 {y} 30 0"))
        .collect();
    let knots: String = (0..11).map(|knot| format!(" 40 {}", knot - 3)).collect();
    for flags in [8, 11] {
        let found = chain(&format!(
            "0 SPLINE 70 {flags} 71 3 72 11 73 7 74 0{knots}{control}"
        ));
        let start = ((0.0 + 4.0 * 60.0 + 60.0) / 6.0, 5.0);
        assert_eq!(found[0], start);
        assert_eq!(found.last(), found.first());
        let top = found.iter().map(|point| point.1).fold(0.0, f64::max);
        // In the middle of a piece, (P0 + 23 P1 + 23 P2 + P3) / 48.
        assert!((top - 28.75).abs() < 2e-3, "{top}");
    }
}

/// A quarter circle as a rational spline: every point is on the circle.
#[test]
fn weights_of_splines_are_heeded() {
    let weight = 0.5_f64.sqrt();
    let spline = format!(
        "0 SPLINE 70 4 71 2 72 6 73 3 74 0 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 {weight} 41 1 \
         10 0 20 10 30 0 10 10 20 10 30 0 10 10 20 0 30 0"
    );
    let found = chain(&spline);
    assert!(found.len() > 20);
    assert!(
        found
            .iter()
            .all(|point| (libm::hypot(point.0, point.1) - 10.0).abs() < 2e-6)
    );
}

#[test]
fn other_things_are_listed_and_windows_of_sheets_are_not() {
    let kinds = [
        "3DFACE",
        "SOLID",
        "HATCH",
        "DIMENSION",
        "POINT",
        "MTEXT",
        "LEADER",
        "ATTDEF",
        "REGION",
        "MLINE",
    ];
    let others: String = kinds
        .map(|kind| format!("0 {kind} 8 SKIN 10 0 20 0 30 0 "))
        .concat();
    let text = entities(&format!("{others}0 VIEWPORT 67 1 8 0 10 0 20 0 {LINE}"));
    let drawing = dxf(&text, None).unwrap();
    assert_eq!(drawing.strokes.len(), 1);
    let listed: Vec<&str> = drawing.unread.iter().map(|unread| unread.kind.as_str()).collect();
    assert_eq!(listed, kinds);
}

#[test]
fn units_of_the_head_are_known() {
    let unit = |number: &str| {
        let text = format!(
            "0 SECTION 2 HEADER 9 $INSUNITS 70 {number} 0 ENDSEC 0 SECTION 2 ENTITIES 0 ENDSEC 0 EOF"
        );
        dxf(&file(&text), None).unwrap().unit
    };
    assert_eq!(unit("1"), Unit::Known(25.4));
    assert_eq!(unit("6"), Unit::Known(1000.0));
    assert!(matches!(unit("0"), Unit::Unsaid(_)));
    assert!(matches!(unit("18"), Unit::Unsaid(_)));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]
    /// Whatever becomes of a good file, it gives a drawing or a place in the text.
    #[test]
    fn damaged_files_never_fail_otherwise(
        at in 0..20_000usize, length in 0..40usize, put in "[-0-9a-zA-Z. \n]{0,12}",
    ) {
        let text = include_str!("../../../../tests/data/drawings/ezdxf.dxf");
        let start = at % text.len();
        let end = (start + length).min(text.len());
        let damaged = format!("{}{put}{}", &text[..start], &text[end..]);
        if let Err(error) = dxf(&damaged, Some("SKIN")) {
            prop_assert!(damaged.get(error.start as usize..error.end as usize).is_some());
        }
    }
}
