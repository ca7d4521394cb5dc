//! What is asked for before anything is planned: the job as it is understood, and its machine in words.

use super::{Request, target};
use crate::job::CheckedJob;
use crate::machine::Model;
use crate::sema;
use crate::source::SourceMap;
use vcutc_backend_api::ir::MachineKind;

/// The job alone, understood and not planned; none where it has errors or cannot be read.
#[must_use]
pub fn understood(request: Request<'_>) -> Option<CheckedJob> {
    let (mut sources, mut found) = (SourceMap::default(), Vec::new());
    let choices = request.choices();
    let checked = sema::check(request.path, request.loader, choices, &mut sources, &mut found);
    checked.ok().and_then(|(_, job)| job)
}

/// A machine as messages say it: `kuka/kr210_r3100_ultra, a robot by KUKA`.
#[must_use]
pub fn machine_words(model: &Model) -> String {
    match model.kind() {
        MachineKind::FiveAxis => format!("{}, {}", model.name, target::kind_words(Some(model))),
        MachineKind::Robot => format!("{}, {}", model.name, target::by_maker(Some(model))),
    }
}
