//! The entities of an exchange structure (ISO 10303-21): where they stand, and what is in each.
//!
//! A first pass checks brackets and finds where each entity stands. An entity is read when it is needed; what is read in
//! all is bounded by a multiple of the file's length, however often entities refer to one.

use super::super::words::Word;
use super::super::{DataError, fault};
use super::tokens::{Kind, Token, Tokens};
use crate::patch::MOST_CONTROL;
use core::ops::Range;

/// Brackets within brackets. Control points take three.
const MOST_DEPTH: usize = 12;

/// Values in an entity: control points and weights of the largest surface.
const MOST_VALUES: usize = 2 * MOST_CONTROL + 1000;

/// How often the bytes of a file are read on average at most, and bytes on top for small files.
const MOST_READINGS: usize = 16;
const READ_AT_LEAST: usize = 1 << 16;

/// Characters of a keyword that messages show.
const MOST_SHOWN: usize = 60;

/// An entity, by where it stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entity {
    pub(super) id: u64,
    /// From its first token to before its semicolon.
    start: u32,
    end: u32,
}

/// A part of an entity: its keyword, and the values in brackets after it.
#[derive(Debug)]
pub(super) struct Record<'a> {
    pub(super) keyword: Word<'a>,
    pub(super) items: Vec<Item<'a>>,
}

/// An entity as it is read: one record, or several in brackets.
#[derive(Debug)]
pub(super) struct Instance<'a> {
    pub(super) records: Vec<Record<'a>>,
    pub(super) range: Range<usize>,
}

/// A value, with the text it stands in; that of a list is its first bracket.
#[derive(Debug)]
pub(super) struct Item<'a> {
    pub(super) word: Word<'a>,
    pub(super) value: Value<'a>,
}

#[derive(Debug)]
pub(super) enum Value<'a> {
    Number,
    Reference(u64),
    Enumeration,
    List(Vec<Item<'a>>),
    /// A value with the name of its type, such as `LENGTH_MEASURE(25.4)`.
    Typed(Vec<Item<'a>>),
    /// A text, bits, or a value that is left out.
    Other,
}

/// A reference to an entity, and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Reference {
    pub(super) id: u64,
    pub(super) range: Range<usize>,
}

/// The entities of a file.
pub(super) struct File<'a> {
    bytes: &'a [u8],
    /// In the order of their numbers.
    entities: Vec<Entity>,
    /// Bytes that may still be read.
    left: usize,
}

impl<'a> File<'a> {
    /// Finds the entities of a file.
    pub(super) fn scan(bytes: &'a [u8]) -> Result<Self, DataError> {
        if u32::try_from(bytes.len()).is_err() {
            return Err(fault(0..0, "this file is longer than 4 GiB"));
        }
        let start = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        let mut tokens = Tokens::new(bytes, start, bytes.len());
        let is_step = matches!(tokens.next(), Ok(Some(first)) if first.word.is("ISO-10303-21"));
        if !is_step {
            let message = "this is not a STEP file: it does not begin with `ISO-10303-21`";
            return Err(fault(start..bytes.len().min(start + 12), message));
        }
        punctuation(&mut tokens, Kind::Semicolon, "`;`")?;
        let mut entities = Vec::new();
        loop {
            let section = tokens.expect("`END-ISO-10303-21;`")?;
            if section.word.is("END-ISO-10303-21") {
                break;
            } else if section.word.is("DATA") {
                statement(&mut tokens)?;
                data(&mut tokens, &mut entities)?;
            } else if section.kind == Kind::Keyword {
                while !tokens.expect("`ENDSEC;`")?.word.is("ENDSEC") {}
                punctuation(&mut tokens, Kind::Semicolon, "`;`")?;
            } else {
                return Err(unexpected(section, "a section such as `DATA;`"));
            }
        }
        // Stable: of two with one number the earlier stays first.
        entities.sort_by_key(|entity: &Entity| entity.id);
        let twice = entities.windows(2).find(|pair| pair[0].id == pair[1].id);
        if let Some(&[_, again]) = twice {
            let message = format!("entity #{} stands twice in the file", again.id);
            return Err(fault(again.range(), message));
        }
        Ok(Self {
            bytes,
            entities,
            left: bytes
                .len()
                .saturating_mul(MOST_READINGS)
                .saturating_add(READ_AT_LEAST),
        })
    }

