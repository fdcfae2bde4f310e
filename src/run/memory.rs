//! How much memory a run may take: what its machines have left, and what control groups and `ulimit` leave of that; and whether
//! it will do with that.

use super::outcome::{keep_forecast, size};
use crate::output::RunError;
use crate::petsc::Session;
use std::path::{Path, PathBuf};

/// Where nothing tells (bytes).
const UNKNOWN: f64 = 4e9;

/// What a process takes before it has read a mesh: program and libraries.
const BY_PROCESS: f64 = 60e6;

/// Text of a file; nothing if it cannot be read.
type Read<'a> = &'a dyn Fn(&Path) -> Option<String>;

/// Bytes that all ranks together may still take. Ranks of one machine share what it has left; every rank gets as much as the
/// one that can have least. **Collective**
pub fn left(session: &Session) -> f64 {
    let [of_machine, of_process] = left_here(session.ranks_here());
    let [least] = session.max([-of_machine.min(of_process)]);
    -least * session.size() as f64
}

/// Refuses a scene that takes more memory than there is, before any of it is taken; `need` tells the unknowns with so many
/// refinements, and what this rank takes for them. **Collective**
///
/// # Errors
/// Those of `need`, and [`RunError::Key`] with what is needed, what is left, and the refinement that fits.
pub fn refuse_too_large<E: Into<RunError>>(
    refine: usize,
    need: impl Fn(usize) -> Result<(usize, f64), E>,
    session: &Session,
) -> Result<(), RunError> {
    let [of_machine, of_process] = left_here(session.ranks_here());
    // Unknowns, the bytes of all ranks together, and these as a share of what is left, where that is shortest.
    let taken = |refine: usize| {
        let (unknowns, bytes) = need(refine)?;
        let [whole] = session.sum([bytes]);
        let mean = whole / session.size() as f64;
        let [share] = session.max([(mean / of_machine).max(bytes / of_process)]);
        Ok::<_, E>((unknowns, whole, share))
    };
    let (unknowns, whole, share) = taken(refine).map_err(E::into)?;
    keep_forecast(whole);
    if share <= 1.0 {
        return Ok(());
    }
    let mut coarser = (0..refine).rev().filter_map(|refine| Some((refine, taken(refine).ok()?)));
    let remedy = match coarser.find(|(_, (.., share))| *share <= 1.0) {
        Some((refine, (_, whole, _))) => format!("mesh.refine = {refine} fits, with {}", size(whole)),
        None => "no refinement of this mesh fits; take a coarser mesh, or a machine with more memory".into(),
    };
    let [need, left] = [whole, whole / share].map(size);
    Err(RunError::Key(format!(
        "mesh.refine = {refine}: {unknowns} unknowns take some {need} of memory, and {left} are left; {remedy}"
    )))
}

/// What a run takes on one rank of this machine, and what each further rank adds; with it a warning if that is not left here.
/// `need` is that of a scene on one rank, and that of its macro mesh.
pub fn told(need: f64, of_macro_mesh: f64) -> (String, Option<String>) {
    let [of_machine, of_process] = left_here(1);
    let left = of_machine.min(of_process);
    let [whole, more, there] = [need + BY_PROCESS, of_macro_mesh + BY_PROCESS, left].map(size);
    let words = format!("memory: some {whole} on one rank, and {more} more for each further one");
    let warning = format!("a run takes some {whole} of memory, and {there} are left on this machine: it would be refused here");
    (words, (need > left).then_some(warning))
}

/// Bytes that this rank may still take: its share of what the machine has left for so many ranks, of which others may take less
/// than theirs, and what its process may take.
fn left_here(ranks: usize) -> [f64; 2] {
    let read: Read = &|path| std::fs::read_to_string(path).ok();
    [of_machine(read) / ranks as f64, of_process(read)]
}

/// What is left of the machine, or of the control groups that this process is in.
fn of_machine(read: Read) -> f64 {
    let available = read(Path::new("/proc/meminfo")).and_then(|text| value(&text, "MemAvailable:")).map(|kib| 1024.0 * kib);
    let groups = GROUPS.iter().flat_map(|kind| kind.left(read));
    available.into_iter().chain(groups).reduce(f64::min).unwrap_or(UNKNOWN).max(0.0)
}

