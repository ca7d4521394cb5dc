//! The part as it is drawn: curves, formulas and sections of drawings stay what they are until a stage needs lines.
//!
//! A part is a profile, the same at every y, or a surface.
//!
//! Checking a job proves that a profile is one height at every x of the stock, and within it, at the tolerance [`Part::TOLERANCE`]. A
//! checked job keeps the curves. Planning tessellates them once, at the same tolerance; what comes after it, proofs, pictures and
//! reports, uses the polyline of the plan.

mod formula;
mod section;
mod strip;

pub(crate) use formula::{Formula, Sampling};
pub(crate) use section::Section;
pub(crate) use strip::{REACHES, SAME, Strip};

use crate::follow::Guide;
use std::sync::{Arc, OnceLock};
use vcutc_backend_api::ir::Stock;
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::source::Span;
use vcutc_geometry::columns::Column;
use vcutc_geometry::curve::{Curve, Point2};
use vcutc_geometry::profile::{Profile, ProfileError};
use vcutc_geometry::spine::Spine;
use vcutc_surface::bend::{Bend, Exact};
use vcutc_surface::columns::{Covered, Each};
use vcutc_surface::map::Cells;
use vcutc_surface::residual::Machined;
use vcutc_surface::spine::{Fitted, Rising};
use vcutc_surface::surface::Surface;

/// The part across the stock.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    shape: Shape,
    /// From x = 0 to here, in mm.
    width: f64,
}

/// What a part is drawn as.
#[derive(Clone, Debug, PartialEq)]
enum Shape {
    /// Pieces end to end, cut off at the sides of the stock, the same at every y.
    Profile(Arc<[Piece]>),
    Surface(Arc<Shaded>),
}

/// A surface with its shadow, shared by all that look at it.
#[derive(Debug)]
pub struct Shaded {
    surface: Arc<Surface>,
    /// Its curvature, where what it is given by has derivatives.
    exact: Option<Exact>,
    /// How cuts follow it; none where they are level.
    followed: Option<Followed>,
    /// Its greatest height over each x, with what cuts follow taken off.
    shadow: Profile,
    /// How cuts might follow it, computed once: a surface outlives a run.
    ways: [OnceLock<Option<Way>>; 2],
    /// The columns that cover it, straight and curved, likewise.
    own: [OnceLock<Option<OwnWay>>; 2],
}

/// A way to follow a surface.
#[derive(Debug)]
struct Way {
    fitted: Fitted,
    /// The surface with all cuts along its spine; none where it has no shadow then.
    along: OnceLock<Option<Arc<Shaded>>>,
}

/// A way of its own for each cut over a surface.
#[derive(Debug)]
struct OwnWay {
    covered: Covered,
    /// The surface with every cut along its column.
    along: OnceLock<Arc<Shaded>>,
}

/// How all cuts follow a surface.
#[derive(Debug)]
struct Followed {
    guide: Guide,
    /// The surface with the spine taken off; none where each cut follows a way of its own.
    levelled: Option<Surface>,
}

impl Shaded {
    fn of(surface: Arc<Surface>, exact: Option<Exact>, followed: Option<Followed>, shadow: Profile) -> Self {
        Self {
            surface,
            exact,
            followed,
            shadow,
            ways: [const { OnceLock::new() }; 2],
            own: [const { OnceLock::new() }; 2],
        }
    }

    /// The surface.
    #[must_use]
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    fn way(&self, rising: Rising) -> Option<&Way> {
        let [evenly, freely] = &self.ways;
        let way = match rising {
            Rising::Evenly => evenly,
            Rising::Freely => freely,
        };
        let fit = || {
            self.surface.spine(rising).map(|fitted| Way {
                fitted,
                along: OnceLock::new(),
            })
        };
        way.get_or_init(fit).as_ref()
    }

    /// With all cuts along a spine in a stock of that height.
    fn along(&self, spine: &Spine, height: Length) -> Option<Self> {
        let levelled = self.surface.levelled(spine).ok()?;
        let shadow = levelled.shadow().ok()?;
        let shadow = shadow.raised(levelled.accuracy().tolerance, height);
        // Where the spine rises above the part, cuts go down to the bottom of the stock where the spine is lowest, and no further.
        let shadow = shadow.not_below(Length::ZERO);
        let followed = Followed {
            guide: Guide::Spine(Arc::new(spine.clone())),
            levelled: Some(levelled),
        };
        let exact = self.exact.clone();
        Some(Self::of(Arc::clone(&self.surface), exact, Some(followed), shadow))
    }

    fn own_way(&self, each: Each) -> Option<&OwnWay> {
        let [straight, curved] = &self.own;
        let way = match each {
            Each::Straight => straight,
            Each::Curved => curved,
        };
        let cover = || {
            self.surface.columns(each).map(|covered| OwnWay {
                covered,
                along: OnceLock::new(),
            })
        };
        way.get_or_init(cover).as_ref()
    }

