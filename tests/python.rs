//! `python/mezha.py` with its own tests, and the tutorial. The script for ParaView is only compiled: it needs ParaView itself.
//!
//! Set `MEZHA_PYTHON` to an interpreter with numpy, matplotlib, nbclient and ipykernel; without it the tests say so and check
//! nothing.

use std::path::Path;
use std::process::Command;

/// Runs Python in the folder `python`, if there is one; it must end well.
fn python(words: &[&str]) {
    let Some(python) = std::env::var_os("MEZHA_PYTHON") else {
        println!("skipped: MEZHA_PYTHON is not set, so nothing was run");
        return;
    };
    let mut command = Command::new(python);
    command.args(words).current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("python"));
    command.env("MEZHA", env!("CARGO_BIN_EXE_mezha")).env("PYTHONDONTWRITEBYTECODE", "1");
    for name in ["OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMP_NUM_THREADS"] {
        command.env(name, "1");
    }
    let ended = command.output().expect("Python starts");
    let said = [ended.stdout, ended.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(ended.status.success(), "{said}");
}

#[test]
fn the_module_keeps_its_word() {
    python(&["-m", "unittest", "-q"]);
}

/// All cells of the notebook run, one after the other.
#[test]
fn the_tutorial_runs() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let script = "import sys, nbformat, nbclient\n\
        notebook = nbformat.read('tutorial.ipynb', 4)\n\
        nbclient.NotebookClient(notebook, timeout=300, kernel_name='python3').execute()\n\
        cells = [cell for cell in notebook.cells if cell.cell_type == 'code']\n\
        assert len(cells) > 4 and any('image/png' in out.get('data', {}) for cell in cells for out in cell.outputs)\n";
    let file = folder.path().join("execute.py");
    std::fs::write(&file, script).expect("a file");
    python(&[file.to_str().expect("a path")]);
}

#[test]
fn the_script_for_paraview_compiles() {
    python(&["-c", "compile(open('paraview_contact.py').read(), 'paraview_contact.py', 'exec')"]);
}
