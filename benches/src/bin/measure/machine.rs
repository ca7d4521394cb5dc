//! What a run was made on, as far as the system says.

use std::fs;
use std::process::Command;

/// Processor, cores, system and compiler, a line each.
pub(crate) fn describe() -> [String; 4] {
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let field = |name: &str| {
        let line = cpu.lines().find(|line| line.starts_with(name))?;
        line.split_once(':').map(|(_, value)| value.trim().to_owned())
    };
    let model = field("model name").unwrap_or_else(|| "unknown".to_owned());
    let place = |name| field(name).unwrap_or_else(|| "?".to_owned());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let kernel = fs::read_to_string("/proc/sys/kernel/osrelease").unwrap_or_default();
    let rustc = Command::new("rustc")
        .arg("--version")
        .output()
        .map(|output| output.stdout)
        .unwrap_or_default();
    [
        format!(
            "processor: {model} (family {}, model {}), {cores} cores, one used",
            place("cpu family"),
            place("model\t")
        ),
        format!("memory: {:.0} GiB", memory() / 1024.0 / 1024.0),
        format!("system: Linux {}, load before the run {}", kernel.trim(), load()),
        format!("compiler: {}", String::from_utf8_lossy(&rustc).trim()),
    ]
}

/// The largest resident memory of this process so far, in KiB.
pub(crate) fn peak_memory() -> f64 {
    kib("/proc/self/status", "VmHWM:")
}

fn memory() -> f64 {
    kib("/proc/meminfo", "MemTotal:")
}

fn kib(file: &str, name: &str) -> f64 {
    let text = fs::read_to_string(file).unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with(name));
    let number = line.and_then(|line| line.split_whitespace().nth(1));
    number.and_then(|number| number.parse().ok()).unwrap_or(f64::NAN)
}

fn load() -> String {
    let text = fs::read_to_string("/proc/loadavg").unwrap_or_default();
    text.split_whitespace().next().unwrap_or("unknown").to_owned()
}
