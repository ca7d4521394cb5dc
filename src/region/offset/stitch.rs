//! Slices, put together to ways.
//!
//! Slices there and back between two places are the middle of a corridor as wide as two distances; each is kept once, as a way
//! of its own. Slices that lead nowhere are what rounding left; where one is more than that, the level is broken. At a place where
//! boundaries touch, a way turns as far to the left as it can: so the parts on both sides stay apart.

use super::split::{Slice, Splits, middle};
use super::{JOIN, Kind, OffsetFault, Scratch, Way};
use crate::curve::Curve;
use crate::place::Place;
use core::f64::consts::{PI, TAU};

/// Turns closer to straight back than this, in rad, are so.
const BACK: f64 = 1e-6;

/// Stitches the slices. `is_alone` says whether a middle of a slice is of one wall only.
pub(super) fn ways(
    scratch: &Scratch,
    is_alone: &mut dyn FnMut(&Curve, Place) -> bool,
) -> Result<Vec<Way>, OffsetFault> {
    let mut web = Web::of(scratch);
    web.take_repeats();
    let ties = web.take_ties();
    web.prune(is_alone)?;
    let mut ways = Vec::new();
    web.runs(&mut ways)?;
    web.loops(&mut ways)?;
    web.join_ties(ties, &mut ways);
    Ok(ways)
}

struct Web<'a> {
    scratch: &'a Scratch,
    split: &'a Splits,
    slices: &'a [Slice],
    /// Slices by the places they leave and reach.
    leaving: Index,
    reaching: Index,
    is_used: Vec<bool>,
    is_gate: Vec<bool>,
}

/// Numbers of slices, by a place.
struct Index {
    begins: Vec<u32>,
    slices: Vec<u32>,
}

impl Index {
    fn of(count: usize, slices: &[Slice], place: fn(&Slice) -> u32) -> Self {
        let mut begins = vec![0_u32; count + 1];
        for slice in slices {
            if let Some(begin) = begins.get_mut(place(slice) as usize + 1) {
                *begin += 1;
            }
        }
        let mut sum = 0;
        for begin in &mut begins {
            sum += *begin;
            *begin = sum;
        }
        let mut free = begins.clone();
        let mut sorted = vec![0; slices.len()];
        for (number, slice) in (0..).zip(slices) {
            if let Some(free) = free.get_mut(place(slice) as usize) {
                if let Some(spot) = sorted.get_mut(*free as usize) {
                    *spot = number;
                }
                *free += 1;
            }
        }
        Self {
            begins,
            slices: sorted,
        }
    }

    fn at(&self, place: u32) -> &[u32] {
        let begin = self.begins.get(place as usize).copied().unwrap_or(0) as usize;
        let end = self.begins.get(place as usize + 1).copied().unwrap_or(0) as usize;
        self.slices.get(begin..end).unwrap_or(&[])
    }
}

impl<'a> Web<'a> {
    fn of(scratch: &'a Scratch) -> Self {
        let (split, slices) = (&scratch.split, scratch.slices.as_slice());
        let count = split.places.len();
        let mut is_gate = vec![false; count];
        for &gate in &split.gates {
            let stand = split.stands.get(gate as usize).copied().unwrap_or(gate);
            if let Some(is_gate) = is_gate.get_mut(stand as usize) {
                *is_gate = true;
            }
        }
        Self {
            scratch,
            split,
            slices,
            leaving: Index::of(count, slices, |slice| slice.from),
            reaching: Index::of(count, slices, |slice| slice.to),
            is_used: vec![false; slices.len()],
            is_gate,
        }
    }

    fn slice(&self, number: u32) -> Option<(&'a Slice, &'a Curve)> {
        let slice = self.slices.get(number as usize)?;
        let raw = self.scratch.raws.get(slice.curve as usize)?;
        Some((slice, &raw.curve))
    }

    fn place(&self, place: u32) -> Place {
        let place = self.split.places.get(place as usize);
        place.copied().unwrap_or(Place::new(f64::NAN, f64::NAN))
    }

    fn middle(&self, number: u32) -> Option<Place> {
        let (slice, curve) = self.slice(number)?;
        Some(middle(curve, self.place(slice.from), self.place(slice.to)))
    }

