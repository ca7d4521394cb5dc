//! placeholder until meaning lands
use crate::diag::Diagnostic;
use crate::job::CheckedJob;
use crate::source::{LoadError, Loader, SourceMap};
use crate::syntax::ast::Ast;
/// placeholder
pub fn check(
    _root: &str, _loader: &dyn Loader, _overrides: &[String], _sources: &mut SourceMap, _diagnostics: &mut Vec<Diagnostic>,
) -> Result<(Option<Ast>, Option<CheckedJob>), LoadError> { Ok((None, None)) }
