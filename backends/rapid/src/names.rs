//! Names: of modules and routines, which must not be those of the controller, and of the data that a program declares.
//!
//! Names have at most 32 characters, begin with a letter and do not mind case [A-KER]. All modules of a task share one name
//! space with the data, routines and instructions that RobotWare brings along.

use vcutc_backend_api::namer::{NameRules, Namer};

/// Longest name [A-KER].
pub(crate) const LONGEST_NAME: usize = 32;

/// Longest name of a main module: room is left for the suffix of a part, so that a program keeps its name when it grows.
pub(crate) const LONGEST_MAIN_NAME: usize = LONGEST_NAME - LONGEST_SUFFIX;

/// `_part` and four digits.
const LONGEST_SUFFIX: usize = 9;

/// Most parts that such a suffix can distinguish.
pub(crate) const MOST_PARTS: usize = 9999;

/// The entry of a task; exactly one routine has this name.
pub(crate) const MAIN: &str = "main";
/// The jointtarget of home.
pub(crate) const HOME: &str = "vc_home";
/// The jointtarget at which the blade is changed.
pub(crate) const CHANGE: &str = "vc_change";
/// The speed of the moves of all axes.
pub(crate) const AXES_SPEED: &str = "vc_axes";
/// The zone of rounded corners.
pub(crate) const ZONE: &str = "vc_zone";
/// The zone of joints of chains.
pub(crate) const BLEND: &str = "vc_blend";
/// The tool, when the program declares it and the job does not name it.
pub(crate) const TOOL: &str = "vc_tool";
/// The work object, likewise.
pub(crate) const WORK_OBJECT: &str = "vc_wobj";
/// Start of the names of tip speeds; a number follows.
pub(crate) const FEED: &str = "vc_feed";
/// Start of the names of reorientation rates; a number follows.
pub(crate) const RATE: &str = "vc_rate";
/// Start of the names of speeddata; a number follows.
pub(crate) const SPEED: &str = "vc_speed";

/// Start of all names that programs have of themselves. Nothing else may have such a name, so a job need
/// not know which of them its program needs.
const OWN: &str = "vc_";
/// Start of names of modules that would otherwise be a word of RAPID, or one of our own names.
const MODULE: &str = "job_";

const RULES: NameRules = NameRules {
    max_length: LONGEST_MAIN_NAME,
    prefix: MODULE,
    reserved: RESERVED,
};

/// The name of the main module for a job of that name, and none of those to avoid.
pub(crate) fn main_name(job: &str, avoid: &[String]) -> String {
    let mut namer = Namer::new(RULES);
    namer.avoid(avoid);
    let name = namer.name(job);
    if is_own(&name) {
        namer.name(&format!("{MODULE}{name}"))
    } else {
        name
    }
}

/// The name of the module of a part, counted from 1.
pub(crate) fn part_module(main: &str, part: usize) -> String {
    format!("{main}_m{part:03}")
}

/// The name of the routine of a part, counted from 1.
pub(crate) fn part_routine(main: &str, part: usize) -> String {
    format!("{main}_part{part:03}")
}

/// Whether a name begins as those do that programs have of themselves.
pub(crate) fn is_own(name: &str) -> bool {
    let start = name.get(..OWN.len());
    start.is_some_and(|start| start.eq_ignore_ascii_case(OWN))
}

/// Whether a text is a name that a job may give to data.
pub(crate) fn is_name(text: &str) -> bool {
    let upper = text.to_ascii_uppercase();
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && text.len() <= LONGEST_NAME
        && !is_own(text)
        && !RESERVED.contains(&upper.as_str())
}

