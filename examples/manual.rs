//! Writes the man pages and the shell completions of `mezha` into a folder, as packages take them:
//!
//! ```text
//! cargo run --release --example manual -- DIR
//! ```
//!
//! `DIR/man1` is for `share/man/man1`; `DIR/bash/mezha` is for `share/bash-completion/completions`, `DIR/zsh/_mezha` for
//! `share/zsh/site-functions`, `DIR/fish/mezha.fish` for `share/fish/vendor_completions.d`.

use clap::{Command, CommandFactory};
use clap_complete::Shell;
use clap_mangen::Man;
use clap_mangen::roff::{Roff, roman};
use mezha::arguments::Arguments;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let folder = env::args_os().nth(1).map(PathBuf::from);
    write(&folder.ok_or_else(|| io::Error::other("name the folder: cargo run --release --example manual -- DIR"))?)
}

/// One page for `mezha` and one for each of its commands; completions for three shells.
fn write(folder: &Path) -> io::Result<()> {
    let mut mezha = Arguments::command().disable_help_subcommand(true);
    for (shell, name) in [(Shell::Bash, "bash"), (Shell::Zsh, "zsh"), (Shell::Fish, "fish")] {
        let place = folder.join(name);
        fs::create_dir_all(&place)?;
        clap_complete::generate_to(shell, &mut mezha, "mezha", &place)?;
    }
    fs::rename(folder.join("bash/mezha.bash"), folder.join("bash/mezha"))?;

    let pages = folder.join("man1");
    fs::create_dir_all(&pages)?;
    mezha.build();
    let commands = mezha.get_subcommands().filter(|command| !command.is_hide_set());
    [&mezha].into_iter().chain(commands).try_for_each(|command| fs::write(pages.join(name(command) + ".1"), page(command)?))
}

/// `mezha-run` for the command `run`.
fn name(command: &Command) -> String {
    command.get_display_name().unwrap_or(command.get_name()).to_owned()
}

/// A page; what the help says at its end keeps its lines.
fn page(command: &Command) -> io::Result<Vec<u8>> {
    let man = Man::new(command.clone()).title(name(command)).source(concat!("mezha ", env!("CARGO_PKG_VERSION"))).manual("mezha");
    let mut page = Vec::new();
    man.render_title(&mut page)?;
    man.render_name_section(&mut page)?;
    man.render_synopsis_section(&mut page)?;
    man.render_description_section(&mut page)?;
    man.render_options_section(&mut page)?;
    if command.has_subcommands() {
        man.render_subcommands_section(&mut page)?;
    }
    if let Some(words) = command.get_after_help() {
        let mut section = Roff::new();
        section.control("SH", ["EXAMPLES AND EXIT CODES"]).control("nf", []).text([roman(words.to_string())]).control("fi", []);
        section.to_writer(&mut page)?;
    }
    Ok(page)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process;

    fn written() -> tempfile::TempDir {
        let folder = tempfile::tempdir().expect("a temporary folder");
        write(folder.path()).expect("pages and completions");
        folder
    }

    #[test]
    fn every_command_has_a_page_that_tells_its_options() {
        let folder = written();
        let page = |name: &str| fs::read_to_string(folder.path().join("man1").join(name)).expect("a page");
        let whole = page("mezha.1");
        for command in Arguments::command().get_subcommands().filter(|command| !command.is_hide_set()) {
            let own = page(&format!("mezha-{}.1", command.get_name()));
            assert!(whole.contains(&format!("mezha\\-{}(1)", command.get_name())), "{whole}");
            for option in command.get_arguments().filter(|option| !option.is_hide_set()) {
                let told = option.get_long().map_or(option.get_id().as_str().to_uppercase(), |long| format!("\\-\\-{long}"));
                assert!(own.to_uppercase().contains(&told.to_uppercase()) || option.is_positional(), "{told} in {own}");
            }
            assert!(!own.contains("\\-\\-inputs"), "what is for mezha itself is not told: {own}");
        }
        assert!(whole.contains(".nf\nExamples:\n") && page("mezha-run.1").contains("\nExit codes:\n"), "{whole}");
    }

    #[test]
    fn bash_completes_commands_and_options() {
        let folder = written();
        for (words, expected) in [("mezha ru", "run"), ("mezha run --fo", "--force"), ("mezha st", "study")] {
            let count = words.split(' ').count();
            let script = format!(
                "source {}/bash/mezha; COMP_WORDS=({words}); COMP_CWORD={}; _mezha mezha {} {}; echo ${{COMPREPLY[*]}}",
                folder.path().display(),
                count - 1,
                words.rsplit(' ').next().unwrap_or_default(),
                words.split(' ').nth(count - 2).unwrap_or_default(),
            );
            let output = process::Command::new("bash").args(["-c", &script]).output().expect("bash");
            assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), expected, "{}", String::from_utf8_lossy(&output.stderr));
        }
    }
}
