//! The functions of expressions.

use super::dimension::Dimension;
use super::mismatch::{Mismatch, same_dimension};
use super::names::did_you_mean;
use super::quantity::{Quantity, number};
use super::report::{Checked, Reports};
use super::scope::{Operand, Scope};
use vcutc_backend_api::words::counted;
use vcutc_diagnostics::source::{Span, Spanned};
use vcutc_diagnostics::suggest::nearest;
use vcutc_diagnostics::{Code, Diagnostic};
use vcutc_geometry::number::{Interval, OnPlane, Scalar};
use vcutc_syntax::ast::Argument;

struct Function {
    name: &'static str,
    form: Form,
    /// A call of it.
    example: &'static str,
    /// What it takes and gives.
    signature: Signature,
    over: Over,
}

/// A height over a box of the plan, or any other value of a formula over x and y.
pub(super) type Height = OnPlane<Interval>;

/// What a function makes of values over a box; none where it has no value.
#[derive(Clone, Copy)]
pub(super) enum Over {
    One(fn(Height) -> Option<Height>),
    /// Of more than two values it is taken of the first two, then of that and the next.
    Two(fn(Height, Height) -> Option<Height>),
    Three(fn(Height, Height, Height) -> Option<Height>),
}

/// A value between bounds that do not cross.
fn clamped(value: Height, low: Height, high: Height) -> Option<Height> {
    (low.value.high <= high.value.low).then(|| value.greater(low).lesser(high))
}

/// What a function takes and gives, for completion and signature help. The functions find out by themselves;
/// a test compares the two.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signature {
    /// An angle, and gives a pure number.
    OfAngle,
    /// A pure number, and gives an angle.
    ToAngle,
    /// Values of one dimension, and gives an angle.
    Bearing,
    /// The square of what it gives.
    Root,
    /// Values of the dimension that it gives.
    Alike,
}

