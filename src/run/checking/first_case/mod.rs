//! `mezha new`: a first case from a mesh.
//!
//! Names and places of boundaries tell what is likely meant: what is below is held, what is on top is pressed, what lies close
//! is in contact. What is only an example is said to be one, and the whole is a case that runs as it comes where that can be.

mod draft;
mod guesses;
mod named_curve;

use crate::case::{Case, CaseError};
use crate::mesh::{parse_gmsh, read_bytes, touching_surfaces};
use crate::output::RunError;
use crate::run::checking::check::check;
use crate::run::checking::proposals::{ProposedSupports, TableNames, measure, proposed_supports, quoted, refused_contacts};
use draft::Draft;
use guesses::{DOWN, Guesses, Press};
use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};

/// A first case, and what keeps it from being a whole one.
pub struct FirstCase {
    /// The case, as TOML with comments.
    pub text: String,
    /// What the mesh lacks, a sentence each; the comments say it, too.
    pub remarks: Vec<String>,
}

/// A first case for a mesh file, which the case names as `named`.
///
/// # Errors
/// [`RunError::Input`] if the mesh cannot be used.
pub fn first_case(mesh_file: &Path, named: &str) -> Result<FirstCase, RunError> {
    let bytes = read_bytes(mesh_file).map_err(|error| RunError::Input(error.to_string()))?;
    let groups = touching_surfaces(&bytes, mesh_file).map_err(|error| RunError::Input(error.to_string()))?;
    let names = body_names(&groups);
    let parts = groups.iter().zip(&names).flat_map(|(group, body)| group.iter().map(move |part| (part.clone(), body.clone())));
    let joined: HashMap<String, String> = parts.filter(|(part, body)| part != body).collect();
    let mesh = parse_gmsh(&bytes, mesh_file, joined).map_err(|error| RunError::Input(error.to_string()))?;
    let mut draft = Draft { guesses: Guesses::new(&mesh), groups: &groups, names: &names };
    let place = std::path::absolute(mesh_file).unwrap_or_else(|_| mesh_file.to_path_buf());
    let file = place.with_file_name("case.toml");
    let parse = |text: &str| Case::parse(text, &file, &[format!("mesh.file={}", quoted(&place.to_string_lossy()))]);
    if let Ok(case) = parse(&draft.text(named, Press::Nothing)) {
        measure(&mut draft.guesses.pairs, &case);
    }
    // The first way of pressing that contact carries is taken; the last presses nothing, and an interference that only pushes bodies off
    // wants a load as well. If contact carries none, the first that can be is, and if none can be, the first is told with its words.
    let (mut failed, mut carried) = (None, None);
    let presses = [Press::Plate, Press::Pressure, Press::Nothing];
    let ways = [true, false].into_iter().flat_map(|loads| presses.map(|press| (loads, press)));
    for ((interference_loads, press), down) in ways.flat_map(|way| DOWN.map(|down| (way, down))) {
        (draft.guesses.interference_loads, draft.guesses.down) = (interference_loads, down);
        let is_new = down == DOWN[0] || press != Press::Nothing && draft.guesses.may_turn_weights();
        if !is_new || press == Press::Nothing && carried.is_some() {
            continue;
        }
        loop {
            let text = draft.text(named, press);
            let supports = parse(&text).map(|case| proposed_supports(&case)).unwrap_or_default();
            let case = parse(&format!("{text}\n{}", supports.tables.join("\n")));
            let Some(words) = refusal(&case) else {
                let are_driven = supports.are_driven;
                let case = finished(&draft, text, &supports, None);
                if !are_driven {
                    return Ok(case);
                }
                carried.get_or_insert(case);
                break;
            };
            let refused = case.map_or_else(|_| Vec::new(), |case| refused_contacts(&case));
            if refused.iter().filter(|(between, why)| draft.guesses.refuse(between, why)).count() == 0 {
                failed.get_or_insert((text, supports, words));
                break;
            }
        }
    }
    if let Some(case) = carried {
        return Ok(case);
    }
    let (text, supports, words) = failed.expect("all have failed");
    let file_prefix = format!("{}: ", file.display());
    let words = words.lines().map(|line| line.trim_start_matches(&file_prefix)).collect::<Vec<_>>().join("\n");
    Ok(finished(&draft, text, &supports, Some(words)))
}

