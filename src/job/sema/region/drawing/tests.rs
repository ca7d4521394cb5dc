//! Regions from drawings: what layers come to, and what is said where they do not form a region.

use crate::sema::kind::Operations;
use crate::sema::scope::Scope;
use crate::sema::session::Session;
use crate::sema::{files, gather, lets, overrides, region};
use core::f64::consts::PI;
use vcutc_diagnostics::source::{LoadError, Loader, SourceMap};
use vcutc_diagnostics::{Code, Diagnostic, Severity};
use vcutc_region::region::{Region, Side};

/// A job of one region, and the drawing beside it.
struct Folder {
    job: String,
    drawing: String,
}

impl Loader for Folder {
    fn load(&self, path: &str) -> Result<Vec<u8>, LoadError> {
        match path {
            "job.vcut" => Ok(self.job.clone().into_bytes()),
            "tray.dxf" | "tray.svg" => Ok(self.drawing.clone().into_bytes()),
            _ => Err(LoadError::NotFound),
        }
    }
}

struct Outcome {
    region: Option<Region>,
    diagnostics: Vec<Diagnostic>,
    sources: SourceMap,
}

fn checked(entries: &str, drawing: &str) -> Outcome {
    let folder = Folder {
        job: format!("region seat {{ {entries} }}\n"),
        drawing: drawing.to_owned(),
    };
    let mut sources = SourceMap::default();
    let mut session = Session::new(&folder, &mut sources);
    let files = files::load("job.vcut", &mut session).unwrap();
    let overrides = overrides::read(&[], &[], &mut session);
    let all = gather::gather(&files, &overrides, Operations::default(), &mut session);
    let values = lets::evaluate(&all.lets, &all.names, &mut session.reports);
    let scope = Scope {
        names: &all.names,
        lets: &all.lets,
        values: &values,
        variables: &[],
    };
    let (name, placed) = all.regions.first().copied().unwrap();
    let found = region::check(name, placed.block, placed.place, scope, &mut session);
    let diagnostics = session.reports.into_vec();
    Outcome {
        region: found.ok().map(|named| Region::clone(&named.region)),
        diagnostics,
        sources,
    }
}

/// The region of a drawing that is one, and its area.
fn region_of(entries: &str, drawing: &str) -> (Region, f64) {
    let outcome = checked(entries, drawing);
    let region = outcome
        .region
        .unwrap_or_else(|| panic!("{:?}", outcome.diagnostics));
    let is_error = |diagnostic: &&Diagnostic| diagnostic.severity() == Severity::Error;
    assert_eq!(outcome.diagnostics.iter().find(is_error), None);
    let area = region.area();
    (region, area)
}

/// What is said of a drawing: the one error, with what each of its places points at.
fn reported(entries: &str, drawing: &str) -> (Code, String) {
    let outcome = checked(entries, drawing);
    assert!(outcome.region.is_none(), "a region all the same");
    let is_error = |diagnostic: &&Diagnostic| diagnostic.severity() == Severity::Error;
    let errors: Vec<&Diagnostic> = outcome.diagnostics.iter().filter(is_error).collect();
    let [error] = errors.as_slice() else {
        panic!("{errors:?}");
    };
    let mut lines = vec![error.message.clone()];
    for label in [&error.primary].into_iter().chain(&error.secondary) {
        let file = outcome.sources.get(label.span.file).unwrap();
        let text = file.text.get(label.span.start as usize..label.span.end as usize);
        let first = text.unwrap().lines().next().unwrap_or_default();
        lines.push(format!("{} `{first}`: {}", file.name, label.text));
    }
    lines.extend(error.notes.iter().map(|note| format!("note: {note}")));
    lines.extend(error.help.iter().map(|help| format!("help: {help}")));
    lines.extend(error.fixes.iter().map(|fix| format!("fix: {}", fix.title)));
    (error.code, lines.join("\n"))
}

fn codes(outcome: &Outcome) -> Vec<Code> {
    outcome.diagnostics.iter().map(|found| found.code).collect()
}

/// A DXF in mm with these groups in its section ENTITIES, written `code value code value`.
fn dxf(groups: &str) -> String {
    let whole =
        format!("0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 ENTITIES {groups} 0 ENDSEC 0 EOF");
    whole.split_whitespace().map(|part| format!("{part}\n")).collect()
}

