//! The arguments, and the help that teaches them.

mod air;
#[cfg(feature = "krl")]
mod convert;
mod examples;
mod pictures;

#[cfg(feature = "krl")]
pub(super) use convert::ConvertArgs;

pub(super) use air::AirArgs;
pub(super) use pictures::{PlotArgs, ReportArgs, What};

use super::Targets;
use super::console::Warnings;
use super::files::Disk;
use super::patience::{HelpBudget, help_budget};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use examples::{EXAMPLES, FIRST_EXAMPLES};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Severity};
use vcutc_driver::{Request, Typed};
use vcutc_registry::OPERATIONS;

/// The version of the package, with the commit where a release was built from one (`build.rs`).
const VERSION: &str = env!("VCUTC_VERSION");

/// Compiler for V-shaped ultrasonic knife cutting of honeycomb core.
///
/// Reads a job file (.vcut), plans the cuts, proves that every chip comes free and that no cut enters the part, and
/// writes the program for the machine. A job with errors leaves no program behind, neither whole nor in part.
#[derive(Debug, Parser)]
#[command(
    name = "vcutc",
    version = VERSION,
    subcommand_negates_reqs = true,
    arg_required_else_help = true,
    override_usage = "vcutc [OPTIONS] <JOB>...\n       vcutc [OPTIONS] <COMMAND>",
    after_help = FIRST_EXAMPLES,
    after_long_help = EXAMPLES
)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
    #[command(flatten)]
    pub(super) compile: CompileArgs,
    #[command(flatten)]
    pub(super) outside: OutsideArgs,
    #[command(flatten)]
    pub(super) display: DisplayArgs,
}

impl Arguments {
    /// The arguments of this process.
    ///
    /// Arguments of a compilation in front of a command are refused here: clap's own rule for it
    /// (`args_conflicts_with_subcommands`) would also refuse `vcutc --quiet check JOB`.
    pub(super) fn of_process() -> Result<Self, clap::Error> {
        let arguments = Self::try_parse().map_err(suggest_command)?;
        // Behind a job every word is taken for another one.
        let jobs = arguments.compile.jobs.iter().skip(1);
        let has_command = jobs.filter(|word| Self::is_command(word)).count() > 0;
        match arguments.compile.first_given() {
            Some(stray) if has_command => Err(Self::command().error(
                ErrorKind::ArgumentConflict,
                format!("{stray} cannot stand in front of a command"),
            )),
            Some(stray) if arguments.command.is_some() => Err(Self::command().error(
                ErrorKind::ArgumentConflict,
                format!("{stray} cannot stand in front of a command"),
            )),
            Some(_) | None => Ok(arguments),
        }
    }

    /// How warnings are taken. Commands that write no program only show them.
    pub(super) fn warnings(&self) -> Warnings {
        match &self.command {
            None => self.compile.warnings.taken(),
            Some(Command::Build(args)) => args.warnings.taken(),
            Some(Command::Check(args)) => args.warnings.taken(),
            Some(_) => Warnings::Shown,
        }
    }

    fn is_command(word: &str) -> bool {
        Self::command()
            .get_subcommands()
            .any(|command| command.get_name() == word)
    }

    /// The command that was most likely meant by a word.
    pub(super) fn command_near(word: &str) -> Option<String> {
        let root = Self::command();
        let near = nearest(word, root.get_subcommands().map(clap::Command::get_name));
        near.first().map(|&name| name.to_owned())
    }
}

/// Options whose value is a list of numbers with commas.
const LISTS: [&str; 5] = ["--joints", "--pose", "--quaternion", "--tool", "--base"];

/// The numbers behind an option that takes them with commas, where they were given with blanks: the option, and all of them.
fn list_with_blanks(words: &[String]) -> Option<(&str, String)> {
    let is_number = |word: &&String| word.trim_end_matches(',').parse::<f64>().is_ok();
    let at = words.iter().position(|word| LISTS.contains(&word.as_str()))?;
    let numbers: Vec<&str> = words
        .iter()
        .skip(at + 1)
        .take_while(is_number)
        .map(|word| word.trim_end_matches(','))
        .collect();
    (numbers.len() > 1).then(|| (words[at].as_str(), numbers.join(",")))
}

