//! Names, variables and values within a statement.

use super::cursor::{Cursor, Number};
use super::types::{Component, Coordinates, Field, Value, Variable, is_same_name};

/// How deep structures lie within structures; `LOAD` needs two.
pub(super) const DEEPEST: u32 = 4;

/// Why a line is not a phrase of its kind.
pub(super) enum ParseError {
    /// Something else was expected.
    Expected(&'static str),
    /// It is KRL, but not of the part that is read.
    Other,
}

pub(super) type Parsed<T> = Result<T, ParseError>;

pub(super) const fn expected<T>(what: &'static str) -> Parsed<T> {
    Err(ParseError::Expected(what))
}

pub(super) fn name<'t>(cursor: &mut Cursor<'t>) -> Parsed<&'t str> {
    cursor.word().ok_or(ParseError::Expected("a name"))
}

/// The place and the field after a name.
pub(super) fn variable<'t>(called: &'t str, cursor: &mut Cursor<'t>) -> Parsed<Variable<'t>> {
    let mut index = None;
    if cursor.skip(b'[') {
        // `TEXT[]`, `GRID[1,2]` and `POINTS[I]` are KRL as well.
        index = Some(cursor.whole().ok_or(ParseError::Other)?);
        if !cursor.skip(b']') {
            return Err(ParseError::Other);
        }
    }
    let mut field = None;
    if cursor.skip(b'.') {
        field = Some(name(cursor)?);
    }
    match cursor.peek() {
        // A field of a field, or of a place in a field.
        Some(b'.' | b'[') => Err(ParseError::Other),
        _ => Ok(Variable {
            name: called,
            index,
            field,
        }),
    }
}

pub(super) fn value<'t>(cursor: &mut Cursor<'t>, depth: u32) -> Parsed<Value<'t>> {
    let value = match cursor.peek() {
        Some(b'{') => match coordinates(cursor)? {
            Some(coordinates) => Value::Coordinates(coordinates),
            None => structure(cursor, depth)?,
        },
        Some(b'#') => {
            cursor.skip(b'#');
            Value::Enum(name(cursor)?)
        }
        Some(b'"') => Value::Text(cursor.quoted(b'"').ok_or(ParseError::Expected("`\"`"))?),
        Some(b'\'') => Value::Number(bits(cursor).ok_or(ParseError::Expected("a number such as 'B101'"))?),
        Some(b'(') => return Err(ParseError::Other),
        Some(_) => match cursor.number() {
            Number::Is(number) => Value::Number(number),
            Number::Bad => return expected("a number"),
            Number::None => match cursor.word() {
                Some(word) if is_same_name(word, "TRUE") => Value::Bool(true),
                Some(word) if is_same_name(word, "FALSE") => Value::Bool(false),
                Some(word) if is_same_name(word, "NOT") => return Err(ParseError::Other),
                Some(word) => Value::Variable(variable(word, cursor)?),
                // `-XP1.X`
                None if matches!(cursor.peek(), Some(b'-' | b'+')) => return Err(ParseError::Other),
                None => return expected("a value"),
            },
        },
        None => return expected("a value"),
    };
    Ok(value)
}

/// `'B101'` or `'HFF'`.
fn bits(cursor: &mut Cursor<'_>) -> Option<f64> {
    let text = cursor.quoted(b'\'')?.trim_ascii();
    let (radix, digits) = match text.split_at_checked(1)? {
        ("B" | "b", digits) => (2, digits),
        ("H" | "h", digits) => (16, digits),
        _ => return None,
    };
    u32::from_str_radix(digits.trim_ascii(), radix)
        .ok()
        .map(f64::from)
}

/// `{E6POS: X 1.0,Y 2.0}` of known components only; none, and nothing read, when it is another structure.
#[inline]
pub(super) fn coordinates(cursor: &mut Cursor<'_>) -> Parsed<Option<Coordinates>> {
    let mut inner = *cursor;
    inner.skip(b'{');
    let mut coordinates = Coordinates::default();
    let mut first = true;
    loop {
        let Some(word) = inner.word() else {
            return expected("the name of a component");
        };
        if first && inner.skip(b':') {
            first = false;
            continue;
        }
        first = false;
        let Some(component) = Component::named(word) else {
            return Ok(None);
        };
        let number = match inner.number() {
            Number::Is(number) => number,
            Number::Bad => return expected("a number"),
            Number::None => match inner.peek() {
                Some(b'\'') => bits(&mut inner).ok_or(ParseError::Expected("a number such as 'B101'"))?,
                // A variable or a structure.
                Some(b'{') => return Ok(None),
                Some(byte) if byte.is_ascii_alphabetic() || matches!(byte, b'$' | b'(' | b'-' | b'+') => {
                    return Err(ParseError::Other);
                }
                _ => return expected("a number"),
            },
        };
        if coordinates.has(component) {
            return expected("each component once");
        }
        coordinates.set(component, number);
        if inner.skip(b'}') {
            *cursor = inner;
            return Ok(Some(coordinates));
        }
        separator(&mut inner)?;
    }
}

/// What stands between two fields, or arithmetic.
#[inline]
fn separator(cursor: &mut Cursor<'_>) -> Parsed<()> {
    if cursor.skip(b',') {
        return Ok(());
    }
    match cursor.peek() {
        Some(b'+' | b'-' | b'*' | b'/') => Err(ParseError::Other),
        _ => expected("`,` or `}`"),
    }
}

fn structure<'t>(cursor: &mut Cursor<'t>, depth: u32) -> Parsed<Value<'t>> {
    let Some(depth) = depth.checked_sub(1) else {
        return Err(ParseError::Other);
    };
    cursor.skip(b'{');
    let mut fields = Vec::new();
    loop {
        let mut called = name(cursor)?;
        if fields.is_empty() && cursor.skip(b':') {
            called = name(cursor)?;
        }
        // `TQ_NAME[] "..."`
        if cursor.skip(b'[') && !cursor.skip(b']') {
            return Err(ParseError::Other);
        }
        let value = value(cursor, depth)?;
        fields.push(Field { name: called, value });
        if cursor.skip(b'}') {
            return Ok(Value::Structure(fields));
        }
        separator(cursor)?;
    }
}

/// Nothing may follow; an operator makes it arithmetic.
pub(super) fn at_end(cursor: &mut Cursor<'_>) -> Parsed<()> {
    match cursor.peek() {
        None => Ok(()),
        Some(b'+' | b'-' | b'*' | b'/' | b'=' | b'<' | b'>' | b':') => Err(ParseError::Other),
        Some(_) => {
            let operators = [
                "AND", "OR", "EXOR", "NOT", "B_AND", "B_OR", "B_EXOR", "B_NOT", "C_DIS", "C_ORI", "C_VEL",
                "WITH",
            ];
            match cursor.word() {
                Some(word) if operators.iter().any(|name| is_same_name(word, name)) => Err(ParseError::Other),
                Some(_) | None => expected("the end of the line"),
            }
        }
    }
}
