//! The arguments of `vcutc convert`.

use super::TargetOptions;
use clap::Args;
use vcutc_convert::asked::Words;

/// What `vcutc convert` takes. Lengths are in mm unless a unit follows; everything else carries its unit.
#[derive(Debug, Args)]
pub(in crate::cli) struct ConvertArgs {
    /// The milling program: its .src files, and .dat files with named positions
    ///
    /// A .dat file beside a .src file of the same name is read too.
    #[arg(required = true, value_name = "FILE.src")]
    pub(in crate::cli) files: Vec<String>,

    /// Angle between tool axis and feed, such as 60deg
    #[arg(long, value_name = "ANGLE")]
    pub(in crate::cli) rake: String,

    /// Half the opening angle of the V, such as 34deg
    #[arg(long, value_name = "ANGLE")]
    pub(in crate::cli) swing: String,

    /// Distance that cuts extend beyond the stock, such as 8mm
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) extension: String,

    /// Size of the blank, such as 85x50x50: across the passes, along them, and height
    #[arg(long, value_name = "WxDxH")]
    pub(in crate::cli) stock: String,

    /// Position of the blank's lowest corner in the file [default: inferred from the passes]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(in crate::cli) origin: Option<String>,

    /// The axis along which the passes run: x, y or z [default: the one with the longest motions]
    #[arg(long, value_name = "AXIS")]
    pub(in crate::cli) along: Option<String>,

    /// The direction in the file that points up: x, y, z, -x, -y or -z [default: z]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub(in crate::cli) up: Option<String>,

    /// The unit of the file's speeds: m/s, mm/s or mm/min [default: m/s, or mm/min if they are too high for anything else]
    #[arg(long, value_name = "UNIT")]
    pub(in crate::cli) feed_unit: Option<String>,

    /// Speed in the material, such as 200mm/s [default: that of the passes in the file]
    #[arg(long, value_name = "SPEED")]
    pub(in crate::cli) feed: Option<String>,

    /// Speed through the air [default: the highest between passes in the file]
    #[arg(long, value_name = "SPEED")]
    pub(in crate::cli) travel: Option<String>,

    /// Speed of reorientation, such as 90deg/s [default: the file's $VEL.ORI1, or 90 deg/s]
    #[arg(long, value_name = "RATE")]
    pub(in crate::cli) reorient: Option<String>,

    /// Height of the safe plane above the blank [default: the highest point in the file]
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) clearance: Option<String>,

    /// Cutting length of the blade [default: the shortest that frees every chip]
    #[arg(long, value_name = "LENGTH", conflicts_with = "blade")]
    pub(in crate::cli) edge: Option<String>,

    /// Half the apex angle of the blade [default: 7.13 deg]
    #[arg(long, value_name = "ANGLE", conflicts_with = "blade")]
    pub(in crate::cli) half_apex: Option<String>,

    /// Thickness of the blade [default: 0 mm]; with --blade, the thickness that the profile allows for
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) thickness: Option<String>,

    /// Largest deviation of the points of a pass, sideways and in height [default: 0.01 mm]
    ///
    /// Post processors that divide a straight pass into many points round each of them. At most 1 mm; steps between
    /// passes must be longer.
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) tolerance: Option<String>,

    /// A shop file with machines, and with blades for --blade
    #[arg(long, value_name = "FILE.vcut")]
    pub(in crate::cli) cell: Option<String>,

    /// A blade from that file
    #[arg(long, value_name = "NAME", requires = "cell")]
    pub(in crate::cli) blade: Option<String>,

    /// A machine from that file, if it has several
    #[arg(long, value_name = "NAME", requires = "cell")]
    pub(in crate::cli) machine: Option<String>,

    /// The part's profile: points in .csv, an airfoil in .dat, a drawing in .dxf or .svg [default: through the lowest passes]
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) profile: Option<String>,

    /// Fields for that file, written as in a job, such as "side = upper, chord = 300 mm"
    #[arg(long, value_name = "FIELDS", requires = "profile")]
    pub(in crate::cli) profile_fields: Option<String>,

    /// Write the equivalent job (.vcut)
    #[arg(long, conflicts_with = "target")]
    pub(in crate::cli) as_job: bool,

    /// Write a program for this kind of machine (see `vcutc targets`); needs --cell
    ///
    /// Without --target or --as-job the conversion is only checked.
    #[arg(short, long, value_name = "TARGET", requires = "cell")]
    pub(in crate::cli) target: Option<String>,

    /// Write the job or program to this folder, or - for standard output; for a job also FILE.vcut [default: the
    /// current folder]
    #[arg(short, long, value_name = "DIR|FILE.vcut|-")]
    pub(in crate::cli) output: Option<String>,

    /// Draw the path of the milling program and that of the V-cuts in this file
    #[arg(long, value_name = "FILE.svg")]
    pub(in crate::cli) picture: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) options: TargetOptions,
}

impl ConvertArgs {
    /// The words of the options about cutting.
    pub(in crate::cli) fn words(&self) -> Words<'_> {
        Words {
            rake: &self.rake,
            swing: &self.swing,
            extension: &self.extension,
            stock: &self.stock,
            origin: self.origin.as_deref(),
            along: self.along.as_deref(),
            up: self.up.as_deref(),
            feed_unit: self.feed_unit.as_deref(),
            feed: self.feed.as_deref(),
            travel: self.travel.as_deref(),
            reorient: self.reorient.as_deref(),
            clearance: self.clearance.as_deref(),
            edge: self.edge.as_deref(),
            half_apex: self.half_apex.as_deref(),
            thickness: self.thickness.as_deref(),
            tolerance: self.tolerance.as_deref(),
        }
    }
}