/// Says what was meant: lists of numbers with blanks between them are taken for several arguments, a mistyped command for a
/// job, and what follows it for one argument too many.
fn suggest_command(mut error: clap::Error) -> clap::Error {
    if error.kind() == ErrorKind::UnknownArgument {
        let words: Vec<String> = std::env::args().collect();
        if let Some((option, list)) = list_with_blanks(&words) {
            let text = format!("{option} takes its numbers with commas between them: {option} {list}");
            return Arguments::command().error(ErrorKind::ValueValidation, text);
        }
        let first_word = words.into_iter().skip(1).find(|word| !word.starts_with('-'));
        let mistyped = first_word.filter(|word| !Arguments::is_command(word));
        if let Some(command) = mistyped.and_then(|word| Arguments::command_near(&word)) {
            error.insert(
                ContextKind::SuggestedSubcommand,
                ContextValue::Strings(vec![command]),
            );
        }
    }
    error
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Look for errors in jobs; write nothing
    Check(CheckArgs),
    /// Write all programs that vcut.toml lists, or check that they are up to date
    ///
    /// vcut.toml is looked for in the current folder and above it. Programs are compiled side by side and told of in the
    /// order of the list; each is written whole or not at all, and files that would not change are left alone.
    Build(BuildArgs),
    /// Turn a KUKA milling program of three axes into V-cuts
    ///
    /// Reads the passes of a raster from the program of any CAM system, and cuts each of them as a V: left flank there, right
    /// flank back. What the command line does not say is taken from the program where that leaves one possibility, and told.
    #[cfg(feature = "krl")]
    Convert(Box<ConvertArgs>),
    /// Print what a shell needs to complete commands, options and their values
    ///
    /// Put it where your shell looks for completions: docs/command_line.md says where that is.
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
    /// Explain a diagnostic code, or list them all
    ///
    /// Every error and warning has a permanent code such as VC0203. Its page says what it means, shows a job that has
    /// the error, and how to mend it.
    Explain {
        /// The code, such as VC0203 (203 will do); without it, the list of all codes
        code: Option<String>,
    },
    /// Format job files
    ///
    /// Comments stay where they are, and what a job says does not change; a file with mistakes is left as it is. Files are
    /// replaced whole or not at all. docs/fmt.md says what the layout is.
    Fmt(FmtArgs),
    /// Write a first job that compiles, to change into one of your own
    ///
    /// With --robot the job has that machine, with a tool, a base and a home with which it was compiled before it is written.
    /// A file that is there is not written over.
    Init(InitArgs),
    /// Search the base frame that leaves the machine the most room
    ///
    /// Looks for the place of the work (and its turn about z) where the smallest margin of the whole job is largest, proves
    /// the whole program there, and prints the frame to paste. The job file is not changed.
    Place(PlaceArgs),
    /// Show what `auto` chose, which limits are active, and the cost of a finer surface
    ///
    /// Solves each operation's parameters on every lattice, by the formulas of the paper and by the exact ones; plans and
    /// simulates the chosen ones; tells which limits bind and what relaxing each by 1 % would save; and lists the least
    /// time for a row of limits of the scallop. The job file is not changed.
    Optimize(OptimizeArgs),
    /// List the machines of the catalogue, or show one
    ///
    /// A part of a name, such as kuka or r3100, lists those that have it.
    ///
    /// Shown are lengths, limits and speeds, where the numbers come from, where sources differ, and how far they can be
    /// trusted.
    Machines {
        /// A name of the catalogue or a part of one, or a file that describes a machine (.toml, .urdf); without it, the list
        machine: Option<String>,
    },
    /// Tell where axis values bring a machine's flange or blade
    ///
    /// Lengths are in mm, angles in deg. For robots the way to stand comes along in the terms of their controllers: status
    /// and turn (KUKA), confdata (ABB).
    Fk {
        #[command(flatten)]
        cell: CellArgs,

        /// The axis values, in the controller's order and sense: deg for rotary axes, mm for linear ones
        #[arg(long, value_name = "J1,J2,...", allow_hyphen_values = true)]
        joints: String,
    },
    /// List all axis values that bring a machine's flange or blade to a pose
    ///
    /// All ways to stand are listed, with all turns of each axis within its limits; with --verbose those that leave the limits
    /// too, with the axes that do and by how much. For robots each comes with status and turn (KUKA) or confdata (ABB).
    Ik {
        #[command(flatten)]
        cell: CellArgs,

        /// The pose: x, y, z in mm and a, b, c in deg (R = Rz(A) Ry(B) Rx(C)); only x, y, z with --quaternion
        #[arg(long, value_name = "X,Y,Z,A,B,C", allow_hyphen_values = true)]
        pose: String,

        /// The orientation of the pose as a unit quaternion, the order of ABB's controllers
        #[arg(long, value_name = "W,X,Y,Z", allow_hyphen_values = true)]
        quaternion: Option<String>,
    },
    /// Answer an editor's questions about job files, over standard input and output
    ///
    /// Speaks the Language Server Protocol: diagnostics while typing, fixes, explanations, completion, definitions, renaming.
    /// Editors start it; docs/editors.md says how.
    #[cfg(feature = "lsp")]
    Lsp {
        /// Over standard input and output, which is the only way; some editors say so
        #[arg(long)]
        stdio: bool,
    },
    /// Write the manual pages of all commands into a folder
    ///
    /// For those who make packages: vcutc.1, vcutc-check.1 and so on.
    #[command(hide = true)]
    Man {
        /// The folder
        #[arg(short, long, value_name = "DIR", default_value = ".")]
        output: String,
    },
    /// Draw pictures of a job as SVG
    ///
    /// Compiles the job once and draws all there is to see of it, or with --what one aspect. docs/pictures.md shows each of them.
    Plot(PlotArgs),
    /// List the targets and their options, or describe one
    ///
    /// Programs `vcutc-backend-NAME` on the PATH are listed by their names; they are only run to be described.
    Targets {
        /// A target; without it, the list
        target: Option<String>,
    },
    /// Write a page that shows all there is to see of a job
    ///
    /// One HTML file that needs nothing else: cross-section, deviations, axes, times, parameters with where each came from, and
    /// the cuts played back. A job with errors writes nothing.
    Report(ReportArgs),
    /// Compile a job again whenever one of its files changes
    ///
    /// Writes programs as `vcutc JOB --target` does. With --serve the report is shown in a browser on this machine, and follows.
    /// Ctrl-C ends it.
    Watch(WatchArgs),
    /// Compare a program with the job that it was made from
    ///
    /// Compiles the job, reads the program as its controller would, and reports every operation that is not the job's: at its
    /// line of the program and at its place in the job. Comments and layout may differ. Nothing is written.
    Verify(VerifyArgs),
}

