//! STEP files written in the manners of several systems, and read again; trims; damage.

use super::*;
use core::fmt::Write as _;
use proptest::prelude::*;
use vcutc_backend_api::geometry::Point3;

/// A number as STEP files have it.
fn real(value: f64) -> String {
    let text = format!("{value:?}").to_uppercase();
    match text.split_once('E') {
        Some((mantissa, exponent)) if !mantissa.contains('.') => format!("{mantissa}.E{exponent}"),
        Some(_) => text,
        None => text
            .strip_suffix('0')
            .filter(|text| text.ends_with('.'))
            .unwrap_or(&text)
            .to_owned(),
    }
}

fn list(items: impl IntoIterator<Item = String>) -> String {
    format!("({})", items.into_iter().collect::<Vec<_>>().join(","))
}

/// Knots once each, and how often they count.
fn multiplicities(knots: &[f64]) -> (String, String) {
    let mut distinct: Vec<(f64, usize)> = Vec::new();
    for &knot in knots {
        match distinct.last_mut() {
            Some((last, times)) if *last == knot => *times += 1,
            _ => distinct.push((knot, 1)),
        }
    }
    (
        list(distinct.iter().map(|(_, times)| times.to_string())),
        list(distinct.iter().map(|(knot, _)| real(*knot))),
    )
}

/// How entities of several kinds are written.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Manner {
    /// Each in one record, edges in wrappers with their parametric curves left out: as Open CASCADE does.
    Simple,
    /// Several records in brackets, lines broken anywhere: as NX and CATIA do.
    Complex,
}

struct Writer {
    text: String,
    last: usize,
    manner: Manner,
}

