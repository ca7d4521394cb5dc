//! Where a value is being written: what it is for, in which brackets, and beside which operators. From that follows its
//! dimension, as far as it can be said.

use super::surroundings::Surroundings;
use vcutc_job::sema::vocabulary;
use vcutc_syntax::ast::Row;

/// A place for a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Slot {
    /// What the whole value is for.
    pub(super) owner: Owner,
    /// The brackets that are open within the value, from the outermost.
    pub(super) within: Vec<Within>,
    /// How it relates to its neighbours.
    pub(super) part: Part,
    /// Whether anything of the value is before it.
    pub(super) rest: Rest,
}

/// What a value is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Owner {
    /// The field, limit or option of that name.
    Field(String),
    /// A `let`, or nothing that is known.
    Let,
    /// A coordinate or a radius.
    Coordinate,
    /// The formula of a profile, with its variable.
    Formula(String),
}

/// A bracket within a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Within {
    /// The call whose bracket it is; none for a calculation, a point or a list.
    pub(super) call: Option<String>,
    /// The name of the value in the call.
    pub(super) label: Option<String>,
    /// How many values are before it.
    pub(super) place: usize,
    /// How the whole of it relates to its neighbours.
    pub(super) part: Part,
}

/// How a value relates to its neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// It has the dimension of the whole: it is that, or added to it.
    Summand,
    /// It is multiplied, divided or raised, so that its dimension is its own affair.
    Factor,
}

/// Whether anything of a value is before a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rest {
    Begins,
    /// Something is before it.
    GoesOn,
}

impl Slot {
    /// Where a value, or the next part of one, begins before a token. The word that is being written may be there.
    pub(super) fn at(around: &Surroundings<'_>, before: usize) -> Self {
        let end = if around.is_word(before) {
            before + 1
        } else {
            before
        };
        Self::of(around, before, end)
    }

    /// Where a unit is wanted: after the number before a token, and before a unit that may be there.
    pub(super) fn after(around: &Surroundings<'_>, before: usize) -> Self {
        Self::of(around, before.saturating_sub(1), after_unit(around, before))
    }

    /// Of the operand that reaches from a token to another.
    fn of(around: &Surroundings<'_>, start: usize, end: usize) -> Self {
        let brackets = around.value_brackets(start);
        let first = brackets
            .first()
            .map_or(start, |&bracket| name_before(around, bracket));
        let begins = start
            .checked_sub(1)
            .is_some_and(|last| around.is_symbol(last, &["=", "<=", ">="]));
        Self {
            owner: owner(around, first),
            within: within(around, &brackets, start),
            part: part(around, start, end),
            rest: if begins && brackets.is_empty() {
                Rest::Begins
            } else {
                Rest::GoesOn
            },
        }
    }

    /// The innermost call.
    pub(super) fn call(&self) -> Option<&Within> {
        self.within.last().filter(|within| within.call.is_some())
    }
}

/// After the unit that a token begins, such as `mm` or `deg/s`; the token itself if it begins none.
fn after_unit(around: &Surroundings<'_>, start: usize) -> usize {
    let word = |number: usize| around.word(number).unwrap_or_default();
    let quotient = format!("{}/{}", word(start), word(start + 2));
    if around.is_symbol(start + 1, &["/"]) && vocabulary::unit_in_words(&quotient).is_some() {
        start + 3
    } else {
        start + usize::from(around.is_word(start) || around.is_symbol(start, &["%"]))
    }
}

/// The first token of a call or group with that bracket.
fn name_before(around: &Surroundings<'_>, bracket: usize) -> usize {
    match bracket.checked_sub(1) {
        Some(name) if is_call(around, name) => name,
        Some(_) | None => bracket,
    }
}

/// Whether the word before a bracket is that of a call; words of pieces are not.
fn is_call(around: &Surroundings<'_>, name: usize) -> bool {
    let of_pieces = |word: &str| {
        Row::named(word).is_some()
            || vocabulary::JOINTS_OF_CURVES.contains(&word)
            || vocabulary::begins_a_piece(word)
    };
    let is_unit = name.checked_sub(1).is_some_and(|number| around.is_number(number));
    around.word(name).is_some_and(|word| !of_pieces(word)) && !is_unit
}

fn owner(around: &Surroundings<'_>, first: usize) -> Owner {
    for number in around.back_from(first) {
        if let Some(word) = around.word(number)
            && (Row::named(word).is_some()
                || vocabulary::JOINTS_OF_CURVES.contains(&word)
                || vocabulary::begins_a_piece(word))
        {
            return Owner::Coordinate;
        }
        if around.is_symbol(number, &["=", "<=", ">="]) {
            return owner_before(around, number);
        }
    }
    Owner::Let
}

/// Whose value begins after a sign.
fn owner_before(around: &Surroundings<'_>, sign: usize) -> Owner {
    let word = |back: usize| sign.checked_sub(back).and_then(|number| around.word(number));
    if sign.checked_sub(1).is_some_and(|last| around.closes(last)) {
        return Owner::Formula(word(2).unwrap_or_default().to_owned());
    }
    match (word(2), word(1)) {
        (Some("let"), _) | (_, None) => Owner::Let,
        (_, Some(field)) => Owner::Field(field.to_owned()),
    }
}

fn within(around: &Surroundings<'_>, brackets: &[usize], start: usize) -> Vec<Within> {
    let inner = brackets.iter().skip(1).copied().map(Some).chain([None]);
    brackets
        .iter()
        .zip(inner)
        .map(|(&bracket, inner)| {
            // What is in the bracket before the next inner one.
            let until = inner.unwrap_or(start);
            let mut place = 0;
            let mut label = None;
            for number in around.back_from(until) {
                if number <= bracket {
                    break;
                }
                if around.is_symbol(number, &[","]) {
                    place += 1;
                } else if place == 0 && around.is_symbol(number, &["="]) {
                    label = around.word(number - 1).map(str::to_owned);
                }
            }
            let name = name_before(around, bracket);
            let end = around.partner(bracket).map_or(usize::MAX, |close| close + 1);
            Within {
                call: (name < bracket)
                    .then(|| around.word(name).map(str::to_owned))
                    .flatten(),
                label,
                place,
                part: part(around, name, end),
            }
        })
        .collect()
}

/// How the operand from a token to another relates to its neighbours.
fn part(around: &Surroundings<'_>, start: usize, end: usize) -> Part {
    const BINDING: &[&str] = &["*", "/", "^"];
    // Minus signs before it change nothing.
    let mut before = start.checked_sub(1);
    while let Some(number) = before
        && around.is_symbol(number, &["-"])
    {
        before = number.checked_sub(1);
    }
    let is_bound =
        before.is_some_and(|number| around.is_symbol(number, BINDING)) || around.is_symbol(end, BINDING);
    if is_bound { Part::Factor } else { Part::Summand }
}
