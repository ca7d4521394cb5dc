//! Ways to do an operation, where a job leaves the choice between several to the compiler.

use crate::{CheckedJob, Operation};

/// One of the ways.
#[derive(Clone, Debug)]
pub struct Way {
    /// What it is called in the language: the second word of its head, such as `vcut`.
    pub word: &'static str,
    /// What it does.
    pub operation: Box<dyn Operation>,
}

impl PartialEq for Way {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word && *self.operation == *other.operation
    }
}

/// The ways to do an operation, at least one. The first one is preferred among equals.
#[derive(Clone, Debug, PartialEq)]
pub struct Ways {
    first: Way,
    others: Vec<Way>,
}

impl Ways {
    /// These ways.
    #[must_use]
    pub const fn of(first: Way, others: Vec<Way>) -> Self {
        Self { first, others }
    }

    /// The only way.
    #[must_use]
    pub const fn one(way: Way) -> Self {
        Self::of(way, Vec::new())
    }

    /// The preferred way.
    #[must_use]
    pub fn into_first(self) -> Way {
        self.first
    }

    /// Whether there is a choice.
    #[must_use]
    pub const fn are_several(&self) -> bool {
        !self.others.is_empty()
    }

    /// All of them, to be changed.
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut Way> {
        core::iter::once(&mut self.first).chain(&mut self.others)
    }

    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Way> {
        core::iter::once(&self.first).chain(&self.others)
    }
}

/// A choice that a job leaves open.
#[derive(Clone, Debug, PartialEq)]
pub struct OpenChoice {
    /// The operation, by its number from 0.
    pub operation: usize,
    pub ways: Ways,
}

impl CheckedJob {
    /// The job with its first open choice made, once in each way; none where it leaves none open.
    #[must_use]
    pub fn each_way(&self) -> Option<Vec<(&'static str, Self)>> {
        let (choice, rest) = self.open.split_first()?;
        let ways = choice.ways.iter().map(|way| {
            let mut job = self.clone();
            job.open = rest.to_vec();
            if let Some(operation) = job.operations.get_mut(choice.operation) {
                operation.clone_from(&way.operation);
            }
            (way.word, job)
        });
        Some(ways.collect())
    }
}
