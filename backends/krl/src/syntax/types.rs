//! What statements of KRL are made of. Everything is borrowed from the text.

/// Whether two names are the same for a controller, which does not mind case.
#[must_use]
pub const fn is_same_name(one: &str, other: &str) -> bool {
    one.eq_ignore_ascii_case(other)
}

/// What a table of words says of a name.
#[inline]
pub(crate) fn meaning<T: Copy>(name: &str, words: &[(&str, T)]) -> Option<T> {
    let found = words.iter().find(|(word, _)| is_same_name(name, word));
    found.map(|(_, meaning)| *meaning)
}

/// A stretch of bytes in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// A statement and its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement<'t> {
    /// Where it stands, without its comment and the blanks around it.
    pub span: Span,
    /// The text there.
    pub text: &'t str,
    /// What it is.
    pub phrase: Phrase<'t>,
}

/// What a statement is.
#[derive(Clone, Debug, PartialEq)]
pub enum Phrase<'t> {
    /// `&ACCESS RVP`: a record of the controller's editor; what stands after the `&`.
    Mark(&'t str),
    /// `DEF name( )`, the head of a routine.
    Def {
        /// Its name.
        name: &'t str,
        /// Who may call it.
        scope: Scope,
    },
    /// `END` of a routine.
    End,
    /// `DEFDAT name`, the head of a data list.
    DefDat {
        /// Its name.
        name: &'t str,
        /// Who may use what is declared in it: with `PUBLIC` everyone, as far as it is declared `GLOBAL`.
        scope: Scope,
    },
    /// `ENDDAT` of a data list.
    EndDat,
    /// `EXT name(...)`: makes a routine of another module known.
    Ext {
        /// Its name.
        name: &'t str,
    },
    /// `DECL E6POS XP1={...}`.
    Declaration(Declaration<'t>),
    /// `$VEL.CP=0.2`, `XP1.Y=5.0`.
    Assignment {
        /// What gets the value.
        to: Variable<'t>,
        /// The value.
        value: Value<'t>,
    },
    /// `PTP`, `LIN` and their like.
    Motion(Motion<'t>),
    /// `CIRC` and its like.
    Arc(Arc<'t>),
    /// `BAS (#command,value)`: the controller's routine that sets up motions.
    Bas {
        /// What it is to do, without the `#`.
        command: &'t str,
        /// With which value.
        value: Option<f64>,
    },
    /// `name(...)`: a routine is called.
    Call {
        /// Its name.
        name: &'t str,
        /// What it is given, blanks apart: empty for `( )`.
        arguments: &'t str,
    },
    /// `WAIT SEC t`, in seconds.
    WaitSec(f64),
    /// `WAIT FOR name[n]`, for nothing but one variable.
    WaitFor(Variable<'t>),
    /// `HALT`.
    Halt,
    /// KRL that is not described here; the word it begins with.
    Other(&'t str),
    /// No KRL.
    Unreadable {
        /// What was expected where reading ended.
        expected: &'static str,
    },
}

/// Who may use something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// The module that it stands in.
    Module,
    /// All modules: `GLOBAL`, or `PUBLIC` of a data list.
    Global,
}

/// A declaration, with a value in data lists.
#[derive(Clone, Debug, PartialEq)]
pub struct Declaration<'t> {
    /// Who may use it.
    pub scope: Scope,
    /// The type.
    pub kind: &'t str,
    /// The variable.
    pub name: Variable<'t>,
    /// Its value.
    pub value: Option<Value<'t>>,
    /// What stands after a comma: further names of the same type, without values.
    pub further: &'t str,
}

impl<'t> Declaration<'t> {
    /// The further names, without those of arrays.
    pub fn further_names(&self) -> impl Iterator<Item = &'t str> {
        let names = self.further.split(',').map(str::trim_ascii);
        names.filter(|name| !name.is_empty() && !name.ends_with(']'))
    }
}

/// A variable, a place of an array, or a field of one: `XP1`, `$OUT[3]`, `$VEL.CP`, `TOOL_DATA[3]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variable<'t> {
    /// Its name.
    pub name: &'t str,
    /// The place in an array, from 1 on.
    pub index: Option<u32>,
    /// The field.
    pub field: Option<&'t str>,
}

impl Variable<'_> {
    /// Whether it is the variable of that name, without place and field.
    #[must_use]
    pub const fn is(&self, name: &str) -> bool {
        self.index.is_none() && self.field.is_none() && is_same_name(self.name, name)
    }

    /// Whether it is this field of the variable of that name.
    #[must_use]
    pub fn is_field(&self, name: &str, field: &str) -> bool {
        self.index.is_none()
            && is_same_name(self.name, name)
            && self.field.is_some_and(|is| is_same_name(is, field))
    }

    /// The place, when it is a place of the array of that name.
    #[must_use]
    pub const fn index_in(&self, name: &str) -> Option<u32> {
        if self.field.is_none() && is_same_name(self.name, name) {
            self.index
        } else {
            None
        }
    }
}

