#![doc = include_str!("../ARCHITECTURE.md")]
#![warn(missing_docs)]

#[cfg(feature = "cli")]
pub mod cli;
pub use vcutc_cancellation as cancellation;
#[cfg(feature = "krl")]
pub use vcutc_convert as convert;
pub use vcutc_diagnostics as diagnostics;
pub use vcutc_diff as diff;
pub use vcutc_driver as driver;
pub use vcutc_dynamics as dynamics;
pub use vcutc_equivalent as equivalent;
pub use vcutc_geometry as geometry;
pub use vcutc_job as job;
#[cfg(feature = "lsp")]
pub use vcutc_lsp as lsp;
pub use vcutc_machine as machine;
pub use vcutc_motion as motion;
pub use vcutc_optimize as optimize;
pub use vcutc_picture as picture;
pub use vcutc_place as place;
pub use vcutc_process as process;
pub use vcutc_readback as readback;
pub use vcutc_rect as rect;
pub use vcutc_registry as registry;
pub use vcutc_remedy as remedy;
pub use vcutc_report as report;
pub use vcutc_simulation as simulation;
pub use vcutc_surface as surface;
pub use vcutc_syntax as syntax;
pub use vcutc_vcut as vcut;
