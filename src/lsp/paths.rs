//! The files that a text in quotes may name: those of a fitting ending in the folder that is written so far, and its folders.

use super::offer::{Offer, Rank, offer};
use lsp_types::CompletionItemKind;
use vcutc_diagnostics::source::{Entry, Loader, join_path};

/// A kind of file that a job names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    Job,
    Points,
    Airfoil,
    Dxf,
    Svg,
    Mesh,
    Step,
    /// A machine's sheet or description, or a profile of its habits.
    Machine,
}

impl Named {
    /// The endings of such files.
    const fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Job => &["vcut"],
            Self::Points => &["csv", "txt"],
            Self::Airfoil => &["dat", "txt"],
            Self::Dxf => &["dxf"],
            Self::Svg => &["svg"],
            Self::Mesh => &["stl", "obj", "ply"],
            Self::Step => &["stp", "step", "p21"],
            Self::Machine => &["toml", "urdf"],
        }
    }
}

/// What is named after these words of a line, or as the first thing in the brackets of a profile's short form.
pub(super) fn named_by(words: &[String], around: Option<&str>) -> Option<Named> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let word = match (words.as_slice(), around) {
        (["machine", _, "=", "robot" | "five_axis"], _)
        | (["profile", "="], Some("gcode" | "krl" | "rapid")) => {
            return Some(Named::Machine);
        }
        ([], Some(file)) => file,
        ([.., last], _) => last,
        ([], None) => return None,
    };
    match word {
        "use" => Some(Named::Job),
        "points" | "grid" => Some(Named::Points),
        "mesh" => Some(Named::Mesh),
        "step" => Some(Named::Step),
        "airfoil" => Some(Named::Airfoil),
        "dxf" => Some(Named::Dxf),
        "svg" => Some(Named::Svg),
        _ => None,
    }
}

/// The folder of the file that is written in.
pub(super) struct Folder<'a> {
    pub(super) file: &'a str,
    /// What is around it.
    pub(super) files: &'a dyn Loader,
}

impl Folder<'_> {
    /// The paths that can be where a part of one is typed.
    pub(super) fn offers(&self, named: Named, typed: &str) -> Vec<Offer> {
        let begun = typed.rsplit_once('/').map_or("", |(folder, _)| folder);
        let joint = if typed.contains('/') { "/" } else { "" };
        // The folder of a file in the begun one, whatever that is called.
        let inside = join_path(self.file, &format!("{begun}{joint}x"));
        let folder = match inside.rsplit_once('/') {
            Some(("", _)) => "/",
            Some((folder, _)) => folder,
            None => "",
        };
        let path = |name: &str| format!("{begun}{joint}{name}");
        let entries = self.files.list(folder).into_iter();
        entries
            .filter_map(|entry| match entry {
                Entry::Folder(name) => Some(offer(
                    &path(&format!("{name}/")),
                    CompletionItemKind::FOLDER,
                    Rank::Possible,
                )),
                Entry::File(name) => {
                    let is_itself = join_path(folder_file(folder).as_str(), &name) == self.file;
                    let fits = has_ending(&name, named.endings()) && !is_itself;
                    fits.then(|| offer(&path(&name), CompletionItemKind::FILE, Rank::Fitting))
                }
            })
            .collect()
    }
}

/// Some file in a folder.
fn folder_file(folder: &str) -> String {
    match folder {
        "" | "/" => format!("{folder}x"),
        _ => format!("{folder}/x"),
    }
}

fn has_ending(name: &str, endings: &[&str]) -> bool {
    let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
    endings.iter().any(|known| known.eq_ignore_ascii_case(ending))
}
