//! How a program is put in KRL.

use crate::attitude::{Attitudes, push_angles};
use crate::configuration::StatusAndTurn;
use crate::names::{CHANGE, HOME};
use crate::options::Settings;
use crate::syntax::Planner;
use crate::turns::{Rates, Turns, rounded_down};
use core::num::NonZeroU32;
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{FeedId, RateId, Switch};
use vcutc_backend_api::readback::End;
use vcutc_backend_api::script::{
    Dialect, JointMove, JointTarget, Layer, LinearMove, Part, Source, TRIMMED, Text, ToolChange, Written,
    feed, rate,
};
use vcutc_backend_api::segments::{LimitedBy, LinearSegment};
use vcutc_backend_api::state::TipPose;
use vcutc_backend_api::units::{Duration, Length};

/// KRL, as far as a program is written.
pub(crate) struct KrlDialect<'a, 't, 's> {
    /// What it is written from.
    pub(crate) source: Source<'a>,
    /// The options.
    pub(crate) settings: &'a Settings<'a>,
    /// The program's orientations as text.
    pub(crate) attitudes: &'a Attitudes,
    /// Whether it follows arcs.
    pub(crate) arcs: Arcs,
    /// How fast its turns are.
    pub(crate) turns: &'a Turns,
    /// Where lines go.
    pub(crate) text: &'t mut Text<'s>,
    /// What motions depend on, as last said.
    pub(crate) said: Said,
}

/// What motions depend on, as last said.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Said {
    /// The rates of swivel and twist.
    pub(crate) rates: Option<Rates>,
    /// The speed of the tip that ops name, in m/s.
    feed: f64,
    /// `$VEL.CP`.
    tip: f64,
    /// `$APO.CDIS`, in mm.
    pub(crate) rounding: Option<f64>,
}

/// Whether a program follows arcs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arcs {
    None,
    Some,
}

impl Dialect for KrlDialect<'_, '_, '_> {
    fn comment(&mut self, ours: &str, theirs: &str) -> Written {
        self.text.put(b"; ");
        Ok(self.text.comment(ours, theirs)?)
    }

    fn verbatim(&mut self, line: &str) -> Written {
        Ok(self.text.line(line)?)
    }

    /// Rates stand at the head of a part, because what `BAS (#INITMOV,0 )` leaves is the fastest there is.
    fn part_begins(&mut self, part: &Part, first: Option<RateId>) -> Written {
        self.said.rates = None;
        let turning = part.ops.clone().find_map(|index| self.turns.at(index));
        match (turning, first) {
            (Some(_), _) => self.turn_rates(turning),
            (None, Some(id)) => {
                // The part turns nothing, and does not leave the rates open all the same.
                let swivel = rounded_down(rate(self.source.program(), id)?);
                let twist = swivel;
                self.turn_rates(Some(Rates { swivel, twist }))
            }
            (None, None) => Ok(()),
        }
    }

    fn layer_begins(&mut self, layer: Layer, _: Option<NonZeroU32>) -> Written {
        self.text.put(b";FOLD layer ");
        self.text.whole(layer.number.get());
        Ok(self.text.end_line()?)
    }

    fn layer_ends(&mut self, layer: Layer) -> Written {
        self.text.put(b";ENDFOLD (layer ");
        self.text.whole(layer.number.get());
        Ok(self.text.line(")")?)
    }

    fn feed(&mut self, id: FeedId) -> Written {
        let feed = feed(self.source.program(), id)?.to_m_per_s();
        (self.said.feed, self.said.tip) = (feed, feed);
        self.assign(b"$VEL.CP=", feed)
    }

    /// To home, to the change place, or to a pose with the status and turn that the arm has there.
    fn joint_move(&mut self, motion: &JointMove) -> Written {
        self.text.put(self.settings.planner.axes());
        self.text.put(b" ");
        let pose = match motion.to {
            JointTarget::Home => return Ok(self.text.line(HOME)?),
            JointTarget::Change => return Ok(self.text.line(CHANGE)?),
            JointTarget::Pose(pose) => pose,
        };
        let branch = self.source.reachable.branch_after(motion.op);
        let StatusAndTurn { status, turn } = branch
            .and_then(|branch| StatusAndTurn::of(branch, motion.axes))
            .ok_or(EmitError::Internal("a pose has no status"))?;
        self.text.put(b"{X ");
        self.pose(pose)?;
        self.text.put(b",S ");
        self.text.whole(status);
        self.text.put(b",T ");
        self.text.whole(turn);
        Ok(self.text.line("}")?)
    }

    fn linear_move(&mut self, motion: &LinearMove<'_>) -> Written {
        self.turn_rates(self.turns.at(motion.op.0 as usize))?;
        self.tip_speed(motion.line)?;
        let common = &self.settings.common;
        let leaves = match motion.end {
            End::Exact => None,
            End::Rounded => common.approximation,
            End::Through { within } => Some(common.chain_distance(within)),
        };
        self.rounding(leaves)?;
        let planner = self.settings.planner;
        match motion.line.via {
            None => self.text.put(planner.straight()),
            Some(via) => {
                self.text.put(planner.round());
                self.point_on_arc(motion.line, via)?;
                self.text.put(b"},{X ");
            }
        }
        self.pose(motion.line.to)?;
        self.text.put(b"}");
        if leaves.is_some() {
            self.text.put(planner.approximate());
        }
        Ok(self.text.end_line()?)
    }

    fn change_tool(&mut self, change: &ToolChange<'_>) -> Written {
        self.put_in(change)
    }

    /// Without `CONTINUE`: the output waits for the robot to arrive (advance run stop) [K-SI].
    fn switch(&mut self, output: u32, state: Switch) -> Written {
        self.text.put(b"$OUT[");
        self.text.whole(output);
        Ok(self.text.line(match state {
            Switch::On => "]=TRUE",
            Switch::Off => "]=FALSE",
        })?)
    }

    fn await_input(&mut self, input: u32) -> Written {
        self.text.put(b"WAIT FOR $IN[");
        self.text.whole(input);
        Ok(self.text.line("]")?)
    }

    fn wait(&mut self, time: Duration) -> Written {
        self.assign(b"WAIT SEC ", time.to_s())
    }
}