impl Writer {
    fn new(manner: Manner) -> Self {
        let text = String::from(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('a part; not #1=A(), but it''s a text'),'2;1');\n\
             FILE_NAME('part.stp','2024-01-01T00:00:00',(''),(''),'','','');\n\
             FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\n/* made by a test */\nDATA;\n",
        );
        Self {
            text,
            last: 10,
            manner,
        }
    }

    fn add(&mut self, body: &str) -> usize {
        self.last += 1;
        writeln!(self.text, "#{}={body};", self.last).unwrap();
        self.last
    }

    fn point(&mut self, p: Point3) -> usize {
        self.add(&format!("CARTESIAN_POINT('',{})", list(p.to_array().map(real))))
    }

    fn vertex(&mut self, p: Point3) -> usize {
        let point = self.point(p);
        self.add(&format!("VERTEX_POINT('',#{point})"))
    }

    fn surface(&mut self, surface: &Nurbs) -> usize {
        let columns = surface.knots[1].len() - surface.degrees[1] - 1;
        let points: Vec<usize> = surface.control.iter().map(|&p| self.point(p)).collect();
        let rows = list(
            points
                .chunks(columns)
                .map(|row| list(row.iter().map(|id| format!("#{id}")))),
        );
        let [(mu, ku), (mv, kv)] = [0, 1].map(|i| multiplicities(&surface.knots[i]));
        let [p, q] = surface.degrees;
        let flags = ".UNSPECIFIED.,.F.,.F.,.F.";
        if surface.weights.is_empty() && self.manner == Manner::Simple {
            let body = format!("'',{p},{q},{rows},{flags},{mu},{mv},{ku},{kv},.UNSPECIFIED.");
            return self.add(&format!("B_SPLINE_SURFACE_WITH_KNOTS({body})"));
        }
        let weights = list(
            surface
                .weights
                .chunks(columns)
                .map(|row| list(row.iter().map(|w| real(*w)))),
        );
        let rational = match surface.weights.is_empty() {
            true => String::new(),
            false => format!("\nRATIONAL_B_SPLINE_SURFACE({weights})"),
        };
        self.add(&format!(
            "(\nBOUNDED_SURFACE()\nB_SPLINE_SURFACE({p},{q},{rows},\n{flags})\nB_SPLINE_SURFACE_WITH_KNOTS({mu},{mv},{ku},{kv},\
             .UNSPECIFIED.)\nGEOMETRIC_REPRESENTATION_ITEM(){rational}\nREPRESENTATION_ITEM('')\nSURFACE()\n)"
        ))
    }

    fn curve(&mut self, curve: &crate::patch::Curve) -> usize {
        let points: Vec<usize> = curve.control.iter().map(|&p| self.point(p)).collect();
        let points = list(points.iter().map(|id| format!("#{id}")));
        let (times, knots) = multiplicities(&curve.knots);
        let (degree, flags) = (curve.degree, ".UNSPECIFIED.,.F.,.F.");
        let curve = if curve.weights.is_empty() {
            self.add(&format!(
                "B_SPLINE_CURVE_WITH_KNOTS('',{degree},{points},{flags},{times},{knots},.UNSPECIFIED.)"
            ))
        } else {
            let weights = list(curve.weights.iter().map(|w| real(*w)));
            self.add(&format!(
                "( BOUNDED_CURVE() B_SPLINE_CURVE({degree},{points},{flags}) B_SPLINE_CURVE_WITH_KNOTS({times},{knots},.UNSPECIFIED.) \
                 CURVE() GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE({weights}) REPRESENTATION_ITEM('') )"
            ))
        };
        match self.manner {
            Manner::Simple => self.add(&format!("SURFACE_CURVE('',#{curve},(),.PCURVE_S1.)")),
            Manner::Complex => curve,
        }
    }

    /// A face of edges along these curves, each followed from its start to its end or the other way.
    fn face(&mut self, surface: usize, edges: &[Side]) -> usize {
        let ends = edges
            .iter()
            .map(|edge| [edge.curve.control[0], *edge.curve.control.last().unwrap()]);
        let ends: Vec<[Point3; 2]> = ends.collect();
        let mut oriented = Vec::new();
        for (edge, ends) in edges.iter().zip(ends) {
            let curve = self.curve(&edge.curve);
            let [start, end] = edge.vertices.unwrap_or(ends).map(|p| self.vertex(p));
            let id = self.add(&format!("EDGE_CURVE('',#{start},#{end},#{curve},.T.)"));
            let sense = if edge.is_forward { "T" } else { "F" };
            oriented.push(self.add(&format!("ORIENTED_EDGE('',*,*,#{id},.{sense}.)")));
        }
        let edges = list(oriented.iter().map(|id| format!("#{id}")));
        let around = self.add(&format!("EDGE_LOOP('',{edges})"));
        let bound = self.add(&format!("FACE_OUTER_BOUND('',#{around},.T.)"));
        let face = self.add(&format!("ADVANCED_FACE('',(#{bound}),#{surface},.T.)"));
        self.add(&format!("OPEN_SHELL('',(#{face}))"))
    }

    fn unit(&mut self, unit: &str) {
        let length = match unit {
            "mm" => self.add("( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )"),
            "m" => self.add("(NAMED_UNIT(*)LENGTH_UNIT()SI_UNIT($,.METRE.))"),
            _ => {
                let mm = self.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
                let factor = self.add(&format!("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#{mm})"));
                let dimensions = self.add("DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
                self.add(&format!(
                    "(CONVERSION_BASED_UNIT('INCH',#{factor})LENGTH_UNIT()NAMED_UNIT(#{dimensions}))"
                ))
            }
        };
        let angle = self.add("( NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.) )");
        self.add(&format!(
            "( GEOMETRIC_REPRESENTATION_CONTEXT(3)\nGLOBAL_UNIT_ASSIGNED_CONTEXT((#{length},#{angle})) REPRESENTATION_CONTEXT('','3D') )"
        ));
    }

    fn end(self) -> String {
        self.text + "ENDSEC;\nEND-ISO-10303-21;\n"
    }
}

/// An edge along a side of a surface.
#[derive(Clone, Debug)]
struct Side {
    curve: crate::patch::Curve,
    is_forward: bool,
    /// Other vertices than the ends of the curve.
    vertices: Option<[Point3; 2]>,
}

