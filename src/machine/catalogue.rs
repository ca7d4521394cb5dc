//! The machines that come with the compiler, by name.
//!
//! Each is a sheet under `src/machine/robots` or `src/machine/generic`, compiled in as it is and read when it is asked for.

use super::Model;
use super::sheet::{self, Confidence, Sheet};
use vcutc_backend_api::ir::MachineKind;
use vcutc_diagnostics::source::FileId;
use vcutc_diagnostics::suggest::closest;

/// Names with the texts of their sheets, each in the folder before it.
macro_rules! sheets {
    ($($folder:literal: $($name:literal)+;)+) => {
        &[$($(($name, include_str!(concat!($folder, $name, ".toml"))),)+)+]
    };
}

/// In the order of the names.
const SHEETS: &[(&str, &str)] = sheets! {
    "robots/":
        "abb/irb120_3_058"
        "abb/irb1600_x_120"
        "abb/irb1600_x_145"
        "abb/irb2400_16"
        "abb/irb4600_20_250"
        "abb/irb4600_40_255"
        "abb/irb4600_60_205"
        "abb/irb6640_185_280"
        "abb/irb6640_235_255"
        "abb/irb6650s_125_350"
        "abb/irb6650s_90_390"
        "abb/irb6660_205_190"
        "abb/irb6700_155_285"
        "abb/irb6700_200_260"
        "abb/irb6700_235_265";
    "":
        "generic/head_head_ac"
        "generic/head_head_ac_spindle"
        "generic/head_head_ba"
        "generic/head_head_bc"
        "generic/head_table_ab"
        "generic/table_table_ab"
        "generic/table_table_ac";
    "robots/":
        "kuka/kr10_r1100_2"
        "kuka/kr10_r1100_sixx"
        "kuka/kr120_r2500_pro"
        "kuka/kr16_2"
        "kuka/kr16_r1610_2"
        "kuka/kr16_r2010_2"
        "kuka/kr210_l150_2"
        "kuka/kr210_r2700_2"
        "kuka/kr210_r2700_extra"
        "kuka/kr210_r2700_prime"
        "kuka/kr210_r3100_2"
        "kuka/kr210_r3100_ultra"
        "kuka/kr240_r2900_2"
        "kuka/kr240_r2900_ultra"
        "kuka/kr240_r3330"
        "kuka/kr6_r700_sixx"
        "kuka/kr6_r900_2"
        "kuka/kr6_r900_sixx";
};

/// The names of all machines, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    SHEETS.iter().map(|(name, _)| *name)
}

/// The text of the sheet of that name.
#[must_use]
pub fn text(name: &str) -> Option<&'static str> {
    let found = SHEETS.iter().find(|(known, _)| *known == name);
    found.map(|(_, text)| *text)
}

/// The sheet of that name. That every sheet of the catalogue can be read is tested.
#[must_use]
pub fn sheet(name: &str) -> Option<Sheet> {
    sheet::parse(FileId::ALONE, text(name)?).ok()
}

/// The machine of that name.
#[must_use]
pub fn find(name: &str) -> Option<Model> {
    sheet(name).map(|sheet| sheet.machine(name))
}

/// Most names that [`near`] offers.
const MOST_NEAR: usize = 6;

/// Names that may have been meant: those that go on where `wanted` ends (`kuka/kr210_r3100` is near `_2` and
/// `_ultra`), those that say the same without the maker, else those spelt alike.
#[must_use]
pub fn near(wanted: &str) -> Vec<&'static str> {
    let tidy = wanted.trim().to_lowercase().replace([' ', '-', '\\'], "_");
    let model = tidy.rsplit('/').next().unwrap_or_default();
    let without_maker = |name: &'static str| name.split_once('/').map_or(name, |(_, model)| model);
    let begins: Vec<_> = names()
        .filter(|name| name.starts_with(&tidy) || without_maker(name).starts_with(model))
        .collect();
    if !model.is_empty() && (1..=MOST_NEAR).contains(&begins.len()) {
        begins
    } else {
        closest(&tidy, names())
    }
}

/// A line of the list of machines.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Its name in jobs.
    pub name: &'static str,
    pub kind: MachineKind,
    /// Its model as its maker writes it.
    pub model: String,
    /// Rated payload in kg, when known.
    pub payload: Option<f64>,
    /// How far the wrist centre gets from axis 1, in mm, when known.
    pub reach: Option<f64>,
    /// How far the numbers are backed.
    pub confidence: Option<Confidence>,
}

