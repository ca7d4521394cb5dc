//! Jobs that are roughed by the faster of two processes, and the same ones by V cuts alone; and a dome that is roughed by level
//! cuts, and by cuts that follow it.

/// A part: its name, width and height of its stock in mm, and its profile.
type Part = (&'static str, u32, u32, &'static str);

/// A hill, a ramp and a curve.
pub const PARTS: [Part; 3] = [
    ("hill", 420, 64, "z(x) = 58 mm - (x - 210 mm)^2 / 1050 mm"),
    ("ramp", 300, 80, "start (0 mm, 20 mm)  line to (300 mm, 70 mm)"),
    (
        "curve",
        170,
        100,
        "start (0 mm, 36 mm)  bezier (40 mm, 60 mm) (120 mm, 68 mm) to (170 mm, 28 mm)",
    ),
];

/// What roughs a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roughing {
    /// V cuts.
    Vcut,
    /// The faster one of V cuts and of slits and strips.
    Auto,
}

/// The text of a job.
#[must_use]
pub fn text((_, width, height, profile): Part, roughing: Roughing) -> String {
    let common = "blade = dagger, rake = 60 deg, allowance = 0.5 mm, clearance = 10 mm";
    let feed = "feed { cut = 150 mm/s, travel = 300 mm/s, reorient = 40 deg/s }";
    let limits = "scallop <= 8 mm";
    let operation = match roughing {
        Roughing::Vcut => {
            format!("rough vcut {{ {common}\n  {feed}\n  limits {{ {limits}, swing <= 45 deg }} }}")
        }
        Roughing::Auto => format!(
            "rough auto {{ {common}\n  {feed}\n  limits {{ {limits} }}\n  vcut {{ limits {{ swing <= 45 deg }} }}\n  \
             rect {{ disc = wheel, feed {{ free = 100 mm/s }} }} }}"
        ),
    };
    let wheel = match roughing {
        Roughing::Vcut => "",
        Roughing::Auto => {
            "blade wheel = disc { radius = 25 mm, thickness = 1 mm, depth = 12 mm, width = 20 mm, spin = 3000 rev/min\n  \
             body (1 mm, 8 mm) (60 mm, 25 mm) }"
        }
    };
    format!(
        "job \"bench\"\nstock {{ size = ({width} mm, 400 mm, {height} mm) }}\nprofile {{ {profile} }}\n\
         blade dagger {{ cutting_length = 20 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}\n{wheel}\n{operation}\n"
    )
}

/// A dome of 600 x 1000 mm with 10 000 cuts or so, all given, that follow it in a way: `straight` or `spine`.
#[must_use]
pub fn dome(follow: &str) -> String {
    format!(
        "job \"bench\"\nstock {{ size = (600 mm, 1000 mm, 160 mm) }}\n\
         surface {{ z(x, y) = 100 mm - (x - 300 mm)^2 / 3000 mm - (y - 500 mm)^2 / 6000 mm }}\n\
         blade dagger {{ cutting_length = 20 mm, half_apex = 7.13 deg, thickness = 0.5 mm, edges = double }}\n\
         rough vcut {{ blade = dagger, rake = 60 deg, clearance = 10 mm\n  lattice = orthogonal, swing = 40 deg, layer = 1.2 mm, step = 4 mm\n  \
         order = point, sequence = rows, residual = lift, follow = {follow}\n  \
         feed {{ cut = 150 mm/s, travel = 300 mm/s, reorient = 40 deg/s }} }}\n"
    )
}
