//! The table of codes. A code is given once and never reused; its page is `docs/diagnostics/VCnnnn.md`.

use super::Severity;

macro_rules! codes {
    ($($(#[$doc:meta])* $name:ident = $number:literal, $severity:ident, $title:literal;)+) => {
        /// A permanent diagnostic code.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Code {
            $($(#[$doc])* $name,)+
        }

        impl Code {
            /// All codes in order.
            pub const ALL: &[Self] = &[$(Self::$name,)+];

            /// The code as people write it, such as `VC0203`.
            #[must_use]
            pub const fn number(self) -> &'static str {
                match self { $(Self::$name => $number,)+ }
            }

            /// What it is about, in a few words.
            #[must_use]
            pub const fn title(self) -> &'static str {
                match self { $(Self::$name => $title,)+ }
            }

            /// How bad it is.
            #[must_use]
            pub const fn severity(self) -> Severity {
                match self { $(Self::$name => Severity::$severity,)+ }
            }

            /// Its page, in Markdown.
            #[must_use]
            pub const fn page(self) -> &'static str {
                match self {
                    $(Self::$name => include_str!(concat!("../../docs/diagnostics/", $number, ".md")),)+
                }
            }

            /// The code of that number.
            #[must_use]
            pub fn from_number(number: &str) -> Option<Self> {
                Self::ALL.iter().copied().find(|code| code.number().eq_ignore_ascii_case(number))
            }
        }
    };
}

