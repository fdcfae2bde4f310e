//! What runs leave beside their results: for a while each, and for ever if they are killed.

use std::fs::{self, File, Permissions, TryLockError};
use std::hash::{BuildHasher, Hasher, RandomState};
use std::io::{self, ErrorKind};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use rustix::io::Errno;
use rustix::process::{Pid, test_kill_process};
use rustix::system::uname;

use super::own_files::{OwnFiles, entries};
use crate::output::error::OutputError;

/// Ending of a result under construction, or of one that it has just replaced.
const PARTIAL: &str = "partial";
/// Ending of a result that is being replaced, where that takes two steps.
const OLD: &str = "old";
/// What the owner of a folder needs to change it.
const OWNER: u32 = 0o700;

/// A hidden folder beside a target, and who has made it.
struct Leftover {
    path: PathBuf,
    host: String,
    process: i32,
    is_old: bool,
}

/// Makes a hidden folder beside `out` that nobody else has, with all folders above it: `.bars.HOST-PROCESS-NUMBER.partial` for
/// `bars`. Its path begins at the root. With it the folders above that were not there, from the inside out.
///
/// # Errors
/// The operating system refuses.
pub fn make_hidden(out: &Path) -> io::Result<(PathBuf, Vec<PathBuf>)> {
    let out = std::path::absolute(out)?;
    let above: Vec<PathBuf> = out.ancestors().skip(1).take_while(|path| !path.exists()).map(Path::to_path_buf).collect();
    out.parent().map_or(Ok(()), fs::create_dir_all).inspect_err(|_| remove_empty(&above))?;
    loop {
        let number = RandomState::new().build_hasher().finish() as u32;
        let path = out.with_file_name(format!(".{}.{}-{}-{number:08x}.{PARTIAL}", name(&out), host(), std::process::id()));
        match fs::create_dir(&path) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            made => return made.inspect_err(|_| remove_empty(&above)).map(|()| (path, above)),
        }
    }
}

/// Removes folders that nothing has come into.
pub fn remove_empty(folders: &[PathBuf]) {
    // One that holds something, or is gone, stays as it is.
    folders.iter().for_each(|folder| drop(fs::remove_dir(folder)));
}

/// Clears away what killed runs of this host have left beside `out`, and brings back a result that one has set aside. What
/// cannot be cleared stays; so does what another host has left, since nobody can tell here whether its run lives.
pub fn recover(out: &Path) {
    for left in leftovers(out).filter(Leftover::is_dead) {
        // Others may do the same at the same time.
        let _ = match (left.is_old, out.is_dir()) {
            (true, false) => fs::rename(&left.path, out).map_err(OutputError::io("restore", out)),
            (is_old, true) if is_old || OwnFiles::of(&left.path).is_some() => {
                retire(&left.path, out, &OwnFiles::of(&left.path).unwrap_or_default())
            }
            // Without a summary it was never a result.
            _ => fs::remove_dir_all(&left.path).map_err(OutputError::io("remove", &left.path)),
        };
    }
}

/// Carries all files that the old result has not written from its folder to the new one, then removes the old folder.
///
/// # Errors
/// The operating system refuses.
pub fn retire(old: &Path, new: &Path, own: &OwnFiles) -> Result<(), OutputError> {
    carry_over(old, new, Path::new(""), own)?;
    fs::remove_dir_all(old).map_err(OutputError::io("remove", old))
}

/// Carries the files within the folder `inner` of an old result to a new one; what the old result has written stays where it is. A
/// file whose name the new result has, too, gets another one.
///
/// # Errors
/// The operating system refuses.
pub fn carry_over(old: &Path, new: &Path, inner: &Path, own: &OwnFiles) -> Result<(), OutputError> {
    let folder = old.join(inner);
    make_writable(&folder);
    for entry in entries(&folder)? {
        let name = inner.join(entry.file_name());
        let (from, to) = (old.join(&name), new.join(&name));
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && (own.has_within(&name) || to.is_dir()) {
            carry_over(old, new, &name, own)?;
        } else if is_folder || !own.has(&name) && !is_equal(&from, &to) {
            let make = || to.parent().map_or(Ok(()), fs::create_dir_all).and_then(|()| rename(&from, &free_name(&to), is_folder));
            make().map_err(OutputError::io("carry over", &from))?;
        }
    }
    Ok(())
}