#[derive(Debug, Args)]
pub(super) struct VerifyArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(super) job: String,

    /// All files of one program, in any order, or the folder that holds them
    ///
    /// Of a folder only the files of this job's program are read.
    #[arg(required = true, value_name = "PROGRAM")]
    pub(super) programs: Vec<String>,

    /// The target that the program was written for [default: the one whose files have such names]
    #[arg(short, long, value_name = "TARGET")]
    pub(super) target: Option<String>,

    #[command(flatten)]
    pub(super) air: AirArgs,

    #[command(flatten)]
    pub(super) options: TargetOptions,

    #[command(flatten)]
    pub(super) overrides: Overrides,
}

/// A machine and the frames between its flange and the blade, its root and the work.
#[derive(Debug, Args)]
pub(super) struct CellArgs {
    /// A machine of the catalogue (see `vcutc machines`), or a file that describes one (.toml, .urdf)
    pub(super) machine: String,

    /// The blade seen from the flange [default: the flange itself]
    #[arg(long, value_name = "X,Y,Z,A,B,C", allow_hyphen_values = true)]
    pub(super) tool: Option<String>,

    /// The work seen from the machine's root [default: the root itself]
    #[arg(long, value_name = "X,Y,Z,A,B,C", allow_hyphen_values = true)]
    pub(super) base: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct CompileArgs {
    /// The job file (.vcut), or - to read it from standard input; with --target there can be several
    ///
    /// Files that the job names are looked for beside it; those of a job from standard input in the current folder.
    #[arg(required = true, value_name = "JOB")]
    pub(super) jobs: Vec<String>,

    /// Write a program for this kind of machine (see `vcutc targets`)
    ///
    /// Without --target and --emit the job is only checked.
    #[arg(short, long, value_name = "TARGET", conflicts_with = "emit")]
    pub(super) target: Option<String>,

    /// Where files go: a folder, or - for standard output [default: the current folder]
    ///
    /// The folder is made if there is none. Files are written beside their place under passing names and only
    /// renamed when all of them are complete, so a run that fails leaves earlier versions as they were.
    ///
    /// On standard output each file of a program is headed by a line `; file: NAME`.
    #[arg(short, long, value_name = "DIR|-")]
    pub(super) output: Option<String>,

    /// Compare with the files that are in the folder, and write nothing
    ///
    /// Fails with the differences, a diff for each file, when the folder does not hold the program that the job gives
    /// now. Parts of an earlier program that the job no longer gives are differences too.
    #[arg(long, requires = "target")]
    pub(super) check: bool,

    /// Show an inner form of the job instead of writing a program
    ///
    /// It goes to standard output, or with -o into a file of the folder. Tree and plan are shown for a job with
    /// errors too, as far as it got.
    #[arg(long, value_name = "FORM")]
    pub(super) emit: Option<InnerForm>,

    #[command(flatten)]
    pub(super) air: AirArgs,

    #[command(flatten)]
    pub(super) options: TargetOptions,

    #[command(flatten)]
    pub(super) overrides: Overrides,

    #[command(flatten)]
    pub(super) warnings: WarningArgs,
}

/// How warnings are taken.
#[derive(Clone, Debug, Args)]
pub(super) struct WarningArgs {
    /// End with 1 and write nothing where there is a warning
    ///
    /// For continuous integration: what a person would read and accept then fails the run.
    #[arg(long)]
    deny_warnings: bool,