/// The sides of a clamped surface, once around.
fn sides(surface: &Nurbs) -> Vec<Side> {
    let counts = [0, 1].map(|i| surface.knots[i].len() - surface.degrees[i] - 1);
    let of = |direction: usize, indices: Vec<usize>, is_forward: bool| Side {
        curve: crate::patch::Curve {
            degree: surface.degrees[direction],
            knots: surface.knots[direction].clone(),
            control: indices.iter().map(|&i| surface.control[i]).collect(),
            weights: indices
                .iter()
                .filter_map(|&i| surface.weights.get(i).copied())
                .collect(),
        },
        is_forward,
        vertices: None,
    };
    let row = |row: usize| (0..counts[1]).map(|j| row * counts[1] + j).collect();
    let column = |column: usize| (0..counts[0]).map(|i| i * counts[1] + column).collect();
    vec![
        of(1, row(0), true),
        of(0, column(counts[1] - 1), true),
        of(1, row(counts[0] - 1), false),
        of(0, column(0), false),
    ]
}

fn whole(surface: &Nurbs, manner: Manner, unit: &str) -> String {
    let mut writer = Writer::new(manner);
    let id = writer.surface(surface);
    writer.face(id, &sides(surface));
    writer.unit(unit);
    writer.end()
}

fn read(text: &str) -> Result<ReadStep, StepError> {
    let mut step = Step::scan(text.as_bytes())?;
    let unit = step.unit()?.unwrap_or(Length::mm(1.0));
    step.surfaces(unit)
}

/// Surfaces with clamped knots over squares of about 20 mm, with weights or without.
fn surfaces() -> impl Strategy<Value = Nurbs> {
    (1..4usize, 1..4usize, 0..3usize, 0..3usize, any::<bool>()).prop_flat_map(
        |(p, q, more_u, more_v, rational)| {
            let (rows, columns) = (p + 1 + more_u, q + 1 + more_v);
            let count = rows * columns;
            let steps = |more: usize| prop::collection::vec(0.1..3.0f64, more + 1);
            let weights = prop::collection::vec(0.2..4.0f64, if rational { count } else { 0 });
            (
                steps(more_u),
                steps(more_v),
                prop::collection::vec(-5.0..5.0f64, 3 * count),
                weights,
            )
                .prop_map(move |(steps_u, steps_v, off, weights)| {
                    let knots = |degree: usize, steps: &[f64]| {
                        let mut knots = vec![0.0; degree + 1];
                        let mut sum = 0.0;
                        for step in steps {
                            sum += step;
                            knots.push(sum);
                        }
                        knots.extend(vec![sum; degree]);
                        knots
                    };
                    let control = (0..count).map(|k| {
                        let (x, y) = (20.0 * (k / columns) as f64, 20.0 * (k % columns) as f64);
                        Point3::new(x + off[3 * k], y + off[3 * k + 1], 50.0 + off[3 * k + 2])
                    });
                    Nurbs {
                        degrees: [p, q],
                        knots: [knots(p, &steps_u), knots(q, &steps_v)],
                        control: control.collect(),
                        weights,
                    }
                })
        },
    )
}

