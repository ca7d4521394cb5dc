//! Equivalent tools as tool bits of FreeCAD: a file `.fctb` each, in version 2 of its JSON.
//!
//! A tool bit names a shape of FreeCAD and gives its parameters as texts with units. Cylinders are end mills, cones are V bits.
//! What a shape asks for beyond the solid is the shank: from the body of the blade where the job states it, else as wide as the
//! solid and as long again. FreeCAD's V bits end in a flat, and have a short side above the cone; both are as in those it ships.

use crate::{Equivalent, Solid};
use serde::Serialize;
use std::collections::BTreeMap;
use vcutc_backend_api::units::{Angle, Length};

/// The flat at the tip of FreeCAD's own V bits, and the side above their cone.
const TIP: Length = Length::mm(0.1);
const SIDE: Length = Length::mm(1.0);

#[derive(Serialize)]
struct ToolBit<'t> {
    version: u32,
    name: &'t str,
    shape: &'static str,
    #[serde(rename = "shape-type")]
    kind: &'static str,
    parameter: BTreeMap<&'static str, String>,
    attribute: BTreeMap<&'static str, String>,
}

/// The text of the file.
///
/// # Errors
/// It cannot be written as JSON.
pub fn tool_bit(tool: &Equivalent) -> Result<String, serde_json::Error> {
    let solid = tool.solid;
    let (radius, height) = (solid.radius(), solid.height());
    let shank = tool.shank.map_or(radius, |shank| shank.radius);
    let holder = tool.shank.and_then(|shank| shank.holder);
    let mut parameter = BTreeMap::from([
        ("Diameter", length(radius * 2.0)),
        ("Length", length(holder.unwrap_or(height * 2.0))),
        ("ShankDiameter", length(shank * 2.0)),
    ]);
    let (shape, kind) = match solid {
        Solid::Cylinder { .. } => {
            parameter.insert("CuttingEdgeHeight", length(height));
            ("endmill.fcstd", "Endmill")
        }
        Solid::Cone { half_angle, .. } => {
            parameter.insert("CuttingEdgeAngle", angle(half_angle * 2.0));
            parameter.insert("CuttingEdgeHeight", length(SIDE));
            parameter.insert("TipDiameter", length(TIP));
            ("v-bit.fcstd", "VBit")
        }
    };
    let bit = ToolBit {
        version: 2,
        name: &tool.name,
        shape,
        kind,
        parameter,
        attribute: BTreeMap::new(),
    };
    Ok(serde_json::to_string_pretty(&bit)? + "\n")
}

fn length(length: Length) -> String {
    format!("{:.4} mm", length.to_mm())
}

fn angle(angle: Angle) -> String {
    format!("{:.4} \u{b0}", angle.to_deg())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Role, Shank};

    fn parameters(solid: Solid, shank: Option<Shank>) -> serde_json::Value {
        let tool = Equivalent {
            name: "wheel_crushing".to_owned(),
            blade: "wheel".to_owned(),
            solid,
            role: Role::Disc,
            shank,
            spin: None,
        };
        let text = tool_bit(&tool).unwrap();
        let bit: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(
            (&bit["version"], &bit["name"]),
            (&2.into(), &"wheel_crushing".into())
        );
        assert!(bit["attribute"].as_object().unwrap().is_empty());
        bit
    }

    #[test]
    fn a_cylinder_is_an_end_mill_on_the_shank_of_its_blade() {
        let shank = Shank {
            radius: Length::mm(8.0),
            holder: Some(Length::mm(60.0)),
        };
        let solid = Solid::Cylinder {
            radius: Length::mm(25.0),
            height: Length::mm(10.0),
        };
        let bit = parameters(solid, Some(shank));
        assert_eq!(bit["shape"], "endmill.fcstd");
        assert_eq!(bit["shape-type"], "Endmill");
        let expected = serde_json::json!({
            "CuttingEdgeHeight": "10.0000 mm",
            "Diameter": "50.0000 mm",
            "Length": "60.0000 mm",
            "ShankDiameter": "16.0000 mm",
        });
        assert_eq!(bit["parameter"], expected);
    }

    #[test]
    fn a_cone_is_a_v_bit_of_its_whole_angle() {
        let solid = Solid::Cone {
            half_angle: Angle::deg(45.0),
            height: Length::mm(10.0),
        };
        let bit = parameters(solid, None);
        assert_eq!(bit["shape"], "v-bit.fcstd");
        assert_eq!(bit["shape-type"], "VBit");
        let expected = serde_json::json!({
            "CuttingEdgeAngle": "90.0000 \u{b0}",
            "CuttingEdgeHeight": "1.0000 mm",
            "Diameter": "20.0000 mm",
            "Length": "20.0000 mm",
            "ShankDiameter": "20.0000 mm",
            "TipDiameter": "0.1000 mm",
        });
        assert_eq!(bit["parameter"], expected);
    }
}
