//! Whole jobs: strips in layers over parts, freed in an order that a disc can follow, against columns that know nothing of
//! cracks and rims, and against an arrangement of lines.

use super::arrangement::Arrangement;
use super::*;
use crate::disc::PassFault;
use proptest::prelude::*;
use proptest::sample::select;
use std::collections::BTreeSet;
use vcutc_geometry::curve::Curve;

/// Parameters of a job.
#[derive(Clone, Debug)]
struct Job {
    part: Profile,
    top: f64,
    layer: f64,
    step: f64,
    radius: f64,
    /// In degrees.
    lead: f64,
    beyond: f64,
    strategy: Residual,
}

/// What becomes of the strip of a column that would enter the part.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Residual {
    Discard,
    Lift,
}

/// A strip, its slit and its pass.
#[derive(Clone, Copy, Debug)]
struct Strip {
    /// From the top, from 1.
    layer: u32,
    span: [f64; 2],
    slit: Option<(f64, f64)>,
    pass: DiscPass,
}

/// A column of the stock.
#[derive(Clone, Copy, Debug)]
struct Column {
    span: [f64; 2],
    height: f64,
    /// The part does not rise higher near it.
    floor: f64,
}

impl Job {
    fn width(&self) -> f64 {
        self.part.span().1
    }

    fn disc(&self) -> Disc {
        disc(self.radius)
    }

    fn columns(&self) -> Vec<Column> {
        let count = (((self.width() - 0.6) / self.step).ceil() as u32).max(1);
        let column = |number: u32| {
            let last = if number + 1 == count {
                self.width()
            } else {
                f64::from(number + 1) * self.step
            };
            let span = [f64::from(number) * self.step, last];
            let (from, to) = (
                (span[0] - self.beyond).max(0.0),
                (span[1] + self.beyond).min(self.width()),
            );
            let inner = self
                .part
                .points()
                .iter()
                .filter(|point| (from..=to).contains(&point.x));
            let ends = [from, to].map(|x| self.part.height(x));
            let floor = inner.map(|point| point.z).chain(ends).fold(0.0, f64::max);
            Column {
                span,
                height: self.top,
                floor,
            }
        };
        (0..count).map(column).collect()
    }

    /// The strips in order, and the columns that they leave.
    fn strips(&self) -> (Vec<Strip>, Vec<Column>) {
        let (mut strips, mut columns) = (Vec::new(), self.columns());
        for layer in 1..=((self.top / self.layer) as u32) {
            let mut open: Vec<usize> = (0..columns.len()).collect();
            while let Some((place, strip, height)) = open.iter().enumerate().find_map(|(place, &number)| {
                let (strip, height) = self.strip(&columns, number, layer)?;
                Some((place, strip, height))
            }) {
                columns[open.remove(place)].height = height;
                strips.push(strip);
            }
        }
        (strips, columns)
    }

    /// The strip of a column in a layer, if a disc gets at it from a side.
    fn strip(&self, columns: &[Column], number: usize, layer: u32) -> Option<(Strip, f64)> {
        let Column { span, height, floor } = columns[number];
        let level = self.top - f64::from(layer) * self.layer;
        let floor = match self.strategy {
            Residual::Discard if floor > level + 1e-9 => return None,
            Residual::Discard => level,
            Residual::Lift => level.max(floor),
        };
        [Side::Right, Side::Left].into_iter().find_map(|side| {
            let inset = self.radius - self.beyond;
            let (x, end) = match side {
                Side::Right => (span[1] - inset, span[1]),
                Side::Left => (span[0] + inset, span[0]),
            };
            let mut pass = pass(at(x, floor), side, self.lead);
            pass.beyond = Length::mm(self.beyond);
            let lift = Guard::new(&self.part).deepest(&pass.rim(&self.disc()));
            // A level rim must be clear as planned.
            let lift = lift.map_or(0.0, |(_, depth)| if self.lead == 0.0 { 1000.0 } else { depth });
            pass.centre.z += lift;
            let rim = pass.rim(&self.disc());
            let thin = if self.lead == 0.0 {
                1e-6
            } else {
                2.0 * rim.depth().to_mm()
            };
            let [left, right] = rim.cover();
            let behind = |other: &Column| {
                let is_over = other.span[0] < right - 1e-9 && other.span[1] > left + 1e-9;
                is_over
                    && match side {
                        Side::Right => other.span[1] <= span[0] + 1e-9,
                        Side::Left => other.span[0] >= span[1] - 1e-9,
                    }
            };
            let is_clear = columns
                .iter()
                .filter(|other| behind(other))
                .all(|other| other.height <= pass.centre.z + 1e-9);
            if height - pass.centre.z <= thin || !is_clear {
                return None;
            }
            let neighbour = match side {
                Side::Right => columns.get(number + 1),
                Side::Left => number.checked_sub(1).and_then(|number| columns.get(number)),
            };
            let bottom = rim.height(end);
            let slit = neighbour
                .filter(|other| other.height > bottom)
                .map(|_| (end, bottom));
            Some((
                Strip {
                    layer,
                    span,
                    slit,
                    pass,
                },
                pass.centre.z,
            ))
        })
    }
}

