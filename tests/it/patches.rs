//! Surfaces by control points, in jobs and in STEP files.

use crate::pipeline::{Files, compile};
use crate::surfaces::{VCUT, job, program};
use std::fmt::Write as _;
use vcutc::job::Part;

/// A surface with clamped knots over the stock of 120 mm by 80 mm.
struct Patch {
    degrees: [usize; 2],
    knots: [Vec<f64>; 2],
    /// In rows.
    points: Vec<Vec<[f64; 3]>>,
    /// One for each point, if there are any.
    weights: Vec<Vec<f64>>,
}

/// Numbers from 0 to 1 that look random, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        // Knuth, The Art of Computer Programming, volume 2, section 3.3.4, table 1, line 26.
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

impl Patch {
    fn random(seed: u64) -> Self {
        let mut numbers = Numbers(seed);
        for _ in 0..4 {
            numbers.next();
        }
        let mut upto = |count: f64| (numbers.next() * count) as usize;
        let degrees = [1 + upto(3.0), 1 + upto(3.0)];
        let counts = [degrees[0] + 1 + upto(3.0), degrees[1] + 1 + upto(3.0)];
        let has_weights = upto(2.0) == 1;
        let mut knots = |axis: usize| {
            let (degree, count) = (degrees[axis], counts[axis]);
            let mut knots = vec![0.0; degree + 1];
            for _ in degree + 1..count {
                knots.push(knots.last().unwrap() + 0.2 + numbers.next());
            }
            let end = knots.last().unwrap() + 1.0;
            knots.extend(vec![end; degree + 1]);
            knots
        };
        let knots = [knots(0), knots(1)];
        // Columns of points lie straight over each other, so that the border is that of the stock.
        let point = |i: usize, j: usize, z: f64| {
            let along = |axis: usize, i: usize| i as f64 / (counts[axis] - 1) as f64;
            [120.0 * along(0, i), 80.0 * along(1, j), 15.0 + 30.0 * z]
        };
        let mut grid = |make: &dyn Fn(usize, usize, f64) -> [f64; 3]| -> Vec<Vec<[f64; 3]>> {
            let row = |i, numbers: &mut Numbers| (0..counts[1]).map(|j| make(i, j, numbers.next())).collect();
            (0..counts[0]).map(|i| row(i, &mut numbers)).collect()
        };
        let points = grid(&point);
        let weights = grid(&|_, _, z| [0.5 + z; 3]);
        let weights = weights.iter().map(|row| row.iter().map(|part| part[0]).collect());
        Self {
            degrees,
            knots,
            points,
            weights: if has_weights {
                weights.collect()
            } else {
                Vec::new()
            },
        }
    }

    /// As a job has it.
    fn written(&self) -> String {
        let list = |knots: &[f64]| knots.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
        let mut text = format!(
            "surface {{ nurbs {{ degree = ({}, {}) u_knots = ({}) v_knots = ({})\n",
            self.degrees[0],
            self.degrees[1],
            list(&self.knots[0]),
            list(&self.knots[1])
        );
        for (i, row) in self.points.iter().enumerate() {
            text += "row";
            for (j, [x, y, z]) in row.iter().enumerate() {
                let weight = self
                    .weights
                    .get(i)
                    .map_or(String::new(), |row| format!(", {}", row[j]));
                write!(text, " ({x} mm, {y} mm, {z} mm{weight})").unwrap();
            }
            text += "\n";
        }
        text + "} }"
    }

    /// As a STEP file has it, in one record or in several.
    fn step(&self) -> String {
        let mut text = String::from("ISO-10303-21;HEADER;ENDSEC;DATA;\n");
        let columns = self.points[0].len();
        for (k, [x, y, z]) in self.points.iter().flatten().enumerate() {
            writeln!(text, "#{}=CARTESIAN_POINT('',({x:?},{y:?},{z:?}));", 100 + k).unwrap();
        }
        let rows = |cell: &dyn Fn(usize, usize) -> String| {
            let row = |i| (0..columns).map(|j| cell(i, j)).collect::<Vec<_>>().join(",");
            let rows: Vec<String> = (0..self.points.len()).map(|i| format!("({})", row(i))).collect();
            format!("({})", rows.join(","))
        };
        let points = rows(&|i, j| format!("#{}", 100 + i * columns + j));
        let runs = |knots: &[f64]| {
            let mut all: Vec<(f64, usize)> = Vec::new();
            for &knot in knots {
                match all.last_mut() {
                    Some((last, times)) if *last == knot => *times += 1,
                    _ => all.push((knot, 1)),
                }
            }
            let join = |texts: Vec<String>| format!("({})", texts.join(","));
            [
                join(all.iter().map(|(_, times)| times.to_string()).collect()),
                join(all.iter().map(|(knot, _)| format!("{knot:?}")).collect()),
            ]
        };
        let [u, v] = [0, 1].map(|axis| runs(&self.knots[axis]));
        let [p, q] = self.degrees;
        let knots = format!("{},{},{},{},.UNSPECIFIED.", u[0], v[0], u[1], v[1]);
        let body = format!("{p},{q},{points},.UNSPECIFIED.,.F.,.F.,.F.");
        if self.weights.is_empty() {
            writeln!(text, "#10=B_SPLINE_SURFACE_WITH_KNOTS('',{body},{knots});").unwrap();
        } else {
            let weights = rows(&|i, j| format!("{:?}", self.weights[i][j]));
            writeln!(
                text,
                "#10=(BOUNDED_SURFACE()B_SPLINE_SURFACE({body})B_SPLINE_SURFACE_WITH_KNOTS({knots})GEOMETRIC_REPRESENTATION_ITEM()\
                 RATIONAL_B_SPLINE_SURFACE({weights})REPRESENTATION_ITEM('')SURFACE());"
            )
            .unwrap();
        }
        text + "#20=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n\
                #21=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#20))REPRESENTATION_CONTEXT('',''));\n\
                ENDSEC;END-ISO-10303-21;"
    }