    fn is_free(&self, number: u32) -> bool {
        self.is_used.get(number as usize) == Some(&false)
    }

    fn take(&mut self, number: u32) {
        if let Some(is_used) = self.is_used.get_mut(number as usize) {
            *is_used = true;
        }
    }

    fn is_gate(&self, place: u32) -> bool {
        self.is_gate.get(place as usize) == Some(&true)
    }

    /// Takes the slices that go there and back out, and returns for each the one that goes back.
    fn take_ties(&mut self) -> Vec<Option<u32>> {
        let mut partners = vec![None; self.slices.len()];
        for number in 0..self.slices.len() as u32 {
            if self.is_free(number)
                && let Some(back) = self.back(number)
            {
                for (one, other) in [(number, back), (back, number)] {
                    self.take(one);
                    if let Some(partner) = partners.get_mut(one as usize) {
                        *partner = Some(other);
                    }
                }
            }
        }
        partners
    }

    /// The slice that goes the same way back.
    fn back(&self, number: u32) -> Option<u32> {
        let (slice, _) = self.slice(number)?;
        self.beside(number, slice.to, slice.from)
    }

    /// Takes slices out that go the same way as an earlier one: of walls that go on in each other nearly smoothly.
    fn take_repeats(&mut self) {
        for number in 0..self.slices.len() as u32 {
            let Some((slice, _)) = self.slice(number).filter(|_| self.is_free(number)) else {
                continue;
            };
            while let Some(other) = self.beside(number, slice.from, slice.to) {
                self.take(other);
            }
        }
    }

    /// Another slice between two places with the same middle as one.
    fn beside(&self, number: u32, from: u32, to: u32) -> Option<u32> {
        let leaving = self.leaving.at(from);
        let mut others = leaving.iter().copied().filter(|&other| {
            let end = self.slice(other).map(|(slice, _)| slice.to);
            other != number && end == Some(to) && self.is_free(other)
        });
        let first = others.next()?;
        let here = self.middle(number)?;
        let is_near = |other: &u32| {
            let middle = self.middle(*other);
            middle.is_some_and(|middle| middle.distance(here) <= 2.0 * JOIN)
        };
        core::iter::once(first).chain(others).find(is_near)
    }

    /// Takes out slices that lead nowhere, and such as come from nowhere.
    fn prune(&mut self, is_alone: &mut dyn FnMut(&Curve, Place) -> bool) -> Result<(), OffsetFault> {
        let mut open: Vec<u32> = (0..self.slices.len() as u32).rev().collect();
        while let Some(number) = open.pop() {
            let Some((slice, curve)) = self.slice(number).filter(|_| self.is_free(number)) else {
                continue;
            };
            let is_left = self.free_at(&self.leaving, slice.to) || self.is_gate(slice.to);
            let is_reached = self.free_at(&self.reaching, slice.from) || self.is_gate(slice.from);
            if is_left && is_reached {
                continue;
            }
            let middle = middle(curve, self.place(slice.from), self.place(slice.to));
            if is_alone(curve, middle) {
                return Err(OffsetFault::Broken(middle));
            }
            self.take(number);
            open.extend(self.leaving.at(slice.to));
            open.extend(self.reaching.at(slice.from));
        }
        Ok(())
    }

    fn free_at(&self, index: &Index, place: u32) -> bool {
        index.at(place).iter().any(|&slice| self.is_free(slice))
    }

    /// Ways that begin at gates.
    fn runs(&mut self, ways: &mut Vec<Way>) -> Result<(), OffsetFault> {
        for first in 0..self.slices.len() as u32 {
            let Some((slice, _)) = self.slice(first).filter(|_| self.is_free(first)) else {
                continue;
            };
            if self.is_gate(slice.from) && !self.free_at(&self.reaching, slice.from) {
                let (numbers, _) = self.follow(first)?;
                ways.extend(self.way(Kind::Run, &numbers));
            }
        }
        Ok(())
    }

    fn loops(&mut self, ways: &mut Vec<Way>) -> Result<(), OffsetFault> {
        for first in 0..self.slices.len() as u32 {
            if self.is_free(first) {
                let (mut numbers, kind) = self.follow(first)?;
                if kind == Kind::Loop {
                    self.begin_at_a_change(&mut numbers);
                }
                ways.extend(self.way(kind, &numbers));
            }
        }
        Ok(())
    }

