//! Cuts along columns: chains that each have a way of their own, with the knots of all others.
//!
//! The way of a tip and the planes of its blade are taken from the program. At an end of its chain the plane has the slope of the way, and
//! at a knot the mean of the slopes before and after it. Such a blade cuts a V at every y, but for what it lies off a way that bends
//! ([`Spine::deviation`]), and what its way or its posture is off by rounding, blending and turning, as along a spine.
//!
//! Chips come out by the rule of [`crate::slab`], at every y at once: a flank may lie lower by all of that, and what others have left
//! higher by all of theirs. The part is entered where the lower side of a V is below its cover at a knot ([`vcutc_geometry::columns`]): at
//! a tip that is below the cover raised so that no flank is steeper.
//!
//! What the cuts leave is shown as it is seen from the lower ends of ways, and there by Vs that open less than these do, as the
//! steepest section of each shows it: what is left is nowhere higher.

use super::along::{ChainPiece, OFF, OpenChain, Plane, Strayed, edge_on, overhang};
use super::flank::FlankGeometry;
use super::{Cut, Player, VNumber};
use crate::slab::{Slabs, Walls};
use crate::surface::{Side, Vee};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use vcutc_backend_api::geometry::{Orientation, Point3};
use vcutc_backend_api::ir::{Flank, OrientationId, Straight};
use vcutc_backend_api::segments::Segment;
use vcutc_backend_api::units::Length;
use vcutc_geometry::columns::{Column, Columns, stations};
use vcutc_geometry::cone::clearance;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::grid;
use vcutc_geometry::profile::Profile;
use vcutc_geometry::spine::{Deviation, Knot, Spine, Station};

/// The columns that the cuts of an operation keep to.
#[derive(Clone, Copy, Debug)]
pub struct ColumnsBound<'p> {
    /// The columns, whose cover is that of the part.
    pub columns: &'p Columns,
    /// What is to stay on the part.
    pub allowance: Length,
    /// How its cuts are made.
    pub made: Made,
}

/// How cuts along columns are made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Made {
    /// As chains.
    AsChains,
    /// Level cuts stand for them while plans are compared: each is looked at as if it followed its column, with flanks that lie off
    /// their Vs by that.
    Level(Deviation),
}

/// How much the slopes of flanks may differ: rounding of postures.
const ALIKE: f64 = 1e-6;

/// Cuts along columns.
#[derive(Default)]
pub(super) struct AlongColumns {
    /// The Vs that are out.
    slabs: Slabs,
    /// The chain that is not at its end.
    open: OpenChain,
    /// Flanks of Vs whose other flank is not cut yet.
    half_done: BTreeMap<VNumber, (Cut, Followed)>,
    /// Vs of which a flank left its way.
    strayed: BTreeSet<VNumber>,
    /// How far any flank so far may lie above its V.
    above: f64,
    /// The slope of all flanks, and where tips must stay for them, at each knot.
    clear: Option<(f64, Vec<Profile>)>,
    /// How far flanks lie off their Vs, by the bits of x and of how far the blade reaches: of ways that rise so.
    deviations: BTreeMap<[u64; 2], (Vec<f64>, Deviation)>,
    /// How much Vs open towards the lower ends of ways, by the bits of x.
    openings: BTreeMap<u64, [f64; 2]>,
}

impl AlongColumns {
    pub(super) fn into_columns(self) -> Vec<Column> {
        self.slabs.into_columns()
    }
}

/// A flank along a column.
#[derive(Clone, Debug)]
struct Followed {
    column: Column,
    side: Side,
    geometry: FlankGeometry,
    /// How far it may lie off its V.
    off: Deviation,
}

/// A place of a chain, and how the blade is held there.
type Place = (Point3, OrientationId);

