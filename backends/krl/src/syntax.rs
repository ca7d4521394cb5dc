//! KRL as text: the statements of a file, each with its place, and nothing of what they do.
//!
//! [`statements`] walks over a file line by line, for KRL has one statement a line, and borrows everything from the text.
//! Names are as written; compare them without regard to case ([`is_same_name`]). What is KRL but not described here
//! (control flow, splines, arithmetic, types of one's own) is [`Phrase::Other`]; what is not KRL is
//! [`Phrase::Unreadable`]. Neither stops the walk.
//!
//! Sources: KUKA, Quickguide KRL-Syntax, KSS 8.x (2012); KUKA, KSS 8.3 Operating and Programming Instructions for System
//! Integrators (2015).

pub(crate) mod cursor;
mod motions;
mod parse;
mod types;
mod values;

pub(crate) use types::meaning;
pub use types::{
    Approximation, Arc, Component, Coordinates, Declaration, Directions, Field, Motion, Path, Phrase,
    Planner, Points, Scope, Setting, SettingValue, Span, Statement, Tail, Target, Value, Variable,
    is_same_name,
};

/// The statements of a text, in its order. Comments (with all fold marks) and blank lines do not count.
#[must_use]
pub const fn statements(text: &str) -> Statements<'_> {
    Statements {
        text,
        at: 0,
        end: text.len(),
    }
}

/// The walk over the statements of a text.
#[derive(Clone, Debug)]
pub struct Statements<'t> {
    text: &'t str,
    at: usize,
    end: usize,
}

impl<'t> Statements<'t> {
    /// Over the lines that begin in this span only, such as those of a routine
    /// ([`Routine::span`](crate::interpreter::index::Routine::span)).
    #[must_use]
    pub const fn within(text: &'t str, span: Span) -> Self {
        Self {
            text,
            at: span.start,
            end: span.end,
        }
    }

    /// Where they end in the text.
    #[must_use]
    pub const fn end(&self) -> usize {
        self.end
    }
}

impl<'t> Iterator for Statements<'t> {
    type Item = Statement<'t>;

    #[inline]
    fn next(&mut self) -> Option<Statement<'t>> {
        while self.at < self.end {
            let start = self.at;
            let rest = self.text.get(start..)?;
            let length = rest.find('\n').unwrap_or(rest.len());
            self.at = start + length + 1;
            if let Some((span, code)) = parse::code(rest.get(..length)?, start) {
                return Some(Statement {
                    span,
                    text: code,
                    phrase: parse::phrase(code),
                });
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn phrase(line: &str) -> Phrase<'_> {
        statements(line).next().unwrap().phrase
    }

    fn value(text: &str) -> Value<'_> {
        match phrase(text) {
            Phrase::Assignment { value, .. } => value,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn statements_have_places_without_comments_and_blanks() {
        let text = "&REL 1\r\n\r\n  DEF a( ) ; head\r\n;FOLD x\r\n\tHALT\r\nEND";
        let found: Vec<_> = statements(text)
            .map(|statement| (statement.text, statement.span))
            .collect();
        assert_eq!(
            found.iter().map(|(code, _)| *code).collect::<Vec<_>>(),
            ["&REL 1", "DEF a( )", "HALT", "END"]
        );
        for (code, span) in found {
            assert_eq!(&text[span.start..span.end], code);
        }
    }

    #[test]
    fn a_semicolon_in_quotes_begins_no_comment() {
        assert_eq!(value("N=\"a;b\" ; c"), Value::Text("a;b"));
    }

    #[test]
    fn values_are_distinguished() {
        assert_eq!(value("X=-1.5"), Value::Number(-1.5));
        assert_eq!(value("X='B101'"), Value::Number(5.0));
        assert_eq!(value("X='H fF'"), Value::Number(255.0));
        assert_eq!(value("X=true"), Value::Bool(true));
        assert_eq!(value("X=#VAR"), Value::Enum("VAR"));
        let variable = Variable {
            name: "TOOL_DATA",
            index: Some(3),
            field: None,
        };
        assert_eq!(value("$TOOL=TOOL_DATA[3]"), Value::Variable(variable));
        assert_eq!(phrase("X=A+1"), Phrase::Other("X"));
        assert_eq!(phrase("X=(1)"), Phrase::Other("X"));
    }

    #[test]
    fn structures_have_types_and_structures_in_them() {
        let Value::Structure(fields) = value("$LOAD={LOAD: M 5,CM {X 1,Y 2},NOTE[] \"n\"}") else {
            panic!("a structure");
        };
        let names: Vec<_> = fields.iter().map(|field| field.name).collect();
        assert_eq!(names, ["M", "CM", "NOTE"]);
        let Value::Coordinates(centre) = &fields[1].value else {
            panic!("coordinates");
        };
        assert_eq!(centre.all([Component::X, Component::Y]), Some([1.0, 2.0]));
        assert_eq!(centre.get(Component::Z), None);
    }

    #[test]
    fn components_are_found_by_their_names() {
        for component in Component::ALL {
            let name = format!("{component:?}");
            assert_eq!(Component::named(&name), Some(component));
            assert_eq!(Component::named(&name.to_lowercase()), Some(component));
        }
        for name in ["", "A7", "E0", "XY", "Q"] {
            assert_eq!(Component::named(name), None);
        }
    }

    #[test]
    fn declarations_may_have_several_names() {
        let Phrase::Declaration(declaration) = phrase("DECL GLOBAL E6POS XP1, XP2 ,LIST[7]") else {
            panic!("a declaration");
        };
        assert_eq!((declaration.scope, declaration.kind), (Scope::Global, "E6POS"));
        assert_eq!(declaration.name.name, "XP1");
        assert_eq!(declaration.further_names().collect::<Vec<_>>(), ["XP2"]);
    }
}
