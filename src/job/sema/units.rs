//! The units of the language, and what people write instead of them.

use super::dimension::Dimension;
use super::quantity::Quantity;
use core::f64::consts::PI;

pub(super) struct Unit {
    pub(super) name: &'static str,
    /// What it is called.
    pub(super) spoken: &'static str,
    /// One of it in mm, rad, s, kg.
    pub(super) size: f64,
    pub(super) dimension: Dimension,
}

const fn unit(name: &'static str, spoken: &'static str, size: f64, dimension: Dimension) -> Unit {
    Unit {
        name,
        spoken,
        size,
        dimension,
    }
}

/// All simple units. The inch is 25.4 mm exactly (international yard and pound agreement, 1959).
pub(super) const UNITS: &[Unit] = &[
    unit("um", "micrometre", 0.001, Dimension::LENGTH),
    unit("mm", "millimetre", 1.0, Dimension::LENGTH),
    unit("cm", "centimetre", 10.0, Dimension::LENGTH),
    unit("m", "metre", 1000.0, Dimension::LENGTH),
    unit("in", "inch", 25.4, Dimension::LENGTH),
    unit("ft", "foot", 304.8, Dimension::LENGTH),
    unit("mm2", "square millimetre", 1.0, Dimension::AREA),
    unit("deg", "degree", PI / 180.0, Dimension::ANGLE),
    unit("rad", "radian", 1.0, Dimension::ANGLE),
    unit("rev", "revolution", 2.0 * PI, Dimension::ANGLE),
    unit("ms", "millisecond", 0.001, Dimension::TIME),
    unit("s", "second", 1.0, Dimension::TIME),
    unit("min", "minute", 60.0, Dimension::TIME),
    unit("h", "hour", 3600.0, Dimension::TIME),
    unit("g", "gram", 0.001, Dimension::MASS),
    unit("kg", "kilogram", 1.0, Dimension::MASS),
    unit("N", "newton", 1000.0, Dimension::FORCE),
    unit("kN", "kilonewton", 1e6, Dimension::FORCE),
    unit("kgm2", "kilogram square metre", 1e6, Dimension::INERTIA),
    unit("kgmm2", "kilogram square millimetre", 1.0, Dimension::INERTIA),
    unit("%", "percent", 0.01, Dimension::PURE),
];