/// What may be limited, and what is taken of it.
const LIMITS: [(&str, &str); 2] = [("Max address space", "VmSize:"), ("Max data size", "VmData:")];

/// What `ulimit -v` and `ulimit -d` leave to this process.
fn of_process(read: Read) -> f64 {
    let [limits, status] = ["limits", "status"].map(|file| read(&Path::new("/proc/self").join(file)).unwrap_or_default());
    let left = |(limit, taken): (&str, &str)| {
        let taken = value(&status, taken).map_or(0.0, |kib| 1024.0 * kib);
        value(&limits, limit).map_or(f64::INFINITY, |limit| (limit - taken).max(0.0))
    };
    LIMITS.map(left).into_iter().fold(f64::INFINITY, f64::min)
}

/// The first number after a word at the beginning of a line; nothing if it is none, such as `unlimited`.
pub fn value(text: &str, key: &str) -> Option<f64> {
    text.lines().find_map(|line| line.strip_prefix(key))?.split_whitespace().next()?.parse().ok()
}

/// A version of control groups: how it is mounted, and its files.
struct GroupKind {
    /// Type of the file system, and the controller among its options.
    mounted_as: [&'static str; 2],
    limit: &'static str,
    taken: &'static str,
    /// Of what is taken, this is given back on demand: files that were read.
    given_back: &'static str,
}

/// Linux, Documentation/admin-guide/cgroup-v2.rst and cgroup-v1/memory.rst.
const GROUPS: [GroupKind; 2] = [
    GroupKind { mounted_as: ["cgroup2", ""], limit: "memory.max", taken: "memory.current", given_back: "inactive_file" },
    GroupKind {
        mounted_as: ["cgroup", "memory"],
        limit: "memory.limit_in_bytes",
        taken: "memory.usage_in_bytes",
        given_back: "total_inactive_file",
    },
];

impl GroupKind {
    /// What is left of the group that this process is in, and of each one around it.
    fn left(&self, read: Read) -> Vec<f64> {
        let Some((mount, group)) = self.place(read) else { return Vec::new() };
        let within = |folder: &&Path| folder.starts_with(&mount);
        group.ancestors().take_while(within).filter_map(|folder| self.left_of(folder, read)).collect()
    }

    fn left_of(&self, folder: &Path, read: Read) -> Option<f64> {
        let number = |file: &str| read(&folder.join(file))?.trim().parse::<f64>().ok();
        let limit = number(self.limit)?;
        let given_back = read(&folder.join("memory.stat")).and_then(|text| value(&text, self.given_back)).unwrap_or(0.0);
        let taken = number(self.taken).unwrap_or(0.0);
        Some(limit - (taken - given_back).max(0.0))
    }

    /// Where the groups are mounted, and the folder of this process's own.
    fn place(&self, read: Read) -> Option<(PathBuf, PathBuf)> {
        let [_, controller] = self.mounted_as;
        let groups = read(Path::new("/proc/self/cgroup"))?;
        // `4:memory:/path` or `0::/path`
        let own = groups.lines().find_map(|line| {
            let mut fields = line.splitn(3, ':').skip(1);
            let is_it = fields.next()?.split(',').any(|name| name == controller);
            fields.next().filter(|_| is_it)
        })?;
        let mounts = read(Path::new("/proc/self/mountinfo"))?;
        let (root, mount) = mounts.lines().find_map(|line| self.mount(line))?;
        // A container sees the folder that is its own as the root.
        let below = Path::new(own).strip_prefix(root).unwrap_or(Path::new(""));
        Some((mount.into(), Path::new(mount).join(below)))
    }

