//! Which files of a folder its result has written: all others are the user's.

use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::entries::entries;
use crate::output::error::OutputError;

/// The file that makes a folder a result.
pub const SUMMARY: &str = "summary.json";

/// Names of the files of a result, relative to its folder.
#[derive(Debug, Default)]
pub struct OwnFiles(pub BTreeSet<PathBuf>);

impl OwnFiles {
    /// The files that the summary in a folder lists; None if there is no summary of mezha.
    pub fn of(folder: &Path) -> Option<Self> {
        let text = fs::read(folder.join(SUMMARY)).ok()?;
        let summary: Value = serde_json::from_slice(&text).ok()?;
        let is_text = |key: &str| summary.get(key).is_some_and(Value::is_string);
        if !is_text("mezha") || !is_text("status") {
            return None;
        }
        let mut names = match summary.get("files").and_then(Value::as_array) {
            Some(list) => list.iter().filter_map(Value::as_str).map(String::from).collect(),
            None => names_without_list(&summary),
        };
        names.push(SUMMARY.into());
        Some(Self(names.into_iter().map(PathBuf::from).collect()))
    }

    /// Their names.
    pub fn names(&self) -> impl Iterator<Item = &PathBuf> {
        self.0.iter()
    }

    /// Whether the result has written the file of this name.
    pub fn has(&self, name: &Path) -> bool {
        self.0.contains(name)
    }

    /// Whether the result has written a file in the folder of this name.
    pub fn has_within(&self, folder: &Path) -> bool {
        self.0.iter().any(|name| name.starts_with(folder))
    }

    /// The same without one file, which is kept.
    pub fn without(mut self, name: &Path) -> Self {
        self.0.remove(name);
        self
    }
}

/// Names of all files in a folder and in those within, relative to it, sorted.
///
/// # Errors
/// The operating system refuses.
pub fn names_within(folder: &Path) -> Result<Vec<String>, OutputError> {
    let mut names = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(inner) = folders.pop() {
        for entry in entries(&folder.join(&inner))? {
            let name = inner.join(entry.file_name());
            if entry.path().is_dir() { folders.push(name) } else { names.push(name.to_string_lossy().into_owned()) }
        }
    }
    names.sort();
    Ok(names)
}

/// The names that follow from a summary of an older version, which has no list.
fn names_without_list(summary: &Value) -> Vec<String> {
    let count = |pointer: &str| summary.pointer(pointer).and_then(Value::as_array).map_or(0, Vec::len);
    let contacts = summary.get("contact").and_then(Value::as_object);
    let contacts: Vec<&String> = contacts.into_iter().flat_map(|contacts| contacts.keys()).collect();
    let ranks = summary.get("ranks").and_then(Value::as_u64).unwrap_or(1);
    let mut fields = match ranks {
        0 | 1 => vec!["fields.vtu".to_string()],
        _ => (0..ranks).map(|rank| format!("fields_{rank:04}.vtu")).chain(["fields.pvtu".into()]).collect(),
    };
    fields.extend(contacts.iter().flat_map(|name| ["csv", "vtu"].map(|ending| format!("contact_{name}.{ending}"))));
    let steps = (1..=count("/steps")).flat_map(|step| {
        let names = fields.iter().map(String::as_str).chain(["case.toml"]);
        names.map(move |name| format!("steps/{step:04}/{name}")).collect::<Vec<_>>()
    });
    let mut names: Vec<String> = steps.collect();
    names.extend(["case.toml", "deformed.svg"].map(String::from));
    for (key, files) in [
        ("/provenance/mesh_hash", &["case.msh", "report.html"][..]),
        ("/accuracy", &["adapted.msh", "accuracy.svg"]),
        ("/steps", &["steps.csv", "steps.svg", "fields.pvd"]),
    ] {
        let is_told = summary.pointer(key).is_some_and(|value| !value.is_null());
        names.extend(files.iter().filter(|_| is_told).map(|name| name.to_string()));
    }
    for name in contacts {
        names.extend(["pressure", "gap", "displacement"].map(|figure| format!("{figure}_{name}.svg")));
        let zones = summary.get("contact").and_then(|all| all[name.as_str()]["zones"].as_array()).map_or(0, Vec::len);
        names.extend((1..=zones).map(|number| format!("deformed_{name}_{number}.svg")));
        names.extend((count("/steps") > 0).then(|| format!("contact_{name}.pvd")));
    }
    names.extend(fields);
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_summary_of_mezha_makes_a_result() {
        let folder = tempfile::tempdir().unwrap();
        for text in ["[1,2,3]", "{}", "", r#"{"mezha": "0.1"}"#, r#"{"mezha": 1, "status": "converged"}"#] {
            fs::write(folder.path().join(SUMMARY), text).unwrap();
            assert!(OwnFiles::of(folder.path()).is_none(), "{text}");
        }
        fs::write(folder.path().join(SUMMARY), r#"{"mezha": "0.1", "status": "converged", "files": ["steps/0001/a.csv"]}"#)
            .unwrap();
        let own = OwnFiles::of(folder.path()).unwrap();
        assert!(["summary.json", "steps/0001/a.csv"].iter().all(|name| own.has(Path::new(name))));
        assert!(own.has_within(Path::new("steps")) && !own.has_within(Path::new("step")) && !own.has(Path::new("case.toml")));
    }

    #[test]
    fn names_of_older_results_follow_from_what_they_tell() {
        let contact = json!({"seam": {"zones": [{}, {}]}});
        let names = |summary: Value| {
            let mut names = names_without_list(&summary);
            names.sort();
            names.join(" ")
        };
        let alone = json!({"ranks": 1, "contact": contact});
        assert_eq!(
            names(alone),
            "case.toml contact_seam.csv contact_seam.vtu deformed.svg deformed_seam_1.svg deformed_seam_2.svg displacement_seam.svg fields.vtu gap_seam.svg pressure_seam.svg"
        );
        let all = names(json!({"ranks": 2, "contact": contact, "accuracy": [], "steps": [{}], "provenance": {"mesh_hash": "a"}}));
        for name in
            ["fields_0001.vtu", "fields.pvtu", "adapted.msh", "case.msh", "steps/0001/fields_0000.vtu", "contact_seam.pvd"]
        {
            assert!(all.split(' ').any(|other| other == name), "{name}: {all}");
        }
        assert!(!all.contains("fields.vtu") && !all.contains("0002"), "{all}");
    }
}