    /// A warning that does not end a run with --deny-warnings, such as VC0529
    ///
    /// It is shown and counted all the same. May be given several times.
    #[arg(long, value_name = "CODE", requires = "deny_warnings", value_parser = warning_code)]
    allow: Vec<Code>,
}

/// The code of a warning.
fn warning_code(number: &str) -> Result<Code, String> {
    match Code::from_number(number) {
        Some(code) if code.severity() == Severity::Warning => Ok(code),
        Some(code) => Err(format!("{} is an error, which cannot be allowed", code.number())),
        None => Err("there is no such code; `vcutc explain` lists all".to_owned()),
    }
}

impl WarningArgs {
    fn taken(&self) -> Warnings {
        if self.deny_warnings {
            Warnings::Denied {
                allowed: self.allow.clone(),
            }
        } else {
            Warnings::Shown
        }
    }
}

impl CompileArgs {
    /// One of the arguments that were given, in the words of the user.
    fn first_given(&self) -> Option<String> {
        let job = self.jobs.first().map(|job| format!("the job '{job}'"));
        let target = self.target.as_ref().map(|_| "--target".to_owned());
        let output = self.output.as_ref().map(|_| "--output".to_owned());
        let emit = self.emit.map(|_| "--emit".to_owned());
        let set = self.overrides.set.first().map(|_| "--set".to_owned());
        let machine = self.overrides.machine.as_ref().map(|_| "--machine".to_owned());
        let check = self.check.then(|| "--check".to_owned());
        let option = self.options.option.first().map(|_| "--option".to_owned());
        let air_cut = self.air.air_cut.map(|_| "--air-cut".to_owned());
        let denied = self.warnings.deny_warnings.then(|| "--deny-warnings".to_owned());
        job.or(target)
            .or(output)
            .or(check)
            .or(emit)
            .or(option)
            .or(air_cut)
            .or(set)
            .or(machine)
            .or(denied)
    }
}

#[derive(Debug, Args)]
pub(super) struct WatchArgs {
    /// The job file (.vcut)
    pub(super) job: String,

