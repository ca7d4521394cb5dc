//! Changes of roughing after which it leaves less on the part.

use super::{Operation, Variant};
use crate::{Auto, Sourced};
use vcutc_backend_api::units::Length;
use vcutc_diagnostics::number::show;

/// Shares of a length that are tried.
const SHARES: [f64; 3] = [0.5, 0.25, 0.1];

/// The fields of an operation that decide how much it leaves.
#[derive(Clone, Copy, Debug)]
pub struct Leaves<O, R> {
    /// What must stay along the normal of the part.
    pub allowance: fn(&mut O) -> &mut Sourced<Length>,
    /// The most that may stay, with the allowance.
    pub scallop: fn(&mut O) -> &mut Option<Sourced<Length>>,
    /// What becomes of places where a cut of a whole layer does not fit.
    pub residual: fn(&mut O) -> &mut Sourced<Auto<R>>,
    /// `lift`, its value that ends cuts on the part.
    pub lift: R,
}

impl<O: Operation + Clone, R: Clone + PartialEq> Leaves<O, R> {
    /// The operation with one of the fields changed: cuts lifted, then smaller allowances, no less than `least`, then tighter limits.
    #[must_use]
    pub fn less(self, operation: &O, least: Length) -> Vec<Variant> {
        let lifted = self.lifted(operation);
        let mut now = operation.clone();
        let allowance = *(self.allowance)(&mut now);
        let scallop = *(self.scallop)(&mut now);
        let allowances = smaller(allowance, least).filter_map(|value| {
            let mut other = operation.clone();
            (self.allowance)(&mut other).value = value;
            variant("allowance =", Sourced { value, ..allowance }, other)
        });
        let scallops = scallop.into_iter().flat_map(|limit| {
            let leaves = self.scallop;
            smaller(limit, allowance.value).filter_map(move |value| {
                let mut other = operation.clone();
                *leaves(&mut other) = Some(Sourced { value, ..limit });
                variant("scallop <=", Sourced { value, ..limit }, other)
            })
        });
        lifted.into_iter().chain(allowances).chain(scallops).collect()
    }

    fn lifted(&self, operation: &O) -> Option<Variant> {
        let mut other = operation.clone();
        let residual = (self.residual)(&mut other);
        let lift = Auto::Given(self.lift.clone());
        if residual.value == lift {
            return None;
        }
        residual.value = lift;
        let span = residual.span;
        Some(Variant {
            advice: "`residual = lift`".to_owned(),
            edits: operation.setup().stated("residual", span, "lift"),
            operation: Box::new(other),
        })
    }
}

/// Smaller values of a length that the job states, the nearest first.
fn smaller(now: Sourced<Length>, least: Length) -> impl Iterator<Item = Length> {
    let values = SHARES.map(|share| Length::mm((now.value.to_mm() * share * 1e3).floor() / 1e3));
    values
        .into_iter()
        .filter(move |value| *value >= least && Length::ZERO < *value && *value < now.value)
}

/// None where the job does not state the field.
fn variant<O: Operation>(field: &str, then: Sourced<Length>, operation: O) -> Option<Variant> {
    let word = format!("{} mm", show(then.value.to_mm()));
    Some(Variant {
        advice: format!("`{field} {word}`"),
        edits: vec![(then.span?, word)],
        operation: Box::new(operation),
    })
}
