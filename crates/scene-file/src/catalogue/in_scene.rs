//! What the name in a scene file says, and whether a clearance beside it belongs to its class.

use super::{Designation, designation};
use toml::{Table, Value};

/// What the name of a scene's bearing says beside the bearing's own; `None` where it says nothing, where there is none,
/// and of what is no scene file.
pub fn name_remark(text: &str) -> Option<String> {
    let file: Table = text.parse().ok()?;
    let keys = file.get("bearing")?.as_table()?;
    let name = keys.get("catalogue")?.as_str()?;
    let read = designation(name).ok()?;
    let beside = beside(keys, &read);
    let said = match (read.remark(), beside) {
        (None, None) => return None,
        (remark, beside) => {
            let own = remark.unwrap_or_else(|| format!("a {read}"));
            beside.map_or(own.clone(), |beside| format!("{own}; {beside}"))
        }
    };
    Some(format!("bearing.catalogue = {name:?} is {said}"))
}

/// A clearance that is given beside a name with a class, and is not of that class.
fn beside(keys: &Table, read: &Designation) -> Option<String> {
    let class = read.clearance.filter(|_| read.says_class)?;
    let number = |key: &str| {
        keys.get(key).and_then(|value| match value {
            Value::Float(number) => Some(*number),
            Value::Integer(number) => Some(*number as f64),
            _ => None,
        })
    };
    let [low, high] = class.range_um;
    let (key, given, per) = [("internal_clearance_um", 1.0), ("radial_clearance_um", 2.0)]
        .into_iter()
        .find_map(|(key, per)| Some((key, number(key)?, per)))?;
    let outside = !(low..=high).contains(&(per * given));
    outside.then(|| {
        let twice = if per == 2.0 { ", which is half of an internal clearance," } else { "" };
        format!("bearing.{key} = {given}{twice} wins over it and is not of class {}", class.class)
    })
}
