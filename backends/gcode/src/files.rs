//! Files: what is before and after the ops of a part, or the calls of parts.

use crate::controller::{File, Unnumbered};
use crate::dialect::GcodeDialect;
use crate::names::part_name;
use vcutc_backend_api::geometry::Point3;
use vcutc_backend_api::ir::ToolId;
use vcutc_backend_api::script::{self, Dialect, Files, Written, trimmed_text};

impl Files for GcodeDialect<'_, '_, '_> {
    fn part_name(&self, main: &str, part: usize) -> String {
        part_name(main, part, self.job.settings)
    }

    /// What stands before the comments at the head of a file.
    fn open(&mut self, file: script::File<'_>) -> Written {
        let settings = self.job.settings;
        let [main, part] = settings.facts().extensions;
        let extension = match (file.place, &settings.common.profile.extension) {
            (0, Some(extension)) => extension,
            (0, None) => main,
            (_, _) => part,
        };
        self.blocks
            .file(&format!("{}.{extension}", file.name), settings)?;
        for line in settings.controller.opening(self.file(file)) {
            self.blocks.line(&line)?;
        }
        Ok(())
    }

    /// Everything that motions depend on; in the main program also what the operator and the machine's profile want there.
    fn setup(&mut self, file: script::File<'_>) -> Written {
        let tool = file.part.map_or(ToolId::FIRST, |part| part.start.tool);
        if file.place > 0 {
            return self.motion_setup(tool);
        }
        self.frames()?;
        self.motion_setup(tool)?;
        self.blocks.all(&self.job.settings.common.profile.header)
    }

    /// The call of a part.
    fn call(&mut self, part: script::File<'_>) -> Written {
        let call = self.job.settings.controller.call(self.file(part));
        self.blocks.line(&call)
    }

    /// The end of a file.
    fn close(&mut self, file: script::File<'_>) -> Written {
        for line in self.job.settings.controller.closing(self.file(file)) {
            self.blocks.line(&line)?;
        }
        Ok(())
    }

    fn finish(&mut self, _: &str) -> Written {
        self.blocks.flush()
    }

    fn caution(&self, _: &str) -> Vec<String> {
        vec![
            "if started alone: the blade clear of the work,".to_owned(),
            "watching the way to the first point".to_owned(),
        ]
    }
}

impl GcodeDialect<'_, '_, '_> {
    fn file<'f>(&self, file: script::File<'f>) -> File<'f> {
        let first = u64::from(self.job.settings.program_number);
        File {
            name: file.name,
            place: file.place,
            number: first.saturating_add(file.place as u64),
        }
    }

    /// What the operator has to see to: the values that the program was proven with.
    fn frames(&mut self) -> Written {
        let (cell, controller) = (self.job.source.cell, self.job.settings.controller);
        let offset = controller.work_offset_name(self.offset_number());
        let Point3 { x, y, z } = cell.base.frame.origin;
        let [x, y, z] = [x, y, z].map(trimmed_text);
        self.comment(
            &format!("{offset}: zero of the job, a corner of the stock, at"),
            "",
        )?;
        self.comment(&format!("X {x} Y {y} Z {z} mm from the mount"), "")?;
        for (id, tool) in cell.tools.iter() {
            let length = trimmed_text(tool.frame.frame.origin.z);
            let name = controller.tool_name(self.job.tool(id));
            self.comment(&format!("{name}: length {length} mm"), "")?;
        }
        match controller.facts().note_of_axis_moves {
            Some(note) => self.comment(note, ""),
            None => Ok(()),
        }
    }

    /// Number of the work offset, counted from 1.
    fn offset_number(&self) -> u32 {
        self.job.source.cell.base.number.unwrap_or(1)
    }

    /// Everything that motions depend on, tool-centre-point control off.
    pub(crate) fn motion_setup(&mut self, tool: ToolId) -> Written {
        let (settings, tool) = (self.job.settings, self.job.tool(tool).number);
        self.blocks.all(&settings.controller.tcp_off(settings.codes))?;
        self.blocks.all(&settings.controller.setup(tool))?;
        self.work_offset()
    }

    /// The work offset, which is the operator's where the controller leaves one without a number to him.
    fn work_offset(&mut self) -> Written {
        let controller = self.job.settings.controller;
        match (self.job.source.cell.base.number, controller.facts().unnumbered) {
            (None, Unnumbered::Operators) => return Ok(()),
            (Some(_), Unnumbered::First | Unnumbered::Operators) | (None, Unnumbered::First) => {}
        }
        let number = self.offset_number();
        if let Some(block) = controller.work_offset(number) {
            self.blocks.block(&block)?;
        }
        match controller.rest_of_work_offset(number) {
            Some(line) => self.blocks.continuation(&line),
            None => Ok(()),
        }
    }
}
