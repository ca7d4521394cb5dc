//! Speeds of motions, `$VEL`.

use crate::syntax::{Field, Value, Variable, is_same_name, meaning};

/// A field of `$VEL`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Velocity {
    /// `CP`, the speed of the tip in m/s.
    Path,
    /// `ORI1`, the swivel of the tool's direction in deg/s.
    Swivel,
    /// `ORI2`, the turn about it in deg/s.
    Twist,
}

fn velocity(field: &str) -> Option<Velocity> {
    let fields = [
        ("CP", Velocity::Path),
        ("ORI1", Velocity::Swivel),
        ("ORI2", Velocity::Twist),
    ];
    meaning(field, &fields)
}

/// What an assignment makes of the speeds: `$VEL.CP=0.2`, `$VEL={CP 0.2,ORI1 200.0}`. The field and the value
/// are not known where they are not among these. None for an assignment to something else.
pub fn velocities<'v>(
    to: &Variable<'_>,
    value: &'v Value<'_>,
) -> Option<impl Iterator<Item = (Option<Velocity>, Option<f64>)> + use<'v>> {
    if !is_same_name(to.name, "$VEL") || to.index.is_some() {
        return None;
    }
    let (single, fields): (_, &[Field<'_>]) = match (to.field, value) {
        (Some(field), value) => (Some((velocity(field), value.number())), &[]),
        (None, Value::Structure(fields)) => (None, fields),
        (None, _) => (Some((None, None)), &[]),
    };
    let fields = fields
        .iter()
        .map(|field| (velocity(field.name), field.value.number()));
    Some(single.into_iter().chain(fields))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::{Phrase, statements};

    #[test]
    fn speeds_are_set_one_by_one_and_together() {
        for (text, expected) in [
            ("$VEL.CP=0.2", Some(vec![(Some(Velocity::Path), Some(0.2))])),
            (
                "$vel={cp FAST,ORI1 200}",
                Some(vec![
                    (Some(Velocity::Path), None),
                    (Some(Velocity::Swivel), Some(200.0)),
                ]),
            ),
            ("$VEL=SLOW", Some(vec![(None, None)])),
            ("$ACC.CP=2", None),
        ] {
            let Phrase::Assignment { to, value } = statements(text).next().unwrap().phrase else {
                panic!("an assignment");
            };
            assert_eq!(velocities(&to, &value).map(Iterator::collect), expected, "{text}");
        }
    }
}