codes! {
    /// The text does not follow the grammar.
    UnexpectedText = "VC0101", Error, "text that does not belong here";
    /// A bracket is never closed.
    UnclosedBracket = "VC0102", Error, "a bracket that is never closed";
    /// A bracket is closed that was never opened.
    UnopenedBracket = "VC0103", Error, "a closing bracket without its opening one";
    /// A text in quotes does not end on its line.
    UnclosedText = "VC0104", Error, "a text in quotes that does not end";
    /// Brackets are nested too deeply.
    NestedTooDeeply = "VC0105", Error, "brackets nested too deeply";
    /// A number that cannot be held.
    NumberTooLarge = "VC0106", Error, "a number too large to hold";
    /// A file is not UTF-8.
    NotUtf8 = "VC0107", Error, "a file that is not text";

    /// A name that is defined nowhere.
    UnknownName = "VC0201", Error, "a name that is defined nowhere";
    /// A name that is defined twice.
    DefinedTwice = "VC0202", Error, "a name that is defined twice";
    /// A value of another dimension, or without a unit.
    WrongDimension = "VC0203", Error, "a value of the wrong dimension, or without its unit";
    /// A unit that does not exist.
    UnknownUnit = "VC0204", Error, "a unit that does not exist";
    /// A field that its block does not have.
    UnknownField = "VC0205", Error, "a field that its block does not have";
    /// A field that its block must have.
    MissingField = "VC0206", Error, "a field that is missing";
    /// A block that does not exist.
    UnknownBlock = "VC0207", Error, "a block that does not exist";
    /// A block that a job must have.
    MissingBlock = "VC0208", Error, "a block that is missing";
    /// A word that is none of those a field takes.
    UnknownChoice = "VC0209", Error, "a word that the field does not take";
    /// A value outside of its range.
    OutOfRange = "VC0210", Error, "a value outside of its range";
    /// Files that use one another in a circle.
    UseCycle = "VC0211", Error, "files that use one another in a circle";
    /// A file that cannot be read.
    FileNotFound = "VC0212", Error, "a file that cannot be read";
    /// A function that does not exist, or with the wrong arguments.
    BadCall = "VC0213", Error, "a call of a function that does not fit";
    /// An expression without a finite value.
    NotFinite = "VC0214", Error, "an expression without a value";
    /// A field that is given twice.
    FieldTwice = "VC0215", Error, "a field that is given twice";
    /// A `--set` that sets nothing.
    BadOverride = "VC0216", Error, "a --set that fits no let";
    /// Names that are defined by one another.
    LetCycle = "VC0217", Error, "names that are defined by one another";
    /// Something that is right elsewhere but not here.
    Misplaced = "VC0218", Error, "something in a place where it does not belong";
    /// A value of another kind.
    WrongKind = "VC0219", Error, "a value of the wrong kind";
    /// A curve that does not exist.
    ImpossibleCurve = "VC0220", Error, "a curve that does not exist";
    /// A profile that has two heights at one place.
    NotSingleValued = "VC0221", Error, "a profile with two heights at one place";
    /// A profile that does not reach from side to side.
    ProfileTooShort = "VC0222", Error, "a profile that does not reach across the stock";
    /// A profile that leaves the stock.
    ProfileOutsideStock = "VC0223", Error, "a profile that leaves the stock";
    /// A line of a data file that cannot be read.
    BadData = "VC0224", Error, "a data file that cannot be understood";
    /// A layer that a drawing does not have.
    UnknownLayer = "VC0225", Error, "a layer that is not in the drawing";
    /// A drawing whose lines are not one outline.
    BrokenOutline = "VC0226", Error, "a drawing that is not one outline";
    /// Things in a drawing that are left out, or decided on.
    PartlyRead = "VC0227", Warning, "parts of a drawing that are not taken as they stand";
    /// A drawing whose numbers have no unit.
    UnknownScale = "VC0228", Error, "a drawing without a unit";
    /// A drawing, or a layer, without lines.
    NothingDrawn = "VC0229", Error, "a drawing with no line to read";
    /// Lines of a drawing lie on each other in part.
    DrawnOver = "VC0230", Error, "lines of a drawing that lie on each other";
    /// A file of an airfoil that is read otherwise than it is written.
    AirfoilRepaired = "VC0231", Warning, "an airfoil file that is repaired";

    /// A job that leaves nothing to cut.
    NothingToCut = "VC0301", Error, "a job that leaves nothing to cut";
    /// More cuts than a program can sensibly hold.
    TooManyCuts = "VC0303", Error, "more cuts than a program can hold";
    /// Cuts that do not run out far enough.
    ExtensionTooShort = "VC0304", Error, "cuts that do not run out far enough";
    /// A rake at which no edge leads.
    RakeTooFlat = "VC0305", Error, "a rake at which the edge does not cut";
    /// Limits that cannot be kept together.
    LimitsConflict = "VC0306", Error, "limits that cannot be kept together";
    /// An objective that makes layers vanish.
    NoLeastLayer = "VC0307", Error, "an objective that no limit holds";
    /// More than a tenth of what an operation is to take away stays.
    MuchStays = "VC0308", Warning, "much of what is to be cut away stays";

    /// A chip that is not cut free.
    ChipNotFreed = "VC0401", Error, "a chip that is not cut free";
    /// A cut that enters the part.
    Overcut = "VC0402", Error, "a cut that enters the part";
    /// Material left standing above the limit.
    ScallopOverLimit = "VC0403", Error, "more material left standing than the limit allows";
    /// Uncut material in the way of the blade's body.
    BladeBlocked = "VC0404", Error, "uncut material in the way of the blade";

    /// A machine that is not in the catalogue.
    UnknownMachine = "VC0501", Error, "a machine that is not in the catalogue";
    /// A machine's file that cannot be used.
    BadMachineFile = "VC0502", Error, "a machine's file that cannot be used";
    /// A home that the axes cannot reach.
    HomeOutsideLimits = "VC0503", Error, "a home outside of the axes' limits";
    /// An orientation that is none.
    NotARotation = "VC0504", Error, "an orientation that is not a rotation";
    /// A motion that the machine does not reach.
    OutOfReach = "VC0510", Error, "a motion out of the machine's reach";
    /// A motion that takes an axis beyond its limit.
    AxisLimit = "VC0511", Error, "a motion that takes an axis beyond its limit";
    /// A motion that is too fast for an axis.
    AxisRate = "VC0512", Error, "a motion that is too fast for an axis";
    /// A motion too near to a singular pose.
    NearSingular = "VC0513", Error, "a motion too near to a singular pose";
    /// Motions that need different branches where none can be changed.
    NoCommonBranch = "VC0514", Error, "motions that no one way to stand carries";
    /// A move of all axes that leads through the stock.
    WayThroughStock = "VC0515", Error, "a way to or from home through the stock";
    /// A posture for which the machine lacks an axis.
    PostureNeedsAxis = "VC0516", Error, "a posture for which the machine lacks an axis";
    /// Axes whose rates are not known.
    RatesNotChecked = "VC0517", Warning, "rates of axes that were not checked";
    /// An air cut that cannot be made at the height that was asked for.
    AirCut = "VC0521", Error, "an air cut at a height that does not work";
    /// A tool frame that no mount gives.
    ToolFrame = "VC0522", Warning, "a tool frame that no mount gives";
    /// Travels that became moves of all axes.
    ManyAxisMoves = "VC0527", Warning, "travels that became moves of all axes";
    /// A turn of a five-axis machine that takes the blade through the work.
    SweepThroughWork = "VC0528", Error, "a turn that sweeps the blade through the work";
    /// Something about the motions of this machine that nothing checks.
    MotionNotChecked = "VC0529", Warning, "something about the motions of this machine that was not checked";

    /// A target that needs a machine.
    MissingMachine = "VC0601", Error, "a target that needs a machine";
    /// A target that needs more of the machine.
    MissingMachineField = "VC0602", Error, "a machine that lacks something the target needs";
    /// An option that the target does not have.
    UnknownOption = "VC0603", Error, "an option that the target does not have";
    /// An option with a value that it does not take.
    BadOption = "VC0604", Error, "an option with a value that it does not take";
    /// Something that the target cannot say.
    Unsupported = "VC0605", Error, "something that the target cannot say";
    /// A number that the target does not take.
    TargetRange = "VC0606", Error, "a number that the target does not take";
    /// A machine that the target does not drive.
    WrongMachine = "VC0607", Error, "a machine that the target does not drive";
    /// A file with the habits of a machine that is no such file.
    BadProfile = "VC0608", Error, "a profile that does not say what it should";
    /// A target that is a program of its own, which did not do its work.
    OutsideProgram = "VC0609", Error, "a target's own program that failed";

    /// An operation of a program that is not the job's.
    ChangedOperation = "VC0701", Error, "an operation that a program does in another way";
    /// An operation that a program lacks.
    MissingOperation = "VC0702", Error, "an operation that is missing from a program";
    /// Something that a program does beside its job.
    AddedOperation = "VC0703", Error, "something in a program that its job does not ask for";
    /// Statements in another order.
    OtherOrder = "VC0704", Error, "statements of a program in another order";
    /// A setting that is not the one that was written.
    OtherSetting = "VC0705", Error, "a setting of a program that differs";
    /// A statement whose effect is not known.
    UnknownStatement = "VC0706", Error, "a statement that is not understood";
    /// Text that is no statement.
    UnreadableStatement = "VC0707", Error, "text in a program that is not a statement";

    /// A program that breaks a rule of the process.
    ProgramRule = "VC0708", Error, "a program that moves the blade as it must not";
    /// A program whose cuts are wrong.
    ProgramCuts = "VC0709", Error, "a program that cuts into the part or leaves chips";
    /// A program that its machine does not carry out.
    ProgramReach = "VC0710", Error, "a program that its machine cannot carry out as written";
    /// A program that was not checked further.
    ChecksLeftOut = "VC0711", Warning, "checks of a program that were left out";

    /// A list of programs that is no such list.
    BadManifest = "VC0801", Error, "a list of programs that does not say what it should";
    /// A list of programs with a job that is not there.
    NoSuchJob = "VC0802", Error, "a job of a list of programs that is not there";
    /// A list of programs with a target that is not there.
    NoSuchTarget = "VC0803", Error, "a target of a list of programs that does not exist";
    /// Two programs that want one file.
    SameFile = "VC0804", Error, "two programs that would write the same file";
    /// Parts of an earlier version of a program.
    StaleParts = "VC0805", Warning, "parts of an earlier version of a program";
    /// A program with worse figures than its baseline.
    WorseNumbers = "VC0806", Error, "a program with worse figures than its baseline";
    /// A baseline that cannot be used.
    BadBaseline = "VC0807", Error, "a baseline that cannot be used";
    /// A program that the baseline does not have.
    NoBaseline = "VC0808", Error, "a program that the baseline does not have";

    /// A fault of the compiler.
    Internal = "VC0901", Error, "a fault of the compiler";

    /// A field that has no meaning beside given tips, or that they need.
    TipsBesideField = "VC1001", Error, "a field that does not go with given tips";
    /// A given tip whose cut would enter the part.
    TipInPart = "VC1002", Error, "a given tip whose cut would enter the part";
    /// A given tip that cuts nothing.
    TipCutsNothing = "VC1003", Warning, "a given tip that cuts nothing";
    /// A motion of a milling program that is no pass.
    NoPass = "VC1004", Error, "a motion that cannot be part of a V-cut";
    /// A milling program whose motions cannot be followed.
    NotFollowed = "VC1005", Error, "a milling program whose motions cannot be followed";
    /// A milling program without passes.
    NothingToConvert = "VC1006", Error, "a milling program without passes";
    /// Something that a milling program does not say clearly.
    Unclear = "VC1007", Error, "something that a milling program does not say clearly";
    /// Statements of a milling program that are left out.
    LeftOut = "VC1008", Warning, "statements of a milling program that are left out";
    /// Passes beside the blank.
    BesideBlank = "VC1009", Warning, "passes beside the blank";
    /// A routine that a milling program calls and no file holds.
    MissingRoutine = "VC1010", Error, "a routine of a milling program whose file is missing";
    /// External axes that move in a milling program.
    ExternalAxis = "VC1011", Error, "a milling program that moves external axes";
    /// A milling program without its end.
    NotWhole = "VC1012", Warning, "a milling program without its end";
    /// Passes above the blank.
    AboveBlank = "VC1013", Warning, "passes above the blank";
    /// Motions straight into the uncut blank.
    Plunge = "VC1014", Warning, "motions straight into the uncut blank";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_index_lists_every_code_with_its_title() {
        let index = include_str!("../../docs/diagnostics.md");
        for code in Code::ALL {
            let (number, title) = (code.number(), code.title());
            let line = format!("- [{number}](diagnostics/{number}.md): {title}");
            assert!(index.lines().any(|listed| listed == line), "{line}");
        }
    }

    #[test]
    fn numbers_are_unique_and_in_order() {
        assert!(Code::ALL.is_sorted_by(|a, b| a.number() < b.number()));
        for &code in Code::ALL {
            assert_eq!(Code::from_number(&code.number().to_lowercase()), Some(code));
        }
    }
}