/// What people write, and the unit they mean.
const ALIASES: &[(&str, &str)] = &[
    ("inch", "in"),
    ("inches", "in"),
    ("foot", "ft"),
    ("feet", "ft"),
    ("micron", "um"),
    ("microns", "um"),
    ("µm", "um"),
    ("μm", "um"),
    ("millimeter", "mm"),
    ("millimeters", "mm"),
    ("millimetre", "mm"),
    ("millimetres", "mm"),
    ("meter", "m"),
    ("meters", "m"),
    ("metre", "m"),
    ("metres", "m"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("radian", "rad"),
    ("radians", "rad"),
    ("revolution", "rev"),
    ("revolutions", "rev"),
    ("turn", "rev"),
    ("turns", "rev"),
    ("sec", "s"),
    ("secs", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("minute", "min"),
    ("minutes", "min"),
    ("hr", "h"),
    ("hour", "h"),
    ("hours", "h"),
    ("gram", "g"),
    ("grams", "g"),
    ("kilogram", "kg"),
    ("kilograms", "kg"),
    ("newton", "N"),
    ("newtons", "N"),
    ("percent", "%"),
];

/// What people write for a compound unit.
const COMPOUND_ALIASES: &[(&str, &str)] = &[
    ("mps", "m/s"),
    ("mmps", "mm/s"),
    ("mpm", "m/min"),
    ("mmpm", "mm/min"),
    ("ipm", "in/min"),
    ("ips", "in/s"),
    ("dps", "deg/s"),
    ("rpm", "rev/min"),
    ("rps", "rev/s"),
    ("MPa", "N/mm2"),
];

fn find(name: &str) -> Option<&'static Unit> {
    UNITS.iter().find(|unit| unit.name == name)
}

/// A number of a unit, which is a simple one or a quotient such as `mm/s`; none for an unknown unit.
pub fn quantity(number: f64, name: &str) -> Option<Quantity> {
    let Some((above, below)) = split(name) else {
        let unit = find(name)?;
        return Some(Quantity::new(number * unit.size, unit.dimension));
    };
    let (above, below) = (find(above)?, find(below)?);
    let dimension = above.dimension.over(below.dimension)?;
    Some(Quantity::new(number * above.size / below.size, dimension))
}

/// The name of a unit: `metre per minute`; none for an unknown unit.
pub(super) fn spoken(name: &str) -> Option<String> {
    let Some((above, below)) = split(name) else {
        return Some(find(name)?.spoken.to_owned());
    };
    Some(format!("{} per {}", find(above)?.spoken, find(below)?.spoken))
}

/// The units of a dimension: simple ones, and the quotients that people write.
pub(super) fn fitting(dimension: Dimension) -> Vec<String> {
    let simple = UNITS.iter().map(|unit| unit.name);
    let quotients = COMPOUND_ALIASES
        .iter()
        .map(|(_, unit)| *unit)
        .chain(["rad/s", "N/mm", "N/mm2"]);
    simple
        .chain(quotients)
        .filter(|unit| quantity(1.0, unit).is_some_and(|one| one.dimension == dimension))
        .map(str::to_owned)
        .collect()
}

/// The two sides of a quotient of units.
fn split(name: &str) -> Option<(&str, &str)> {
    let (above, below) = name.split_once('/')?;
    Some((above.trim(), below.trim()))
}

/// The units that may have been meant, best first.
pub(crate) fn meant(name: &str) -> Vec<String> {
    if let Some(&(_, compound)) = COMPOUND_ALIASES
        .iter()
        .find(|(alias, _)| alias.eq_ignore_ascii_case(name))
    {
        return vec![compound.to_owned()];
    }
    let Some((above, below)) = split(name) else {
        return meant_simple(name).into_iter().map(str::to_owned).collect();
    };
    let firsts = meant_simple(above);
    let seconds = meant_simple(below);
    let Some(second) = seconds.first() else {
        return Vec::new();
    };
    firsts.iter().map(|first| format!("{first}/{second}")).collect()
}

/// Words that mean one unit to some people and another to others: reading them as one of the two would be
/// wrong half of the time.
const AMBIGUOUS: &[(&str, [&str; 2])] = &[
    // Degrees in German, and gon in French.
    ("grad", ["deg", "rad"]),
    ("grads", ["deg", "rad"]),
    ("grade", ["deg", "rad"]),
];

/// Units that the language lacks, and how they are written in those it has.
const CONVERSIONS: &[(&str, &str)] = &[
    ("km", "1 km is 1000 m"),
    ("m2", "1 m2 is 1000000 mm2"),
    ("cm2", "1 cm2 is 100 mm2"),
    ("N/m2", "1000000 N/m2 are 1 N/mm2"),
    ("N/cm2", "100 N/cm2 are 1 N/mm2"),
    ("Pa", "1000000 Pa are 1 N/mm2"),
    ("kPa", "1000 kPa are 1 N/mm2"),
    ("GPa", "1 GPa is 1000 N/mm2"),
    ("km/h", "1 km/h is 1000 m/h, which is 277.8 mm/s"),
    ("gon", "1 gon is 0.9 deg"),
    ("mil", "1 mil is 0.0254 mm"),
    ("thou", "1 thou is 0.0254 mm"),
];

/// How a value in a unit that the language lacks is written.
pub(super) fn conversion(name: &str) -> Option<&'static str> {
    let mut known = CONVERSIONS.iter();
    known
        .find(|(unit, _)| unit.eq_ignore_ascii_case(name))
        .map(|(_, words)| *words)
}