/// Makes a section out of cuts in an order.
fn cut(job: &Job, cuts: &[Cut]) -> (CrossSection, Vec<crate::disc::PassOutcome>) {
    let mut section = block(job.width(), job.top);
    let guard = Guard::new(&job.part);
    let mut outcomes = Vec::new();
    for cut in cuts {
        match *cut {
            Cut::Slit(x, bottom) => {
                section.slit(x, bottom);
            }
            Cut::Pass(pass) => outcomes.push(section.pass(&job.disc(), &pass, &guard)),
        }
    }
    (section, outcomes)
}

#[derive(Clone, Copy, Debug)]
enum Cut {
    Slit(f64, f64),
    Pass(DiscPass),
}

fn in_turn(strips: &[Strip]) -> Vec<Cut> {
    let cuts = strips.iter().flat_map(|strip| {
        let slit = strip.slit.map(|(x, bottom)| Cut::Slit(x, bottom));
        slit.into_iter().chain([Cut::Pass(strip.pass)])
    });
    cuts.collect()
}

/// Slits of all layers first.
fn slits_first(strips: &[Strip], by: impl Fn(&(f64, f64)) -> u64) -> Vec<Cut> {
    let mut slits: Vec<(f64, f64)> = strips.iter().filter_map(|strip| strip.slit).collect();
    slits.sort_by_key(|slit| by(slit));
    let slits = slits.into_iter().map(|(x, bottom)| Cut::Slit(x, bottom));
    slits
        .chain(strips.iter().map(|strip| Cut::Pass(strip.pass)))
        .collect()
}

/// Slits after all passes.
fn slits_last(strips: &[Strip]) -> Vec<Cut> {
    let slits = strips
        .iter()
        .filter_map(|strip| strip.slit)
        .map(|(x, bottom)| Cut::Slit(x, bottom));
    strips
        .iter()
        .map(|strip| Cut::Pass(strip.pass))
        .chain(slits)
        .collect()
}

fn a_part() -> impl Strategy<Value = Profile> {
    prop_oneof![
        2 => prop::collection::vec((5.0..40.0_f64, 8.0..60.0_f64), 2..9),
        // Level pieces on the layers.
        1 => prop::collection::vec((5.0..40.0_f64, (1..=6_u32).prop_map(|z| f64::from(z) * 10.0)), 2..9),
    ]
    .prop_map(|steps| {
        let mut x = 0.0;
        let points = steps.into_iter().map(|(step, z)| {
            let point = at(x, z);
            x += step;
            point
        });
        Profile::new(points.collect()).unwrap()
    })
}

fn a_job(lead: impl Strategy<Value = f64>) -> impl Strategy<Value = Job> {
    (
        a_part(),
        select(vec![4.0, 5.0, 7.3, 10.0, 12.0]),
        select(vec![4.0, 5.0, 7.3, 10.0, 12.0]),
        select(vec![12.0, 25.0, 60.0]),
        lead,
        select(vec![0.0, 0.5]),
        select(vec![Residual::Discard, Residual::Lift]),
    )
        .prop_map(|(part, layer, step, radius, lead, beyond, strategy)| Job {
            part,
            top: 60.0,
            layer,
            step,
            radius,
            lead,
            beyond,
            strategy,
        })
}

