//! What the cuts leave: the machined contour, proven chip by chip.
//!
//! In the x-z plane a V-cut whose chip comes free takes everything above the two flanks that rise from its tip. The
//! surface after any sequence of cuts is therefore the lower envelope of the stock's top and of those Vs: piecewise
//! linear, so it is kept exactly, by its corners ([`surface`]). [`prove`](mod@prove) reads the cuts back from the
//! verified program (not from the plan that made it), replays them in order, and finds every chip that is not freed and
//! every entry into the part; [`report`] gathers the figures people want to see, [`contour`] those of two contours, [`timing`] how long it all takes; [`body`] proves
//! that the body of a blade stays out of the work, [`sides`] where the sides of a thick one are. Slits and discs cut a section of their own ([`cross_section`]).

pub mod body;
mod by_layer;
pub mod contour;
mod course;
pub mod cross_section;
pub mod disc;
pub mod prove;
pub mod report;
pub mod rim;
pub mod sides;
pub mod slab;
pub mod slit;
pub mod surface;
pub mod timing;
