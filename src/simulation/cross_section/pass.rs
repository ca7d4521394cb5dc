//! A pass of a disc: what it frees, and what is wrong with it.

use super::body::{self, Stand};
use super::crack::Crack;
use super::sweep::{End, Piece, Sweep};
use super::undercut::Undercut;
use super::{Chip, CrossSection, Guard, TOUCH, Taken};
use crate::disc::{Disc, DiscPass, Freed, PassFault, PassOutcome};
use crate::rim::{Drift, Rim};
use crate::surface::Side;
use vcutc_backend_api::units::{Angle, Area, Length};
use vcutc_geometry::curve::Point2;

/// Floors of a disc with a lead are chords no more than this above its rim, in mm.
const BEND: f64 = 1e-3;

impl CrossSection {
    /// Passes a disc through the section: releases what comes free, and says what is wrong.
    pub fn pass(&mut self, disc: &Disc, pass: &DiscPass, guard: &Guard<'_>) -> PassOutcome {
        let entry = guard.deepest(&pass.rim(disc));
        let mut outcome = self.pass_unguarded(disc, pass);
        if let Some((at, depth)) = entry {
            let depth = Length::mm(depth);
            outcome.faults.insert(0, PassFault::EntersPart { at, depth });
        }
        outcome
    }

    /// The same without a part to stay out of.
    pub fn pass_unguarded(&mut self, disc: &Disc, pass: &DiscPass) -> PassOutcome {
        let rim = pass.rim(disc);
        let mut outcome = PassOutcome::default();
        let stand = Stand {
            centre: pass.centre,
            lead: pass.lead,
            roll: Angle::ZERO,
            drift: Drift::NONE,
            clearance: pass.clearance,
            cover: Some(rim.cover()),
        };
        body::contacts(&mut self.surface, disc, &stand, &mut outcome.faults);
        let mut pieces = core::mem::take(&mut self.scratch.pieces);
        let [from, to] = rim.cover();
        self.sweep(&rim, [from, to], [End::Attached; 2], &mut pieces);
        self.judge(disc, pass, &pieces, &mut outcome);
        self.take_off(&rim, &pieces, &mut outcome);
        pieces.clear();
        self.scratch.pieces = pieces;
        outcome
    }

    /// Takes off what comes free, and remembers what is cut below the rest.
    pub(super) fn take_off(&mut self, rim: &Rim, pieces: &[Piece], outcome: &mut PassOutcome) {
        for piece in pieces.iter().filter(|piece| piece.is_free()) {
            let area = self.free(rim, piece);
            let stretch = piece.stretch();
            outcome.freed.push(Freed { stretch, area });
        }
        for piece in pieces.iter().filter(|piece| !piece.is_free()) {
            self.join(Undercut::of(*rim, piece));
        }
        for piece in pieces.iter().filter(|piece| piece.is_free()) {
            let [from, to] = piece.span;
            self.free_undercuts(from, to);
        }
    }

    /// Cuts along a rim, and finds what stands above it.
    pub(super) fn sweep(&mut self, rim: &Rim, [from, to]: [f64; 2], ends: [End; 2], out: &mut Vec<Piece>) {
        let (left, right) = (from.max(0.0), to.min(self.surface.width()));
        if left >= right {
            return;
        }
        let mut line = core::mem::take(&mut self.scratch.line);
        line.extend(self.surface.stretch(left, right));
        self.cracks.go_to(left - TOUCH);
        let cracks = self.cracks.ahead().take_while(|crack| crack.x <= right + TOUCH);
        let tolerance = tolerance(rim);
        let is_at_side = [from <= TOUCH, to >= self.surface.width() - TOUCH];
        let ends = [0, 1].map(|end: usize| match (is_at_side.get(end), ends.get(end)) {
            (Some(false), Some(&end)) => end,
            _ => End::Open,
        });
        let sweep = Sweep {
            rim,
            line: &line,
            tolerance,
            ends,
        };
        sweep.pieces(cracks, out);
        line.clear();
        self.scratch.line = line;
        if let Some(piece) = out.first_mut()
            && piece.ends[0] == End::Attached
            && self.surface.heights(left)[0] <= rim.height(left) + tolerance
        {
            piece.ends[0] = End::Open;
        }
        if let Some(piece) = out.last_mut()
            && piece.ends[1] == End::Attached
            && self.surface.heights(right)[1] <= rim.height(right) + tolerance
        {
            piece.ends[1] = End::Open;
        }
    }

    /// Takes a column off down to a rim, and returns its area.
    fn free(&mut self, rim: &Rim, piece: &Piece) -> Area {
        let [from, to] = piece.span;
        let mut floor = core::mem::take(&mut self.scratch.floor);
        rim.chords(from, to, BEND, &mut floor);
        let above = area(self.surface.stretch(from, to));
        let area = above - area(floor.iter().copied());
        self.note(|surface| {
            Some(Taken::Chip(Chip {
                top: surface.stretch(from, to).collect(),
                floor: floor.clone(),
            }))
        });
        self.surface.lower(&floor);
        floor.clear();
        self.scratch.floor = floor;
        let mut gone = core::mem::take(&mut self.scratch.cracks);
        let ends = |crack: &Crack| crack.bottom >= rim.height(crack.x) - TOUCH;
        self.cracks.take(from - TOUCH, to + TOUCH, ends, &mut gone);
        gone.clear();
        self.scratch.cracks = gone;
        Area::mm2(area)
    }

    fn remember(&mut self, undercut: Undercut) {
        self.widest = self.widest.max(undercut.width());
        self.undercuts.insert(undercut);
    }

