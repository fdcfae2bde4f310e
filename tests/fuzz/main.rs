//! Random inputs: no reader panics, hangs, or takes much memory, whatever it is given.
//!
//! Each target mutates texts of the project and of `tests/fuzz/corpus` (files that begin with the name of the target). Which text
//! is made depends on the target and a number alone, so that a failure is found again: `MEZHA_FUZZ_RUNS` is how many are made
//! (without it each target takes two seconds), `MEZHA_FUZZ_FROM` the number of the first one.
//!
//! This is a mutator of our own because it needs neither nightly Rust nor instrumented libraries, and its inputs are the same
//! everywhere.

mod mutate;

use mezha::case::Case;
use mezha::geometry::Formula;
use mezha::mesh::parse_gmsh;
use mezha::run;
use mezha::study::Plan;
use mutate::{Random, mutated};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// How long a target takes where nothing else is asked for.
const TIME: Duration = Duration::from_secs(2);
/// An input that takes longer hangs (the machine may be busy).
const PATIENCE: Duration = Duration::from_secs(30);
/// Most memory that a target may take (KiB).
const MEMORY: u64 = 2 << 20;
/// Longest text of the project that is mutated (bytes): long meshes take long and say no more.
const LONGEST: u64 = 40_000;

/// Makes a target.
type Make = fn() -> Target;

/// Reads a text, and tells whether it was taken.
type Read = Box<dyn Fn(&[u8]) -> bool>;

fn main() {
    let words: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let targets: [(&str, Make); 5] = [("formula", formula), ("case", case), ("mesh", mesh), ("study", study), ("check", check)];
    if std::env::args().any(|word| word == "--list") {
        targets.iter().for_each(|(name, _)| println!("{name}: test"));
        return;
    }
    std::panic::set_hook(Box::new(|_| {}));
    let wanted = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word.as_str()));
    let failed =
        targets.iter().filter(|(name, _)| wanted(name)).filter(|(name, make)| !make().runs_without_failure(name)).count();
    std::process::exit(i32::from(failed > 0));
}

/// A reader, and texts to begin with.
struct Target {
    corpus: Vec<Vec<u8>>,
    /// What is done with a text.
    read: Read,
}

impl Target {
    fn new(name: &str, mut corpus: Vec<Vec<u8>>, read: impl Fn(&[u8]) -> bool + 'static) -> Self {
        let own = files(&root().join("tests/fuzz/corpus"), &|file| file.starts_with(name));
        corpus.extend(own.iter().map(|file| std::fs::read(file).expect("a file of the corpus")));
        Self { corpus, read: Box::new(read) }
    }

    /// Reads the corpus itself, and then texts made of it. Tells how it went.
    fn runs_without_failure(&self, name: &str) -> bool {
        let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
        let (runs, from) = (number("MEZHA_FUZZ_RUNS"), number("MEZHA_FUZZ_FROM").unwrap_or(0));
        let started = Instant::now();
        let (mut slowest, mut made, mut taken) = ((Duration::ZERO, 0), 0, 0);
        for text in &self.corpus {
            if let Err(words) = self.read(text) {
                return report(name, "the corpus", text, &words);
            }
        }
        while runs.map_or(started.elapsed() < TIME, |runs| made < runs) {
            let input = from + made;
            let text = mutated(&self.corpus, &mut Random(seed(name, input)));
            let began = Instant::now();
            match self.read(&text) {
                Ok(good) => taken += u64::from(good),
                Err(words) => return report(name, &format!("input {input}"), &text, &words),
            }
            let took = began.elapsed();
            if took > PATIENCE {
                return report(name, &format!("input {input}"), &text, &format!("it took {took:.1?}"));
            }
            slowest = slowest.max((took, input));
            made += 1;
            if runs.is_some_and(|runs| made % (runs / 10).max(1) == 0) {
                println!("fuzz {name}: {made} inputs, {:.0?}, {} MiB at most", started.elapsed(), memory() / 1024);
            }
        }
        let ([longest, at], mib) = ([slowest.0.as_millis() as u64, slowest.1], memory() / 1024);
        println!("test {name} ... ok ({made} inputs, {taken} of them taken; input {at} took longest, {longest} ms; {mib} MiB)");
        memory() < MEMORY
    }

    /// Whether a text was taken.
    ///
    /// # Errors
    /// Words of a panic.
    fn read(&self, text: &[u8]) -> Result<bool, String> {
        catch_unwind(AssertUnwindSafe(|| (self.read)(text))).map_err(|panic| {
            let words = panic.downcast_ref::<String>().cloned();
            words.or_else(|| panic.downcast_ref::<&str>().map(|words| (*words).to_owned())).unwrap_or_default()
        })
    }
}

/// Words that refuse a text are few.
fn short(words: &str) -> bool {
    assert!(words.len() < 40_000, "{} bytes of words", words.len());
    false
}

/// Keeps a text that a reader fails on.
fn report(name: &str, which: &str, text: &[u8], words: &str) -> bool {
    let file = std::env::temp_dir().join(format!("{name}_{:016x}", seed(which, text.len() as u64)));
    let kept = std::fs::write(&file, text).map_or("nowhere".into(), |()| file.display().to_string());
    println!("test {name} ... FAILED: {which}, kept as {kept}: {words}");
    false
}

