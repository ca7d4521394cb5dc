//! Whether an answer is still wanted: work that has become needless ends early.
//!
//! While somebody types, what was asked a moment ago is of no use any more, and it may take many seconds to find out. Who asks
//! holds an [`Interest`] for as long as it wants to know; the stages that take the time carry a [`Wanted`] and look at it
//! before each step of their long loops. Interest that is lost does not come back. So an answer that is still wanted when it is
//! complete was cut short nowhere: to the last bit it is that of a question in which nobody could lose interest. One that is
//! no longer wanted by then may have been cut short anywhere, and [`Wanted::answer`] gives it to nobody.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Looks at whether anybody still wants to know.
#[derive(Clone, Debug)]
pub struct Wanted(Option<Arc<AtomicBool>>);

/// Interest in an answer. It ends when this is dropped.
#[derive(Debug)]
#[must_use]
pub struct Interest(Arc<AtomicBool>);

/// Nobody wants to know any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needless;

impl Wanted {
    /// For who does not lose interest.
    pub const ALWAYS: Self = Self(None);

    /// For as long as the interest is held.
    pub fn while_held() -> (Self, Interest) {
        let is_lost = Arc::new(AtomicBool::new(false));
        (Self(Some(Arc::clone(&is_lost))), Interest(is_lost))
    }

    /// Whether what is done for the answer may be left.
    #[must_use]
    pub fn is_needless(&self) -> bool {
        let is_lost = |is_lost: &Arc<AtomicBool>| is_lost.load(Ordering::Acquire);
        self.0.as_ref().is_some_and(is_lost)
    }

    /// Goes on where somebody wants to know.
    ///
    /// # Errors
    /// When nobody does.
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
    fn an_answer_that_is_no_longer_wanted_is_given_to_nobody() {
        assert_eq!(Wanted::ALWAYS.answer(|| 1), Ok(1));
        let (wanted, interest) = Wanted::while_held();
        let same = wanted.clone();
        assert_eq!(wanted.answer(|| 2), Ok(2));
        assert_eq!(wanted.answer(|| drop(interest)), Err(Needless));
        assert!(same.is_needless());
        assert_eq!(same.answer(|| 3), Err(Needless));
    }
}
