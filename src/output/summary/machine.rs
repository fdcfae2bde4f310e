//! The machine that a run was made on: times mean nothing without it.

use std::fs;
use std::num::NonZero;
use std::thread::available_parallelism;

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
    fn a_machine_has_cpu_cores_and_memory() {
        let cpuinfo = "processor\t: 0\nmodel name\t: Great  CPU 9000\nprocessor\t: 1\nmodel name\t: Great CPU 9000\n";
        let meminfo = "MemTotal:       24651612 kB\nMemFree:        1 kB\n";
        assert_eq!(describe(cpuinfo, 2, meminfo), "Great CPU 9000, 2 cores, 24 GiB");
        assert_eq!((cores(cpuinfo), cores("")), (2, 1));
        assert_eq!(describe("", 1, ""), "CPU unknown, 1 core, memory unknown");
    }
}
