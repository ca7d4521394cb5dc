//! The controllers of the family: a file each, with what is written for it and what is read of it.

mod fanuc;
mod heidenhain;
mod linuxcnc;
mod sinumerik;

use crate::controller::Controller;

/// Their words in a job, the default first.
pub(crate) const WORDS: &[&str] = &["linuxcnc", "fanuc", "sinumerik", "heidenhain"];

/// The one of that word; the default for other words, which the compiler does not let through.
pub(crate) fn of(word: &str) -> &'static dyn Controller {
    match word {
        "fanuc" => &fanuc::Fanuc,
        "sinumerik" => &sinumerik::Sinumerik,
        "heidenhain" => &heidenhain::Heidenhain,
        _ => &linuxcnc::LinuxCnc,
    }
}
