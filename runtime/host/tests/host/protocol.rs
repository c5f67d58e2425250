//! Wire form of the driver protocol.

use motet_host::remote::protocol;

/// A change of the schema is a new version of the protocol, unless older drivers still understand it.
#[test]
fn protocol_schema_is_as_recorded() {
    insta::assert_json_snapshot!(serde_json::json!({
        "version": protocol::VERSION,
        "messages": protocol::schema(),
    }));
}
