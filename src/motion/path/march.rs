//! Goes along a course span by span, each as long as its proof allows.

use super::course::Span;

/// Spans begin and end at multiples of this part of a course: of a cut of 1 m, 0.06 um.
const TICKS: u32 = 1 << 24;
/// Spans this short are not made shorter for the sake of tighter bounds.
const FINE: u32 = TICKS / 256;
/// Most spans that are tried on one course.
const MOST_TRIES: u32 = 4096;

/// What became of a span.
#[derive(Clone, Copy, Debug)]
pub(super) enum Tried<V> {
    /// It is proven, with bounds this many times better than they have to be.
    Proven(f64),
    /// It could be proven with better bounds if it were shorter; these are this many times as good as they have to be,
    /// which is less than once.
    Loose(f64),
    /// It is not proven, for this reason.
    Refused(V),
}

/// Proves a course from its beginning to its end; returns how many spans were tried.
///
/// `attempt` tries a span that begins where the last proven one ended; the flag says that loose bounds will do.
///
/// # Errors
/// Where the span begins that can be made no shorter, and why it was refused.
pub(super) fn march<V>(mut attempt: impl FnMut(Span, Effort) -> Tried<V>) -> Result<u32, (f64, V)> {
    let mut march = March::new();
    while !march.is_over() {
        let (span, effort) = march.next();
        march.became(attempt(span, effort))?;
    }
    Ok(march.tries)
}

/// How far a course is proven, and with how long a span it continues.
///
/// A span that is refused is halved, so that all before the one that can be made no shorter is proven. The quality of the bounds of a
/// span sets the length of the next one: they are off by a term of the second order in its length.
#[derive(Clone, Copy, Debug)]
pub(super) struct March {
    at: u32,
    length: u32,
    tries: u32,
    /// After a refusal the next span is not tried longer: it would most often be refused again.
    grows: bool,
}

impl March {
    /// At the beginning of a course.
    pub(super) const fn new() -> Self {
        Self {
            at: 0,
            length: TICKS,
            tries: 0,
            grows: true,
        }
    }

    /// Whether the whole course is proven.
    pub(super) const fn is_over(&self) -> bool {
        self.at >= TICKS
    }

    /// How many spans were tried.
    pub(super) const fn tries(&self) -> u32 {
        self.tries
    }

    /// The span to try next, and how good its bounds have to be.
    pub(super) fn next(&mut self) -> (Span, Effort) {
        self.length = self.length.min(TICKS - self.at);
        self.tries += 1;
        let effort = if self.length <= FINE {
            Effort::Bare
        } else {
            Effort::Tight
        };
        (span(self.at, self.length), effort)
    }

    /// Goes on after what became of the span.
    ///
    /// # Errors
    /// As for [`march`].
    pub(super) fn became<V>(&mut self, tried: Tried<V>) -> Result<(), (f64, V)> {
        let length = self.length;
        match tried {
            Tried::Proven(quality) => {
                self.at += length;
                // Bounds that were bare are no reason to go on in ever shorter spans.
                let next = scaled(length, quality).max(length.min(FINE));
                self.length = if self.grows { next } else { length };
                self.grows = true;
            }
            Tried::Refused(why) if length == 1 || self.tries >= MOST_TRIES => {
                return Err((f64::from(self.at) / f64::from(TICKS), why));
            }
            Tried::Loose(quality) => self.length = scaled(length, quality).min(length - 1),
            Tried::Refused(_) => {
                self.length = (length / 2).max(1);
                self.grows = false;
            }
        }
        Ok(())
    }
}

/// The length of a span whose bounds are as good as they have to be, with something in hand.
fn scaled(length: u32, quality: f64) -> u32 {
    const IN_HAND: f64 = 0.9;
    let times = (IN_HAND * quality.sqrt()).clamp(0.25, 4.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "lengths are below 2^25, and the factor is between a quarter and four"
    )]
    let scaled = (f64::from(length) * times) as u32;
    scaled.max(1)
}

/// How good bounds have to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effort {
    /// Near the true ones.
    Tight,
    /// Whatever proves the span.
    Bare,
}

/// The shortest span about a place.
pub(super) fn about(place: f64) -> Span {
    let half = 0.5 / f64::from(TICKS);
    Span {
        middle: place.clamp(half, 1.0 - half),
        half,
    }
}

/// Exact, since ticks are powers of two.
fn span(at: u32, length: u32) -> Span {
    let tick = 1.0 / f64::from(TICKS);
    let half = 0.5 * f64::from(length);
    Span {
        middle: (f64::from(at) + half) * tick,
        half: half * tick,
    }
}