/// A value: literals, and variables that stand for themselves.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<'t> {
    /// A number with its sign; `'B101'` and `'HFF'` as well.
    Number(f64),
    /// `TRUE` or `FALSE`.
    Bool(bool),
    /// `#BASE`, without the `#`.
    Enum(&'t str),
    /// Text in double quotes, as it stands between them.
    Text(&'t str),
    /// A pose, a frame or axis values.
    Coordinates(Coordinates),
    /// Any other structure.
    Structure(Vec<Field<'t>>),
    /// A variable.
    Variable(Variable<'t>),
}

impl Value<'_> {
    /// A number.
    #[must_use]
    pub const fn number(&self) -> Option<f64> {
        match self {
            Self::Number(number) => Some(*number),
            _ => None,
        }
    }
}

/// A field of a structure.
#[derive(Clone, Debug, PartialEq)]
pub struct Field<'t> {
    /// Its name.
    pub name: &'t str,
    /// Its value.
    pub value: Value<'t>,
}

/// A component of `E6POS`, `POS`, `FRAME`, `E6AXIS` and `AXIS`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[rustfmt::skip]
#[expect(missing_docs, reason = "X, Y, Z in mm, A, B, C and axes in degrees, S and T: they are called what they are")]
pub enum Component { X, Y, Z, A, B, C, S, T, A1, A2, A3, A4, A5, A6, E1, E2, E3, E4, E5, E6 }

impl Component {
    /// All of them.
    #[rustfmt::skip]
    pub const ALL: [Self; 20] = [
        Self::X, Self::Y, Self::Z, Self::A, Self::B, Self::C, Self::S, Self::T,
        Self::A1, Self::A2, Self::A3, Self::A4, Self::A5, Self::A6,
        Self::E1, Self::E2, Self::E3, Self::E4, Self::E5, Self::E6,
    ];

    /// The place of the tip, in mm.
    pub const TIP: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The orientation `R = Rz(A) Ry(B) Rx(C)`, in degrees.
    pub const ANGLES: [Self; 3] = [Self::A, Self::B, Self::C];

    /// The axes of the arm, in degrees.
    pub const AXES: [Self; 6] = [Self::A1, Self::A2, Self::A3, Self::A4, Self::A5, Self::A6];

    /// External axes.
    pub const EXTERNAL: [Self; 6] = [Self::E1, Self::E2, Self::E3, Self::E4, Self::E5, Self::E6];

    /// By its name.
    #[must_use]
    #[inline]
    pub const fn named(name: &str) -> Option<Self> {
        match *name.as_bytes() {
            [b'X' | b'x'] => Some(Self::X),
            [b'Y' | b'y'] => Some(Self::Y),
            [b'Z' | b'z'] => Some(Self::Z),
            [b'A' | b'a'] => Some(Self::A),
            [b'B' | b'b'] => Some(Self::B),
            [b'C' | b'c'] => Some(Self::C),
            [b'S' | b's'] => Some(Self::S),
            [b'T' | b't'] => Some(Self::T),
            [b'A' | b'a', b'1'] => Some(Self::A1),
            [b'A' | b'a', b'2'] => Some(Self::A2),
            [b'A' | b'a', b'3'] => Some(Self::A3),
            [b'A' | b'a', b'4'] => Some(Self::A4),
            [b'A' | b'a', b'5'] => Some(Self::A5),
            [b'A' | b'a', b'6'] => Some(Self::A6),
            [b'E' | b'e', b'1'] => Some(Self::E1),
            [b'E' | b'e', b'2'] => Some(Self::E2),
            [b'E' | b'e', b'3'] => Some(Self::E3),
            [b'E' | b'e', b'4'] => Some(Self::E4),
            [b'E' | b'e', b'5'] => Some(Self::E5),
            [b'E' | b'e', b'6'] => Some(Self::E6),
            _ => None,
        }
    }
}

/// Components with their values; what is left out keeps the value it had before.
#[derive(Clone, Copy, Debug, Default)]
pub struct Coordinates {
    values: [f64; Component::ALL.len()],
    /// A bit for each component that is given.
    given: u32,
}

/// The same components with the same values.
impl PartialEq for Coordinates {
    fn eq(&self, other: &Self) -> bool {
        let mut all = Component::ALL.iter();
        all.all(|&component| self.get(component) == other.get(component))
    }
}

impl Coordinates {
    /// The value of a component; none when it is not given.
    #[must_use]
    #[inline]
    pub fn get(&self, component: Component) -> Option<f64> {
        self.has(component)
            .then(|| self.values.get(component as usize).copied())
            .flatten()
    }

    /// Gives a component a value.
    #[inline]
    pub fn set(&mut self, component: Component, value: f64) {
        if let Some(place) = self.values.get_mut(component as usize) {
            *place = value;
            self.given |= 1 << component as u32;
        }
    }

    /// The same without some components.
    #[must_use]
    pub fn without(mut self, components: &[Component]) -> Self {
        for &component in components {
            self.given &= !(1 << component as u32);
        }
        self
    }

    /// Whether a component is given.
    #[must_use]
    #[inline]
    pub const fn has(&self, component: Component) -> bool {
        self.given & (1 << component as u32) != 0
    }

    /// The given among some components.
    #[must_use]
    #[inline]
    pub fn has_any(&self, components: &[Component]) -> bool {
        components.iter().any(|&component| self.has(component))
    }

    /// The values of some components; none when one of them is not given.
    #[must_use]
    #[inline]
    pub fn all<const N: usize>(&self, components: [Component; N]) -> Option<[f64; N]> {
        let mut values = [0.0; N];
        for (value, component) in values.iter_mut().zip(components) {
            *value = self.get(component)?;
        }
        Some(values)
    }
}

/// A motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion<'t> {
    /// What moves on a line.
    pub path: Path,
    /// Which planner of the controller plans it.
    pub planner: Planner,
    /// How its target is given.
    pub points: Points,
    /// Where to.
    pub target: Target<'t>,
    /// What follows it.
    pub tail: Tail<'t>,
}