fn scaled(surface: &Nurbs, factor: f64) -> Nurbs {
    let control = surface
        .control
        .iter()
        .map(|p| p.to_array().map(|part| part * factor).into());
    Nurbs {
        control: control.collect(),
        ..surface.clone()
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn what_is_written_is_read(
        surface in surfaces(), turns in 0..4usize, reversed in any::<bool>(),
        manner in prop::sample::select(vec![Manner::Simple, Manner::Complex]),
        (unit, size) in prop::sample::select(vec![("mm", 1.0), ("m", 1000.0), ("inch", 25.4)]),
    ) {
        // Edges may begin anywhere and turn either way.
        let mut edges = sides(&surface);
        edges.rotate_left(turns);
        if reversed {
            edges.reverse();
            edges.iter_mut().for_each(|edge| edge.is_forward = !edge.is_forward);
        }
        let mut writer = Writer::new(manner);
        let id = writer.surface(&surface);
        writer.face(id, &edges);
        writer.unit(unit);
        let text = writer.end();
        prop_assert_eq!(Step::scan(text.as_bytes()).unwrap().unit().unwrap(), Some(Length::mm(size)));
        let found = read(&text);
        prop_assert_eq!(found.map(|found| found.surfaces), Ok(vec![scaled(&surface, size)]), "{}", text);
    }

    #[test]
    fn edges_off_the_border_are_trims(surface in surfaces(), side in 0..4usize, by in 0.0..0.1f64) {
        // A point of control of one side moved, without its ends: the curve moves by up to as much.
        let mut edges = sides(&surface);
        let control = &mut edges[side].curve.control;
        prop_assume!(control.len() > 2);
        let middle = control.len() / 2;
        control[middle].z += by;
        let mut writer = Writer::new(Manner::Complex);
        let id = writer.surface(&surface);
        writer.face(id, &edges);
        let fine = Length::mm(1e-3);
        let curve = crate::patch::polyline(&edges[side].curve, fine).unwrap();
        let border = crate::patch::border(&surface, fine).unwrap();
        let off = |point: &Point3| crate::polyline::nearest(&border, *point).unwrap().1;
        let most = curve.iter().step_by(curve.len() / 50 + 1).map(off).fold(0.0, f64::max);
        match read(&writer.end()) {
            Ok(_) => prop_assert!(most <= face::TRIMMED + 0.002, "{most}"),
            Err(error) => {
                prop_assert!(by >= 0.005, "{by}: {}", error.place.message);
                prop_assert_eq!(error.advice, Advice::Untrim);
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]
    #[test]
    fn damaged_files_are_refused_or_read(
        surface in surfaces(), places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..5u8), 1..4),
    ) {
        for manner in [Manner::Simple, Manner::Complex] {
            let mut bytes = whole(&surface, manner, "inch").into_bytes();
            for (place, byte, how) in &places {
                let at = place.index(bytes.len());
                match how {
                    0 => bytes[at] = *byte,
                    1 => drop(bytes.remove(at)),
                    2 => bytes.insert(at, *byte),
                    3 => bytes[at] = b"0123456789#().,;'*$E-"[usize::from(*byte) % 21],
                    _ => bytes.truncate(at.max(1)),
                }
            }
            if let Err(error) = Step::scan(&bytes).and_then(|mut step| {
                let unit = step.unit()?.unwrap_or(Length::mm(1.0));
                step.surfaces(unit)
            }) {
                let DataError { start, end, message } = error.place;
                prop_assert!(start <= end && end as usize <= bytes.len(), "{start}..{end}: {message}");
                prop_assert!(!message.is_empty());
            }
        }
    }
}

/// A bilinear patch of 60 by 80 mm, its v along y.
fn plain() -> Nurbs {
    Nurbs {
        degrees: [1, 1],
        knots: [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 1.0, 1.0]],
        control: [
            [0.0, 0.0, 20.0],
            [0.0, 80.0, 22.0],
            [60.0, 0.0, 24.0],
            [60.0, 80.0, 30.0],
        ]
        .map(Point3::from)
        .to_vec(),
        weights: Vec::new(),
    }
}

fn straight(from: Point3, to: Point3) -> Side {
    Side {
        curve: crate::patch::Curve {
            degree: 1,
            knots: vec![0.0, 0.0, 1.0, 1.0],
            control: vec![from, to],
            weights: Vec::new(),
        },
        is_forward: true,
        vertices: None,
    }
}

fn with_edges(edges: &[Side]) -> Result<ReadStep, StepError> {
    let mut writer = Writer::new(Manner::Simple);
    let id = writer.surface(&plain());
    writer.face(id, edges);
    read(&writer.end())
}

fn around(corners: &[[f64; 3]]) -> Vec<Side> {
    let next = corners.iter().cycle().skip(1);
    corners
        .iter()
        .zip(next)
        .map(|(a, b)| straight((*a).into(), (*b).into()))
        .collect()
}

#[test]
fn edges_may_divide_a_side_and_trims_are_not_ignored() {
    let [a, b, c, d] = [
        [0.0, 0.0, 20.0],
        [0.0, 80.0, 22.0],
        [60.0, 80.0, 30.0],
        [60.0, 0.0, 24.0],
    ];
    let middle = [0.0, 40.0, 21.0];
    assert!(with_edges(&around(&[a, b, c, d])).is_ok());
    assert!(with_edges(&around(&[middle, b, c, d, a])).is_ok());
    assert!(with_edges(&around(&[a, middle, b, c, d])).is_ok());
    // Half of the face; a corner cut off; three sides and back; twice around; along one side and back.
    let half = [[30.0, 0.0, 22.0], [30.0, 80.0, 26.0]];
    for trim in [
        vec![a, b, half[1], half[0]],
        vec![
            a,
            b,
            c,
            [60.0, 1.0, 24.0 + 6.0 / 80.0],
            [59.0, 0.0, 20.0 + 59.0 / 15.0],
        ],
        vec![a, b, c, b],
        vec![a, b, c, d, a, b, c, d],
        vec![a, b],
    ] {
        let error = with_edges(&around(&trim)).unwrap_err();
        assert_eq!(error.advice, Advice::Untrim, "{trim:?}");
        assert!(error.place.message.contains("trimmed"), "{}", error.place.message);
    }
    let hole = with_edges(&around(&[a, b, [60.0, 80.0, 30.5], d])).unwrap_err();
    assert!(
        hole.place.message.contains("off the border"),
        "{}",
        hole.place.message
    );
}