/// All machines in the order of their names.
#[must_use]
pub fn summaries() -> Vec<Summary> {
    let summary = |name| {
        let sheet = sheet(name)?;
        Some(Summary {
            name,
            kind: sheet.kind(),
            model: sheet.model,
            payload: sheet.payload.rated,
            reach: sheet.facts.wrist_reach,
            confidence: sheet.confidence,
        })
    };
    names().filter_map(summary).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sheet_is_a_machine_with_limits_and_sources() {
        for (name, text) in SHEETS {
            let sheet =
                sheet::parse(FileId::ALONE, text).unwrap_or_else(|flaws| panic!("{name}: {flaws:#?}"));
            assert!(sheet.confidence.is_some(), "{name}");
            match sheet.kind() {
                MachineKind::Robot => {
                    assert_eq!(sheet.axes.len(), 6, "{name}");
                    assert!(!sheet.facts.sources.is_empty(), "{name}");
                    assert!(sheet.facts.fk_checks.len() >= 3, "{name}");
                }
                MachineKind::FiveAxis => {
                    assert!((5..=6).contains(&sheet.axes.len()), "{name}");
                    assert_eq!(sheet.confidence, Some(Confidence::Example), "{name}");
                }
            }
            assert_eq!(find(name).map(|model| model.name).as_deref(), Some(*name));
        }
        assert_eq!(SHEETS.len(), 33 + 7);
        assert!(names().is_sorted());
    }

    #[test]
    #[expect(
        clippy::disallowed_methods,
        reason = "what lies in the folders is the question"
    )]
    fn the_folders_and_the_table_agree() {
        let mut found = Vec::new();
        let here = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        for (folder, prefix) in [
            ("robots/abb", "abb"),
            ("robots/kuka", "kuka"),
            ("generic", "generic"),
        ] {
            for entry in std::fs::read_dir(here.join(folder)).unwrap() {
                let file = entry.unwrap().file_name().into_string().unwrap();
                let name = format!("{prefix}/{}", file.strip_suffix(".toml").unwrap());
                let path = here.join(folder).join(&file);
                assert_eq!(
                    std::fs::read_to_string(path).unwrap(),
                    text(&name).unwrap(),
                    "{name}"
                );
                found.push(name);
            }
        }
        found.sort();
        assert_eq!(found, names().collect::<Vec<_>>());
    }

    /// The conventions: zero positions, senses, order of the wrist, coupling, the flange's axes.
    #[test]
    fn published_poses_are_met() {
        let mut checks = 0;
        for name in names() {
            let sheet = sheet(name).unwrap();
            for check in &sheet.facts.fk_checks {
                let (apart, turned) = check.apart(&sheet.mechanism, &sheet.axes);
                let joints = check.joints_deg;
                assert!(
                    apart <= check.position_tolerance_mm,
                    "{name} {joints:?}: {apart} mm"
                );
                assert!(
                    turned <= check.rotation_tolerance_deg,
                    "{name} {joints:?}: {turned} deg"
                );
                checks += 1;
            }
        }
        assert!(checks >= 99, "{checks}");
    }

    #[test]
    fn near_names_are_those_that_go_on_or_are_spelt_alike() {
        assert_eq!(
            near("kuka/kr210_r3100"),
            ["kuka/kr210_r3100_2", "kuka/kr210_r3100_ultra"]
        );
        assert_eq!(near("KUKA/KR210 R3100-ultra"), ["kuka/kr210_r3100_ultra"]);
        assert_eq!(near("irb6660_205_190"), ["abb/irb6660_205_190"]);
        assert_eq!(near("abb/irb6670_205_190"), ["abb/irb6660_205_190"]);
        assert!(near("fanuc/m20").is_empty());
        assert!(near("").is_empty());
    }

    #[test]
    fn parallelograms_are_those_with_rods() {
        use crate::kinematics::Mechanism;
        use crate::kinematics::opw::Coupling;
        let coupled: Vec<_> = names()
            .filter(|name| match sheet(name).unwrap().mechanism {
                Mechanism::OrthoParallel(arm) => arm.coupling == Coupling::Parallelogram,
                Mechanism::Mounted(_) | Mechanism::Serial(_) | Mechanism::FiveAxis(_) => false,
            })
            .collect();
        assert_eq!(coupled, ["abb/irb2400_16", "abb/irb6660_205_190"]);
    }
}
