//! Drawings for tests: the text of a DXF, and beside it the sides of what it shows, worked out here from the same numbers.
//!
//! All coordinates are in mm, whatever the unit of the file is. Curves become short chords, at most half a micrometre off.

use crate::seen_from_above::{Spot, along_circle, distance};
use core::f64::consts::{PI, TAU};
use std::collections::BTreeMap;

/// Chords of an ellipse or a spline.
const CHORDS: u32 = 2000;

type Sides = Vec<[Spot; 2]>;

/// A sheet that is drawn on.
#[derive(Clone, Debug)]
pub(crate) struct Sheet {
    /// The number of the unit in the header, none for a file that does not say it.
    number: Option<u32>,
    unit: f64,
    blocks: String,
    entities: String,
    sides: BTreeMap<String, Sides>,
    shapes: BTreeMap<String, Sides>,
}

/// How polylines are written.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Form {
    /// `LWPOLYLINE`, in one entity.
    Light,
    /// `POLYLINE` with an entity for each `VERTEX`, as of old.
    Vertices,
}

/// A corner of a polyline: x, y, and the bulge of the side that begins there.
pub(crate) type Corner = (f64, f64, f64);

impl Sheet {
    /// In mm, as the header says.
    pub(crate) fn in_mm() -> Self {
        Self::new(Some(4), 1.0)
    }

    /// In inches, as the header says.
    pub(crate) fn in_inches() -> Self {
        Self::new(Some(1), 25.4)
    }

    /// In inches, which the file does not say.
    pub(crate) fn of_old() -> Self {
        Self::new(None, 25.4)
    }

    fn new(number: Option<u32>, unit: f64) -> Self {
        Self {
            number,
            unit,
            blocks: String::new(),
            entities: String::new(),
            sides: BTreeMap::new(),
            shapes: BTreeMap::new(),
        }
    }

    /// The file.
    pub(crate) fn text(&self) -> String {
        let mut text = String::from("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n");
        if let Some(number) = self.number {
            text += &format!("9\n$INSUNITS\n70\n{number}\n");
        }
        text += &format!("0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n{}0\nENDSEC\n", self.blocks);
        text + &format!("0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", self.entities)
    }

    /// The sides on a layer.
    pub(crate) fn sides(&self, layer: &str) -> Sides {
        self.sides.get(layer).cloned().unwrap_or_default()
    }

    fn begin(&mut self, kind: &str, layer: &str) {
        self.entities += &format!("0\n{kind}\n8\n{layer}\n");
    }

    fn group(&mut self, code: u32, value: impl core::fmt::Display) {
        self.entities += &format!("{code}\n{value}\n");
    }

    /// A length.
    fn length(&mut self, code: u32, value: f64) {
        self.group(code, value / self.unit);
    }

    fn point(&mut self, code: u32, [x, y]: Spot) {
        self.length(code, x);
        self.length(code + 10, y);
    }

    fn show(&mut self, layer: &str, places: &[Spot]) {
        let sides = places.windows(2).map(|ends| [ends[0], ends[1]]);
        self.sides.entry(layer.to_owned()).or_default().extend(sides);
    }

    pub(crate) fn line(&mut self, layer: &str, from: Spot, to: Spot) {
        self.begin("LINE", layer);
        self.point(10, from);
        self.point(11, to);
        self.show(layer, &[from, to]);
    }

    /// To the left from one angle to another, in deg.
    pub(crate) fn arc(&mut self, layer: &str, centre: Spot, radius: f64, [from, to]: [f64; 2]) {
        self.begin("ARC", layer);
        self.point(10, centre);
        self.length(40, radius);
        self.group(50, from);
        self.group(51, to);
        let sweep = (to - from).rem_euclid(360.0).to_radians();
        self.show(layer, &along_circle(centre, radius, from.to_radians(), sweep));
    }

    pub(crate) fn circle(&mut self, layer: &str, centre: Spot, radius: f64) {
        self.begin("CIRCLE", layer);
        self.point(10, centre);
        self.length(40, radius);
        self.show(layer, &along_circle(centre, radius, 0.0, TAU));
    }

    /// A closed polyline.
    pub(crate) fn polyline(&mut self, layer: &str, form: Form, corners: &[Corner]) {
        match form {
            Form::Light => {
                self.begin("LWPOLYLINE", layer);
                self.group(90, corners.len());
                self.group(70, 1);
            }
            Form::Vertices => {
                self.begin("POLYLINE", layer);
                self.group(66, 1);
                self.group(70, 1);
            }
        }
        for &(x, y, bulge) in corners {
            if matches!(form, Form::Vertices) {
                self.begin("VERTEX", layer);
            }
            self.point(10, [x, y]);
            if bulge != 0.0 {
                self.group(42, bulge);
            }
        }
        if matches!(form, Form::Vertices) {
            self.begin("SEQEND", layer);
        }
        let next = corners.iter().cycle().skip(1);
        for (&(x, y, bulge), &(next_x, next_y, _)) in corners.iter().zip(next) {
            self.show(layer, &along_bulge([x, y], [next_x, next_y], bulge));
        }
    }

