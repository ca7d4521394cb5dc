//! KUKA KRL output.