    /// Write a program for this kind of machine (see `vcutc targets`)
    #[arg(short, long, value_name = "TARGET")]
    pub(super) target: Option<String>,

    /// The folder that programs go into [default: the current folder]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<String>,

    /// Show the report at http://127.0.0.1:PORT/, for browsers on this machine only [default port: 8228]
    #[arg(long, value_name = "PORT", num_args = 0..=1, default_missing_value = "8228")]
    pub(super) serve: Option<u16>,

    #[command(flatten)]
    pub(super) options: TargetOptions,

    #[command(flatten)]
    pub(super) overrides: Overrides,
}

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    /// The job files (.vcut), or - to read one from standard input
    #[arg(required = true, value_name = "JOB")]
    pub(super) jobs: Vec<String>,

    #[command(flatten)]
    pub(super) air: AirArgs,

    #[command(flatten)]
    pub(super) overrides: Overrides,

    #[command(flatten)]
    pub(super) warnings: WarningArgs,
}

#[derive(Debug, Args)]
pub(super) struct FmtArgs {
    /// Job files (.vcut), folders to search for them, or - to format standard input to standard output
    #[arg(value_name = "FILE|DIR|-", default_value = ".")]
    pub(super) paths: Vec<String>,

    /// Show what would change, and write nothing
    ///
    /// Fails with a diff for each file that is not in the layout.
    #[arg(long)]
    pub(super) check: bool,
}

#[derive(Debug, Args)]
pub(super) struct InitArgs {
    /// The name of the job; its file is NAME.vcut [default: first]
    pub(super) name: Option<String>,

    /// The robot or five-axis machine that cuts it: a name of the catalogue (see `vcutc machines`), or a file (.toml, .urdf)
    #[arg(long, visible_alias = "machine", value_name = "MODEL")]
    pub(super) robot: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct BuildArgs {
    /// Only these: names of sections, names of jobs, or paths of job files
    #[arg(value_name = "NAME|JOB")]
    pub(super) programs: Vec<String>,

    /// Compare with the files that are there, and write nothing
    #[arg(long)]
    pub(super) check: bool,

    /// Take the figures of these programs for the baseline that vcut.toml names
    #[arg(long, conflicts_with = "check")]
    pub(super) accept: bool,

    /// The list of programs [default: vcut.toml in the current folder or above it]
    #[arg(long, value_name = "FILE")]
    pub(super) manifest: Option<String>,

    #[command(flatten)]
    pub(super) warnings: WarningArgs,
}

#[derive(Debug, Args)]
pub(super) struct PlaceArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(super) job: String,

    /// Where x of the base may be, in the machine's root [default: 500 mm either way from now]
    ///
    /// A range such as 1000..2500 (in mm), 1 m..2.5 m, or one value that must be kept.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(super) x: Option<String>,

    /// Where y of the base may be [default: 500 mm either way from now]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(super) y: Option<String>,

    /// Where z of the base may be [default: 300 mm either way from now]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(super) z: Option<String>,

    /// By how much the work may be turned about the root's z against now [default: -90..90 deg]
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(super) yaw: Option<String>,

    /// Draw a map of the margin over x and y into this file
    #[arg(short, long, value_name = "FILE.svg")]
    pub(super) output: Option<String>,

    #[command(flatten)]
    pub(super) overrides: Overrides,
}

#[derive(Debug, Args)]
pub(super) struct OptimizeArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(super) job: String,

    /// How many limits of the scallop are tried for the trade-off
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(2..=100))]
    pub(super) points: u32,

    /// Draw time against scallop into this file
    ///
    /// Jobs of several operations get a picture for each, with its number behind the name.
    #[arg(short, long, value_name = "FILE.svg")]
    pub(super) output: Option<String>,

    #[command(flatten)]
    pub(super) overrides: Overrides,
}

