//! Pictures: SVG texts, made without fonts, clocks or chance, so that the same data gives the same bytes.
//!
//! Each picture takes plain numbers and knows nothing of jobs, plans and programs. What several of them share: the sheet
//! with its headings and legend (`sheet`), scales with round values (`scale`), the x-z section (`section`), plots of
//! curves (`plot`), paths in relative coordinates (`trace`), and curves of any number of points in as many as can be seen (`thin`).

pub mod blade;
pub mod contour;
pub mod correlation;
pub mod deviation;
pub mod heat_map;
pub mod joints;
pub mod lattice;
mod marks;
pub mod pareto;
pub mod paths;
mod plot;
mod scale;
mod section;
mod sheet;
mod svg;
pub mod thin;
pub mod times;
mod trace;

pub(crate) use svg::escaped;

/// What the ids within a picture begin with. Pictures that stand in one page need different ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Prefix(&'static str);

impl Prefix {
    /// For pictures that stand alone.
    pub const NONE: Self = Self("");

    /// Ids that begin with a name, which should begin with a letter and have no blanks, such as `lattice-`.
    #[must_use]
    pub const fn new(name: &'static str) -> Self {
        Self(name)
    }
}
