//! What a kind of operation is in the language.

use super::report::Checked;
use super::session::Session;
use super::written::Written;
use crate::operation::Operation;
use crate::ways::{Way, Ways};
use core::fmt::Debug;
use vcutc_diagnostics::schema::field::{BlockSpec, Need, Takes};

/// A kind of operation in the language.
pub trait Kind: Debug + Sync {
    /// The two words of its head: `rough vcut`.
    fn head(&self) -> &'static str;

    /// The two words, one by one.
    fn words(&self) -> [&'static str; 2] {
        let (first, second) = self.head().split_once(' ').unwrap_or((self.head(), ""));
        [first, second]
    }

    /// Words that people write for it by mistake.
    fn mistaken_for(&self) -> &'static [&'static str] {
        &[]
    }

    /// The table of its fields.
    fn spec(&self) -> &'static BlockSpec;

    /// Whether it cuts towards a part, which the job then has to describe.
    fn needs_part(&self) -> bool {
        true
    }

    /// A block of it with this blade, as an example for a job that has none.
    fn example(&self, blade: &str) -> String {
        let required = self
            .spec()
            .fields
            .iter()
            .filter(|field| field.need == Need::Required);
        let lines = required.map(|field| match field.takes {
            Takes::Blade(_) => format!("  {} = {blade}\n", field.name),
            _ => format!("  {}\n", field.sample()),
        });
        format!("{} {{\n{}}}", self.head(), lines.collect::<String>())
    }

    /// Works out what a block of it means.
    fn check(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Box<dyn Operation>>;

    /// The same with all ways that the block leaves to the compiler; most leave none.
    fn ways(&self, written: Written<'_>, session: &mut Session<'_>) -> Checked<Ways> {
        Ok(Ways::one(Way {
            word: self.words()[1],
            operation: self.check(written, session)?,
        }))
    }
}

/// The kinds of operation that this compiler knows.
#[derive(Clone, Copy, Debug, Default)]
pub struct Operations(pub &'static [&'static dyn Kind]);

impl Operations {
    /// The kind whose head begins with these words; the first one of its first word where the second does not
    /// match any.
    #[must_use]
    pub fn find(self, first: &str, second: Option<&str>) -> Option<&'static dyn Kind> {
        let mut kinds = self.0.iter().copied().filter(|kind| kind.words()[0] == first);
        let named = kinds.clone().find(|kind| Some(kind.words()[1]) == second);
        named.or_else(|| kinds.next())
    }
}