    /// With every cut along its column, in a stock of that height.
    fn covered(&self, covered: &Covered, height: Length) -> Self {
        let shadow = covered.columns.shadow().not_above(height);
        let followed = Followed {
            guide: Guide::Columns(Arc::clone(&covered.columns)),
            levelled: None,
        };
        let exact = self.exact.clone();
        Self::of(Arc::clone(&self.surface), exact, Some(followed), shadow)
    }

    /// What all cuts that rough the surface follow; none where they are level.
    #[must_use]
    pub fn guide(&self) -> Option<&Guide> {
        self.followed.as_ref().map(|followed| &followed.guide)
    }

    /// The spine of all cuts that rough the surface; none where they are level.
    #[must_use]
    pub fn spine(&self) -> Option<&Arc<Spine>> {
        match self.guide()? {
            Guide::Spine(spine) => Some(spine),
            Guide::Columns(_) => None,
        }
    }

    /// The surface as it is seen across the cuts: with their spine taken off. Columns have none.
    #[must_use]
    pub fn levelled(&self) -> &Surface {
        let levelled = self
            .followed
            .as_ref()
            .and_then(|followed| followed.levelled.as_ref());
        levelled.unwrap_or(&self.surface)
    }
}

/// The shadow follows from the surface and what cuts follow. A surface of a million triangles is not compared with itself.
impl PartialEq for Shaded {
    fn eq(&self, other: &Self) -> bool {
        let is_same = || Arc::ptr_eq(&self.surface, &other.surface) || self.surface == other.surface;
        let is_as_exact = self.exact.is_some() == other.exact.is_some();
        core::ptr::eq(self, other) || (self.guide() == other.guide() && is_as_exact && is_same())
    }
}

/// A piece of a part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Piece {
    /// Points joined by straight lines, the first one included.
    Points(Vec<Point2>),
    /// A curve, from where the piece before it ended.
    Curve(Curve),
    /// What a drawing shows.
    Section(Section),
    /// A height by formula.
    Formula(Formula),
}

impl Part {
    /// How far the polyline of a part may be off its curves: far below what a knife can do in honeycomb.
    pub const TOLERANCE: Length = Length::mm(0.001);

    /// How far the triangles of a surface that is given by profiles or by a formula may be off it.
    pub const SURFACE_TOLERANCE: Length = Length::mm(0.01);

    /// Of pieces that were checked on a stock of this width, in mm.
    pub(crate) fn new(pieces: Vec<Piece>, width: f64) -> Self {
        Self {
            shape: Shape::Profile(pieces.into()),
            width,
        }
    }

    /// All of a stock.
    pub(crate) fn whole(stock: Stock) -> Self {
        let [width, height] = [stock.width, stock.height].map(Length::to_mm);
        Self::new(
            vec![Piece::Points(vec![
                Point2::new(0.0, height),
                Point2::new(width, height),
            ])],
            width,
        )
    }

    /// Of a surface that was checked on the stock, with its curvature, where that is known exactly, and its shadow.
    pub(crate) fn of_surface(surface: Surface, exact: Option<Exact>, shadow: Profile) -> Self {
        let width = surface.plan().width.to_mm();
        Self {
            shape: Shape::Surface(Arc::new(Shaded::of(Arc::new(surface), exact, None, shadow))),
            width,
        }
    }

    /// The best spine that rises so. None where level cuts are as good, and where the part is not a surface.
    #[must_use]
    pub fn fitted(&self, rising: Rising) -> Option<&Fitted> {
        match &self.shape {
            Shape::Surface(shaded) => Some(&shaded.way(rising)?.fitted),
            Shape::Profile(_) => None,
        }
    }

    /// The same part, with all cuts that rough it along that spine. None without such a spine or shadow.
    pub(crate) fn along(&self, rising: Rising, stock: Stock) -> Option<Self> {
        let Shape::Surface(shaded) = &self.shape else {
            return None;
        };
        let way = shaded.way(rising)?;
        let along = || shaded.along(&way.fitted.spine, stock.height).map(Arc::new);
        let along = way.along.get_or_init(along).as_ref()?;
        Some(Self {
            shape: Shape::Surface(Arc::clone(along)),
            width: self.width,
        })
    }

    /// The columns that suit it best. None where none cover it, and where the part is not a surface.
    pub(crate) fn covered(&self, each: Each) -> Option<&Covered> {
        match &self.shape {
            Shape::Surface(shaded) => Some(&shaded.own_way(each)?.covered),
            Shape::Profile(_) => None,
        }
    }

    /// How high material stays at most along straight lines with slopes of their own that are infinitely close, in mm; none where none
    /// cover it, and where the part is not a surface.
    #[must_use]
    pub fn left_by_lines(&self) -> Option<f64> {
        self.covered(Each::Straight).map(|covered| covered.leaves)
    }

