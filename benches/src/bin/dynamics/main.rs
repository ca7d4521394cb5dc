//! What forces take: torques beside a peer, and bounds of the torques and of the deviation of whole jobs beside the proof of their reach.
//!
//! `cargo run --release --bin dynamics` prints the rows of the tables in `docs/benchmarks.md`.

mod bounds;
mod torques;

fn main() {
    torques::table();
    println!();
    bounds::torques();
    println!();
    bounds::deviation();
}