/// Reserved words, data types, instructions, functions and data of RobotWare [A-KER, A-INS], as far as a user might call
/// a job so. Upper case.
#[rustfmt::skip]
pub(crate) const RESERVED: &[&str] = &[
    // Reserved words.
    "ALIAS", "AND", "BACKWARD", "CASE", "CONNECT", "CONST", "DEFAULT", "DIV", "DO", "ELSE", "ELSEIF", "ENDFOR", "ENDFUNC",
    "ENDIF", "ENDMODULE", "ENDPROC", "ENDRECORD", "ENDTEST", "ENDTRAP", "ENDWHILE", "ERROR", "EXIT", "FALSE", "FOR",
    "FROM", "FUNC", "GOTO", "IF", "INOUT", "LOCAL", "MOD", "MODULE", "NOSTEPIN", "NOT", "NOVIEW", "OR", "PERS", "PROC",
    "RAISE", "READONLY", "RECORD", "RETRY", "RETURN", "STEP", "SYSMODULE", "TASK", "TEST", "THEN", "TO", "TRAP", "TRUE",
    "TRYNEXT", "UNDO", "VAR", "VIEWONLY", "WHILE", "WITH", "XOR",
    // Data types.
    "AIOTRIGG", "BOOL", "BYTE", "CLOCK", "CONFDATA", "DATAPOS", "DIONUM", "DNUM", "ERRNUM", "EXTJOINT", "INTNUM", "IODEV",
    "JOINTTARGET", "LOADDATA", "MECUNIT", "MOTSETDATA", "NUM", "ORIENT", "POS", "POSE", "PROGDISP", "RAWBYTES",
    "ROBJOINT", "ROBTARGET", "SIGNALAI", "SIGNALAO", "SIGNALDI", "SIGNALDO", "SIGNALGI", "SIGNALGO", "SPEEDDATA",
    "STRING", "SWITCH", "SYMNUM", "TOOLDATA", "TPNUM", "TRIGGDATA", "TRIGGIOS", "WOBJDATA", "WZSTATIONARY",
    "WZTEMPORARY", "ZONEDATA",
    // Instructions.
    "ACCSET", "ACTUNIT", "ADD", "BITCLEAR", "BITSET", "BREAK", "CALLBYVAR", "CIRCPATHMODE", "CLEAR", "CLKRESET",
    "CLKSTART", "CLKSTOP", "CLOSE", "COMPACT", "CONFJ", "CONFL", "DEACTUNIT", "DECR", "EOFFSOFF", "EOFFSON", "EOFFSSET",
    "ERASEMODULE", "ERRWRITE", "GRIPLOAD", "IDELETE", "IDISABLE", "IENABLE", "INCR", "INVERTDO", "IPERS", "ISIGNALDI",
    "ISIGNALDO", "ISLEEP", "ITIMER", "IVARVALUE", "IWATCH", "LOAD", "MECHUNITLOAD", "MOVEABSJ", "MOVEC", "MOVECDO",
    "MOVEEXTJ", "MOVEJ", "MOVEJDO", "MOVEL", "MOVELDO", "MTOOLROTCALIB", "OPEN", "PATHACCLIM", "PATHRESOL", "PDISPOFF",
    "PDISPON", "PDISPSET", "PULSEDO", "REMOVE", "RESET", "RESETPPMOVED", "RESTOPATH", "REWIND", "SAVE", "SEARCHC",
    "SEARCHL", "SET", "SETAO", "SETDO", "SETGO", "SINGAREA", "SOFTACT", "SOFTDEACT", "STARTLOAD", "STARTMOVE", "STOP",
    "STOPMOVE", "STOREPATH", "TPERASE", "TPREADFK", "TPREADNUM", "TPSHOW", "TPWRITE", "TRIGGC", "TRIGGEQUIP",
    "TRIGGIO", "TRIGGJ", "TRIGGL", "TUNERESET", "TUNESERVO", "UNLOAD", "VELSET", "WAITDI", "WAITDO", "WAITLOAD",
    "WAITTIME", "WAITUNTIL", "WORLDACCLIM", "WRITE", "WZBOXDEF", "WZDISABLE", "WZENABLE",
    // Functions.
    "ABS", "ACOS", "ASIN", "ATAN", "ATAN2", "CALCJOINTT", "CALCROBT", "CDATE", "CJOINTT", "COS", "CPOS", "CROBT",
    "CSPEEDOVERRIDE", "CTIME", "CTOOL", "CWOBJ", "DEFACCFRAME", "DEFFRAME", "DIM", "DISTANCE", "DOTPROD", "EULERZYX", "EXP",
    "GETTIME", "INPOS", "ISPERS", "ISVAR", "NUMTOSTR", "OFFS", "OPMODE", "ORIENTZYX", "ORROBT", "POSEINV", "POSEMULT",
    "POSEVECT", "POW", "PRESENT", "RELTOOL", "ROBOS", "ROUND", "SIN", "SQRT", "STRLEN", "STRPART", "TAN", "TESTDI",
    "TEXTGET", "TRUNC", "VALTOSTR",
    // Predefined data, those of the module USER among them.
    "CLOCK1", "C_MOTSET", "C_PROGDISP", "DISKHOME", "DISKRAM", "DISKTEMP", "END_OF_LIST", "EOF", "EOF_BIN", "EOF_NUM",
    "ERRNO", "INTNO", "OP_AUTO", "OP_MAN_PROG", "OP_MAN_TEST", "OP_UNDEF", "REG1", "REG2", "REG3", "REG4", "REG5",
    "ROB_ID", "WAIT_MAX",
    "DIFFERENT", "EDGE", "EQ", "FINE", "GT", "HIGH", "LOAD0", "LOW", "LT", "NOTEQ", "PI", "STR_DIGIT", "STR_LOWER",
    "STR_UPPER", "STR_WHITE", "TOOL0", "WOBJ0",
    "V5", "V10", "V20", "V30", "V40", "V50", "V60", "V80", "V100", "V150", "V200", "V300", "V400", "V500", "V600", "V800",
    "V1000", "V1500", "V2000", "V2500", "V3000", "V4000", "V5000", "V6000", "V7000", "VMAX", "VLIN10", "VLIN20",
    "VLIN50", "VLIN100", "VLIN200", "VLIN500", "VLIN1000", "VROT1", "VROT2", "VROT5", "VROT10", "VROT20", "VROT50",
    "VROT100",
    "Z0", "Z1", "Z5", "Z10", "Z15", "Z20", "Z30", "Z40", "Z50", "Z60", "Z80", "Z100", "Z150", "Z200",
    // The entry, modules that every controller has, and names that Windows keeps for devices.
    "BASE", "MAIN", "MAINMODULE", "USER",
    "AUX", "COM1", "COM2", "COM3", "COM4", "CON", "LPT1", "LPT2", "LPT3", "LPT4", "NUL", "PRN",
];

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn reserved_words_are_in_upper_case_and_cannot_come_from_cutting_a_longer_name() {
        for word in RESERVED {
            assert_eq!(word.to_ascii_uppercase(), *word);
            assert!(word.len() < LONGEST_MAIN_NAME, "{word}");
        }
    }

    #[test]
    fn the_longest_part_name_just_fits() {
        let main = main_name(&"x".repeat(100), &[]);
        assert_eq!(main.len(), LONGEST_MAIN_NAME);
        assert_eq!(part_routine(&main, MOST_PARTS).len(), LONGEST_NAME);
        assert_eq!(part_module("rib", 7), "rib_m007");
    }

    #[test]
    fn names_of_the_controller_are_avoided() {
        for name in ["MoveL", "z10", "fine", "Tool0", "main", "v100", "pers", "reg1"] {
            assert_eq!(main_name(name, &[]), format!("job_{name}"));
        }
        for name in ["vc_feed1", "VC_home", "vc_rib"] {
            assert_eq!(main_name(name, &[]), format!("job_{name}"));
        }
        assert_eq!(main_name("Rib", &["RIB".to_owned()]), "Rib_2");
    }

    #[test]
    fn what_is_a_name() {
        assert!(is_name("doKnife_2"));
        for no in [
            "vc_feed1",
            "Vc_x",
            "reg5",
            "ErrNo",
            "",
            "2do",
            "do 2",
            "wobj0",
            "tär",
            &"x".repeat(33),
        ] {
            assert!(!is_name(no), "{no}");
        }
    }

    proptest! {
        #[test]
        fn any_job_name_gives_a_module_name(job in ".{0,40}") {
            let name = main_name(&job, &[]);
            prop_assert!(name.len() <= LONGEST_MAIN_NAME);
            prop_assert!(is_name(&name), "{}", name);
        }
    }
}