impl Player<'_> {
    /// A piece of a chain of an operation whose cuts keep to columns.
    pub(super) fn follow_column(&mut self, segment: &Segment<'_>, bound: ColumnsBound<'_>, blade: Straight) {
        let Some(piece) = ChainPiece::of(segment) else {
            return;
        };
        let Some((places, has_arc)) = self.columns.open.add(&piece) else {
            return;
        };
        let last = piece.line.to;
        let followed = if has_arc {
            Err(Strayed {
                y: last.tip.y,
                by: blade.cutting_length.to_mm(),
            })
        } else {
            self.followed(&places, bound.columns, blade)
        };
        let cut = Cut {
            operation: piece.operation,
            layer: piece.layer,
            cut: piece.cut,
            flank: match followed.as_ref().map(|followed| followed.side) {
                Ok(Side::Left) | Err(_) => Flank::Left,
                Ok(Side::Right) => Flank::Right,
            },
            tip: followed.as_ref().map_or_else(
                |_| Point2::new(last.tip.x, last.tip.z),
                |line| lower_end(&line.column),
            ),
            held: last.orientation,
            tool: segment.before.tool,
        };
        match followed {
            Ok(followed) => self.flank_on(cut, followed, bound),
            Err(strayed) => {
                let place = (cut.layer, cut.cut);
                self.columns.half_done.remove(&place);
                self.columns.strayed.insert(place);
                self.note_strayed(&cut, strayed);
            }
        }
    }

    /// The flank that a blade cuts on its way through some places, if it is one along a column over all of the stock.
    fn followed(
        &mut self,
        places: &[Place],
        columns: &Columns,
        blade: Straight,
    ) -> Result<Followed, Strayed> {
        let edge = blade.cutting_length.to_mm();
        let nowhere = Strayed { y: 0.0, by: edge };
        let chain = self.chain(places).ok_or(nowhere)?;
        let flank = chain.across.abs();
        let known = self.columns.clear.as_ref().map_or(flank, |(known, _)| *known);
        let moved = chain.moved(columns, edge)?;
        if (flank - known).abs() > ALIKE {
            let by = edge * (libm::atan(flank) - libm::atan(known)).abs();
            return Err(Strayed { by, ..nowhere });
        }
        let x = chain.x();
        let tips = chain.tips(columns.knots());
        let deviation = self.lies_off((x, &tips), columns.knots(), overhang(&chain.held, blade));
        let deviation = deviation.ok_or(nowhere)?;
        let off = chain.off(moved, edge, self.program.blend.to_mm());
        let edges = chain.held.iter().zip(&chain.stations);
        let edges = edges.map(|((_, held), station)| edge_on(*held, station.slope, blade, flank));
        Ok(Followed {
            column: Column {
                x,
                tips,
                flank: known,
            },
            // Looking along y, a plane that rises to the left is that of a left flank.
            side: if chain.across < 0.0 {
                Side::Left
            } else {
                Side::Right
            },
            geometry: FlankGeometry {
                slope: known,
                edge_per_height: edges.fold(0.0, f64::max),
            },
            off: Deviation {
                above: deviation.above + off,
                below: deviation.below + off,
            },
        })
    }

    /// A chain, from its lesser y on; none where its places do not follow each other along y.
    fn chain(&self, places: &[Place]) -> Option<Chain> {
        let held: Option<Vec<(Point3, Orientation)>> = places
            .iter()
            .map(|&(tip, held)| Some((tip, self.program.orientation(held)?)))
            .collect();
        let mut held = held?;
        if held.first()?.0.y > held.last()?.0.y {
            held.reverse();
        }
        let way: Vec<Knot> = held
            .iter()
            .map(|(tip, _)| Knot {
                y: tip.y,
                rise: tip.z,
            })
            .collect();
        let is_ordered = way.len() >= 2 && way.windows(2).all(|pair| pair[0].y < pair[1].y);
        let across = Plane::of(held.first()?.1).across;
        is_ordered.then(|| Chain {
            held,
            stations: stations(&way),
            across,
        })
    }

    /// How far the flanks of a blade that reaches so far along y lie off the Vs of tips; none where it could not follow them.
    fn lies_off(&mut self, (x, tips): (f64, &[f64]), knots: &[f64], overhang: f64) -> Option<Deviation> {
        let least = tips.iter().copied().fold(f64::INFINITY, f64::min);
        // Up to rounding, which ends beyond the stock are put on.
        let on_grid = |rise: f64| grid::nearest(rise - least);
        let rises: Vec<f64> = tips.iter().map(|&tip| on_grid(tip)).collect();
        let key = [x.to_bits(), overhang.to_bits()];
        if let Some((known, deviation)) = self.columns.deviations.get(&key)
            && *known == rises
        {
            return Some(*deviation);
        }
        let places = knots.iter().zip(&rises);
        let spine = Spine::new(places.map(|(&y, &rise)| Knot { y, rise }).collect()).ok()?;
        let deviation = if knots.len() == 2 {
            Deviation::default()
        } else {
            spine.deviation(overhang)
        };
        self.columns.deviations.insert(key, (rises, deviation));
        Some(deviation)
    }

    fn flank_on(&mut self, cut: Cut, followed: Followed, bound: ColumnsBound<'_>) {
        let stock = self.program.stock;
        let stock = Walls {
            width: stock.width.to_mm(),
            height: stock.height.to_mm(),
        };
        self.columns.above = self.columns.above.max(followed.off.above);
        let lower = followed.column.lowered(followed.off.below + self.columns.above);
        let reach = self.columns.slabs.reach(&lower, followed.side, stock);
        self.use_edge(reach * followed.geometry.edge_per_height, &cut);
        self.note_below_cover(&cut, &followed, bound);
        let place = (cut.layer, cut.cut);
        if self.columns.strayed.contains(&place) {
            return;
        }
        match self.columns.half_done.remove(&place) {
            Some((_, other)) if other.side != followed.side && other.column == followed.column => {
                self.release_column(followed.column, bound.columns);
            }
            Some((before, _)) => {
                self.note_unfreed(&before);
                self.columns.half_done.insert(place, (cut, followed));
            }
            None => {
                self.columns.half_done.insert(place, (cut, followed));
            }
        }
    }

    /// Notes where the lower side of a V is below the cover of the part at a knot.
    fn note_below_cover(&mut self, cut: &Cut, followed: &Followed, bound: ColumnsBound<'_>) {
        let drop = self.bounds.get(usize::from(cut.operation.0));
        let drop = drop.map_or(0.0, |bound| bound.drop.to_mm()) + followed.off.below;
        let column = &followed.column;
        let clear = self.columns.clear.get_or_insert_with(|| {
            let covers = bound.columns.covers_with(bound.allowance).into_iter();
            let clear = covers.map(|cover| clearance(&cover, column.flank));
            (column.flank, clear.collect())
        });
        let entries = clear.1.iter().zip(&*column.tips);
        let depth = entries.map(|(clear, tip)| clear.height(column.x) - (tip - drop));
        let depth = depth.fold(f64::NEG_INFINITY, f64::max);
        let program = self.program;
        self.note_entry(lower_end(column), depth, |fault| cut.finding(program, fault));
    }

    /// Takes the chip of a V out both flanks of which are cut.
    fn release_column(&mut self, column: Column, columns: &Columns) {
        let tip = Point2::new(column.x, columns.lower_end(column.x, &column.tips));
        let known = self.columns.openings.entry(column.x.to_bits());
        let opening = *known.or_insert_with(|| columns.opening(column.x));
        let [left, right] = opening.map(|more| column.flank + more);
        self.columns.slabs.release(column);
        self.section
            .release(Vee::one(tip, Side::Left, left).with(Side::Right, right));
    }

    /// A level cut of an operation whose cuts keep to columns: it is off its column, or stands for one.
    pub(super) fn level_for_column(
        &mut self,
        cut: &Cut,
        geometry: FlankGeometry,
        bound: ColumnsBound<'_>,
        side: Side,
    ) {
        let columns = bound.columns;
        match bound.made {
            Made::AsChains => {
                let by = columns.steepest() * columns.depth();
                self.note_strayed(cut, Strayed { y: 0.0, by });
            }
            Made::Level(off) => {
                let stations = columns.stations(cut.tip.x, [0.0, columns.depth()]);
                let column = Column {
                    x: cut.tip.x,
                    tips: stations.iter().map(|station| cut.tip.z + station.rise).collect(),
                    flank: geometry.slope,
                };
                let followed = Followed {
                    column,
                    side,
                    geometry,
                    off,
                };
                self.flank_on(cut.clone(), followed, bound);
            }
        }
    }

    /// Notes Vs along columns of which only one flank was cut.
    pub(super) fn note_half_done_of_columns(&mut self) {
        for (cut, _) in core::mem::take(&mut self.columns.half_done).into_values() {
            self.note_unfreed(&cut);
        }
        self.columns.strayed.clear();
    }
}

