//! Things along x, with the place of work between them.
//!
//! As the corners of the surface, they are kept in two stacks, because neighbouring places are visited one after the other:
//! going from one to the next moves the few things in between.

/// What has a place along x.
pub(super) trait Placed: Copy {
    /// In mm.
    fn x(&self) -> f64;
}

/// Things in order of x.
#[derive(Clone, Debug)]
pub(super) struct Sorted<T> {
    /// Left of the place of work, nearest last.
    left: Vec<T>,
    /// The others, nearest last.
    right: Vec<T>,
}

impl<T: Placed> Sorted<T> {
    pub(super) const fn new() -> Self {
        Self {
            left: Vec::new(),
            right: Vec::new(),
        }
    }

    pub(super) const fn is_empty(&self) -> bool {
        self.left.is_empty() && self.right.is_empty()
    }

    /// Moves the place of work so that what is at x lies right of it.
    pub(super) fn go_to(&mut self, x: f64) {
        while let Some(thing) = self.left.pop_if(|thing| thing.x() >= x) {
            self.right.push(thing);
        }
        while let Some(thing) = self.right.pop_if(|thing| thing.x() < x) {
            self.left.push(thing);
        }
    }

    pub(super) fn insert(&mut self, thing: T) {
        self.go_to(thing.x());
        self.right.push(thing);
    }

    /// The next one right of the place of work.
    pub(super) fn next_mut(&mut self) -> Option<&mut T> {
        self.right.last_mut()
    }

    /// All right of the place of work, from left to right.
    pub(super) fn ahead(&self) -> impl Iterator<Item = T> + '_ {
        self.right.iter().rev().copied()
    }

    /// All left of it, from right to left.
    pub(super) fn behind(&self) -> impl Iterator<Item = T> + '_ {
        self.left.iter().rev().copied()
    }

    /// All of them, from left to right.
    pub(super) fn all(&self) -> impl Iterator<Item = T> + '_ {
        self.left.iter().copied().chain(self.ahead())
    }

    /// Takes out what is chosen of those from one x to another.
    pub(super) fn take(&mut self, from: f64, to: f64, mut goes: impl FnMut(&T) -> bool, out: &mut Vec<T>) {
        self.go_to(from);
        while let Some(thing) = self.right.pop_if(|thing| thing.x() <= to) {
            if goes(&thing) {
                out.push(thing);
            } else {
                self.left.push(thing);
            }
        }
    }
}
