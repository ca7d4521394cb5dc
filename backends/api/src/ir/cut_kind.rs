//! What people call a cut.

use super::{OperationId, Program, Shape, Site, ToolId};

/// What a cut of a layer does, as the words of programs, messages and reports name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum CutKind {
    /// A straight blade or a crusher cuts what its operation asks for, with nothing but this blade.
    Cut,
    /// A straight blade cuts upright for a disc that comes after it in the same operation.
    Slit,
    /// A disc frees a strip between slits.
    Strip,
    /// A disc takes the skin off the part, in an operation of its own.
    Track,
}

impl CutKind {
    /// `cut`, `slit`, `strip` or `track`.
    #[must_use]
    pub const fn noun(self) -> &'static str {
        match self {
            Self::Cut => "cut",
            Self::Slit => "slit",
            Self::Strip => "strip",
            Self::Track => "track",
        }
    }
}

impl Program {
    /// What a blade cuts in an operation.
    #[must_use]
    pub fn cut_kind(&self, operation: OperationId, tool: ToolId) -> CutKind {
        let several = self.blades_of(operation).count() > 1;
        match self.blade(tool).map(|blade| &blade.shape) {
            Some(Shape::Disc(_)) if several => CutKind::Strip,
            Some(Shape::Disc(_)) => CutKind::Track,
            Some(Shape::Straight(_)) if several => CutKind::Slit,
            Some(Shape::Straight(_) | Shape::Crusher(_)) | None => CutKind::Cut,
        }
    }

    /// What is cut at a place: all ops before it are walked where its operation has several blades.
    #[must_use]
    pub fn cut_kind_at(&self, site: Site) -> CutKind {
        let Some(operation) = site.operation() else {
            return CutKind::Cut;
        };
        let tool = match self
            .operation(operation)
            .map(|operation| operation.tools.as_slice())
        {
            Some([only]) => Some(*only),
            Some(_) | None => self
                .ends()
                .find(|(_, op, _)| op.site == site)
                .map(|(_, _, after)| after.tool),
        };
        tool.map_or(CutKind::Cut, |tool| self.cut_kind(operation, tool))
    }
}
