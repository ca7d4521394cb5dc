//! Equivalent tools as a table for people and as CSV.

use crate::{Equivalent, Equivalents, Solid};
use core::fmt::Write;
use vcutc_diagnostics::number::show;

/// What CSV has for each tool.
const COLUMNS: &str =
    "name,blade,form,diameter_mm,height_mm,apex_deg,shank_diameter_mm,spin_rev_min,source\n";

/// The tools in columns, with what each does not say below it.
#[must_use]
pub fn table(all: &Equivalents) -> String {
    let width = |of: fn(&Equivalent) -> &str| {
        let widths = all.tools.iter().map(|tool| of(tool).chars().count());
        widths.max().unwrap_or_default()
    };
    let (names, blades) = (width(|tool| &tool.name), width(|tool| &tool.blade));
    let mut text = String::new();
    for tool in &all.tools {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:names$}  for {:blades$}  {}  {}",
            tool.name,
            tool.blade,
            measures(tool.solid),
            tool.role.source()
        );
        if let Some(note) = tool.role.note() {
            let _ = writeln!(text, "  {note}");
        }
    }
    for blade in &all.flat {
        let _ = writeln!(
            text,
            "none  for {blade}: both its edges lie on its axis, so its bottom edge has no width"
        );
    }
    text
}

fn measures(solid: Solid) -> String {
    let size = format!(
        "diameter {} mm, height {} mm",
        show(2.0 * solid.radius().to_mm()),
        show(solid.height().to_mm())
    );
    match solid {
        Solid::Cylinder { .. } => format!("cylinder, {size}"),
        Solid::Cone { half_angle, .. } => format!("cone of {} deg, {size}", show(2.0 * half_angle.to_deg())),
    }
}

/// The tools as CSV, a line each; what a tool does not have is empty.
#[must_use]
pub fn csv(tools: &[Equivalent]) -> String {
    let mut text = COLUMNS.to_owned();
    for tool in tools {
        let (form, apex) = match tool.solid {
            Solid::Cylinder { .. } => ("cylinder", String::new()),
            Solid::Cone { half_angle, .. } => ("cone", show(2.0 * half_angle.to_deg())),
        };
        let shank = tool.shank.map(|shank| show(2.0 * shank.radius.to_mm()));
        let spin = tool.spin.map(|spin| show(spin.to_deg_per_s() / 6.0));
        let fields = [
            &tool.name,
            &tool.blade,
            form,
            &show(2.0 * tool.solid.radius().to_mm()),
            &show(tool.solid.height().to_mm()),
            &apex,
            &shank.unwrap_or_default(),
            &spin.unwrap_or_default(),
            tool.role.source(),
        ];
        text.push_str(&fields.join(","));
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Role, Shank};
    use vcutc_backend_api::units::{Angle, AngularSpeed, Length};

    fn all() -> Equivalents {
        let cone = Equivalent {
            name: "dagger_cone_1".to_owned(),
            blade: "dagger".to_owned(),
            solid: Solid::Cone {
                half_angle: Angle::deg(45.0),
                height: Length::mm(8.0),
            },
            role: Role::Groove { operation: 1 },
            shank: None,
            spin: None,
        };
        let disc = Equivalent {
            name: "wheel_crushing".to_owned(),
            blade: "wheel".to_owned(),
            solid: Solid::Cylinder {
                radius: Length::mm(25.0),
                height: Length::mm(10.0),
            },
            role: Role::Disc,
            shank: Some(Shank {
                radius: Length::mm(8.0),
                holder: None,
            }),
            spin: Some(AngularSpeed::deg_per_s(18000.0)),
        };
        Equivalents {
            tools: vec![cone, disc],
            flat: vec!["needle".to_owned()],
        }
    }

    #[test]
    fn csv_has_a_line_for_every_tool() {
        let expected = "name,blade,form,diameter_mm,height_mm,apex_deg,shank_diameter_mm,spin_rev_min,source\n\
                        dagger_cone_1,dagger,cone,16,8,90,,,[Cui II.D]\n\
                        wheel_crushing,wheel,cylinder,50,10,,16,3000,[Yang fig. 2]\n";
        assert_eq!(csv(&all().tools), expected);
    }

    #[test]
    fn the_table_has_measures_notes_and_blades_without_a_width() {
        let expected = "\
dagger_cone_1   for dagger  cone of 90 deg, diameter 16 mm, height 8 mm  [Cui II.D]
  it cuts both flanks of the V at once, upright; the blade cuts one, leaning
wheel_crushing  for wheel   cylinder, diameter 50 mm, height 10 mm  [Yang fig. 2]
  it crushes what the disc lifts off whole
none  for needle: both its edges lie on its axis, so its bottom edge has no width
";
        assert_eq!(table(&all()), expected);
    }
}
