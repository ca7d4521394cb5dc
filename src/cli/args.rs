//! The arguments, and the help that teaches them.

mod air;
#[cfg(feature = "krl")]
mod convert;
mod effort;
mod examples;
mod inner_form;
mod optimize;
mod overrides;
mod pictures;
mod place;
mod tools;

#[cfg(feature = "krl")]
pub(super) use convert::ConvertArgs;

pub(super) use air::AirArgs;
pub(super) use optimize::OptimizeArgs;
pub(super) use overrides::Overrides;
pub(super) use pictures::{PlotArgs, ReportArgs, What};
pub(super) use place::PlaceArgs;
pub(super) use tools::{ToolForm, ToolsArgs};

use super::patience::{HelpBudget, help_budget};
use super::warnings::Warnings;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use examples::{EXAMPLES, FIRST_EXAMPLES};
pub(super) use inner_form::InnerForm;
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Severity};

/// The version of the package, with the commit where a release was built from one (`build.rs`).
const VERSION: &str = env!("VCUTC_VERSION");

/// Compiler for V-shaped ultrasonic knife cutting of honeycomb core.
///
/// Reads a job file (.vcut), plans the cuts, proves that every chip comes free and that no cut enters the part, and
/// writes the program for the machine. A job with errors never leaves a program, neither complete nor partial.
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
        // After a job every word is taken for another one.
        let jobs = arguments.compile.jobs.iter().skip(1);
        let has_command = jobs.filter(|word| Self::is_command(word)).count() > 0;
        match arguments.compile.first_given() {
            Some(stray) if has_command => Err(Self::command().error(
                ErrorKind::ArgumentConflict,
                format!("{stray} is not allowed before a command"),
            )),
            Some(stray) if arguments.command.is_some() => Err(Self::command().error(
                ErrorKind::ArgumentConflict,
                format!("{stray} is not allowed before a command"),
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

/// The numbers after an option that takes them with commas, where they were given with blanks: the option,
/// and all of them.
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
            let text = format!("{option} takes numbers separated by commas: {option} {list}");
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
    /// Check jobs for errors; write nothing
    Check(CheckArgs),
    /// Write all programs that vcut.toml lists, or check that they are up to date
    ///
    /// vcutc searches for vcut.toml in the current folder and in those above it. It compiles programs in parallel and
    /// reports them in the order of the list. Each program is written completely or not at all; unchanged files are not
    /// touched.
    Build(BuildArgs),
    /// Convert a three-axis KUKA milling program to V-cuts
    ///
    /// Reads the passes of a raster from the program of any CAM system, and cuts each of them as a V: the left flank on
    /// the way out, the right flank on the way back. What the command line does not state is inferred from the program,
    /// if there is only one possibility, and reported.
    #[cfg(feature = "krl")]
    Convert(Box<ConvertArgs>),
    /// Print a completion script for a shell
    ///
    /// It completes commands, options and their values. docs/command_line.md says where your shell looks for it.
    Completions {
        /// The shell
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
    /// Explain a diagnostic code, or list them all
    ///
    /// Every error and warning has a permanent code such as VC0203. Its page explains the meaning, shows a job with the
    /// error, and how to fix it.
    Explain {
        /// The code, such as VC0203 or just 203 [default: list all codes]
        code: Option<String>,
    },
    /// Format job files
    ///
    /// Comments stay in place, and the meaning of a job does not change; files with errors are left unchanged. Files
    /// are replaced completely or not at all. docs/fmt.md describes the layout.
    Fmt(FmtArgs),
    /// Write a first job that compiles, to adapt to your part
    ///
    /// With --robot the job has that machine, with a tool, a base and a home, and is compiled before it is written.
    /// Existing files are not overwritten.
    Init(InitArgs),
    /// Find the base frame with the largest margin, or with the smallest deviation
    ///
    /// Searches for the position of the work (and its rotation about z) with the largest minimum margin over the whole
    /// job, proves the whole program there, and prints the frame to paste. With --objective deviation, the position where the
    /// forces of the blade push its cuts off least. The job file is not changed.
    Place(PlaceArgs),
    /// Show what `auto` chose, which limits are active, and the cost of a finer surface
    ///
    /// Plans each operation again with every limit a tenth wider, on other lattices where the job names one, and under a
    /// series of limits on the scallop, the cuts or the edge; reports what each would save; and compares the plans with
    /// the formulas of the paper and the exact ones. The job file is not changed.
    Optimize(OptimizeArgs),
    /// List the machines in the catalogue, or show one
    ///
    /// Part of a name, such as kuka or r3100, lists the machines whose names contain it.
    ///
    /// Shows lengths, limits and speeds, the sources of the numbers, where sources differ, and how reliable they are.
    Machines {
        /// A name in the catalogue or part of one, or a file that describes a machine (.toml, .urdf) [default: list all
        /// machines]
        machine: Option<String>,
    },
    /// Compute the pose of the flange or blade from axis values (forward kinematics)
    ///
    /// Lengths are in mm, angles in deg. For robots the arm configuration is shown too, in the controller's terms:
    /// status and turn (KUKA), confdata (ABB).
    Fk {
        #[command(flatten)]
        cell: CellArgs,

        /// The axis values, in the controller's order and direction: deg for rotary axes, mm for linear ones
        #[arg(long, value_name = "J1,J2,...", allow_hyphen_values = true)]
        joints: String,
    },
    /// List all axis values for a pose of the flange or blade (inverse kinematics)
    ///
    /// Lists all arm configurations, with all turns of each axis within its limits. With --verbose it also lists
    /// solutions outside the limits, with the axes concerned and by how much. For robots each has status and turn
    /// (KUKA) or confdata (ABB).
    Ik {
        #[command(flatten)]
        cell: CellArgs,

        /// The pose: x, y, z in mm and a, b, c in deg (R = Rz(A) Ry(B) Rx(C)); only x, y, z with --quaternion
        #[arg(long, value_name = "X,Y,Z,A,B,C", allow_hyphen_values = true)]
        pose: String,

        /// The orientation of the pose as a unit quaternion, in the order of ABB controllers
        #[arg(long, value_name = "W,X,Y,Z", allow_hyphen_values = true)]
        quaternion: Option<String>,
    },
    /// Run the language server for editors, over standard input and output
    ///
    /// Speaks the Language Server Protocol: diagnostics while typing, fixes, explanations, completion, definitions,
    /// renaming. Editors start it; docs/editors.md explains the setup.
    #[cfg(feature = "lsp")]
    Lsp {
        /// Use standard input and output; this is always so, but some editors pass the option
        #[arg(long)]
        stdio: bool,
    },
    /// Write the manual pages of all commands into a folder
    ///
    /// For package maintainers: vcutc.1, vcutc-check.1 and so on.
    #[command(hide = true)]
    Man {
        /// The folder
        #[arg(short, long, value_name = "DIR", default_value = ".")]
        output: String,
    },
    /// Draw pictures of a job as SVG
    ///
    /// Compiles the job once and draws all pictures, or with --what only one. docs/pictures.md shows each of them.
    Plot(PlotArgs),
    /// List the targets and their options, or describe one
    ///
    /// The list includes programs `vcutc-backend-NAME` on the PATH by name; they run only when described.
    Targets {
        /// A target [default: list all targets]
        target: Option<String>,
    },
    /// List the tools that stand for the blades of a job in CAM, or write them for it
    ///
    /// For a straight blade a cylinder, and a cone for its V cuts; for a disc a cylinder. docs/tools.md explains them.
    Tools(ToolsArgs),
    /// Write an HTML report of a job
    ///
    /// A single self-contained file with the cross-section, deviations, axes, times, parameters with their sources, and
    /// a playback of the cuts. A job with errors writes nothing.
    Report(ReportArgs),
    /// Compile a job again whenever one of its files changes
    ///
    /// Writes programs as `vcutc JOB --target` does. With --serve, a browser on this machine shows the report and
    /// updates it. Press Ctrl-C to stop.
    Watch(WatchArgs),
    /// Check a program against its job
    ///
    /// Compiles the job, reads the program as its controller would, and reports every operation that differs from the
    /// job, with its line in the program and its place in the job. Comments and layout may differ. Nothing is written.
    Verify(VerifyArgs),
}

#[derive(Debug, Args)]
pub(super) struct VerifyArgs {
    /// The job file (.vcut), or - to read it from standard input
    pub(super) job: String,

    /// All files of one program, in any order, or the folder that contains them
    ///
    /// From a folder, only the files of this job's program are read.
    #[arg(required = true, value_name = "PROGRAM")]
    pub(super) programs: Vec<String>,

    /// The target that the program was written for [default: inferred from the file names]
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
    /// A machine in the catalogue (see `vcutc machines`), or a file that describes one (.toml, .urdf)
    pub(super) machine: String,

    /// The blade's frame relative to the flange [default: the flange itself]
    #[arg(long, value_name = "X,Y,Z,A,B,C", allow_hyphen_values = true)]
    pub(super) tool: Option<String>,

    /// The work's frame relative to the machine's root [default: the root itself]
    #[arg(long, value_name = "X,Y,Z,A,B,C", allow_hyphen_values = true)]
    pub(super) base: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct CompileArgs {
    /// The job file (.vcut), or - to read it from standard input; with --target, one or more
    ///
    /// Paths in a job are relative to the job file, or to the current folder for a job from standard input.
    #[arg(required = true, value_name = "JOB")]
    pub(super) jobs: Vec<String>,

    /// Write a program for this kind of machine (see `vcutc targets`)
    ///
    /// Without --target or --emit the job is only checked.
    #[arg(short, long, value_name = "TARGET", conflicts_with = "emit")]
    pub(super) target: Option<String>,

    /// Write files to this folder, or - for standard output [default: the current folder]
    ///
    /// The folder is created if it does not exist. Files are first written under temporary names and renamed only when
    /// all of them are complete, so a run that fails leaves earlier versions unchanged.
    ///
    /// On standard output each file of a program begins with a line `; file: NAME`.
    #[arg(short, long, value_name = "DIR|-")]
    pub(super) output: Option<String>,

    /// Compare with the existing files in the folder; write nothing
    ///
    /// Fails with a diff for each file if the program in the folder differs from what the job gives now. Leftover parts
    /// of an earlier program count as differences too.
    #[arg(long, requires = "target")]
    pub(super) check: bool,

    /// Print an intermediate representation instead of writing a program
    ///
    /// Prints to standard output, or with -o writes a file in the folder. The syntax tree and the plan are printed for
    /// jobs with errors too, as far as compilation got.
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
    /// Treat warnings as errors: exit with 1 and write nothing
    ///
    /// For continuous integration, where no one reads and accepts warnings.
    #[arg(long)]
    deny_warnings: bool,

    /// Allow this warning despite --deny-warnings, such as VC0529
    ///
    /// The warning is still shown and counted. Can be given several times.
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

    /// Write programs to this folder [default: the current folder]
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: Option<String>,

    /// Serve the report at http://127.0.0.1:PORT/, for browsers on this machine only [default port: 8228]
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

    /// Show what would change; write nothing
    ///
    /// Fails with a diff for each file that is not formatted.
    #[arg(long)]
    pub(super) check: bool,
}

#[derive(Debug, Args)]
pub(super) struct InitArgs {
    /// The name of the job; its file is NAME.vcut [default: first]
    pub(super) name: Option<String>,

    /// The robot or five-axis machine for the job: a name in the catalogue (see `vcutc machines`), or a file (.toml,
    /// .urdf)
    #[arg(long, visible_alias = "machine", value_name = "MODEL")]
    pub(super) robot: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct BuildArgs {
    /// Build only these: names of sections, names of jobs, or paths of job files
    #[arg(value_name = "NAME|JOB")]
    pub(super) programs: Vec<String>,

    /// Compare with the existing files; write nothing
    #[arg(long)]
    pub(super) check: bool,

    /// Accept the figures of these programs as the new baseline (see `baseline` in vcut.toml)
    #[arg(long, conflicts_with = "check")]
    pub(super) accept: bool,

    /// The list of programs [default: vcut.toml in the current folder or above it]
    #[arg(long, value_name = "FILE")]
    pub(super) manifest: Option<String>,

    #[command(flatten)]
    pub(super) warnings: WarningArgs,
}

/// What the command line says to the target, over what the machine's block says.
#[derive(Debug, Args)]
pub(super) struct TargetOptions {
    /// Set an option of the target; can be given several times
    ///
    /// Keys and values are those of the target's block in the machine (see `vcutc targets`), and override that block:
    /// --option lines_per_part=0, --option 'header=("; cell 4", "; rib")'. The word `default` restores the default
    /// value: --option header=default. Paths are relative to the current folder.
    #[arg(long, value_name = "KEY=VALUE")]
    pub(super) option: Vec<String>,
}

/// Where targets outside of the compiler are, and how long they may take.
#[derive(Debug, Args)]
pub(super) struct OutsideArgs {
    /// Also search this folder for programs `vcutc-backend-NAME`; can be given several times
    ///
    /// Such a program provides the target NAME. These folders are searched before those of the PATH.
    #[arg(
        long,
        global = true,
        value_name = "DIR",
        help_heading = "Targets of your own",
        hide_short_help = true
    )]
    pub(super) backend_path: Vec<String>,

    /// Stop a program `vcutc-backend-NAME` that has not finished after this many seconds
    #[arg(long, global = true, value_name = "SECONDS", help_heading = "Targets of your own", hide_short_help = true, default_value_t = 60, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    pub(super) backend_timeout: u64,
}

/// The heading of what is said how.
const MESSAGES: &str = "Messages";

/// How to talk to the user.
#[derive(Debug, Args)]
pub(super) struct DisplayArgs {
    /// The format of diagnostics on standard error
    #[arg(long, value_enum, global = true, default_value_t, value_name = "FORMAT", help_heading = MESSAGES)]
    pub(super) message_format: MessageFormat,

    /// When to use colours
    #[arg(long, value_enum, global = true, default_value_t, value_name = "WHEN", help_heading = MESSAGES)]
    pub(super) color: Color,

    /// Time limit of the search for changes that fix a refused job, such as 5s or none [default: 1s; none with
    /// --message-format json]
    ///
    /// With none, the search ends after a bounded amount of work, so its suggestions depend only on the job; with 0s
    /// there is no search.
    #[arg(long, global = true, value_name = "TIME", value_parser = help_budget)]
    pub(super) help_budget: Option<HelpBudget>,

    /// Print only diagnostics: no summary, no progress
    #[arg(short, long, global = true, conflicts_with = "verbose", help_heading = MESSAGES)]
    pub(super) quiet: bool,

    /// Also print the use of every axis, the time of each stage, and the progress of long runs
    #[arg(short, long, global = true, help_heading = MESSAGES)]
    pub(super) verbose: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum MessageFormat {
    /// For people
    #[default]
    Human,
    /// For programs: one JSON object per line, the last one of kind "summary"
    Json,
    /// For GitHub Actions: as for people, plus annotations on the changed lines
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
