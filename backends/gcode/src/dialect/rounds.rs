//! How the tip is led in a block: on a line, or on an arc.

use super::GcodeDialect;
use crate::arcs::WrittenArc;
use crate::blocks::push_word;
use crate::controller::Arcs;
use crate::job::Job;
use crate::statement::{Once, Plane, Sense};
use vcutc_backend_api::script::Written;

/// Whether a block names the tip.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Tip {
    Named,
    LeftOut,
}

impl GcodeDialect<'_, '_, '_> {
    /// Begins a straight motion: everything before the feed.
    pub(super) fn straight(&mut self, stop: &str, tip: Tip) {
        self.blocks.begin();
        self.blocks.put(stop);
        self.blocks.put(self.job.settings.facts().straight);
        if tip == Tip::Named {
            self.blocks.put_bytes(&self.tip);
        }
        self.blocks.put_bytes(&self.rotary);
    }

    /// Begins a motion on an arc: everything before the feed.
    pub(super) fn round(&mut self, stop: &str, arc: WrittenArc) -> Written {
        match (arc, self.job.settings.facts().arcs) {
            (WrittenArc::About { sense, centre, .. }, Arcs::AboutPole) => {
                self.about_pole(stop, sense, centre)
            }
            (
                WrittenArc::About {
                    plane, sense, offset, ..
                },
                Arcs::InPlanes | Arcs::InAnyPlane,
            ) => self.about_centre(stop, (plane, sense), offset),
            (WrittenArc::Through(point), _) => {
                self.blocks.begin();
                self.blocks.put(stop);
                self.blocks.put("CIP");
                self.blocks.put_bytes(&self.tip);
                self.coordinates(point.to_array(), Words::OfPoint)?;
                self.blocks.put_bytes(&self.rotary);
                Ok(())
            }
        }
    }

    /// The plane is a word of the block itself: a block of words alone would stop a chain.
    fn about_centre(&mut self, stop: &str, (plane, sense): (Plane, Sense), offset: [f64; 3]) -> Written {
        let facts = self.job.settings.facts();
        self.blocks.begin();
        self.blocks.put(stop);
        if self.modes.plane != plane {
            self.modes.plane = plane;
            self.blocks.put(plane.word());
            self.blocks.put(" ");
        }
        if let (Some(word), Once::No) = (facts.centres_from_start, self.modes.centres_from_start) {
            self.modes.centres_from_start = Once::Yes;
            self.blocks.put(word);
            self.blocks.put(" ");
        }
        self.blocks.put(match sense {
            Sense::Clockwise => "G2",
            Sense::Counterclockwise => "G3",
        });
        self.blocks.put_bytes(&self.tip);
        self.coordinates(offset, Words::ToCentre(plane))?;
        self.blocks.put_bytes(&self.rotary);
        Ok(())
    }

    /// `CC X Y`, then `C X Y DR+`, which leaves Z as it is.
    fn about_pole(&mut self, stop: &str, sense: Sense, centre: [f64; 3]) -> Written {
        self.blocks.begin();
        self.blocks.put("CC");
        self.coordinates(centre, Words::OfPole)?;
        self.blocks.end()?;
        self.blocks.begin();
        self.blocks.put(stop);
        self.blocks.put("C");
        let z = self.tip.windows(2).position(|two| two == b" Z");
        let in_plane = self.tip.get(..z.unwrap_or(self.tip.len()));
        self.blocks.put_bytes(in_plane.unwrap_or_default());
        self.blocks.put_bytes(&self.rotary);
        self.blocks.put(match sense {
            Sense::Clockwise => " DR-",
            Sense::Counterclockwise => " DR+",
        });
        Ok(())
    }

    /// Words of a point, or of a way.
    fn coordinates(&mut self, values: [f64; 3], words: Words) -> Written {
        let Job { settings, .. } = self.job;
        let (lengths, signs) = (settings.common.lengths, settings.facts().signs);
        let mut out = Vec::with_capacity(32);
        for (place, value) in values.into_iter().enumerate() {
            match words {
                Words::ToCentre(plane) if place != plane.normal() => {
                    push_word(&mut out, letter(b"IJK", place), value, lengths, signs)?;
                }
                Words::OfPole if place != Plane::Xy.normal() => {
                    push_word(&mut out, letter(b"XYZ", place), value, lengths, signs)?;
                }
                Words::OfPoint => {
                    out.extend_from_slice(&[b' ', letter(b"IJK", place)]);
                    out.extend_from_slice(b"1=");
                    lengths.push(&mut out, value)?;
                }
                Words::ToCentre(_) | Words::OfPole => {}
            }
        }
        self.blocks.put_bytes(&out);
        Ok(())
    }
}

/// What three coordinates are.
#[derive(Clone, Copy)]
enum Words {
    /// I, J and K in this plane.
    ToCentre(Plane),
    /// X and Y.
    OfPole,
    /// I1, J1 and K1.
    OfPoint,
}

fn letter(letters: &[u8; 3], place: usize) -> u8 {
    letters.get(place).copied().unwrap_or_default()
}
