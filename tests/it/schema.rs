//! The committed schema of the exchange form is the one that the types give.

use std::path::Path;
use vcutc_backend_api::exchange::Exchange;

#[test]
#[allow(
    clippy::disallowed_methods,
    reason = "the test reads a committed file, and writes it when asked to"
)]
fn committed_schema_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/schema/ir.json");
    let schema = serde_json::to_string_pretty(&schemars::schema_for!(Exchange<'_>)).unwrap() + "\n";
    if std::env::var("UPDATE_SCHEMA").is_ok() {
        std::fs::write(&path, &schema).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == schema,
        "docs/schema/ir.json is out of date: run the tests with UPDATE_SCHEMA=1 and commit it"
    );
}
