//! The folder of a study: its tables and figures, and under `runs` the result of each run beside a record of it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, DirEntry, File, TryLockError};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::case::Inputs;
use crate::output::summary::read_summary;
use crate::output::{OutputError, RunError, entries, remove_if_there};
use crate::study::runs::ended::Ended;
use crate::study::runs::record::{Identity, Record};

/// What a whole study leaves, but for the runs; the last one is of older versions, which called the page so.
const TABLES: [&str; 8] =
    ["study.csv", "study.json", "study.md", "study_figure.svg", "study.svg", "study_all.svg", "report.html", "study.html"];
const RUNS: &str = "runs";
/// Held by the program, and by the run that it has started, as long as one of them lives.
const LOCK: &str = ".lock";

/// The folder of a study, which is this program's as long as this value lives.
pub struct Folder {
    out: PathBuf,
    lock: File,
    records: BTreeMap<usize, Record>,
}

/// Where the result of a run belongs.
#[derive(Clone, Debug)]
pub struct ResultPlace {
    /// Number of the result under `runs`.
    pub number: usize,
    /// The run, if it has been made.
    pub kept: Option<Ended>,
    /// Whether it was made before and has to be made again.
    pub again: bool,
}

/// A run that is asked for.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Fingerprints of what the run is made of.
    pub identity: Identity,
    /// The run in words: its case file and what is set in it.
    pub what: String,
    /// What of it the run has to find again.
    pub inputs: Inputs,
}

impl Folder {
    /// Opens the folder of a study, or makes it. With `force` it forgets what an older study has left there; other files stay.
    ///
    /// # Errors
    /// It holds another study, is in use or no folder, or the operating system refuses.
    pub fn open(out: &Path, study: &str, force: bool) -> Result<Self, RunError> {
        if out.exists() && !out.is_dir() {
            return Err(OutputError::NotAFolder(out.into()).into());
        }
        let runs = out.join(RUNS);
        fs::create_dir_all(&runs).map_err(OutputError::io("create the folder", &runs))?;
        let mut folder = Self { out: out.into(), lock: lock(out)?, records: BTreeMap::new() };
        if force {
            folder.forget()?;
        }
        folder.records = read_records(&runs)?;
        folder.refuse_others(study)?;
        Ok(folder)
    }

    /// A study of another name is not mixed with this one, nor one without records, which an older mezha has made.
    fn refuse_others(&self, study: &str) -> Result<(), RunError> {
        let other = match self.records.values().find(|record| record.study != study) {
            Some(record) => format!("the study {}", record.study),
            None if self.records.is_empty() && TABLES.iter().any(|name| self.out.join(name).exists()) => {
                "a result, or an older study".into()
            }
            None => return Ok(()),
        };
        let words = "choose another folder with --out, or replace it with --force";
        Err(RunError::Input(format!("`{}` holds {other}; {words}", self.out.display())))
    }

    /// Removes tables, results and records.
    fn forget(&self) -> Result<(), OutputError> {
        self.remove_tables()?;
        numbered(&self.out.join(RUNS))?.iter().try_for_each(|(_, path)| remove_if_there(path))
    }

    /// Finds the runs that have been made, and a place for each of the others: that of an older run of the same words, or the
    /// next free one.
    pub fn places(&self, wanted: &[Wanted], timeout: Duration) -> Vec<ResultPlace> {
        let mut taken = BTreeSet::new();
        let mut places: Vec<Option<ResultPlace>> = vec![None; wanted.len()];
        for (place, wanted) in places.iter_mut().zip(wanted) {
            let same =
                self.records.iter().filter(|(number, record)| !taken.contains(*number) && record.identity == wanted.identity);
            let kept = |record: &Record, number| record.kept(read_summary(&self.result(number)), timeout, &result_name(number));
            let found = same.map(|(&number, record)| (number, kept(record, number))).find(|(_, ended)| ended.is_some());
            if let Some((number, kept)) = found {
                taken.insert(number);
                *place = Some(ResultPlace { number, kept, again: false });
            }
        }
        let is_same = |record: &Record, wanted: &Wanted| {
            let (a, b) = (&record.identity, &wanted.identity);
            record.what == wanted.what && (a.ranks, a.repeat) == (b.ranks, b.repeat)
        };
        for (place, wanted) in places.iter_mut().zip(wanted).filter(|(place, _)| place.is_none()) {
            let older = self.records.iter().find(|(number, record)| !taken.contains(*number) && is_same(record, wanted));
            let free = || (1..).find(|number| !taken.contains(number) && !self.records.contains_key(number));
            let number = older.map(|(&number, _)| number).or_else(free).expect("numbers do not end");
            taken.insert(number);
            *place = Some(ResultPlace { number, kept: None, again: older.is_some() });
        }
        places.into_iter().flatten().collect()
    }