    /// From one parameter to another, in rad; `major` leads from the centre to an end of the longer axis.
    pub(crate) fn ellipse(
        &mut self,
        layer: &str,
        centre: Spot,
        (major, ratio): (Spot, f64),
        [from, to]: [f64; 2],
    ) {
        self.begin("ELLIPSE", layer);
        self.point(10, centre);
        self.point(11, major);
        self.group(40, ratio);
        self.group(41, from);
        self.group(42, to);
        let at = |k: u32| {
            let (sin, cos) = (from + (to - from) * f64::from(k) / f64::from(CHORDS)).sin_cos();
            let [x, y] = major;
            [
                centre[0] + cos * x - sin * ratio * y,
                centre[1] + cos * y + sin * ratio * x,
            ]
        };
        self.show(layer, &(0..=CHORDS).map(at).collect::<Vec<Spot>>());
    }

    /// A spline of degree 3 with ends on its first and last control point.
    pub(crate) fn spline(&mut self, layer: &str, controls: &[Spot]) {
        let spans = controls.len() - 3;
        let inner = (1..spans).map(|k| k as f64);
        let mut knots = vec![0.0; 4];
        knots.extend(inner);
        knots.extend([spans as f64; 4]);
        self.begin("SPLINE", layer);
        for (code, value) in [(70, 8), (71, 3), (72, knots.len()), (73, controls.len()), (74, 0)] {
            self.group(code, value);
        }
        for knot in &knots {
            self.group(40, knot);
        }
        for &control in controls {
            self.point(10, control);
        }
        let at = |k: u32| {
            if k == CHORDS {
                return controls[controls.len() - 1];
            }
            let u = spans as f64 * f64::from(k) / f64::from(CHORDS);
            let mut sum = [0.0; 2];
            for (number, control) in controls.iter().enumerate() {
                let weight = basis(&knots, number, 3, u);
                sum = [sum[0] + weight * control[0], sum[1] + weight * control[1]];
            }
            sum
        };
        self.show(layer, &(0..=CHORDS).map(at).collect::<Vec<Spot>>());
    }

    /// A block, drawn on layer 0.
    pub(crate) fn block(&mut self, name: &str, draw: impl FnOnce(&mut Self)) {
        let mut inner = Self::new(self.number, self.unit);
        draw(&mut inner);
        self.blocks += &format!("0\nBLOCK\n8\n0\n2\n{name}\n70\n0\n10\n0\n20\n0\n");
        self.blocks += &inner.entities;
        self.blocks += "0\nENDBLK\n8\n0\n";
        self.shapes.insert(name.to_owned(), inner.sides("0"));
    }

    /// A block, scaled, turned by an angle in deg, and moved.
    pub(crate) fn insert(&mut self, layer: &str, block: &str, at: Spot, scale: Spot, turn: f64) {
        self.begin("INSERT", layer);
        self.group(2, block);
        self.point(10, at);
        self.group(41, scale[0]);
        self.group(42, scale[1]);
        self.group(50, turn);
        let (sin, cos) = turn.to_radians().sin_cos();
        let moved = |[x, y]: Spot| {
            let (x, y) = (x * scale[0], y * scale[1]);
            [at[0] + cos * x - sin * y, at[1] + sin * x + cos * y]
        };
        let sides: Sides = self.shapes[block].iter().map(|side| side.map(moved)).collect();
        self.sides.entry(layer.to_owned()).or_default().extend(sides);
    }
}

/// Places on a side of a polyline: the bulge is the tangent of a quarter of its angle, positive to the left.
fn along_bulge(from: Spot, to: Spot, bulge: f64) -> Vec<Spot> {
    if bulge == 0.0 {
        return vec![from, to];
    }
    // The centre lies on the line that halves the chord.
    let chord = distance(from, to);
    let aside = (1.0 - bulge * bulge) / (4.0 * bulge);
    let centre = [
        f64::midpoint(from[0], to[0]) - (to[1] - from[1]) * aside,
        f64::midpoint(from[1], to[1]) + (to[0] - from[0]) * aside,
    ];
    let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
    let begin = (from[1] - centre[1]).atan2(from[0] - centre[0]);
    along_circle(centre, radius, begin, 4.0 * bulge.atan())
}

/// A basis function of a spline, by its recursion.
fn basis(knots: &[f64], number: usize, degree: usize, u: f64) -> f64 {
    if degree == 0 {
        return f64::from(u8::from(knots[number] <= u && u < knots[number + 1]));
    }
    let share = |from: usize, to: usize, way: f64| {
        let span = knots[to] - knots[from];
        if span == 0.0 { 0.0 } else { way / span }
    };
    let rise = share(number, number + degree, u - knots[number]);
    let fall = share(number + 1, number + degree + 1, knots[number + degree + 1] - u);
    rise * basis(knots, number, degree - 1, u) + fall * basis(knots, number + 1, degree - 1, u)
}

/// Corners of a regular polygon.
pub(crate) fn regular(centre: Spot, radius: f64, count: u32) -> Vec<Corner> {
    let corner = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / f64::from(count) + PI / 7.0).sin_cos();
        (centre[0] + radius * cos, centre[1] + radius * sin, 0.0)
    };
    (0..count).map(corner).collect()
}
