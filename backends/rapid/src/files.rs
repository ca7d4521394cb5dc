//! Modules: the main one with the data and the entry of the task, those of the parts that it calls, and the list of them.

use crate::dialect::{Arcs, NO_EXTERNAL_AXES, RapidDialect};
use crate::limits::first_passed;
use crate::names::{
    AXES_SPEED, BLEND, CHANGE, FEED, HOME, MAIN, RATE, SPEED, ZONE, part_module, part_routine,
};
use crate::options::zone_members;
use crate::orient::Quaternion;
use crate::speeds::{EXTERNAL, RATE_OF_NOTHING, named};
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Frame;
use vcutc_backend_api::ir::{Action, AxisValues, Load, RateId, Registered, Tool, ToolId};
use vcutc_backend_api::script::{File, Files, TRIMMED, Written, feed, rate};
use vcutc_backend_api::units::Length;

/// The modes that moves depend on. A task that is started from the beginning has them; one that is started at
/// a part may not, nor one whose blade a routine of the cell has changed.
const MODES: [&str; 3] = ["    ConfJ\\On;", "    ConfL\\On;", "    SingArea\\Off;"];

/// On arcs the blade turns about one axis, seen from the work object, in even steps along the way: as on lines [A-INS].
const ARCS: &str = "    CirPathMode\\ObjectFrame;";

impl RapidDialect<'_, '_, '_> {
    /// All modes that moves depend on.
    pub(crate) fn modes(&mut self) -> Written {
        for line in MODES {
            self.text.line(line)?;
        }
        match self.arcs {
            Arcs::Some => Ok(self.text.line(ARCS)?),
            Arcs::None => Ok(()),
        }
    }
}

impl Files for RapidDialect<'_, '_, '_> {
    fn part_name(&self, main: &str, part: usize) -> String {
        part_routine(main, part)
    }

    /// The head of a module.
    fn open(&mut self, file: File<'_>) -> Written {
        let module = match file.place {
            0 => file.name.to_owned(),
            part => part_module(file.main, part),
        };
        let path = format!("{module}.{}", self.settings.extension());
        self.text.file(&path)?;
        self.modules.push(path);
        Ok(self.text.line(&format!("MODULE {module}"))?)
    }

    /// The head of a routine: in the main module after the data, and with the lines that the machine wants there.
    fn setup(&mut self, file: File<'_>) -> Written {
        let routine = match file.place {
            0 => {
                self.data()?;
                self.text.line("")?;
                MAIN
            }
            _ => file.name,
        };
        self.text.line(&format!("  PROC {routine}()"))?;
        if file.part.is_some() {
            self.modes()?;
        }
        if file.place == 0 {
            for line in &self.settings.common.profile.header {
                self.text.line(line)?;
            }
        }
        Ok(())
    }

    fn call(&mut self, part: File<'_>) -> Written {
        self.begin(part.name.as_bytes());
        Ok(self.text.line(";")?)
    }

    fn close(&mut self, _: File<'_>) -> Written {
        self.text.line("  ENDPROC")?;
        Ok(self.text.line("ENDMODULE")?)
    }

    /// The list of modules, which the controller loads as one program [A-OV].
    fn finish(&mut self, main: &str) -> Written {
        self.text.file(&format!("{main}.pgf"))?;
        self.text
            .line("<?xml version=\"1.0\" encoding=\"ISO-8859-1\" ?>")?;
        self.text.line("<Program>")?;
        for module in &self.modules {
            self.text.line(&format!("  <Module>{module}</Module>"))?;
        }
        self.text.line("</Program>")?;
        Ok(self.text.flush()?)
    }

    fn caution(&self, before: &str) -> Vec<String> {
        vec![
            format!("goes on where {before} stopped"),
            "if started alone: in manual mode, the blade clear of the work, watching the way to the first point"
                .to_owned(),
        ]
    }
}

