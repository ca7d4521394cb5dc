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
    UnexpectedText = "VC0101", Error, "unexpected text";
    /// A bracket is never closed.
    UnclosedBracket = "VC0102", Error, "unclosed bracket or comment";
    /// A bracket is closed that was never opened.
    UnopenedBracket = "VC0103", Error, "unmatched closing bracket";
    /// A text in quotes does not end on its line.
    UnclosedText = "VC0104", Error, "unclosed text in quotes";
    /// Brackets are nested too deeply.
    NestedTooDeeply = "VC0105", Error, "brackets nested too deeply";
    /// A number that is too large.
    NumberTooLarge = "VC0106", Error, "number too large";
    /// A file is not UTF-8.
    NotUtf8 = "VC0107", Error, "file that is not UTF-8 text";

    /// A name that is defined nowhere.
    UnknownName = "VC0201", Error, "undefined name";
    /// A name that is defined twice.
    DefinedTwice = "VC0202", Error, "name defined twice";
    /// A value of another dimension, or without a unit.
    WrongDimension = "VC0203", Error, "wrong dimension or missing unit";
    /// A unit that does not exist.
    UnknownUnit = "VC0204", Error, "unknown unit";
    /// A field that its block does not have.
    UnknownField = "VC0205", Error, "unknown field";
    /// A field that its block must have.
    MissingField = "VC0206", Error, "missing field";
    /// A block that does not exist.
    UnknownBlock = "VC0207", Error, "unknown block";
    /// A block that a job must have.
    MissingBlock = "VC0208", Error, "missing block";
    /// A word that a field does not take.
    UnknownChoice = "VC0209", Error, "word that the field does not accept";
    /// A value outside of its range.
    OutOfRange = "VC0210", Error, "value out of range";
    /// Files that use one another in a circle.
    UseCycle = "VC0211", Error, "circular `use`";
    /// A file that cannot be read.
    FileNotFound = "VC0212", Error, "unreadable file";
    /// A function that does not exist, or with the wrong arguments.
    BadCall = "VC0213", Error, "invalid function call";
    /// An expression without a finite value.
    NotFinite = "VC0214", Error, "expression without a value";
    /// A field that is given twice.
    FieldTwice = "VC0215", Error, "field given twice";
    /// A `--set` that sets nothing.
    BadOverride = "VC0216", Error, "invalid --set";
    /// Names that are defined by one another.
    LetCycle = "VC0217", Error, "circular definition";
    /// Something that is right elsewhere but not here.
    Misplaced = "VC0218", Error, "item in the wrong place";
    /// A value of another kind.
    WrongKind = "VC0219", Error, "value of the wrong kind";
    /// A curve that does not exist.
    ImpossibleCurve = "VC0220", Error, "impossible curve";
    /// A profile that has two heights at one place.
    NotSingleValued = "VC0221", Error, "profile with two heights at one place";
    /// A profile that does not reach from side to side.
    ProfileTooShort = "VC0222", Error, "profile that does not span the stock";
    /// A profile that leaves the stock.
    ProfileOutsideStock = "VC0223", Error, "profile outside the stock";
    /// A line of a data file that cannot be read.
    BadData = "VC0224", Error, "invalid data file";
    /// A layer that a drawing does not have.
    UnknownLayer = "VC0225", Error, "layer that is not in the drawing";
    /// A drawing whose lines are not one outline.
    BrokenOutline = "VC0226", Error, "drawing without a single outline";
    /// Things in a drawing that are left out, or decided on.
    PartlyRead = "VC0227", Warning, "drawing read only in part";
    /// A drawing whose numbers have no unit.
    UnknownScale = "VC0228", Error, "drawing without a unit";
    /// A drawing, or a layer, without lines.
    NothingDrawn = "VC0229", Error, "drawing without lines";
    /// Lines of a drawing lie on each other in part.
    DrawnOver = "VC0230", Error, "overlapping lines in a drawing";
    /// A file of an airfoil that is read otherwise than it is written.
    AirfoilRepaired = "VC0231", Warning, "repaired airfoil file";
    /// A blade of a kind that an operation does not cut with.
    WrongBlade = "VC0232", Error, "blade of the wrong kind";
    /// A surface that does not lie over all of the stock.
    SurfaceIncomplete = "VC0240", Error, "surface without height over part of the stock";
    /// A surface that overhangs.
    Undercut = "VC0241", Warning, "surface with undercuts";
    /// A mesh whose numbers have no unit.
    MeshWithoutUnit = "VC0242", Error, "file of a surface without a unit, or with another one";
    /// A file of triangles that cannot be read.
    BadMesh = "VC0243", Error, "invalid mesh or STEP file";
    /// Two descriptions of the part.
    SurfaceAndProfile = "VC0244", Error, "surface beside a profile";
    /// A surface that leaves the stock.
    SurfaceOutsideStock = "VC0245", Error, "surface outside the stock";
    /// A surface that cannot be made.
    ImpossibleSurface = "VC0246", Error, "impossible surface";
    /// Things in a file of triangles that are left out, or decided on.
    MeshPartlyRead = "VC0247", Warning, "mesh or STEP file read only in part";
    /// Cuts that cannot follow the part as they are to.
    CannotFollow = "VC0248", Error, "cuts that cannot follow the part";
    /// A field that has no meaning for fitted tips.
    FieldBesideFitted = "VC0249", Error, "field that does not go with fitted tips";
    /// A field of `clear pocket` that its pattern does not use.
    FieldOfAnotherPattern = "VC0250", Error, "field of another pattern";
    /// A part that rises more steeply than the ways that cuts follow over it.
    SteeperThanCuts = "VC0251", Warning, "part steeper than its cuts";

    /// A job that leaves nothing to cut.
    NothingToCut = "VC0301", Error, "nothing to cut";
    /// More cuts than a program can sensibly hold.
    TooManyCuts = "VC0303", Error, "too many cuts";
    /// Cuts that do not run out far enough.
    ExtensionTooShort = "VC0304", Error, "extension too short";
    /// A rake at which no edge leads.
    RakeTooFlat = "VC0305", Error, "rake too flat to cut";
    /// Limits that cannot be kept together.
    LimitsConflict = "VC0306", Error, "conflicting limits";
    /// An objective that makes layers vanish.
    NoLeastLayer = "VC0307", Error, "unbounded objective";
    /// More than a tenth of what an operation is to take away stays.
    MuchStays = "VC0308", Warning, "much material left uncut";
    /// Strips that are wider, or layers that are deeper, than the blades take.
    BladesTooSmall = "VC0309", Error, "strips or layers too large for the blades";

    /// A chip that is not cut free.
    ChipNotFreed = "VC0401", Error, "chip not cut free";
    /// A cut that enters the part.
    Overcut = "VC0402", Error, "cut into the part";
    /// Material left standing above the limit.
    ScallopOverLimit = "VC0403", Error, "scallop above the limit";
    /// Uncut material in the way of the blade's body.
    BladeBlocked = "VC0404", Error, "blade blocked by uncut material";
    /// The body of a blade that comes into the work.
    BodyInWork = "VC0405", Error, "body of the blade in the work";
    /// Strips that no disc gets at.
    NoAccess = "VC0406", Error, "strips that no disc gets at";

    /// A machine that is not in the catalogue.
    UnknownMachine = "VC0501", Error, "unknown machine";
    /// A machine's file that cannot be used.
    BadMachineFile = "VC0502", Error, "invalid machine file";
    /// A home that the axes cannot reach.
    HomeOutsideLimits = "VC0503", Error, "home outside the axis limits";
    /// An invalid orientation.
    NotARotation = "VC0504", Error, "orientation that is not a rotation";
    /// A blade that the machine has no tool for, or nothing that spins it.
    BladeWithoutTool = "VC0505", Error, "blade that the machine cannot hold or spin";
    /// Several blades, and no word of how they are changed.
    NoChange = "VC0506", Error, "blades that cannot be changed";
    /// Two tools of the same place or number.
    SamePlace = "VC0507", Error, "two tools in one place";
    /// A motion that the machine does not reach.
    OutOfReach = "VC0510", Error, "motion out of reach";
    /// A motion that takes an axis beyond its limit.
    AxisLimit = "VC0511", Error, "axis beyond its limit";
    /// A motion that is too fast for an axis.
    AxisRate = "VC0512", Error, "motion too fast for an axis";
    /// A motion too close to a singularity.
    NearSingular = "VC0513", Error, "motion too close to a singularity";
    /// Motions that need different branches where none can be changed.
    NoCommonBranch = "VC0514", Error, "no common arm configuration";
    /// An axis move that leads through the stock.
    WayThroughStock = "VC0515", Error, "way to or from home through the stock";
    /// A posture for which the machine lacks an axis.
    PostureNeedsAxis = "VC0516", Error, "posture that needs a missing axis";
    /// Axes whose rates are not known.
    RatesNotChecked = "VC0517", Warning, "axis speeds not checked";
    /// An air cut that cannot be made at the height that was asked for.
    AirCut = "VC0521", Error, "air cut at an unsuitable height";
    /// A tool frame that no mount gives.
    ToolFrame = "VC0522", Warning, "suspicious tool frame";
    /// Travels that became axis moves.
    ManyAxisMoves = "VC0527", Warning, "travels turned into axis moves";
    /// A turn of a five-axis machine that takes the blade through the work.
    SweepThroughWork = "VC0528", Error, "blade turning through the work";
    /// Something about the motions of this machine that nothing checks.
    MotionNotChecked = "VC0529", Warning, "motions not fully checked";
    /// A piece of a chain on which a five-axis machine holds the blade otherwise than planned.
    ChainPosture = "VC0530", Error, "blade off its planned place along a chain";
    /// A torque that a drive does not give.
    TorqueAboveLimit = "VC0531", Error, "torque above the limit of an axis";
    /// The same by numbers that are not those of the machine, or not all.
    TorqueIndicative = "VC0532", Warning, "torque probably above the limit of an axis";
    /// Forces that push a cut farther off than may be.
    DeviationAboveLimit = "VC0533", Error, "cut pushed off by more than its limit";
    /// The same by a stiffness that is not that of the machine.
    DeviationIndicative = "VC0534", Warning, "cut probably pushed off by more than its limit";
    /// A limit on deviations that nothing can check.
    LimitNotChecked = "VC0535", Error, "limit on deviation or torque that cannot be checked";
    /// Cuts that differ from how the forces of their blade were measured.
    ForcesElsewhere = "VC0536", Warning, "forces measured under other conditions";
    /// A load that the machine may not carry.
    LoadTooMuch = "VC0537", Error, "load that is too much for the machine";
    /// Tips that cannot be offset against forces.
    NotCompensated = "VC0538", Error, "cuts that cannot be compensated for forces";
    /// Cells whose walls push the edge at a frequency at which the arm swings.
    CellsMeetMode = "VC0539", Warning, "cells that meet a mode of the arm";
    /// Teeth of a crusher that come about as often as the arm swings by itself.
    TeethMeetMode = "VC0540", Warning, "teeth that meet a mode of the arm";

    /// A target that needs a machine.
    MissingMachine = "VC0601", Error, "target that needs a machine";
    /// A target that needs more of the machine.
    MissingMachineField = "VC0602", Error, "machine without a field that the target needs";
    /// An option that the target does not have.
    UnknownOption = "VC0603", Error, "unknown target option";
    /// An option with a value that it does not take.
    BadOption = "VC0604", Error, "invalid value for a target option";
    /// Something that the target cannot say.
    Unsupported = "VC0605", Error, "program that the target cannot express";
    /// A number that the target does not take.
    TargetRange = "VC0606", Error, "number outside the target's range";
    /// A machine that the target does not drive.
    WrongMachine = "VC0607", Error, "machine that the target does not drive";
    /// An invalid profile of a machine.
    BadProfile = "VC0608", Error, "invalid profile of a machine";
    /// A target that is a program of its own, which did not do its work.
    OutsideProgram = "VC0609", Error, "failed program of a target";

    /// An operation of a program that is not the job's.
    ChangedOperation = "VC0701", Error, "changed operation in a program";
    /// An operation that a program lacks.
    MissingOperation = "VC0702", Error, "missing operation in a program";
    /// Something that a program does beside its job.
    AddedOperation = "VC0703", Error, "added operation in a program";
    /// Statements in another order.
    OtherOrder = "VC0704", Error, "statements out of order";
    /// A setting that is not the one that was written.
    OtherSetting = "VC0705", Error, "changed setting in a program";
    /// A statement whose effect is not known.
    UnknownStatement = "VC0706", Error, "unknown statement in a program";
    /// Text that is not a statement.
    UnreadableStatement = "VC0707", Error, "unreadable statement in a program";

    /// A program that breaks a rule of the process.
    ProgramRule = "VC0708", Error, "program that breaks a rule of the process";
    /// A program whose cuts are wrong.
    ProgramCuts = "VC0709", Error, "program that cuts the part or leaves chips";
    /// A program that its machine does not carry out.
    ProgramReach = "VC0710", Error, "program that the machine cannot carry out";
    /// A program that was not checked further.
    ChecksLeftOut = "VC0711", Warning, "checks of a program left out";

    /// An invalid list of programs.
    BadManifest = "VC0801", Error, "invalid list of programs";
    /// A list of programs with a job that is not there.
    NoSuchJob = "VC0802", Error, "missing job in a list of programs";
    /// A list of programs with a target that is not there.
    NoSuchTarget = "VC0803", Error, "unknown target in a list of programs";
    /// Two programs that want one file.
    SameFile = "VC0804", Error, "two programs that write the same file";
    /// Parts of an earlier version of a program.
    StaleParts = "VC0805", Warning, "leftover parts of an earlier program";
    /// A program with worse figures than its baseline.
    WorseNumbers = "VC0806", Error, "figures worse than the baseline";
    /// A baseline that cannot be used.
    BadBaseline = "VC0807", Error, "unusable baseline";
    /// A program that the baseline does not have.
    NoBaseline = "VC0808", Error, "program missing from the baseline";

    /// A fault of the compiler.
    Internal = "VC0901", Error, "internal compiler error";

    /// A field that has no meaning beside given tips, or that they need.
    TipsBesideField = "VC1001", Error, "field that does not go with given tips";
    /// A given tip whose cut would enter the part.
    TipInPart = "VC1002", Error, "given tip that cuts into the part";
    /// A given tip that cuts nothing.
    TipCutsNothing = "VC1003", Warning, "given tip that cuts nothing";
    /// A motion of a milling program that is not a pass.
    NoPass = "VC1004", Error, "motion that cannot become a V-cut";
    /// A milling program whose motions cannot be followed.
    NotFollowed = "VC1005", Error, "milling program that cannot be followed";
    /// A milling program without passes.
    NothingToConvert = "VC1006", Error, "milling program without passes";
    /// Something that a milling program does not say clearly.
    Unclear = "VC1007", Error, "ambiguous milling program";
    /// Statements of a milling program that are left out.
    LeftOut = "VC1008", Warning, "statements left out of a conversion";
    /// Passes beside the blank.
    BesideBlank = "VC1009", Warning, "passes beside the blank";
    /// A routine that a milling program calls and no file holds.
    MissingRoutine = "VC1010", Error, "missing routine of a milling program";
    /// External axes that move in a milling program.
    ExternalAxis = "VC1011", Error, "external axes in a milling program";
    /// A milling program without its end.
    NotWhole = "VC1012", Warning, "milling program without its end";
    /// Passes above the blank.
    AboveBlank = "VC1013", Warning, "passes above the blank";
    /// Motions straight into the uncut blank.
    Plunge = "VC1014", Warning, "plunges into the uncut blank";
    /// Sides of a region cross, or enclose nothing.
    RegionTangled = "VC1101", Error, "region whose loops cross or do not close";
    /// A tool has no room in a pocket.
    PocketTooNarrow = "VC1103", Error, "pocket too narrow for its tool";
    /// More ground of a pocket stays uncut than may.
    PocketUncut = "VC1105", Error, "ground of a pocket uncut";
    /// The disc has no way to a strip over freed ground.
    NoWayForDisc = "VC1106", Error, "no way for the disc";
    /// A layer is thicker than its tool.
    LayerTooThick = "VC1108", Error, "layer thicker than the tool";
    /// More stays at the foot of a wall than may, or the blade has no room in a hollow one.
    WallLeft = "VC1109", Error, "wall that a straight blade cannot follow";
    /// A blade meets another wall than the one that it follows.
    WallTooShort = "VC1110", Error, "wall without room for the blade";
    /// More stands in corners of walls than may: the rim of a disc does not reach it.
    PillarsStay = "VC1111", Error, "pillars in corners";
    /// Core stands beyond an open side.
    OpenSideBlocked = "VC1112", Error, "open side where core stands";
    /// A pocket reaches out of the stock, or into another one.
    PocketOutside = "VC1113", Error, "pocket out of place";
    /// Lines of a sound field end within a pocket, or leave ground.
    FieldBroken = "VC1116", Warning, "lines of a sound field that end or leave ground";
    /// The way into a pocket that a job asks for is not there: a hole too narrow or out of place, no room for a helix, no open side.
    NoEntry = "VC1117", Error, "no such way into a pocket";
    /// The hole that a job names is not used.
    HoleUnused = "VC1118", Warning, "hole that is not used";
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
