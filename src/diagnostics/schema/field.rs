//! The fields that a block of a job or a table of a sheet has: their names, how they are written, and what they take.
//!
//! Readers and editors use the same description: a reader looks up here which fields are unknown or missing and which range
//! a value must be in, an editor what to offer.

use super::dimension::Dimension;
use super::range::Range;

/// What kind of entry a field is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// `name = value`.
    Value,
    /// `name { ... }`.
    Block,
    /// `name <= value`.
    Limit,
    /// `name <= value`, `name >= value`, or both.
    Bounds,
    /// `name (x, z) (x, z) ...`.
    Points,
}

/// Whether a block must have a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    /// It must.
    Required,
    /// It has a default, or means nothing when it is not there.
    Optional,
}

/// What the value of a field is.
#[derive(Clone, Copy, Debug)]
pub enum Takes {
    /// What the description does not state.
    Anything,
    /// A value of a range.
    Quantity(Range),
    /// One of a few words.
    Words(fn() -> Vec<&'static str>),
    /// The name of a blade of this kind: `straight`, `disc` or `crusher`.
    Blade(&'static str),
    /// The name of a region.
    Region,
    /// The name of a machine.
    Machine,
    /// One of a few calls, each with an example.
    Calls(&'static [(&'static str, &'static str)]),
    /// The fields of a block.
    Fields(&'static BlockSpec),
}

/// Whether a field can be left to the compiler.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leaving {
    /// It takes `auto`.
    Open,
    Closed,
}

/// A field that a block can have.
#[derive(Clone, Copy, Debug)]
pub struct FieldSpec {
    pub name: &'static str,
    /// What kind of entry it is.
    pub form: Form,
    /// A typical value; for a block with its braces.
    pub typical: &'static str,
    /// Whether it must be there.
    pub need: Need,
    pub takes: Takes,
    /// Whether it takes `auto`.
    pub leaving: Leaving,
}

impl FieldSpec {
    const fn new(name: &'static str, form: Form, typical: &'static str) -> Self {
        Self {
            name,
            form,
            typical,
            need: Need::Optional,
            takes: Takes::Anything,
            leaving: Leaving::Closed,
        }
    }

    /// The same, but it must be there.
    pub const fn required(self) -> Self {
        Self {
            need: Need::Required,
            ..self
        }
    }

    /// The same, with what its value is.
    pub const fn takes(self, takes: Takes) -> Self {
        Self { takes, ..self }
    }

    /// The same, with a value of a range.
    pub const fn within(self, range: Range) -> Self {
        self.takes(Takes::Quantity(range))
    }

    /// The same, but it can be left to the compiler.
    pub const fn or_auto(self) -> Self {
        Self {
            leaving: Leaving::Open,
            ..self
        }
    }

    /// The range of its values, if it takes a quantity.
    pub const fn quantity(&self) -> Option<Range> {
        match self.takes {
            Takes::Quantity(range) => Some(range),
            Takes::Anything
            | Takes::Words(_)
            | Takes::Blade(_)
            | Takes::Region
            | Takes::Machine
            | Takes::Calls(_)
            | Takes::Fields(_) => None,
        }
    }

    /// The range of its values; all values of a dimension where the description states none.
    pub fn range(&self, dimension: Dimension) -> Range {
        self.quantity().unwrap_or(Range::all(dimension))
    }

    /// The fields in it, if it is a block.
    pub const fn inner(&self) -> Option<&'static BlockSpec> {
        match self.takes {
            Takes::Fields(inner) => Some(inner),
            Takes::Anything
            | Takes::Quantity(_)
            | Takes::Words(_)
            | Takes::Blade(_)
            | Takes::Region
            | Takes::Machine
            | Takes::Calls(_) => None,
        }
    }

    /// The whole field with its typical value.
    pub fn sample(&self) -> String {
        match self.form {
            Form::Value => format!("{} = {}", self.name, self.typical),
            Form::Block | Form::Points => format!("{} {}", self.name, self.typical),
            Form::Limit | Form::Bounds => format!("{} <= {}", self.name, self.typical),
        }
    }
}

/// A field of the form `name = value`.
pub const fn value(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec::new(name, Form::Value, typical)
}

/// A field that may be left out and has no typical value, such as a source.
pub const fn optional(name: &'static str) -> FieldSpec {
    value(name, "")
}

/// A field of the form `name { ... }`.
pub const fn block(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec::new(name, Form::Block, typical)
}

/// A field of the form `name (x, z) (x, z) ...`.
pub const fn points(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec::new(name, Form::Points, typical)
}

/// A field of the form `name <= value`.
pub const fn limit(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec::new(name, Form::Limit, typical)
}

/// A field of the forms `name <= value` and `name >= value`.
pub const fn bounds(name: &'static str, typical: &'static str) -> FieldSpec {
    FieldSpec::new(name, Form::Bounds, typical)
}

#[derive(Debug)]
pub struct BlockSpec {
    /// What it is called in a sentence, such as `` `rough vcut` ``.
    pub title: &'static str,
    /// Its fields, in the order in which people write them.
    pub fields: &'static [FieldSpec],
    /// What inner blocks that are not fields are.
    pub inner: Inner,
}

impl BlockSpec {
    /// The fields of an inner block, by the words of its head.
    pub fn block(&self, first: &str, second: Option<&str>) -> Option<&'static BlockSpec> {
        match (self.inner, second) {
            (Inner::Machine { named, spec }, Some(_)) if first == named => Some(spec),
            (Inner::Machine { .. } | Inner::Refused | Inner::Rows, _) => self.field(first)?.inner(),
        }
    }

    /// The field of that name.
    pub fn field(&self, name: &str) -> Option<&'static FieldSpec> {
        self.fields.iter().find(|field| field.name == name)
    }
}

/// What inner blocks that are not fields are.
#[derive(Clone, Copy, Debug)]
pub enum Inner {
    /// They are unknown.
    Refused,
    /// They are unknown too, but the block has rows of control points beside its fields.
    Rows,
    /// They are those of a machine: options for a target, or of what is named in their heads.
    Machine {
        /// The word before the name.
        named: &'static str,
        /// Their fields.
        spec: &'static BlockSpec,
    },
}

impl Inner {
    /// Whether they are options for a target.
    pub const fn takes_target_options(self) -> bool {
        match self {
            Self::Refused | Self::Rows => false,
            Self::Machine { .. } => true,
        }
    }
}