/// How many values a function takes, and what it makes of them.
enum Form {
    One(fn(&Apply<'_>, Operand<'_>) -> Applied),
    Two(fn(&Apply<'_>, Operand<'_>, Operand<'_>) -> Applied),
    Three(fn(&Apply<'_>, Operand<'_>, Operand<'_>, Operand<'_>) -> Applied),
    /// Two or more.
    Several(fn(&Apply<'_>, Operand<'_>, &[Operand<'_>]) -> Applied),
}

const fn function(
    name: &'static str,
    form: Form,
    example: &'static str,
    signature: Signature,
    over: Over,
) -> Function {
    Function {
        name,
        form,
        example,
        signature,
        over,
    }
}

const FUNCTIONS: &[Function] = &[
    function(
        "sin",
        Form::One(|f, a| f.of_angle(a, libm::sin)),
        "sin(30 deg)",
        Signature::OfAngle,
        Over::One(Height::sine),
    ),
    function(
        "cos",
        Form::One(|f, a| f.of_angle(a, libm::cos)),
        "cos(30 deg)",
        Signature::OfAngle,
        Over::One(Height::cosine),
    ),
    function(
        "tan",
        Form::One(|f, a| f.of_angle(a, libm::tan)),
        "tan(30 deg)",
        Signature::OfAngle,
        Over::One(Height::tangent),
    ),
    function(
        "asin",
        Form::One(|f, a| f.to_angle(a, 1.0, libm::asin)),
        "asin(0.5)",
        Signature::ToAngle,
        Over::One(Height::arc_sine),
    ),
    function(
        "acos",
        Form::One(|f, a| f.to_angle(a, 1.0, libm::acos)),
        "acos(0.5)",
        Signature::ToAngle,
        Over::One(Height::arc_cosine),
    ),
    function(
        "atan",
        Form::One(|f, a| f.to_angle(a, f64::INFINITY, libm::atan)),
        "atan(0.5)",
        Signature::ToAngle,
        Over::One(Height::arc),
    ),
    function(
        "atan2",
        Form::Two(|f, a, b| f.atan2(a, b)),
        "atan2(3 mm, 4 mm)",
        Signature::Bearing,
        Over::Two(Height::bearing),
    ),
    function(
        "sqrt",
        Form::One(|_, a| root(a)),
        "sqrt(2)",
        Signature::Root,
        Over::One(Height::square_root),
    ),
    function(
        "abs",
        Form::One(|_, a| Ok(absolute(a.quantity))),
        "abs(-3 mm)",
        Signature::Alike,
        Over::One(Height::magnitude),
    ),
    function(
        "min",
        Form::Several(|f, a, rest| f.fold(a, rest, f64::min)),
        "min(3 mm, 4 mm)",
        Signature::Alike,
        Over::Two(|a, b| Some(a.lesser(b))),
    ),
    function(
        "max",
        Form::Several(|f, a, rest| f.fold(a, rest, f64::max)),
        "max(3 mm, 4 mm)",
        Signature::Alike,
        Over::Two(|a, b| Some(a.greater(b))),
    ),
    function(
        "clamp",
        Form::Three(|f, a, b, c| f.clamp(a, b, c)),
        "clamp(5 mm, 0 mm, 10 mm)",
        Signature::Alike,
        Over::Three(clamped),
    ),
];

/// The names of all functions, each with a call of it.
pub(super) fn examples() -> impl Iterator<Item = (&'static str, &'static str)> {
    FUNCTIONS.iter().map(|function| (function.name, function.example))
}

/// What a function does over boxes.
pub(super) fn over(name: &str) -> Option<Over> {
    let known = FUNCTIONS.iter().find(|function| function.name == name)?;
    Some(known.over)
}

/// What a function takes and gives.
pub(super) fn signature(name: &str) -> Option<Signature> {
    let known = FUNCTIONS.iter().find(|function| function.name == name)?;
    Some(known.signature)
}

/// Calls that are values only of certain fields, and where they belong.
const ELSEWHERE: &[(&str, &str)] = &[
    (
        "frame",
        "after `tool` and `base` of a machine, or `place` of a mesh",
    ),
    ("number", "after `tool`, `base` and `load` of a machine"),
    ("load", "after `load` of a machine"),
    ("joints", "after `home` of a machine"),
    ("output", "after `ultrasonic` and `spindle` of a machine"),
    ("input", "after `ready` of a machine"),
    ("after", "after `ready` of a machine"),
];

/// The value of a call.
pub(super) fn call(
    scope: &Scope<'_>,
    whole: Span,
    function: &Spanned<String>,
    arguments: &[Argument],
    depth: usize,
    reports: &mut Reports,
) -> Checked<Quantity> {
    let Some(known) = FUNCTIONS.iter().find(|known| known.name == function.node) else {
        return Err(reports.push(unknown(function)));
    };
    // All arguments first, so that every one of them is checked.
    let values: Vec<Checked<Operand<'_>>> = arguments
        .iter()
        .map(|argument| {
            let quantity = scope.at_depth(&argument.value, depth + 1, reports)?;
            match &argument.name {
                Some(label) => Err(reports.push(named(known, label))),
                None => Ok(Operand {
                    expr: &argument.value,
                    quantity,
                }),
            }
        })
        .collect();
    let values: Vec<Operand<'_>> = values.into_iter().collect::<Checked<_>>()?;
    let apply = Apply {
        name: known.name,
        scope,
    };
    let result = match (&known.form, values.as_slice()) {
        (Form::One(f), &[a]) => f(&apply, a),
        (Form::Two(f), &[a, b]) => f(&apply, a, b),
        (Form::Three(f), &[a, b, c]) => f(&apply, a, b, c),
        (Form::Several(f), [a, rest @ ..]) if !rest.is_empty() => f(&apply, *a, rest),
        (Form::One(_) | Form::Two(_) | Form::Three(_) | Form::Several(_), values) => {
            Err(Box::new(wrong_count(whole, known, values.len())))
        }
    };
    result.map_err(|fault| reports.push(*fault))
}

/// A function at work.
struct Apply<'a> {
    name: &'static str,
    scope: &'a Scope<'a>,
}

type Applied = Result<Quantity, Box<Diagnostic>>;

impl Apply<'_> {
    fn wanted(&self, operand: Operand<'_>, wanted: Dimension) -> Result<f64, Box<Diagnostic>> {
        if operand.quantity.dimension == wanted {
            return Ok(operand.quantity.value);
        }
        let mismatch = Mismatch {
            taker: &format!("`{}`", self.name),
            wanted,
            expr: operand.expr,
            found: operand.quantity,
            typical: None,
        };
        Err(Box::new(mismatch.diagnostic(self.scope)))
    }

    fn of_angle(&self, operand: Operand<'_>, f: fn(f64) -> f64) -> Applied {
        Ok(Quantity::pure(f(self.wanted(operand, Dimension::ANGLE)?)))
    }

    fn to_angle(&self, operand: Operand<'_>, largest: f64, f: fn(f64) -> f64) -> Applied {
        let value = self.wanted(operand, Dimension::PURE)?;
        if value.abs() <= largest {
            return Ok(Quantity::new(f(value), Dimension::ANGLE));
        }
        let diagnostic = Diagnostic::new(
            Code::NotFinite,
            format!("`{}` has no value at {}", self.name, number(value)),
            operand.expr.span,
            format!("this is {}", number(value)),
        );
        Err(Box::new(
            diagnostic.help(format!("`{}` takes numbers from -1 to 1", self.name)),
        ))
    }

    fn atan2(&self, y: Operand<'_>, x: Operand<'_>) -> Applied {
        same_dimension(self.name, y, x)?;
        let angle = libm::atan2(y.quantity.value, x.quantity.value);
        Ok(Quantity::new(angle, Dimension::ANGLE))
    }

    fn fold(&self, first: Operand<'_>, rest: &[Operand<'_>], choose: fn(f64, f64) -> f64) -> Applied {
        let mut value = first.quantity.value;
        for operand in rest {
            same_dimension(self.name, first, *operand)?;
            value = choose(value, operand.quantity.value);
        }
        Ok(Quantity::new(value, first.quantity.dimension))
    }

    fn clamp(&self, value: Operand<'_>, low: Operand<'_>, high: Operand<'_>) -> Applied {
        let dimension = same_dimension(self.name, value, low)?;
        same_dimension(self.name, value, high)?;
        let (least, most) = (low.quantity.value, high.quantity.value);
        if least > most {
            let diagnostic = Diagnostic::new(
                Code::NotFinite,
                "`clamp` has no value between bounds that cross",
                high.expr.span,
                format!("the upper bound is {}", high.quantity.text()),
            )
            .and(
                low.expr.span,
                format!("the lower bound is {}", low.quantity.text()),
            )
            .help("write the lower bound second and the upper bound third");
            return Err(Box::new(diagnostic));
        }
        Ok(Quantity::new(
            value.quantity.value.max(least).min(most),
            dimension,
        ))
    }
}

const fn absolute(quantity: Quantity) -> Quantity {
    Quantity::new(quantity.value.abs(), quantity.dimension)
}

fn root(operand: Operand<'_>) -> Applied {
    let quantity = operand.quantity;
    let Some(dimension) = quantity.dimension.root() else {
        let words = quantity.dimension.words();
        let diagnostic = Diagnostic::new(
            Code::WrongDimension,
            format!("the square root of {words} has no dimension"),
            operand.expr.span,
            format!("this is {words}"),
        );
        return Err(Box::new(
            diagnostic.help("`sqrt` takes a pure number, an area, or another square"),
        ));
    };
    if quantity.value < 0.0 {
        let diagnostic = Diagnostic::new(
            Code::NotFinite,
            "a negative value has no square root",
            operand.expr.span,
            format!("this is {}", quantity.text()),
        );
        return Err(Box::new(
            diagnostic.help("check the values that it is made of: it must be zero or more"),
        ));
    }
    Ok(Quantity::new(libm::sqrt(quantity.value), dimension))
}

fn unknown(function: &Spanned<String>) -> Diagnostic {
    if let Some((name, place)) = ELSEWHERE.iter().find(|(name, _)| *name == function.node) {
        return Diagnostic::new(
            Code::WrongKind,
            format!("`{name}(...)` is not a value to calculate with"),
            function.span,
            format!("belongs {place}"),
        )
        .help("give a value with its unit, such as `4 mm`");
    }
    let diagnostic = Diagnostic::new(
        Code::BadCall,
        format!("there is no function `{}`", function.node),
        function.span,
        "not a function of the language",
    );
    let near = nearest(&function.node, FUNCTIONS.iter().map(|known| known.name));
    let names: Vec<&str> = FUNCTIONS.iter().map(|known| known.name).collect();
    did_you_mean(diagnostic, function.span, &near).note(format!("the functions are {}", names.join(", ")))
}

fn wrong_count(whole: Span, known: &Function, given: usize) -> Diagnostic {
    let takes = match known.form {
        Form::One(_) => "1 value",
        Form::Two(_) => "2 values",
        Form::Three(_) => "3 values",
        Form::Several(_) => "2 values or more",
    };
    let given = counted(given, "value");
    Diagnostic::new(
        Code::BadCall,
        format!("`{}` takes {takes}, but is given {given}", known.name),
        whole,
        format!("{given} here"),
    )
    .help(format!("write it as `{}`", known.example))
}

fn named(known: &Function, label: &Spanned<String>) -> Diagnostic {
    Diagnostic::new(
        Code::BadCall,
        format!("the values of `{}` have no names", known.name),
        label.span,
        format!("`{}` is not expected here", label.node),
    )
    .help(format!("write it as `{}`", known.example))
}
