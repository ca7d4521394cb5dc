//! The description of fields that blocks of jobs and tables of sheets share, with the quantities that fields take and the
//! faults that readers find.

pub mod dimension;
pub mod faults;
pub mod field;
pub mod range;