    /// Root and mount point of a line of `mountinfo`: `35 31 0:32 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory`
    fn mount<'a>(&self, line: &'a str) -> Option<(&'a str, &'a str)> {
        let [kind, controller] = self.mounted_as;
        let (place, how) = line.split_once(" - ")?;
        let (mut place, mut how) = (place.split(' ').skip(3), how.split(' '));
        let is_kind = how.next()? == kind;
        let has_controller = controller.is_empty() || how.nth(1)?.split(',').any(|option| option == controller);
        Some((place.next()?, place.next()?)).filter(|_| is_kind && has_controller)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GIB: f64 = 1024.0 * 1024.0 * 1024.0;

    const MEMINFO: &str = "MemTotal:       16777216 kB\nMemAvailable:    8388608 kB\n";

    const MOUNT_2: &str = "41 31 0:38 / /sys/fs/cgroup rw,relatime - cgroup2 cgroup2 rw";

    /// What is left of a machine with these files.
    fn left(files: &[(&str, &str)]) -> f64 {
        let find = |path: &Path| files.iter().find(|(name, _)| Path::new(name) == path).map(|(_, text)| text.to_string());
        of_machine(&find) / GIB
    }

    #[test]
    fn a_machine_without_groups_has_what_it_has() {
        assert_eq!(left(&[("/proc/meminfo", MEMINFO)]), 8.0);
        assert_eq!(left(&[]), UNKNOWN / GIB);
        let at_the_root = [("/proc/meminfo", MEMINFO), ("/proc/self/cgroup", "0::/\n"), ("/proc/self/mountinfo", MOUNT_2)];
        assert_eq!(left(&at_the_root), 8.0, "the root has no limits");
    }

    #[test]
    fn the_least_of_the_groups_around_a_process_counts() {
        let files = |inner: &'static str, outer: &'static str| {
            left(&[
                ("/proc/meminfo", MEMINFO),
                ("/proc/self/cgroup", "0::/job/step\n"),
                ("/proc/self/mountinfo", MOUNT_2),
                ("/sys/fs/cgroup/job/step/memory.max", inner),
                ("/sys/fs/cgroup/job/step/memory.current", "1073741824\n"),
                ("/sys/fs/cgroup/job/memory.max", outer),
                ("/sys/fs/cgroup/job/memory.current", "2147483648\n"),
                ("/sys/fs/cgroup/job/memory.stat", "anon 1\ninactive_file 1073741824\nactive_file 7\n"),
            ])
        };
        assert_eq!(files("max\n", "max\n"), 8.0);
        assert_eq!(files("4294967296\n", "max\n"), 3.0);
        assert_eq!(files("max\n", "3221225472\n"), 2.0, "files that were read are given back");
        assert_eq!(files("4294967296\n", "3221225472\n"), 2.0);
        assert_eq!(files("1048576\n", "max\n"), 0.0, "more is taken than is allowed");
    }

    #[test]
    fn older_groups_and_containers_are_understood() {
        let files = |group: &'static str, root: &'static str| {
            let mount = format!(
                "30 23 0:27 / /proc rw - proc proc rw\n33 31 0:30 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n32 31 0:32 {root} /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory"
            );
            left(&[
                ("/proc/meminfo", MEMINFO),
                ("/proc/self/cgroup", group),
                ("/proc/self/mountinfo", &mount),
                ("/sys/fs/cgroup/memory/memory.limit_in_bytes", "6442450944"),
                ("/sys/fs/cgroup/memory/memory.usage_in_bytes", "1073741824"),
                ("/sys/fs/cgroup/memory/slurm/job/memory.limit_in_bytes", "2147483648"),
                ("/sys/fs/cgroup/memory/slurm/job/memory.stat", "inactive_file 5\ntotal_inactive_file 10\n"),
            ])
        };
        assert_eq!(files("5:cpu:/slurm/job\n4:memory:/slurm/job\n0::/\n", "/"), 2.0);
        assert_eq!(files("5:cpu:/slurm/job\n4:memory:/other\n0::/\n", "/"), 5.0, "a group that cannot be seen");
        assert_eq!(files("4:cpu,memory:/docker/a\n", "/docker/a"), 5.0, "the root of a container");
    }

    #[test]
    fn address_space_is_limited_by_ulimit() {
        let left = |limit: &str| {
            let limits =
                format!("Limit    Soft Limit   Hard Limit   Units\nMax address space         {limit}   unlimited   bytes\n");
            let find = |path: &Path| match path.to_str() {
                Some("/proc/self/limits") => Some(limits.clone()),
                Some("/proc/self/status") => Some("VmPeak:\t 9 kB\nVmSize:\t 1048576 kB\n".into()),
                _ => None,
            };
            of_process(&find) / GIB
        };
        assert_eq!(left("unlimited"), f64::INFINITY);
        assert_eq!([left("3221225472"), left("1048576")], [2.0, 0.0]);
    }
}