#[test]
fn longer_curves_are_cut_at_their_vertices() {
    let [a, b, c, d] = [
        [0.0, 0.0, 20.0],
        [0.0, 80.0, 22.0],
        [60.0, 80.0, 30.0],
        [60.0, 0.0, 24.0],
    ];
    let mut edges = around(&[a, b, c, d]);
    // The first curve goes on beyond both of its vertices.
    let beyond = straight([0.0, -40.0, 19.0].into(), [0.0, 160.0, 24.0].into());
    edges[0] = Side {
        vertices: Some([a.into(), b.into()]),
        ..beyond.clone()
    };
    assert!(with_edges(&edges).is_ok());
    edges[0] = Side {
        vertices: Some([[0.0, -1.0, 20.0].into(), b.into()]),
        ..beyond
    };
    let error = with_edges(&edges).unwrap_err();
    assert!(
        error.place.message.contains("vertices"),
        "{}",
        error.place.message
    );
}

fn entities(body: &str) -> String {
    format!("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n{body}ENDSEC;\nEND-ISO-10303-21;\n")
}

/// Four points, as #1 to #4.
const CORNERS: &str = "#1=CARTESIAN_POINT('',(0.,0.,20.));#2=CARTESIAN_POINT('',(0.,80.,22.));\
    #3=CARTESIAN_POINT('',(60.,0.,24.));#4=CARTESIAN_POINT('',(60.,80.,30.));\n";

