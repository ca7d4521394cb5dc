//! The sum of all sources: Yang et al., eq. 7 to 10.

use crate::complex::Complex;
use crate::source::{Segment, Source, Tuning};
use vcutc_region::place::Place;

/// Sources of a field at most.
const MOST_SOURCES: usize = 20_000;

/// The reasons for which a region has no field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldError {
    /// Step, lift or reference is not a number above 0.
    Tuning,
    /// The axis has more pieces than this.
    TooManySources {
        /// The most.
        most: usize,
    },
}

/// A synthesised sound field over the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    sources: Vec<Source>,
    tuning: Tuning,
}

impl Field {
    /// The field of sources along these pieces of an axis.
    ///
    /// # Errors
    /// Where the tuning is unsound or the pieces are too many.
    pub fn new(segments: &[Segment], tuning: &Tuning) -> Result<Self, FieldError> {
        let Tuning {
            step,
            lift,
            reference,
        } = *tuning;
        if [step, lift, reference]
            .into_iter()
            .any(|number| !(number > 0.0 && number.is_finite()))
        {
            return Err(FieldError::Tuning);
        }
        if segments.len() > MOST_SOURCES {
            return Err(FieldError::TooManySources { most: MOST_SOURCES });
        }
        let sources = segments.iter().filter_map(|segment| Source::new(segment, tuning));
        Ok(Self {
            sources: sources.collect(),
            tuning: *tuning,
        })
    }

    /// Its sources.
    #[must_use]
    pub fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// What its sources have in common.
    #[must_use]
    pub const fn tuning(&self) -> &Tuning {
        &self.tuning
    }

    /// Its value at a place. At the distance d from the walls its angle is about `k d`.
    #[must_use]
    pub fn value(&self, place: Place) -> Complex {
        let (mut sum, mut last) = (Complex::ZERO, None);
        for source in &self.sources {
            sum += source.field_after(place, &mut last);
        }
        sum
    }

    /// Its value and the derivatives by x and by y.
    #[must_use]
    pub fn with_gradient(&self, place: Place) -> (Complex, [Complex; 2]) {
        let mut sum = Complex::ZERO;
        let (mut gradient, mut last) = ([Complex::ZERO; 2], None);
        for source in &self.sources {
            let (value, slopes) = source.with_gradient_after(place, &mut last);
            sum += value;
            for (sum, slope) in gradient.iter_mut().zip(slopes) {
                *sum += slope;
            }
        }
        (sum, gradient)
    }

    /// Its value by Gauss quadrature over every source: slow, for comparison.
    #[must_use]
    pub fn integral(&self, place: Place) -> Complex {
        let mut sum = Complex::ZERO;
        for source in &self.sources {
            sum += source.integral(place);
        }
        sum
    }

    /// What turns the field so that its real part, about `-sin(k (d - radius))`, is zero at the distances
    /// `radius + n step` from the walls.
    #[must_use]
    pub fn turned_to(&self, radius: f64) -> Complex {
        Complex::I * Complex::turn(-self.tuning.wave_number() * radius)
    }
}