fn polyline(layer: &str, corners: &[(f64, f64)], closed: u8) -> String {
    let corners: Vec<String> = corners.iter().map(|(x, y)| format!("10 {x} 20 {y}")).collect();
    let count = corners.len();
    format!(
        "0 LWPOLYLINE 8 {layer} 90 {count} 70 {closed} {}",
        corners.join(" ")
    )
}

fn line(layer: &str, from: (f64, f64), to: (f64, f64)) -> String {
    format!(
        "0 LINE 8 {layer} 10 {} 20 {} 11 {} 21 {}",
        from.0, from.1, to.0, to.1
    )
}

fn tray() -> String {
    let outline = polyline("SEAT", &[(0.0, 0.0), (0.0, 40.0), (80.0, 40.0), (80.0, 0.0)], 1);
    format!("{outline} 0 CIRCLE 8 SEAT 10 20 20 20 40 5")
}

const SEAT: &str = "dxf \"tray.dxf\" { layer = \"SEAT\" }";

#[test]
fn outlines_have_their_islands_and_arcs_stay_arcs() {
    let (region, area) = region_of(SEAT, &dxf(&tray()));
    assert!((area - (3200.0 - 25.0 * PI)).abs() < 1e-9);
    assert_eq!(region.loops().len(), 2);
    let turned: f64 = region.edges().map(|edge| edge.piece.sweep).sum();
    assert!((turned + 2.0 * PI).abs() < 1e-12);
    // An outline in the island, one beside it that touches in a point, and all of it twice.
    let more = [
        tray(),
        polyline("SEAT", &[(18.0, 18.0), (22.0, 18.0), (20.0, 22.0)], 1),
        polyline("SEAT", &[(80.0, 40.0), (90.0, 40.0), (90.0, 50.0)], 1),
        tray(),
    ];
    let (region, more) = region_of(SEAT, &dxf(&more.join(" ")));
    assert!(
        (more - area - 8.0 - 50.0).abs() < 1e-9,
        "{more} {area} {region:?}"
    );
    assert_eq!(region.loops().len(), 4);
}

#[test]
fn drawings_are_scaled_and_shifted() {
    let entries = "dxf \"tray.dxf\" { layer = \"SEAT\", unit = cm, scale = 0.5, x = 100 mm, y = -7 mm }";
    let (region, area) = region_of(entries, &dxf(&tray()));
    assert!((area - 25.0 * (3200.0 - 25.0 * PI)).abs() < 1e-6);
    let corner = region.loops()[0].iter().map(|edge| edge.piece.from);
    let low = corner.fold((f64::INFINITY, f64::INFINITY), |low, at| {
        (low.0.min(at.x), low.1.min(at.y))
    });
    assert!((low.0 - 100.0).abs() < 1e-9 && (low.1 + 7.0).abs() < 1e-9);
}

#[test]
fn layers_of_svgs_are_regions_too() {
    let text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100mm\" height=\"80mm\" viewBox=\"0 0 100 80\">\
                <g id=\"SEAT\"><path d=\"M10 10 H70 V50 H10 Z\"/><circle cx=\"30\" cy=\"30\" r=\"8\"/></g>\
                <path id=\"NOTES\" d=\"M0 0 L5 5\"/></svg>";
    let (region, area) = region_of("svg \"tray.svg\" { layer = \"SEAT\", y = 5 mm }", text);
    assert!((area - (2400.0 - 64.0 * PI)).abs() < 1e-6);
    // y points down in the file, and 0 is the lower edge of the page.
    let highest = region.edges().map(|edge| edge.piece.from.y).fold(0.0, f64::max);
    assert!((highest - 75.0).abs() < 1e-9);
}

#[test]
fn lines_of_another_layer_open_sides() {
    let open = line("SEAT_OPEN", (80.0, 40.004), (80.0, 0.0));
    let entries = "dxf \"tray.dxf\" { layer = \"SEAT\", open = \"seat_open\" }";
    let (region, _) = region_of(entries, &dxf(&format!("{} {open}", tray())));
    let open: Vec<_> = region.edges().filter(|edge| edge.side == Side::Open).collect();
    assert_eq!(open.len(), 1);
    assert!((open[0].piece.from.x - 80.0).abs() < 1e-12 && (open[0].piece.to.x - 80.0).abs() < 1e-12);
}

