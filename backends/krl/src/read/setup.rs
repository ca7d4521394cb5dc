//! What motions depend on apart from their targets: modes, speeds, load, rounding.
//!
//! `BAS (#INITMOV,0 )` resets all of it to what the controller keeps, which no text says. So a motion is only
//! understood when everything it depends on has been said after that; and what is said must be what the job
//! says, because paths, rates and corners were proven for that. Another mode is not understood, even though
//! the controller knows it.

use crate::interpreter::speeds::{Velocity, velocities};
use crate::options::Settings;
use crate::syntax::{Component, Coordinates, Field, Value, Variable, is_same_name};
use vcutc_backend_api::ir::{Cell, Inertia, Load, Registered, ToolId};
use vcutc_backend_api::number::FixedDecimal;
use vcutc_backend_api::readback::{Effect, End, Pace};
use vcutc_backend_api::script::TRIMMED;
use vcutc_backend_api::units::{AngularSpeed, Length, Speed};

/// `$ADVANCE`: how many motions the controller looks ahead.
const ADVANCE: f64 = 3.0;

/// What the program has said so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Setup {
    said: u32,
    /// `$VEL.CP`.
    tip: Option<Speed>,
    /// `$VEL.ORI1`, the swivel of the tool's direction.
    swivel: Option<AngularSpeed>,
    /// `$VEL.ORI2`, the turn about it.
    twist: Option<AngularSpeed>,
    /// `$APO.CDIS`, how far before its end a motion may be left.
    rounding: Option<Length>,
}

/// Something that a motion depends on, once it has been said as it should be.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Said {
    Start,
    IpoMode,
    OriType,
    Advance,
    Load,
    AxisSpeed,
    CircType,
}

impl Said {
    const ALL: [Self; 7] = [
        Self::Start,
        Self::IpoMode,
        Self::OriType,
        Self::Advance,
        Self::Load,
        Self::AxisSpeed,
        Self::CircType,
    ];

    const fn bit(self) -> u32 {
        1 << self as u32
    }

    /// What to expect in front of a motion that needs it.
    const fn missing(self) -> &'static str {
        match self {
            Self::Start => "`BAS (#INITMOV,0 )` at the head of the routine, before the first motion",
            Self::IpoMode => "`$IPO_MODE=#BASE` before the first motion",
            Self::OriType => "`$ORI_TYPE=#VAR` before the first motion",
            Self::Advance => "`$ADVANCE=3` before the first motion",
            Self::Load => "the job's `$LOAD` before the first motion",
            Self::AxisSpeed => "`BAS (#VEL_PTP,n )` before the first axis move, with the job's home speed",
            Self::CircType => "`$CIRC_TYPE=#PATH` before the first arc",
        }
    }
}

/// What to expect in front of a motion that may be left before its end.
const NO_ROUNDING: &str = "`$APO.CDIS` before the first rounded corner, with the job's approximation";

/// What needs the setup.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Need {
    /// A move of all axes.
    Axes,
    /// A straight move.
    Straight,
    /// A move on an arc.
    Arc,
}

/// What the job says.
#[derive(Clone, Copy)]
pub(super) struct Wanted<'a> {
    pub(super) cell: &'a Cell,
    pub(super) settings: &'a Settings<'a>,
    /// The tool at hand; none where a person has changed it, and its frame has not been set since.
    pub(super) tool: Option<ToolId>,
}

impl<'a> Wanted<'a> {
    /// What the flange carries with the tool at hand.
    fn load(&self) -> Option<&'a Registered<Load>> {
        self.cell.tools.get(self.tool?)?.load.as_ref()
    }
}

impl Setup {
    /// After `BAS (#INITMOV,0 )`.
    pub(super) fn started() -> Self {
        Self {
            said: Said::Start.bit(),
            ..Self::default()
        }
    }