    /// The height at a parameter, by Cox and de Boor's recursion.
    fn at(&self, [u, v]: [f64; 2]) -> [f64; 3] {
        let mut sum = [0.0; 4];
        for (i, row) in self.points.iter().enumerate() {
            for (j, point) in row.iter().enumerate() {
                let weight = self.weights.get(i).map_or(1.0, |row| row[j]);
                let share = weight
                    * basis(&self.knots[0], i, self.degrees[0], u)
                    * basis(&self.knots[1], j, self.degrees[1], v);
                for axis in 0..3 {
                    sum[axis] += share * point[axis];
                }
                sum[3] += share;
            }
        }
        [sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]]
    }
}

fn basis(knots: &[f64], i: usize, degree: usize, t: f64) -> f64 {
    if degree == 0 {
        return f64::from(u8::from(knots[i] <= t && t < knots[i + 1]));
    }
    let part = |above: f64, below: f64| if below == 0.0 { 0.0 } else { above / below };
    part(t - knots[i], knots[i + degree] - knots[i]) * basis(knots, i, degree - 1, t)
        + part(knots[i + degree + 1] - t, knots[i + degree + 1] - knots[i + 1])
            * basis(knots, i + 1, degree - 1, t)
}

#[test]
fn a_step_file_and_its_control_points_are_roughed_alike() {
    for seed in 1..=6 {
        let patch = Patch::random(seed);
        let files = Files::default().with("a.stp", patch.step());
        let text = |part: &str| {
            program(&compile(
                "job.vcut",
                &files.clone().with("job.vcut", job(part, VCUT)),
            ))
        };
        let of_step = text("surface { step \"a.stp\" }");
        let of_job = text(&patch.written());
        assert!(of_step.lines().count() > 50);
        assert_eq!(of_step, of_job, "{}", patch.written());
    }
}

/// No place of the surface is above the shadow that cuts keep to, and none of the shadow is far above the surface.
#[test]
fn cuts_keep_clear_of_what_control_points_stand_for() {
    for seed in 1..=12 {
        let patch = Patch::random(seed);
        let text = job(&patch.written(), VCUT);
        let outcome = compile("job.vcut", &Files::default().with("job.vcut", text));
        let part = &outcome
            .job
            .as_ref()
            .unwrap_or_else(|| panic!("{:?}", outcome.diagnostics))
            .part;
        let shadow = part.tessellated(Part::TOLERANCE).unwrap();
        let steps = 200;
        let mut highest = vec![f64::NEG_INFINITY; 121];
        for k in 0..steps * steps {
            let share = |count: usize, axis: usize| {
                0.999_999_999 * patch.knots[axis].last().unwrap() * count as f64 / (steps - 1) as f64
            };
            let [x, _, z] = patch.at([share(k / steps, 0), share(k % steps, 1)]);
            let above = shadow.height(x.clamp(0.0, 120.0)) - z;
            assert!(above >= -1e-9, "{above} at {x} of {}", patch.written());
            let nearest = &mut highest[x.round() as usize];
            *nearest = nearest.max(z);
        }
        // With weights, x differs along v, and samples are not sections.
        if !patch.weights.is_empty() {
            continue;
        }
        // In bins of a millimetre, the highest of the samples is nearly as high as the shadow somewhere.
        for x in (1..120).filter(|x| highest[*x as usize].is_finite()) {
            let low = (-5..=5)
                .map(|part| shadow.height(f64::from(x) + f64::from(part) / 10.0))
                .fold(f64::INFINITY, f64::min);
            assert!(
                low <= highest[x as usize] + 0.25,
                "{low} at {x} of {}",
                patch.written()
            );
        }
    }
}