impl KrlDialect<'_, '_, '_> {
    /// The rates of a turn, where they are others than before. The controller limits the swivel of the tool's direction
    /// (ORI1) and the twist about it (ORI2) apart [K-SI].
    pub(crate) fn turn_rates(&mut self, rates: Option<Rates>) -> Written {
        match rates {
            Some(now) if self.said.rates != rates => {
                self.said.rates = rates;
                self.assign(b"$VEL.ORI1=", now.swivel)?;
                self.assign(b"$VEL.ORI2=", now.twist)
            }
            Some(_) | None => Ok(()),
        }
    }

    /// The speed of the tip, where it is another than before. On an arc the blade turns with its way, and nothing says that the
    /// controller limits that turn: where it is the slower part, the tip goes so slowly that it takes its time all the same.
    fn tip_speed(&mut self, line: &LinearSegment) -> Written {
        let slower = line.via.is_some() && matches!(line.limited_by(), Some(LimitedBy::Rate(_)));
        let tip = if slower {
            TRIMMED.floored((line.length() / line.duration()).to_m_per_s())
        } else {
            self.said.feed
        };
        if tip == self.said.tip {
            return Ok(());
        }
        self.said.tip = tip;
        self.assign(b"$VEL.CP=", tip)
    }

    /// How far before its end a motion may be left, where it is another distance than before.
    fn rounding(&mut self, distance: Option<Length>) -> Written {
        match distance.map(Length::to_mm) {
            Some(now) if self.said.rounding != Some(now) => {
                self.said.rounding = Some(now);
                self.assign(b"$APO.CDIS=", now)
            }
            Some(_) | None => Ok(()),
        }
    }

    /// The auxiliary point of an arc from the value of X on. `CIRC` passes over how the blade is held there, and would be a long line
    /// with it; `SCIRC` may go by it [K-SI].
    fn point_on_arc(&mut self, line: &LinearSegment, via: Point3) -> Written {
        let lengths = self.settings.common.lengths;
        for (name, value) in [(&b""[..], via.x), (b",Y ", via.y), (b",Z ", via.z)] {
            self.text.put(name);
            self.text.fixed(lengths, value)?;
        }
        match self.settings.planner {
            Planner::Classic => Ok(()),
            Planner::Spline => {
                let done = line.arc().map(|arc| arc.done_at(via.to_array()));
                let held = done.and_then(|done| line.frame_at(self.source.program(), done));
                let held = held
                    .ok_or(EmitError::Internal("an arc has no circle"))?
                    .orientation;
                Ok(push_angles(self.text.buffer(), held, self.settings.angles)?)
            }
        }
    }

    /// Sets a variable, or says another instruction that ends in a number.
    pub(crate) fn assign(&mut self, target: &[u8], value: f64) -> Written {
        self.text.put(target);
        self.text.trimmed(value)?;
        Ok(self.text.end_line()?)
    }

    /// A target from the value of X on, without its closing bracket.
    #[inline]
    fn pose(&mut self, TipPose { tip, orientation }: TipPose) -> Written {
        let (lengths, text) = (self.settings.common.lengths, &mut *self.text);
        text.fixed(lengths, tip.x)?;
        text.put(b",Y ");
        text.fixed(lengths, tip.y)?;
        text.put(b",Z ");
        text.fixed(lengths, tip.z)?;
        text.put(self.attitudes.text(orientation)?);
        Ok(())
    }
}
