//! Whether an answer is still wanted: work that has become needless ends early.
//!
//! While a user types, what was asked a moment ago is not needed any more, and the answer may take many
//! seconds. The caller holds an [`Interest`] for as long as the answer is wanted; the stages that take the
//! time carry a [`Wanted`] and look at it before each step of their long loops. Interest that is lost does
//! not come back. So an answer that is still wanted when it is complete was not cut short: it is, to the last
//! bit, the answer to a question in which interest cannot be lost. An answer that is not wanted any more may
//! have been cut short anywhere, and [`Wanted::answer`] does not give it out.
//!
//! The compiler does not read a clock. A caller that limits the time of a search drops the interest when that
//! time is over.

mod effort;

pub use effort::Effort;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Looks at whether anybody still wants to know.
#[derive(Clone, Debug)]
pub struct Wanted(Vec<Arc<AtomicBool>>);

/// Interest in an answer. It ends when this is dropped.
#[derive(Debug)]
#[must_use]
pub struct Interest(Arc<AtomicBool>);

/// The answer is not wanted any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needless;

impl Wanted {
    /// For a caller that does not lose interest.
    pub const ALWAYS: Self = Self(Vec::new());

    /// For a caller that does not want the answer.
    #[must_use]
    pub fn never() -> Self {
        Self(vec![Arc::new(AtomicBool::new(true))])
    }

    /// For as long as the interest is held.
    pub fn while_held() -> (Self, Interest) {
        let is_lost = Arc::new(AtomicBool::new(false));
        (Self(vec![Arc::clone(&is_lost)]), Interest(is_lost))
    }

    /// For as long as both are wanted.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        Self(self.0.iter().chain(&other.0).cloned().collect())
    }

    /// Whether what is done for the answer may be left.
    #[must_use]
    pub fn is_needless(&self) -> bool {
        self.0.iter().any(|is_lost| is_lost.load(Ordering::Acquire))
    }

    /// Continues if the answer is still wanted.
    ///
    /// # Errors
    /// When the answer is not wanted any more.
    pub fn go_on(&self) -> Result<(), Needless> {
        if self.is_needless() { Err(Needless) } else { Ok(()) }
    }

    /// The answer, if it is still wanted when it is complete.
    ///
    /// # Errors
    /// When it is not.
    pub fn answer<T>(&self, work: impl FnOnce() -> T) -> Result<T, Needless> {
        self.go_on()?;
        let answer = work();
        self.go_on()?;
        Ok(answer)
    }
}

impl Drop for Interest {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_that_is_not_wanted_any_more_is_not_given() {
        assert_eq!(Wanted::ALWAYS.answer(|| 1), Ok(1));
        let (wanted, interest) = Wanted::while_held();
        let same = wanted.clone();
        assert_eq!(wanted.answer(|| 2), Ok(2));
        assert_eq!(wanted.answer(|| drop(interest)), Err(Needless));
        assert!(same.is_needless());
        assert_eq!(same.answer(|| 3), Err(Needless));
    }

    #[test]
    fn what_two_want_ends_when_one_of_them_loses_interest() {
        let (one, _kept) = Wanted::while_held();
        let (other, lost) = Wanted::while_held();
        let both = one.and(&other);
        assert!(!both.is_needless());
        drop(lost);
        assert!(both.is_needless());
        assert!(!one.is_needless(), "the one alone goes on");
        assert!(one.and(&Wanted::never()).is_needless());
        assert!(!Wanted::ALWAYS.and(&one).is_needless());
    }
}
