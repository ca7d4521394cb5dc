//! The whole run as Markdown.

use crate::{EMISSION_SIZE, Figures, PEER_SIZES, POSES, SIZES, child, machine};

/// A goal: what is measured, the value, and whether it is met.
struct Goal {
    what: String,
    wanted: String,
    got: String,
    met: bool,
}

/// Measures everything and prints the tables.
pub(crate) fn print() {
    let machine = machine::describe();
    let stages = SIZES.map(|cuts| child("stages", cuts));
    let memory = SIZES.map(|cuts| child("memory", cuts));
    let emission = child("emission", EMISSION_SIZE);
    let contour = PEER_SIZES.map(|cuts| child("contour", cuts));
    let kinematics = child("kinematics", POSES);

    println!("Measured on:\n");
    for line in machine {
        println!("- {line}");
    }
    println!("\n### Goals\n");
    print_goals(&goals(&stages, &memory, &emission, &contour));
    print_goal_rows(&kinematic_goals(&kinematics));
    println!("\n### Stages, ns per cut\n");
    print_stages(&stages);
    println!("\n### Peak memory\n");
    print_memory(&memory);
    println!("\n### Writing the same files\n");
    print_emission(&emission);
    println!("\n### Reading them back\n");
    print_reading(&emission);
    println!("\n### Machined contour, ns per cut\n");
    print_contour(&contour);
    println!("\n### Inverse kinematics, ns per pose\n");
    print_kinematics(&kinematics);
}

/// Names of the timed stages, with what they are called in the table.
const STAGES: [(&str, &str); 7] = [
    ("check", "parse and check"),
    ("plan", "plan"),
    ("lower", "lower and verify"),
    ("contour", "contour"),
    ("report", "figures"),
    ("emit", "emit, in memory"),
    ("to_files", "emit, to files"),
];

fn per_cut(figures: &Figures, name: &str) -> f64 {
    figures[name] / figures["cuts"]
}

/// Meaning to program text, in ns per cut. Left out is what does not grow with the number of cuts: reading the job, and
/// the figures, most of which is a correlation over a fixed number of points.
fn whole_run(figures: &Figures) -> f64 {
    let stages = ["plan", "lower", "contour", "emit"];
    stages.iter().map(|name| per_cut(figures, name)).sum()
}

/// Text to files, in s.
fn seconds(figures: &Figures) -> f64 {
    let stages = ["check", "plan", "lower", "contour", "report", "to_files"];
    stages.iter().map(|name| figures[*name]).sum::<f64>() * 1e-9
}

fn goals(
    stages: &[Figures; 3],
    memory: &[Figures; 3],
    emission: &Figures,
    contour: &[Figures; 2],
) -> Vec<Goal> {
    let growth = |cost: &dyn Fn(&Figures) -> f64| cost(&stages[2]) / cost(&stages[0]);
    let at_most = |what: &str, wanted: f64, got: f64, unit: &str| Goal {
        what: what.to_owned(),
        wanted: format!("at most {wanted}{unit}"),
        got: format!("{got:.2}{unit}"),
        met: got <= wanted,
    };
    let at_least = |what: &str, wanted: f64, got: f64| Goal {
        what: what.to_owned(),
        wanted: format!("at least {wanted}x"),
        got: format!("{got:.1}x"),
        met: got >= wanted,
    };
    let peer = |name: &str| contour[1][name] / contour[1]["replay"];
    let peer_without = |name: &str| contour[1][name] / contour[1]["deviation"];
    let worst_memory = memory[1..]
        .iter()
        .map(|figures| per_cut(figures, "emit"))
        .fold(0.0, f64::max);
    vec![
        at_most(
            "cost per cut of plan, lower, contour and emit, 10^6 cuts against 10^3",
            1.25,
            growth(&whole_run),
            "x",
        ),
        at_most(
            "cost per cut of the contour, 10^6 cuts against 10^3",
            1.25,
            growth(&|f| per_cut(f, "contour")),
            "x",
        ),
        at_least(
            "files faster than with `write!`",
            6.0,
            emission["formatted"] / emission["backend"],
        ),
        at_most(
            "files against writing the finished bytes",
            2.5,
            emission["backend"] / emission["finished"],
            "x",
        ),
        at_most(
            "reading the files against formatting them, in memory",
            2.0,
            emission["read"] / emission["memory"],
            "x",
        ),
        at_least(
            "contour of 10^5 cuts faster than Clipper2, blade's reach",
            4.0,
            peer("clipper_reach"),
        ),
        at_least(
            "the same with triangles as high as a chip",
            4.0,
            peer("clipper_chip"),
        ),
        at_least(
            "contour of 10^5 cuts faster than i_overlay, blade's reach",
            20.0,
            peer("i_overlay_reach"),
        ),
        at_least(
            "the same with triangles as high as a chip",
            20.0,
            peer("i_overlay_chip"),
        ),
        at_least(
            "contour and deviation of 10^5 cuts faster than Clipper2's contour alone, blade's reach",
            4.0,
            peer_without("clipper_reach"),
        ),
        at_least(
            "the same with triangles as high as a chip",
            4.0,
            peer_without("clipper_chip"),
        ),
        at_least(
            "contour and deviation of 10^5 cuts faster than i_overlay's contour alone, blade's reach",
            20.0,
            peer_without("i_overlay_reach"),
        ),
        at_least(
            "the same with triangles as high as a chip",
            20.0,
            peer_without("i_overlay_chip"),
        ),
        at_most(
            "peak memory per cut of the whole run, 10^5 cuts and more",
            1.0,
            worst_memory,
            " KiB",
        ),
    ]
}

