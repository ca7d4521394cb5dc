//! Rasters of three axes as different post processors write them.

use std::fmt::Write;
use vcutc_backend_api::readback::ProgramFile;

/// A raster over a blank, in the axes of a job from the blank's corner, in mm.
#[derive(Clone, Debug)]
pub(super) struct Raster {
    /// Width, depth, height of the blank.
    pub(super) blank: [f64; 3],
    /// Rows from the top down: the height of each, and where its passes lie, in the order in which they are made.
    pub(super) rows: Vec<(f64, Vec<f64>)>,
    /// How far passes run out of the blank.
    pub(super) overrun: f64,
    /// Height of the safe plane above the blank.
    pub(super) safe: f64,
}

impl Raster {
    /// Layers from the top down, columns centred, to and fro.
    pub(super) fn block(blank: [f64; 3], layer: f64, step: f64, bottom: f64) -> Self {
        let [width, _, height] = blank;
        let micrometres = |mm: f64| (mm * 1000.0).round() / 1000.0;
        let count = (width / step).ceil() as u32;
        let first = width / 2.0 - f64::from(count - 1) / 2.0 * step;
        let columns: Vec<f64> = (0..count)
            .map(|i| micrometres(first + f64::from(i) * step))
            .collect();
        let heights = (1..)
            .map(|k| micrometres(height - f64::from(k) * layer))
            .take_while(|&z| z >= bottom);
        let rows = heights.enumerate().map(|(row, z)| {
            let mut columns = columns.clone();
            if row % 2 == 1 {
                columns.reverse();
            }
            (z, columns)
        });
        Self {
            blank,
            rows: rows.collect(),
            overrun: 3.0,
            safe: 10.0,
        }
    }

    /// The tips that its passes stand for.
    pub(super) fn tips(&self) -> Vec<[f64; 2]> {
        let row = |(z, columns): &(f64, Vec<f64>)| columns.iter().map(|&x| [x, *z]).collect::<Vec<_>>();
        self.rows.iter().flat_map(row).collect()
    }
}

/// How a post processor writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    /// All components of every point, CRLF, folds.
    Full,
    /// `{E6POS: ...}` with external axes, tabs, Latin-1 comments.
    Typed,
    /// Lower case, and only what changes.
    Sparse,
    /// Points with names in the `.dat` file.
    Named,
    /// Spline motions, and a subprogram for every row.
    Parts,
}

pub(super) const STYLES: [Style; 5] = [
    Style::Full,
    Style::Typed,
    Style::Sparse,
    Style::Named,
    Style::Parts,
];

/// Where the zero of the program lies, and along which of its axes the passes run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zero {
    /// At the corner, z from the bottom; along y.
    Corner,
    /// In the middle of the top; along y.
    MiddleOfTop,
    /// At the corner, z from the bottom; along x.
    AlongX,
}

pub(super) const ZEROS: [Zero; 3] = [Zero::Corner, Zero::MiddleOfTop, Zero::AlongX];

/// How passes are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passes {
    /// To and fro, with a step across outside of the blank.
    ToAndFro,
    /// Always the same way, back through the air.
    OneWay,
    /// To and fro, each in many pieces.
    InPieces,
}

pub(super) const PASSES: [Passes; 3] = [Passes::ToAndFro, Passes::OneWay, Passes::InPieces];

/// A post processor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Post {
    pub(super) style: Style,
    pub(super) zero: Zero,
    pub(super) passes: Passes,
}

impl Post {
    /// The program `raster`.
    pub(super) fn write(self, raster: &Raster) -> Vec<ProgramFile> {
        let mut writer = Writer::new(self, raster);
        for (z, columns) in &raster.rows {
            writer.row(*z, columns);
        }
        writer.finish()
    }
}

struct Writer<'r> {
    post: Post,
    raster: &'r Raster,
    main: String,
    parts: String,
    data: String,
    points: u32,
    rows: u32,
    last: [f64; 3],
}

const SPEED: (&str, &str) = ("0.2", "1.0");

impl<'r> Writer<'r> {
    fn new(post: Post, raster: &'r Raster) -> Self {
        let head = match post.style {
            Style::Full => {
                "&ACCESS RVP\n&REL 12\nDEF raster ( )\n;FOLD INI\nBAS (#INITMOV,0 )\n;ENDFOLD (INI)\n$BASE=BASE_DATA[1]\n"
            }
            Style::Typed => "DEF raster()\n\t; Fr\u{e4}sen\n\tBAS (#INITMOV,0)\n",
            Style::Sparse => "def raster( )\nbas(#initmov,0)\n",
            Style::Named | Style::Parts => "DEF raster( )\nBAS (#INITMOV,0 )\n",
        };
        let home = match post.style {
            Style::Sparse => "ptp {a1 0, a2 -90, a3 90, a4 0, a5 45, a6 0}\n",
            _ => "PTP {A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 45.0,A6 0.0}\n",
        };
        Self {
            post,
            raster,
            main: format!("{head}{home}"),
            parts: String::new(),
            data: "DEFDAT raster\n".to_owned(),
            points: 0,
            rows: 0,
            last: [f64::NAN; 3],
        }
    }

