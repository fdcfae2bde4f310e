//! PETSc's options: mezha sets defaults, the user has the last word.

use super::error::{Result, petsc, words};
use super::session::{Session, is_name};
use std::ffi::{CString, c_char};
use std::ptr;

/// Beginnings of options that PETSc reads only at its end, and of those of a later solver.
const READ_LATER: [&str; 7] = ["-log_", "-malloc_", "-objects_", "-options_", "-memory_", "-no_signal_handler", "-inf_sup_"];

/// Options that every session is started with.
const STARTED_WITH: [&str; 2] = ["-no_signal_handler", "-options_left"];

/// Parts of options that PETSc reads only in a solve.
const READ_IN_SOLVES: [&str; 2] = ["converged_reason", "_view"];

/// Whether an option may be unread before the first solve.
fn is_read_later(name: &str) -> bool {
    let name = name.to_lowercase();
    READ_LATER.iter().any(|start| name.starts_with(start)) || READ_IN_SOLVES.iter().any(|part| name.contains(part))
}

/// Sets option `name` (`"-ksp_type"`) to `value`, unless the user has set it; an empty value stands for a bare flag.
pub fn set_default(session: &Session, name: &str, value: &str) -> Result<()> {
    let is_of_user = !session.defaults().borrow().contains(&name.to_lowercase()) && get(session, name).is_some();
    if is_of_user {
        return Ok(());
    }
    let (key, text) = (c_string(name), c_string(value));
    petsc!(PetscOptionsSetValue(ptr::null_mut(), key.as_ptr(), text.as_ptr()))?;
    session.defaults().borrow_mut().insert(name.to_lowercase());
    Ok(())
}

/// Takes back a default that [`set_default`] or the start has set; a value of the user's stays.
pub fn clear(session: &Session, name: &str) -> Result<()> {
    if session.defaults().borrow_mut().remove(&name.to_lowercase()) {
        petsc!(PetscOptionsClearValue(ptr::null_mut(), c_string(name).as_ptr()))?;
    }
    Ok(())
}

/// Value of option `name`, empty for a bare flag; `None` if nobody has set it. Does not count as a use of the option.
pub fn get(_session: &Session, name: &str) -> Option<String> {
    all().into_iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, value)| value)
}

/// Whether the user has set some option whose name is like this.
pub fn any_of_user(session: &Session, is_like: impl Fn(&str) -> bool) -> bool {
    let names = all().into_iter().map(|(name, _)| name.to_lowercase());
    names.filter(|name| !session.defaults().borrow().contains(name)).any(|name| is_like(&name))
}

/// Options of the user's, each as `-name value`: from the command line, the environment or a file that PETSc reads.
pub fn of_user(session: &Session) -> Vec<String> {
    let defaults = session.defaults().borrow();
    let is_own = |name: &String| defaults.contains(&name.to_lowercase()) || STARTED_WITH.contains(&name.as_str());
    all().into_iter().filter(|(name, _)| !is_own(name)).map(in_words).collect()
}

/// An option as `-name value`, or as a bare flag.
fn in_words((name, value): (String, String)) -> String {
    format!("{name} {value}").trim_end().to_owned()
}

/// Options of the user's that no object has asked for so far, each as `-name value`: a typing mistake is among them.
/// Options that PETSc reads only at its end are left out.
pub fn unused(session: &Session) -> Result<Vec<String>> {
    let mut count = 0;
    let (mut names, mut values): (*mut *mut c_char, *mut *mut c_char) = (ptr::null_mut(), ptr::null_mut());
    petsc!(PetscOptionsLeftGet(ptr::null_mut(), &mut count, &mut names, &mut values))?;
    let left: Vec<(String, String)> =
        (0..count as usize).map(|i| unsafe { (format!("-{}", words(*names.add(i))), words(*values.add(i))) }).collect();
    petsc!(PetscOptionsLeftRestore(ptr::null_mut(), &mut count, &mut names, &mut values))?;
    let defaults = session.defaults().borrow();
    let is_expected = |name: &str| defaults.contains(&name.to_lowercase()) || is_read_later(name);
    Ok(left.into_iter().filter(|(name, _)| !is_expected(name)).map(in_words).collect())
}

/// All options that are set, with their values.
fn all() -> Vec<(String, String)> {
    let mut text: *mut c_char = ptr::null_mut();
    petsc!(PetscOptionsGetAll(ptr::null_mut(), &mut text)).expect("PETSc lists its options");
    let line = words(text);
    petsc!(mezha_free(text.cast())).expect("PETSc takes back what it lists");
    let mut options: Vec<(String, String)> = Vec::new();
    for word in line.split_whitespace() {
        match options.last_mut() {
            Some((_, value)) if !is_name(word) => {
                *value = format!("{value} {word}").trim_start().to_owned();
            }
            _ => options.push((word.to_owned(), String::new())),
        }
    }
    options
}

fn c_string(text: &str) -> CString {
    CString::new(text).expect("an option has no zero byte")
}