/// What the command line says over what the job says.
#[derive(Debug, Args)]
pub(super) struct Overrides {
    /// Replace the value of a `let` of the job; can be given several times
    ///
    /// The value is written as in the job, with its unit: --set width=90mm, --set 'height = 2 in'.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub(super) set: Vec<String>,

    /// Cut on this machine of the job, whatever its `cell` block says
    ///
    /// For jobs that see several machines, such as all cells of a shop.
    #[arg(long, value_name = "NAME")]
    pub(super) machine: Option<String>,
}

impl Overrides {
    /// To compile a job with them, whatever its target.
    pub(super) fn request<'a>(&'a self, disk: &'a Disk, targets: &'a Targets) -> Request<'a> {
        Request {
            path: disk.job(),
            loader: disk,
            overrides: &self.set,
            machine: self.machine.as_deref(),
            options: Typed::default(),
            operations: OPERATIONS,
            targets,
        }
    }
}

/// What the command line says to the target, over what the machine's block says.
#[derive(Debug, Args)]
pub(super) struct TargetOptions {
    /// Set an option of the target; can be given several times
    ///
    /// Keys and values are those of the target's block in the machine (see `vcutc targets`), and go before what stands there:
    /// --option lines_per_part=0, --option 'header=("; cell 4", "; rib")'. The word `default` takes back what the block says:
    /// --option header=default. Files are looked for from the current folder.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(super) option: Vec<String>,
}

/// Where targets outside of the compiler are, and how long they may take.
#[derive(Debug, Args)]
pub(super) struct OutsideArgs {
    /// Look for programs `vcutc-backend-NAME` in this folder, too; can be given several times
    ///
    /// Such a program is the target NAME. These folders come before those of the PATH.
    #[arg(
        long,
        global = true,
        value_name = "DIR",
        help_heading = "Targets of your own",
        hide_short_help = true
    )]
    pub(super) backend_path: Vec<String>,

    /// Stop a program `vcutc-backend-NAME` that is not done after so many seconds
    #[arg(long, global = true, value_name = "SECONDS", help_heading = "Targets of your own", hide_short_help = true, default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    pub(super) backend_timeout: u64,
}

/// The heading of what is said how.
const MESSAGES: &str = "Messages";

/// How to talk to the user.
#[derive(Debug, Args)]
pub(super) struct DisplayArgs {
    /// How diagnostics are written to standard error
    #[arg(long, value_enum, global = true, default_value_t, value_name = "FORMAT", help_heading = MESSAGES)]
    pub(super) message_format: MessageFormat,

    /// When to use colours
    #[arg(long, value_enum, global = true, default_value_t, value_name = "WHEN", help_heading = MESSAGES)]
    pub(super) color: Color,

    /// Look for changes that help a refused job for this long, such as 5s, or none for no limit [default: 1s; none with --message-format json]
    ///
    /// With none the search ends after a bounded amount of work, so that what is offered depends on the job alone; with 0s
    /// nothing is searched.
    #[arg(long, global = true, value_name = "TIME", value_parser = help_budget)]
    pub(super) help_budget: Option<HelpBudget>,

    /// Print diagnostics only: no summary, no progress
    #[arg(short, long, global = true, conflicts_with = "verbose", help_heading = MESSAGES)]
    pub(super) quiet: bool,

    /// Print what is asked of every axis of the machine and how long each stage took, too; and what a long run does
    #[arg(short, long, global = true, help_heading = MESSAGES)]
    pub(super) verbose: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum MessageFormat {
    /// For people
    #[default]
    Human,
    /// For programs: one JSON object a line, the last one of kind "summary"
    Json,
    /// For GitHub Actions: as for people, and annotations for the lines of a change
    Github,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum Color {
    /// On a terminal, unless NO_COLOR or CLICOLOR=0 is set
    #[default]
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// What `--emit` shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum InnerForm {
    /// The syntax tree, for people who work on the compiler
    Ast,
    /// The planned cuts, as CSV with a row for each
    Plan,
    /// The verified intermediate program, as JSON
    Ir,
    /// The machine's axes all along the program, as CSV with a row at least every 5 mm or 2 degrees
    Joints,
}