    /// Remembers what a rim has cut below material that stands. Together with what others have cut in the same level plane it may
    /// free that.
    fn join(&mut self, mut undercut: Undercut) {
        if !undercut.rim.is_level() || self.undercuts.is_empty() {
            self.remember(undercut);
            return;
        }
        let mut joined = Vec::new();
        let mut is_alone = true;
        loop {
            let [from, to] = undercut.span;
            let first = from - self.widest - TOUCH;
            let meets = |other: &Undercut| other.meets(&undercut);
            self.undercuts.take(first, to + TOUCH, meets, &mut joined);
            if joined.is_empty() {
                break;
            }
            for other in joined.drain(..) {
                undercut = undercut.joined(&other);
            }
            is_alone = false;
        }
        if is_alone {
            self.remember(undercut);
            return;
        }
        for [from, to] in self.settle(&undercut) {
            self.free_undercuts(from, to);
        }
    }

    /// Looks again at what rims have cut below a stretch that has changed, and frees what is free now.
    pub(super) fn free_undercuts(&mut self, from: f64, to: f64) {
        if self.undercuts.is_empty() {
            return;
        }
        let mut changed = vec![[from, to]];
        let mut under = Vec::new();
        while let Some([from, to]) = changed.pop() {
            let is_changed = |undercut: &Undercut| undercut.is_changed_by(from, to);
            let first = from - self.widest - TOUCH;
            self.undercuts.take(first, to + TOUCH, is_changed, &mut under);
            for undercut in under.drain(..) {
                changed.extend(self.settle(&undercut));
            }
        }
    }

    /// Frees what is free above an undercut and remembers the rest. Returns the stretches that were freed.
    fn settle(&mut self, undercut: &Undercut) -> Vec<[f64; 2]> {
        let (rim, mut pieces, mut freed) = (undercut.rim, Vec::new(), Vec::new());
        self.sweep(&rim, undercut.span, undercut.ends, &mut pieces);
        for piece in pieces {
            if piece.is_free() {
                self.free(&rim, &piece);
                freed.push(piece.span);
            } else {
                self.remember(Undercut::of(rim, &piece));
            }
        }
        freed
    }

    /// Says which piece is the strip, or its first part, and what is wrong with it and with the others.
    fn judge(&mut self, disc: &Disc, pass: &DiscPass, pieces: &[Piece], outcome: &mut PassOutcome) {
        let rim = pass.rim(disc);
        let shave = pass.shave.unwrap_or_else(|| rim.depth()).to_mm() + tolerance(&rim);
        let (outer, inner) = (pass.side, pass.side.opposite());
        // From the rim on the side of the strip inwards.
        let mut inwards: Vec<&Piece> = pieces.iter().collect();
        if pass.side == Side::Right {
            inwards.reverse();
        }
        // What ends near the rim is beside the strip.
        let rest = inwards.split_off(
            inwards
                .iter()
                .take_while(|piece| is_beside(&rim, pass, piece))
                .count(),
        );
        let held = |piece: &&&Piece| piece.end(outer) == End::Attached;
        outcome.undercut = inwards.first().filter(held).map(|piece| piece.stretch());
        let is_strip = |piece: &&&Piece| held(piece) || piece.height > shave;
        let strip = rest.iter().find(is_strip).copied();
        if let Some(strip) = strip {
            if strip.is_free() {
                let faults = self.judge_size(disc, pass, strip, shave);
                outcome.faults.extend(faults);
            } else {
                let hold = self.hold(&rim, pass.side, strip, strip.end(inner));
                let stretch = strip.stretch();
                outcome.faults.push(PassFault::Attached { stretch, hold });
            }
        }
        let others = rest
            .iter()
            .filter(|piece| piece.height > shave)
            .filter(|piece| strip.is_none_or(|strip| !core::ptr::eq(**piece, strip)));
        // Grooves of operations before may have divided the strip: what lies within the width that the disc takes is of it.
        let mut is_of_strip = |piece: &Piece| {
            let far = self.thicker(&rim, piece.span, shave).unwrap_or(piece.span);
            let span = strip.zip(disc.width).map(|(strip, width)| match outer {
                Side::Left => (far[1] - strip.span[0], width),
                Side::Right => (strip.span[1] - far[0], width),
            });
            piece.is_free() && span.is_some_and(|(span, width)| span <= width.to_mm() + TOUCH)
        };
        let (parts, met): (Vec<&Piece>, Vec<&Piece>) = others.partition(|piece| is_of_strip(piece));
        for part in parts {
            let faults = self.judge_size(disc, pass, part, shave);
            outcome.faults.extend(faults);
        }
        outcome
            .faults
            .extend(met.into_iter().map(|piece| PassFault::Meets(piece.stretch())));
    }
}

/// Whether all of a piece lies no farther within the rim than that goes beyond the strip.
fn is_beside(rim: &Rim, pass: &DiscPass, piece: &Piece) -> bool {
    let ([left, right], [from, to]) = (rim.cover(), piece.span);
    let within = match pass.side {
        Side::Left => to - left,
        Side::Right => right - from,
    };
    within <= pass.beyond.to_mm() + TOUCH
}

/// How far above a rim counts as on it.
pub(super) fn tolerance(rim: &Rim) -> f64 {
    if rim.is_level() { TOUCH } else { BEND }
}

/// The area below a polyline, in mm2.
fn area(line: impl Iterator<Item = Point2>) -> f64 {
    let mut before: Option<Point2> = None;
    let mut sum = 0.0;
    for corner in line {
        if let Some(from) = before {
            sum += (corner.x - from.x) * (corner.z + from.z) / 2.0;
        }
        before = Some(corner);
    }
    sum
}
