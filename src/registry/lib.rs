//! The operations and the backends that this build knows.

use vcutc_backend_api::backend::Backend;
use vcutc_job::sema::kind::Operations;

/// All operations.
pub const OPERATIONS: Operations = Operations(&[
    &vcutc_vcut::Vcut,
    &vcutc_rect::Rect,
    &vcutc_auto::Auto,
    &vcutc_finish::Finish,
    &vcutc_pocket::Pocket,
    &vcutc_slit::Slit,
    &vcutc_free::Free,
]);

/// All backends, in the order of their names.
#[must_use]
pub fn backends() -> Vec<&'static dyn Backend> {
    vec![
        #[cfg(feature = "gcode")]
        &vcutc_backend_gcode::Gcode,
        #[cfg(feature = "krl")]
        &vcutc_backend_krl::Krl,
        #[cfg(feature = "rapid")]
        &vcutc_backend_rapid::Rapid,
    ]
}

/// The backend of that name.
#[must_use]
pub fn backend(id: &str) -> Option<&'static dyn Backend> {
    backends().into_iter().find(|backend| backend.id() == id)
}