/// A chain along a column, from its lesser y on.
struct Chain {
    held: Vec<(Point3, Orientation)>,
    stations: Vec<Station>,
    /// Rise of the blade's plane over x.
    across: f64,
}

impl Chain {
    /// Where it runs across the cuts.
    fn x(&self) -> f64 {
        self.held.first().map_or(0.0, |(tip, _)| tip.x)
    }

    fn is_end(&self, number: usize) -> bool {
        number == 0 || number + 1 == self.held.len()
    }

    /// How far the tip, or by its turn the end of an edge of that length, is off one that runs straight along y, through the knots and with
    /// the plane of the blade along its way.
    fn moved(&self, columns: &Columns, edge: f64) -> Result<f64, Strayed> {
        let ([first, .., last], knots) = (self.stations.as_slice(), columns.knots()) else {
            return Err(Strayed { y: 0.0, by: edge });
        };
        let short = first.y.max(columns.depth() - last.y);
        if short > 0.0 {
            return Err(Strayed {
                y: first.y,
                by: short,
            });
        }
        if self.held.len() != knots.len() {
            // A chain that has other places than the knots lies elsewhere in between.
            return Err(Strayed { y: last.y, by: edge });
        }
        let mut moved = 0.0_f64;
        let places = self.held.iter().zip(&self.stations).zip(knots).enumerate();
        for (number, (((tip, held), station), knot)) in places {
            let along = if self.is_end(number) { 0.0 } else { tip.y - knot };
            let plane = Plane::of(*held);
            let turned = if plane.is_inclined() {
                plane.turned_from(station, self.across)
            } else {
                core::f64::consts::FRAC_PI_2
            };
            let by = (tip.x - self.x()).abs().max(along.abs()).max(edge * turned);
            if by > OFF {
                return Err(Strayed { y: tip.y, by });
            }
            moved = moved.max(by);
        }
        Ok(moved)
    }

