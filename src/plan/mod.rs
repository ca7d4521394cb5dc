pub mod blade_reach;
pub mod time_model;
