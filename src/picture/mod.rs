//! Pictures: SVG texts, made without fonts, clocks or chance, so that the same data gives the same bytes.

pub mod heat_map;
pub mod pareto;
mod svg;
