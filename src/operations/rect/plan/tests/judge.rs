//! A judge that knows no strips: the cross-section as cells between all lines of a plan, and cuts as walls between cells. What no
//! longer hangs together with the bottom is free. Only for discs without a lead, whose passes are lines.

use super::*;
use vcutc_simulation::surface::Side;

/// Lines this close are one.
const SAME: f64 = 1e-7;

/// The cross-section of a stock that is being cut.
pub(super) struct Judge<'j> {
    xs: Vec<f64>,
    zs: Vec<f64>,
    /// Whether a cell, by column and row, is still there.
    there: Vec<Vec<bool>>,
    /// Whether the line left of a cell is cut.
    cut_left: Vec<Vec<bool>>,
    /// Whether the line below a cell is cut.
    cut_below: Vec<Vec<bool>>,
    bound: &'j Profile,
    blades: &'j Blades,
}

/// A pass of the disc: its centre, and the strip that it is to free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pass {
    pub(super) centre: Point2,
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) open: Side,
}

fn lines(mut values: Vec<f64>, from: f64, to: f64) -> Vec<f64> {
    values.extend([from, to]);
    values.retain(|value| (from..=to).contains(value));
    values.sort_by(f64::total_cmp);
    values.dedup_by(|one, other| *one - *other < SAME);
    values
}

impl<'j> Judge<'j> {
    /// A whole stock, with lines wherever cuts will run.
    pub(super) fn new(
        sample: &Sample,
        bound: &'j Profile,
        blades: &'j Blades,
        slits: &[Slit],
        passes: &[Pass],
    ) -> Self {
        let radius = blades.wheel.radius.to_mm();
        let room = blades.wheel.clearance.to_mm() - 1.1e-3;
        let by_slit = slits.iter().map(|slit| slit.x);
        let by_body = |pass: &Pass| {
            let shafts = blades.wheel.body.iter();
            let reaches: Vec<f64> = shafts.map(|shaft| shaft.radius.to_mm() + room).collect();
            let both = reaches.into_iter().chain([radius]);
            let x = pass.centre.x;
            both.flat_map(|reach| [x - reach, x + reach])
                .chain([pass.left, pass.right])
                .collect::<Vec<_>>()
        };
        let by_pass = passes.iter().flat_map(by_body);
        let xs = lines(by_slit.chain(by_pass).collect(), 0.0, sample.width);
        let heights = slits
            .iter()
            .map(|slit| slit.bottom)
            .chain(passes.iter().map(|pass| pass.centre.z));
        let zs = lines(heights.collect(), 0.0, sample.height);
        let (columns, rows) = (xs.len() - 1, zs.len() - 1);
        Self {
            xs,
            zs,
            there: vec![vec![true; rows]; columns],
            cut_left: vec![vec![false; rows]; columns],
            cut_below: vec![vec![false; rows]; columns],
            bound,
            blades,
        }
    }

    /// The height of the material in a column.
    fn height(&self, column: usize) -> f64 {
        let rows = self.there[column].iter().rposition(|there| *there);
        rows.map_or(0.0, |row| self.zs[row + 1])
    }

