//! The way up against trying all of them.
