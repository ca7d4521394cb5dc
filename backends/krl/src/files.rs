//! Modules: the `.src` and `.dat` around the ops of a part, or around the calls of parts.

use crate::attitude::push_angles;
use crate::dialect::{Arcs, KrlDialect};
use crate::names::{CHANGE, HOME, part_name};
use crate::options::PartNames;
use vcutc_backend_api::backend::EmitError;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::{
    Action, AxisValues, Changer, Inertia, Load, PlacedFrame, Registered, Tool, ToolId,
};
use vcutc_backend_api::number::NotFinite;
use vcutc_backend_api::script::{File, Files, Part, Written};
use vcutc_backend_api::state::Place;
use vcutc_backend_api::units::Length;

const NO_HOME: EmitError = EmitError::Internal("the machine has no home angles");
const NO_CHANGE: EmitError = EmitError::Internal("the machine has no place for changes");

impl Files for KrlDialect<'_, '_, '_> {
    fn part_name(&self, main: &str, part: usize) -> String {
        part_name(main, part)
    }

    /// The head of a `.src`.
    fn open(&mut self, file: File<'_>) -> Written {
        self.text.file(&format!("{}.src", file.name))?;
        self.marks()?;
        self.text.line(&format!("DEF {}( )", file.name))?;
        if file.part.is_none() && self.settings.part_names == PartNames::Declared {
            for part in 1..=file.parts {
                let name = self.part_name(file.name, part);
                self.text.line(&format!("EXT {name}( )"))?;
            }
        }
        if self.settings.part_names == PartNames::Declared
            && file.part.is_some_and(|part| self.calls_routine(part))
        {
            let routine = self.settings.change_routine;
            self.text.line(&format!("EXT {routine}(INT :IN )"))?;
        }
        Ok(())
    }

    /// Everything that motions depend on. `BAS (#INITMOV,0 )` resets all of it, so it comes first [K-QG]; the lines that the
    /// machine wants in the main module stand in front of it.
    fn setup(&mut self, file: File<'_>) -> Written {
        if file.place == 0 {
            for line in &self.settings.common.profile.header {
                self.text.line(line)?;
            }
        }
        self.text.line(";FOLD INI")?;
        self.text.line("BAS (#INITMOV,0 )")?;
        self.text.line(";ENDFOLD (INI)")?;
        match file.part {
            Some(part) => self.motion_setup(part.start.tool),
            None => Ok(()),
        }
    }

    fn call(&mut self, part: File<'_>) -> Written {
        Ok(self.text.line(&format!("{}( )", part.name))?)
    }

    fn close(&mut self, file: File<'_>) -> Written {
        self.text.line("END")?;
        self.data(file)
    }

    fn finish(&mut self, _: &str) -> Written {
        Ok(self.text.flush()?)
    }

    fn caution(&self, before: &str) -> Vec<String> {
        vec![
            format!("goes on where {before} stopped"),
            "if started alone: in T1, the blade clear of the work, watching the way to the first point"
                .to_owned(),
        ]
    }
}