impl RapidDialect<'_, '_, '_> {
    /// The data that moves refer to, each of which some move does refer to.
    fn data(&mut self) -> Written {
        let mut ops = self.source.program().ops.iter();
        let moves = |action: &Action| {
            named(action).is_some()
                || matches!(
                    action,
                    Action::Home | Action::ChangePlace | Action::AxisTravel { .. }
                )
        };
        if !ops.any(|op| moves(&op.action)) {
            return Ok(());
        }
        for (id, tool) in self.source.cell.tools.iter() {
            self.tool(id, tool)?;
        }
        self.work_object()?;
        self.places()?;
        self.speed_data()?;
        let common = &self.settings.common;
        let corners = common.approximation.map(|distance| (ZONE, distance));
        let joints = first_passed(self.source.reachable)
            .map(|_| (BLEND, common.chain_distance(self.source.program().blend)));
        for (name, distance) in corners.into_iter().chain(joints) {
            self.zone(name, distance)?;
        }
        Ok(())
    }

    fn tool(&mut self, id: ToolId, tool: &Tool) -> Written {
        let name = self.settings.tool(self.source.cell, id);
        if tool.frame.number.is_some() {
            return Ok(self
                .text
                .line(&format!("  ! tool and load as the controller has them in {name}"))?);
        }
        let Some(Registered::Value(load)) = tool.load else {
            return Err(EmitError::Internal("a tool without load was not refused"));
        };
        self.text
            .put(format!("  PERS tooldata {name}:=[TRUE,").as_bytes());
        self.frame(tool.frame.frame)?;
        self.text.put(b",");
        self.load(load)?;
        Ok(self.text.line("];")?)
    }

    /// Where the job states no inertia about the centre of mass, that of a point mass stands.
    fn load(&mut self, load: Load) -> Written {
        self.text.put(b"[");
        self.text.trimmed(load.mass.to_kg())?;
        self.text.put(b",");
        self.point(load.centre)?;
        let Some(inertia) = load.inertia else {
            self.text.put(b",[1,0,0,0],0,0,0]");
            return Ok(());
        };
        self.text.put(b",[1,0,0,0]");
        for moment in inertia.to_array() {
            self.text.put(b",");
            self.text.trimmed(moment)?;
        }
        self.text.put(b"]");
        Ok(())
    }

    fn work_object(&mut self) -> Written {
        let name = self.settings.work_object(self.source.cell);
        if self.source.cell.base.number.is_some() {
            return Ok(self
                .text
                .line(&format!("  ! work object as the controller has it in {name}"))?);
        }
        self.text
            .put(format!("  PERS wobjdata {name}:=[FALSE,TRUE,\"\",").as_bytes());
        self.frame(self.source.cell.base.frame)?;
        Ok(self.text.line(",[[0,0,0],[1,0,0,0]]];")?)
    }

    /// `[[x,y,z],[q1,q2,q3,q4]]`.
    fn frame(&mut self, frame: Frame) -> Written {
        self.text.put(b"[");
        self.point(frame.origin)?;
        self.text.put(b",");
        Quaternion::rounded(frame.orientation).push(self.text.buffer());
        self.text.put(b"]");
        Ok(())
    }

    /// The axis values of home and of the change place, where a move goes there.
    fn places(&mut self) -> Written {
        let cell = self.source.cell;
        self.place(HOME, Action::Home, cell.home)?;
        self.place(CHANGE, Action::ChangePlace, cell.change.map(|change| change.at))
    }

    fn place(&mut self, name: &str, goes_there: Action, axes: Option<AxisValues>) -> Written {
        let goes = self.source.program().ops.iter().any(|op| op.action == goes_there);
        let Some(axes) = axes.filter(|_| goes) else {
            return Ok(());
        };
        self.text.put(format!("  CONST jointtarget {name}:=[").as_bytes());
        self.joints(axes)?;
        self.text.put(b",");
        self.text.put(NO_EXTERNAL_AXES);
        Ok(self.text.line("];")?)
    }

    fn speed_data(&mut self) -> Written {
        let program = self.source.program();
        for id in self.speeds.feeds() {
            self.number(FEED, id.0, feed(program, id)?.to_mm_per_s())?;
        }
        for id in self.speeds.rates() {
            // Never faster than proven.
            let turning = TRIMMED.floored(rate(program, id)?.to_deg_per_s());
            self.number(RATE, id.0, turning)?;
        }
        let rate = |id: Option<RateId>| {
            id.map_or_else(
                || RATE_OF_NOTHING.to_string(),
                |id| format!("{RATE}{}", u32::from(id.0) + 1),
            )
        };
        let home_speed = self.settings.home_speed;
        let [linear, rotary] = EXTERNAL;
        let slowest = rate(self.speeds.slowest_rate());
        self.text.line(&format!(
            "  CONST speeddata {AXES_SPEED}:=[{home_speed},{slowest},{linear},{rotary}];"
        ))?;
        for (number, (feed, turning)) in self.speeds.all() {
            let tip = feed.map_or_else(
                || home_speed.to_string(),
                |id| format!("{FEED}{}", u32::from(id.0) + 1),
            );
            let turning = rate(turning);
            self.text.line(&format!(
                "  CONST speeddata {SPEED}{number}:=[{tip},{turning},{linear},{rotary}];"
            ))?;
        }
        Ok(())
    }

    fn number(&mut self, start: &str, place: u16, value: f64) -> Written {
        let number = u32::from(place) + 1;
        self.text.put(format!("  CONST num {start}{number}:=").as_bytes());
        self.text.trimmed(value)?;
        Ok(self.text.line(";")?)
    }

    /// All seven members.
    fn zone(&mut self, name: &str, distance: Length) -> Written {
        self.text
            .put(format!("  CONST zonedata {name}:=[FALSE").as_bytes());
        for member in zone_members(distance) {
            self.text.put(b",");
            self.text.trimmed(member)?;
        }
        Ok(self.text.line("];")?)
    }
}
