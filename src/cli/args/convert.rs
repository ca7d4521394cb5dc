//! The arguments of `vcutc convert`.

use super::TargetOptions;
use clap::Args;
use vcutc_convert::asked::Words;

/// What `vcutc convert` takes. Lengths are in mm unless a unit follows; everything else carries its unit.
#[derive(Debug, Args)]
pub(in crate::cli) struct ConvertArgs {
    /// The milling program: its .src files, and its .dat files with positions that have names
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

    /// How far cuts run out beyond the stock, such as 8mm
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) extension: String,

    /// Size of the blank as in a job, such as 85x50x50: across the passes, along them, up
    #[arg(long, value_name = "WxDxH")]
    pub(in crate::cli) stock: String,

    /// Where the blank's lowest corner lies in the file [default: inferred from the passes]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(in crate::cli) origin: Option<String>,

    /// The axis of the file that passes run along: x, y or z [default: the one along which it moves farthest]
    #[arg(long, value_name = "AXIS")]
    pub(in crate::cli) along: Option<String>,

    /// The direction of the file that points up: x, y, z, -x, -y or -z [default: z]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub(in crate::cli) up: Option<String>,

    /// The unit of the file's speeds: m/s, mm/s or mm/min [default: m/s, or mm/min if they are too high for anything else]
    #[arg(long, value_name = "UNIT")]
    pub(in crate::cli) feed_unit: Option<String>,

    /// Speed in the material, such as 200mm/s [default: the file's in its passes]
    #[arg(long, value_name = "SPEED")]
    pub(in crate::cli) feed: Option<String>,

    /// Speed through the air [default: the file's highest between passes]
    #[arg(long, value_name = "SPEED")]
    pub(in crate::cli) travel: Option<String>,

    /// Rate of turning the blade, such as 90deg/s [default: the file's $VEL.ORI1, or 90 deg/s]
    #[arg(long, value_name = "RATE")]
    pub(in crate::cli) reorient: Option<String>,

    /// Height of the safe plane above the blank [default: as high as the file goes]
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) clearance: Option<String>,

    /// Cutting length of the blade [default: the least that frees every chip]
    #[arg(long, value_name = "LENGTH", conflicts_with = "blade")]
    pub(in crate::cli) edge: Option<String>,

    /// Half the apex angle of the blade [default: 7.13 deg]
    #[arg(long, value_name = "ANGLE", conflicts_with = "blade")]
    pub(in crate::cli) half_apex: Option<String>,

    /// Thickness of the blade [default: 0 mm]; with --blade, what the profile is lowered for
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) thickness: Option<String>,

    /// How close together the points of a pass lie, across and in height [default: 0.01 mm]
    ///
    /// Posts that divide a straight pass into many points round each of them. Up to 1 mm; steps between passes have to be longer.
    #[arg(long, value_name = "LENGTH")]
    pub(in crate::cli) tolerance: Option<String>,

    /// A file of the shop with machines, and blades for --blade
    #[arg(long, value_name = "FILE.vcut")]
    pub(in crate::cli) cell: Option<String>,

    /// A blade of that file
    #[arg(long, value_name = "NAME", requires = "cell")]
    pub(in crate::cli) blade: Option<String>,

    /// A machine of that file, if it has several
    #[arg(long, value_name = "NAME", requires = "cell")]
    pub(in crate::cli) machine: Option<String>,

    /// The part's profile: points in .csv, an airfoil in .dat, a drawing in .dxf or .svg [default: through the lowest passes]
    #[arg(long, value_name = "FILE")]
    pub(in crate::cli) profile: Option<String>,

    /// Fields of that file as in the language, such as "side = upper, chord = 300 mm"
    #[arg(long, value_name = "FIELDS", requires = "profile")]
    pub(in crate::cli) profile_fields: Option<String>,

    /// Write the job (.vcut) that stands for the program
    #[arg(long, conflicts_with = "target")]
    pub(in crate::cli) as_job: bool,

    /// Write a program for this kind of machine (see `vcutc targets`); needs --cell
    ///
    /// Without --target and --as-job the conversion is only checked.
    #[arg(short, long, value_name = "TARGET", requires = "cell")]
    pub(in crate::cli) target: Option<String>,

    /// Where the job or the program goes: a folder, a job also FILE.vcut, or - for standard output [default: the current folder]
    #[arg(short, long, value_name = "DIR|FILE.vcut|-")]
    pub(in crate::cli) output: Option<String>,

    /// Draw the path of the file and that of the V-cuts into this file
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