fn kinematic_goals(figures: &Figures) -> Vec<Goal> {
    let faster = |what: &str, wanted: f64, ours: &str, theirs: &str| {
        let got = figures[theirs] / figures[ours];
        Goal {
            what: what.to_owned(),
            wanted: format!("at least {wanted}x"),
            got: format!("{got:.1}x"),
            met: got >= wanted,
        }
    };
    let worst = figures["worst"];
    vec![
        faster(
            "all solutions of a pose, each checked, faster than rs-opw-kinematics",
            4.0,
            "all",
            "peer_all",
        ),
        faster("the same in batches", 20.0, "batches", "peer_all"),
        faster(
            "a pose on a known branch faster than its `inverse_continuing`",
            15.0,
            "on_branch",
            "peer_continuing",
        ),
        Goal {
            what: "worst residual of 10^5 poses".to_owned(),
            wanted: "below 1e-12 m".to_owned(),
            got: format!("{worst:.1e} m"),
            met: worst < 1e-12,
        },
    ]
}

fn print_goals(goals: &[Goal]) {
    println!("| | goal | measured | |");
    println!("|---|---|---|---|");
    print_goal_rows(goals);
}

fn print_goal_rows(goals: &[Goal]) {
    for Goal {
        what,
        wanted,
        got,
        met,
    } in goals
    {
        let verdict = if *met { "met" } else { "**missed**" };
        println!("| {what} | {wanted} | {got} | {verdict} |");
    }
}

fn print_stages(stages: &[Figures; 3]) {
    print_head("stage", stages);
    for (name, title) in STAGES {
        print_row(
            title,
            stages
                .iter()
                .map(|figures| format!("{:.0}", per_cut(figures, name))),
        );
    }
    print_row(
        "plan, lower, contour, emit in memory",
        stages.iter().map(|figures| format!("{:.0}", whole_run(figures))),
    );
    print_row(
        "text to files, in all",
        stages.iter().map(|figures| format!("{:.4} s", seconds(figures))),
    );
    let microseconds = |figures: &Figures, name: &str| format!("{:.0} us", figures[name] * 1e-3);
    print_row(
        "of which parse",
        stages.iter().map(|figures| microseconds(figures, "parse")),
    );
    print_row(
        "of which parse and check",
        stages.iter().map(|figures| microseconds(figures, "check")),
    );
}

fn print_memory(memory: &[Figures; 3]) {
    print_head("after", memory);
    for (name, title) in [
        ("check", "check"),
        ("plan", "plan"),
        ("lower", "lower"),
        ("contour", "contour"),
        ("emit", "emit"),
    ] {
        let cell = |figures: &Figures| {
            format!(
                "{:.1} MiB, {:.0} B a cut",
                figures[name] / 1024.0,
                per_cut(figures, name) * 1024.0
            )
        };
        print_row(title, memory.iter().map(cell));
    }
}