    /// The folder of a result.
    pub fn result(&self, number: usize) -> PathBuf {
        self.out.join(result_name(number))
    }

    /// The lock, for a run to hold: then nobody makes the study while a run of it is left behind.
    pub fn lock(&self) -> Option<File> {
        self.lock.try_clone().ok()
    }

    /// Keeps a record of a run that has ended.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn keep(&self, number: usize, record: &Record) -> Result<(), OutputError> {
        let path = self.result(number).with_extension("json");
        let text = serde_json::to_string_pretty(record).map_err(|error| OutputError::io("write", &path)(error.into()))?;
        write_whole(&path, &(text + "\n"))
    }

    /// Makes room for a run: what an older one has left under its number goes, the record first.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn clear(&self, number: usize) -> Result<(), OutputError> {
        let result = self.result(number);
        let all = [result.with_extension("json"), result.with_extension("stderr"), result];
        all.iter().try_for_each(|path| remove_if_there(path))?;
        // All that live in the folder have locked it: what is half done is of nobody.
        let hidden = |path: &PathBuf| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'));
        let mut left = numbered(&self.out.join(RUNS))?.into_iter().filter(|(other, path)| *other == number && hidden(path));
        left.try_for_each(|(_, path)| remove_if_there(&path))
    }

    /// Removes the tables and figures: what they say is about to change.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn remove_tables(&self) -> Result<(), OutputError> {
        TABLES.iter().try_for_each(|name| remove_if_there(&self.out.join(name)))
    }

    /// Writes tables and figures, each whole or not at all, and removes those that there are none of.
    ///
    /// # Errors
    /// The operating system refuses.
    pub fn write_tables(&self, texts: &[(&str, String)]) -> Result<(), OutputError> {
        for name in TABLES.iter().filter(|name| texts.iter().all(|(written, _)| written != *name)) {
            remove_if_there(&self.out.join(name))?;
        }
        texts.iter().try_for_each(|(name, text)| write_whole(&self.out.join(name), text))
    }
}

/// Name of a result in the folder of the study.
pub fn result_name(number: usize) -> String {
    format!("{RUNS}/{number:03}")
}

/// Takes the folder for this program. Where the file system has no locks, nothing is locked.
fn lock(out: &Path) -> Result<File, RunError> {
    let path = out.join(LOCK);
    let opened = File::options().read(true).write(true).create(true).truncate(false).open(&path);
    let file = opened.map_err(OutputError::io("open", &path))?;
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => {
            let words = "is in use by another `mezha study`, or by a run that one has left behind; wait for it, or end it";
            Err(RunError::Input(format!("`{}` {words}", out.display())))
        }
        Ok(()) | Err(TryLockError::Error(_)) => Ok(file),
    }
}

/// What the folder of the runs holds under numbers, also half done.
fn numbered(runs: &Path) -> Result<Vec<(usize, PathBuf)>, OutputError> {
    let number = |entry: DirEntry| {
        let name = entry.file_name().to_string_lossy().into_owned();
        Some((name.trim_start_matches('.').split('.').next()?.parse().ok()?, entry.path()))
    };
    Ok(entries(runs)?.into_iter().filter_map(number).collect())
}

/// The records of all runs. One that cannot be read is none: its run is made again.
fn read_records(runs: &Path) -> Result<BTreeMap<usize, Record>, OutputError> {
    let files = numbered(runs)?.into_iter().filter(|(_, path)| path.extension().is_some_and(|extension| extension == "json"));
    let read = |path: &Path| fs::read_to_string(path).ok().and_then(|text| serde_json::from_str(&text).ok());
    Ok(files.filter_map(|(number, path)| Some((number, read(&path)?))).collect())
}

/// Writes a file that appears whole or not at all.
fn write_whole(path: &Path, text: &str) -> Result<(), OutputError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let temporary = path.with_file_name(format!(".{name}.partial"));
    fs::write(&temporary, text).map_err(OutputError::io("write", &temporary))?;
    fs::rename(&temporary, path).map_err(OutputError::io("make", path))
}

#[cfg(test)]
mod tests;