    /// How far its flank may lie off what a blade makes that turns evenly on the chords between its places, where it is moved so far
    /// and may leave its way within a chain by `blend`.
    fn off(&self, moved: f64, edge: f64, blend: f64) -> f64 {
        let turns = self.held.windows(2);
        let turns = turns.map(|pair| pair[0].1.angle_to(pair[1].1).to_rad());
        let turn = turns.fold(0.0, f64::max);
        let blend = if self.held.len() > 2 { blend } else { 0.0 };
        let slopes = self.stations.iter().map(|station| station.slope.abs());
        // A piece is no steeper than that: its ends have the mean of its slope and that beside it.
        let steepest = slopes.fold(0.0, f64::max) + Spine::LARGEST_BEND;
        let steep = 1.0 + self.across * self.across + steepest * steepest;
        (moved + blend + edge * turn * turn / 8.0) * steep.sqrt()
    }

    /// Its heights at the knots, near to which it passes, and at the sides of the stock.
    fn tips(&self, knots: &[f64]) -> Arc<[f64]> {
        let places = self.stations.iter().zip(knots).enumerate();
        places
            .map(|(number, (station, &knot))| {
                if self.is_end(number) {
                    // At an end the station has the slope of the piece.
                    station.rise + station.slope * (knot - station.y)
                } else {
                    station.rise
                }
            })
            .collect()
    }
}

/// Where the lower end of a way runs.
fn lower_end(column: &Column) -> Point2 {
    Point2::new(column.x, column.lowest())
}
