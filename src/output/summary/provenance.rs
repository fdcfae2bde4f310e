//! Where a result comes from, and on which machine: times mean nothing without that.

use super::read_summary;
use serde::{Deserialize, Serialize};
use std::fs;
use std::num::NonZero;
use std::path::Path;
use std::thread::available_parallelism;

/// What made a result, and of what. Nothing here is a number of the result: two runs that differ in date, host or command alone
/// have the same digits.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    /// Commit of mezha's sources; null if the build did not know it.
    pub commit: Option<String>,
    /// Version of PETSc.
    pub petsc: String,
    /// Name and version of MPI.
    pub mpi: String,
    /// The BLAS in use, with its file.
    pub blas: String,
    /// Compiler of mezha; null if the build did not know it.
    pub compiler: Option<String>,
    /// The command, as a shell takes it.
    pub command: String,
    /// The folder it was given in.
    pub directory: String,
    /// Options of PETSc that are the user's, from the command line, `PETSC_OPTIONS` or a file, as they stand behind `--`; may be
    /// empty.
    pub petsc_options: String,
    /// SHA-256 of `case.toml` in the result folder, with `case.msh` as the name of the mesh.
    pub case_hash: String,
    /// The same of the case of each load step; the key is missing if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub step_hashes: Vec<String>,
    /// SHA-256 of the mesh file; null if it was not read yet.
    pub mesh_hash: Option<String>,
    /// The mesh file, where it was read.
    pub mesh_file: String,
    /// Name of the host, or of all hosts.
    pub host: String,
    /// CPU, cores and memory of the first host.
    pub cpu: String,
    /// Number of ranks.
    pub ranks: usize,
    /// When the run was begun: UTC by ISO 8601.
    pub date: String,
}

impl Provenance {
    /// What made the result in a folder; nothing if its `summary.json` does not tell.
    pub fn of_result(folder: &Path) -> Option<Self> {
        Self::deserialize(&read_summary(folder)["provenance"]).ok()
    }

    /// In what this run differs from one `before`, beside its time and place, one phrase for each.
    pub fn differences(&self, before: &Self) -> Vec<String> {
        let text = |value: &Option<String>| value.clone().unwrap_or_else(|| "unknown".into());
        let pairs = [
            ("ranks", self.ranks.to_string(), before.ranks.to_string()),
            ("PETSc options", quoted(&self.petsc_options), quoted(&before.petsc_options)),
            ("commit", text(&self.commit), text(&before.commit)),
            ("compiler", text(&self.compiler), text(&before.compiler)),
            ("PETSc", self.petsc.clone(), before.petsc.clone()),
            ("MPI", self.mpi.clone(), before.mpi.clone()),
            ("BLAS", self.blas.clone(), before.blas.clone()),
            ("CPU", self.cpu.clone(), before.cpu.clone()),
        ];
        let differing = pairs.into_iter().filter(|(_, now, then)| now != then);
        differing.map(|(what, now, then)| format!("{what}: {now} instead of {then}")).collect()
    }
}

fn quoted(options: &str) -> String {
    if options.is_empty() { "none".into() } else { format!("`{options}`") }
}

/// CPU, cores and memory in words, as the system tells them; cores are those that this process may use.
pub fn machine() -> String {
    let machine = describe(&read("cpuinfo"), available_parallelism().map_or(1, NonZero::get), &read("meminfo"));
    match std::env::var("SLURM_JOB_NUM_NODES") {
        Ok(nodes) if nodes != "1" => format!("{nodes} nodes of {machine}"),
        _ => machine,
    }
}

/// The same of this host with all of its cores: a rank may be bound to one of them.
pub fn whole_machine() -> String {
    let cpuinfo = read("cpuinfo");
    describe(&cpuinfo, cores(&cpuinfo), &read("meminfo"))
}

fn read(name: &str) -> String {
    fs::read_to_string(format!("/proc/{name}")).unwrap_or_default()
}

fn cores(cpuinfo: &str) -> usize {
    cpuinfo.lines().filter(|line| line.starts_with("processor")).count().max(1)
}

fn describe(cpuinfo: &str, cores: usize, meminfo: &str) -> String {
    let value = |text: &str, key: &str| {
        let line = text.lines().find(|line| line.starts_with(key))?;
        Some(line.split_once(':')?.1.split_whitespace().collect::<Vec<_>>().join(" "))
    };
    let cpu = value(cpuinfo, "model name").unwrap_or("CPU unknown".into());
    let cores = if cores == 1 { "1 core".to_string() } else { format!("{cores} cores") };
    let kib = value(meminfo, "MemTotal").and_then(|words| words.split(' ').next()?.parse::<f64>().ok());
    let memory = kib.map_or("memory unknown".into(), |kib| format!("{:.0} GiB", kib / 1024.0 / 1024.0));
    format!("{cpu}, {cores}, {memory}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_and_places_are_no_differences() {
        let before = Provenance { ranks: 2, petsc_options: "-ksp_type gcr".into(), ..Provenance::default() };
        let again = Provenance { date: "2026-01-01T00:00:00Z".into(), host: "there".into(), ..before.clone() };
        assert!(again.differences(&before).is_empty());
        let other = Provenance { ranks: 1, petsc_options: String::new(), commit: Some("abc".into()), ..before.clone() };
        assert_eq!(
            other.differences(&before),
            ["ranks: 1 instead of 2", "PETSc options: none instead of `-ksp_type gcr`", "commit: abc instead of unknown"]
        );
    }

    #[test]
    fn a_machine_has_cpu_cores_and_memory() {
        let cpuinfo = "processor\t: 0\nmodel name\t: Great  CPU 9000\nprocessor\t: 1\nmodel name\t: Great CPU 9000\n";
        let meminfo = "MemTotal:       24651612 kB\nMemFree:        1 kB\n";
        assert_eq!(describe(cpuinfo, 2, meminfo), "Great CPU 9000, 2 cores, 24 GiB");
        assert_eq!((cores(cpuinfo), cores("")), (2, 1));
        assert_eq!(describe("", 1, ""), "CPU unknown, 1 core, memory unknown");
    }
}
