//! Nodes and elements of format 4.1: in blocks, one or more for each entity.

use super::cursor::Cursor;
use super::elements::{ElementKind, Elements};
use super::groups::Groups;
use crate::mesh::MeshError;

/// The line before a block: dimension, entity, kind, and how many there are.
fn block(cursor: &mut Cursor, section: &str) -> Result<[i64; 4], MeshError> {
    let [dimension, entity, kind, count] = match cursor.is_text() {
        true => {
            let values: Vec<i64> = cursor.line_of(section, 4)?;
            [values[0], values[1], values[2], values[3]]
        }
        false => {
            let [dimension, entity, kind] = cursor.whole(section)?;
            [dimension, entity, kind, cursor.size(section)?]
        }
    };
    if count < 0 {
        return Err(cursor.error(format!("in ${section}, expected a count of at least 0, found {count}")));
    }
    Ok([dimension, entity, kind, count])
}

/// How many blocks a section has.
fn blocks(cursor: &mut Cursor, section: &str) -> Result<i64, MeshError> {
    if cursor.is_text() {
        return Ok(cursor.line_of::<u64>(section, 4)?[0].try_into().unwrap_or(i64::MAX));
    }
    let count = cursor.size(section)?;
    cursor.pass(section, 3, 8)?;
    Ok(count)
}

/// Reads `$Nodes`.
pub(super) fn read_nodes(cursor: &mut Cursor, elements: &mut Elements) -> Result<(), MeshError> {
    const SECTION: &str = "Nodes";
    for _ in 0..blocks(cursor, SECTION)? {
        let [dimension, _, parametric, count] = block(cursor, SECTION)?;
        let (mut tags, mut words) = (Vec::new(), Vec::new());
        for _ in 0..count {
            tags.push(if cursor.is_text() {
                cursor.wholes_in_place_of(SECTION, 1, &mut words)?;
                words[0]
            } else {
                cursor.size(SECTION)?
            });
        }
        for tag in tags {
            let x = if cursor.is_text() {
                let mut x = [0.0; 3];
                cursor.line_into(SECTION, &mut x)?;
                x
            } else {
                let x = cursor.floats(SECTION)?;
                cursor.pass(SECTION, if parametric == 0 { 0 } else { dimension }, 8)?;
                x
            };
            elements.add_node(cursor, tag, x)?;
        }
    }
    elements.end_nodes();
    Ok(())
}

/// Reads `$Elements`.
pub(super) fn read_elements(cursor: &mut Cursor, groups: &Groups, elements: &mut Elements) -> Result<(), MeshError> {
    const SECTION: &str = "Elements";
    for _ in 0..blocks(cursor, SECTION)? {
        let [dimension, entity, number, count] = block(cursor, SECTION)?;
        let kind = ElementKind::of(number).map_err(|words| cursor.error(words))?;
        let names = elements.names(groups.names_of((usize::try_from(dimension).unwrap_or(usize::MAX), entity)));
        let mut words = vec![0; kind.nodes + 1];
        for _ in 0..count {
            if cursor.is_text() {
                cursor.wholes_in_place_of(SECTION, kind.nodes + 1, &mut words)?;
            } else {
                words.iter_mut().try_for_each(|word| cursor.size(SECTION).map(|size| *word = size))?;
            }
            elements.add(cursor, kind, &words[1..], names)?;
        }
    }
    Ok(())
}
