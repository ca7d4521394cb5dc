//! Pictures: SVG texts, made without fonts, clocks or chance, so that the same data gives the same bytes.
//!
//! Each picture takes plain numbers and knows nothing of jobs, plans and programs. What several of them share: the sheet
//! with its headings and legend (`sheet`), scales with round values (`scale`), charts of series over two axes (`chart`), the
//! x-z section (`section`), panels over the time of a program (`over_time`), maps seen from above (`tiles`), solids in space
//! (`projection`), what lies between the lowest and the highest of a curve (`band`), colours and their partners on a dark ground
//! (`palette`), paths in relative coordinates (`trace`), and curves of any number of points in as many as can be seen (`thin`).

mod band;
pub mod blade;
pub mod by_forces;
mod chart;
pub mod class_map;
pub mod contour;
pub mod correlation;
pub mod deviation;
pub mod ground;
pub mod heat_map;
pub mod joints;
pub mod lattice;
pub mod over_time;
mod palette;
pub mod pareto;
pub mod passes;
pub mod paths;
pub mod plan_map;
pub mod processes;
mod projection;
mod scale;
mod section;
pub mod sections;
pub mod setup;
mod sheet;
pub mod strips;
mod svg;
pub mod thin;
mod tiles;
pub mod times;
pub mod torques;
mod trace;
pub mod tracks;
pub mod wave;

pub use palette::dark;
pub use sheet::{PAGE_WIDTH, PHONE_WIDTH};
pub use svg::escaped;

/// A place in a picture, or a point of a plane.
type Point = [f64; 2];

/// What the ids within a picture begin with, and where it is shown. Pictures that stand in one page need different ids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Prefix {
    ids: &'static str,
    setting: Setting,
}

/// Where a picture is shown: decides how wide it is drawn, and whether its words stand on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Setting {
    /// By itself, with title and subtitle.
    Alone,
    /// In a page on a wide screen or on paper, which has the words.
    Page,
    /// In a page on a telephone.
    Phone,
}

impl Prefix {
    /// For pictures that stand alone.
    pub const NONE: Self = Self {
        ids: "",
        setting: Setting::Alone,
    };

    /// Ids that begin with a name, which should begin with a letter and have no blanks, such as `lattice-`: for a page that is
    /// as wide as [`PAGE_WIDTH`].
    #[must_use]
    pub const fn new(name: &'static str) -> Self {
        Self {
            ids: name,
            setting: Setting::Page,
        }
    }

    /// The same for the screen of a telephone, [`PHONE_WIDTH`] wide.
    #[must_use]
    pub const fn for_phones(name: &'static str) -> Self {
        Self {
            ids: name,
            setting: Setting::Phone,
        }
    }
}