/// A draft with the supports that it wants, and at its top why it does not pass, if so.
fn finished(draft: &Draft, mut text: String, supports: &ProposedSupports, words: Option<String>) -> FirstCase {
    let unheld = draft.proposed_supports(&mut text, supports);
    let mut remarks = draft.remarks();
    let Some(words) = words.or(unheld) else { return FirstCase { text, remarks } };
    remarks.push(format!("the case does not pass `mezha check` yet: {}", words.lines().next().unwrap_or_default()));
    let words: String = words.lines().map(|line| format!("#   {line}\n")).collect();
    let (schema, rest) = text.split_once("\n\n").unwrap_or(("", &text));
    FirstCase { text: format!("{schema}\n\n# This case does not pass `mezha check` yet:\n{words}\n{rest}"), remarks }
}

/// What `check` says against a case.
fn refusal(case: &Result<Case, CaseError>) -> Option<String> {
    match case {
        Ok(case) => check(case).map_or_else(|error| Some(error.to_string()), |checked| checked.not_held),
        Err(error) => Some(error.to_string()),
    }
}

/// The path of a mesh file from the folder of a case, or its name alone where that folder is not known: the case then goes
/// beside the mesh.
pub fn path_from(folder: Option<&Path>, mesh_file: &Path) -> String {
    let absolute =
        |path: &Path| path.canonicalize().or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_path_buf());
    let alone = || mesh_file.file_name().map(PathBuf::from).unwrap_or_default();
    let path = folder.map_or_else(alone, |folder| {
        let (folder, mesh_file) = (absolute(folder), absolute(mesh_file));
        let common = folder.components().zip(mesh_file.components()).take_while(|(a, b)| a == b).count();
        let up = folder.components().skip(common).map(|_| Component::ParentDir);
        up.chain(mesh_file.components().skip(common)).collect()
    });
    path.to_string_lossy().into_owned()
}

/// A name for each group of surfaces that share nodes: that of its surface, or a new one.
fn body_names(groups: &[Vec<String>]) -> Vec<String> {
    let mut names = TableNames::of(groups.iter().flatten().cloned());
    let name = |group: &Vec<String>| match &group[..] {
        [only] => only.clone(),
        many => {
            let is_in_all =
                |&(at, c): &(usize, char)| many.iter().all(|name| name.get(at..).is_some_and(|rest| rest.starts_with(c)));
            let common: String = many[0].char_indices().take_while(is_in_all).map(|(_, c)| c).collect();
            let common = common.trim_end_matches(['.', '_', '-', ' ']);
            names.fresh(if common.is_empty() { "body" } else { common })
        }
    };
    groups.iter().map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mesh_is_named_from_the_folder_of_the_case() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let place = |name: &str| folder.path().join(name);
        std::fs::create_dir(place("mine")).expect("a folder");
        std::fs::write(place("mine/a.msh"), "").expect("a file");
        let from = |at: Option<&str>| path_from(at.map(place).as_deref(), &place("mine/a.msh"));
        assert_eq!([from(None), from(Some("mine")), from(Some(""))], ["a.msh", "a.msh", "mine/a.msh"]);
        assert_eq!(path_from(Some(&place("mine")), &place("b.msh")), "../b.msh");
    }

    #[test]
    fn parts_of_one_body_have_a_name_in_common() {
        let names = |groups: &[&[&str]]| {
            body_names(&groups.iter().map(|group| group.iter().map(|name| (*name).to_owned()).collect()).collect::<Vec<_>>())
        };
        assert_eq!(names(&[&["block"], &["shaft.core", "shaft.film"]]), ["block", "shaft"]);
        assert_eq!(names(&[&["core", "film"], &["a", "b"]]), ["body", "body-2"]);
    }
}
