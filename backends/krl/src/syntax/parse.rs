//! One line of KRL as a [`Phrase`].

use super::cursor::{Cursor, Number};
use super::motions;
use super::types::{Declaration, Phrase, Scope, Span, is_same_name, meaning};
use super::values::{DEEPEST, ParseError, Parsed, at_end, expected, name, value, variable};

/// The statement of a line that begins at a byte of its text: without its comment and the blanks around it.
#[inline]
pub(super) fn code(line: &str, start: usize) -> Option<(Span, &str)> {
    let code = match line.find(';') {
        Some(comment) => line.get(..before_comment(line, comment))?,
        None => line,
    };
    let from = code.trim_ascii_start();
    let start = start + (code.len() - from.len());
    let code = from.trim_ascii_end();
    let end = start + code.len();
    (!code.is_empty()).then_some((Span { start, end }, code))
}

/// Where the comment begins, given the first `;`. A `;` between double quotes does not begin one.
fn before_comment(line: &str, first: usize) -> usize {
    if !line.get(..first).is_some_and(|before| before.contains('"')) {
        return first;
    }
    let mut quoted = false;
    let comment = line.bytes().position(|byte| {
        quoted ^= byte == b'"';
        byte == b';' && !quoted
    });
    comment.unwrap_or(line.len())
}

/// What a statement without comment is.
#[inline]
pub(super) fn phrase(code: &str) -> Phrase<'_> {
    let mut cursor = Cursor::new(code);
    let Some(word) = cursor.word() else {
        return match code.strip_prefix('&') {
            Some(mark) => Phrase::Mark(mark),
            None => Phrase::Unreadable {
                expected: "a statement of KRL",
            },
        };
    };
    match statement(word, &mut cursor) {
        Ok(phrase) => phrase,
        Err(ParseError::Other) => Phrase::Other(word),
        Err(ParseError::Expected(expected)) => Phrase::Unreadable { expected },
    }
}

#[inline]
fn statement<'t>(word: &'t str, cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    if let Some(motion) = motions::phrase(word, cursor) {
        return motion;
    }
    match Keyword::of(word) {
        Some(keyword) => keyword_statement(keyword, cursor),
        None => plain_statement(word, cursor),
    }
}

/// Words that begin statements, motions apart.
#[derive(Clone, Copy)]
enum Keyword {
    Def,
    Global,
    End,
    DefDat,
    EndDat,
    Ext,
    Decl,
    Bas,
    Wait,
    Halt,
    /// Of statements that are not described.
    Other,
}

impl Keyword {
    fn of(word: &str) -> Option<Self> {
        let words = [
            ("DEF", Self::Def),
            ("GLOBAL", Self::Global),
            ("END", Self::End),
            ("DEFDAT", Self::DefDat),
            ("ENDDAT", Self::EndDat),
            ("EXT", Self::Ext),
            ("DECL", Self::Decl),
            ("BAS", Self::Bas),
            ("WAIT", Self::Wait),
            ("HALT", Self::Halt),
        ];
        let described = meaning(word, &words);
        described.or_else(|| {
            let is_known = OTHERS.iter().any(|name| is_same_name(word, name));
            is_known.then_some(Self::Other)
        })
    }
}

/// Words that begin statements which are not described [K-QG].
#[rustfmt::skip]
const OTHERS: [&str; 56] = [
    "ANIN", "ANOUT", "BRAKE", "CASE", "CCLOSE", "CHANNEL", "CIRC", "CIRC_REL", "CONFIRM", "CONST", "CONST_VEL", "CONTINUE",
    "COPEN", "CREAD", "CWRITE", "DEFAULT", "DEFFCT", "DIGIN", "ELSE", "ENDFCT", "ENDFOR", "ENDIF", "ENDLOOP", "ENDSPLINE",
    "ENDSWITCH", "ENDWHILE", "ENUM", "ERR_RAISE", "EXIT", "EXTFCT", "EXTFCTP", "EXTP", "FOR", "GOTO", "IF", "IMPORT",
    "INTERRUPT", "LOOP", "ON_ERROR_PROCEED", "PTP_SPLINE", "PULSE", "REPEAT", "RESUME", "RETURN", "SCIRC", "SCIRC_REL",
    "SIGNAL", "SPL", "SPL_REL", "SPLINE", "STRUC", "SWITCH", "TIME_BLOCK", "TRIGGER", "UNTIL", "WHILE",
];

/// Types that need no `DECL`; files also leave it out before positions.
const TYPES: [&str; 11] = [
    "AXIS", "BOOL", "CHAR", "E3AXIS", "E3POS", "E6AXIS", "E6POS", "FRAME", "INT", "POS", "REAL",
];

