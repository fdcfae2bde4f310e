//! The command line of `mezha`. A usage error ends with exit code 2, as clap has it.

use std::path::{Path, PathBuf};

use clap::error::{ContextKind, ContextValue};
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};

use crate::geometry::Quote;
use crate::petsc::is_name;

/// Exit codes, and where the rest is told.
const AFTERWORD: &str = "
Exit codes:
  0  converged, and every expected value that must hold does
  1  a failure of the program, PETSc or MPI, or a signal
  2  bad input; nothing is written
  3  not converged, a body that nothing holds, or an expected value missed

The keys of a case: docs/case.md, in packages below /usr/share/doc/mezha";

const EXAMPLES: &str = "\
Examples:
  mezha new part.msh > case.toml               a first case from a mesh
  mezha check cases/bars_inclined              what would be solved, and a figure of it
  mezha run cases/bars_inclined                solve it on one rank, with results in out/bars_inclined
  mpirun -n 4 mezha run cases/bars_inclined    solve it on four
";

const RUN_EXAMPLES: &str = "\
Examples:
  mezha run cases/bars_inclined
  mezha run cases/bars_inclined --set mesh.refine=5 --out finer
  mezha run cases/bars_inclined --force -- -log_view
  mpirun -n 4 mezha run cases/bars_inclined
";

/// Parallel contact of elastic bodies on a contact boundary of its own.
#[derive(Clone, Debug, Parser, PartialEq, Eq)]
#[command(name = "mezha", version, arg_required_else_help = true, after_help = format!("{EXAMPLES}{AFTERWORD}"))]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What mezha can do.
#[derive(Clone, Debug, PartialEq, Eq, Subcommand)]
pub enum Command {
    /// Solve a case and write its results; start it under mpirun for several ranks
    #[command(after_help = format!("{RUN_EXAMPLES}{AFTERWORD}"))]
    Run(RunArguments),
    /// Read everything, solve nothing, say what would be solved, and draw it
    Check(CheckArguments),
    /// Write a first case for a mesh to standard output
    New {
        /// The mesh file
        #[arg(value_name = "MESH.msh")]
        mesh: PathBuf,
    },
    /// Make every run of a grid that is not made yet, each a row of one table; start it without mpirun
    Study(Study),
    /// Print the JSON Schema of case files or study files, for editors and other programs
    Schema {
        /// Which files
        #[arg(value_enum, default_value_t = FileKind::Case)]
        kind: FileKind,
    },
    /// Print versions of mezha, PETSc, MPI and BLAS, and the number of ranks
    Info,
}

/// Which case, with which changes.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct CaseArguments {
    /// The case file, or its folder if it is called case.toml
    #[arg(value_name = "CASE.toml")]
    pub case: PathBuf,
    /// Override a key of the case, as in body.upper.young=7e6; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
}

/// Arguments of `mezha check`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct CheckArguments {
    /// The case.
    #[command(flatten)]
    pub case: CaseArguments,
    /// The figure of bodies, supports, loads and contacts; by default out/NAME.check.svg, NAME the folder of the case
    #[arg(long, value_name = "FILE.svg")]
    pub draw: Option<PathBuf>,
}

/// Arguments of `mezha run`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct RunArguments {
    /// The case.
    #[command(flatten)]
    pub case: CaseArguments,
    /// Folder of the results; by default out/NAME, NAME the folder of the case
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Overwrite a folder that holds a result
    #[arg(long)]
    pub force: bool,
    /// Fingerprints of case file and mesh: a run that finds others ends (for `mezha study`)
    #[arg(long, hide = true, value_name = "CASE:MESH")]
    pub inputs: Option<String>,
    /// Print errors only
    #[arg(long)]
    pub quiet: bool,
    /// Show on standard error where a long run is, in a line that is rewritten
    #[arg(long, value_enum, value_name = "WHEN", default_value_t = ShowProgress::Auto)]
    pub progress: ShowProgress,
    /// Options for PETSc, which win over mezha's own
    #[arg(last = true, value_name = "PETSC OPTIONS")]
    pub petsc_options: Vec<String>,
}

/// When a run shows where it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ShowProgress {
    /// On a terminal, also that of mpirun on this host; elsewhere a line each minute; nothing of a quiet run
    #[default]
    Auto,
    /// Always; for a pipe that ends at a terminal, as of srun or ssh
    Always,
    /// Never
    Never,
}

/// Arguments of `mezha study`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct Study {
    /// The study file, or its folder if it is called study.toml
    #[arg(value_name = "STUDY.toml")]
    pub file: PathBuf,
    /// Folder of tables, figures and all results; runs that are there already are kept
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Override a key of the study, as in repeat=3; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Forget the runs in the folder, also those of another study, and make all anew
    #[arg(long)]
    pub force: bool,
}

/// The files that people write.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FileKind {
    /// Case files, for `mezha run`
    Case,
    /// Study files, for `mezha study`
    Study,
}

impl CaseArguments {
    /// The case file: `case.toml` of a folder.
    pub fn file(&self) -> PathBuf {
        file_of(&self.case, "case.toml")
    }
}

