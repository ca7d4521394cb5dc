//! Statements of G-code, in terms that all controllers share: [`lines`] finds what of a line is statement, [`words`] the letters
//! with numbers in it, an [`order`](mod@order) is what it says, and arcs lie in a [`plane`].

mod lines;
mod order;
mod plane;
mod words;

pub(crate) use lines::{Code, Span, Style, line};
pub(crate) use order::{
    Act, CONVENTIONS, Convention, Coordinates, Cycle, FeedMode, Flow, Mode, Motion, Once, Order, Parsed,
    ReadError, Routine, Scope, Tcp, expected,
};
pub(crate) use plane::{Plane, Sense};
pub(crate) use words::{Block, Cursor, Number, Point, block};
