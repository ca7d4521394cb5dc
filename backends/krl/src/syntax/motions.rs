//! Statements that move: the word, the target, and what stands after it.

use super::cursor::{Cursor, Number};
use super::types::{
    Approximation, Arc, Directions, Motion, Path, Phrase, Planner, Points, Setting, SettingValue, Tail,
    Target, is_same_name, meaning,
};
use super::values::{DEEPEST, ParseError, Parsed, at_end, coordinates, expected, name, value, variable};

/// A motion that begins with this word; none where the word begins something else.
#[inline]
pub(super) fn phrase<'t>(word: &str, cursor: &mut Cursor<'t>) -> Option<Parsed<Phrase<'t>>> {
    if let Some(kind) = meaning(word, &MOTIONS) {
        return Some(motion(kind, cursor));
    }
    let kind = meaning(word, &ARCS)?;
    // Other ways to write an arc are not described.
    Some(arc(kind, cursor).map_err(|_| ParseError::Other))
}

/// Words of motions to one point.
const MOTIONS: [(&str, (Path, Planner, Points)); 8] = [
    ("LIN", (Path::Straight, Planner::Classic, Points::Absolute)),
    ("SLIN", (Path::Straight, Planner::Spline, Points::Absolute)),
    ("PTP", (Path::Axes, Planner::Classic, Points::Absolute)),
    ("SPTP", (Path::Axes, Planner::Spline, Points::Absolute)),
    ("LIN_REL", (Path::Straight, Planner::Classic, Points::Relative)),
    ("SLIN_REL", (Path::Straight, Planner::Spline, Points::Relative)),
    ("PTP_REL", (Path::Axes, Planner::Classic, Points::Relative)),
    ("SPTP_REL", (Path::Axes, Planner::Spline, Points::Relative)),
];

/// Words of arcs.
const ARCS: [(&str, (Planner, Points)); 4] = [
    ("CIRC", (Planner::Classic, Points::Absolute)),
    ("SCIRC", (Planner::Spline, Points::Absolute)),
    ("CIRC_REL", (Planner::Classic, Points::Relative)),
    ("SCIRC_REL", (Planner::Spline, Points::Relative)),
];

#[inline]
fn motion<'t>(
    (path, planner, points): (Path, Planner, Points),
    cursor: &mut Cursor<'t>,
) -> Parsed<Phrase<'t>> {
    Ok(Phrase::Motion(Motion {
        path,
        planner,
        points,
        target: target(cursor)?,
        tail: tail(cursor)?,
    }))
}

/// `CIRC {point on the way}, {end}, CA 180`.
fn arc<'t>((planner, points): (Planner, Points), cursor: &mut Cursor<'t>) -> Parsed<Phrase<'t>> {
    let through = target(cursor)?;
    if !cursor.skip(b',') {
        return expected("`,` and the end of the arc");
    }
    let target = target(cursor)?;
    let angle = if cursor.skip(b',') {
        match cursor.word() {
            Some(word) if is_same_name(word, "CA") => match cursor.number() {
                Number::Is(degrees) => Some(degrees),
                Number::Bad => return expected("a number"),
                Number::None => return Err(ParseError::Other),
            },
            Some(_) | None => return expected("`CA`"),
        }
    } else {
        None
    };
    Ok(Phrase::Arc(Arc {
        planner,
        points,
        through,
        target,
        angle,
        tail: tail(cursor)?,
    }))
}

#[inline]
fn target<'t>(cursor: &mut Cursor<'t>) -> Parsed<Target<'t>> {
    if cursor.peek() == Some(b'{') {
        return match coordinates(cursor)? {
            Some(coordinates) => Ok(Target::Literal(coordinates)),
            None => expected("X, Y, Z, A, B, C, S, T, or axes A1 to A6, E1 to E6"),
        };
    }
    match cursor.word() {
        Some(name) => Ok(Target::Variable(variable(name, cursor)?)),
        None => expected("a target"),
    }
}

/// What stands after a target: `C_DIS`, `C_PTP C_DIS`, `#TOOL`, `WITH ...`, each at most once, in any order.
#[inline]
fn tail<'t>(cursor: &mut Cursor<'t>) -> Parsed<Tail<'t>> {
    let mut tail = Tail::default();
    loop {
        if tail.directions.is_none() && cursor.peek() == Some(b'#') {
            tail.directions = Some(directions(cursor)?);
            continue;
        }
        let before = *cursor;
        let Some(word) = cursor.word() else { break };
        if let Some(approximation) = approximation(word) {
            match (tail.approximation, tail.second) {
                (None, _) => tail.approximation = Some(approximation),
                (Some(_), None) => tail.second = Some(approximation),
                (Some(_), Some(_)) => return expected("the end of the line"),
            }
        } else if tail.with.is_empty() && is_same_name(word, "WITH") {
            tail.with = settings(cursor)?;
        } else {
            *cursor = before;
            return match at_end(cursor) {
                Err(ParseError::Other) => Err(ParseError::Other),
                Err(ParseError::Expected(_)) | Ok(()) => {
                    expected("`C_DIS` or its like, or the end of the line")
                }
            };
        }
    }
    // `LIN P1:P2`.
    at_end(cursor)?;
    Ok(tail)
}