proptest! {
    #[test]
    fn level_passes_free_their_strips_and_nothing_else(job in a_job(Just(0.0)), salt in any::<u64>()) {
        let (strips, columns) = job.strips();
        let (mut section, outcomes) = cut(&job, &in_turn(&strips));
        for (strip, outcome) in strips.iter().zip(&outcomes) {
            prop_assert!(outcome.faults.is_empty(), "{strip:?} {outcome:?}");
            prop_assert!(outcome.freed.len() == 1, "{strip:?} {outcome:?}");
            let stretch = outcome.freed[0].stretch;
            prop_assert!((stretch.from - strip.span[0]).abs() < 1e-9 && (stretch.to - strip.span[1]).abs() < 1e-9);
        }
        let mut arrangement = Arrangement::of(job.width(), job.top);
        for strip in &strips {
            if let Some((x, bottom)) = strip.slit {
                arrangement.slit(x, bottom);
            }
            arrangement.pass(&job.disc(), &strip.pass);
        }
        let differs = arrangement.differs(&mut section, 1e-6);
        prop_assert!(differs.is_none(), "{differs:?}");
        let scrambled = |slit: &(f64, f64)| slit.0.to_bits().wrapping_mul(salt | 1) ^ slit.1.to_bits();
        for cuts in [in_turn(&strips), slits_first(&strips, scrambled), slits_last(&strips)] {
            let (mut section, _) = cut(&job, &cuts);
            for column in &columns {
                for share in [0.001, 0.5, 0.999] {
                    let x = column.span[0] + (column.span[1] - column.span[0]) * share;
                    prop_assert!((section.surface().height(x) - column.height).abs() < 1e-9, "{x} {column:?}");
                }
            }
        }
    }

    /// The edge is a circle in space.
    #[test]
    fn a_rim_enters_the_part_as_deep_as_any_point_of_its_circle(
        part in a_part(),
        (x, z, radius) in (-20.0..120.0_f64, 0.0..60.0_f64, 5.0..60.0_f64),
        lead in prop_oneof![Just(0.0), 0.05..8.0_f64],
    ) {
        let rim = pass(at(x, z), Side::Right, lead).rim(&disc(radius));
        let found = Guard::new(&part).deepest(&rim);
        let (start, end) = part.span();
        let lean = libm::sin(lead.to_radians());
        let mut sampled = 0.0_f64;
        for i in 0..=100_000_u32 {
            let (sine, cosine) = libm::sincos(f64::from(i) / 100_000.0 * core::f64::consts::PI);
            let at = at(x - radius * cosine, z - radius * sine * lean);
            if (start..=end).contains(&at.x) {
                sampled = sampled.max(part.height(at.x) - at.z);
            }
        }
        let depth = found.map_or(0.0, |(_, depth)| depth);
        prop_assert!(depth >= sampled - 1e-6, "{depth} {sampled}");
        // Between two samples a point is missed by no more than the part rises there.
        prop_assert!(depth <= sampled + 0.05, "{depth} {sampled}");
        if let Some((at, depth)) = found {
            prop_assert!((rim.height(at.x) - at.z).abs() < 1e-9 && (part.height(at.x) - at.z - depth).abs() < 1e-9);
        }
    }
}