    pub(super) fn entities(&self) -> &[Entity] {
        &self.entities
    }

    /// The whole file, as a place.
    pub(super) const fn whole(&self) -> Range<usize> {
        0..self.bytes.len()
    }

    /// The keywords of an entity's records.
    pub(super) fn keywords(&self, entity: Entity) -> impl Iterator<Item = Word<'a>> {
        let range = entity.range();
        let mut tokens = Tokens::new(self.bytes, range.start, range.end);
        let mut depth = 0_usize;
        // Of a simple entity the first token is the only keyword of a record.
        let mut records_at = None;
        core::iter::from_fn(move || {
            loop {
                let token = tokens.next().ok().flatten()?;
                let outer = *records_at.get_or_insert(usize::from(token.kind == Kind::Open));
                match token.kind {
                    Kind::Keyword if depth == outer => return Some(token.word),
                    Kind::Open => depth += 1,
                    Kind::Close => depth = depth.saturating_sub(1),
                    _ => {}
                }
                if outer == 0 && depth > 0 {
                    return None;
                }
            }
        })
    }

    /// Reads the entity that is referred to.
    pub(super) fn named(&mut self, reference: &Reference) -> Result<Instance<'a>, DataError> {
        let found = self
            .entities
            .binary_search_by_key(&reference.id, |entity| entity.id);
        match found.ok().and_then(|place| self.entities.get(place).copied()) {
            Some(entity) => self.read(entity),
            None => Err(fault(
                reference.range.clone(),
                format!("there is no entity #{} in the file", reference.id),
            )),
        }
    }

    pub(super) fn read(&mut self, entity: Entity) -> Result<Instance<'a>, DataError> {
        let range = entity.range();
        self.left = self
            .left
            .checked_sub(range.len())
            .ok_or_else(|| fault(range.clone(), "entities like this one are referred to too often"))?;
        let mut parser = Parser {
            tokens: Tokens::new(self.bytes, range.start, range.end),
            values: 0,
        };
        let first = parser.tokens.expect("a keyword")?;
        let mut records = Vec::new();
        match first.kind {
            Kind::Keyword => records.push(parser.record(first)?),
            Kind::Open => loop {
                let next = parser.tokens.expect("`)`")?;
                match next.kind {
                    Kind::Close => break,
                    _ => records.push(parser.record(next)?),
                }
            },
            _ => return Err(unexpected(first, "the kind of an entity")),
        }
        match parser.tokens.next()? {
            None => Ok(Instance { records, range }),
            Some(token) => Err(unexpected(token, "`;`")),
        }
    }
}

