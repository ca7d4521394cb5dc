//! Hints are tried: applied, a job takes the time that they state.
