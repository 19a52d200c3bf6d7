//! The JSON schema of a scene file. The limits in it are those by which files are refused, from the same table.

use crate::quantities::written;
use crate::tables::SceneFile;
use brinell::scene::{Bound, LONGEST_NAME, MOST_SENSOR_MODES, MOST_SENSORS};
use schemars::{Schema, schema_for};
use serde_json::Value;

/// The JSON schema of a scene file, by which editors complete and explain its keys, with the limits of all numbers and
/// the form of names.
pub fn schema() -> Schema {
    let mut schema = schema_for!(SceneFile);
    for (key, quantity) in written() {
        let limits = quantity.limits();
        let (low, high) =
            (named(limits.low, ["minimum", "exclusiveMinimum"]), named(limits.high, ["maximum", "exclusiveMaximum"]));
        put(&mut schema, key, &[low, high]);
    }
    if let Some(name) = schema.pointer_mut("/properties/name").and_then(|name| name.as_object_mut()) {
        name.insert("pattern".to_owned(), format!("^[A-Za-z0-9_-]{{1,{LONGEST_NAME}}}$").into());
    }
    for (key, most) in [("sensor", MOST_SENSORS), ("sensor.mode", MOST_SENSOR_MODES)] {
        let Some(property) = pointer(schema.as_value(), key) else { continue };
        // The list itself, or the second of what one table or several of them may be.
        let second = referred(schema.as_value(), &property).map(|either| format!("{either}/anyOf/1"));
        for pointer in [Some(property), second].into_iter().flatten() {
            let list = schema.pointer_mut(&pointer).and_then(|value| value.as_object_mut());
            if let Some(list) = list.filter(|list| list.contains_key("items")) {
                list.insert("maxItems".to_owned(), most.into());
            }
        }
    }
    schema
}

/// What a key of a scene file means, given with its table (`shaft.load_n`), in the words of the schema.
pub fn description(key: &str) -> Option<String> {
    let schema = Value::from(schema());
    let property = schema.pointer(&pointer(&schema, key)?)?;
    property.get("description")?.as_str().map(str::to_owned)
}

fn named(bound: Bound, [inclusive, exclusive]: [&'static str; 2]) -> (&'static str, f64) {
    match bound {
        Bound::Inclusive(bound) => (inclusive, bound),
        Bound::Exclusive(bound) => (exclusive, bound),
    }
}

fn put(schema: &mut Schema, key: &str, bounds: &[(&str, f64)]) {
    let Some(pointer) = pointer(schema.as_value(), key) else { return };
    let Some(property) = schema.pointer_mut(&pointer).and_then(|value| value.as_object_mut()) else { return };
    let numbers = if property.contains_key("items") {
        property.get_mut("items").and_then(|items| items.as_object_mut())
    } else {
        Some(property)
    };
    if let Some(numbers) = numbers {
        numbers.remove("minimum");
        bounds.iter().for_each(|(name, bound)| {
            numbers.insert((*name).to_owned(), (*bound).into());
        });
    }
}

/// The part of the schema that describes the table of a name, the file itself without one.
pub(crate) fn table<'s>(schema: &'s Value, name: &str) -> Option<&'s Value> {
    if name.is_empty() { Some(schema) } else { schema.pointer(&table_of(schema, &pointer(schema, name)?)?) }
}

/// Where the property of a key, given with its table, stands in the schema.
fn pointer(schema: &Value, key: &str) -> Option<String> {
    let mut table = String::new();
    let mut parts = key.split('.').peekable();
    loop {
        let property = format!("{table}/properties/{}", parts.next()?);
        schema.pointer(&property)?;
        if parts.peek().is_none() {
            return Some(property);
        }
        table = table_of(schema, &property)?;
    }
}

/// The table that a property holds, or several of which it does.
fn table_of(schema: &Value, property: &str) -> Option<String> {
    let referred = referred(schema, property)?;
    let is_table = schema.pointer(&referred)?.get("properties").is_some();
    if is_table { Some(referred) } else { table_of(schema, &referred) }
}

/// What a property refers to: by itself, as the first of several, or as the items of a list.
fn referred(schema: &Value, property: &str) -> Option<String> {
    let own = schema.pointer(property)?;
    let holders = [Some(own), own.get("anyOf").and_then(|any| any.get(0)), own.get("items")];
    let name = holders.into_iter().flatten().find_map(|holder| holder.get("$ref"))?.as_str()?;
    name.strip_prefix('#').map(str::to_owned)
}