    fn row(&mut self, z: f64, columns: &[f64]) {
        self.rows += 1;
        if self.post.style == Style::Parts {
            let call = format!("row_{}( )\n", self.rows);
            self.main += &call;
            self.parts += &format!("DEF {call}");
        }
        let [_, depth, height] = self.raster.blank;
        let (near, far) = (-self.raster.overrun, depth + self.raster.overrun);
        let safe = height + self.raster.safe;
        let mut y = near;
        let first = columns[0];
        self.speed(SPEED.1);
        self.go([first, y, safe]);
        self.speed(SPEED.0);
        self.go([first, y, z]);
        for &x in columns {
            if self.post.passes == Passes::OneWay && x != first {
                self.speed(SPEED.1);
                self.go([self.last[0], y, safe]);
                self.go([self.last[0], near, safe]);
                self.go([x, near, safe]);
                y = near;
                self.speed(SPEED.0);
            }
            self.go([x, y, z]);
            let end = if y == near { far } else { near };
            if self.post.passes == Passes::InPieces {
                for share in [0.2, 0.5, 0.9] {
                    self.go([x, y + (end - y) * share, z]);
                }
            }
            y = end;
            self.go([x, y, z]);
        }
        self.speed(SPEED.1);
        self.go([self.last[0], y, safe]);
        if self.post.style == Style::Parts {
            self.parts += "END\n";
        }
    }

    fn line(&mut self, line: &str) {
        match self.post.style {
            Style::Parts if self.rows > 0 => self.parts += line,
            _ => self.main += line,
        }
    }

    fn speed(&mut self, speed: &str) {
        match self.post.style {
            Style::Sparse => self.line(&format!("$vel.cp = {speed}\n")),
            Style::Typed => self.line(&format!("\t$VEL.CP={speed}\n")),
            _ => self.line(&format!("$VEL.CP={speed}\n")),
        }
    }

    /// A point of the job in the program's axes.
    fn place(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [width, depth, height] = self.raster.blank;
        match self.post.zero {
            Zero::Corner => [x, y, z],
            Zero::MiddleOfTop => [x - width / 2.0, y - depth / 2.0, z - height],
            // The job's x is the program's -y.
            Zero::AlongX => [y, width - x, z],
        }
    }

    fn go(&mut self, to: [f64; 3]) {
        let before = std::mem::replace(&mut self.last, to);
        let [x, y, z] = self.place(to);
        let angles = "A 0.0,B 90.0,C 0.0";
        match self.post.style {
            Style::Full => self.line(&format!(
                "LIN {{X {x:.3},Y {y:.3},Z {z:.3},{angles}}} C_DIS ; cut\n"
            )),
            Style::Typed => self.line(&format!(
                "\tLIN {{E6POS: X {x:.4}, Y {y:.4}, Z {z:.4}, {angles}, E1 0.0, E2 0.0}}\n"
            )),
            Style::Parts => self.line(&format!("SLIN {{X {x:.3},Y {y:.3},Z {z:.3},{angles}}} C_SPL\n")),
            Style::Named => {
                self.points += 1;
                let name = format!("XP{}", self.points);
                let _ = writeln!(
                    self.data,
                    "DECL E6POS {name}={{X {x:.3},Y {y:.3},Z {z:.3},{angles},S 2,T 10}}"
                );
                self.line(&format!("LIN {name}\n"));
            }
            Style::Sparse => self.sparse(before, to),
        }
    }

    /// What is the same as before is left out.
    fn sparse(&mut self, before: [f64; 3], to: [f64; 3]) {
        let is_first = before[0].is_nan();
        let (before, to) = (self.place(before), self.place(to));
        let names = ["x", "y", "z"];
        let changed: Vec<String> = (0..3)
            .filter(|&axis| is_first || (before[axis] - to[axis]).abs() > 1e-9)
            .map(|axis| format!("{} {:.3}", names[axis], to[axis]))
            .collect();
        if !changed.is_empty() {
            self.line(&format!("lin {{{}}}\n", changed.join(", ")));
        }
    }

    fn finish(mut self) -> Vec<ProgramFile> {
        self.main += match self.post.style {
            Style::Sparse => "end\n",
            _ => "END\n",
        };
        let mut text = self.main + &self.parts;
        if self.post.style == Style::Full {
            text = text.replace('\n', "\r\n");
        }
        let file = |name: &str, text: String| ProgramFile {
            name: name.to_owned(),
            text,
        };
        let mut files = vec![file("raster.src", text)];
        if self.post.style == Style::Named {
            files.push(file("raster.dat", self.data + "ENDDAT\n"));
        }
        files
    }
}