#[test]
fn chains_that_are_open_say_where_and_by_how_much() {
    let gap = format!(
        "{} {} {}",
        tray(),
        polyline("SEAT", &[(41.2, 25.64), (60.0, 26.0), (60.0, 10.0)], 0),
        polyline("SEAT", &[(60.0, 10.0), (41.2, 10.0), (41.2, 26.0)], 0)
    );
    let (code, text) = reported(SEAT, &dxf(&gap));
    assert_eq!(code, Code::RegionTangled);
    assert_eq!(
        text,
        "layer `SEAT` of `tray.dxf` has 2 loops and one open chain: it ends at (41.2 mm, 26 mm), 0.36 mm from its beginning\n\
         job.vcut `\"SEAT\"`: a region takes closed loops only\n\
         tray.dxf `LWPOLYLINE`: one side of the gap\n\
         tray.dxf `LWPOLYLINE`: the other side of the gap\n\
         help: close the gap in the drawing, or join over it with `tolerance = 0.36 mm`"
    );
    let wider = "dxf \"tray.dxf\" { layer = \"SEAT\", tolerance = 0.36 mm }";
    assert_eq!(region_of(wider, &dxf(&gap)).0.loops().len(), 3);
    let (_, text) = reported(
        "dxf \"tray.dxf\"",
        &dxf(&format!(
            "{} {}",
            line("A", (0.0, 0.0), (9.0, 0.0)),
            line("B", (9.5, 0.0), (9.5, 9.0))
        )),
    );
    assert_eq!(
        text,
        "`tray.dxf` has no loop and 2 open chains: the nearest two ends are 0.5 mm apart, at (9 mm, 0 mm)\n\
         job.vcut `\"tray.dxf\"`: a region takes closed loops only\n\
         tray.dxf `LINE`: one side of the gap\n\
         tray.dxf `LINE`: the other side of the gap\n\
         note: from (0 mm, 0 mm) to (9 mm, 0 mm): LINE\n\
         note: from (9.5 mm, 0 mm) to (9.5 mm, 9 mm): LINE\n\
         note: the layers of `tray.dxf` are `A` (1 line), `B` (1 line)\n\
         help: close the loops in the drawing, or move other lines to another layer\n\
         help: say which layer the outline is on, like `layer = \"SEAT\"`"
    );
}

#[test]
fn lines_that_branch_are_named() {
    let branch = format!(
        "{} {}",
        line("SEAT", (0.0, 0.0), (9.0, 0.0)),
        polyline("SEAT", &[(9.0, 5.0), (9.0, 0.0)], 0)
    );
    let (code, text) = reported(
        SEAT,
        &dxf(&format!("{branch} {}", line("SEAT", (9.0, 0.0), (20.0, 0.0)))),
    );
    assert_eq!(code, Code::BrokenOutline);
    assert_eq!(
        text,
        "the outline in layer `SEAT` of `tray.dxf` branches at (9 mm, 0 mm)\n\
         job.vcut `\"SEAT\"`: 3 lines meet there\n\
         tray.dxf `LINE`: one of them\n\
         tray.dxf `LWPOLYLINE`: one of them\n\
         tray.dxf `LINE`: one of them\n\
         help: delete the lines that are not part of the outline\n\
         help: draw loops that touch in a point as one closed polyline each"
    );
}

#[test]
fn loops_that_cross_are_shown_in_the_drawing() {
    let crossing = format!("{} 0 CIRCLE 8 SEAT 10 80 20 20 40 5", tray());
    let (code, text) = reported(SEAT, &dxf(&crossing));
    assert_eq!(code, Code::RegionTangled);
    let lines: Vec<&str> = text.lines().collect();
    assert!(
        lines[0].starts_with("two sides of the region cross at (80 mm, "),
        "{text}"
    );
    let mut labels = [lines[1], lines[2]].map(|line| line.split(':').next().unwrap_or_default());
    labels.sort_unstable();
    assert_eq!(labels, ["tray.dxf `CIRCLE`", "tray.dxf `LWPOLYLINE`"], "{text}");
    assert_eq!(lines[3], "job.vcut `\"tray.dxf\"`: the drawing is named here");
}