#[test]
fn knots_may_be_implied() {
    let rows = "((#1,#2),(#3,#4))";
    for kind in ["BEZIER_SURFACE", "QUASI_UNIFORM_SURFACE", "UNIFORM_SURFACE"] {
        let text = entities(&format!(
            "{CORNERS}#5={kind}('',1,1,{rows},.UNSPECIFIED.,.F.,.F.,.F.);\n"
        ));
        let [surface] = <[Nurbs; 1]>::try_from(read(&text).unwrap().surfaces).unwrap();
        let expected = match kind {
            "UNIFORM_SURFACE" => vec![-1.0, 0.0, 1.0, 2.0],
            _ => vec![0.0, 0.0, 1.0, 1.0],
        };
        assert_eq!(surface.knots, [expected.clone(), expected], "{kind}");
        assert_eq!(surface.control, plain().control);
    }
    // Two quadratic pieces in u.
    let rows = "((#1,#2),(#3,#4),(#1,#2),(#3,#4),(#1,#2))";
    let text = entities(&format!(
        "{CORNERS}#5=BEZIER_SURFACE('',2,1,{rows},.UNSPECIFIED.,.F.,.F.,.F.);\n"
    ));
    let found = read(&text).unwrap().surfaces;
    assert_eq!(found[0].knots[0], [0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
    let quasi = text.replace("BEZIER", "QUASI_UNIFORM");
    assert_eq!(
        read(&quasi).unwrap().surfaces[0].knots[0],
        [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 3.0, 3.0]
    );
}

/// The message and the text that it points at.
fn fault_of(text: &str) -> (String, String) {
    let StepError { place, .. } = read(text).unwrap_err();
    let at = &text[place.start as usize..place.end as usize];
    (place.message, at.to_owned())
}

#[test]
fn faults_are_shown_at_their_places() {
    let spline = |body: &str| entities(&format!("{CORNERS}#5=B_SPLINE_SURFACE_WITH_KNOTS('',{body});\n"));
    let flags = ".UNSPECIFIED.,.F.,.F.,.F.";
    let rows = "((#1,#2),(#3,#4))";
    let knots = "(2,2),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED.";
    assert!(read(&spline(&format!("1,1,{rows},{flags},{knots}"))).is_ok());
    for (body, at) in [
        (format!("1,99,{rows},{flags},{knots}"), "99"),
        (format!("1,2,{rows},{flags},{knots}"), "("),
        (format!("1,1,((#1,#2),(#3)),{flags},{knots}"), "("),
        (format!("1,1,((#1,#2),(#3,#44)),{flags},{knots}"), "#44"),
        (format!("1,1,((#1,#2),(#3,4)),{flags},{knots}"), "4"),
        (
            format!("1,1,{rows},{flags},(2,3),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED."),
            "3",
        ),
        (
            format!("1,1,{rows},{flags},(2,1),(2,2),(0.,1.),(0.,1.),.UNSPECIFIED."),
            "(",
        ),
        (
            format!("1,1,{rows},{flags},(2,2),(2,2),(0.,0.),(0.,1.),.UNSPECIFIED."),
            "0.",
        ),
        (
            format!("1,1,{rows},{flags},(2,2),(2,2),(0.,1.)"),
            "B_SPLINE_SURFACE_WITH_KNOTS",
        ),
        (
            format!("1,1,{rows},{flags},(2,2),(2,2),(0.,1.),(0.,.T.),.UNSPECIFIED."),
            ".T.",
        ),
    ] {
        let (message, found) = fault_of(&spline(&body));
        assert_eq!(found, at, "{message}");
    }
    for (text, at) in [
        ("solid part\n".to_owned(), "solid part\n"),
        (entities("#1=A(((((((((((((1)))))))))))));\n"), "("),
        (entities("#1=A(1;\n"), ";"),
        (entities("#1=A(1));\n"), ")"),
        (entities("#1=A('x);\n"), "'"),
        (entities("#1=A(/* x);\n"), "/*"),
        (entities("#1=A();#1=B();\n"), "B()"),
        (entities("#99999999999999999999=A();\n"), "#99999999999999999999"),
        (entities("#1=A(.T);\n"), ".T"),
        (entities("#1 A();\n"), "A"),
        (entities("A();\n"), "A"),
        (entities("#1=MAPPED_ITEM('',#2,#3);\n"), "MAPPED_ITEM('',#2,#3)"),
        (entities("#1=PLANE('',#2);\n"), "PLANE('',#2)"),
    ] {
        let (message, found) = fault_of(&text);
        assert_eq!(found, at, "{text}: {message}");
    }
    // What lacks its end.
    for text in [
        "ISO-10303-21;",
        "ISO-10303-21;\nHEADER;\n",
        "ISO-10303-21;\nDATA;\n#1=A()",
    ] {
        let (message, found) = fault_of(text);
        assert_eq!(found, "", "{message}");
    }
}

#[test]
fn what_is_not_a_spline_is_named() {
    let face = |on: &str| {
        entities(&format!(
            "#1=ADVANCED_FACE('',(#2),#3,.T.);#2=FACE_OUTER_BOUND('',#4,.T.);#4=VERTEX_LOOP('',#5);#3={on};\n{}",
            CORNERS.replace('#', "#1")
        ))
    };
    for kind in [
        "PLANE('',#5)",
        "CYLINDRICAL_SURFACE('',#5,3.)",
        "SURFACE_OF_LINEAR_EXTRUSION('',#5,#6)",
    ] {
        let error = read(&face(kind)).unwrap_err();
        let (name, _) = kind.split_once('(').unwrap();
        assert!(
            error.place.message.contains("#1 lies on a") && error.place.message.contains(name),
            "{error:?}"
        );
        assert_eq!(error.advice, Advice::OnlySplines);
    }
    let error = read(&face(
        "BEZIER_SURFACE('',1,1,((#11,#12),(#13,#14)),.UNSPECIFIED.,.F.,.F.,.F.)",
    ))
    .unwrap_err();
    assert!(error.place.message.contains("VERTEX_LOOP"), "{error:?}");
    assert_eq!(error.advice, Advice::Untrim);
}

#[test]
fn units_are_read_or_refused() {
    let unit = |body: &str| {
        let text = entities(body);
        Step::scan(text.as_bytes()).unwrap().unit()
    };
    assert_eq!(unit(""), Ok(None));
    let context = "#1=GLOBAL_UNIT_ASSIGNED_CONTEXT('','',(#2));";
    assert_eq!(
        unit(&format!("{context}#2=SI_UNIT(*,.CENTI.,.METRE.);")),
        Ok(Some(Length::mm(10.0)))
    );
    assert_eq!(unit(&format!("{context}#2=SI_UNIT(*,$,.RADIAN.);")), Ok(None));
    let feet = "#2=(CONVERSION_BASED_UNIT('FOOT',#3)LENGTH_UNIT()NAMED_UNIT($));#3=LENGTH_MEASURE_WITH_UNIT(12.,#4);\
                #4=(CONVERSION_BASED_UNIT('INCH',#5)LENGTH_UNIT()NAMED_UNIT($));#5=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(2.54),#6);\
                #6=SI_UNIT(*,.CENTI.,.METRE.);";
    let length = unit(&format!("{context}{feet}")).unwrap().unwrap();
    assert!((length.to_mm() - 304.8).abs() < 1e-12);
    let second = "#7=GLOBAL_UNIT_ASSIGNED_CONTEXT('','',(#6));";
    assert!(unit(&format!("{context}{feet}{second}")).is_err());
    for body in [
        "#2=SI_UNIT(*,.EXA.,.METRE.);",
        "#2=(CONVERSION_BASED_UNIT('X',#3)LENGTH_UNIT());#3=LENGTH_MEASURE_WITH_UNIT(2.,#2);",
        "#2=(CONVERSION_BASED_UNIT('X',#3)LENGTH_UNIT());#3=LENGTH_MEASURE_WITH_UNIT(0.,#4);#4=SI_UNIT(*,$,.METRE.);",
        "#2=(CONVERSION_BASED_UNIT('X',#3)LENGTH_UNIT());#3=PLANE('',#2);",
        "",
    ] {
        assert!(unit(&format!("{context}{body}")).is_err(), "{body}");
    }
}

/// Many faces that refer to one large surface are read in time that the file's length bounds.
#[test]
fn references_do_not_multiply_work() {
    let row = format!("({})", vec!["#1"; 2000].join(","));
    let knots = format!("(2,{},2)", vec!["1"; 1998].join(","));
    let values = format!(
        "({})",
        (0..2000).map(|k| format!("{k}.")).collect::<Vec<_>>().join(",")
    );
    let mut body = format!(
        "{CORNERS}#5=B_SPLINE_SURFACE_WITH_KNOTS('',1,1,({row},{row}),.U.,.F.,.F.,.F.,(2,2),{knots},(0.,1.),{values},.U.);\n"
    );
    for face in 10..1010 {
        writeln!(body, "#{face}=ADVANCED_FACE('',(#6),#5,.T.);").unwrap();
    }
    body += "#6=FACE_BOUND('',#7,.T.);#7=EDGE_LOOP('',());\n";
    assert!(read(&entities(&body)).is_err());
    let text = entities(&body);
    let mut file = File::scan(text.as_bytes()).unwrap();
    let surface = file::Reference { id: 5, range: 0..0 };
    let count = (0..100_000).take_while(|_| file.named(&surface).is_ok()).count();
    assert!(count < 100, "{count}");
}

#[test]
fn faces_beside_each_other_are_one_part() {
    let mut writer = Writer::new(Manner::Simple);
    let mut second = plain();
    for point in &mut second.control {
        point.x = 120.0 - point.x;
    }
    for surface in [&plain(), &second] {
        let id = writer.surface(surface);
        writer.face(id, &sides(surface));
    }
    writer.surface(&plain());
    let found = read(&writer.end()).unwrap();
    assert_eq!(found.surfaces, [plain(), second]);
    assert_eq!(found.remarks.passed_over.get("surface without a face"), Some(&1));
    let mesh = crate::patch::several(&found.surfaces, Length::mm(0.01)).unwrap();
    let surface = crate::testkit::surface_over(&mesh, crate::testkit::FIXED, 120.0, 80.0);
    assert!(surface.coverage().unwrap().gaps.is_empty());
}