    /// The highest place of the part, by its corners and by samples.
    fn part_over(&self, from: f64, to: f64) -> f64 {
        let corners = self
            .bound
            .points()
            .iter()
            .filter(|point| (from..=to).contains(&point.x));
        let samples = (0..=20).map(|i| self.bound.height(from + (to - from) * f64::from(i) / 20.0));
        corners
            .map(|point| point.z)
            .chain(samples)
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// Cuts a slit. It needs edge up to the surface and must stay out of the part.
    pub(super) fn slit(&mut self, slit: Slit) {
        let column = self.xs.iter().position(|x| (x - slit.x).abs() < SAME).unwrap();
        let sides = [
            column.checked_sub(1),
            (column + 1 < self.xs.len()).then_some(column),
        ];
        let surface = sides
            .into_iter()
            .flatten()
            .map(|side| self.height(side))
            .fold(0.0, f64::max);
        assert!(surface > slit.bottom + SAME, "a slit in the air: {slit:?}");
        assert!((surface - slit.top).abs() < 1e-6, "{surface} {slit:?}");
        let lower = sides
            .into_iter()
            .flatten()
            .map(|side| self.height(side))
            .fold(surface, f64::min);
        assert!((lower - slit.uncut).abs() < 1e-6, "{lower} {slit:?}");
        assert!(lower > slit.bottom + SAME, "a slit beside a wall: {slit:?}");
        let covered = match self.blades.knife.covers {
            Cover::Standing => surface,
            Cover::Uncut => lower,
        };
        let deepest =
            self.blades.knife.edge.to_mm() * libm::sin(60.0_f64.to_radians() - 7.13_f64.to_radians());
        assert!(
            covered - slit.bottom <= deepest + 1.1e-3,
            "{} deep",
            covered - slit.bottom
        );
        let standoff = self.blades.knife.standoff.to_mm();
        let part = self.part_over(slit.x - standoff, slit.x + standoff);
        assert!(part <= slit.bottom + 1e-6, "{slit:?} enters the part at {part}");
        self.cut_slit(slit);
    }

    fn cut_slit(&mut self, slit: Slit) {
        let column = self.xs.iter().position(|x| (x - slit.x).abs() < SAME).unwrap();
        for row in 0..self.zs.len() - 1 {
            if self.zs[row] > slit.bottom - SAME {
                self.cut_left[column][row] = true;
            }
        }
    }

    /// Makes a pass and returns the area that comes free with it; the reason where the disc may not go there.
    pub(super) fn pass(&mut self, pass: Pass) -> Result<f64, String> {
        let wheel = &self.blades.wheel;
        let (radius, z) = (wheel.radius.to_mm(), pass.centre.z);
        let cover = (pass.centre.x - radius, pass.centre.x + radius);
        let part = self.part_over(cover.0.max(0.0), cover.1.min(self.xs[self.xs.len() - 1]));
        if part > z + 1e-6 {
            return Err(format!("the part reaches {part} over {pass:?}"));
        }
        for column in 0..self.xs.len() - 1 {
            let (from, to) = (self.xs[column], self.xs[column + 1]);
            let within = |left: f64, right: f64| from >= left - SAME && to <= right + SAME;
            let aside = match pass.open {
                Side::Left => within(cover.0, pass.left),
                Side::Right => within(pass.right, cover.1),
            };
            if aside && self.height(column) > z + 1e-6 {
                return Err(format!(
                    "material up to {} under the disc at {from}",
                    self.height(column)
                ));
            }
            for shaft in &wheel.body {
                // Centres on the grid may lie up to a grid point nearer.
                let room = (shaft.radius + wheel.clearance).to_mm() - 1.1e-3;
                let is_under = within(pass.centre.x - room, pass.centre.x + room);
                if is_under && self.height(column) > z + shaft.from.to_mm() + 1e-6 {
                    return Err(format!(
                        "material up to {} under the body at {from}",
                        self.height(column)
                    ));
                }
            }
        }
        let row = self.zs.iter().position(|line| (line - z).abs() < SAME);
        if let Some(row) = row.filter(|row| *row < self.zs.len() - 1) {
            for column in 0..self.xs.len() - 1 {
                if self.xs[column] >= cover.0 - SAME && self.xs[column + 1] <= cover.1 + SAME {
                    self.cut_below[column][row] = true;
                }
            }
        }
        Ok(self.release())
    }

    /// Takes out what does not hang together with the bottom, and returns its area.
    fn release(&mut self) -> f64 {
        let (columns, rows) = (self.there.len(), self.zs.len() - 1);
        let mut held = vec![vec![false; rows]; columns];
        let mut open: Vec<(usize, usize)> = (0..columns)
            .filter(|&c| self.there[c][0])
            .map(|c| (c, 0))
            .collect();
        while let Some((column, row)) = open.pop() {
            if core::mem::replace(&mut held[column][row], true) {
                continue;
            }
            let mut go = |c: usize, r: usize, cut: bool| {
                if !cut && self.there[c][r] && !held[c][r] {
                    open.push((c, r));
                }
            };
            if column > 0 {
                go(column - 1, row, self.cut_left[column][row]);
            }
            if column + 1 < columns {
                go(column + 1, row, self.cut_left[column + 1][row]);
            }
            if row > 0 {
                go(column, row - 1, self.cut_below[column][row]);
            }
            if row + 1 < rows {
                go(column, row + 1, self.cut_below[column][row + 1]);
            }
        }
        let mut area = 0.0;
        for (column, held) in held.iter().enumerate() {
            for (row, held) in held.iter().enumerate() {
                if self.there[column][row] && !held {
                    self.there[column][row] = false;
                    area += (self.xs[column + 1] - self.xs[column]) * (self.zs[row + 1] - self.zs[row]);
                }
            }
        }
        area
    }

    /// The area that stands above a height over a stretch.
    fn area_above(&self, (from, to): (f64, f64), floor: f64) -> f64 {
        let columns = (0..self.there.len())
            .filter(|&column| self.xs[column] >= from - SAME && self.xs[column + 1] <= to + SAME);
        let above = |column: usize| (self.height(column) - floor).max(0.0);
        columns
            .map(|column| (self.xs[column + 1] - self.xs[column]) * above(column))
            .sum()
    }

    /// Carries a stage out. Beside each strip, so much of its neighbours may come out with it.
    fn carry_out(&mut self, stage: &Stage, slivers: f64) {
        match stage {
            Stage::Slits { slits, .. } => {
                assert!(!slits.is_empty());
                for &slit in slits {
                    self.slit(slit);
                    // What a rim of the plan before has cut under is cut off on its last side.
                    let loose = self.release();
                    let most = 2.0 * slivers * (slit.top - slit.bottom);
                    assert!(loose <= most + 1e-6, "{loose} comes out by {slit:?}");
                }
            }
            Stage::Strips { strips, layers } => {
                assert!(!strips.is_empty());
                for strip in strips {
                    assert!(layers.contains(&strip.layer));
                    let extent = (strip.left, strip.right);
                    let around = (strip.left - slivers, strip.right + slivers);
                    let highest = self.highest_over(strip.left, strip.right);
                    assert!(highest <= strip.top + 1e-6, "{highest}: {strip:?}");
                    assert!(
                        slivers > 0.0 || highest >= strip.top - 1e-6,
                        "{highest}: {strip:?}"
                    );
                    let whole = self.area_above(extent, strip.floor);
                    let most = self.area_above(around, strip.floor).max(whole);
                    let area = self
                        .pass(pass_of(strip))
                        .unwrap_or_else(|why| panic!("{why}: {strip:?}"));
                    assert!(
                        area > whole - 1e-6 && area < most + 1e-6,
                        "{area} instead of {whole}: {strip:?}"
                    );
                }
            }
        }
    }

    /// Cuts a slit without looking, to see what could come free.
    pub(super) fn presume(&mut self, slit: Slit) {
        self.cut_slit(slit);
    }

    /// The highest place of what stands over a stretch.
    pub(super) fn highest_over(&self, from: f64, to: f64) -> f64 {
        let columns = (0..self.there.len())
            .filter(|&column| self.xs[column] >= from - SAME && self.xs[column + 1] <= to + SAME);
        columns.map(|column| self.height(column)).fold(0.0, f64::max)
    }

    /// The height of what stands over x.
    pub(super) fn height_over(&self, x: f64) -> f64 {
        let column = self.xs.partition_point(|line| *line <= x).saturating_sub(1);
        self.height(column.min(self.there.len() - 1))
    }
}

/// Carries plans out before the judge, one after the other: every strip must come free when its turn comes, and nothing else.
pub(super) fn carried_out(sample: &Sample, bound: &Profile, blades: &Blades, plans: &[&PlannedRect]) {
    let slits: Vec<Slit> = plans.iter().flat_map(|plan| plan.slits()).copied().collect();
    let passes: Vec<Pass> = plans.iter().flat_map(|plan| plan.strips()).map(pass_of).collect();
    let mut judge = Judge::new(sample, bound, blades, &slits, &passes);
    for (number, plan) in plans.iter().enumerate() {
        // Between a slit and a wall of the plan before, the rims of two passes may free more than the strip.
        let slivers = if number == 0 {
            0.0
        } else {
            2.0 * blades.wheel.beyond.to_mm()
        };
        for stage in &plan.stages {
            judge.carry_out(stage, slivers);
        }
        let mut less = 0.0;
        for pair in plan.contour.windows(2) {
            let (x, width) = ((pair[0].x + pair[1].x) / 2.0, pair[1].x - pair[0].x);
            if width > 1e-6 {
                let height = judge.height_over(x);
                assert!(height <= pair[0].z + 1e-6, "the contour at {x}: {height}");
                less += if height < pair[0].z - 1e-6 { width } else { 0.0 };
            }
        }
        let most = slivers * plan.strips().count() as f64;
        assert!(less <= most + 1e-6, "{less} mm of the contour are lower");
    }
}

pub(super) fn pass_of(strip: &Strip) -> Pass {
    Pass {
        centre: strip.centre,
        left: strip.left,
        right: strip.right,
        open: strip.open,
    }
}