/// Gives a file or a folder another name. Who owns a folder may do so even if it is read-only.
fn rename(from: &Path, to: &Path, is_folder: bool) -> io::Result<()> {
    match (fs::rename(from, to), from.symlink_metadata()) {
        (Err(error), Ok(before)) if is_folder && error.kind() == ErrorKind::PermissionDenied => {
            make_writable(from);
            fs::rename(from, to)?;
            fs::set_permissions(to, before.permissions())
        }
        (renamed, _) => renamed,
    }
}

/// Lets the owner of a folder change it; where this process must not allow it, the next step tells.
fn make_writable(folder: &Path) {
    if let Ok(found) = folder.metadata()
        && found.permissions().mode() & OWNER != OWNER
    {
        let _ = fs::set_permissions(folder, Permissions::from_mode(found.permissions().mode() | OWNER));
    }
}

/// Whether both are files of the same content.
pub fn is_equal(one: &Path, other: &Path) -> bool {
    let length = |path: &Path| path.symlink_metadata().ok().filter(|found| found.is_file()).map(|found| found.len());
    length(one).is_some()
        && length(one) == length(other)
        && matches!((fs::read(one), fs::read(other)), (Ok(one), Ok(other)) if one == other)
}

/// The path itself, or, where there is something, with `.old`, `.old2` and so on.
pub fn free_name(path: &Path) -> PathBuf {
    let numbered = (1..).map(|number: usize| match number {
        1 => ".old".into(),
        _ => format!(".old{number}"),
    });
    let paths = numbered.map(|ending| path.with_file_name(format!("{}{ending}", name(path))));
    let mut all = [path.to_path_buf()].into_iter().chain(paths);
    all.find(|path| path.symlink_metadata().is_err()).unwrap_or_else(|| path.to_path_buf())
}

/// All hidden folders of runs beside `out`.
fn leftovers(out: &Path) -> impl Iterator<Item = Leftover> {
    let folder = out.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let start = format!(".{}.", name(out));
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    entries.filter_map(move |entry| Leftover::of(entry.path(), &start))
}

impl Leftover {
    /// None if the name is not made as [`make_hidden`] does.
    fn of(path: PathBuf, start: &str) -> Option<Self> {
        let (maker, ending) = name(&path).strip_prefix(start)?.rsplit_once('.').map(|(a, b)| (a.to_owned(), b.to_owned()))?;
        let mut words = maker.rsplitn(3, '-').skip(1);
        let (process, host) = (words.next()?.parse().ok()?, words.next()?.to_owned());
        let is_ours = !host.contains('.') && [PARTIAL, OLD].contains(&ending.as_str());
        is_ours.then(|| Self { path, host, process, is_old: ending == OLD })
    }

    /// Whether its maker is known to live no more: a process of this host that is gone, and has not locked the folder, as one that
    /// is hidden from this process would have.
    fn is_dead(&self) -> bool {
        let is_gone = Pid::from_raw(self.process).is_some_and(|process| test_kill_process(process) == Err(Errno::SRCH));
        let is_locked = || File::open(&self.path).is_ok_and(|it| matches!(it.try_lock(), Err(TryLockError::WouldBlock)));
        self.host == host() && is_gone && !is_locked()
    }
}

/// The last name of a path.
fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Name of this host, as far as a file name takes it.
fn host() -> String {
    let name = uname().nodename().to_string_lossy().into_owned();
    name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect()
}

#[cfg(test)]
mod tests {
    use super::super::own_files::names_within;
    use super::*;
    use serde_json::json;
    use std::process::Command;

    /// A process that was there once.
    fn gone() -> u32 {
        let mut child = Command::new("true").spawn().unwrap();
        child.wait().unwrap();
        child.id()
    }

    /// Folders beside the target `bars`, each with a summary that says its name, and what is left of them.
    fn recovered(target: Option<&str>, folders: &[String]) -> (Vec<String>, Option<String>) {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("bars");
        for folder in folders.iter().map(String::as_str).chain(target) {
            fs::create_dir(root.path().join(folder)).unwrap();
            fs::write(root.path().join(folder).join("summary.json"), folder).unwrap();
        }
        recover(&out);
        let entries = fs::read_dir(root.path()).unwrap();
        let mut names: Vec<String> = entries.map(|entry| name(&entry.unwrap().path())).filter(|name| name != "bars").collect();
        names.sort();
        (names, fs::read_to_string(out.join("summary.json")).ok())
    }

