//! Nodes and elements of format 2.2: one by one, each element with its physical group.

use super::cursor::Cursor;
use super::elements::{ElementKind, Elements};
use super::groups::Groups;
use crate::mesh::MeshError;

/// Reads `$Nodes`.
pub(super) fn read_nodes(cursor: &mut Cursor, elements: &mut Elements) -> Result<(), MeshError> {
    const SECTION: &str = "Nodes";
    let count: u64 = cursor.line_of(SECTION, 1)?[0];
    for _ in 0..count {
        let (tag, x) = if cursor.is_text() {
            let mut values = [0.0; 4];
            cursor.line_into(SECTION, &mut values)?;
            let [tag, x, y, z] = values;
            (tag as i64, [x, y, z])
        } else {
            let [tag] = cursor.whole(SECTION)?;
            (tag, cursor.floats(SECTION)?)
        };
        elements.add_node(cursor, tag, x)?;
    }
    elements.end_nodes();
    Ok(())
}

/// Reads `$Elements`.
pub(super) fn read_elements(cursor: &mut Cursor, groups: &Groups, elements: &mut Elements) -> Result<(), MeshError> {
    const SECTION: &str = "Elements";
    let count: u64 = cursor.line_of(SECTION, 1)?[0];
    let (mut read, mut words) = (0, Vec::<i64>::new());
    while read < count {
        if cursor.is_text() {
            cursor.wholes_in_place_of(SECTION, 3, &mut words)?;
            let kind = ElementKind::of(words[1]).map_err(|words| cursor.error(words))?;
            let behind = usize::try_from(words[2]).ok().and_then(|tags| words.get(3..)?.split_at_checked(tags));
            let Some((tags, nodes)) = behind.filter(|(_, nodes)| nodes.len() >= kind.nodes) else {
                let words = format!("in $Elements, expected {} tags and {} nodes; save the file again", words[2], kind.nodes);
                return Err(cursor.error(words));
            };
            add(cursor, groups, elements, kind, tags, nodes)?;
            read += 1;
            continue;
        }
        let [number, following, tags] = cursor.whole(SECTION)?;
        let kind = ElementKind::of(number).map_err(|words| cursor.error(words))?;
        let Some(tag_count) = usize::try_from(tags).ok().filter(|_| following > 0) else {
            return Err(cursor.error(format!("in $Elements, found {following} elements with {tags} tags; save the file again")));
        };
        for _ in 0..following {
            cursor.pass(SECTION, 1, 4)?;
            let tags = cursor.wholes(SECTION, tag_count)?;
            let nodes = cursor.wholes(SECTION, kind.nodes)?;
            add(cursor, groups, elements, kind, &tags, &nodes)?;
            read += 1;
        }
    }
    elements.join_repeated();
    Ok(())
}

/// Adds an element; its first tag is the physical group (0 for none), the third the number of partitions that it lies in.
fn add(
    cursor: &Cursor,
    groups: &Groups,
    elements: &mut Elements,
    kind: ElementKind,
    tags: &[i64],
    nodes: &[i64],
) -> Result<(), MeshError> {
    if tags.get(2).is_some_and(|&partitions| partitions > 0) {
        return Err(cursor.error(super::PARTITIONED));
    }
    let group = tags.first().copied().filter(|&tag| tag != 0);
    let names = elements.names_of_group(groups, group.map(|tag| (kind.dimension, tag.abs())));
    elements.add(cursor, kind, nodes, names)
}
