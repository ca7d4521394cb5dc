//! An upright disc that comes down on a waved sheet, for `benches/upright.py`: the sheet as binary STL, and places with how far
//! the disc comes down there.
//!
//! `upright TRIANGLES FOLDER` writes `sheet.stl` and `places.csv` there, and prints how long a place takes, in us.

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;
use vcutc::surface::disc::Axis;
use vcutc::surface::surface::Surface;
use vcutc_backend_api::units::Length;
use vcutc_benches::{drop, surface};

/// How often all places are taken; the fastest time counts.
const ROUNDS: u32 = 5;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(count), Some(folder)) = (arguments.next(), arguments.next()) else {
        return Err("upright TRIANGLES FOLDER".into());
    };
    let folder = Path::new(&folder);
    let bytes = surface::binary(&surface::triangles(count.parse()?));
    std::fs::write(folder.join("sheet.stl"), &bytes)?;
    let placed: Surface = surface::placed(&surface::read(&bytes));
    let dropper = drop::dropper(&placed);
    let upright = Axis::new([0.0, 0.0, 1.0]).ok_or("it points up")?;
    let places: Vec<[f64; 2]> = drop::places().collect();
    let heights = || -> Vec<f64> {
        let rests = places
            .iter()
            .filter_map(|&place| dropper.face(Length::mm(drop::RADIUS), place, upright));
        rests.map(|rest| rest.height.to_mm()).collect()
    };
    let mut fastest = f64::INFINITY;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        black_box(heights());
        fastest = fastest.min(start.elapsed().as_secs_f64());
    }
    let mut rows = String::new();
    for ([x, y], z) in places.iter().zip(heights()) {
        writeln!(rows, "{x:?},{y:?},{z:?}")?;
    }
    std::fs::write(folder.join("places.csv"), rows)?;
    println!("{}", fastest * 1e6 / places.len() as f64);
    Ok(())
}