    /// Follows slices from one on, back to it or to a gate.
    fn follow(&mut self, first: u32) -> Result<(Vec<u32>, Kind), OffsetFault> {
        let mut numbers = vec![first];
        let mut last = first;
        let begin = self.slice(first).map(|(slice, _)| slice.from);
        self.take(first);
        while let Some((slice, curve)) = self.slice(last) {
            let at = self.place(slice.to);
            let arrival = curve.direction(at);
            let leaving = self.leaving.at(slice.to).iter().copied();
            let open = leaving.filter(|&next| self.is_free(next) || next == first);
            let turn = |&next: &u32| {
                let ahead = self.slice(next).map_or(arrival, |(_, curve)| curve.direction(at));
                let turn = libm::atan2(arrival.cross(ahead), arrival.dot(ahead));
                if turn > PI - BACK { turn - TAU } else { turn }
            };
            let next = open.max_by(|a, b| turn(a).total_cmp(&turn(b)).then(b.cmp(a)));
            match next {
                Some(next) if next == first => return Ok((numbers, Kind::Loop)),
                Some(next) => {
                    self.take(next);
                    numbers.push(next);
                    last = next;
                }
                None if self.is_gate(slice.to) => return Ok((numbers, Kind::Run)),
                None if begin == Some(slice.to) => return Ok((numbers, Kind::Loop)),
                None => return Err(OffsetFault::Broken(at)),
            }
        }
        Ok((numbers, Kind::Loop))
    }

    /// Lets a loop begin where a piece does.
    fn begin_at_a_change(&self, numbers: &mut [u32]) {
        let curve = |number: &u32| self.slice(*number).map(|(slice, _)| slice.curve);
        let last = numbers.last().and_then(curve);
        if numbers.first().and_then(curve) == last {
            let change = numbers.iter().position(|number| curve(number) != last);
            numbers.rotate_left(change.unwrap_or(0));
        }
    }

    /// Slices as pieces; those of one curve that follow each other are one.
    fn way(&self, kind: Kind, numbers: &[u32]) -> Option<Way> {
        let mut way = Way {
            kind,
            pieces: Vec::new(),
            origins: Vec::new(),
        };
        let mut rest = numbers.iter().peekable();
        while let Some(&number) = rest.next() {
            let (slice, curve) = self.slice(number)?;
            let mut end = slice.to;
            let raw = self.scratch.raws.get(slice.curve as usize)?;
            while let Some((next, _)) = rest.peek().and_then(|&&next| self.slice(next))
                && next.curve == slice.curve
                && next.from == end
                && next.to != slice.from
            {
                end = next.to;
                rest.next();
            }
            way.pieces
                .push(curve.part(self.place(slice.from), self.place(end)));
            way.origins.push(raw.origin);
        }
        Some(way)
    }

    /// Ties that follow each other are one way.
    fn join_ties(&self, mut partners: Vec<Option<u32>>, ways: &mut Vec<Way>) {
        for first in 0..self.slices.len() as u32 {
            let Some(Some(_)) = partners.get(first as usize) else {
                continue;
            };
            // Onwards, and from its beginning backwards.
            let mut after = Vec::new();
            let mut before = vec![first];
            let mut take = |number: u32| {
                let partner = partners.get_mut(number as usize).and_then(Option::take);
                if let Some(partner) = partner.and_then(|partner| partners.get_mut(partner as usize)) {
                    *partner = None;
                }
                partner.is_some()
            };
            take(first);
            let mut last = first;
            while let Some((slice, _)) = self.slice(last)
                && let Some(&next) = self.leaving.at(slice.to).iter().find(|&&next| take(next))
            {
                after.push(next);
                last = next;
            }
            last = first;
            while let Some((slice, _)) = self.slice(last)
                && let Some(&next) = self.reaching.at(slice.from).iter().find(|&&next| take(next))
            {
                before.push(next);
                last = next;
            }
            before.reverse();
            before.extend(after);
            ways.extend(self.way(Kind::Tie, &before));
        }
    }
}