    /// The same part, with every cut that roughs it along its column. None where that does not exist.
    pub(crate) fn along_columns(&self, each: Each, stock: Stock) -> Option<Self> {
        let Shape::Surface(shaded) = &self.shape else {
            return None;
        };
        let way = shaded.own_way(each)?;
        let along = || Arc::new(shaded.covered(&way.covered, stock.height));
        Some(Self {
            shape: Shape::Surface(Arc::clone(way.along.get_or_init(along))),
            width: self.width,
        })
    }

    /// What the cuts that rough a part follow; none where they are level.
    #[must_use]
    pub fn guide(&self) -> Option<&Guide> {
        match &self.shape {
            Shape::Surface(shaded) => shaded.guide(),
            Shape::Profile(_) => None,
        }
    }

    /// The surface of a part that changes along y.
    #[must_use]
    pub fn surface(&self) -> Option<&Surface> {
        match &self.shape {
            Shape::Surface(shaded) => Some(shaded.surface()),
            Shape::Profile(_) => None,
        }
    }

    /// How it bends at the middles of cells; none of a part that is a profile.
    #[must_use]
    pub fn bends(&self, cells: Cells) -> Option<Vec<Option<Bend>>> {
        match &self.shape {
            Shape::Surface(shaded) => Some(shaded.surface.bends(cells, shaded.exact.as_ref())),
            Shape::Profile(_) => None,
        }
    }

    /// The same as cuts see it: with their spine taken off.
    #[must_use]
    pub fn levelled(&self) -> Option<&Surface> {
        match &self.shape {
            Shape::Surface(shaded) => Some(shaded.levelled()),
            Shape::Profile(_) => None,
        }
    }

    /// The spine of the cuts that rough a part; none where they are level.
    #[must_use]
    pub fn spine(&self) -> Option<&Arc<Spine>> {
        match &self.shape {
            Shape::Surface(shaded) => shaded.spine(),
            Shape::Profile(_) => None,
        }
    }

    /// What cuts leave that end at this contour, seen with what they follow taken off, from left to right; of columns what their Vs
    /// leave. None where that does not exist.
    #[must_use]
    pub fn left_by(&self, contour: &[Point2], columns: &[Column], stock: Stock) -> Option<Machined> {
        let machined = Machined::new(contour.to_vec()).ok()?;
        Some(match self.guide() {
            None => machined,
            Some(Guide::Spine(spine)) => machined.along(Arc::clone(spine), stock.height),
            Some(Guide::Columns(guide)) => machined.ruled(columns.to_vec(), guide.knots(), stock.height),
        })
    }

    /// The same with its shadow, and the spine of the cuts that rough it, to be kept.
    #[must_use]
    pub fn shared_surface(&self) -> Option<Arc<Shaded>> {
        match &self.shape {
            Shape::Surface(shaded) => Some(Arc::clone(shaded)),
            Shape::Profile(_) => None,
        }
    }

    /// Straight lines through points, up to the last of them.
    ///
    /// # Errors
    /// See [`ProfileError`].
    pub fn through(points: Vec<Point2>) -> Result<Self, ProfileError> {
        let width = Profile::new(points.clone())?.span().1;
        Ok(Self::new(vec![Piece::Points(points)], width))
    }

    /// The part's polyline, within a tolerance; none where a curve asks for too many points for that. Of a surface its shadow
    /// along y, the greatest height over each x, with the spine of its cuts taken off: cuts that keep clear of that keep clear of the
    /// part.
    #[must_use]
    pub fn tessellated(&self, tolerance: Length) -> Option<Profile> {
        let mut points = Vec::new();
        match &self.shape {
            Shape::Profile(pieces) => {
                for piece in &**pieces {
                    piece.tessellate(self.width, tolerance, &mut points)?;
                }
            }
            Shape::Surface(shaded) => points.extend_from_slice(shaded.shadow.points()),
        }
        Strip::cut(&points, self.width).profile(self.width).ok()
    }

    /// Replaces every place in the job's text by this one.
    pub(crate) fn forget_places(&mut self, place: Span) {
        let formula = |piece: &Piece| matches!(piece, Piece::Formula(_));
        // Nothing else knows where it is written.
        if let Shape::Profile(known) = &mut self.shape
            && known.iter().any(formula)
        {
            let mut pieces = known.to_vec();
            for piece in &mut pieces {
                if let Piece::Formula(formula) = piece {
                    formula.forget_places(place);
                }
            }
            *known = pieces.into();
        }
    }
}

impl Piece {
    fn tessellate(&self, width: f64, tolerance: Length, out: &mut Vec<Point2>) -> Option<()> {
        match self {
            Self::Points(points) => out.extend(points),
            Self::Curve(curve) => curve.flatten(tolerance, out).ok()?,
            Self::Section(section) => out.extend(section.points(tolerance)?),
            Self::Formula(formula) => out.extend(formula.points(width, tolerance)?),
        }
        Some(())
    }
}
