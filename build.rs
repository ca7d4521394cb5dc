//! Gives releases their commit for `vcutc --version`.
#![allow(
    clippy::disallowed_macros,
    clippy::disallowed_methods,
    reason = "a build script reads files and its environment, and answers by printing"
)]

#[path = "build/commit.rs"]
mod commit;

use std::env;
use std::path::Path;

fn main() {
    let version = env::var("CARGO_PKG_VERSION").unwrap_or_default();
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=build/commit.rs");
    // Builds for development would be repeated after every commit, for a number that is old as soon as a file
    // changes.
    let is_release = env::var("PROFILE").is_ok_and(|profile| profile == "release");
    let root = env::var("CARGO_MANIFEST_DIR").unwrap_or_default();
    let root = Path::new(&root);
    let commit = if is_release {
        for file in commit::files(root) {
            println!("cargo::rerun-if-changed={}", file.display());
        }
        commit::of(root)
    } else {
        None
    };
    let shown = commit.map_or(version.clone(), |commit| format!("{version} ({commit})"));
    println!("cargo::rustc-env=VCUTC_VERSION={shown}");
}