fn directions(cursor: &mut Cursor<'_>) -> Parsed<Directions> {
    cursor.skip(b'#');
    match cursor.word() {
        Some(word) if is_same_name(word, "BASE") => Ok(Directions::Base),
        Some(word) if is_same_name(word, "TOOL") => Ok(Directions::Tool),
        Some(_) | None => expected("`#BASE` or `#TOOL`"),
    }
}

#[inline]
fn approximation(word: &str) -> Option<Approximation> {
    let words = [
        ("C_DIS", Approximation::Distance),
        ("C_ORI", Approximation::Orientation),
        ("C_PTP", Approximation::Axes),
        ("C_SPL", Approximation::Spline),
        ("C_VEL", Approximation::Speed),
    ];
    meaning(word, &words)
}

/// `$VEL=SVEL_CP(0.2, , LCPDAT1), $BASE=BASE_DATA[1]`.
fn settings<'t>(cursor: &mut Cursor<'t>) -> Parsed<Vec<Setting<'t>>> {
    let mut settings = Vec::new();
    loop {
        let word = name(cursor)?;
        let to = variable(word, cursor)?;
        if !cursor.skip(b'=') {
            return expected("`=`");
        }
        let before = *cursor;
        let function = cursor
            .word()
            .and_then(|name| cursor.bracketed().map(|arguments| (name, arguments)));
        let value = match function {
            Some((name, arguments)) => SettingValue::Function { name, arguments },
            None => {
                *cursor = before;
                SettingValue::Plain(value(cursor, DEEPEST)?)
            }
        };
        settings.push(Setting {
            to,
            value,
            text: before.until(*cursor),
        });
        if !cursor.skip(b',') {
            return Ok(settings);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::syntax::{Component, Value, statements};

    fn phrase(line: &str) -> Phrase<'_> {
        statements(line).next().unwrap().phrase
    }

    fn tail(line: &str) -> Tail<'_> {
        match phrase(line) {
            Phrase::Motion(motion) => motion.tail,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn relative_motions_say_their_directions_before_or_after_the_rounding() {
        for line in ["LIN_REL {Z 10} #TOOL C_DIS", "lin_rel {Z 10} c_dis #tool"] {
            let tail = tail(line);
            assert_eq!(tail.directions, Some(Directions::Tool), "{line}");
            assert_eq!(tail.approximation, Some(Approximation::Distance), "{line}");
        }
        assert_eq!(tail("LIN_REL {Z 10}").directions, None);
    }

    #[test]
    fn words_of_rounding_may_be_two() {
        let tail = tail("PTP XP1 C_PTP C_DIS");
        assert_eq!(
            (tail.approximation, tail.second),
            (Some(Approximation::Axes), Some(Approximation::Distance))
        );
        assert!(matches!(
            phrase("LIN XP1 C_DIS C_DIS C_DIS"),
            Phrase::Unreadable { .. }
        ));
        assert!(matches!(phrase("LIN XP1 FAST"), Phrase::Unreadable { .. }));
        assert_eq!(phrase("LIN XP1:XP2"), Phrase::Other("LIN"));
    }

    #[test]
    fn inline_forms_of_the_pendant_set_values_for_one_motion() {
        let tail = tail(
            "SLIN XP1 WITH $VEL=SVEL_CP(2.0, , LCPDAT1), $TOOL=STOOL2(FP1), $BASE=SBASE(FP1.BASE_NO), $VEL.ORI1=90 C_Spl",
        );
        assert_eq!(tail.approximation, Some(Approximation::Spline));
        let [speed, tool, base, turning] = tail.with.as_slice() else {
            panic!("{:?}", tail.with);
        };
        assert_eq!(
            speed.value,
            SettingValue::Function {
                name: "SVEL_CP",
                arguments: "2.0, , LCPDAT1"
            }
        );
        assert!(tool.to.is("$TOOL") && base.to.is("$BASE"));
        assert!(turning.to.is_field("$VEL", "ORI1"));
        assert_eq!(turning.value, SettingValue::Plain(Value::Number(90.0)));
    }

    #[test]
    fn arcs_have_a_point_on_the_way_and_an_end() {
        let Phrase::Arc(arc) = phrase("CIRC {X 1,Y 2,Z 3},{X 4.5,Y 2}, CA 180.0 C_DIS") else {
            panic!("an arc");
        };
        let Target::Literal(to) = arc.target else {
            panic!("a literal");
        };
        assert_eq!(to.get(Component::X), Some(4.5));
        assert_eq!((arc.points, arc.angle), (Points::Absolute, Some(180.0)));
        assert_eq!(phrase("CIRC XP1"), Phrase::Other("CIRC"));
    }
}
