//! The committed schemas are those that the types give.

use std::path::Path;
use vcutc_backend_api::exchange::Exchange;
use vcutc_backend_api::profile::Profile;
use vcutc_backend_api::protocol::Message;

#[allow(
    clippy::disallowed_methods,
    reason = "the test reads a committed file, and writes it when asked to"
)]
fn assert_current(file: &str, schema: &schemars::Schema) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    let schema = serde_json::to_string_pretty(schema).unwrap() + "\n";
    if std::env::var("UPDATE_SCHEMA").is_ok() {
        std::fs::write(&path, &schema).unwrap();
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == schema,
        "{file} is out of date: run the tests with UPDATE_SCHEMA=1 and commit it"
    );
}

#[test]
fn the_schema_of_the_exchange_form_is_current() {
    assert_current("docs/schema/ir.json", &schemars::schema_for!(Exchange<'_>));
}

#[test]
fn the_schema_of_the_protocol_of_outside_programs_is_current() {
    assert_current("docs/schema/backend.json", &schemars::schema_for!(Message<'_>));
}

#[test]
fn the_schema_of_profiles_is_current() {
    assert_current("docs/schema/profile.json", &schemars::schema_for!(Profile));
}
