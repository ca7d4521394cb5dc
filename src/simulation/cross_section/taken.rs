//! What cuts take out of a section, kept for display: chips as their outlines, and slits.

use super::{Crack, CrossSection};
use crate::surface::{Surface, Vee};
use vcutc_geometry::curve::Point2;

/// Something that a cut does to the section.
#[derive(Clone, Debug, PartialEq)]
pub enum Taken {
    /// It parts the material along a slit, and takes nothing out.
    Slit(Crack),
    /// It takes a chip out.
    Chip(Chip),
}

/// A piece that comes free, between what was the surface and what is the surface then.
#[derive(Clone, Debug, PartialEq)]
pub struct Chip {
    /// The surface before, from left to right.
    pub top: Vec<Point2>,
    /// What the blade leaves instead, from left to right. Where its ends lie below those of `top`, walls stay.
    pub floor: Vec<Point2>,
}

impl Chip {
    /// Of a cut and what [`Surface::chip`] says of it: the surface, and for two flanks the tip behind it.
    pub(super) fn of(vee: Vee, mut outline: Vec<Point2>) -> Self {
        let tip = if vee.is_single() { None } else { outline.pop() };
        let ends = [outline.first().copied(), tip, outline.last().copied()];
        Self {
            floor: ends.into_iter().flatten().collect(),
            top: outline,
        }
    }

    /// Around it: along the surface from left to right, and back along what is cut.
    #[must_use]
    pub fn outline(&self) -> Vec<Point2> {
        let mut outline = self.top.clone();
        let ends = [self.top.first(), self.top.last()];
        let back = self.floor.iter().rev();
        outline.extend(back.filter(|corner| !ends.contains(&Some(corner))));
        outline
    }
}

impl CrossSection {
    /// From now on keeps what cuts take.
    pub(crate) fn keep_taken(&mut self) {
        self.taken.get_or_insert_default();
    }

    /// What cuts have taken since it was last asked for, in their order.
    pub(crate) fn taken(&mut self) -> Vec<Taken> {
        self.taken.as_mut().map(core::mem::take).unwrap_or_default()
    }

    /// Keeps what a cut is about to take, where that is wanted.
    pub(super) fn note(&mut self, what: impl FnOnce(&mut Surface) -> Option<Taken>) {
        if let Some(taken) = &mut self.taken {
            taken.extend(what(&mut self.surface));
        }
    }
}
