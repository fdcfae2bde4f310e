//! The command line of `mezha`. A usage error ends with exit code 2, as clap has it.

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand};

/// Parallel contact of elastic bodies on a contact boundary of its own.
#[derive(Clone, Debug, Parser, PartialEq, Eq)]
#[command(name = "mezha", version, arg_required_else_help = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// What mezha can do.
#[derive(Clone, Debug, PartialEq, Eq, Subcommand)]
pub enum Command {
    /// Solve a case and write its results; start it under mpirun for several ranks
    Run(RunArguments),
    /// Read everything, solve nothing, say what would be solved
    Check(CaseArguments),
    /// Make every run of a grid that is not made yet, each a row of one table; start it without mpirun
    Study(Study),
    /// Print versions of mezha, PETSc, MPI and BLAS, and the number of ranks
    Info,
}

/// Which case, with which changes.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct CaseArguments {
    /// The case file
    #[arg(value_name = "CASE.toml")]
    pub case: PathBuf,
    /// Override a key of the case, as in body.upper.young=7e6; may be repeated
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
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
    /// Options for PETSc, which win over mezha's own
    #[arg(last = true, value_name = "PETSC OPTIONS")]
    pub petsc_options: Vec<String>,
}

/// Arguments of `mezha study`.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct Study {
    /// The study file
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

impl RunArguments {
    /// Folder of the results for a case of this name.
    pub fn folder(&self, case_name: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| Path::new("out").join(case_name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;
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