impl KrlDialect<'_, '_, '_> {
    /// The lines with `&` that the pendant's navigator shows; `.src` and `.dat` carry the same.
    fn marks(&mut self) -> Written {
        self.text.line("&ACCESS RVP")?;
        self.text.line("&REL 1")?;
        Ok(self.text.comment("&COMMENT ", &self.source.program().name)?)
    }

    pub(crate) fn motion_setup(&mut self, tool: ToolId) -> Written {
        let (cell, settings) = (self.source.cell, self.settings);
        self.text.line(";FOLD SETUP")?;
        let tool = cell.tools.at(tool);
        self.frame("TOOL", tool.frame)?;
        self.frame("BASE", cell.base)?;
        self.load_of(tool)?;
        self.text.line("$IPO_MODE=#BASE")?;
        self.text.line("$ORI_TYPE=#VAR")?;
        match self.arcs {
            Arcs::Some => self.text.line("$CIRC_TYPE=#PATH")?,
            Arcs::None => {}
        }
        self.text.line("$ADVANCE=3")?;
        self.said.rounding = settings.common.approximation.map(Length::to_mm);
        if let Some(distance) = self.said.rounding {
            self.assign(b"$APO.CDIS=", distance)?;
        }
        self.text
            .line(&format!("BAS (#VEL_PTP,{} )", settings.home_speed))?;
        Ok(self.text.line(";ENDFOLD (SETUP)")?)
    }

    /// Sets `$TOOL` or `$BASE`.
    pub(crate) fn frame(&mut self, which: &str, placed: PlacedFrame) -> Written {
        if let Some(number) = placed.number {
            return Ok(self.text.line(&format!("BAS (#{which},{number} )"))?);
        }
        self.text.put(format!("${which}={{").as_bytes());
        self.point(placed.frame.origin)?;
        push_angles(self.text.buffer(), placed.frame.orientation, self.settings.angles)?;
        Ok(self.text.line("}")?)
    }

    /// `X ..,Y ..,Z ..` in mm.
    fn point(&mut self, point: Point3) -> Result<(), NotFinite> {
        let lengths = self.settings.common.lengths;
        for (name, value) in [("X ", point.x), (",Y ", point.y), (",Z ", point.z)] {
            self.text.put(name.as_bytes());
            self.text.fixed(lengths, value)?;
        }
        Ok(())
    }

    fn load_of(&mut self, tool: &Tool) -> Written {
        match tool.load {
            Some(Registered::Value(load)) => self.load(load),
            Some(Registered::Number(number)) => Ok(self.text.line(&format!("$LOAD=LOAD_DATA[{number}]"))?),
            None => Ok(self
                .text
                .line("; load as the controller has it: the job states none")?),
        }
    }

    /// Sets `$LOAD`. Where the job states no inertia about the centre of mass, that of a point mass stands.
    fn load(&mut self, load: Load) -> Written {
        self.text.put(b"$LOAD={M ");
        self.text.trimmed(load.mass.to_kg())?;
        self.text.put(b",CM {");
        self.point(load.centre)?;
        let Inertia { x, y, z } = load.inertia.unwrap_or(Inertia::POINT);
        self.text.put(b",A 0.0,B 0.0,C 0.0},J {");
        for (name, moment) in [("X ", x), (",Y ", y), (",Z ", z)] {
            self.text.put(name.as_bytes());
            self.text.trimmed(moment)?;
        }
        Ok(self.text.line("}}")?)
    }

    /// The `.dat` of a module. Declarations live here only: one after an instruction of a `.src` does not
    /// compile [K-QG].
    fn data(&mut self, file: File<'_>) -> Written {
        self.text.file(&format!("{}.dat", file.name))?;
        self.marks()?;
        self.text.line(&format!("DEFDAT {}", file.name))?;
        self.text.line("EXT BAS (BAS_COMMAND :IN,REAL :IN )")?;
        if let Some(part) = file.part {
            if self.needs_home(part) {
                let home = self.source.cell.home;
                self.angles(HOME, home.ok_or(NO_HOME)?)?;
            }
            if self.needs_change(part) {
                let change = self.source.cell.change;
                self.angles(CHANGE, change.ok_or(NO_CHANGE)?.at)?;
            }
        }
        Ok(self.text.line("ENDDAT")?)
    }

    fn calls_routine(&self, part: &Part) -> bool {
        let by = self.source.cell.changer();
        let mut ops = self.source.ops(part).iter();
        by == Some(Changer::Program) && ops.any(|op| matches!(op.action, Action::ToolChange { .. }))
    }

    fn needs_home(&self, part: &Part) -> bool {
        let mut ops = self.source.ops(part).iter();
        part.start.place == Place::Home || ops.any(|op| matches!(op.action, Action::Home))
    }

    fn needs_change(&self, part: &Part) -> bool {
        let mut ops = self.source.ops(part).iter();
        part.start.place == Place::Change || ops.any(|op| matches!(op.action, Action::ChangePlace))
    }

    /// Angles of the axes with a name. External axes are left out: what is left out stays where it is [K-SI], and the job says nothing of
    /// them.
    fn angles(&mut self, name: &str, angles: AxisValues) -> Written {
        self.text.put(b"DECL E6AXIS ");
        self.text.put(name.as_bytes());
        let starts = ["={A1 ", ",A2 ", ",A3 ", ",A4 ", ",A5 ", ",A6 "];
        for (start, angle) in starts.into_iter().zip(angles.0) {
            self.text.put(start.as_bytes());
            self.text.fixed(self.settings.angles, angle.to_degrees())?;
        }
        Ok(self.text.line("}")?)
    }
}