/// A number for a name and a number.
fn seed(name: &str, number: u64) -> u64 {
    name.bytes().fold(number.wrapping_mul(0x2545_f491_4f6c_dd1d), |sum, byte| sum.wrapping_mul(31).wrapping_add(u64::from(byte)))
}

/// Largest memory of this process so far (KiB).
fn memory() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or(0)
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Files of a folder by their names, in order.
fn files(folder: &Path, wanted: &dyn Fn(&str) -> bool) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let name = |path: &PathBuf| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut found: Vec<PathBuf> = entries.filter(|path| path.is_file() && wanted(&name(path))).collect();
    found.sort();
    found
}

/// Short files of all cases.
fn of_cases(wanted: &dyn Fn(&str) -> bool) -> Vec<PathBuf> {
    let mut folders: Vec<PathBuf> =
        std::fs::read_dir(root().join("cases")).expect("cases").map(|entry| entry.expect("an entry").path()).collect();
    folders.sort();
    let all = folders.iter().filter(|path| path.is_dir()).flat_map(|folder| files(folder, wanted));
    all.filter(|file| std::fs::metadata(file).is_ok_and(|about| about.len() <= LONGEST)).collect()
}

fn texts(files: &[PathBuf]) -> Vec<Vec<u8>> {
    files.iter().map(|file| std::fs::read(file).expect("a file of a case")).collect()
}

fn is_study(name: &str) -> bool {
    name.starts_with("study")
}

/// Formulas of two variables, and of one.
fn formula() -> Target {
    let formulas = [
        "x",
        "-x^2",
        "2^-1",
        "2^3^2",
        "sqrt(x^2 + y^2)",
        "sin(pi*x)*cos(y) - exp(-x)",
        "1.227/7000*(0.546*1.15 + 1.15/(x^2 + y^2))*x",
        "((((((((((x))))))))))",
        "--+-x",
        ".5e-3*x",
        "0.375*(sqrt((x - 0.3)^2) + x - 0.3)^2",
        "1/x/x/x",
        "t",
        "4 + t - 0.25*t^2",
    ];
    Target::new("formula", formulas.map(|text| text.as_bytes().to_vec()).to_vec(), |text| {
        let text = String::from_utf8_lossy(text);
        for variables in [&["x", "y"][..], &["t"]] {
            match Formula::parse(&text, variables) {
                Ok(formula) => {
                    for at in [[0.0, 0.0], [1.5, -2.0], [f64::NAN, f64::INFINITY]] {
                        let _ = (formula.value(&at), formula.derivative(0, &at));
                    }
                    return true;
                }
                Err(error) => assert!(error.to_string().len() < 1000, "long words"),
            }
        }
        false
    })
}

/// Case files.
fn case() -> Target {
    let files = of_cases(&|name| name.ends_with(".toml") && !is_study(name));
    Target::new("case", texts(&files), |text| {
        let text = String::from_utf8_lossy(text);
        match Case::parse(&text, Path::new("cases/bars/case.toml"), &[]) {
            // What is written out reads back.
            Ok(case) => Case::parse(&case.resolved(), Path::new("again.toml"), &[]).map(|_| true).expect("a resolved case"),
            Err(error) => short(&error.to_string()),
        }
    })
}

/// Mesh files.
fn mesh() -> Target {
    let files = of_cases(&|name| name.ends_with(".msh"));
    Target::new("mesh", texts(&files), |text| {
        parse_gmsh(text, Path::new("a.msh"), Default::default()).map_or_else(|error| short(&error.to_string()), |_| true)
    })
}

/// Study files, with the cases that they name.
fn study() -> Target {
    let mut files = of_cases(&is_study);
    files.extend(self::files(&root().join("cases/studies"), &|name| name.ends_with(".toml")));
    let place = root().join("cases/bars_inclined/study.toml");
    Target::new("study", texts(&files), move |text| {
        let plan = Plan::parse(&String::from_utf8_lossy(text), &place, &[]);
        plan.map_or_else(|error| short(&error.to_string()), |_| true)
    })
}

/// Case files with their meshes, all the way to the solve.
fn check() -> Target {
    const FOLDERS: [&str; 8] = ["hertz", "bars_inclined", "rings", "rigid_tools", "patch_columns", "springs", "pin", "wedge"];
    let files = of_cases(&|name| name == "case.toml");
    let chosen = files.iter().filter(|file| FOLDERS.iter().any(|folder| file.parent().is_some_and(|own| own.ends_with(folder))));
    let corpus = chosen.clone().map(|file| {
        let text = std::fs::read_to_string(file).expect("a case");
        let folder = file.parent().expect("a folder").display().to_string();
        text.replacen("file   = \"", &format!("file = \"{folder}/"), 1).into_bytes()
    });
    Target::new("check", corpus.collect(), |text| {
        let text = String::from_utf8_lossy(text);
        // Refined meshes take long, and nothing is read there.
        let Ok(case) = Case::parse(&text, Path::new("/nowhere/case.toml"), &["mesh.refine=0".into()]) else { return false };
        run::check(&case).map_or_else(|error| short(&error.to_string()), |_| true)
    })
}