proptest! {
    // Rims of many corners take their time.
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 4, ..ProptestConfig::default() })]

    #[test]
    fn leaning_passes_free_their_strips(job in a_job(0.05..5.0_f64)) {
        let (strips, _) = job.strips();
        let (mut section, outcomes) = cut(&job, &in_turn(&strips));
        let mut arrangement = Arrangement::of(job.width(), job.top);
        for (strip, outcome) in strips.iter().zip(&outcomes) {
            prop_assert!(outcome.faults.is_empty(), "{strip:?} {outcome:?}");
            let middle = (strip.span[0] + strip.span[1]) / 2.0;
            let frees = outcome.freed.iter().any(|freed| (freed.stretch.from..=freed.stretch.to).contains(&middle));
            prop_assert!(frees, "{strip:?} {outcome:?}");
            if let Some((x, bottom)) = strip.slit {
                arrangement.slit(x, bottom);
            }
            arrangement.pass(&job.disc(), &strip.pass);
        }
        let differs = arrangement.differs(&mut section, 2e-3);
        prop_assert!(differs.is_none(), "{differs:?}");
        for cuts in [slits_first(&strips, |slit| slit.0.to_bits()), slits_last(&strips)] {
            let (mut other, _) = cut(&job, &cuts);
            for strip in &strips {
                for share in [0.01, 0.3, 0.5, 0.9] {
                    let x = strip.span[0] + (strip.span[1] - strip.span[0]) * share;
                    let heights = [&mut section, &mut other].map(|section| section.surface().height(x));
                    prop_assert!((heights[0] - heights[1]).abs() < 2e-3, "{x} {heights:?}");
                }
            }
        }
    }
}

/// The part of the language page.
fn sample() -> Job {
    let curve = Curve::bezier(vec![
        at(0.0, 18.0),
        at(20.0, 30.0),
        at(60.0, 34.0),
        at(85.0, 14.0),
    ])
    .unwrap();
    let mut points = vec![curve.start()];
    curve.flatten(Length::mm(1e-4), &mut points).unwrap();
    Job {
        part: Profile::new(points).unwrap(),
        top: 50.0,
        layer: 10.0,
        step: 10.0,
        radius: 25.0,
        lead: 0.0,
        beyond: 0.0,
        strategy: Residual::Lift,
    }
}

fn removed(section: &mut CrossSection, job: &Job) -> f64 {
    let corners: Vec<Point2> = section.surface().corners().collect();
    let below = corners
        .windows(2)
        .map(|pair| (pair[1].x - pair[0].x) * (pair[0].z + pair[1].z) / 2.0);
    job.width() * job.top - below.sum::<f64>()
}

/// Towards the crest nothing is lost; from left to right throughout, the disc cuts what stands behind the strip.
#[test]
fn strips_over_a_crest_are_freed_from_both_sides() {
    let job = sample();
    let (strips, _) = job.strips();
    let (mut section, outcomes) = cut(&job, &in_turn(&strips));
    assert!(
        outcomes.iter().all(|outcome| outcome.faults.is_empty()),
        "{outcomes:?}"
    );
    // Two strips at one place share a slit.
    let slits = strips
        .iter()
        .filter_map(|strip| Some((strip.layer, strip.slit?.0.to_bits())));
    let slits: BTreeSet<_> = slits.collect();
    assert_eq!((strips.len(), slits.len()), (28, 25));
    assert!(
        (removed(&mut section, &job) - 2084.48).abs() < 0.01,
        "{}",
        removed(&mut section, &job)
    );

    let mut naive = strips;
    naive.sort_by(|a, b| a.layer.cmp(&b.layer).then(a.span[0].total_cmp(&b.span[0])));
    for strip in &mut naive {
        strip.pass.centre.x = strip.span[1] - 24.5;
        strip.pass.beyond = Length::mm(0.5);
        strip.pass.side = Side::Right;
    }
    let all = naive
        .iter()
        .flat_map(|strip| strip.span.map(|x| Cut::Slit(x, strip.pass.centre.z)));
    let cuts: Vec<Cut> = all
        .chain(naive.iter().map(|strip| Cut::Pass(strip.pass)))
        .collect();
    let (mut section, outcomes) = cut(&job, &cuts);
    let lost = removed(&mut section, &job) - 2084.48;
    let below = job
        .part
        .points()
        .iter()
        .map(|point| point.z - section.surface().height(point.x));
    let deepest = below.fold(0.0, f64::max);
    assert!(
        (lost - 9.81).abs() < 0.01 && (deepest - 0.49).abs() < 0.01,
        "{lost} {deepest}"
    );
    let enters = |fault: &PassFault| matches!(fault, PassFault::EntersPart { .. });
    assert!(outcomes.iter().flat_map(|outcome| &outcome.faults).any(enters));
}