fn keyword_statement<'t>(keyword: Keyword, cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    let phrase = match keyword {
        Keyword::Def => def(cursor, Scope::Module)?,
        Keyword::Global => return global(cursor),
        Keyword::End => Phrase::End,
        Keyword::DefDat => {
            let name = name(cursor)?;
            let scope = match cursor.word() {
                Some(word) if is_same_name(word, "PUBLIC") => Scope::Global,
                Some(_) => return expected("`PUBLIC` or the end of the line"),
                None => Scope::Module,
            };
            Phrase::DefDat { name, scope }
        }
        Keyword::EndDat => Phrase::EndDat,
        Keyword::Ext => {
            let name = name(cursor)?;
            arguments(cursor)?;
            Phrase::Ext { name }
        }
        Keyword::Decl => match cursor.word() {
            Some(word) if is_same_name(word, "GLOBAL") => {
                let kind = name(cursor)?;
                declaration(kind, Scope::Global, cursor)?
            }
            Some(kind) => declaration(kind, Scope::Module, cursor)?,
            None => return expected("a type after `DECL`"),
        },
        Keyword::Bas => bas(cursor)?,
        Keyword::Wait => wait(cursor)?,
        Keyword::Halt => Phrase::Halt,
        Keyword::Other => return Err(ParseError::Other),
    };
    at_end(cursor)?;
    Ok(phrase)
}

fn global<'t>(cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    let phrase = match cursor.word() {
        Some(word) if is_same_name(word, "DEF") => def(cursor, Scope::Global)?,
        Some(word) if is_same_name(word, "DECL") => {
            let kind = name(cursor)?;
            declaration(kind, Scope::Global, cursor)?
        }
        Some(word) if Keyword::of(word).is_some() => return Err(ParseError::Other),
        Some(kind) => declaration(kind, Scope::Global, cursor)?,
        None => return expected("what is global"),
    };
    at_end(cursor)?;
    Ok(phrase)
}

fn def<'t>(cursor: &mut Cursor<'t>, scope: Scope) -> Parsed<Phrase<'t>> {
    let name = name(cursor)?;
    arguments(cursor)?;
    Ok(Phrase::Def { name, scope })
}

/// `(...)`: what stands between the brackets, blanks apart.
fn arguments<'t>(cursor: &mut Cursor<'t>) -> Parsed<&'t str> {
    if !cursor.skip(b'(') {
        return expected("`(`");
    }
    let rest = cursor.rest();
    let Some(inner) = rest.strip_suffix(')') else {
        return expected("`)` at the end of the line");
    };
    *cursor = Cursor::new("");
    Ok(inner.trim_ascii())
}

fn bas<'t>(cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    let mut inner = Cursor::new(arguments(cursor)?);
    if !inner.skip(b'#') {
        return Err(ParseError::Other);
    }
    let command = name(&mut inner)?;
    let value = if inner.skip(b',') {
        match inner.number() {
            Number::Is(value) => Some(value),
            Number::Bad => return expected("a number"),
            Number::None => return Err(ParseError::Other),
        }
    } else {
        None
    };
    at_end(&mut inner)?;
    Ok(Phrase::Bas { command, value })
}

fn wait<'t>(cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    match cursor.word() {
        Some(word) if is_same_name(word, "SEC") => match cursor.number() {
            Number::Is(seconds) => Ok(Phrase::WaitSec(seconds)),
            Number::Bad => expected("seconds"),
            Number::None => Err(ParseError::Other),
        },
        Some(word) if is_same_name(word, "FOR") => match cursor.word() {
            Some(name) if !is_same_name(name, "NOT") => Ok(Phrase::WaitFor(variable(name, cursor)?)),
            Some(_) | None => Err(ParseError::Other),
        },
        Some(_) | None => expected("`SEC` or `FOR` after `WAIT`"),
    }
}

/// Statements that begin with a name of one's own: declarations, calls, assignments.
fn plain_statement<'t>(word: &'t str, cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    let phrase = match cursor.peek() {
        Some(b'(') => Phrase::Call {
            name: word,
            arguments: arguments(cursor)?,
        },
        Some(b'=' | b'.' | b'[') => {
            let to = variable(word, cursor)?;
            if !cursor.skip(b'=') {
                return expected("`=`");
            }
            let value = value(cursor, DEEPEST)?;
            Phrase::Assignment { to, value }
        }
        // A label, where GOTO leads.
        Some(b':') => return Err(ParseError::Other),
        Some(byte) if byte.is_ascii_alphabetic() || matches!(byte, b'_' | b'$') => {
            if !TYPES.iter().any(|name| is_same_name(word, name)) {
                return expected("a statement of KRL");
            }
            declaration(word, Scope::Module, cursor)?
        }
        Some(_) | None => return expected("`(` or `=` after a name"),
    };
    at_end(cursor)?;
    Ok(phrase)
}

fn declaration<'t>(kind: &'t str, scope: Scope, cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    if Keyword::of(kind).is_some() {
        return Err(ParseError::Other);
    }
    let name = name(cursor)?;
    let name = variable(name, cursor)?;
    let value = if cursor.skip(b'=') {
        Some(value(cursor, DEEPEST)?)
    } else {
        None
    };
    let mut further = "";
    if value.is_none() && cursor.skip(b',') {
        further = cursor.rest();
        further_names(cursor)?;
    }
    Ok(Phrase::Declaration(Declaration {
        scope,
        kind,
        name,
        value,
        further,
    }))
}

/// Goes over names with commas between them.
fn further_names(cursor: &mut Cursor<'_>) -> Parsed<()> {
    loop {
        let name = name(cursor)?;
        variable(name, cursor)?;
        if !cursor.skip(b',') {
            return Ok(());
        }
    }
}