impl Entity {
    pub(super) const fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Reads statements up to the end of a section with data.
fn data(tokens: &mut Tokens<'_>, entities: &mut Vec<Entity>) -> Result<(), DataError> {
    loop {
        let first = tokens.expect("`ENDSEC;`")?;
        let id = match first.kind {
            Kind::Reference(id) => id,
            Kind::Keyword if first.word.is("ENDSEC") => {
                return punctuation(tokens, Kind::Semicolon, "`;`");
            }
            _ => return Err(unexpected(first, "an entity such as `#12 = ...;`")),
        };
        punctuation(tokens, Kind::Equals, "`=`")?;
        tokens.skip_blanks()?;
        let start = tokens.at();
        let end = statement(tokens)?;
        // The length of the file was seen to fit.
        let offset = |place: usize| u32::try_from(place).unwrap_or(u32::MAX);
        entities.push(Entity {
            id,
            start: offset(start),
            end: offset(end),
        });
    }
}

/// Passes over a statement, whose brackets must be in order. Returns where its semicolon stands.
fn statement(tokens: &mut Tokens<'_>) -> Result<usize, DataError> {
    let mut depth = 0_usize;
    loop {
        let token = tokens.expect("`;`")?;
        match token.kind {
            Kind::Open if depth == MOST_DEPTH => {
                let message = format!("brackets are nested more than {MOST_DEPTH} deep here");
                return Err(fault(token.word.range(), message));
            }
            Kind::Open => depth += 1,
            Kind::Close => {
                let closed = depth.checked_sub(1);
                depth = closed.ok_or_else(|| fault(token.word.range(), "no bracket is open here"))?;
            }
            Kind::Semicolon if depth == 0 => return Ok(token.word.start),
            Kind::Semicolon => return Err(fault(token.word.range(), "a bracket is still open here")),
            Kind::Keyword
            | Kind::Number
            | Kind::Reference(_)
            | Kind::Enumeration
            | Kind::Text
            | Kind::Binary
            | Kind::Omitted
            | Kind::Derived
            | Kind::Comma => {}
            Kind::Equals | Kind::Other => return Err(unexpected(token, "`;`")),
        }
    }
}

fn punctuation(tokens: &mut Tokens<'_>, kind: Kind, what: &str) -> Result<(), DataError> {
    let token = tokens.expect(what)?;
    if token.kind == kind {
        Ok(())
    } else {
        Err(unexpected(token, what))
    }
}

fn unexpected(token: Token<'_>, expected: &str) -> DataError {
    fault(
        token.word.range(),
        format!("`{}` stands where {expected} should", token.word.shown()),
    )
}

/// Reads one entity.
struct Parser<'a> {
    tokens: Tokens<'a>,
    values: usize,
}

impl<'a> Parser<'a> {
    /// A record whose first token was taken.
    fn record(&mut self, first: Token<'a>) -> Result<Record<'a>, DataError> {
        if first.kind != Kind::Keyword {
            return Err(unexpected(first, "the kind of an entity"));
        }
        punctuation(&mut self.tokens, Kind::Open, "`(`")?;
        Ok(Record {
            keyword: first.word,
            items: self.items()?,
        })
    }

    /// Values up to the closing bracket. How deep they are nested was checked.
    fn items(&mut self) -> Result<Vec<Item<'a>>, DataError> {
        let mut items = Vec::new();
        let mut token = self.tokens.expect("`)`")?;
        if token.kind == Kind::Close {
            return Ok(items);
        }
        loop {
            self.values += 1;
            if self.values > MOST_VALUES {
                let message = format!("this entity has more than {MOST_VALUES} values");
                return Err(fault(token.word.range(), message));
            }
            let value = match token.kind {
                Kind::Number => Value::Number,
                Kind::Reference(id) => Value::Reference(id),
                Kind::Enumeration => Value::Enumeration,
                Kind::Text | Kind::Binary | Kind::Omitted | Kind::Derived => Value::Other,
                Kind::Open => Value::List(self.items()?),
                Kind::Keyword => {
                    punctuation(&mut self.tokens, Kind::Open, "`(`")?;
                    Value::Typed(self.items()?)
                }
                Kind::Close | Kind::Comma | Kind::Equals | Kind::Semicolon | Kind::Other => {
                    return Err(unexpected(token, "a value"));
                }
            };
            items.push(Item {
                word: token.word,
                value,
            });
            let next = self.tokens.expect("`)`")?;
            match next.kind {
                Kind::Close => return Ok(items),
                Kind::Comma => token = self.tokens.expect("a value")?,
                _ => return Err(unexpected(next, "`,` or `)`")),
            }
        }
    }
}