fn meant_simple(name: &str) -> Vec<&'static str> {
    if let Some(unit) = UNITS.iter().find(|unit| unit.name.eq_ignore_ascii_case(name)) {
        return vec![unit.name];
    }
    if let Some(&(_, unit)) = ALIASES.iter().find(|(alias, _)| alias.eq_ignore_ascii_case(name)) {
        return vec![unit];
    }
    if let Some((_, units)) = AMBIGUOUS.iter().find(|(word, _)| word.eq_ignore_ascii_case(name)) {
        return units.to_vec();
    }
    if conversion(name).is_some() {
        return Vec::new();
    }
    vcutc_diagnostics::suggest::nearest(name, UNITS.iter().map(|unit| unit.name))
}

/// Those of [`meant`] that a value of a dimension has.
pub(super) fn meant_for(name: &str, wanted: Dimension) -> Vec<String> {
    let mut near = meant(name);
    near.retain(|unit| quantity(1.0, unit).is_some_and(|one| one.dimension == wanted));
    near
}

/// Whether a word is a unit.
pub(super) fn is_unit(name: &str) -> bool {
    UNITS.iter().any(|unit| unit.name == name)
}

/// All simple units, for a help line.
pub(crate) fn list() -> String {
    let names: Vec<&str> = UNITS.iter().map(|unit| unit.name).collect();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_exact_where_decimals_are() {
        assert_eq!(quantity(2.0, "in"), Some(Quantity::length(50.8)));
        assert_eq!(
            quantity(6.0, "m/min"),
            Some(Quantity::new(100.0, Dimension::SPEED))
        );
        assert_eq!(quantity(0.2, "m/s"), Some(Quantity::new(200.0, Dimension::SPEED)));
        assert_eq!(
            quantity(180.0, "deg/s"),
            Some(Quantity::new(PI, Dimension::TURNING_RATE))
        );
        assert_eq!(quantity(1.0, "rev"), quantity(360.0, "deg"));
        assert_eq!(quantity(3000.0, "rev/min"), quantity(18_000.0, "deg/s"));
        assert_eq!(quantity(30.0, "%"), Some(Quantity::pure(0.3)));
        assert_eq!(quantity(1.0, "N").map(Quantity::text).as_deref(), Some("1 N"));
        assert_eq!(
            quantity(3.0, "kN/m").map(Quantity::text).as_deref(),
            Some("3 N/mm")
        );
        assert_eq!(
            quantity(2.0, "kN/mm2").map(Quantity::text).as_deref(),
            Some("2000 N/mm2")
        );
        assert_eq!(quantity(5.0, "furlong"), None);
        assert_eq!(quantity(5.0, "mm/furlong"), None);
    }

    #[test]
    fn the_unit_meant_is_named() {
        assert_eq!(meant("inch"), ["in"]);
        assert_eq!(meant("Degrees"), ["deg"]);
        assert_eq!(meant("mm/sec"), ["mm/s"]);
        assert_eq!(meant("mps"), ["m/s"]);
        assert_eq!(meant("MM"), ["mm"]);
        assert!(meant("parsec/fortnight").is_empty());
        assert_eq!(meant("grad"), ["deg", "rad"]);
        assert_eq!(meant("Grad/s"), ["deg/s", "rad/s"]);
        assert_eq!(meant("RPM"), ["rev/min"]);
        assert!(meant("gon").is_empty() && conversion("Gon").is_some());
        // A square metre is not the metre, nor a square millimetre, that its name is near.
        assert!(meant("N/m2").is_empty() && conversion("N/m2").is_some());
        assert!(meant_for("Nm", Dimension::FORCE).iter().all(|unit| unit == "N"));
        assert_eq!(meant_for("degs", Dimension::ANGLE), ["deg"]);
    }
}