    /// What is missing for a motion.
    pub(super) fn missing(&self, need: Need, wanted: Wanted<'_>) -> Option<&'static str> {
        let always = Said::Start.bit() | Said::IpoMode.bit() | Said::OriType.bit() | Said::Advance.bit();
        let load = match wanted.load() {
            Some(_) => Said::Load.bit(),
            None => 0,
        };
        let own = match need {
            Need::Axes => Said::AxisSpeed.bit(),
            Need::Straight => 0,
            Need::Arc => Said::CircType.bit(),
        };
        let missing = (always | load | own) & !self.said;
        if missing == 0 {
            return None;
        }
        let first = Said::ALL.into_iter().find(|said| missing & said.bit() != 0);
        first.map(Said::missing)
    }

    /// How a motion ends that may be left before its end.
    pub(super) fn left(&self, wanted: Wanted<'_>) -> Result<End, &'static str> {
        let distance = self.rounding.ok_or(NO_ROUNDING)?;
        Ok(wanted.settings.common.left(distance))
    }

    /// The speeds of a straight move.
    pub(super) const fn pace(&self) -> Pace {
        Pace::Apart {
            tip: self.tip,
            swivel: self.swivel,
            twist: self.twist,
        }
    }

    fn note(&mut self, said: Said, is_as_it_should: bool) -> Effect {
        if is_as_it_should {
            self.said |= said.bit();
            Effect::Setting
        } else {
            self.said &= !said.bit();
            Effect::Unknown
        }
    }

    /// `BAS (#VEL_PTP,n )`.
    pub(super) fn axis_speed(&mut self, percent: Option<f64>, wanted: Wanted<'_>) -> Effect {
        let should = f64::from(wanted.settings.home_speed);
        self.note(Said::AxisSpeed, percent == Some(should))
    }

    /// An assignment to one of the variables that motions depend on; none when it is to another.
    pub(super) fn assign(
        &mut self,
        to: &Variable<'_>,
        value: &Value<'_>,
        wanted: Wanted<'_>,
    ) -> Option<Effect> {
        let effect = if let Some(velocities) = velocities(to, value) {
            self.speeds(velocities)
        } else if to.is("$IPO_MODE") {
            self.note(Said::IpoMode, is_word(value, "BASE"))
        } else if to.is("$ORI_TYPE") {
            self.note(Said::OriType, is_word(value, "VAR"))
        } else if to.is("$ADVANCE") {
            self.note(Said::Advance, *value == Value::Number(ADVANCE))
        } else if to.is_field("$APO", "CDIS") {
            self.rounds(value)
        } else if to.is("$CIRC_TYPE") {
            self.note(Said::CircType, is_word(value, "PATH"))
        } else if to.is("$LOAD") {
            let is = wanted
                .load()
                .is_some_and(|should| is_load(value, should, wanted.settings));
            self.note(Said::Load, is)
        } else {
            return None;
        };
        Some(effect)
    }

    /// Takes a distance from which on a motion may be left. A distance of zero is a stop [K-SI].
    fn rounds(&mut self, value: &Value<'_>) -> Effect {
        let distance = value.number().filter(|distance| *distance > 0.0);
        self.rounding = distance.map(Length::mm);
        distance.map_or(Effect::Unknown, |_| Effect::Setting)
    }

    /// Takes speeds that a controller takes for some.
    fn speeds(&mut self, velocities: impl Iterator<Item = (Option<Velocity>, Option<f64>)>) -> Effect {
        for (velocity, value) in velocities {
            let value = value.filter(|value| *value > 0.0);
            match velocity {
                Some(Velocity::Path) => self.tip = value.map(Speed::m_per_s),
                Some(Velocity::Swivel) => self.swivel = value.map(AngularSpeed::deg_per_s),
                Some(Velocity::Twist) => self.twist = value.map(AngularSpeed::deg_per_s),
                None => return Effect::Unknown,
            }
            if value.is_none() {
                return Effect::Unknown;
            }
        }
        Effect::Setting
    }
}

fn is_word(value: &Value<'_>, word: &str) -> bool {
    matches!(value, Value::Enum(is) if is_same_name(is, word))
}

/// Whether a value is a number as printed in a format.
fn is_number(value: &Value<'_>, should: f64, format: FixedDecimal) -> bool {
    value.number().is_some_and(|is| format.is_near(is, should))
}

fn is_load(value: &Value<'_>, should: &Registered<Load>, settings: &Settings<'_>) -> bool {
    match (should, value) {
        (Registered::Number(should), Value::Variable(variable)) => {
            variable.index_in("LOAD_DATA") == Some(*should)
        }
        (Registered::Value(should), Value::Structure(fields)) => match fields.as_slice() {
            [mass, centre, inertia] => {
                let of = |field: &Field<'_>, name| is_same_name(field.name, name);
                let centre_of_mass = match &centre.value {
                    Value::Coordinates(is) => is_centre(is, should, settings.common.lengths),
                    _ => false,
                };
                let is_inertia = match &inertia.value {
                    Value::Coordinates(is) => has_inertia(is, should.inertia.unwrap_or(Inertia::POINT)),
                    _ => false,
                };
                of(mass, "M")
                    && of(centre, "CM")
                    && of(inertia, "J")
                    && is_number(&mass.value, should.mass.to_kg(), TRIMMED)
                    && centre_of_mass
                    && is_inertia
            }
            _ => false,
        },
        (Registered::Number(_) | Registered::Value(_), _) => false,
    }
}

fn has_inertia(is: &Coordinates, should: Inertia) -> bool {
    is.all(Component::TIP).is_some_and(|is| {
        let mut pairs = is.into_iter().zip(should.to_array());
        pairs.all(|(is, should)| TRIMMED.is_near(is, should))
    })
}

fn is_centre(is: &Coordinates, should: &Load, lengths: FixedDecimal) -> bool {
    let Load { centre, .. } = should;
    let tip = is.all(Component::TIP);
    let near = tip.is_some_and(|tip| {
        tip.into_iter()
            .zip([centre.x, centre.y, centre.z])
            .all(|(is, should)| lengths.is_near(is, should))
    });
    near && is.all(Component::ANGLES) == Some([0.0; 3])
}