    #[test]
    fn the_dead_are_cleared_away_and_no_others() {
        let (gone, here) = (gone(), host());
        let dead = format!(".bars.{here}-{gone}-00000001.partial");
        let mut kept = vec![
            format!(".bars.{here}-{}-00000002.partial", std::process::id()),
            format!(".bars.elsewhere-{gone}-00000003.partial"),
            format!(".bars.x.{here}-{gone}-00000004.partial"),
            ".bars.partial".into(),
            format!(".bars.{here}-{gone}-00000005.mine"),
            format!(".barsx.{here}-{gone}-00000006.partial"),
        ];
        kept.sort();
        let all: Vec<String> = kept.iter().cloned().chain([dead]).collect();
        assert_eq!(recovered(None, &all), (kept.clone(), None));
        assert_eq!(recovered(Some("bars"), &all), (kept, Some("bars".into())));
    }

    #[test]
    fn a_result_that_was_set_aside_comes_back() {
        let old = format!(".bars.{}-{}-00000001.old", host(), gone());
        assert_eq!(recovered(None, std::slice::from_ref(&old)), (vec![], Some(old.clone())));
        assert_eq!(recovered(Some("bars"), &[old]), (vec![], Some("bars".into())));
    }

    #[test]
    fn a_folder_that_is_locked_has_somebody() {
        let root = tempfile::tempdir().unwrap();
        let path = root.path().join(format!(".bars.{}-{}-00000001.partial", host(), gone()));
        fs::create_dir(&path).unwrap();
        let lock = File::open(&path).unwrap();
        lock.lock().unwrap();
        recover(&root.path().join("bars"));
        assert!(path.exists());
        drop(lock);
        // A program that another test begins at this moment has the lock, too, until it runs.
        let is_gone = |_: &u32| {
            recover(&root.path().join("bars"));
            std::thread::sleep(std::time::Duration::from_millis(20));
            !path.exists()
        };
        assert!((0..50).any(|time| is_gone(&time)));
    }

    /// Folders may be read-only, and names resemble those of results.
    #[test]
    fn what_the_result_has_not_written_is_carried_over() {
        let root = tempfile::tempdir().unwrap();
        let [old, new] = ["old", "new"].map(|folder| root.path().join(folder));
        let own = ["summary.json", "case.toml", "steps/0001/contact_a.csv", "contact_a.csv"];
        let mine = [
            "case_mine.toml",
            "contact_measured.csv",
            "deformed_paper.svg",
            "steps/mine.txt",
            "paper/case.toml",
            "case.msh",
            "same",
        ];
        for name in own.iter().chain(&mine) {
            fs::create_dir_all(old.join(name).parent().unwrap()).unwrap();
            fs::write(old.join(name), name).unwrap();
        }
        fs::write(old.join("summary.json"), json!({"mezha": "0", "status": "converged", "files": own}).to_string()).unwrap();
        for folder in ["steps/0001", "steps", "paper", ""] {
            fs::set_permissions(old.join(folder), Permissions::from_mode(0o555)).unwrap();
        }
        fs::create_dir_all(&new).unwrap();
        [("case.toml", "new"), ("case.msh", "new"), ("same", "same")]
            .iter()
            .for_each(|(name, text)| fs::write(new.join(name), text).unwrap());
        retire(&old, &new, &OwnFiles::of(&old).unwrap()).unwrap();
        let mut expected = mine.map(|name| if name == "case.msh" { "case.msh.old" } else { name }).to_vec();
        expected.extend(["case.toml", "case.msh"]);
        expected.sort();
        assert_eq!(names_within(&new).unwrap(), expected);
        let read = |name: &str| fs::read_to_string(new.join(name)).unwrap();
        assert_eq!([read("case.msh.old"), read("case.msh"), read("case.toml")], ["case.msh", "new", "new"]);
        assert_eq!(new.join("paper").metadata().unwrap().permissions().mode() & 0o777, 0o555);
        assert!(!old.exists());
        make_writable(&new.join("paper"));
    }

    #[test]
    fn names_are_of_one_run_each() {
        let root = tempfile::tempdir().unwrap();
        let out = root.path().join("deep/bars");
        let [(a, above), (b, none)] = [0, 1].map(|_| make_hidden(&out).unwrap());
        assert_eq!((above, none), (vec![root.path().join("deep")], vec![]));
        assert!(a != b && a.is_absolute() && a.is_dir() && b.is_dir());
        assert_eq!(leftovers(&out).filter(|left| left.process as u32 == std::process::id()).count(), 2);
    }
}