impl CheckArguments {
    /// Where the figure of a case of this name goes.
    pub fn figure(&self, case_name: &str) -> PathBuf {
        self.draw.clone().unwrap_or_else(|| Path::new("out").join(format!("{case_name}.check.svg")))
    }
}

impl Study {
    /// The study file: `study.toml` of a folder.
    pub fn file(&self) -> PathBuf {
        file_of(&self.file, "study.toml")
    }
}

/// A file, or the usual one of a folder.
fn file_of(path: &Path, usual: &str) -> PathBuf {
    if path.is_dir() { path.join(usual) } else { path.to_path_buf() }
}

/// The command that is nearest to one that does not exist, if clap has none to propose.
pub fn nearest_command(error: &clap::Error) -> Option<String> {
    let told = error.get(ContextKind::SuggestedSubcommand).is_some();
    let Some(ContextValue::String(found)) = error.get(ContextKind::InvalidSubcommand).filter(|_| !told) else { return None };
    let names = Arguments::command().get_subcommands().map(|command| command.get_name().to_owned()).collect::<Vec<_>>();
    let near = names.into_iter().map(|name| (strsim::damerau_levenshtein(Quote(found).head(), &name), name)).min()?;
    (near.0 <= 2).then_some(near.1)
}

/// Whether PETSc takes a word for the name of an option: one minus or two, and a letter; infinity and NaN are numbers.
fn is_option(word: &str) -> bool {
    is_name(word) && word.parse::<f64>().is_err()
}

impl RunArguments {
    /// The first word for PETSc that is neither the name of an option nor the value after one: PETSc would pass over it.
    pub fn stray_word(&self) -> Option<&str> {
        let words = || self.petsc_options.iter().map(String::as_str);
        let before = std::iter::once("").chain(words());
        before.zip(words()).find(|(before, word)| !is_option(before) && !is_option(word)).map(|(_, word)| word)
    }

    /// Folder of the results for a case of this name.
    pub fn folder(&self, case_name: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| Path::new("out").join(case_name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::error::ErrorKind;

    fn parse(line: &str) -> Result<Arguments, clap::Error> {
        Arguments::try_parse_from(line.split(' '))
    }

    #[test]
    fn definitions_are_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn run_takes_everything() {
        let line = "mezha run a/case.toml --out r --set mesh.refine=3 --set contact.seam.gap=-1e-3 --force --quiet -- -ksp_view -ksp_rtol 1e-9";
        let Command::Run(run) = parse(line).unwrap().command else { panic!("{line}") };
        assert_eq!(run.case.case, Path::new("a/case.toml"));
        assert_eq!(run.case.overrides, ["mesh.refine=3", "contact.seam.gap=-1e-3"]);
        assert!(run.force && run.quiet);
        assert_eq!(run.petsc_options, ["-ksp_view", "-ksp_rtol", "1e-9"]);
        assert_eq!(run.folder("bars"), Path::new("r"));
    }

    #[test]
    fn results_go_to_a_folder_of_the_cases_name() {
        let Command::Run(run) = parse("mezha run bars.toml").unwrap().command else { panic!("run") };
        assert_eq!(run.folder("bars"), Path::new("out/bars"));
    }

    #[test]
    fn words_that_petsc_would_pass_over_are_found() {
        let stray = |line: &str| {
            let Command::Run(run) = parse(&format!("mezha run a.toml -- {line}")).unwrap().command else { panic!("{line}") };
            run.stray_word().map(str::to_owned)
        };
        for good in ["-ksp_view", "-a 1 -b", "-shift -1 -b -inf", "--a x", "-a 1,2,3 -b"] {
            assert_eq!(stray(good), None, "{good}");
        }
        for (bad, word) in
            [("-", "-"), ("-1", "-1"), ("-a 1 2", "2"), ("ksp_view", "ksp_view"), ("-a 1 -- -b", "--"), ("-a 1 -2", "-2")]
        {
            assert_eq!(stray(bad).as_deref(), Some(word), "{bad}");
        }
    }

    #[test]
    fn the_nearest_command_is_proposed() {
        let near = |word: &str| nearest_command(&parse(&format!("mezha {word}")).unwrap_err());
        // Of "sutdy" clap knows by itself that "study" is meant.
        assert_eq!((near("rnu"), near("sutdy"), near("frobnicate")), (Some("run".into()), None, None));
    }

    #[test]
    fn usage_errors_end_with_code_2() {
        let table = [
            ("mezha run", ErrorKind::MissingRequiredArgument),
            ("mezha solve a.toml", ErrorKind::InvalidSubcommand),
            ("mezha study a.toml", ErrorKind::MissingRequiredArgument),
            ("mezha study --out r", ErrorKind::MissingRequiredArgument),
            ("mezha study a.toml --out r --quiet", ErrorKind::UnknownArgument),
            ("mezha check a.toml --out r", ErrorKind::UnknownArgument),
            ("mezha run a.toml -ksp_view", ErrorKind::UnknownArgument),
            ("mezha run a.toml --set", ErrorKind::InvalidValue),
        ];
        for (line, kind) in table {
            let error = parse(line).unwrap_err();
            assert_eq!((error.kind(), error.exit_code()), (kind, 2), "{line}");
        }
        assert_eq!(parse("mezha info --help").unwrap_err().exit_code(), 0);
    }
}
