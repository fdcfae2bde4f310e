//! Physical groups: names, and which entities belong to them.

use super::cursor::Cursor;
use crate::geometry::{Quote, Rounded};
use crate::mesh::MeshError;
use std::collections::HashMap;

/// Whole numbers below this are exact as floating-point ones.
const MOST_EXACT: f64 = 9_007_199_254_740_992.0;

/// Dimension and tag of an elementary entity of the file, or of a physical group.
pub(super) type Entity = (usize, i64);

/// Physical groups of a file.
#[derive(Default)]
pub(super) struct Groups {
    names: HashMap<Entity, String>,
    /// Tags of the groups that an entity belongs to.
    of_entity: HashMap<Entity, Vec<i64>>,
}

impl Groups {
    /// Physical names of an entity.
    pub fn names_of(&self, entity: Entity) -> Vec<String> {
        let tags = self.of_entity.get(&entity).map(Vec::as_slice).unwrap_or(&[]);
        tags.iter().map(|&tag| self.name((entity.0, tag))).collect()
    }

    /// The name of a group; one without a name is known by its tag.
    pub fn name(&self, group: Entity) -> String {
        self.names.get(&group).cloned().unwrap_or(group.1.to_string())
    }

    /// Reads `$PhysicalNames`, which are text in binary files, too.
    pub fn read_names(&mut self, cursor: &mut Cursor) -> Result<(), MeshError> {
        let count: usize = cursor.line_of("PhysicalNames", 1)?[0];
        for _ in 0..count {
            let line = cursor.line_in("PhysicalNames")?;
            let mut rest = line.trim();
            let mut number = || {
                let (word, behind) = rest.split_once(char::is_whitespace)?;
                rest = behind.trim_start();
                word.parse::<i64>().ok()
            };
            let (dimension, tag) = (number(), number());
            let name = Some(rest.trim_matches('"').to_string()).filter(|_| !rest.is_empty());
            let (Some(dimension), Some(tag), Some(name)) = (dimension, tag, name) else {
                return Err(cursor.error(format!("expected `dimension tag \"name\"`, found `{}`", Quote(&line))));
            };
            self.names.insert((dimension as usize, tag), name);
        }
        Ok(())
    }

    /// Reads `$Entities` of format 4.1.
    pub fn read_entities(&mut self, cursor: &mut Cursor) -> Result<(), MeshError> {
        let counts: Vec<i64> = match cursor.is_text() {
            true => cursor.line_of::<u64>("Entities", 4)?.into_iter().map(|count| count.try_into().unwrap_or(i64::MAX)).collect(),
            false => (0..4).map(|_| cursor.size("Entities")).collect::<Result<_, _>>()?,
        };
        for (dimension, count) in counts.into_iter().take(4).enumerate() {
            for _ in 0..count {
                let (entity, tags) = if cursor.is_text() { in_line(cursor, dimension)? } else { in_bytes(cursor, dimension)? };
                // A sign tells the direction of the entity in the group.
                self.of_entity.insert((dimension, entity), tags.into_iter().map(i64::abs).collect());
            }
        }
        Ok(())
    }
}

/// Tag and physical tags of an entity in a text.
fn in_line(cursor: &mut Cursor, dimension: usize) -> Result<(i64, Vec<i64>), MeshError> {
    let first = if dimension == 0 { 4 } else { 7 };
    let values: Vec<f64> = cursor.line_of("Entities", first + 1)?;
    let (entity, count) = (whole(cursor, values[0])?, whole(cursor, values[first])?);
    let rest = &values[first + 1..];
    let Some(tags) = usize::try_from(count).ok().and_then(|count| rest.get(..count)) else {
        let words = format!("expected {count} physical tags, found {} numbers; save the file again", rest.len());
        return Err(cursor.error(words));
    };
    Ok((entity, tags.iter().map(|&tag| whole(cursor, tag)).collect::<Result<_, _>>()?))
}

/// Tag and physical tags of an entity in a binary file.
fn in_bytes(cursor: &mut Cursor, dimension: usize) -> Result<(i64, Vec<i64>), MeshError> {
    const SECTION: &str = "Entities";
    let [entity] = cursor.whole(SECTION)?;
    cursor.pass(SECTION, if dimension == 0 { 3 } else { 6 }, 8)?;
    let count = cursor.size(SECTION)?;
    let tags = cursor.wholes(SECTION, count as usize)?;
    if dimension > 0 {
        let bounding = cursor.size(SECTION)?;
        cursor.pass(SECTION, bounding, 4)?;
    }
    Ok((entity, tags))
}

/// A tag or a count that stands among coordinates.
fn whole(cursor: &Cursor, number: f64) -> Result<i64, MeshError> {
    if number.fract() == 0.0 && number.abs() < MOST_EXACT {
        return Ok(number as i64);
    }
    Err(cursor.error(format!("in $Entities, found {} where a tag or a count stands; it must be a whole number", Rounded(number))))
}