/// A motion on a circular arc from where the one before it ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Arc<'t> {
    /// Which planner of the controller plans it.
    pub planner: Planner,
    /// How its points are given.
    pub points: Points,
    /// A point on the way.
    pub through: Target<'t>,
    /// Its end; with an angle, a second point of the circle.
    pub target: Target<'t>,
    /// `CA`: how far it goes round, in degrees; none where it ends at its target.
    pub angle: Option<f64>,
    /// What stands after it.
    pub tail: Tail<'t>,
}

/// How the points of a motion are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Points {
    /// `LIN`, `CIRC`: in the base.
    Absolute,
    /// `LIN_REL`, `CIRC_REL`: from where the motion begins.
    Relative,
}

/// What stands after the target of a motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tail<'t> {
    /// Where its end may be rounded.
    pub approximation: Option<Approximation>,
    /// A second such word: after `PTP` the way back to a straight line, `C_PTP C_DIS`.
    pub second: Option<Approximation>,
    /// The directions of a motion that is relative, where they are stated.
    pub directions: Option<Directions>,
    /// `WITH`: values that hold for this motion only.
    pub with: Vec<Setting<'t>>,
}

/// Along which axes a relative motion goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Directions {
    /// `#BASE`: those of the base, which is also what it is without a word.
    Base,
    /// `#TOOL`: those of the tool, as it is held where the motion begins.
    Tool,
}

/// `$VEL.CP=0.2` after `WITH`.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting<'t> {
    /// What gets a value.
    pub to: Variable<'t>,
    /// The value.
    pub value: SettingValue<'t>,
    /// The value as it is written.
    pub text: &'t str,
}

/// A value after `WITH`.
#[derive(Clone, Debug, PartialEq)]
pub enum SettingValue<'t> {
    /// As in an assignment.
    Plain(Value<'t>),
    /// What a function of the controller gives, such as `SVEL_CP(0.2, , LCPDAT1)`.
    Function {
        /// Its name.
        name: &'t str,
        /// What it is given, blanks apart.
        arguments: &'t str,
    },
}

/// What moves on a line in a motion to one point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    /// `LIN`, `SLIN`: the tip.
    Straight,
    /// `PTP`, `SPTP`: every axis.
    Axes,
}

/// The planners of a controller.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planner {
    /// `LIN`, `PTP`.
    Classic,
    /// `SLIN`, `SPTP`.
    Spline,
}

/// Where a motion leads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target<'t> {
    /// A literal.
    Literal(Coordinates),
    /// A variable.
    Variable(Variable<'t>),
}

/// Words after a motion that allow its end to be rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Approximation {
    /// `C_DIS`: from a distance on.
    Distance,
    /// `C_ORI`: from an angle on.
    Orientation,
    /// `C_PTP`: from a part of the axes' ways on.
    Axes,
    /// `C_SPL`: of splines.
    Spline,
    /// `C_VEL`: from a speed on.
    Speed,
}