fn print_emission(emission: &Figures) {
    let [lines, moves, files, bytes] = ["lines", "moves", "files", "bytes"].map(|name| emission[name]);
    println!(
        "{lines:.0} lines, of which {moves:.0} motions, in {files:.0} files with {:.1} MB.\n",
        bytes * 1e-6
    );
    println!("| way | ns per line | ns per motion | MB/s | times the finished bytes |");
    println!("|---|---|---|---|---|");
    let ways = [
        ("memory", "backend, bytes discarded"),
        ("backend", "backend, to files"),
        ("formatted", "`write!` through a `BufWriter`, to files"),
        ("finished", "finished bytes, to files"),
    ];
    for (name, title) in ways {
        let time = emission[name];
        println!(
            "| {title} | {:.0} | {:.0} | {:.0} | {:.2} |",
            time / lines,
            time / moves,
            bytes / time * 1e3,
            time / emission["finished"]
        );
    }
}

fn print_reading(emission: &Figures) {
    let [lines, moves, bytes] = ["lines", "moves", "bytes"].map(|name| emission[name]);
    println!("| way | ns per line | ns per motion | MB/s | times formatting them |");
    println!("|---|---|---|---|---|");
    let ways = [
        ("memory", "formatted, bytes discarded"),
        ("read", "read, statements discarded"),
        ("retrace", "read, and held against the program"),
    ];
    for (name, title) in ways {
        let time = emission[name];
        println!(
            "| {title} | {:.0} | {:.0} | {:.0} | {:.2} |",
            time / lines,
            time / moves,
            bytes / time * 1e3,
            time / emission["memory"]
        );
    }
}

fn print_contour(contour: &[Figures; 2]) {
    print_head("way", contour);
    let ways = [
        ("replay", "replay, with its proof"),
        ("deviation", "the same, and how far both contours deviate"),
        (
            "clipper_reach",
            "Clipper2, triangles as high as the blade reaches",
        ),
        ("clipper_chip", "Clipper2, triangles as high as a chip"),
        (
            "i_overlay_reach",
            "i_overlay, triangles as high as the blade reaches",
        ),
        ("i_overlay_chip", "i_overlay, triangles as high as a chip"),
    ];
    for (name, title) in ways {
        let cell = |figures: &Figures| {
            format!(
                "{:.0} ({:.1}x)",
                per_cut(figures, name),
                figures[name] / figures["replay"]
            )
        };
        print_row(title, contour.iter().map(cell));
    }
}

fn print_kinematics(figures: &Figures) {
    println!("| way | ns | rs-opw-kinematics takes | worst residual, m |");
    println!("|---|---|---|---|");
    let rows = [
        ("all", "peer_all", "worst", "all solutions, checked"),
        (
            "batches",
            "peer_all",
            "worst",
            "all solutions, checked, batches of 256",
        ),
        ("on_branch", "peer_continuing", "worst", "one branch, checked"),
        (
            "branch_batches",
            "peer_continuing",
            "worst",
            "one branch, checked, batches of 256",
        ),
        ("forward", "", "", "forward kinematics"),
        (
            "peer_all",
            "peer_all",
            "peer_worst",
            "rs-opw-kinematics, `inverse`",
        ),
        (
            "peer_continuing",
            "peer_continuing",
            "peer_worst",
            "rs-opw-kinematics, `inverse_continuing`",
        ),
        (
            "geo",
            "peer_all",
            "geo_worst",
            "ik-geo, all solutions, not checked",
        ),
    ];
    for (name, peer, worst, title) in rows {
        let Some(time) = figures.get(name) else { continue };
        let ratio = figures.get(peer).map(|peer| format!("{:.1}x", peer / time));
        let worst = figures.get(worst).map(|worst| format!("{worst:.1e}"));
        println!(
            "| {title} | {:.0} | {} | {} |",
            time / figures["poses"],
            ratio.unwrap_or_default(),
            worst.unwrap_or_default()
        );
    }
}

fn print_head(first: &str, columns: &[Figures]) {
    print_row(
        first,
        columns
            .iter()
            .map(|figures| format!("{:.0} cuts", figures["cuts"])),
    );
    print_row("---", columns.iter().map(|_| "---".to_owned()));
}

fn print_row(first: &str, cells: impl Iterator<Item = String>) {
    let cells: Vec<String> = cells.collect();
    println!("| {first} | {} |", cells.join(" | "));
}
