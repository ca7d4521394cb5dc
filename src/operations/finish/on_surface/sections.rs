//! What tracks on a surface free and leave, in sections across them.
//!
//! Roughing along y leaves the same at every y, and tracks lie side by side. So in a section across them a track shows as a pass of
//! a disc that takes the skin off ([`CrossSection::skim`]): in each of a number of sections the same questions have answers as on
//! parts that are the same at every y.

use super::way::Way;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::units::Length;
use vcutc_geometry::curve::Point2;
use vcutc_geometry::profile::Profile;
use vcutc_geometry::spine::Spine;
use vcutc_simulation::contour::farthest;
use vcutc_simulation::cross_section::{CrossSection, Guard};
use vcutc_simulation::disc::{Disc, Hold, PassFault, Stretch};
use vcutc_simulation::prove::{Across, Skin};
use vcutc_simulation::surface::Surface;
use vcutc_surface::shadow::Uncovered;
use vcutc_surface::surface;

/// How far sections lie apart, but for the most of them, in mm.
const APART: f64 = 10.0;

/// No work is looked at in more sections.
const MOST: f64 = 200.0;

/// The sections of a surface across the tracks, from y = 0 to the depth of the stock, evenly spaced.
#[derive(Clone, Debug)]
pub struct Sections(Vec<Section>);

#[derive(Clone, Debug)]
struct Section {
    y: f64,
    part: Profile,
    /// How high what roughing left stands above its section, in mm.
    rise: f64,
    /// The part as it lies in that section: lower by as much.
    seen: Profile,
}

/// What tracks do in all sections.
#[derive(Clone, Debug)]
pub struct Skimmed {
    /// What is wrong: of each section the faults of the first track that has some, from section to section.
    pub faults: Vec<Fault>,
    /// The most that stays on the part in each section.
    pub left: Vec<Left>,
    /// All that stays in each of them.
    pub across: Vec<Across>,
}

/// Something wrong with a track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// The track, from 0.
    pub track: usize,
    /// The y of the section, in mm.
    pub y: f64,
    /// Where the disc is then.
    pub centre: Point3,
    pub fault: PassFault,
}

/// What stays on the part in a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Left {
    /// The y of the section, in mm.
    pub y: f64,
    /// Where in it the most stays.
    pub at: Point2,
    /// How far that is from the part.
    pub height: Length,
    /// The area that stays in it, in mm2, and how long the part is in it, in mm.
    pub area: f64,
    pub length: f64,
}

impl Sections {
    /// Of a surface that cuts along a spine have roughed, which leave so much above it at most, in mm; or level ones.
    ///
    /// # Errors
    /// Where the surface has no height.
    pub fn of(surface: &surface::Surface, spine: Option<(&Spine, f64)>) -> Result<Self, Uncovered> {
        // What stands higher hangs on more and is thicker, so where the work may be it is taken to be.
        let rise = |y: f64| spine.map_or(0.0, |(spine, above)| spine.rise(y) + above);
        let depth = surface.plan().depth.to_mm();
        let count = (depth / APART).ceil().clamp(1.0, MOST - 1.0);
        let at = |number: u32| depth * f64::from(number) / count;
        let sections = (0..=count as u32).map(|number| {
            let y = at(number);
            surface.section(y).map(|part| Section {
                y,
                rise: rise(y),
                seen: part.lowered(Length::mm(rise(y))),
                part,
            })
        });
        Ok(Self(sections.collect::<Result<_, _>>()?))
    }

    /// How many there are.
    #[must_use]
    pub const fn count(&self) -> usize {
        self.0.len()
    }

    /// The part in each of them as it lies in what roughing left, with its y in mm.
    pub fn parts(&self) -> impl Iterator<Item = (f64, &Profile)> {
        self.0.iter().map(|section| (section.y, &section.seen))
    }

    /// Passes the disc on all ways, in turn, over what was left before.
    #[must_use]
    pub fn skim(&self, before: &Surface, ways: &[&Way], disc: &Disc, skin: Skin) -> Skimmed {
        let mut skimmed = Skimmed {
            faults: Vec::new(),
            left: Vec::with_capacity(self.0.len()),
            across: Vec::with_capacity(self.0.len()),
        };
        for section in &self.0 {
            let mut work = CrossSection::new(before.clone());
            let faults = section.skim(&mut work, ways, disc, skin);
            skimmed.faults.extend(faults);
            let machined: Vec<Point2> = work.into_surface().corners().collect();
            skimmed.left.push(section.left(&machined));
            skimmed.across.push(section.across(machined));
        }
        skimmed
    }
}

impl Skimmed {
    /// The fault of the earliest track.
    #[must_use]
    pub fn first(&self) -> Option<&Fault> {
        self.faults.iter().min_by_key(|fault| fault.track)
    }

    /// The mean height of what stays.
    #[must_use]
    pub fn mean(&self) -> Length {
        let sum = |value: fn(&Left) -> f64| self.left.iter().map(value).sum::<f64>();
        Length::mm(sum(|left| left.area) / sum(|left| left.length).max(1e-9))
    }

    /// The most that stays.
    #[must_use]
    pub fn most(&self) -> Option<&Left> {
        self.left.iter().max_by(|a, b| a.height.total_cmp(&b.height))
    }
}

impl Section {
    fn skim(&self, work: &mut CrossSection, ways: &[&Way], disc: &Disc, skin: Skin) -> Vec<Fault> {
        let guard = Guard::new(&self.part);
        let mut faults: Vec<Fault> = Vec::new();
        for (track, way) in ways.iter().enumerate() {
            let Some((mut pass, centre)) = way.pass(self.y, disc, skin, &guard) else {
                // It does not come so far, so what stands there hangs on.
                if faults.is_empty() {
                    faults.push(self.missed(track, way));
                }
                continue;
            };
            pass.centre.z -= self.rise;
            let found = work.skim(disc, &pass).faults;
            if faults.is_empty() {
                faults.extend(found.into_iter().map(|fault| Fault {
                    track,
                    y: self.y,
                    centre,
                    fault,
                }));
            }
        }
        faults
    }

    fn missed(&self, track: usize, way: &Way) -> Fault {
        let centre = way
            .poses()
            .first()
            .map_or(Point3::new(0.0, self.y, 0.0), |pose| pose.centre);
        let stretch = Stretch {
            from: centre.x,
            to: centre.x,
            height: Length::ZERO,
            highest: centre.x,
        };
        Fault {
            track,
            y: self.y,
            centre,
            fault: PassFault::Attached {
                stretch,
                hold: Hold::Closed,
            },
        }
    }

    /// The contour as it lies in the work.
    fn across(&self, mut machined: Vec<Point2>) -> Across {
        for corner in &mut machined {
            corner.z += self.rise;
        }
        Across { y: self.y, machined }
    }

    fn left(&self, machined: &[Point2]) -> Left {
        let (from, to) = self.seen.span();
        let most = farthest(machined, &self.seen);
        let under = vcutc_simulation::report::area_under(machined);
        Left {
            y: self.y,
            at: Point2::new(most.peak.x, most.peak.z + self.rise),
            height: most.height,
            area: under - self.seen.area_below(from, to).to_mm2(),
            length: self.part.arc_length().to_mm(),
        }
    }
}
