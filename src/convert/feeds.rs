//! Speeds of a milling program. KRL takes metres a second; post processors still write other units.

use super::Inference;
use super::asked::{Asked, FeedUnit};
use super::complaints;
use super::milling::{Milling, Written};
use super::raster::Raster;
use vcutc_backend_api::units::{AngularSpeed, Speed};
use vcutc_diagnostics::Diagnostic;
use vcutc_diagnostics::number::show;

/// The fastest that a controller moves a tool, in m/s: the limit of `$VEL.CP` [KSS 8.3, system variables].
const FASTEST: f64 = 3.0;

/// The rate of turning of [Cui 2020], table 1, taken where neither the command line nor the program says one.
const TURNING: AngularSpeed = AngularSpeed::deg_per_s(90.0);

/// Speeds of the job.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Feeds {
    /// In the material.
    pub cut: Speed,
    /// In the air.
    pub travel: Speed,
    /// Of turning.
    pub reorient: AngularSpeed,
}

/// The speeds, from the command line or from the program.
///
/// # Errors
/// Speeds that are missing, differ from pass to pass, or are of an unknown unit.
pub(super) fn feeds(
    milling: &Milling,
    raster: &Raster,
    asked: &Asked,
    inferences: &mut Vec<Inference>,
) -> Result<Feeds, Box<Diagnostic>> {
    let unit = unit(raster, asked, inferences)?;
    let cut = match asked.feed {
        Some(feed) => feed,
        None => {
            let written = cutting(milling, raster)?;
            let speed = unit.speed(written.value);
            inferences.push(Inference::new(
                "feed",
                format!("cut {}", mm_per_s(speed)),
                "the speed of its passes",
            ));
            speed
        }
    };
    let highest = raster.travel.iter().map(|written| written.value).reduce(f64::max);
    let travel = match (asked.travel, highest) {
        (Some(travel), _) => travel,
        (None, Some(highest)) => {
            let speed = unit.speed(highest);
            let why = match raster.travel.len() {
                1 => "its speed between passes",
                _ => "the highest of its speeds between passes",
            };
            inferences.push(Inference::new("feed", format!("travel {}", mm_per_s(speed)), why));
            speed
        }
        (None, None) => {
            inferences.push(Inference::new(
                "feed",
                format!("travel {}", mm_per_s(cut)),
                "as in the cut; the file has no other",
            ));
            cut
        }
    };
    let reorient = match (asked.reorient, milling.turning) {
        (Some(reorient), _) => reorient,
        (None, Some(rate)) if rate > 0.0 && rate <= MOST_TURNING => {
            inferences.push(Inference::new(
                "feed",
                format!("reorient {} deg/s", show(rate)),
                "its $VEL.ORI1",
            ));
            AngularSpeed::deg_per_s(rate)
        }
        (None, _) => {
            inferences.push(Inference::new(
                "feed",
                format!("reorient {} deg/s", show(TURNING.to_deg_per_s())),
                "assumed; the file does not state the rate of turning",
            ));
            TURNING
        }
    };
    Ok(Feeds {
        cut,
        travel,
        reorient,
    })
}

/// The most that a job takes, in deg/s.
const MOST_TURNING: f64 = 10_000.0;

fn mm_per_s(speed: Speed) -> String {
    format!("{} mm/s", show(speed.to_mm_per_s()))
}

/// The one speed of all passes.
fn cutting(milling: &Milling, raster: &Raster) -> Result<Written, Box<Diagnostic>> {
    let mut first: Option<Written> = None;
    for pass in &raster.passes {
        if let (Some(one), Some(other)) = (pass.speed, pass.second_speed) {
            return Err(complaints::two_speeds(one, other));
        }
        match (pass.speed, first) {
            (None, _) => return Err(complaints::no_speed(pass.places[0])),
            (Some(speed), Some(known)) if speed.value != known.value => {
                return Err(complaints::two_speeds(known, speed));
            }
            (Some(speed), _) if !(speed.value > 0.0 && speed.value.is_finite()) => {
                return Err(complaints::speed_unknown(speed.place));
            }
            (Some(speed), _) => first = Some(speed),
        }
    }
    first.ok_or_else(|| complaints::nothing_straight(milling))
}

/// The unit that the program writes speeds in.
fn unit(
    raster: &Raster,
    asked: &Asked,
    inferences: &mut Vec<Inference>,
) -> Result<FeedUnit, Box<Diagnostic>> {
    if let Some(unit) = asked.feed_unit {
        return Ok(unit);
    }
    let of_passes = raster.passes.iter().filter_map(|pass| pass.speed);
    let used = of_passes
        .filter(|_| asked.feed.is_none())
        .chain(raster.travel.iter().copied().filter(|_| asked.travel.is_none()));
    let fastest = used.reduce(|one, other| if other.value > one.value { other } else { one });
    let Some(fastest) = fastest.filter(|fastest| fastest.value > FASTEST) else {
        return Ok(FeedUnit::MetresPerSecond);
    };
    if fastest.value > FASTEST * 60_000.0 {
        return Err(complaints::too_fast(fastest));
    }
    // In mm/s it would still be faster than any robot.
    if fastest.value > FASTEST * 1000.0 {
        inferences.push(Inference::new(
            "feed",
            "the file's speeds are in mm/min".to_owned(),
            "in m/s or mm/s they would be faster than a robot",
        ));
        return Ok(FeedUnit::MillimetresPerMinute);
    }
    Err(complaints::unclear_speed(fastest))
}