impl<'a> Instance<'a> {
    /// The record of that kind.
    pub(super) fn record(&self, keyword: &str) -> Option<&Record<'a>> {
        self.records.iter().find(|record| record.keyword.is(keyword))
    }

    /// The record of an entity that has only one, if it is of that kind.
    pub(super) fn simple(&self, keyword: &str) -> Option<&Record<'a>> {
        match self.records.as_slice() {
            [only] => Some(only).filter(|record| record.keyword.is(keyword)),
            _ => None,
        }
    }

    /// The record of an entity that must be of that kind.
    pub(super) fn must_be(&self, keyword: &str) -> Result<&Record<'a>, DataError> {
        self.simple(keyword).ok_or_else(|| {
            let message = format!(
                "this is {}, where {keyword} is expected",
                with_article(&self.kind())
            );
            fault(self.range.clone(), message)
        })
    }

    /// What it is called in messages: the clearest of its keywords, which is the longest.
    pub(super) fn kind(&self) -> String {
        let longest = self
            .records
            .iter()
            .max_by_key(|record| record.keyword.bytes.len());
        longest.map_or_else(|| "nothing".to_owned(), |record| shown(record.keyword))
    }
}

impl<'a> Record<'a> {
    /// The value at a place, counted from 0.
    pub(super) fn at(&self, place: usize) -> Result<&Item<'a>, DataError> {
        self.items.get(place).ok_or_else(|| {
            let message = format!("{} has fewer than {} values", shown(self.keyword), place + 1);
            fault(self.keyword.range(), message)
        })
    }
}

impl<'a> Item<'a> {
    pub(super) fn reference(&self) -> Result<Reference, DataError> {
        match self.value {
            Value::Reference(id) => Ok(Reference {
                id,
                range: self.word.range(),
            }),
            _ => Err(self.instead_of("a reference such as `#12`")),
        }
    }

    pub(super) fn list(&self) -> Result<&[Item<'a>], DataError> {
        match &self.value {
            Value::List(items) => Ok(items),
            _ => Err(self.instead_of("a list in brackets")),
        }
    }

    /// A number, which may have the name of its type.
    pub(super) fn number(&self) -> Result<f64, DataError> {
        match &self.value {
            Value::Number => self.word.coordinate(),
            Value::Typed(items) => match items.as_slice() {
                [only] if matches!(only.value, Value::Number) => only.word.coordinate(),
                _ => Err(self.instead_of("a number")),
            },
            _ => Err(self.instead_of("a number")),
        }
    }

    /// A whole number from one to another.
    pub(super) fn whole(&self, range: core::ops::RangeInclusive<usize>) -> Result<usize, DataError> {
        let value = match self.value {
            Value::Number => self.word.whole().and_then(|whole| usize::try_from(whole).ok()),
            _ => None,
        };
        value.filter(|whole| range.contains(whole)).ok_or_else(|| {
            self.instead_of(&format!(
                "a whole number from {} to {}",
                range.start(),
                range.end()
            ))
        })
    }

    /// Whether it is this word between points.
    pub(super) fn is_word(&self, name: &str) -> bool {
        let bytes = self.word.bytes;
        let inner = bytes.get(1..bytes.len().saturating_sub(1)).unwrap_or_default();
        matches!(self.value, Value::Enumeration) && inner.eq_ignore_ascii_case(name.as_bytes())
    }

    fn instead_of(&self, expected: &str) -> DataError {
        fault(
            self.word.range(),
            format!("`{}` stands where {expected} should", self.word.shown()),
        )
    }
}

/// A keyword for messages.
pub(super) fn shown(keyword: Word<'_>) -> String {
    let bytes = keyword.bytes.get(..MOST_SHOWN).unwrap_or(keyword.bytes);
    String::from_utf8_lossy(bytes).to_ascii_uppercase()
}

/// A kind with its article.
pub(super) fn with_article(kind: &str) -> String {
    let article = if kind.starts_with(['A', 'E', 'I', 'O', 'U']) {
        "an"
    } else {
        "a"
    };
    format!("{article} {kind}")
}