#[test]
fn lines_that_open_no_side_are_named() {
    let of = |mark: &str| {
        let entries = "dxf \"tray.dxf\" { layer = \"SEAT\", open = \"OPEN\" }";
        reported(entries, &dxf(&format!("{} {mark}", tray()))).1
    };
    assert_eq!(
        of(&line("OPEN", (80.5, 0.0), (80.5, 40.0))),
        "the LINE in layer `OPEN` of `tray.dxf` from (80.5 mm, 0 mm) to (80.5 mm, 40 mm) lies on no side\n\
         job.vcut `\"OPEN\"`: marks sides of the loops\n\
         tray.dxf `LINE`: this line\n\
         help: draw it from end to end over straight sides, within 0.01 mm; or delete it"
    );
    assert_eq!(
        of(&line("OPEN", (80.0, 0.0), (80.0, 25.0))),
        "the LINE in layer `OPEN` of `tray.dxf` from (80 mm, 0 mm) to (80 mm, 25 mm) covers only a part of a side\n\
         job.vcut `\"OPEN\"`: marks whole sides\n\
         tray.dxf `LINE`: this line\n\
         tray.dxf `LWPOLYLINE`: this side leads from (80 mm, 40 mm) to (80 mm, 0 mm)\n\
         help: draw the line from end to end, or end the side where it stops being open"
    );
    assert!(
        of("0 CIRCLE 8 OPEN 10 20 20 20 40 5")
            .starts_with("a curve in layer `OPEN` of `tray.dxf` marks an open side")
    );
    assert!(of("").starts_with("there is no layer `OPEN` in `tray.dxf`"));
    let alone = reported("dxf \"tray.dxf\" { open = \"OPEN\" }", &dxf(&tray()));
    assert_eq!(
        alone.1,
        "`open` needs `layer`\n\
         job.vcut `\"OPEN\"`: the whole drawing would include these lines\n\
         fix: name the layer of the loops, like `layer = \"SEAT\"`"
    );
}

#[test]
fn a_drawing_is_all_of_its_region() {
    let beside = reported(
        &format!("{SEAT} circle (10 mm, 10 mm) radius 2 mm"),
        &dxf(&tray()),
    );
    assert_eq!(
        beside.1,
        "a drawing is the whole region\n\
         job.vcut `circle (10 mm, 10 mm) radius 2 mm`: cannot be joined to it\n\
         job.vcut `dxf \"tray.dxf\" { layer = \"SEAT\" }`: the drawing\n\
         help: draw this on the layer of the drawing, or as a region of its own"
    );
    let within = reported(
        &format!("circle (10 mm, 10 mm) radius 9 mm island {{ {SEAT} }}"),
        &dxf(&tray()),
    );
    assert!(
        within.1.starts_with("`dxf` does not belong in `island`"),
        "{}",
        within.1
    );
}

#[test]
fn what_holds_of_drawings_of_profiles_holds_here() {
    let unsaid = dxf(&tray()).replace("$INSUNITS\n70\n4\n", "$INSUNITS\n70\n0\n");
    let (code, text) = reported(SEAT, &unsaid);
    assert_eq!(code, Code::UnknownScale);
    assert!(text.contains("fix: state it, for example `unit = mm`"), "{text}");
    let layer = reported("dxf \"tray.dxf\" { layer = \"SEET\" }", &dxf(&tray()));
    assert_eq!(layer.0, Code::UnknownLayer);
    assert!(layer.1.contains("fix: did you mean `SEAT`?"), "{}", layer.1);
    let noted = checked(
        SEAT,
        &dxf(&format!("{} 0 TEXT 8 SEAT 10 0 20 0 40 2 1 A", tray())),
    );
    assert_eq!(codes(&noted), [Code::PartlyRead]);
    let partly = format!("{} {}", tray(), line("SEAT", (10.0, 0.0), (60.0, 0.0)));
    assert_eq!(reported(SEAT, &dxf(&partly)).0, Code::DrawnOver);
    let field = checked(
        "dxf \"tray.dxf\" { layer = \"SEAT\", side = upper }",
        &dxf(&tray()),
    );
    assert_eq!(codes(&field), [Code::UnknownField]);
}
