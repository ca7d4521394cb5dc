//! A pass of a disc over a part that is roughed: what it frees, and what is wrong with it.
//!
//! The rim cuts wherever something stands above it, in as many strips as there are. Each comes free if the rim comes out of the
//! surface at both of its ends, as at a groove of the roughing, an earlier track, or a side of the stock. That over the place where the
//! disc stands on the part has to; what the rim cuts below others farther out, later passes free. A strip that lies over the body runs
//! at it once it is cut, so there it may be no thicker than has room (`docs/process.md`, "Finishing with a disc").

use super::body::{self, Stand};
use super::pass::tolerance;
use super::sweep::{End, Piece};
use super::{CrossSection, TOUCH};
use crate::disc::{Disc, Hold, PassFault, PassOutcome, SkinPass};
use crate::rim::Rim;
use vcutc_backend_api::units::Length;

impl CrossSection {
    /// Passes a disc over what roughing has left: releases what comes free, and says what is wrong but for the part.
    pub fn skim(&mut self, disc: &Disc, pass: &SkinPass) -> PassOutcome {
        let rim = pass.rim(disc);
        let mut outcome = PassOutcome::default();
        let mut pieces = core::mem::take(&mut self.scratch.pieces);
        self.sweep(&rim, rim.cover(), [End::Attached; 2], &mut pieces);
        for piece in pieces.iter().filter(|piece| piece.height > tolerance(&rim)) {
            let [from, to] = piece.span;
            let fault = if piece.is_free() {
                self.skin_size(disc, pass, &rim, piece)
            } else {
                // What the rim cuts below a strip farther out, a later pass frees.
                (from..=to).contains(&pass.contact).then(|| PassFault::Attached {
                    stretch: piece.stretch(),
                    hold: Hold::Buried {
                        missing: self.missing(&rim, piece),
                    },
                })
            };
            outcome.faults.extend(fault);
        }
        self.take_off(&rim, &pieces, &mut outcome);
        pieces.clear();
        self.scratch.pieces = pieces;
        // What came free is gone before the body comes, or runs over it: that is judged by its thickness.
        let stand = Stand {
            centre: pass.centre,
            lead: pass.lead,
            roll: pass.roll,
            drift: pass.drift,
            clearance: pass.clearance,
            cover: None,
        };
        body::contacts(&mut self.surface, disc, &stand, &mut outcome.faults);
        outcome
    }

    /// How far the surface is above the end of the rim where a strip does not come free; the greater of both ends.
    fn missing(&mut self, rim: &Rim, piece: &Piece) -> Length {
        let [left, right] = rim.cover();
        let ends = [(left, piece.ends[0], 0), (right, piece.ends[1], 1)];
        let above = ends.map(|(x, end, side): (f64, End, usize)| match end {
            End::Attached => {
                let x = x.max(0.0).min(self.surface.width());
                let heights = self.surface.heights(x);
                heights.get(side).copied().unwrap_or_default() - rim.height(x)
            }
            End::Open => 0.0,
        });
        Length::mm(above[0].max(above[1]).max(0.0))
    }

    /// Compares a strip with what the disc takes, and with the room over its body.
    fn skin_size(&mut self, disc: &Disc, pass: &SkinPass, rim: &Rim, strip: &Piece) -> Option<PassFault> {
        let stretch = strip.stretch();
        let [from, to] = strip.span;
        let is_thick = |limit: &Length| strip.height > limit.to_mm() + TOUCH;
        if let Some(limit) = disc.depth.filter(is_thick) {
            return Some(PassFault::TooThick { stretch, limit });
        }
        if let Some(limit) = disc.width.filter(|limit| to - from > limit.to_mm() + TOUCH) {
            let width = Length::mm(to - from);
            return Some(PassFault::TooWide {
                stretch,
                width,
                limit,
            });
        }
        for stage in &disc.body {
            let radius = (stage.radius + pass.clearance).to_mm();
            let over = [from.max(pass.centre.x - radius), to.min(pass.centre.x + radius)];
            let limit = stage.from.max(pass.over_hub);
            if over[0] < over[1] && self.thickest(rim, over) > limit.to_mm() + TOUCH {
                return Some(PassFault::OverBody { stretch, limit });
            }
        }
        None
    }

    /// The greatest height of the surface above a rim over a stretch.
    fn thickest(&mut self, rim: &Rim, [from, to]: [f64; 2]) -> f64 {
        let line: Vec<_> = self.surface.stretch(from, to).collect();
        let mut thickest: f64 = 0.0;
        for (a, b) in line.iter().zip(line.iter().skip(1)) {
            let piece = crate::rim::Line::through(*a, *b);
            let x = rim.highest_above(piece, a.x, b.x);
            thickest = thickest.max(rim.below(piece.at(x)));
        }
        thickest
    }
}
