//! The chains of an operation, as a finished program states them.

use core::num::NonZeroU32;
use vcutc_backend_api::geometry::Orientation;
use vcutc_backend_api::ir::{Action, OpId, OperationId, Program, Site, ToolId};
use vcutc_backend_api::segments::LinearSegment;

/// A piece of a chain: a line or an arc, with how the tool is held where it begins and ends.
#[derive(Clone, Debug)]
pub struct ChainPiece {
    pub op: OpId,
    pub layer: NonZeroU32,
    pub cut: NonZeroU32,
    pub tool: ToolId,
    pub line: LinearSegment,
    /// Of verified programs all orientations are known.
    pub held: [Orientation; 2],
}

/// The pieces of an operation's chains, in the order of the program.
pub fn pieces(program: &Program, operation: OperationId) -> impl Iterator<Item = ChainPiece> {
    program.segments().filter_map(move |segment| {
        let (
            Site::Cut {
                operation: own,
                layer,
                cut,
            },
            Action::Follow { .. },
        ) = (segment.op.site, segment.op.action)
        else {
            return None;
        };
        let line = segment.line().filter(|_| own == operation)?;
        let [from, to] = [line.from, line.to].map(|pose| program.orientation(pose.orientation));
        Some(ChainPiece {
            op: segment.id,
            layer,
            cut,
            tool: segment.before.tool,
            held: [from?, to?],
            line,
        })
    })
}
